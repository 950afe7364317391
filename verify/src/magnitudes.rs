//! Numbers that carry the sum of the magnitudes of the terms they were computed from.

use core::ops::{Add, Div, Mul, Neg, Sub};

use twofold::Scalar;

use crate::operators::complete_operators;

/// A number with the sum of the magnitudes of all terms in it, cancelled ones included.
///
/// Run on this type, a kernel says how large its rounding error may be: `magnitude` times the unit roundoff, times the
/// number of roundings that a single term goes through. The measure of a residual that should be zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditioned {
    /// The number.
    pub value: f64,
    /// Sum of the magnitudes of its terms, at least `|value|`.
    pub magnitude: f64,
}

impl Conditioned {
    /// A number that was not computed.
    pub fn new(value: f64) -> Self {
        Self { value, magnitude: value.abs() }
    }
}

impl Add for Conditioned {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { value: self.value + rhs.value, magnitude: self.magnitude + rhs.magnitude }
    }
}

impl Sub for Conditioned {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        self + -rhs
    }
}

impl Neg for Conditioned {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, magnitude: self.magnitude }
    }
}

impl Mul for Conditioned {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        Self { value: self.value * rhs.value, magnitude: self.magnitude * rhs.magnitude }
    }
}

impl Div for Conditioned {
    type Output = Self;

    fn div(self, rhs: Self) -> Self {
        // d(a/b) = da/b - a db/b^2, with |b| at most its magnitude.
        let magnitude = self.magnitude * rhs.magnitude / (rhs.value * rhs.value);
        Self { value: self.value / rhs.value, magnitude }
    }
}

complete_operators!(Conditioned);

impl Scalar for Conditioned {
    fn from_f64(value: f64) -> Self {
        Self::new(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (
            Self { value: sin, magnitude: sin.abs() + cos.abs() * self.magnitude },
            Self { value: cos, magnitude: cos.abs() + sin.abs() * self.magnitude },
        )
    }
}
