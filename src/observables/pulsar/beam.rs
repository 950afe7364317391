//! The beam: a cone about the magnetic axis, and whether it contains the line of sight. Eqs. (44), (45), (47).
//!
//! ```
//! use twofold::observables::pulsar::beam::{Beam, axis_along_line_of_sight};
//! use twofold::{BodyState, EulerAngles, EulerRates, Observer, RigidSpheroid};
//!
//! let (angles, rates) = (EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 }, EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 });
//! let state = BodyState::from_angles(&RigidSpheroid::in_units_of_tc(1.1_f64), &angles, &rates);
//! let (beam, sight) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0).direction);
//! // The observer is inside the cone where the margin is above zero.
//! let along = axis_along_line_of_sight(&angles, 0.5, 0.0, 0.8, 0.0);
//! assert!((beam.margin(&state, &sight) - (along - 0.6_f64.cos())).abs() < 1e-15);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::bulge::bulge_turning;
use crate::dynamics::equations_of_motion::{angular_velocity, reduced_rates};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::euler_angles::EulerAngles;
use crate::numerics::scalar::Scalar;
use crate::observables::sin_cos_of_sum;

/// A cone of radiation fixed in the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam<S> {
    /// Magnetic axis `m`, a unit vector in body components.
    pub axis: Vector3<S>,
    /// Semi-open angle `rho` of the cone (rad), between 0 and pi.
    pub half_opening: S,
}

impl<S: Scalar> Beam<S> {
    /// The beam about `m = sin(chi) cos(delta) e_x + sin(chi) sin(delta) e_y + cos(chi) e_z`, Eq. (45), with the semi-open
    /// angle `half_opening`; angles in rad.
    pub fn new(chi: S, delta: S, half_opening: S) -> Self {
        let ((s_chi, c_chi), (s_delta, c_delta)) = (chi.sin_cos(), delta.sin_cos());
        Self { axis: Vector3::new(s_chi * c_delta, s_chi * s_delta, c_chi), half_opening }
    }

    /// The second beam of the star, about `-m`.
    pub fn opposite(&self) -> Self {
        Self { axis: -self.axis, half_opening: self.half_opening }
    }

    /// Magnetic axis `m` in inertial components.
    pub fn direction(&self, state: &BodyState<S>) -> Vector3<S> {
        let y = state.axis.cross(&state.equatorial_axis);
        state.equatorial_axis * self.axis.x + y * self.axis.y + state.axis * self.axis.z
    }

    /// `m.n - cos(rho)`, positive where the observer in the direction `line_of_sight` (the unit vector `n`, inertial
    /// components) is inside the cone, Eq. (44) `[ineq]`.
    pub fn margin(&self, state: &BodyState<S>, line_of_sight: &Vector3<S>) -> S {
        let (_, edge) = self.half_opening.sin_cos();
        self.direction(state).dot(line_of_sight) - edge
    }

    /// The [`margin`](Self::margin) and its first three time derivatives, for a spheroid under the tensor `s^IJ`. `bulge` is the coefficient of its
    /// [`bulge`](crate::dynamics::bulge), zero if it has none.
    ///
    /// ```text
    /// dm/dt = Omega x m,   d2m/dt2 = Omega' x m + Omega x dm/dt,   d3m/dt3 = Omega'' x m + 2 Omega' x dm/dt + Omega x d2m/dt2,
    /// I^xx Omega' = dL/dt - (I^zz - I^xx) Omega^z dn/dt,   dL/dt = -2 C n x (s n),   I^xx dn/dt = L x n        (here n = e_z)
    /// ```
    ///
    /// A bulge adds `T = 2 b s L` to `Omega` and `T x` to the rates of `L` and `n`.
    pub fn margin_rates(
        &self,
        spheroid: &RigidSpheroid<S>,
        s: &Matrix3<S>,
        bulge: S,
        state: &BodyState<S>,
        line_of_sight: &Vector3<S>,
    ) -> [S; 4] {
        self.margin_rates_turning(&angular_velocity_rates(spheroid, s, bulge, state), state, line_of_sight)
    }

    /// The [`margin`](Self::margin) and its first three time derivatives, for given `Omega`, `Omega'`, `Omega''`.
    pub(super) fn margin_rates_turning(
        &self,
        [omega, acceleration, jerk]: &[Vector3<S>; 3],
        state: &BodyState<S>,
        line_of_sight: &Vector3<S>,
    ) -> [S; 4] {
        let m = self.direction(state);
        let rate = omega.cross(&m);
        let second = acceleration.cross(&m) + omega.cross(&rate);
        let third = jerk.cross(&m) + acceleration.cross(&rate) * S::from_f64(2.0) + omega.cross(&second);
        let along = |v: &Vector3<S>| v.dot(line_of_sight);
        [self.margin(state, line_of_sight), along(&rate), along(&second), along(&third)]
    }
}

/// `Omega`, `Omega'` and `Omega''` from the equations of motion, in inertial components.
fn angular_velocity_rates<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    bulge: S,
    state: &BodyState<S>,
) -> [Vector3<S>; 3] {
    let (n, momentum, xx) = (&state.axis, &state.momentum, spheroid.inertia_xx);
    let turning = |momentum: &Vector3<S>| bulge_turning(bulge, s, momentum);
    let turn = turning(momentum);
    let (axis_rate, torque) = reduced_rates(spheroid, s, n, momentum);
    let (axis_rate, momentum_rate) = (axis_rate + turn.cross(n), torque + turn.cross(momentum));
    let turn_rate = turning(&momentum_rate);
    let axis_second =
        (momentum_rate.cross(n) + momentum.cross(&axis_rate)) / xx + (turn_rate.cross(n) + turn.cross(&axis_rate));
    let pulls = axis_rate.cross(&(s * n)) + n.cross(&(s * axis_rate));
    let momentum_second =
        pulls * (spheroid.constant_c * -2.0) + (turn_rate.cross(momentum) + turn.cross(&momentum_rate));
    let spin = momentum.dot(n) / spheroid.inertia_zz;
    let along_axis = (spheroid.inertia_zz - xx) * spin;
    let omega = angular_velocity(spheroid, n, momentum) + turn;
    let acceleration = (momentum_rate - axis_rate * along_axis) / xx + turn_rate;
    let jerk = (momentum_second - axis_second * along_axis) / xx + turning(&momentum_second);
    [omega, acceleration, jerk]
}

/// `m.n` in angles, Eq. (47) `[pulsemn]`: the magnetic axis at `(chi, delta)` in the body, the observer at colatitude
/// `theta_o` and azimuth `phi_o` in the inertial frame (rad).
pub fn axis_along_line_of_sight<S: Scalar>(angles: &EulerAngles<S>, chi: S, delta: S, theta_o: S, phi_o: S) -> S {
    let (sin_a, cos_a) = sin_cos_of_sum(angles.alpha, -phi_o);
    let (sin_g, cos_g) = sin_cos_of_sum(angles.gamma, delta);
    let (sb, cb) = angles.beta.sin_cos();
    let ((s_chi, c_chi), (s_o, c_o)) = (chi.sin_cos(), theta_o.sin_cos());
    s_o * s_chi * cos_a * cos_g - s_o * s_chi * sin_a * cb * sin_g
        + c_o * c_chi * cb
        + s_o * c_chi * sin_a * sb
        + c_o * s_chi * sb * sin_g
}
