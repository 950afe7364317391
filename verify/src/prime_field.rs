//! Exact arithmetic: the field of integers modulo the prime `2^61 - 1`.
//!
//! An identity between rational functions that holds at a random point of a large field holds everywhere, except with a
//! probability of about its degree over the size of the field. There is no rounding, and thus no tolerance.

use core::fmt;

use crate::prelude::*;
use num_traits::One;

/// The prime `2^61 - 1`. It is 3 modulo 4, so -1 is not a square.
pub const PRIME: u64 = (1 << 61) - 1;

/// An element of the field of integers modulo [`PRIME`].
///
/// An angle is coded by `t = tan(angle / 2)`, a rational point of the circle:
/// `(sin, cos) = (2 t, 1 - t^2) / (1 + t^2)`. Every `t` is an angle, since `1 + t^2` has no zero. Sums of angles are not
/// sums of their codes: a kernel that runs here uses an angle only through its sine and cosine.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Fp(u64);

impl Fp {
    /// The residue class of `value`.
    pub fn new(value: u64) -> Self {
        Self(value % PRIME)
    }

    /// The least non-negative member of the residue class.
    pub fn value(self) -> u64 {
        self.0
    }

    /// The power `self^exponent`, with `0^0 = 1`.
    pub fn pow(self, mut exponent: u64) -> Self {
        let (mut square, mut product) = (self, Self::one());
        while exponent > 0 {
            if exponent & 1 == 1 {
                product *= square;
            }
            square *= square;
            exponent >>= 1;
        }
        product
    }

    /// The inverse `self^(p - 2)`.
    ///
    /// # Panics
    /// For zero.
    pub fn inverse(self) -> Self {
        assert!(!self.is_zero(), "division by zero in the prime field");
        self.pow(PRIME - 2)
    }
}

impl fmt::Debug for Fp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

field_operators! {
    Fp;
    a + b = Self::new(a.0 + b.0);
    -a = Self::new(PRIME - a.0);
    a * b = {
        let product = u128::from(a.0) * u128::from(b.0);
        // 2^61 = 1: the high part is added to the low one.
        Self::new((product & u128::from(PRIME)) as u64 + (product >> 61) as u64)
    };
    a / b = core::ops::Mul::mul(a, b.inverse());
}

impl Scalar for Fp {
    /// # Panics
    /// Unless `value` is `m / 1024` with an integer `m` below `2^50`: any other constant would be rounded.
    fn from_f64(value: f64) -> Self {
        let numerator = value * 1024.0;
        assert!(
            numerator == numerator.trunc() && numerator.abs() < (1_u64 << 50) as f64,
            "{value} is not a small dyadic rational: it has no exact meaning in the prime field"
        );
        // 2^61 = 1, so that 1 / 2^10 = 2^51.
        let magnitude = Self::new(numerator.abs() as u64) * Self(1 << 51);
        if numerator < 0.0 { -magnitude } else { magnitude }
    }

    fn sin_cos(self) -> (Self, Self) {
        let square = self * self;
        let over = (Self::one() + square).inverse();
        ((self + self) * over, (Self::one() - square) * over)
    }
}
