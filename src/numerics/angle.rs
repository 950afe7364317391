//! Angles up to whole turns.
//!
//! ```
//! use core::f64::consts::TAU;
//! use twofold::numerics::angle::wrapped;
//!
//! assert!((wrapped(3.0 * TAU + 0.3) - 0.3).abs() < 1e-14);
//! ```

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::numerics::four_lanes::FourLanes;
use crate::numerics::scalar::Real;

/// The whole turns (rad) nearest to an angle.
pub(crate) fn whole_turns(angle: f64) -> f64 {
    (angle / TAU).round() * TAU
}

/// The angle less its nearest whole turns: from -pi to pi.
pub fn wrapped(angle: f64) -> f64 {
    angle - whole_turns(angle)
}

/// Angle about a unit vector from a vector across it to another one, in (-pi, pi].
pub(crate) fn about<S: Real>(axis: &Vector3<S>, from: &Vector3<S>, to: &Vector3<S>) -> S {
    axis.dot(&from.cross(to)).atan2(from.dot(to))
}

/// Sine and cosine of a part of a turn, at most one in size: the nearest quarter turn is taken off exactly, and the rest, at most an eighth, has short Taylor series.
/// Each to an ulp of one.
#[inline(always)]
pub(crate) fn sin_cos_of_turns<F: FourLanes>(turns: f64) -> (f64, f64) {
    let quarters = (4.0 * turns).round_ties_even();
    let x = core::f64::consts::TAU * (turns - 0.25 * quarters);
    let square = x * x;
    let horner = |divisors: [f64; 8]| {
        divisors.into_iter().rev().fold(1.0, |sum: f64, divisor| {
            let next = square * (-1.0 / divisor);
            if F::FUSED { sum.mul_add(next, 1.0) } else { sum * next + 1.0 }
        })
    };
    // 2 3, 4 5, ... and 1 2, 3 4, ...: what is left out is below (pi / 4)^18 / 18! = 2e-18.
    let sin = x * horner([6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0]);
    let cos = horner([2.0, 12.0, 30.0, 56.0, 90.0, 132.0, 182.0, 240.0]);
    // Without branches, which random phases would mispredict.
    let quarters = quarters as i64 as u64;
    let swap = (quarters & 1).wrapping_neg();
    let either = |a: f64, b: f64| a.to_bits() & !swap | b.to_bits() & swap;
    let signed = |bits: u64, sign: u64| f64::from_bits(bits ^ (sign & 2) << 62);
    (signed(either(sin, cos), quarters), signed(either(cos, sin), quarters.wrapping_add(1)))
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    #[test]
    fn an_angle_is_half_a_turn_from_zero_at_most() {
        for (angle, expected) in [(0.3, 0.3), (PI, -PI), (-PI, PI), (4.0, 4.0 - TAU), (-20.0, -20.0 + 3.0 * TAU)] {
            assert_eq!(wrapped(angle), expected);
        }
    }

    #[test]
    fn sines_of_turns_are_those_of_angles() {
        use crate::numerics::arithmetic::Componentwise;
        for k in -1000..=1000 {
            let turns = f64::from(k) / 1000.0;
            let (sin, cos) = sin_cos_of_turns::<Componentwise<f64>>(turns);
            let (expected_sin, expected_cos) = (TAU * turns).sin_cos();
            // The rounding of the angle itself is in what is expected.
            assert!((sin - expected_sin).abs() < 1e-15 && (cos - expected_cos).abs() < 1e-15, "{turns}: {sin} {cos}");
        }
        for (quarters, expected) in [(0.0, (0.0, 1.0)), (1.0, (1.0, 0.0)), (2.0, (0.0, -1.0)), (-1.0, (-1.0, 0.0))] {
            let (sin, cos) = sin_cos_of_turns::<Componentwise<f64>>(quarters / 4.0);
            assert!(sin == expected.0 && cos == expected.1, "{quarters}: {sin} {cos}");
        }
    }
}
