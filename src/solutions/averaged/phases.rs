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
    pub(crate) fn angle(&self) -> f64 {
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

/// A value for each of the three rotations of an averaged motion: their phases, in rad or in turns, or their rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfRotations<T> {
    /// The slow precession of `L`. Its phase grows by a turn when `L` circles its axis once, in either sense; on a separatrix, where it has no
    /// period, it is `u`, and its rate `lambda`.
    pub slow: T,
    /// The rotation of the frame about `L`, without its periodic part.
    pub about_momentum: T,
    /// The rotation of the body about its symmetry axis relative to the frame.
    pub about_axis: T,
}

impl<T: Copy> OfRotations<T> {
    /// Applies `f` to each value and to the value for the same rotation in `other`.
    pub(crate) fn with<U: Copy, V>(&self, other: &OfRotations<U>, f: impl Fn(T, U) -> V) -> OfRotations<V> {
        OfRotations {
            slow: f(self.slow, other.slow),
            about_momentum: f(self.about_momentum, other.about_momentum),
            about_axis: f(self.about_axis, other.about_axis),
        }
    }
}

impl<S: Real> OfRotations<S> {
    /// These phases after the additional `time`, for the given `rates`.
    pub(crate) fn later(&self, rates: &Self, time: S) -> Self {
        self.with(rates, |phase, rate| phase + rate * time)
    }
}

/// Rates in turns per unit of time: those of free rotation, `|L| / I^xx` and `-epsilon Omega^z`, to 32 digits, plus those that Lorentz
/// violation adds. The slow rate has no free part.
pub(super) fn turning<S: Real>(
    spheroid: &RigidSpheroid<S>,
    initial: &BodyState<S>,
    added: &OfRotations<S>,
) -> OfRotations<DoubleDouble> {
    let [inertia_xx, inertia_zz] = [spheroid.inertia_xx, spheroid.inertia_zz].map(S::re);
    let [n, momentum] = [&initial.axis, &initial.momentum].map(|v| real_part(v).into());
    let about_momentum = DoubleDouble::dot(&momentum, &momentum).sqrt() / inertia_xx;
    let difference = DoubleDouble::sum(inertia_xx, -inertia_zz);
    let about_axis = difference * DoubleDouble::dot(&momentum, &n) / DoubleDouble::product(inertia_xx, inertia_zz);
    let free = OfRotations { slow: DoubleDouble::default(), about_momentum, about_axis };
    free.with(added, |free, added| (free + added.re().into()) / DoubleDouble::TAU)
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
