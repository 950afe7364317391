//! The number of a turn, without a break over decades: from the phases of the mean motion.
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
use crate::solutions::mean::{MeanMotion, MeanTurns};

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
    /// Number of the turn that the time zero belongs to.
    first: i64,
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

fn wrapped(angle: f64) -> f64 {
    angle - (angle / TAU).round() * TAU
}

impl TurnCount {
    pub(super) fn new(motion: &MeanMotion<f64>, beam: &Beam<f64>, line_of_sight: &Vector3<f64>) -> Result<Self, Error> {
        let start = motion.state(0.0);
        let c = start.axis.dot(&start.momentum.normalize());
        let (theta, chi) = (c.abs().min(1.0).acos(), beam.axis.z.clamp(-1.0, 1.0).acos());
        // The wobble changes by some x along the motion: nearer than that the axis of the beam goes now round L, now round n.
        let nearest = (theta - chi).abs().min((core::f64::consts::PI - theta - chi).abs());
        let changes = motion.relative_strength();
        Error::unless(
            nearest > changes || motion.relative_strength() == 0.0,
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
            first: 0,
        };
        let parts = count.parts(&start, &motion.turns([0.0; 2]))?;
        count.last.1 = parts.slow();
        count.first = count.number(&parts);
        Ok(count)
    }

    /// Rate (rad per unit of time) at which turns follow one another.
    pub(super) fn rate(&self, motion: &MeanMotion<f64>) -> f64 {
        let rates = motion.rates();
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
        motion: &MeanMotion<f64>,
        t: [f64; 2],
        state: &BodyState<f64>,
    ) -> Result<Look, Error> {
        let parts = self.parts(state, &motion.turns(t))?;
        self.follow(motion, t, &parts)?;
        Ok(Look { number: self.number(&parts) - self.first, phase: parts.phase })
    }

    fn number(&self, parts: &Parts) -> i64 {
        parts.whole + ((parts.fast + self.last.1 + parts.bounded - parts.phase) / TAU).round() as i64
    }

    /// Follows the slow part to the time `t`.
    fn follow(&mut self, motion: &MeanMotion<f64>, t: [f64; 2], parts: &Parts) -> Result<(), Error> {
        let step = STRIDE / motion.rates().slow.abs();
        let strides = ((t[0] - self.last.0[0]) + (t[1] - self.last.0[1])).abs() / step;
        Error::unless(
            strides <= MOST_STRIDES,
            "slow precession since the last pulse, in quarter radians",
            strides,
            "at most 1e6: to count turns it is followed; ask for pulses between, or for weaker violation",
        )?;
        loop {
            let left = (t[0] - self.last.0[0]) + (t[1] - self.last.0[1]);
            if left.abs() <= step {
                let swept = wrapped(parts.slow() - self.last.1);
                if swept.abs() < FRAC_PI_2 || left.abs() <= f64::EPSILON * t[0].abs() {
                    self.last = (t, self.last.1 + swept);
                    return Ok(());
                }
            }
            let mut ahead = (left / 2.0).clamp(-step, step);
            loop {
                let there = [self.last.0[0] + ahead, self.last.0[1]];
                let between = self.parts(&motion.near(there).state(0.0), &motion.turns(there))?;
                let swept = wrapped(between.slow() - self.last.1);
                if swept.abs() < FRAC_PI_2 || ahead.abs() <= f64::EPSILON * there[0].abs() {
                    self.last = (there, self.last.1 + swept);
                    break;
                }
                ahead /= 2.0;
            }
        }
    }

    fn parts(&self, state: &BodyState<f64>, turns: &MeanTurns) -> Result<Parts, Error> {
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
            Error::unless(
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
    use nalgebra::{Rotation3, Unit};

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::solutions::mean::MeanOrder;

    fn motion() -> MeanMotion<f64> {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let s = PrincipalCoefficients::new([2e-4, -1e-4, 0.5e-4]);
        let momentum = Vector3::new(0.3, 0.7, 2.0);
        let axis = Vector3::new(0.1, -0.2, 0.9).normalize();
        let equatorial_axis = axis.cross(&Vector3::x()).normalize();
        MeanMotion::new(&spheroid, &s, &BodyState { axis, momentum, equatorial_axis }, MeanOrder::Second).unwrap()
    }

    /// A count whose beam is at the angle `chi` to the axis, and the state in which the axis is at `theta` to L, at the azimuth `about_l`, and the
    /// magnetic axis turned about it by `gamma` from the meridian away from L.
    fn look(theta: f64, chi: f64, about_l: f64, gamma: f64) -> (TurnCount, BodyState<f64>, [Vector3<f64>; 3]) {
        let l = Vector3::new(0.36, 0.48, 0.8);
        let from = l.cross(&Vector3::x()).normalize();
        let turned = |axis: &Vector3<f64>, angle: f64, v: Vector3<f64>| {
            Rotation3::from_axis_angle(&Unit::new_normalize(*axis), angle) * v
        };
        let azimuth = turned(&l, about_l, from);
        let axis = l * theta.cos() + azimuth * theta.sin();
        let away = azimuth * theta.cos() - l * theta.sin();
        let m = axis * chi.cos() + turned(&axis, gamma, away) * chi.sin();
        // The beam's own azimuth about the body's axis.
        let beam = Beam::new(chi, 0.7, 0.2);
        let meridian = (m - axis * chi.cos()) / chi.sin();
        let state = BodyState { axis, momentum: l * 2.7, equatorial_axis: turned(&axis, -0.7, meridian) };
        let count = TurnCount {
            beam,
            line_of_sight: Vector3::new(0.1, -0.3, 0.6).normalize(),
            upright: theta <= PI / 2.0,
            encloses: theta.min(PI - theta) < chi && theta.min(PI - theta) < PI - chi,
            last: ([0.0; 2], 0.0),
            first: 0,
        };
        (count, state, [l, from, m])
    }

    #[test]
    fn what_is_bounded_is_the_azimuth_without_the_turns() {
        let turns = motion().turns([31.7, 0.0]);
        for (theta, chi) in
            [(0.4, 0.9), (0.9, 0.4), (0.5, 2.9), (0.4, 1.9), (2.6, 0.9), (2.3, 0.4), (2.7, 1.9), (2.3, 2.9)]
        {
            for (about_l, gamma) in [(0.3, 0.2), (1.9, 2.2), (-2.5, -0.9), (0.8, -2.8), (3.0, 1.4)] {
                let (count, state, [l, from, m]) = look(theta, chi, about_l, gamma);
                assert!((count.beam.direction(&state) - m).norm() < 1e-14);
                let parts = count.parts(&state, &turns).unwrap();
                // Of -n, where that is on the side of L.
                let sign = if count.upright { 1.0 } else { -1.0 };
                let azimuth = |v: &Vector3<f64>| l.dot(&from.cross(v)).atan2(from.dot(v) - l.dot(&from) * l.dot(v));
                let n = state.axis * sign;
                let away = n * n.dot(&l) - l;
                let turned = n.dot(&away.cross(&m)).atan2(away.dot(&m));
                let weight = if count.encloses { 1.0 } else { 0.0 };
                let side = if !count.encloses && chi.cos() * sign < 0.0 { PI } else { 0.0 };
                let exact = azimuth(&m) - azimuth(&n) - weight * turned - side;
                assert!(
                    wrapped(parts.bounded - exact).abs() < 1e-13,
                    "{theta} {chi} {gamma}: {} {exact}",
                    parts.bounded
                );
                assert!(count.encloses || parts.bounded.abs() < FRAC_PI_2);
                assert!(parts.bounded.abs() <= PI);
                let phase = azimuth(&m) - azimuth(&count.line_of_sight);
                assert!(wrapped(parts.phase - phase).abs() < 1e-13);
                assert_eq!(count.weight(), weight * sign);
                assert_eq!(parts.whole, turns.about_momentum.whole + (weight * sign) as i64 * turns.about_axis.whole);
                let fast = turns.about_momentum.angle() + weight * sign * turns.about_axis.angle();
                assert_relative_eq!(parts.fast, fast);
                assert_eq!(parts.slow(), parts.phase - parts.bounded - parts.fast);
            }
        }
    }

    #[test]
    fn the_number_is_the_nearest_to_all_parts_together() {
        let (mut count, ..) = look(0.4, 0.9, 0.3, 0.2);
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
        let period = TAU / motion.rates().slow.abs();
        for beam in [Beam::new(0.9, 0.2, 0.3), Beam::new(0.06, 0.2, 0.3), Beam::new(3.0, 0.2, 0.3)] {
            let start = TurnCount::new(&motion, &beam, &Vector3::new(0.1, -0.3, 0.6).normalize()).unwrap();
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
        let n = Vector3::new(0.1, -0.3, 0.6).normalize();
        let stride = 0.25 / motion.rates().slow.abs();
        let mut count = TurnCount::new(&motion, &Beam::new(0.9, 0.2, 0.3), &n).unwrap();
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
            assert_eq!(TurnCount::new(&motion, &Beam::new(chi, 0.2, 0.3), &n).is_err(), is_refused, "{chi}");
        }
    }
}
