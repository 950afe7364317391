//! Torques as generalised forces: the change of a potential under a small rotation of the body.

use crate::prelude::*;

/// Torque on a body with the tensor `U^ij` in body components: minus the derivative of `-(1/2) s^ij U^ij` under a rotation
/// of the body about each of its axes. `s` is in inertial components.
///
/// After a rotation by a small angle about the axis `e_i`, the rows are `e_j + angle e_i x e_j`.
pub fn torque_by_virtual_rotation<F: Differentiable>(
    rotation: &Matrix3<F>,
    s: &Matrix3<F>,
    potential_energy_tensor: &Matrix3<F>,
) -> Vector3<F> {
    let (s, u) = (s.map(F::fixed), potential_energy_tensor.map(F::fixed));
    Vector3::from_fn(|i, _| {
        let about = rotation.row(i).transpose();
        let turned = Matrix3::from_fn(|j, k| F::first(rotation[(j, k)], about.cross(&rotation.row(j).transpose())[k]));
        -F::derivative(anisotropic_potential_of_body(&tensor_in_body_frame(&turned, &s), &u))
    })
}

/// Derivatives of `-(1/2) s^ij U^ij` by the three Euler angles; `s` in inertial components, `U^ij` in body components.
pub fn gradient_in_angles<F: Differentiable>(
    q: &EulerAngles<F>,
    s: &Matrix3<F>,
    potential_energy_tensor: &Matrix3<F>,
) -> Vector3<F> {
    let (s, u) = (s.map(F::fixed), potential_energy_tensor.map(F::fixed));
    Vector3::from_fn(|i, _| {
        let rotation = body_from_inertial(&moving_angles(q, &unit_rates(i)));
        F::derivative(anisotropic_potential_of_body(&tensor_in_body_frame(&rotation, &s), &u))
    })
}

/// Rates with a one for the `i`-th of `alpha`, `beta`, `gamma` and zeros for the others.
pub fn unit_rates<F: Differentiable>(i: usize) -> EulerRates<F> {
    let unit = |j| if i == j { F::one() } else { F::zero() };
    EulerRates { alpha: unit(0), beta: unit(1), gamma: unit(2) }
}
