//! Dual numbers over any [`Scalar`], exact if it is exact.
//!
//! The dual numbers of `num_dual` are built on floating-point primitives. These also work over a prime field and, nested,
//! for derivatives of any order.

use crate::prelude::*;

/// `re + eps epsilon` with `epsilon^2 = 0`: a value and its derivative. Equality is that of both parts.
///
/// As an angle, `re` has the code of the underlying field for an angle, and `eps` is the derivative of the angle itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<F> {
    /// Value.
    pub re: F,
    /// Derivative.
    pub eps: F,
}

impl<F: Scalar> Dual<F> {
    /// A value and its derivative.
    pub fn new(re: F, eps: F) -> Self {
        Self { re, eps }
    }
}

field_operators! {
    Dual<F>, F;
    a + b = Self::new(a.re + b.re, a.eps + b.eps);
    -a = Self::new(-a.re, -a.eps);
    a * b = Self::new(a.re * b.re, a.re * b.eps + a.eps * b.re);
    a / b = {
        let over = F::one() / b.re;
        // The square of `over` is avoided: it can overflow where the quotient does not.
        Self::new(a.re / b.re, (a.eps - a.re * over * b.eps) * over)
    };
}

impl<F: Scalar> Scalar for Dual<F> {
    fn from_f64(value: f64) -> Self {
        Self::new(F::from_f64(value), F::zero())
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        (Self::new(sin, cos * self.eps), Self::new(cos, -(sin * self.eps)))
    }
}

impl<F: Real> Real for Dual<F> {
    const HAS_DERIVATIVES: bool = true;

    fn re(self) -> f64 {
        self.re.re()
    }

    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        Self::new(root, self.eps / (root * 2.0))
    }

    fn exp(self) -> Self {
        let exp = self.re.exp();
        Self::new(exp, exp * self.eps)
    }

    fn ln(self) -> Self {
        Self::new(self.re.ln(), self.eps / self.re)
    }

    fn atan2(self, x: Self) -> Self {
        let square = self.re * self.re + x.re * x.re;
        Self::new(self.re.atan2(x.re), (x.re * self.eps - self.re * x.eps) / square)
    }
}
