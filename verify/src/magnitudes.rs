//! Numbers that carry the sum of the magnitudes of the terms from which they were computed.

use crate::prelude::*;

/// A number with the sum of the magnitudes of all its terms, including those that cancel.
///
/// A kernel on this type gives a bound on its rounding error: `magnitude` times the unit roundoff, times the number of
/// roundings of a single term. A residual that should be zero is measured in this unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditioned {
    /// The number.
    pub value: f64,
    /// Sum of the magnitudes of its terms, at least `|value|`.
    pub magnitude: f64,
}

impl Conditioned {
    /// A number that is not a result of arithmetic.
    pub fn new(value: f64) -> Self {
        Self { value, magnitude: value.abs() }
    }
}

field_operators! {
    Conditioned;
    a + b = Self { value: a.value + b.value, magnitude: a.magnitude + b.magnitude };
    -a = Self { value: -a.value, magnitude: a.magnitude };
    a * b = Self { value: a.value * b.value, magnitude: a.magnitude * b.magnitude };
    // d(a/b) = da/b - a db/b^2, with |b| at most its magnitude.
    a / b = Self { value: a.value / b.value, magnitude: a.magnitude * b.magnitude / (b.value * b.value) };
}

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
