//! The Lagrangian from which the equations of motion follow.
//!
//! ```
//! use twofold::dynamics::{kinetic_energy::kinetic_energy, lagrangian::lagrangian};
//! use twofold::{EulerAngles, EulerRates, PrincipalCoefficients, RigidSpheroid};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let none = PrincipalCoefficients::new([0.0; 3]);
//! assert_eq!(lagrangian(&star, &none, &angles, &rates), kinetic_energy(&star, angles.beta, &rates));
//! ```

use crate::dynamics::RigidSpheroid;
use crate::dynamics::kinetic_energy::kinetic_energy;
use crate::dynamics::potential::anisotropic_potential_in_angles;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

/// The Lagrangian `L = T_rot - delta U` of a spheroid, with Eqs. (23) and (21) `[anisopot]`; the paper gives it above Eq. (24).
pub fn lagrangian<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    angles: &EulerAngles<S>,
    rates: &EulerRates<S>,
) -> S {
    kinetic_energy(spheroid, angles.beta, rates)
        - anisotropic_potential_in_angles(spheroid.constant_c, s, angles.alpha, angles.beta)
}
