//! Turn numbers without a break over any number of turns, from the phases of the motion.
//!
//! [`Turns`](super::turns) follows a motion from one half radian to the next. Over 1e11 turns the whole turns must come of the phases `theta_i = theta_i0 + w_i t`, of
//! which the state is a periodic function. The azimuth of the magnetic axis `m` about `L` from the line of sight is then
//!
//! ```text
//! phi(t) = sum_i k_i theta_i + periodic function of theta,    k_i whole numbers,    mean rate sum_i k_i w_i
//! ```
//!
//! if neither `m` nor the line of sight is along `L` anywhere on the torus of the phases. `k_i` are the turns of `phi` along a closed way on which `theta_i` grows by a
//! turn; at a time the whole turns of the phases count `k_i` each, and the rest of `phi` is followed along the straight way from the start to the rest of the phases.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;

use super::Beam;
use super::turns::phase;
use crate::error::Error;
use crate::numerics::angle::wrapped;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::PhasedMotion;
use crate::solutions::averaged::Turns;

/// Looks in a turn of a phase, to begin with.
const LOOKS: f64 = 16.0;

/// Shortest step between two looks, as a part of the path. A path that passes `L` nearer than that may count on either side.
const SHORTEST: f64 = 1e-12;

/// Points along a phase at which a torus is looked at.
const MESH: usize = 20;

/// Part of the range of an angle that may lie between the points.
const BETWEEN_POINTS: f64 = 0.1;

/// Most turns from the start: the sum of two such numbers has 64 bits.
const MOST_TURNS: f64 = 4e18;

/// The turns of a magnetic axis.
#[derive(Debug, Clone)]
pub(super) struct TurnCount {
    beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
    /// Phases at the time zero.
    start: [Turns; 3],
    /// Turns with a turn of each phase.
    windings: [i64; 3],
}

/// A look at the phase.
pub(super) struct Look {
    /// Turn that is nearest.
    pub(super) number: i64,
    /// Phase (rad) from it, in (-pi, pi].
    pub(super) phase: f64,
}

impl TurnCount {
    /// Windings are those of ways at [`MESH`] places; of a line of sight just inside the ring that `L` covers, by some hundredths of its width, they may not tell.
    pub(super) fn new(motion: &PhasedMotion, beam: &Beam<f64>, line_of_sight: &Vector3<f64>) -> Result<Self, Error> {
        let start = motion.turns([0.0; 2]);
        let mut count = Self { beam: *beam, line_of_sight: *line_of_sight, start, windings: [0; 3] };
        count.check_wobble(motion)?;
        for along in 0..3 {
            // What `m` does was checked, and where `L` is depends on the first two.
            for place in 0..if along == 2 { 1 } else { MESH } {
                let mut from = start.map(|turns| turns.fraction);
                from[usize::from(along == 0)] += place as f64 / MESH as f64;
                let way = core::array::from_fn(|i| if i == along { 1.0 } else { 0.0 });
                let [first, last] = count.followed(motion, from, way)?;
                let winding = (last - first) / TAU;
                if place == 0 {
                    count.windings[along] = winding.round() as i64;
                }
                let off = winding - count.windings[along] as f64;
                let allowed =
                    "zero: the line of sight is along L at some phases, and turns about L change their number there";
                Error::ensure(
                    off.abs() < 0.5,
                    "turns that differ between paths round the torus",
                    off.round(),
                    allowed,
                )?;
            }
        }
        Ok(count)
    }

    /// Refuses a torus on which `m` comes along `L`: where the wobble, the angle of `n` to `L`, is that of the beam, or its supplement.
    fn check_wobble(&self, motion: &PhasedMotion) -> Result<(), Error> {
        let at = |i: usize| (i % MESH) as f64 / MESH as f64;
        let wobbles = (0..MESH * MESH).map(|i| {
            let state = motion.state_at([at(i), at(i / MESH), 0.0]);
            state.axis.angle(&state.momentum)
        });
        let (least, most) = wobbles.fold((PI, 0.0_f64), |(least, most), angle| (least.min(angle), most.max(angle)));
        let chi = self.beam.axis.z.clamp(-1.0, 1.0).acos();
        let outside = |angle: f64| (least - angle).max(angle - most);
        let nearest = outside(chi).min(outside(PI - chi));
        Error::ensure(
            nearest > BETWEEN_POINTS * (most - least),
            "distance of the angles of the wobble from that of the beam (rad)",
            nearest,
            "above a tenth of their range: within it the magnetic axis comes along L, and turns about L change their number",
        )
    }

    /// Rate (rad per unit of time) at which turns follow one another.
    pub(super) fn rate(&self, motion: &PhasedMotion) -> f64 {
        self.windings.iter().zip(motion.rates()).map(|(turns, rate)| *turns as f64 * rate).sum()
    }

    /// The same in turns, to 32 digits where they are known.
    pub(super) fn per_time(&self, motion: &PhasedMotion) -> DoubleDouble {
        let rates = self.windings.iter().zip(motion.turns_per_time());
        rates.fold(DoubleDouble::default(), |sum, (turns, rate)| sum + rate * (*turns as f64))
    }

    /// The turn at the time `t`.
    pub(super) fn look(&self, motion: &PhasedMotion, t: [f64; 2]) -> Result<Look, Error> {
        let turns = motion.turns(t);
        let moved: [f64; 3] = core::array::from_fn(|i| turns[i].fraction - self.start[i].fraction);
        let whole: [i128; 3] = core::array::from_fn(|i| {
            let whole = i128::from(turns[i].whole) - i128::from(self.start[i].whole) + moved[i].round() as i128;
            i128::from(self.windings[i]) * whole
        });
        let most = whole.iter().map(|turns| turns.unsigned_abs() as f64).sum();
        let allowed = "at most 4e18 either way, for a number of 64 bits";
        Error::ensure(most <= MOST_TURNS, "number of turns since the start", most, allowed)?;
        let [_, followed] =
            self.followed(motion, self.start.map(|turns| turns.fraction), moved.map(|turns| turns - turns.round()))?;
        let phase = wrapped(followed);
        Ok(Look { number: whole.iter().sum::<i128>() as i64 + ((followed - phase) / TAU).round() as i64, phase })
    }

    /// The phase at the start of a straight way on the torus, and at its end with its whole turns.
    ///
    /// A look sees the state, so that between two looks less than a radian apart `L` and `m` have gone no way round. The azimuth swept about a point that a path
    /// passes is at most half a turn and what the path itself turns by: a piece with less than a quarter turn between its ends has none hidden.
    fn followed(&self, motion: &PhasedMotion, from: [f64; 3], way: [f64; 3]) -> Result<[f64; 2], Error> {
        let look = |part: f64| {
            let state = motion.state_at(core::array::from_fn(|i| from[i] + part * way[i]));
            let directions = [state.momentum.normalize(), self.beam.direction(&state)];
            Ok((phase(&self.beam, &self.line_of_sight, &state)?, directions))
        };
        let pieces = (LOOKS * way.iter().fold(0.0_f64, |most, turns| most.max(turns.abs()))).ceil();
        let (mut part, mut last) = (0.0, look(0.0)?);
        let mut phases = [last.0; 2];
        while part < 1.0 {
            let next = part + 1.0 / pieces;
            let mut to = if next < 1.0 - SHORTEST { next } else { 1.0 };
            loop {
                let there = look(to)?;
                let swept = wrapped(there.0 - last.0);
                let is_near = last.1.iter().zip(&there.1).all(|(a, b)| a.dot(b) > 0.5);
                if is_near && swept.abs() < FRAC_PI_2 || to - part < SHORTEST {
                    phases[1] += swept;
                    (part, last) = (to, there);
                    break;
                }
                to = part + (to - part) / 2.0;
            }
        }
        Ok(phases)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{BodyState, Problem, RigidSpheroid};
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::observables::pulsar::turns::Turns as Followed;
    use crate::propagation::{AveragedMotion, Motion, TorusMotion};
    use crate::solutions::averaged::AveragingOrder;

    fn problem(scale: f64) -> Problem<f64> {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let axis = Vector3::new(0.1, -0.2, 0.9).normalize();
        let equatorial_axis = axis.cross(&Vector3::x()).normalize();
        let initial = BodyState { axis, momentum: Vector3::new(0.3, 0.7, 2.0), equatorial_axis };
        let s = PrincipalCoefficients::new([0.2, -0.1, 0.05].map(|value| value * scale));
        Problem::new(spheroid, s.tensor(), initial).unwrap()
    }

    fn sight() -> Vector3<f64> {
        Vector3::new(0.1, -0.3, 0.6).normalize()
    }

    /// Of motions in averaged form and on the torus, of beams that enclose `L` or do not, on either side.
    #[test]
    fn turns_are_those_that_a_motion_takes_one_by_one() {
        fn compare(phased: &PhasedMotion, motion: &impl Motion<f64, State = BodyState<f64>>) {
            for beam in [Beam::new(0.9, 0.2, 0.3), Beam::new(0.02, 0.2, 0.3), Beam::new(3.1, 0.2, 0.3)] {
                let count = TurnCount::new(phased, &beam, &sight()).unwrap();
                let mut turns = Followed::new(motion, &beam, &count.line_of_sight, 3.0, 0.0).unwrap();
                let first = turns.at(0.0).unwrap();
                let mut farthest = 0.0_f64;
                for k in 0..300 {
                    let t = 3.3 * f64::from(k);
                    let look = count.look(phased, [t - 7.0, 7.0]).unwrap();
                    let expected = turns.at(t).unwrap() - wrapped(first) + first;
                    assert!((look.number as f64 * TAU + look.phase - expected).abs() < 1e-8, "{beam:?} {t}");
                    farthest = farthest.max((expected - count.rate(phased) * t).abs());
                }
                assert!(farthest < 9.0, "{farthest}");
            }
        }
        let weak = problem(1e-3);
        let averaged = AveragedMotion::new(&weak, (0.0, 1e3), AveragingOrder::Second).unwrap();
        compare(&PhasedMotion::averaged(&weak, AveragingOrder::Second).unwrap(), &averaged);
        let strong = problem(1.0);
        let exact = TorusMotion::new(&strong, (0.0, 1e3), 1e-14).unwrap();
        compare(&PhasedMotion::torus(&strong, 1e3).unwrap(), &exact);
    }

    #[test]
    fn the_turn_of_the_time_zero_is_zero() {
        // With L in principal planes phases start at half a turn, as a whole one or none.
        let motions = [[0.3, 0.0], [-0.3, 0.0], [0.0, 0.7], [0.0, -0.7]].map(|[x, y]| {
            let weak = problem(0.1);
            let start = BodyState { momentum: Vector3::new(x, y, 2.0), ..*weak.initial() };
            PhasedMotion::averaged(&weak.starting_from(start).unwrap(), AveragingOrder::Second).unwrap()
        });
        for (motion, k) in motions.iter().flat_map(|motion| (0..12).map(move |k| (motion, k))) {
            let beam = Beam::new(0.9, 0.54 * f64::from(k), 0.3);
            for n in [Vector3::new(0.1, -0.3, 0.6), Vector3::new(-0.5, 0.2, -0.1), Vector3::new(0.0, 0.9, -0.1)] {
                let count = TurnCount::new(motion, &beam, &n.normalize()).unwrap();
                assert_eq!(count.look(motion, [0.0; 2]).unwrap().number, 0, "{k}");
            }
        }
    }

    #[test]
    fn an_axis_that_comes_along_the_momentum_is_refused() {
        let motion = PhasedMotion::torus(&problem(1.0), 1e3).unwrap();
        let state = motion.state([17.0, 0.0]);
        let wobble = state.axis.angle(&state.momentum);
        let quantity = |chi: f64, n: &Vector3<f64>| match TurnCount::new(&motion, &Beam::new(chi, 0.2, 0.3), n) {
            Err(Error::Domain { quantity, .. }) => quantity,
            other => panic!("{other:?}"),
        };
        for chi in [wobble, PI - wobble] {
            assert!(quantity(chi, &sight()).starts_with("distance of the angles of the wobble"));
        }
        for n in [state.momentum.normalize(), -state.momentum.normalize()] {
            assert!(quantity(0.9, &n).starts_with("turns that differ"));
        }
    }

    /// At the one place where the azimuth jumps, as the magnetic axis passes `L`, it counts on either side.
    #[test]
    fn a_way_through_the_momentum_is_followed() {
        let motion = PhasedMotion::torus(&problem(1.0), 1e3).unwrap();
        let (state, phases) = (motion.state([17.0, 0.0]), motion.turns([17.0, 0.0]).map(|turns| turns.fraction));
        let l = state.momentum.normalize();
        let (n, x) = (state.axis, state.equatorial_axis);
        let axis = Vector3::new(l.dot(&x), l.dot(&n.cross(&x)), l.dot(&n));
        let count = TurnCount::new(&motion, &Beam::new(0.9, 0.2, 0.3), &sight()).unwrap();
        let through = TurnCount { beam: Beam { axis, half_opening: 0.3 }, ..count };
        let from = [phases[0] - 0.3, phases[1], phases[2]];
        let way = |turns: f64| through.followed(&motion, from, [turns, 0.0, 0.0]).unwrap();
        // The azimuth jumps by half a turn, but for what it turns by in a ten-thousandth of one.
        let [[_, before], [_, after]] = [0.29995, 0.30005].map(way);
        assert!(((after - before).abs() - PI).abs() < 0.01, "{before} {after}");
    }

    #[test]
    fn the_limit_on_turns_is_checked_on_both_sides() {
        let motion = PhasedMotion::torus(&problem(1.0), 1e3).unwrap();
        let count = TurnCount::new(&motion, &Beam::new(0.9, 0.2, 0.3), &sight()).unwrap();
        let all = count.windings.iter().zip(motion.rates()).map(|(turns, rate)| (*turns as f64 * rate).abs());
        let most = MOST_TURNS * TAU / all.sum::<f64>();
        for sign in [1.0, -1.0] {
            let refused = |part: f64| count.look(&motion, [sign * part * most, 0.0]).is_err();
            assert!(refused(1.001) && !refused(0.999));
        }
    }
}
