//! Rotational kinetic energy. Eq. (23).
//!
//! ```
//! use twofold::dynamics::kinetic_energy::{kinetic_energy, kinetic_energy_of_body};
//! use twofold::{EulerAngles, EulerRates, RigidSpheroid, euler_angles::body_rates};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let of_body = kinetic_energy_of_body(&star.inertia(), &body_rates(&angles, &rates));
//! assert!((kinetic_energy(&star, angles.beta, &rates) - of_body).abs() < 1e-15);
//! ```

use nalgebra::Vector3;

use crate::dynamics::{PrincipalInertia, RigidSpheroid};
use crate::euler_angles::EulerRates;
use crate::numerics::scalar::Scalar;

/// `T = (1/2) I^ij Omega^i Omega^j` from the body-frame angular velocity, for any three principal moments of inertia.
pub fn kinetic_energy_of_body<S: Scalar>(inertia: &PrincipalInertia<S>, omega_body: &Vector3<S>) -> S {
    (inertia.xx * omega_body.x * omega_body.x
        + inertia.yy * omega_body.y * omega_body.y
        + inertia.zz * omega_body.z * omega_body.z)
        / 2.0
}

/// `T = (1/2) I^xx (a'^2 sin^2 b + b'^2) + (1/2) I^zz (a' cos b + g')^2` of a spheroid, Eq. (23).
pub fn kinetic_energy<S: Scalar>(spheroid: &RigidSpheroid<S>, beta: S, rates: &EulerRates<S>) -> S {
    let (sb, cb) = beta.sin_cos();
    let transverse = rates.alpha * rates.alpha * sb * sb + rates.beta * rates.beta;
    let spin = rates.alpha * cb + rates.gamma;
    (spheroid.inertia_xx * transverse + spheroid.inertia_zz * spin * spin) / 2.0
}
