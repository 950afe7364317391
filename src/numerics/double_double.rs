//! Sums of two doubles with some 32 digits, for phases over many turns; only the operations that these require are here.

use core::f64::consts::TAU;

use num_traits::{One, Zero};

use crate::numerics::rounding::{add_pairs, multiply_pairs, two_product, two_sum};
use crate::numerics::scalar::{Real, Scalar};

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

    fn of_pair([high, low]: [f64; 2]) -> Self {
        Self { high, low }
    }

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

    /// The square root of a non-negative number: one Newton step from the root of the high part.
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

impl From<[f64; 2]> for DoubleDouble {
    /// From an unevaluated sum in any order.
    fn from([a, b]: [f64; 2]) -> Self {
        Self::sum(a, b)
    }
}

impl From<DoubleDouble> for [f64; 2] {
    fn from(DoubleDouble { high, low }: DoubleDouble) -> Self {
        [high, low]
    }
}

crate::field_operators! {
    DoubleDouble;
    a + b = Self::of_pair(add_pairs(a.into(), b.into()));
    -a = Self { high: -a.high, low: -a.low };
    a * b = Self::of_pair(multiply_pairs(a.into(), b.into(), two_product(a.high, b.high)));
    a / b = {
        // By long division: two digits and a correction.
        let first = a.high / b.high;
        let rest = a + b * Self::from(-first);
        let second = rest.high / b.high;
        let rest = rest + b * Self::from(-second);
        Self::sum(first, second) + Self::from(rest.high / b.high)
    };
}

/// Halvings of an argument before its series, and terms of the series: `(2 pi / 2^8)^20 / 20! = 1e-50`.
const HALVINGS: i32 = 8;
const TERMS: u32 = 20;

impl Scalar for DoubleDouble {
    fn from_f64(value: f64) -> Self {
        Self::from(value)
    }

    /// Accurate to some 30 digits of a turn. A series for the halved angle, then `sin 2x = 2 sin x cos x` and
    /// `1 - cos 2x = 2 sin^2 x`.
    fn sin_cos(self) -> (Self, Self) {
        let turns = (self.high / TAU).round();
        let small = (self - Self::TAU * turns) * 0.5_f64.powi(HALVINGS);
        let square = small * small;
        let (mut sin, mut versine) = (Self::zero(), Self::zero());
        for k in (1..TERMS / 2).rev() {
            let k = f64::from(2 * k);
            sin = (Self::one() - sin) * square / (k * (k + 1.0));
            versine = (Self::one() - versine) * square / (k * (k - 1.0));
        }
        sin = small * (Self::one() - sin);
        for _ in 0..HALVINGS {
            (sin, versine) = (sin * (Self::one() - versine) * 2.0, sin * sin * 2.0);
        }
        (sin, Self::one() - versine)
    }
}

impl Real for DoubleDouble {
    const HAS_DERIVATIVES: bool = false;

    fn re(self) -> f64 {
        self.high + self.low
    }

    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    /// By the series for `x / 2^8` and repeated squaring. A negative number uses a reciprocal, which keeps the digits that the sum of one and nearly
    /// minus one would lose.
    fn exp(self) -> Self {
        if self.high < -745.2 {
            return Self::zero();
        }
        if self.high < 0.0 {
            // The exponential of half the number, since products of a number above 1e300 overflow.
            let root = Self::one() / (self * -0.5).exp();
            return root * root;
        }
        let halvings = (self.high.log2().ceil() as i32 + HALVINGS).max(0);
        let small = self * 0.5_f64.powi(halvings);
        // exp x - 1, which is kept to all its digits.
        let mut less_one = Self::zero();
        for k in (1..=TERMS).rev() {
            less_one = (Self::one() + less_one) * small / f64::from(k);
        }
        for _ in 0..halvings {
            less_one = less_one * (less_one + Self::from(2.0));
        }
        less_one + Self::one()
    }

    /// One Newton step from the logarithm of the high part.
    fn ln(self) -> Self {
        let near = Self::from(self.high.ln());
        near + (self * (-near).exp() - Self::one())
    }

    /// One Newton step from the angle of the high parts.
    fn atan2(self, x: Self) -> Self {
        let near = Self::from(self.high.atan2(x.high));
        let (sin, cos) = near.sin_cos();
        let (along, across) = (x * cos + self * sin, self * cos - x * sin);
        if along.is_zero() { near } else { near + across / along }
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
        let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
        let rest = third * DoubleDouble::from(3.0) + DoubleDouble::from(-1.0);
        assert!(rest.high.abs() < 1e-31, "{rest:?}");
    }

    #[test]
    fn functions_have_thirty_digits() {
        let of = |value: f64| DoubleDouble::from(value);
        for x in [-3.1, -0.7, -1e-9, 1e-3, 0.6, 2.9] {
            let (sin, cos) = of(x).sin_cos();
            let unit = sin * sin + cos * cos - of(1.0);
            assert!(unit.high.abs() < 1e-30, "{x}: {unit:?}");
            let back = Real::atan2(sin * 1.7, cos * 1.7) - of(x);
            assert!(back.high.abs() < 1e-30, "{x}: {back:?}");
            let back = of(x).exp().ln() - of(x);
            assert!(back.high.abs() < 1e-29, "{x}: {back:?}");
            assert!(((sin.high - x.sin()) / x.sin()).abs() < 1e-15 && (cos.high - x.cos()).abs() < 1e-15, "{x}");
            assert!((of(x).exp().high / x.exp() - 1.0).abs() < 1e-15, "{x}");
        }
        // sin 1 = 0.84147098480789650665250232163029899962...
        let (sin, _) = of(1.0).sin_cos();
        let rest = sin - DoubleDouble::sum(0.841_470_984_807_896_5, 1.776_845_092_935_536e-18);
        assert!(rest.high.abs() < 1e-30, "{rest:?}");
        assert!((of(1.0).sin_cos().0 - of(1.0 + 4.0 * TAU).sin_cos().0).high.abs() < 1e-14);
    }

    /// The exponentials are compared with 32 digits from mpmath.
    #[test]
    fn exponentials_have_thirty_digits_of_themselves() {
        for (x, high, low) in [
            (21.3, 1780215034.761984, 6.438600956979643e-8),
            (-21.3, 5.6172989244173e-10, 4.387278612649127e-26),
            (312.9, 7.775769667760138e135, 5.56365938095169e119),
            (-312.9, 1.2860463243223311e-136, -2.600480229297865e-153),
        ] {
            let off = DoubleDouble::from(x).exp() / DoubleDouble::sum(high, low) - DoubleDouble::one();
            assert!(off.high.abs() < 2e-30, "{x}: {:e}", off.high);
        }
        // Down to the underflow to zero.
        for (x, expected) in [(-720.5, 1.2326102893e-313), (-746.0, 0.0), (-1e4, 0.0), (f64::NEG_INFINITY, 0.0)] {
            let found = DoubleDouble::from(x).exp();
            assert!((found.high - expected).abs() <= 1e-8 * expected && found.low.abs() < 1e-320, "{x}: {found:?}");
        }
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
            let square = whole(1.0) / whole(n * n);
            // Horner's rule, from terms below 1e-33 on.
            (0..24).rev().fold(DoubleDouble::default(), |sum, k| {
                let odd = f64::from(2 * k + 1);
                whole(1.0) / whole(odd) - square * sum
            }) * (whole(1.0) / whole(n))
        };
        let turn = (arctan(5.0) * 4.0 - arctan(239.0)) * 8.0;
        let off = turn - DoubleDouble::TAU;
        assert!(off.high.abs() < 1e-29, "{off:?}");
    }
}
