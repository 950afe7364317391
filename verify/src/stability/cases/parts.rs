//! Vectors, tensors and bodies from the numbers of a case.

use crate::prelude::*;

pub(super) fn vector<S: Scalar>(x: &[S]) -> Vector3<S> {
    Vector3::new(x[0], x[1], x[2])
}

/// Six numbers: diagonal, then xy, xz, yz.
pub(super) fn symmetric<S: Scalar>(x: &[S]) -> Matrix3<S> {
    Matrix3::new(x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2])
}

/// Nine numbers, row by row.
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

/// Row by row.
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

/// So many results that are not numbers.
pub(super) fn none<S: Scalar>(count: usize) -> Vec<S> {
    vec![S::from_f64(f64::NAN); count]
}
