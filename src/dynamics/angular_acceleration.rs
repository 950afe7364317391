//! Euler's equations of a rigid body with any torque. Eq. (63).
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::dynamics::angular_acceleration::angular_acceleration;
//!
//! // Free: the angular velocity turns about the symmetry axis at the rate epsilon Omega^z.
//! let inertia = RigidSpheroid::in_units_of_tc(1.1_f64).inertia();
//! let rate = angular_acceleration(&inertia, &Vector3::new(0.2, 0.0, 3.0), &Vector3::zeros());
//! assert!((rate.y - 0.1 * 3.0 * 0.2).abs() < 1e-15 && rate.z == 0.0);
//! ```

use nalgebra::Vector3;

use crate::dynamics::PrincipalInertia;
use crate::numerics::scalar::Scalar;

/// Angular acceleration in the body frame, the solution of Eq. (63) for `d Omega / dt` in principal axes:
///
/// ```text
/// I^xx dOmega^x/dt = Delta_1 Omega^y Omega^z + Gamma^x,   and cyclic
/// ```
///
/// with `Delta_1 = I^yy - I^zz` and cyclic, Eq. (67).
pub fn angular_acceleration<S: Scalar>(
    inertia: &PrincipalInertia<S>,
    omega_body: &Vector3<S>,
    torque_body: &Vector3<S>,
) -> Vector3<S> {
    let [d1, d2, d3] = inertia.differences();
    let (o, g) = (omega_body, torque_body);
    Vector3::new(
        (d1 * o.y * o.z + g.x) / inertia.xx,
        (d2 * o.z * o.x + g.y) / inertia.yy,
        (d3 * o.x * o.y + g.z) / inertia.zz,
    )
}
