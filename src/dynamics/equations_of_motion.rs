//! Coordinate-free equations of motion: symmetry axis, angular momentum and one equatorial body axis.
//!
//! The anisotropic self-energy of a spheroid depends on its orientation only through the symmetry axis `n = e_z`. Therefore
//! `(n, L)` form a closed system (the Clebsch system), and `e_x` follows them. Everything is quadratic in the state and
//! regular on the whole sphere, whereas Eq. (25) `[eleq]` is singular at the poles.
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::dynamics::equations_of_motion::{angular_velocity, body_state_rates, euler_rates_of_axis, reduced_rates, torque_on_axis};
//! use twofold::{BodyState, PrincipalCoefficients, RigidSpheroid};
//!
//! let (star, s) = (RigidSpheroid::in_units_of_tc(1.1_f64), PrincipalCoefficients::new([0.02, 0.01, -0.04]).tensor());
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let (axis_rate, torque) = reduced_rates(&star, &s, &axis, &momentum);
//! assert_eq!(torque, torque_on_axis(star.constant_c, &s, &axis));
//! let omega = angular_velocity(&star, &axis, &momentum);
//! assert!((omega.cross(&axis) - axis_rate).amax() < 1e-15);
//! let all = body_state_rates(&star, &s, &BodyState { axis, momentum, equatorial_axis: Vector3::y() });
//! assert_eq!((all.axis, all.equatorial_axis), (axis_rate, omega.cross(&Vector3::y())));
//! assert!(euler_rates_of_axis(&star, &axis, &momentum)?.alpha > 0.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates, angles_from_rotation, body_from_inertial, refuse_pole};
use crate::numerics::scalar::{Real, Scalar};

/// State of rotation of a spheroid in inertial components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState<S> {
    /// Symmetry axis `n = e_z`, a unit vector.
    pub axis: Vector3<S>,
    /// Angular momentum `L`.
    pub momentum: Vector3<S>,
    /// Equatorial body axis `e_x`, a unit vector normal to `axis`.
    pub equatorial_axis: Vector3<S>,
}

/// `(dn/dt, dL/dt)` of the reduced motion:
///
/// ```text
/// dn/dt = (L x n) / I^xx,    dL/dt = -2 C n x (s n)
/// ```
///
/// with `s` the tensor `s^IJ` in the same inertial frame as `n` and `L`.
pub fn reduced_rates<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> (Vector3<S>, Vector3<S>) {
    (momentum.cross(axis) / spheroid.inertia_xx, torque_on_axis(spheroid.constant_c, s, axis))
}

/// Torque `Gamma = -2 C n x (s n)` on a spheroid, inertial components; it has no component along `n`.
pub fn torque_on_axis<S: Scalar>(constant_c: S, s: &Matrix3<S>, axis: &Vector3<S>) -> Vector3<S> {
    (s * axis).cross(axis) * (constant_c * 2.0)
}

/// Angular velocity in inertial components, `Omega = [L - (I^zz - I^xx) Omega^z n] / I^xx` with `Omega^z = L.n / I^zz`.
pub fn angular_velocity<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> Vector3<S> {
    let spin = momentum.dot(axis) / spheroid.inertia_zz;
    (momentum - axis * ((spheroid.inertia_zz - spheroid.inertia_xx) * spin)) / spheroid.inertia_xx
}

/// Euler rates from the symmetry axis and the angular momentum alone: no rate depends on the rotation about the axis.
///
/// ```text
/// a' = (n x n')^Z / sin^2 b,   b' = -n'^Z / sin b,   g' = Omega^z - a' cos b
/// ```
///
/// # Errors
/// [`Error::Domain`] on the poles, as for [`euler_rates`](crate::euler_angles::euler_rates).
pub fn euler_rates_of_axis<S: Real>(
    spheroid: &RigidSpheroid<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> Result<EulerRates<S>, Error> {
    let sin_squared = axis.x * axis.x + axis.y * axis.y;
    refuse_pole(sin_squared.re().sqrt())?;
    let rate = momentum.cross(axis) / spheroid.inertia_xx;
    let alpha = (axis.x * rate.y - axis.y * rate.x) / sin_squared;
    let spin = momentum.dot(axis) / spheroid.inertia_zz;
    Ok(EulerRates { alpha, beta: -(rate.z / sin_squared.sqrt()), gamma: spin - alpha * axis.z })
}

/// Rates of the full state: [`reduced_rates`] and `d e_x/dt = Omega x e_x`.
pub fn body_state_rates<S: Scalar>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, state: &BodyState<S>) -> BodyState<S> {
    let (axis, momentum) = reduced_rates(spheroid, s, &state.axis, &state.momentum);
    let omega = angular_velocity(spheroid, &state.axis, &state.momentum);
    BodyState { axis, momentum, equatorial_axis: omega.cross(&state.equatorial_axis) }
}

impl<S: Scalar> BodyState<S> {
    /// The state with given Euler angles and rates: Eqs. (9) `[trans]` and (22) `[angvel1]` and `L = I Omega`. Regular at
    /// the poles.
    ///
    /// ```text
    /// L = I^xx [b' (cos a, sin a, 0) + a' sin b (-cos b sin a, cos b cos a, sin b)] + I^zz Omega^z n
    /// ```
    pub fn from_angles(spheroid: &RigidSpheroid<S>, angles: &EulerAngles<S>, rates: &EulerRates<S>) -> Self {
        let rotation = body_from_inertial(angles);
        let ((sa, ca), (sb, cb)) = (angles.alpha.sin_cos(), angles.beta.sin_cos());
        let axis = rotation.row(2).transpose();
        // Along the line of nodes and across it in the equatorial plane. Going through the body frame would leave the rounding of `gamma`
        // in `L`.
        let nodes = Vector3::new(ca, sa, S::zero());
        let across = Vector3::new(-(cb * sa), cb * ca, sb);
        let transverse = nodes * rates.beta + across * (rates.alpha * sb);
        let spin = rates.alpha * cb + rates.gamma;
        Self {
            axis,
            momentum: transverse * spheroid.inertia_xx + axis * (spheroid.inertia_zz * spin),
            equatorial_axis: rotation.row(0).transpose(),
        }
    }

    /// Rotation matrix `R^{iI}`, rows the body axes, Eq. (8) `[rmat]`, with `e_y = e_z x e_x`.
    pub fn body_from_inertial(&self) -> Matrix3<S> {
        let y = self.axis.cross(&self.equatorial_axis);
        Matrix3::from_rows(&[self.equatorial_axis.transpose(), y.transpose(), self.axis.transpose()])
    }
}

impl<S: Real> BodyState<S> {
    /// Euler angles of the state, `alpha` and `gamma` from -pi to pi.
    ///
    /// # Errors
    /// [`Error::Domain`] on the poles, see [`angles_from_rotation`].
    pub fn angles(&self) -> Result<EulerAngles<S>, Error> {
        angles_from_rotation(&self.body_from_inertial())
    }

    /// Euler rates of the state, the inverse of Eq. (22) `[angvel1]`, by [`euler_rates_of_axis`]. Computed from the angles and the body
    /// frame, they would lose another factor `1 / sin b` near the poles.
    ///
    /// # Errors
    /// [`Error::Domain`] on the poles, see [`euler_rates_of_axis`].
    pub fn rates(&self, spheroid: &RigidSpheroid<S>) -> Result<EulerRates<S>, Error> {
        euler_rates_of_axis(spheroid, &self.axis, &self.momentum)
    }
}
