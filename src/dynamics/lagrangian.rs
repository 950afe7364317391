//! The Lagrangian from which the equations of motion follow.
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! use twofold::dynamics::first_integrals::energy_in_angles;
//! use twofold::dynamics::kinetic_energy::kinetic_energy;
//! use twofold::dynamics::lagrangian::lagrangian;
//!
//! // L = T - V where the energy is T + V.
//! let (t, sum) = (kinetic_energy(&star, angles.beta, &rates), energy_in_angles(&star, &s, &angles, &rates));
//! assert!((lagrangian(&star, &s, &angles, &rates) - (2.0 * t - sum)).abs() < 1e-15);
//! ```

use crate::dynamics::RigidSpheroid;
use crate::dynamics::kinetic_energy::kinetic_energy;
use crate::dynamics::potential::anisotropic_potential_in_angles;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

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
