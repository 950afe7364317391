//! Numbers of twice the precision of `f64`, about 32 digits, as a scalar of the model.

use core::ops::{Add, Div, Mul, Neg, Sub};

use twofold::scalar::{Real, Scalar};
use xprec::Df64;

use crate::operators::complete_operators;

/// An unevaluated sum of two `f64` (crate `xprec`), so that every kernel of the model runs with about 32 digits.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble(pub Df64);

impl DoubleDouble {
    /// The number rounded to `f64`.
    pub fn rounded(self) -> f64 {
        self.0.hi()
    }
}

macro_rules! operation {
    ($trait:ident, $method:ident) => {
        impl $trait for DoubleDouble {
            type Output = Self;

            #[inline]
            fn $method(self, rhs: Self) -> Self {
                Self(self.0.$method(rhs.0))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

complete_operators!(DoubleDouble);

impl Scalar for DoubleDouble {
    fn from_f64(value: f64) -> Self {
        Self(Df64::new(value))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Self(sin), Self(cos))
    }
}

impl Real for DoubleDouble {
    fn re(self) -> f64 {
        self.rounded()
    }

    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    fn exp(self) -> Self {
        Self(self.0.exp())
    }

    fn ln(self) -> Self {
        Self(self.0.ln())
    }

    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0))
    }
}

#[cfg(test)]
mod tests {
    use num_traits::Zero;

    use super::*;

    #[test]
    fn thirty_digits_are_kept() {
        let number = DoubleDouble::from_f64;
        let third = number(1.0) / 3.0;
        assert!(((third * 3.0 - number(1.0)).rounded()).abs() < 1e-31);
        assert!(((number(2.0).sqrt() * number(2.0).sqrt() - number(2.0)).rounded()).abs() < 1e-31);
        let (sin, cos) = number(0.7).sin_cos();
        assert!((sin * sin + cos * cos - number(1.0)).rounded().abs() < 1e-31);
        assert!((sin.atan2(cos) - number(0.7)).rounded().abs() < 1e-31);
        assert!((number(0.7).exp().ln() - number(0.7)).rounded().abs() < 1e-31);
        assert_eq!((number(-0.7).abs().re(), number(1.0).is_zero()), (0.7, false));
    }
}
