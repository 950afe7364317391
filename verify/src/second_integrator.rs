//! A second opinion on numerical motion: Verner's Runge-Kutta 9(8) of the crate `numeris`.

use nalgebra::{Matrix3, Vector3};
use numeris::Vector;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKV98, RKV98NoInterp};
use twofold::dynamics::equations_of_motion::{body_state_rates, reduced_rates};
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_accelerations};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::AxisState;

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

/// Symmetry axis and angular momentum at the given times, in ascending order from zero, by the interpolant of order 8 of the
/// method.
///
/// # Errors
/// What the integrator reports.
pub fn axis_states(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &AxisState<f64>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<AxisState<f64>>, String> {
    let pack = |n: &Vector3<f64>, l: &Vector3<f64>| Vector::from_array([n.x, n.y, n.z, l.x, l.y, l.z]);
    let unpack = |y: &Vector<f64, 6>| AxisState {
        axis: Vector3::new(y[0], y[1], y[2]),
        momentum: Vector3::new(y[3], y[4], y[5]),
    };
    let rates = |_: f64, y: &Vector<f64, 6>| {
        let AxisState { axis, momentum } = unpack(y);
        let (axis_rate, momentum_rate) = reduced_rates(spheroid, s, &axis, &momentum);
        pack(&axis_rate, &momentum_rate)
    };
    let settings = AdaptiveSettings { dense_output: true, ..settings(tolerance) };
    let start = pack(&initial.axis, &initial.momentum);
    let end = times.last().copied().unwrap_or(0.0);
    let solution = RKV98::integrate(0.0, end, &start, rates, &settings).map_err(|e| e.to_string())?;
    let states = RKV98::interpolate_batch(times, &solution).map_err(|e| e.to_string())?;
    Ok(states.iter().map(unpack).collect())
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
