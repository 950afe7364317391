//! Dual numbers over any [`Scalar`], exact where it is exact.
//!
//! The dual numbers of `num_dual` are built on floating-point primitives. These carry a prime field, and, nested,
//! derivatives of any order.

use core::ops::{Add, Div, Mul, Neg, Sub};

use twofold::{Real, Scalar};

use crate::operators::complete_operators;

/// `re + eps epsilon` with `epsilon^2 = 0`: a value and its derivative. Equality is that of both parts.
///
/// As an angle, `re` is whatever the field under it codes an angle by, and `eps` the derivative of the angle itself.
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

impl<F: Scalar> Add for Dual<F> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self::new(self.re + rhs.re, self.eps + rhs.eps)
    }
}

impl<F: Scalar> Sub for Dual<F> {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        Self::new(self.re - rhs.re, self.eps - rhs.eps)
    }
}

impl<F: Scalar> Neg for Dual<F> {
    type Output = Self;

    fn neg(self) -> Self {
        Self::new(-self.re, -self.eps)
    }
}

impl<F: Scalar> Mul for Dual<F> {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        Self::new(self.re * rhs.re, self.re * rhs.eps + self.eps * rhs.re)
    }
}

impl<F: Scalar> Div for Dual<F> {
    type Output = Self;

    fn div(self, rhs: Self) -> Self {
        let over = F::one() / rhs.re;
        // Without the square of `over`, which overflows where the quotient does not.
        Self::new(self.re / rhs.re, (self.eps - self.re * over * rhs.eps) * over)
    }
}

complete_operators!(Dual<F>, F);

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
