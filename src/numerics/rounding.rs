//! Error-free sums and products: what a rounded operation lost, as a number.
//!
//! Both are identities of real numbers whose second part is zero, so that they act on duals as well: what is lost carries no
//! derivative beyond rounding.

use core::ops::{Add, Sub};

use crate::numerics::scalar::Scalar;

/// Knuth's exact sum: `a + b = sum + lost`.
#[inline(always)]
pub(crate) fn two_sum<S: Copy + Add<Output = S> + Sub<Output = S>>(a: S, b: S) -> (S, S) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// Dekker's sum: exact where `|a| >= |b|`, as where `b` is a small change of `a`. Elsewhere what it loses is below the rounding of `b`.
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
