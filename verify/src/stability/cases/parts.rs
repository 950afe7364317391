//! Vectors, tensors and bodies built from the numbers of a case.

pub(super) use crate::prelude::*;
pub(super) use crate::stability::Input::{self, Above, Below, Fixed, In, Log, Near, Signed};
pub(super) use crate::stability::oracle::{self, pi, ratio};
pub(super) use crate::stability::{Case, Function, Wide, functions, list};

pub(super) const TURN: Input = In(-3.1, 3.1);
pub(super) const RATE: Input = Signed(-3.0, 1.0);
pub(super) const COMPONENT: Input = In(-1.0, 1.0);
pub(super) const INERTIA: Input = In(0.5, 2.0);

pub(super) fn vector<S: Scalar>(x: &[S]) -> Vector3<S> {
    Vector3::new(x[0], x[1], x[2])
}

/// Symmetric matrix: diagonal, then xy, xz, yz.
pub(super) fn symmetric<S: Scalar>(x: &[S]) -> Matrix3<S> {
    Matrix3::new(x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2])
}

/// Matrix from nine numbers, row by row.
pub(super) fn matrix<S: Scalar>(x: &[S]) -> Matrix3<S> {
    Matrix3::from_row_slice(&x[..9])
}

pub(super) fn angles<S: Scalar>(x: &[S]) -> EulerAngles<S> {
    EulerAngles { alpha: x[0], beta: x[1], gamma: x[2] }
}

pub(super) fn rates<S: Scalar>(x: &[S]) -> EulerRates<S> {
    EulerRates { alpha: x[0], beta: x[1], gamma: x[2] }
}

/// `I^xx`, `I^zz`, `C`.
pub(super) fn body<S: Scalar>(x: &[S]) -> RigidSpheroid<S> {
    RigidSpheroid { inertia_xx: x[0], inertia_zz: x[1], constant_c: x[2] }
}

pub(super) fn principal<S: Scalar>(x: &[S]) -> PrincipalCoefficients<S> {
    PrincipalCoefficients { xx: x[0], yy: x[1], zz: x[2] }
}

/// Entries row by row.
pub(super) fn entries<S: Scalar>(matrix: &Matrix3<S>) -> Vec<S> {
    matrix.transpose().iter().copied().collect()
}

pub(super) fn of_angles<S: Scalar>(angles: &EulerAngles<S>) -> Vec<S> {
    vec![angles.alpha, angles.beta, angles.gamma]
}

pub(super) fn of_rates<S: Scalar>(rates: &EulerRates<S>) -> Vec<S> {
    vec![rates.alpha, rates.beta, rates.gamma]
}

pub(super) fn joined<S: Scalar>(vectors: &[Vector3<S>]) -> Vec<S> {
    vectors.iter().flat_map(|v| v.iter().copied()).collect()
}

/// `count` results that are NaN.
pub(super) fn none<S: Scalar>(count: usize) -> Vec<S> {
    vec![S::from_f64(f64::NAN); count]
}

/// One result, NaN if there is none.
pub(super) fn result<S: Scalar>(value: Result<S, Error>) -> Vec<S> {
    value.map_or(none(1), |value| vec![value])
}

/// `n`, `L`, `e_x`.
pub(super) fn state<S: Scalar>(x: &[S]) -> BodyState<S> {
    BodyState { axis: vector(x), momentum: vector(&x[3..]), equatorial_axis: vector(&x[6..]) }
}

/// Components of `n`, `L` and `e_x`.
pub(super) fn of_state<S: Scalar>(state: &BodyState<S>) -> Vec<S> {
    joined(&state.vectors())
}
