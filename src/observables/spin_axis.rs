//! Angle `lambda` between the spin axis `e_z` and a fixed direction, and its change. Eqs. (37)-(39).
//!
//! The fixed direction is arbitrary: from the star to the observer, as `n-hat` in Eq. (46), or the opposite one, from which
//! the paper counts `lambda` in Eq. (42) `[dela]`. For the reversed direction `cos lambda` and all its changes reverse their
//! sign.
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::observables::spin_axis::{changes_from_start, cos_lambda_change, cos_lambda_in_angles, cos_lambda_rate};
//! use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession};
//! use twofold::{Observer, PrincipalCoefficients, RigidSpheroid};
//!
//! let (star, direction) = (RigidSpheroid::in_units_of_tc(1.1_f64), Observer::at(0.8, 0.4).direction);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let constants = Constants { alpha_0: 0.3, beta_0: 0.7, amplitude: 0.0, phase: 0.0 };
//! let solution = Perturbation::new(Form::Printed, Precession::Single, &star, &s, 1.0, &constants)?;
//! let change = cos_lambda_change(0.8, 0.4, (0.3, 0.7), changes_from_start(&solution, 1.0));
//! assert!(change.abs() < 0.1 && cos_lambda_in_angles(0.8, 0.4, 0.3, 0.7) < 1.0);
//! assert_eq!(cos_lambda_rate(&star, &direction, &Vector3::z(), &Vector3::z()), 0.0); // spins about its axis
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;
use crate::numerics::scalar::Scalar;
use crate::observables::sin_cos_of_sum;
use crate::solutions::perturbation::Perturbation;

/// `cos lambda = sin t sin b sin(a - p) + cos t cos b` for the direction of colatitude `t = theta_o` and azimuth `p = phi_o`
/// (rad), Eq. (37); in coordinate-free form it is the product `e_z . direction`.
pub fn cos_lambda_in_angles<S: Scalar>(theta_o: S, phi_o: S, alpha: S, beta: S) -> S {
    let (st, ct) = theta_o.sin_cos();
    let (sb, cb) = beta.sin_cos();
    let (sin, _) = sin_cos_of_sum(alpha, -phi_o);
    st * sb * sin + ct * cb
}

/// Change of `cos lambda` to first order in small changes of `alpha` and `beta` (rad), Eq. (38):
///
/// ```text
/// (sin t cos b sin(a - p) - cos t sin b) Delta beta + sin t sin b cos(a - p) Delta alpha
/// ```
///
/// Error: of second order in the changes.
pub fn cos_lambda_change<S: Scalar>(
    theta_o: S,
    phi_o: S,
    (alpha, beta): (S, S),
    (alpha_change, beta_change): (S, S),
) -> S {
    let (st, ct) = theta_o.sin_cos();
    let (sb, cb) = beta.sin_cos();
    let (sin, cos) = sin_cos_of_sum(alpha, -phi_o);
    (st * cb * sin - ct * sb) * beta_change + st * sb * cos * alpha_change
}

/// Changes `(Delta alpha, Delta beta)` in the time `interval` after `t = 0`, Eq. (39): the rates of a perturbation solution
/// at `t = 0` times the interval. For single precession, with `a1 = a^(1)`,
///
/// ```text
/// Delta alpha = (a1 + A sin phi / sin b0 + cos b0 C~ cos 2 alpha_0) Delta t
/// Delta beta  = (A cos phi               + sin b0 C~ sin 2 alpha_0) Delta t
/// ```
///
/// Error: of second order in the interval. The terms in `A` belong to an oscillation of frequency `omega` and are valid only
/// for `omega Delta t << 1`, less than one turn of the star; over many turns they average out. Without them (`A = 0`) and
/// for `s^XX = s^YY` the error after any number of turns is of second order in `s`.
pub fn changes_from_start<S: Scalar>(solution: &Perturbation<S>, interval: S) -> (S, S) {
    let start = solution.at(S::zero());
    (start.alpha_rate * interval, start.beta_rate * interval)
}

/// Rate `d cos lambda / dt = direction . (L x n) / I^xx` of a moving spheroid, from its symmetry axis `n` and angular
/// momentum `L`. Exact and regular everywhere.
pub fn cos_lambda_rate<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    direction: &Vector3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> S {
    direction.dot(&momentum.cross(axis)) / spheroid.inertia_xx
}
