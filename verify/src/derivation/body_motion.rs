//! A rigid body moving along given angles, rates and accelerations: everything follows from the rotation matrix by time
//! jets.

use crate::derivation::accelerated_angles;
use crate::prelude::*;

/// The rotation `R_z(gamma) R_x(beta) R_z(alpha)` from inertial to body components, composed of three rotations about
/// coordinate axes: the definition of the angles, behind Eq. (9).
pub fn composed_rotation<F: Scalar>(q: &EulerAngles<F>) -> Matrix3<F> {
    let (o, l) = (F::zero(), F::one());
    let about_z = |angle: F| {
        let (s, c) = angle.sin_cos();
        Matrix3::new(c, s, o, -s, c, o, o, o, l)
    };
    let (s, c) = q.beta.sin_cos();
    about_z(q.gamma) * Matrix3::new(l, o, o, o, c, s, o, -s, c) * about_z(q.alpha)
}

/// The matrix of `v x`.
pub fn cross_matrix<F: Scalar>(v: &Vector3<F>) -> Matrix3<F> {
    let zero = F::zero();
    Matrix3::new(zero, -v.z, v.y, v.z, zero, -v.x, -v.y, v.x, zero)
}

/// `dR/dt` of Eq. (9) along the rates.
pub fn rotation_derivative<F: Differentiable>(q: &EulerAngles<F>, v: &EulerRates<F>) -> Matrix3<F> {
    body_from_inertial(&moving_angles(q, v)).map(F::derivative)
}

/// `dOmega/dt` in the body frame of Eq. (22) along the rates and accelerations.
pub fn angular_acceleration<F: Differentiable>(q: &EulerAngles<F>, v: &EulerRates<F>, a: &EulerRates<F>) -> Vector3<F> {
    body_rates(&moving_angles(q, v), &moving_rates(v, a)).map(F::derivative)
}

/// The torque of such a motion, in body components: `R d(R^T I Omega)/dt`, the rate of the angular momentum in the
/// inertial frame. With free accelerations it is an arbitrary torque.
pub fn torque_of_motion<F: Differentiable>(
    inertia: &PrincipalInertia<F>,
    q: &EulerAngles<F>,
    v: &EulerRates<F>,
    a: &EulerRates<F>,
) -> Vector3<F> {
    let angles = moving_angles(q, v);
    let omega = body_rates(&angles, &moving_rates(v, a));
    let momentum_body =
        Vector3::new(F::fixed(inertia.xx) * omega.x, F::fixed(inertia.yy) * omega.y, F::fixed(inertia.zz) * omega.z);
    let momentum = body_from_inertial(&angles).transpose() * momentum_body;
    body_from_inertial(q) * momentum.map(F::derivative)
}

/// `d^2 I^{IJ}/dt^2` of `I^{IJ} = sum over body axes of I^{ii} e_i^I e_i^J`, along the accelerated angles.
pub fn inertia_tensor_acceleration<F: Differentiable>(
    inertia: &PrincipalInertia<F>,
    q: &EulerAngles<F>,
    v: &EulerRates<F>,
    a: &EulerRates<F>,
) -> Matrix3<F> {
    let rotation = body_from_inertial(&accelerated_angles(q, v, a));
    let moments = [inertia.xx, inertia.yy, inertia.zz].map(F::constant);
    Matrix3::from_fn(|i, j| {
        let mut sum = F::zero();
        for k in 0..3 {
            sum += F::derivative_12(moments[k] * rotation[(k, i)] * rotation[(k, j)]);
        }
        sum
    })
}
