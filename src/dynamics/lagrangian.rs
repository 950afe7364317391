//! The Lagrangian from which the equations of motion follow.

use crate::dynamics::RigidSpheroid;
use crate::dynamics::kinetic_energy::kinetic_energy;
use crate::dynamics::potential::anisotropic_potential_in_angles;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::scalar::Scalar;

/// `L = T_rot - delta U` with Eqs. (23) and (21) `[anisopot]`, above Eq. (24).
pub fn lagrangian<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    angles: &EulerAngles<S>,
    rates: &EulerRates<S>,
) -> S {
    kinetic_energy(spheroid, angles.beta, rates)
        - anisotropic_potential_in_angles(spheroid.constant_c, s, angles.alpha, angles.beta)
}
