//! What the paper's equations say, derived again from first principles with automatic derivatives.
//!
//! Each derivation is written once and runs on three kinds of numbers: a prime field (exact), `f64` with the dual numbers
//! of `num_dual`, and [`Conditioned`] (how large rounding may be).

use num_dual::HyperDual64;

use crate::dual::Dual;
use crate::prelude::*;

pub mod body_motion;
pub mod euler_lagrange;
pub mod first_order;
pub mod spheroid_motion;
pub mod virtual_rotation;

/// A number with two kinds of infinitesimals over it.
pub trait Differentiable: Scalar {
    /// `x + x1 e` with `e^2 = 0`.
    type First: Scalar;

    /// `x + x1 e1 + x2 e2 + x12 e1 e2` with `e1^2 = e2^2 = 0`.
    type Second: Scalar;

    /// `x + x1 e`.
    fn first(x: Self, x1: Self) -> Self::First;

    /// The part without `e`.
    fn value(x: Self::First) -> Self;

    /// The coefficient of `e`.
    fn derivative(x: Self::First) -> Self;

    /// `x + x1 e1 + x2 e2 + x12 e1 e2`.
    fn second(x: Self, x1: Self, x2: Self, x12: Self) -> Self::Second;

    /// The coefficient of `e1`.
    fn derivative_1(x: Self::Second) -> Self;

    /// The coefficient of `e1 e2`.
    fn derivative_12(x: Self::Second) -> Self;

    /// A constant, without derivatives.
    fn constant(x: Self) -> Self::Second {
        Self::second(x, Self::zero(), Self::zero(), Self::zero())
    }

    /// A constant, without derivatives.
    fn fixed(x: Self) -> Self::First {
        Self::first(x, Self::zero())
    }
}

impl Differentiable for f64 {
    type First = Dual64;
    type Second = HyperDual64;

    fn first(x: f64, x1: f64) -> Dual64 {
        Dual64::new(x, x1)
    }

    fn value(x: Dual64) -> f64 {
        x.re
    }

    fn derivative(x: Dual64) -> f64 {
        x.eps
    }

    fn second(x: f64, x1: f64, x2: f64, x12: f64) -> HyperDual64 {
        HyperDual64::new(x, x1, x2, x12)
    }

    fn derivative_1(x: HyperDual64) -> f64 {
        x.eps1
    }

    fn derivative_12(x: HyperDual64) -> f64 {
        x.eps1eps2
    }
}

/// The exact field and the measure of conditioning carry the duals of [`crate::dual`].
macro_rules! differentiable_by_nesting {
    ($type:ty) => {
        impl Differentiable for $type {
            type First = Dual<$type>;
            type Second = Dual<Dual<$type>>;

            fn first(x: Self, x1: Self) -> Self::First {
                Dual::new(x, x1)
            }

            fn value(x: Self::First) -> Self {
                x.re
            }

            fn derivative(x: Self::First) -> Self {
                x.eps
            }

            fn second(x: Self, x1: Self, x2: Self, x12: Self) -> Self::Second {
                Dual::new(Dual::new(x, x1), Dual::new(x2, x12))
            }

            fn derivative_1(x: Self::Second) -> Self {
                x.re.eps
            }

            fn derivative_12(x: Self::Second) -> Self {
                x.eps.eps
            }
        }
    };
}

differentiable_by_nesting!(Fp);
differentiable_by_nesting!(Conditioned);

/// Angles that move with given rates, to first order in time.
pub fn moving_angles<F: Differentiable>(q: &EulerAngles<F>, v: &EulerRates<F>) -> EulerAngles<F::First> {
    EulerAngles { alpha: F::first(q.alpha, v.alpha), beta: F::first(q.beta, v.beta), gamma: F::first(q.gamma, v.gamma) }
}

/// Rates that change with given accelerations, to first order in time.
pub fn moving_rates<F: Differentiable>(v: &EulerRates<F>, a: &EulerRates<F>) -> EulerRates<F::First> {
    EulerRates { alpha: F::first(v.alpha, a.alpha), beta: F::first(v.beta, a.beta), gamma: F::first(v.gamma, a.gamma) }
}

/// The angles `q + v t + a t^2 / 2` to second order in time: `t = e1 + e2`, so that the coefficient of `e1 e2` of a function
/// of them is its second time derivative.
pub fn accelerated_angles<F: Differentiable>(
    q: &EulerAngles<F>,
    v: &EulerRates<F>,
    a: &EulerRates<F>,
) -> EulerAngles<F::Second> {
    EulerAngles {
        alpha: F::second(q.alpha, v.alpha, v.alpha, a.alpha),
        beta: F::second(q.beta, v.beta, v.beta, a.beta),
        gamma: F::second(q.gamma, v.gamma, v.gamma, a.gamma),
    }
}
