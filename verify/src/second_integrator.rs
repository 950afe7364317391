//! A second opinion on numerical motion: Verner's Runge-Kutta 9(8) of the crate `numeris`.

use nalgebra::{Matrix3, Vector3};
use numeris::Vector;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKV98NoInterp};
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_accelerations};
use twofold::dynamics::regular_equations::body_state_rates;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;

fn settings(tolerance: f64) -> AdaptiveSettings<f64> {
    AdaptiveSettings { abs_tol: tolerance, rel_tol: tolerance, max_steps: 10_000_000, ..AdaptiveSettings::default() }
}

/// State after `duration` by the regular equations.
///
/// # Errors
/// What the integrator reports.
pub fn regular_motion(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &BodyState<f64>,
    duration: f64,
    tolerance: f64,
) -> Result<BodyState<f64>, String> {
    let pack = |state: &BodyState<f64>| {
        let mut packed = [0.0; 9];
        for (k, v) in [&state.axis, &state.momentum, &state.equatorial_axis].into_iter().enumerate() {
            packed[3 * k..3 * k + 3].copy_from_slice(v.as_slice());
        }
        Vector::from_array(packed)
    };
    let unpack = |y: &Vector<f64, 9>| {
        let vector = |k: usize| Vector3::new(y[3 * k], y[3 * k + 1], y[3 * k + 2]);
        BodyState { axis: vector(0), momentum: vector(1), equatorial_axis: vector(2) }
    };
    let rates = |_: f64, y: &Vector<f64, 9>| pack(&body_state_rates(spheroid, s, &unpack(y)));
    let end = RKV98NoInterp::integrate(0.0, duration, &pack(initial), rates, &settings(tolerance))
        .map_err(|e| e.to_string())?;
    Ok(unpack(&end.y))
}

/// Euler angles after `duration` by Eq. (25) `[eleq]` and `gamma' = Omega^z - alpha' cos beta`; they count their turns.
///
/// # Errors
/// What the integrator reports; near a pole the equations are singular.
pub fn motion_in_angles(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    (angles, rates): (&EulerAngles<f64>, &EulerRates<f64>),
    duration: f64,
    tolerance: f64,
) -> Result<EulerAngles<f64>, String> {
    let spin = rates.alpha * angles.beta.cos() + rates.gamma;
    let start = Vector::from_array([angles.alpha, angles.beta, angles.gamma, rates.alpha, rates.beta]);
    let equations = |_: f64, y: &Vector<f64, 5>| {
        let q = AxisAngles { alpha: y[0], beta: y[1], alpha_rate: y[3], beta_rate: y[4] };
        let (alpha, beta) = euler_angle_accelerations(spheroid, s, spin, &q);
        Vector::from_array([q.alpha_rate, q.beta_rate, spin - q.alpha_rate * q.beta.cos(), alpha, beta])
    };
    let end =
        RKV98NoInterp::integrate(0.0, duration, &start, equations, &settings(tolerance)).map_err(|e| e.to_string())?;
    Ok(EulerAngles { alpha: end.y[0], beta: end.y[1], gamma: end.y[2] })
}
