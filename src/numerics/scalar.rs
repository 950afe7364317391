//! The number types that the equations run on.
//!
//! There are two bounds, so that a signature states what an equation needs:
//!
//! * [`Scalar`] — field operations and the sine and cosine of an angle. Enough for every equation of motion, and for
//!   exact arithmetic: a prime field implements it with angles coded as rational points of the circle.
//! * [`Real`] — an ordered field with roots and inverse functions, for stars, closed solutions and propagation.
//!
//! Both hold for `f64` and for every dual number of [`num_dual`], by one blanket implementation each. Another crate can
//! implement [`Scalar`] for a type of its own.
//!
//! ```
//! use num_dual::{Dual64, first_derivative};
//! use twofold::numerics::scalar::Scalar;
//!
//! fn tilt<S: Scalar>(beta: S) -> S {
//!     let (sin, cos) = beta.sin_cos();
//!     sin * cos * 2.0
//! }
//! let (value, slope) = first_derivative(tilt::<Dual64>, 0.7);
//! assert_eq!(value, tilt(0.7));
//! assert!((slope - 2.0 * (2.0 * 0.7_f64).cos()).abs() < 1e-15);
//! ```
//!
//! # Example
//!
//! ```
//! use nalgebra::Vector3;
//! use num_dual::Dual64;
//! use twofold::numerics::scalar::length;
//!
//! // The length of (3, 4 + x, 0) and its derivative at x = 0.
//! let mut v = Vector3::new(3.0, 4.0, 0.0).map(Dual64::from_re);
//! v.y.eps = 1.0;
//! let found = length(&v);
//! assert_eq!((found.re, found.eps), (5.0, 0.8));
//! ```

use core::any::Any;
use core::ops::{Div, Mul, Neg};

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Vector3};
use num_dual::DualNum;
use num_traits::{One, Zero};

use crate::numerics::double_double::DoubleDouble;

/// A field with angles, as required by the equations of motion.
///
/// Constants enter as `f64` on the right of a product (`x * 2.0`) or through [`from_f64`](Scalar::from_f64). An exact
/// field accepts those that are small dyadic rationals, which is all that a `Scalar` kernel uses.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Zero
    + One
    + Neg<Output = Self>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The constant `value`, with zero derivatives.
    fn from_f64(value: f64) -> Self;

    /// Sine and cosine of the angle `self` (rad).
    fn sin_cos(self) -> (Self, Self);
}

/// An ordered field with roots and inverse functions, as required by stars, closed solutions and propagation.
///
/// Order and branches depend on the real part only; derivatives never choose a branch.
pub trait Real: Scalar {
    /// Whether numbers carry derivatives.
    const HAS_DERIVATIVES: bool;

    /// The real part, without derivatives.
    fn re(self) -> f64;

    /// Square root. The derivative at zero does not exist and comes out as NaN.
    fn sqrt(self) -> Self;

    /// Exponential.
    fn exp(self) -> Self;

    /// Natural logarithm.
    fn ln(self) -> Self;

    /// Angle (rad) of the point with ordinate `self` and abscissa `x`, from -pi to pi. Where the ordinate is a negative
    /// zero, the result is -pi in place of pi.
    fn atan2(self, x: Self) -> Self;

    /// `sum a_i b_i`, whose terms may cancel. For doubles, and for the real parts of dual numbers, the result is as if it
    /// were rounded once.
    fn inner_product(a: &Vector3<Self>, b: &Vector3<Self>) -> Self {
        a.dot(b)
    }

    /// Absolute value, by the sign of the real part.
    fn abs(self) -> Self {
        if self.re() < 0.0 { -self } else { self }
    }
}

impl<T> Scalar for T
where
    T: DualNum<Primitive = f64> + Copy,
{
    #[inline]
    fn from_f64(value: f64) -> Self {
        T::from(value)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        DualNum::sin_cos(&self)
    }
}

impl<T> Real for T
where
    T: DualNum<Primitive = f64> + Copy,
{
    const HAS_DERIVATIVES: bool = T::NDERIV > 0;

    #[inline]
    fn re(self) -> f64 {
        num_dual::DualStruct::re(&self)
    }

    #[inline]
    fn sqrt(self) -> Self {
        DualNum::sqrt(&self)
    }

    #[inline]
    fn exp(self) -> Self {
        DualNum::exp(&self)
    }

    #[inline]
    fn ln(self) -> Self {
        DualNum::ln(&self)
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        if T::NDERIV == 0 {
            return DualNum::atan2(&self, x);
        }
        // num-dual 0.15 divides by `x`, which loses the higher derivatives where `x` is small. Rotated by the angle itself
        // the point lies on the abscissa, and the quotient is regular everywhere.
        let angle = Real::re(self).atan2(Real::re(x));
        let (sin, cos) = angle.sin_cos();
        let across = self * cos - x * sin;
        let along = x * cos + self * sin;
        T::from(angle) + DualNum::atan(&(across / along))
    }

    #[inline]
    fn inner_product(a: &Vector3<Self>, b: &Vector3<Self>) -> Self {
        let rounded = a.dot(b);
        let exact = DoubleDouble::dot(&a.map(Real::re).into(), &b.map(Real::re).into());
        let lost = (exact + DoubleDouble::from(-Real::re(rounded))).high;
        // What is not finite stays as it is.
        if lost.is_finite() { rounded + T::from(lost) } else { rounded }
    }
}

/// Converts a value to another type if both are the same concrete type, as for the scalar `f64`; `None` otherwise.
pub(crate) fn cast<T: 'static, U: 'static>(value: T) -> Option<U> {
    let mut value = Some(value);
    (&mut value as &mut dyn Any).downcast_mut::<Option<U>>()?.take()
}

/// As [`cast`], for a reference.
#[inline(always)]
pub(crate) fn cast_ref<T: 'static, U: 'static>(value: &T) -> Option<&U> {
    (value as &dyn Any).downcast_ref()
}

/// Euclidean length of `v`. The derivative at the zero vector does not exist and comes out as NaN.
pub fn length<S: Real>(v: &Vector3<S>) -> S {
    v.dot(v).sqrt()
}

/// Real parts of a vector.
pub(crate) fn real_part<S: Real>(v: &Vector3<S>) -> Vector3<f64> {
    v.map(S::re)
}
