//! Turn numbers without a break over decades, from the phases of the averaged motion.
//!
//! [`Turns`](super::turns) follows a motion from one half radian to the next. Over 1e11 turns the whole turns must come of the phases:
//! with the symmetry axis `n` at the angle `theta` to `l` and the magnetic axis `m` at `chi` to `n`, the azimuth of `m` about `l` is
//!
//! ```text
//! phi_m = phi_n + D(gamma),    tan D = sin chi sin gamma / (cos chi sin theta + sin chi cos theta cos gamma)
//! ```
//!
//! with the angle `gamma` of `m` about `n` from the meridian away from `l`. `D` grows with `gamma` where the circle of `m` about `n`
//! encloses `l` (`theta < chi < pi - theta`), and swings to and fro by less than a quarter turn where it does not; `D - gamma` or `D` is
//! written so that it is regular at `theta = 0`, where `phi_n` and `gamma` have no meaning apart. `phi_n` and `gamma` are the phases
//! about `l` and about `n` but for what moves with `l`. That changes with the slow precession, and is followed in steps of it.

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;

use super::Beam;
use super::turns::phase;
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::numerics::angle::wrapped;
use crate::solutions::averaged::{AveragedSolution, AveragedTurns};

/// Slow precession (rad) between two looks.
const STRIDE: f64 = 0.25;

/// Most turns from the start: the sum of two such numbers has 64 bits.
const MOST_TURNS: u64 = 4_000_000_000_000_000_000;

/// Most strides from one pulse to the next: a second of work.
const MOST_STRIDES: f64 = 1e6;

/// Follows the turns of a magnetic axis in the principal frame of `s`.
#[derive(Debug, Clone)]
pub(super) struct TurnCount {
    beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
    /// Whether `n` is on the side of `l`; else `-n` is, and takes its place.
    upright: bool,
    /// Whether the circle of `m` encloses `l`.
    encloses: bool,
    /// Where the slow part of the phase was looked at last, and that part (rad) with its turns.
    last: ([f64; 2], f64),
}

/// A look at the phase.
pub(super) struct Look {
    /// Turn that is nearest.
    pub(super) number: i64,
    /// Phase (rad) from it, in (-pi, pi].
    pub(super) phase: f64,
}

/// A phase and what remains of it without the fast turns.
struct Parts {
    phase: f64,
    bounded: f64,
    /// Whole turns of the fast phases, and the rest (rad).
    whole: i64,
    fast: f64,
}

impl TurnCount {
    pub(super) fn new(
        motion: &AveragedSolution<f64>,
        beam: &Beam<f64>,
        line_of_sight: &Vector3<f64>,
    ) -> Result<Self, Error> {
        let start = motion.state(0.0);
        let c = start.axis.dot(&start.momentum.normalize());
        let (theta, chi) = (c.abs().min(1.0).acos(), beam.axis.z.clamp(-1.0, 1.0).acos());
        // The wobble changes by some x along the motion: nearer than that the axis of the beam goes now round L, now round n.
        let nearest = (theta - chi).abs().min((core::f64::consts::PI - theta - chi).abs());
        let changes = motion.relative_strength;
        Error::ensure(
            nearest > changes || changes == 0.0,
            "distance of the wobble from the angle of the beam (rad)",
            nearest,
            "above C |s| I^xx / |L|^2: nearer to it turns change their number",
        )?;
        let mut count = Self {
            beam: *beam,
            line_of_sight: *line_of_sight,
            upright: c >= 0.0,
            encloses: theta < chi && theta < core::f64::consts::PI - chi,
            last: ([0.0; 2], 0.0),
        };
        // The phases start at zero, so that this is the turn zero.
        count.last.1 = count.parts(&start, &motion.turns([0.0; 2]))?.slow();
        Ok(count)
    }

    /// Rate (rad per unit of time) at which turns follow one another.
    pub(super) fn rate(&self, motion: &AveragedSolution<f64>) -> f64 {
        let rates = &motion.rates;
        rates.about_momentum + self.weight() * rates.about_axis
    }

    fn weight(&self) -> f64 {
        match (self.encloses, self.upright) {
            (false, _) => 0.0,
            (true, true) => 1.0,
            (true, false) => -1.0,
        }
    }

    /// The turn at the time `t`, whose state `motion.near(t)` has at the time zero.
    pub(super) fn look(
        &mut self,
        motion: &AveragedSolution<f64>,
        t: [f64; 2],
        state: &BodyState<f64>,
    ) -> Result<Look, Error> {
        let parts = self.parts(state, &motion.turns(t))?;
        self.follow(motion, t, &parts)?;
        Ok(Look { number: self.number(&parts), phase: parts.phase })
    }

    fn number(&self, parts: &Parts) -> i64 {
        parts.whole + ((parts.fast + self.last.1 + parts.bounded - parts.phase) / TAU).round() as i64
    }

    /// From the last look to the time `t`.
    fn since_last(&self, t: [f64; 2]) -> f64 {
        (t[0] - self.last.0[0]) + (t[1] - self.last.0[1])
    }

    /// Follows the slow part to the time `t`.
    fn follow(&mut self, motion: &AveragedSolution<f64>, t: [f64; 2], parts: &Parts) -> Result<(), Error> {
        let step = STRIDE / motion.rates.slow.abs();
        let strides = self.since_last(t).abs() / step;
        Error::ensure(
            strides <= MOST_STRIDES,
            "slow precession since the last pulse, in quarter radians",
            strides,
            "at most 1e6: to count turns it is followed; ask for pulses between, or for weaker violation",
        )?;
        loop {
            let left = self.since_last(t);
            let mut ahead = left.clamp(-step, step);
            loop {
                let is_end = ahead == left;
                let (there, slow) = if is_end {
                    (t, parts.slow())
                } else {
                    let there = [self.last.0[0] + ahead, self.last.0[1]];
                    (there, self.parts(&motion.near(there).state(0.0), &motion.turns(there))?.slow())
                };
                let swept = wrapped(slow - self.last.1);
                if swept.abs() < FRAC_PI_2 || ahead.abs() <= f64::EPSILON * there[0].abs() {
                    self.last = (there, self.last.1 + swept);
                    if is_end {
                        return Ok(());
                    }
                    break;
                }
                ahead /= 2.0;
            }
        }
    }

    fn parts(&self, state: &BodyState<f64>, turns: &AveragedTurns) -> Result<Parts, Error> {
        let phase = phase(&self.beam, &self.line_of_sight, state)?;
        let (m, l) = (self.beam.direction(state), state.momentum.normalize());
        let sign = if self.upright { 1.0 } else { -1.0 };
        let (n, cos_chi) = (state.axis * sign, self.beam.axis.z * sign);
        let cos_theta = n.dot(&l);
        // sin(theta) sin(chi) times the cosine and the sine of gamma.
        let (cos, sin) = (cos_theta * cos_chi - m.dot(&l), m.dot(&l.cross(&n)));
        let bounded = if self.encloses {
            let share = cos / (1.0 + cos_theta);
            (sin * (share - cos_chi)).atan2(cos_chi * cos + (1.0 - cos_chi * cos_chi) - cos * share)
        } else {
            let side = if cos_chi < 0.0 { -1.0 } else { 1.0 };
            (side * sin).atan2(side * (cos_chi * l.cross(&n).norm_squared() + cos_theta * cos))
        };
        let (momentum, axis) = (turns.about_momentum, turns.about_axis);
        for turns in [momentum.whole, axis.whole] {
            let allowed = "at most 4e18 either way, for a number of 64 bits";
            Error::ensure(
                turns.unsigned_abs() <= MOST_TURNS,
                "number of turns since the start",
                turns as f64,
                allowed,
            )?;
        }
        let weight = self.weight();
        Ok(Parts {
            phase,
            bounded,
            whole: momentum.whole + weight as i64 * axis.whole,
            fast: momentum.angle() + weight * axis.angle(),
        })
    }
}

impl Parts {
    fn slow(&self) -> f64 {
        self.phase - self.bounded - self.fast
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use core::f64::consts::PI;

    use super::*;
    use crate::dynamics::{Problem, RigidSpheroid};
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::solutions::averaged::AveragingOrder;

    const S: [f64; 3] = [2e-4, -1e-4, 0.5e-4];

    fn solution(s: [f64; 3], axis: Vector3<f64>, momentum: Vector3<f64>) -> AveragedSolution<f64> {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let (axis, s) = (axis.normalize(), PrincipalCoefficients::new(s));
        let initial = BodyState { axis, momentum, equatorial_axis: axis.cross(&Vector3::x()).normalize() };
        AveragedSolution::new(&Problem::new(spheroid, s.tensor(), initial).unwrap(), AveragingOrder::Second).unwrap()
    }

    fn motion() -> AveragedSolution<f64> {
        solution(S, Vector3::new(0.1, -0.2, 0.9), Vector3::new(0.3, 0.7, 2.0))
    }

    fn sight() -> Vector3<f64> {
        Vector3::new(0.1, -0.3, 0.6).normalize()
    }

    fn encircling(motion: &AveragedSolution<f64>) -> TurnCount {
        TurnCount::new(motion, &Beam::new(0.9, 0.2, 0.3), &sight()).unwrap()
    }

    #[test]
    fn the_number_is_the_nearest_to_all_parts_together() {
        let mut count = encircling(&motion());
        count.last.1 = 4.7;
        let number = |parts: Parts| count.number(&parts);
        assert_eq!(number(Parts { phase: -4.7, bounded: 4.7, whole: 20, fast: 4.7 }), 23);
        count.last.1 = -4.7;
        let number = |parts: Parts| count.number(&parts);
        assert_eq!(number(Parts { phase: 4.7, bounded: -4.7, whole: 20, fast: -4.7 }), 17);
    }

    /// The strides of the slow part do not matter, nor does their sense.
    #[test]
    fn the_slow_part_is_followed_both_ways() {
        let motion = motion();
        let period = TAU / motion.rates.slow.abs();
        for beam in [Beam::new(0.9, 0.2, 0.3), Beam::new(0.06, 0.2, 0.3), Beam::new(3.0, 0.2, 0.3)] {
            let start = TurnCount::new(&motion, &beam, &sight()).unwrap();
            let number = |count: &mut TurnCount, t: f64| {
                let look = count.look(&motion, [t, 0.0], &motion.state(t)).unwrap();
                (look.number, count.last.1)
            };
            for end in [4.3 * period, -2.9 * period] {
                let mut in_one = start.clone();
                let (whole, slow) = number(&mut in_one, end);
                let mut in_many = start.clone();
                for k in 1..=997 {
                    let (next, _) = number(&mut in_many, end * f64::from(k) / 997.0);
                    // L goes round Z, and may round the line of sight, in a slow period.
                    let turns = start.rate(&motion) * end * f64::from(k) / 997.0 / TAU;
                    assert!((next as f64 - turns).abs() < 6.0, "{next} {turns}");
                }
                assert_eq!(number(&mut in_many, end).0, whole);
                assert_relative_eq!(in_many.last.1, slow, max_relative = 1e-9);
                assert_eq!(in_many.last.0, [end, 0.0]);
                assert_eq!(number(&mut in_many, 0.0).0, 0);
                assert_eq!(number(&mut in_one, 0.0).0, 0);
                // Times as sums of two numbers.
                let split = [end - 1e4, 1e4];
                let look = in_one.look(&motion, split, &motion.near(split).state(0.0)).unwrap();
                assert_eq!(look.number, whole);
            }
        }
    }

    #[test]
    fn what_cannot_be_followed_is_refused() {
        let motion = motion();
        let stride = 0.25 / motion.rates.slow.abs();
        let mut count = encircling(&motion);
        let refused = |count: &mut TurnCount, t: [f64; 2]| count.look(&motion, t, &motion.near(t).state(0.0)).is_err();
        for sign in [1.0, -1.0] {
            assert!(refused(&mut count, [sign * 1.01e6 * stride, 0.0]));
            assert!(refused(&mut count, [sign * 0.6e6 * stride, sign * 0.6e6 * stride]));
            assert!(!refused(&mut count, [sign * 40.0 * stride, 0.0]));
        }
        assert!(!refused(&mut count, [1.01e6 * stride, -1.0e6 * stride]));
        // A beam at the angle of the wobble.
        let theta = motion.state(0.0).axis.angle(&motion.state(0.0).momentum);
        for (chi, is_refused) in [(theta, true), (PI - theta, true), (theta + 0.01, false), (PI - theta - 0.01, false)]
        {
            assert_eq!(TurnCount::new(&motion, &Beam::new(chi, 0.2, 0.3), &sight()).is_err(), is_refused, "{chi}");
        }
    }

    /// Wherever the magnetic axis and its azimuth without the turns are at the start, which may be most of a turn apart.
    #[test]
    fn the_turn_of_the_time_zero_is_zero() {
        let motion = motion();
        let mut farthest = 0.0_f64;
        for k in 0..24 {
            let beam = Beam::new(0.9, 0.27 * f64::from(k), 0.3);
            for n in [Vector3::new(0.1, -0.3, 0.6), Vector3::new(-0.5, 0.2, -0.1), Vector3::new(0.0, 0.9, -0.1)] {
                let mut count = TurnCount::new(&motion, &beam, &n.normalize()).unwrap();
                farthest = farthest.max(count.last.1.abs());
                assert_eq!(count.look(&motion, [0.0; 2], &motion.state(0.0)).unwrap().number, 0, "{k}");
            }
        }
        assert!(farthest > 3.5, "{farthest}");
    }

    /// The slow part at a time, modulo a turn.
    fn slow_at(count: &TurnCount, motion: &AveragedSolution<f64>, t: [f64; 2]) -> f64 {
        count.parts(&motion.near(t).state(0.0), &motion.turns(t)).unwrap().slow()
    }

    /// What the slow part grows by along times that are close together.
    fn followed(count: &TurnCount, motion: &AveragedSolution<f64>, times: impl Iterator<Item = [f64; 2]>) -> f64 {
        let slow: Vec<_> = times.map(|t| slow_at(count, motion, t)).collect();
        let steps: Vec<_> = slow.windows(2).map(|pair| wrapped(pair[1] - pair[0])).collect();
        assert!(steps.iter().all(|step| step.abs() < 1.0), "{steps:?}");
        steps.iter().sum()
    }

    /// `L` passes the line of sight closely, on either side: with the slow precession the azimuth turns by more than half a turn in one stride.
    #[test]
    fn the_slow_part_is_followed_past_the_line_of_sight() {
        let motion = motion();
        let stride = STRIDE / motion.rates.slow.abs();
        let l = |t: f64| motion.near([t, 0.0]).state(0.0).momentum.normalize();
        let mut farthest = 0.0_f64;
        for sense in [1.0, -1.0] {
            let pass = sense * 3.3 * stride;
            let side = l(pass).cross(&(l(pass + stride) - l(pass - stride))).normalize();
            for off in [2e-4, -2e-4, 3e-2] {
                let n = (l(pass) + side * off).normalize();
                let start = TurnCount::new(&motion, &Beam::new(0.9, 0.2, 0.3), &n).unwrap();
                // Close together where it passes.
                let times = (-200..=200).map(|k| [pass + 3.3 * sense * stride * (f64::from(k) / 200.0).powi(3), 0.0]);
                let expected = start.last.1 + followed(&start, &motion, times);
                // In looks that hold the passage in a stride, in its first or in its second half.
                for looks in [&[6.6][..], &[2.9, 3.8, 6.6], &[3.2, 4.0, 6.6], &[2.4, 3.35, 6.6]] {
                    let mut count = start.clone();
                    for k in looks {
                        let t = [sense * k * stride, 0.0];
                        let before = count.last;
                        count.look(&motion, t, &motion.near(t).state(0.0)).unwrap();
                        if count.since_last(before.0).abs() < stride {
                            farthest = farthest.max((count.last.1 - before.1).abs());
                        }
                    }
                    assert!((count.last.1 - expected).abs() < 1e-9, "{sense} {off}: {} {expected}", count.last.1);
                }
            }
        }
        assert!(farthest > PI);
    }

    /// So late that `L` moves by a twentieth of a radian from one time to the next, and passes the line of sight between two.
    #[test]
    fn a_passage_between_two_neighbouring_times_is_passed() {
        let motion = motion();
        let spacing = (0.05 / motion.rates.slow.abs()).log2().round().exp2();
        for sense in [1.0, -1.0] {
            let start = sense * spacing * 2_f64.powi(52);
            let l = |x: f64| motion.near([start, sense * x * spacing]).state(0.0).momentum.normalize();
            let path = l(1.0) - l(0.0);
            let n = (l(0.5) + l(0.5).cross(&path) * 0.25).normalize();
            let mut count = TurnCount::new(&motion, &Beam::new(0.9, 0.2, 0.3), &n).unwrap();
            count.last = ([start, 0.0], slow_at(&count, &motion, [start, 0.0]));
            let times = (0..=200).map(|k| [start, sense * 0.02 * f64::from(k) * spacing]);
            let expected = count.last.1 + followed(&count, &motion, times);
            assert!((expected - count.last.1).abs() > FRAC_PI_2);
            let end = [start + sense * 4.0 * spacing, 0.0];
            count.look(&motion, end, &motion.near(end).state(0.0)).unwrap();
            assert_eq!(count.last.0, end);
            assert!((count.last.1 - expected).abs() < 1e-6, "{sense}: {} {expected}", count.last.1);
        }
    }

    #[test]
    fn the_limit_on_turns_is_checked_on_both_sides() {
        let motion = motion();
        let (count, state) = (encircling(&motion), motion.state(0.0));
        let turns = motion.turns([31.7, 0.0]);
        let most = 4_000_000_000_000_000_000;
        for (size, is_refused) in [(most, false), (most + 1, true)] {
            for whole in [size, -size] {
                let mut many = [turns; 2];
                many[0].about_momentum.whole = whole;
                many[1].about_axis.whole = whole;
                for turns in many {
                    assert_eq!(count.parts(&state, &turns).is_err(), is_refused, "{whole}");
                }
            }
        }
    }

    /// Cosines that rounding, or an axis that is of unit length to 1e-9, makes larger than one.
    #[test]
    fn cosines_above_one_are_those_of_no_angle() {
        for length in [1.0 + 5e-10, -1.0 - 5e-10] {
            let beam = Beam { axis: Vector3::z() * length, half_opening: 0.3 };
            assert!(TurnCount::new(&motion(), &beam, &sight()).is_ok_and(|count| !count.encloses), "{length}");
        }
        for k in 0..60 {
            let (sin, cos) = (0.1 * f64::from(k)).sin_cos();
            let axis = Vector3::new(sin, cos, 0.3 + 0.01 * f64::from(k)).normalize();
            for sign in [1.0, -1.0] {
                let count = encircling(&solution(S, axis, axis * (sign * 2.7)));
                assert!(count.encloses && count.upright == (sign > 0.0));
            }
        }
    }

    /// Without a torque nothing moves the axis of the beam from one side of `L` to the other, however near it is.
    #[test]
    fn a_beam_at_the_angle_of_the_wobble_is_refused_only_under_a_torque() {
        let initial = motion().state(0.0);
        for (s, is_refused) in [([0.0; 3], false), (S, true)] {
            let motion = solution(s, initial.axis, initial.momentum);
            let start = motion.state(0.0);
            let cos = start.axis.dot(&start.momentum.normalize());
            let beam = Beam { axis: Vector3::new((1.0 - cos * cos).sqrt(), 0.0, cos), half_opening: 0.3 };
            assert_eq!(TurnCount::new(&motion, &beam, &Vector3::x()).is_err(), is_refused, "{s:?}");
        }
    }
}
