//! The motion of a spheroid along Eq. (25), with the rotation about its axis.

use crate::prelude::*;

/// Angles and rates without those of the rotation about the symmetry axis.
pub fn axis_angles<F: Scalar>(q: &EulerAngles<F>, v: &EulerRates<F>) -> AxisAngles<F> {
    AxisAngles { alpha: q.alpha, beta: q.beta, alpha_rate: v.alpha, beta_rate: v.beta }
}

/// The rate `gamma''` at constant spin `Omega^z = a' cos b + g'`, for given `a''` and `b''`.
pub fn gamma_acceleration<F: Differentiable>(q: &EulerAngles<F>, v: &EulerRates<F>, alpha_acceleration: F) -> F {
    let (_, cos_beta) = F::first(q.beta, v.beta).sin_cos();
    -F::derivative(F::first(v.alpha, alpha_acceleration) * cos_beta)
}

/// Accelerations of all three angles by Eq. (25) and the conservation of the spin.
pub fn accelerations<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    q: &EulerAngles<F>,
    v: &EulerRates<F>,
) -> EulerRates<F> {
    let (alpha, beta) = euler_angle_accelerations(spheroid, s, spin_in_angles(q, v), &axis_angles(q, v));
    EulerRates { alpha, beta, gamma: gamma_acceleration(q, v, alpha) }
}

/// The spheroid as a constant in the extended numbers.
pub fn fixed_spheroid<F: Differentiable>(spheroid: &RigidSpheroid<F>) -> RigidSpheroid<F::First> {
    spheroid.map(F::fixed)
}

/// The coefficients as constants in the extended numbers.
pub fn fixed_coefficients<F: Differentiable>(s: &PrincipalCoefficients<F>) -> PrincipalCoefficients<F::First> {
    PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(F::fixed))
}
