//! Angles modulo whole turns.
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

/// The multiple of a whole turn (rad) nearest to an angle.
pub(crate) fn whole_turns(angle: f64) -> f64 {
    (angle / TAU).round() * TAU
}

/// The angle minus the nearest multiple of a whole turn: from -pi to pi, up to 2.2e-16 of the angle, the rounding of that multiple. Beyond 1e16 rad
/// the result has no correct digit.
pub fn wrapped(angle: f64) -> f64 {
    angle - whole_turns(angle)
}

/// Angle about a unit vector from one vector to another, from -pi to pi. At least one of the two is perpendicular to the unit
/// vector.
pub(crate) fn about<S: Real>(axis: &Vector3<S>, from: &Vector3<S>, to: &Vector3<S>) -> S {
    axis.dot(&from.cross(to)).atan2(from.dot(to))
}

/// Angle between two vectors, in [0, pi]. Uses the sine as well, because the cosine of a small angle loses its digits.
pub(crate) fn between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// Adding this to a double below a quarter of it rounds the double to an integer, whose last bits are then those of the sum.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Sines and cosines of two fractions of a turn, at most one in size. The nearest quarter turn is subtracted exactly, and the remainder, at most an
/// eighth, has a short Taylor series. Each is accurate to an ulp of one.
#[inline(always)]
pub(crate) fn sines_of_turns<F: FourLanes>(four: F, turns: [f64; 2]) -> [(f64, f64); 2] {
    let (first, second) = (QuarterTurns::nearest(turns[0]), QuarterTurns::nearest(turns[1]));
    let (a, b) = (first.rest, second.rest);
    let (zero, one) = (four.all(0.0), four.all(1.0));
    let x = four.load(&[a, a, b, b]);
    let square = four.multiply_add(x, x, zero);
    // 2 3, 4 5, ... and 1 2, 3 4, ...: the truncation error is below (pi / 4)^18 / 18! = 2e-18.
    let divisors = [
        [272.0, 240.0],
        [210.0, 182.0],
        [156.0, 132.0],
        [110.0, 90.0],
        [72.0, 56.0],
        [42.0, 30.0],
        [20.0, 12.0],
        [6.0, 2.0],
    ];
    let series = divisors.into_iter().fold(one, |sum, [of_sin, of_cos]: [f64; 2]| {
        let (of_sin, of_cos) = (-1.0 / of_sin, -1.0 / of_cos);
        let next = four.multiply_add(square, four.load(&[of_sin, of_cos, of_sin, of_cos]), zero);
        four.multiply_add(sum, next, one)
    });
    let [sin_a, cos_a, sin_b, cos_b] = four.store(series);
    [first.added(a * sin_a, cos_a), second.added(b * sin_b, cos_b)]
}

/// The number of quarter turns in an angle, and the remainder (rad).
struct QuarterTurns {
    /// The last two bits are those of the number of quarter turns.
    bits: u64,
    rest: f64,
}

impl QuarterTurns {
    #[inline(always)]
    fn nearest(turns: f64) -> Self {
        let sum = 4.0 * turns + WHOLE;
        Self { bits: sum.to_bits(), rest: TAU * (turns - 0.25 * (sum - WHOLE)) }
    }

    /// Sine and cosine of the whole angle from those of the remainder, without branches, which random phases would
    /// mispredict.
    #[inline(always)]
    fn added(&self, sin: f64, cos: f64) -> (f64, f64) {
        let swap = (self.bits & 1).wrapping_neg();
        let either = |a: f64, b: f64| a.to_bits() & !swap | b.to_bits() & swap;
        let signed = |bits: u64, sign: u64| f64::from_bits(bits ^ (sign & 2) << 62);
        (signed(either(sin, cos), self.bits), signed(either(cos, sin), self.bits.wrapping_add(1)))
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    /// Angles keep their digits also if they are small or near a half turn, for vectors of any length.
    #[test]
    fn angles_between_vectors_keep_their_digits() {
        for angle in [0.0_f64, 1e-150, 1e-12, 1e-8, 0.3, 2.0] {
            let (a, b) = (Vector3::new(0.0, 3.0, 0.0), Vector3::new(0.0, angle.cos(), angle.sin()) * 0.7);
            assert!((between(&a, &b) - angle).abs() <= 4.0 * f64::EPSILON * angle, "{angle}");
            assert!((between(&-a, &b) - (PI - angle)).abs() < 1e-15, "{angle}");
        }
    }

    #[test]
    fn an_angle_is_half_a_turn_from_zero_at_most() {
        for (angle, expected) in [(0.3, 0.3), (PI, -PI), (-PI, PI), (4.0, 4.0 - TAU), (-20.0, -20.0 + 3.0 * TAU)] {
            assert_eq!(wrapped(angle), expected);
        }
        // Half a rounding of the number of turns, which may take it to the next one, and half a rounding of the multiple.
        for k in 0..1000 {
            for size in [1e3, 1e8, -6.1e13, -4.95e17] {
                let angle = size * (1.0 + 1e-3 * f64::from(k));
                assert!(wrapped(angle).abs() <= PI + f64::EPSILON * angle.abs(), "{angle:e}: {}", wrapped(angle));
            }
        }
    }

    #[test]
    fn sines_of_turns_are_those_of_angles() {
        use crate::numerics::arithmetic::plain;
        for k in -1000..=1000 {
            let turns = f64::from(k) / 1000.0;
            let [(sin, cos), other] = sines_of_turns(plain(), [turns, -turns]);
            assert_eq!(other, (-sin, cos));
            let (expected_sin, expected_cos) = (TAU * turns).sin_cos();
            // The expected values include the rounding of the angle itself.
            assert!((sin - expected_sin).abs() < 1e-15 && (cos - expected_cos).abs() < 1e-15, "{turns}: {sin} {cos}");
        }
        for (quarters, expected) in [(0.0, (0.0, 1.0)), (1.0, (1.0, 0.0)), (2.0, (0.0, -1.0)), (-1.0, (-1.0, 0.0))] {
            let [found, _] = sines_of_turns(plain(), [quarters / 4.0, 0.0]);
            assert_eq!(found, expected, "{quarters}");
        }
    }
}
