//! Error-free sums and products: the rounding error of an operation, as a number.
//!
//! They are identities of real numbers, for which the second part is zero. They therefore also work for duals: the
//! rounding error has no derivatives beyond rounding.
//!
//! Sums and products of double-double numbers are here too, for single numbers and for registers of them.

use core::ops::{Add, Mul, Sub};

use crate::numerics::scalar::Scalar;

/// Knuth's exact sum: `a + b = sum + lost`.
#[inline(always)]
pub(crate) fn two_sum<S: Copy + Add<Output = S> + Sub<Output = S>>(a: S, b: S) -> (S, S) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// Dekker's sum: exact where `|a| >= |b|`, for example if `b` is a small change of `a`. Elsewhere its error is below the rounding of
/// `b`.
#[inline(always)]
pub(crate) fn quick_two_sum<S: Copy + Add<Output = S> + Sub<Output = S>>(a: S, b: S) -> (S, S) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Dekker's exact product: `a b = product + lost`, for factors below 1e300.
pub(crate) fn two_product<S: Scalar>(a: S, b: S) -> (S, S) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let lost = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, lost)
}

/// Adds two double-double numbers, each `[high, low]`.
#[inline(always)]
pub(crate) fn add_pairs<S: Copy + Add<Output = S> + Sub<Output = S>>(a: [S; 2], b: [S; 2]) -> [S; 2] {
    let (high, lost) = two_sum(a[0], b[0]);
    let (low, lost_low) = two_sum(a[1], b[1]);
    let (high, lost) = quick_two_sum(high, lost + low);
    let (high, low) = quick_two_sum(high, lost + lost_low);
    [high, low]
}

/// Multiplies two double-double numbers, given the exact product of their high parts.
#[inline(always)]
pub(crate) fn multiply_pairs<S>(a: [S; 2], b: [S; 2], (product, lost): (S, S)) -> [S; 2]
where
    S: Copy + Add<Output = S> + Sub<Output = S> + Mul<Output = S>,
{
    let (high, low) = quick_two_sum(product, lost + (a[0] * b[1] + a[1] * b[0]));
    [high, low]
}

/// Veltkamp's splitting into two halves of 26 bits.
fn split<S: Scalar>(a: S) -> (S, S) {
    let scaled = a * 134_217_729.0;
    let high = scaled - (scaled - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost() {
        assert_eq!(two_sum(1.0, 1e-20), (1.0, 1e-20));
        assert_eq!(quick_two_sum(1.0, 1e-20), (1.0, 1e-20));
        let (product, lost) = two_product(1.0 + f64::EPSILON, 1.0 + f64::EPSILON);
        assert_eq!((product, lost), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
        let (product, lost) = two_product(0.1, 0.3);
        // 0.1 * 0.3 = 0.03 + 1.387...e-18 as binary fractions; the sum of both parts has 106 bits.
        assert_eq!(lost, 0.1f64.mul_add(0.3, -product));
    }
}
