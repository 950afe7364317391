//! Phases that grow over many turns, and are known to a fixed fraction of a turn.
//!
//! A double has 16 digits: after 1e12 turns the phase of a pulsar has four left. The rates of the fast rotation about `L` and of the
//! third angle are therefore sums of two doubles, and so is the time. The contribution of Lorentz violation to them, and the slow
//! rate, are so much smaller that a double is sufficient.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::numerics::angle::WHOLE;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::{Real, real_part};

/// A phase in turns: `whole + fraction`, the fraction between -1/2 and 1/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turns {
    /// Whole turns; correct below 9e18.
    pub whole: i64,
    /// The remainder.
    pub fraction: f64,
}

impl Turns {
    /// The remainder as an angle (rad).
    pub fn angle(&self) -> f64 {
        self.fraction * TAU
    }

    /// The phase at the `time`, from the turns at the time zero (less than one) and a rate in turns.
    #[inline]
    pub(crate) fn at(start: f64, rate: DoubleDouble, time: DoubleDouble) -> Self {
        let DoubleDouble { high, low } = rate * time;
        let (whole, whole_low) = (nearest(high), nearest(low));
        // The difference is exact; the added term is below two.
        let rest = (high - whole) + (low - whole_low) + start;
        let more = nearest(rest);
        let whole = (whole as i64).saturating_add((whole_low + more) as i64);
        Self { whole, fraction: rest - more }
    }
}

/// The nearest integer. Adding and subtracting [`WHOLE`] rounds to it, without a function call on processors that have no such
/// instruction.
#[inline]
fn nearest(x: f64) -> f64 {
    if x.abs() < 1e15 { (x + WHOLE) - WHOLE } else { x.round() }
}

/// The phases of a motion in turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AveragedTurns {
    /// Phase of the slow precession of `L`; on a separatrix, where it has no period, `u / (2 pi)`.
    pub slow: Turns,
    /// Rotation of the frame about `L`, without its periodic part.
    pub about_momentum: Turns,
    /// Rotation of the body about its symmetry axis relative to the frame.
    pub about_axis: Turns,
}

/// Mean rates of a motion (rad per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AveragedRates<S> {
    /// Rate of the phase of the slow precession, which grows by a turn when `L` circles its axis once, in either sense; `lambda` on
    /// a separatrix.
    pub slow: S,
    /// Rate of the frame about `L`, without its periodic part.
    pub about_momentum: S,
    /// Rate of the body about its symmetry axis relative to the frame.
    pub about_axis: S,
}

/// Phases of a motion at one time (rad), defined modulo a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AveragedPhases<S> {
    /// Phase with the rate [`AveragedRates::slow`], including its initial value.
    pub slow: S,
    /// Phase with the rate [`AveragedRates::about_momentum`].
    pub about_momentum: S,
    /// Phase with the rate [`AveragedRates::about_axis`].
    pub about_axis: S,
}

impl<S: Real> AveragedPhases<S> {
    /// The phases after an additional time.
    pub(crate) fn later(&self, rates: &AveragedRates<S>, time: S) -> Self {
        Self {
            slow: self.slow + rates.slow * time,
            about_momentum: self.about_momentum + rates.about_momentum * time,
            about_axis: self.about_axis + rates.about_axis * time,
        }
    }
}

/// The contribution of Lorentz violation to the rates of free rotation, and the slow rate.
pub(super) struct Added<S> {
    pub(super) slow: S,
    pub(super) about_momentum: S,
    pub(super) about_axis: S,
}

/// Rates in turns: `|L| / I^xx` and `-epsilon Omega^z` to 32 digits, plus the added rates.
pub(super) fn turning<S: Real>(
    spheroid: &RigidSpheroid<S>,
    initial: &BodyState<S>,
    added: &Added<S>,
) -> [DoubleDouble; 3] {
    let [inertia_xx, inertia_zz] = [spheroid.inertia_xx, spheroid.inertia_zz].map(S::re);
    let [n, momentum] = [&initial.axis, &initial.momentum].map(|v| real_part(v).into());
    let about_momentum = DoubleDouble::dot(&momentum, &momentum).sqrt().over(inertia_xx.into());
    let difference = DoubleDouble::sum(inertia_xx, -inertia_zz);
    let about_axis =
        (difference * DoubleDouble::dot(&momentum, &n)).over(DoubleDouble::product(inertia_xx, inertia_zz));
    let with = |free: DoubleDouble, added: S| (free + added.re().into()).over(DoubleDouble::TAU);
    [
        with(DoubleDouble::default(), added.slow),
        with(about_momentum, added.about_momentum),
        with(about_axis, added.about_axis),
    ]
}

/// The error of the length of `n` due to rounding: `n.n - 1`, to its own digits.
pub(super) fn excess_of_length<S: Real>(axis: &Vector3<S>) -> f64 {
    let n = real_part(axis).into();
    (DoubleDouble::dot(&n, &n) + (-1.0).into()).high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_whole_number_is_that_of_any_size() {
        for x in [0.4, -0.4, 1.6, -7.7, 1e14 + 0.4, 1e15 + 0.375, -1e15 - 0.625, 4e15, 1e300] {
            assert_eq!(nearest(x), f64::round(x), "{x}");
        }
    }
}
