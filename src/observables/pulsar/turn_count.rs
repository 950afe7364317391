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
