//! The paper's equations, derived again from first principles with automatic derivatives.
//!
//! Each derivation is written once and runs on three kinds of numbers: a prime field (exact), `f64` with the dual numbers
//! of `num_dual`, and [`Conditioned`] (bounds on rounding errors).

use nalgebra::SMatrix;
use num_dual::HyperDual64;

use crate::dual::Dual;
use crate::prelude::*;

pub mod body_motion;
pub mod euler_lagrange;
pub mod first_order;
pub mod spheroid_motion;
pub mod virtual_rotation;

/// A number with two kinds of infinitesimals added.
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

    /// A constant.
    fn constant(x: Self) -> Self::Second {
        Self::second(x, Self::zero(), Self::zero(), Self::zero())
    }

    /// A constant.
    fn fixed(x: Self) -> Self::First {
        Self::first(x, Self::zero())
    }
}

/// Implements both kinds of infinitesimals for a number type: their types, the constructor of the second, and its two parts.
macro_rules! differentiable {
    ($type:ty, $first:ty, $second:ty, $make:expr, $($one:ident).+, $($both:ident).+) => {
        impl Differentiable for $type {
            type First = $first;
            type Second = $second;

            fn first(x: Self, x1: Self) -> Self::First {
                <$first>::new(x, x1)
            }

            fn value(x: Self::First) -> Self {
                x.re
            }

            fn derivative(x: Self::First) -> Self {
                x.eps
            }

            fn second(x: Self, x1: Self, x2: Self, x12: Self) -> Self::Second {
                $make(x, x1, x2, x12)
            }

            fn derivative_1(x: Self::Second) -> Self {
                x.$($one).+
            }

            fn derivative_12(x: Self::Second) -> Self {
                x.$($both).+
            }
        }
    };
}

fn nested<F: Scalar>(x: F, x1: F, x2: F, x12: F) -> Dual<Dual<F>> {
    Dual::new(Dual::new(x, x1), Dual::new(x2, x12))
}

differentiable!(f64, Dual64, HyperDual64, HyperDual64::new, eps1, eps1eps2);
// The exact field and the conditioned numbers use the duals of `crate::dual`.
differentiable!(Fp, Dual<Fp>, Dual<Dual<Fp>>, nested, re.eps, eps.eps);
differentiable!(Conditioned, Dual<Conditioned>, Dual<Dual<Conditioned>>, nested, re.eps, eps.eps);

/// Angles that change at given rates, to first order in time.
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

/// Numbers, vectors and matrices as lists of their components.
pub trait Components<F> {
    /// Adds the components to a list.
    fn append(&self, list: &mut Vec<F>);
}

impl<F: Differentiable> Components<F> for F {
    fn append(&self, list: &mut Vec<F>) {
        list.push(*self);
    }
}

impl<F: Differentiable, const R: usize, const C: usize> Components<F> for SMatrix<F, R, C> {
    fn append(&self, list: &mut Vec<F>) {
        list.extend(self);
    }
}

impl<F: Differentiable, T: Components<F>, const N: usize> Components<F> for [T; N] {
    fn append(&self, list: &mut Vec<F>) {
        self.iter().for_each(|part| part.append(list));
    }
}

impl<F: Differentiable> Components<F> for Vec<F> {
    fn append(&self, list: &mut Vec<F>) {
        list.extend(self);
    }
}

impl<F: Differentiable> Components<F> for (F, F) {
    fn append(&self, list: &mut Vec<F>) {
        list.extend([self.0, self.1]);
    }
}

/// The components of all parts, one after the other.
macro_rules! components {
    ($($part:expr),+ $(,)?) => {{
        let mut list = Vec::new();
        $($crate::derivation::Components::append(&$part, &mut list);)+
        list
    }};
}
pub(crate) use components;
