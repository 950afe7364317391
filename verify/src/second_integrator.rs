//! An independent numerical motion: Verner's Runge-Kutta 9(8) of the crate `numeris`.

use crate::prelude::*;
use numeris::Vector;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKV98, RKV98NoInterp};

/// Settings for an absolute and a relative tolerance.
pub fn settings(tolerance: f64) -> AdaptiveSettings<f64> {
    AdaptiveSettings { abs_tol: tolerance, rel_tol: tolerance, max_steps: 10_000_000, ..AdaptiveSettings::default() }
}

fn pack<const N: usize, X: RotationState<f64>>(state: &X) -> Vector<f64, N> {
    let vectors = state.vectors();
    Vector::from_array(core::array::from_fn(|i| vectors[i / 3][i % 3]))
}

/// The state from the first nine numbers.
fn unpack<const N: usize>(y: &Vector<f64, N>) -> BodyState<f64> {
    let vector = |k: usize| Vector3::new(y[3 * k], y[3 * k + 1], y[3 * k + 2]);
    BodyState { axis: vector(0), momentum: vector(1), equatorial_axis: vector(2) }
}

/// State after `duration` by the regular equations.
pub(crate) fn regular_motion(problem: &Problem<f64>, duration: f64, tolerance: f64) -> Result<BodyState<f64>, String> {
    let states = regular_states(problem, &[duration], tolerance)?;
    Ok(states[0])
}

/// States at times in ascending order from zero.
pub(crate) fn regular_states(
    problem: &Problem<f64>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<BodyState<f64>>, String> {
    let rates = |_: f64, y: &Vector<f64, 9>| pack(&rates_of(problem, problem.spheroid(), &unpack(y)));
    Ok(integrated(pack(problem.initial()), rates, times, tolerance)?.iter().map(unpack).collect())
}

/// The solution that starts at time zero, at times in ascending order.
fn integrated<const N: usize>(
    start: Vector<f64, N>,
    rates: impl Fn(f64, &Vector<f64, N>) -> Vector<f64, N>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<Vector<f64, N>>, String> {
    let (mut y, mut time, mut found) = (start, 0.0, Vec::new());
    for &next in times {
        let end = RKV98NoInterp::integrate(time, next, &y, &rates, &settings(tolerance)).map_err(|e| e.to_string())?;
        (y, time) = (end.y, next);
        found.push(y);
    }
    Ok(found)
}

/// The equations of motion of the problem with another spheroid. `{u, b L.(s L)} = 2 b (s L) x u` holds for any axis `u` of the body, and for `L`.
fn rates_of(problem: &Problem<f64>, spheroid: &RigidSpheroid<f64>, state: &BodyState<f64>) -> BodyState<f64> {
    let s = problem.coefficients();
    let mut rates = body_state_rates(spheroid, s, state);
    let turn = (s * state.momentum - state.momentum * (s.trace() / 3.0)) * (2.0 * problem.bulge());
    rates.axis += turn.cross(&state.axis);
    rates.momentum += turn.cross(&state.momentum);
    rates.equatorial_axis += turn.cross(&state.equatorial_axis);
    rates
}

/// A star under a braking torque along `L`: its states at times in ascending order from zero. The equations of motion, with `C a^2` in place of `C`
/// as for a bulge, have the additional terms
///
/// ```text
/// dL/dt = ... - lambda L,  da/dt = -lambda a,  lambda = rate a^(n - 1) (1 + g (sin^2 theta_m - a_0))
/// ```
///
/// starting from `a = |L| / unit`, with the magnetic axis of the `beam`. Friction at the rate `gamma` turns `n`, and the body with it, towards
/// `l = L / |L|`,
///
/// ```text
/// dn/dt = ... + gamma a (n.l) (l - n (n.l))
/// ```
pub(crate) fn braked_states(
    problem: &Problem<f64>,
    (beam, unit, rate, index): (&Beam<f64>, f64, f64, f64),
    [modulation, mean, damping]: [f64; 3],
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<BodyState<f64>>, String> {
    let with_last = |state: &BodyState<f64>, last: f64| {
        let packed: Vector<f64, 9> = pack(state);
        Vector::from_array(core::array::from_fn(|i| if i < 9 { packed[i] } else { last }))
    };
    let rates = |_: f64, y: &Vector<f64, 10>| {
        let (state, a) = (unpack(y), y[9]);
        let spheroid = RigidSpheroid { constant_c: problem.spheroid().constant_c * a * a, ..*problem.spheroid() };
        let mut rates = rates_of(problem, &spheroid, &state);
        let cos = beam.direction(&state).dot(&state.momentum) / state.momentum.norm();
        let lambda = rate * a.powf(index - 1.0) * (1.0 + modulation * (1.0 - cos * cos - mean));
        rates.momentum -= state.momentum * lambda;
        let (n, l) = (state.axis, state.momentum.normalize());
        let turning = n.cross(&l) * (damping * a * n.dot(&l));
        rates.axis += turning.cross(&n);
        rates.equatorial_axis += turning.cross(&state.equatorial_axis);
        with_last(&rates, -lambda * a)
    };
    let start = problem.initial();
    let start = with_last(start, start.momentum.norm() / unit);
    Ok(integrated(start, rates, times, tolerance)?.iter().map(unpack).collect())
}

/// Symmetry axis and angular momentum at the given times, in ascending order from zero, from the interpolant of order 8 of
/// the method.
///
/// # Errors
/// Errors of the integrator.
pub fn axis_states(
    problem: &Problem<f64, AxisState<f64>>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<AxisState<f64>>, String> {
    let unpack = |y: &Vector<f64, 6>| AxisState {
        axis: Vector3::new(y[0], y[1], y[2]),
        momentum: Vector3::new(y[3], y[4], y[5]),
    };
    let rates = |_: f64, y: &Vector<f64, 6>| {
        let AxisState { axis, momentum } = unpack(y);
        let (axis, momentum) = reduced_rates(problem.spheroid(), problem.coefficients(), &axis, &momentum);
        pack(&AxisState { axis, momentum })
    };
    let settings = AdaptiveSettings { dense_output: true, ..settings(tolerance) };
    let end = times.last().copied().unwrap_or(0.0);
    let solution = RKV98::integrate(0.0, end, &pack(problem.initial()), rates, &settings).map_err(|e| e.to_string())?;
    let states = RKV98::interpolate_batch(times, &solution).map_err(|e| e.to_string())?;
    Ok(states.iter().map(unpack).collect())
}

/// Euler angles after `duration` by Eq. (25) `[eleq]` and `gamma' = Omega^z - alpha' cos beta`, with their full turns.
pub(crate) fn motion_in_angles(
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
