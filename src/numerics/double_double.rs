//! Sums of two doubles, of some 32 digits: for phases over many turns, and no more than those need.

use core::f64::consts::TAU;
use core::ops::{Add, Mul, Sub};

use crate::numerics::rounding::{quick_two_sum, two_product, two_sum};

/// `2 pi - TAU`.
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// `high + low`, with `|low|` at most half an ulp of `high`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct DoubleDouble {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl DoubleDouble {
    pub(crate) const TAU: Self = Self { high: TAU, low: TAU_LOW };

    /// The sum of two doubles in any order.
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// The product of two doubles.
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        Self { high, low }
    }

    /// `sum a_i b_i`, whose terms may cancel.
    pub(crate) fn dot(a: &[f64; 3], b: &[f64; 3]) -> Self {
        let products = [0, 1, 2].map(|i| Self::product(a[i], b[i]));
        products[0] + products[1] + products[2]
    }

    /// The quotient: two steps of long division.
    pub(crate) fn over(self, divisor: Self) -> Self {
        let first = self.high / divisor.high;
        let rest = self + divisor * Self::from(-first);
        let second = rest.high / divisor.high;
        let rest = rest + divisor * Self::from(-second);
        Self::sum(first, second) + Self::from(rest.high / divisor.high)
    }

    /// The square root of a number that is not negative: Newton's step from that of the high part.
    pub(crate) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::default();
        }
        let rest = self + Self::product(-root, root);
        Self::sum(root, rest.high / (root * 2.0))
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, lost) = two_sum(self.high, other.high);
        let (low, lost_low) = two_sum(self.low, other.low);
        let (high, lost) = quick_two_sum(high, lost + low);
        let (high, low) = quick_two_sum(high, lost + lost_low);
        Self { high, low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl From<[f64; 2]> for DoubleDouble {
    /// Of an unevaluated sum in any order.
    fn from([a, b]: [f64; 2]) -> Self {
        Self::sum(a, b)
    }
}

impl From<DoubleDouble> for [f64; 2] {
    fn from(DoubleDouble { high, low }: DoubleDouble) -> Self {
        [high, low]
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (product, lost) = two_product(self.high, other.high);
        let (high, low) = quick_two_sum(product, lost + (self.high * other.low + self.low * other.high));
        Self { high, low }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_quotients_have_thirty_digits() {
        let two = DoubleDouble::from(2.0);
        let root = two.sqrt();
        // sqrt 2 = 1.4142135623730950488016887242096980786
        assert_eq!(root.high, core::f64::consts::SQRT_2);
        let rest = root * root + DoubleDouble::from(-2.0);
        assert!(rest.high.abs() < 1e-31, "{rest:?}");
        let third = DoubleDouble::from(1.0).over(DoubleDouble::from(3.0));
        let rest = third * DoubleDouble::from(3.0) + DoubleDouble::from(-1.0);
        assert!(rest.high.abs() < 1e-31, "{rest:?}");
    }

    #[test]
    fn a_cancelling_product_keeps_what_is_left() {
        let found = DoubleDouble::dot(&[1e8 + 1.0, 1e8, 0.0], &[1e8 - 1.0, -1e8, 0.0]);
        assert_eq!((found.high, found.low), (-1.0, 0.0));
    }

    #[test]
    fn a_turn_has_thirty_digits() {
        // Machin: pi / 4 = 4 arctan(1/5) - arctan(1/239).
        let arctan = |n: f64| {
            let whole = |k: f64| DoubleDouble::from(k);
            let square = whole(1.0).over(whole(n * n));
            // Horner's rule, from terms below 1e-33 on.
            (0..24).rev().fold(DoubleDouble::default(), |sum, k| {
                let odd = f64::from(2 * k + 1);
                whole(1.0).over(whole(odd)) - square * sum
            }) * whole(1.0).over(whole(n))
        };
        let turn = (arctan(5.0) * 4.0.into() - arctan(239.0)) * 8.0.into();
        let off = turn - DoubleDouble::TAU;
        assert!(off.high.abs() < 1e-29, "{off:?}");
    }
}
