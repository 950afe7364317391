//! Continuous turn numbers over any number of turns, from the phases of the motion.
//!
//! `AzimuthFollower` follows a motion in steps of half a radian. Over 1e11 turns, the whole turns must instead be computed from the phases
//! `theta_i = theta_i0 + w_i t`. The state is a periodic function of these. The azimuth of the magnetic axis `m` about `L` from the line of sight is
//! then
//!
//! ```text
//! phi(t) = sum_i k_i theta_i + periodic function of theta,    k_i whole numbers,    mean rate sum_i k_i w_i
//! ```
//!
//! if neither `m` nor the line of sight is along `L` anywhere on the torus of the phases. `k_i` is the number of turns of `phi` along a closed path
//! on which `theta_i` grows by one turn. At a given time each whole turn of phase `i` counts `k_i`, and the rest of `phi` is followed along the
//! straight path from the start to the fractional phases.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;

use super::Beam;
use super::azimuth_follower::phase;
use crate::error::Error;
use crate::numerics::angle::wrapped;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::PhasedMotion;
use crate::solutions::averaged::Turns;

/// Initial number of evaluations per turn of a phase.
const LOOKS: f64 = 16.0;

/// Shortest step between two evaluations, as a fraction of the path. A path that passes `L` more closely may count on either
/// side.
const SHORTEST: f64 = 1e-12;

/// Number of points along a phase at which a torus is sampled.
const MESH: usize = 20;

/// Fraction of the range of an angle that may lie between the points.
const BETWEEN_POINTS: f64 = 0.1;

/// Largest number of turns from the start, such that the sum of two of them fits into 64 bits.
const MOST_TURNS: f64 = 4e18;

/// The turns of a magnetic axis.
#[derive(Debug, Clone)]
pub(super) struct TurnCount {
    beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
    /// Phases at the time zero.
    start: [Turns; 3],
    /// Turns of the magnetic axis per turn of each phase.
    windings: [i64; 3],
}

/// An evaluation of the phase.
pub(super) struct Look {
    /// Number of the nearest turn.
    pub(super) number: i64,
    /// Phase (rad) relative to it, from -pi to pi.
    pub(super) phase: f64,
}

impl TurnCount {
    /// The windings are determined along paths at [`MESH`] positions. For a line of sight inside the ring that `L` covers, but within some hundredths
    /// of its width from the edge, windings may be missed.
    pub(super) fn new(motion: &PhasedMotion, beam: &Beam<f64>, line_of_sight: &Vector3<f64>) -> Result<Self, Error> {
        let start = motion.turns([0.0; 2]);
        let mut count = Self { beam: *beam, line_of_sight: *line_of_sight, start, windings: [0; 3] };
        count.check_wobble(motion)?;
        for along in 0..3 {
            // The path of `m` was checked, and `L` depends on the first two phases only.
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
                    "zero; the line of sight is along L at some phases, where the number of turns about L changes";
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

    /// Refuses a torus on which `m` comes along `L`: where the wobble, the angle of `n` to `L`, equals the angle of the beam axis to
    /// `n` or its supplement.
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
            "above a tenth of their range; within it the magnetic axis comes along L, where the number of turns about L changes",
        )
    }

    /// Mean rotation rate (rad per unit of time) of the magnetic axis about `L`.
    pub(super) fn rate(&self, motion: &PhasedMotion) -> f64 {
        self.windings.iter().zip(motion.rates()).map(|(turns, rate)| *turns as f64 * rate).sum()
    }

    /// The mean rotation rate in turns per unit of time, to 32 digits where the rates are known to that precision.
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
        let allowed = "at most 4e18 in size, to fit in 64 bits";
        Error::ensure(most <= MOST_TURNS, "number of turns since the start", most, allowed)?;
        let [_, followed] =
            self.followed(motion, self.start.map(|turns| turns.fraction), moved.map(|turns| turns - turns.round()))?;
        let phase = wrapped(followed);
        Ok(Look { number: whole.iter().sum::<i128>() as i64 + ((followed - phase) / TAU).round() as i64, phase })
    }

    /// The phase at the start of a straight path on the torus, and at its end including whole turns.
    ///
    /// Each evaluation sees the state, so `L` and `m` cannot have gone once around between two evaluations less than a radian apart. The azimuth
    /// swept about a point that a path passes is at most half a turn plus the turn of the path itself: a piece with less than a quarter turn between
    /// its ends hides none.
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
    use crate::observables::pulsar::azimuth_follower::AzimuthFollower;
    use crate::propagation::{AveragedMotion, Motion, TorusMotion};

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

    /// For averaged motions and motions on the torus, and for beams that enclose `L` or do not, on either side.
    #[test]
    fn turns_are_those_that_a_motion_takes_one_by_one() {
        fn compare(phased: &PhasedMotion, motion: &impl Motion<f64, State = BodyState<f64>>) {
            for beam in [Beam::new(0.9, 0.2, 0.3), Beam::new(0.02, 0.2, 0.3), Beam::new(3.1, 0.2, 0.3)] {
                let count = TurnCount::new(phased, &beam, &sight()).unwrap();
                let mut turns = AzimuthFollower::new(motion, &beam, &count.line_of_sight, 3.0, 0.0).unwrap();
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
        let averaged = AveragedMotion::new(&weak, (0.0, 1e3)).unwrap();
        compare(&PhasedMotion::averaged(&weak).unwrap(), &averaged);
        let strong = problem(1.0);
        let exact = TorusMotion::new(&strong, (0.0, 1e3), 1e-14).unwrap();
        compare(&PhasedMotion::torus(&strong, 1e3).unwrap(), &exact);
    }

    #[test]
    fn the_turn_of_the_time_zero_is_zero() {
        // With L in principal planes phases start at half a turn, at a whole one or at zero.
        let motions = [[0.3, 0.0], [-0.3, 0.0], [0.0, 0.7], [0.0, -0.7]].map(|[x, y]| {
            let weak = problem(0.1);
            let start = BodyState { momentum: Vector3::new(x, y, 2.0), ..*weak.initial() };
            PhasedMotion::averaged(&weak.starting_from(start).unwrap()).unwrap()
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

    /// At the only place where the azimuth jumps, where the magnetic axis passes `L`, either side may be counted.
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
        // The azimuth jumps by half a turn, except for its change in a ten-thousandth of a turn.
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
