//! Motions of every method: states, steps, estimates, forecasts.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use twofold::Real;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates, body_from_inertial};
use twofold::lorentz_violation::PrincipalCoefficients;

use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Method, Output, Plan, Request, StateFunction, gradient_in_parts};
use twofold::propagation::splitting::{
    SCHEMES, propagate_by_best_splitting, propagate_by_splitting, propagate_orientation_by_best_splitting,
    propagate_orientation_by_splitting, splitting_forecast,
};
use twofold::propagation::{
    AveragedMotion, AxisScene, AxisState, ContinuousAngles, ErrorEstimates, Motion, SymmetricMotion, UniformMotion,
    axis_states_at, axis_states_of_many, propagate, propagate_axis, states_at, taylor_forecast,
};
use twofold::solutions::averaged::AveragingOrder;
use twofold::solutions::free::{free_precession_rates, free_rotation};
use twofold::solutions::perturbation::Precession;
use twofold::solutions::steady::steady_precession_rate;

use crate::values::scene::{ANGLES, PROLATE, RATES, STAR, general, start, state, tensor};
use crate::values::table::Table;

const SPAN: (f64, f64) = (2.0, 31.0);
const BACK: (f64, f64) = (2.0, -17.0);

fn look<M: Motion<f64, State = BodyState<f64>>>(table: &mut Table, name: &str, motion: &M) {
    let (from, to) = motion.span();
    for share in [0.0, 0.31, 0.77, 1.0] {
        let t = from + share * (to - from);
        match motion.state(t) {
            Ok(state) => table.state(&format!("{name} at {t:.2}"), &state),
            Err(error) => table.error(&format!("{name} at {t:.2}"), &error),
        }
        table.number(&format!("{name} at {t:.2}: error estimate"), motion.error_estimate(t));
        if let (Ok(state), Ok(axis)) =
            (motion.state_in_parts([0.75 * t, 0.25 * t]), motion.axis_state_in_parts([0.5 * t, 0.5 * t]))
        {
            table.parts(
                &format!("{name} in parts at {t:.2}: n, e_x"),
                [state.axis.x, state.equatorial_axis.y, axis.axis.z],
            );
        }
    }
    table.refusal(&format!("{name} after its span"), &motion.state(to + (to - from)));
}

#[test]
fn closed_forms() {
    let mut table = Table::default();
    for (name, span) in [("free", SPAN), ("free backwards", BACK)] {
        let motion = UniformMotion::free_from_parts(&STAR, &(general() * 1e-6), &state(), span);
        look(&mut table, name, &motion);
        for elapsed in [5.0, -5.0, 1e6] {
            table.number(&format!("{name}, truncation after {elapsed}"), motion.truncation(elapsed));
            table.number(&format!("{name}, rounding after {elapsed}"), motion.rounding(elapsed));
        }
    }
    table.state("free rotation", &free_rotation(&STAR, &state(), 7.3));
    let rates = free_precession_rates(&STAR, 1.9, 0.8).expect("rates");
    table.parts("free precession", [rates.alpha, rates.beta, rates.gamma]);
    steady(&mut table);
    table.check("closed_forms");
}

/// About the symmetry axis of a tensor, with either root; and at rest on a principal axis.
fn steady(table: &mut Table) {
    let s = PrincipalCoefficients::new([0.02, 0.02, -0.03]);
    let turn = body_from_inertial(&EulerAngles { alpha: -0.3, beta: 0.6, gamma: 0.2 });
    for kind in [Precession::Twofold, Precession::Single] {
        let (spin, beta) = (1.9, 0.8);
        let rate = steady_precession_rate(kind, &STAR, &s, spin, beta).expect("a rate");
        table.number(&format!("steady rate, {kind:?}"), rate);
        let angles = EulerAngles { alpha: 0.4, beta, gamma: 0.1 };
        let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
        let upright = BodyState::from_angles(&STAR, &angles, &rates);
        let (given, s) = (upright.rotated(&turn.transpose()), turn.transpose() * s.tensor() * turn);
        for span in [SPAN, BACK] {
            match UniformMotion::steady_from_parts(&STAR, &s, &given, span) {
                Ok(motion) => {
                    look(table, &format!("steady {kind:?} {span:?}"), &motion);
                    table.number(&format!("steady {kind:?}, rounding after 50"), motion.rounding(50.0));
                    table.number(&format!("steady {kind:?}, truncation after 50"), motion.truncation(50.0));
                }
                Err(error) => table.error(&format!("steady {kind:?}"), &error),
            }
        }
        let off = BodyState { momentum: given.momentum * (1.0 + 1e-9), ..given };
        table.refusal(&format!("not steady {kind:?}"), &UniformMotion::steady_from_parts(&STAR, &s, &off, SPAN));
    }
    let resting = |momentum: f64| BodyState {
        axis: Vector3::z(),
        momentum: Vector3::z() * momentum,
        equatorial_axis: Vector3::x(),
    };
    let s = PrincipalCoefficients::new([0.021, -0.004, 0.009]).tensor();
    for momentum in [3.0, 0.0, -2.0] {
        match UniformMotion::steady_from_parts(&STAR, &s, &resting(momentum), SPAN) {
            Ok(motion) => {
                look(table, &format!("axis at rest, L = {momentum}"), &motion);
                table.number(&format!("axis at rest, L = {momentum}: rounding"), motion.rounding(29.0));
            }
            Err(error) => table.error(&format!("axis at rest, L = {momentum}"), &error),
        }
    }
}

#[test]
fn symmetric_motions() {
    let mut table = Table::default();
    let upright = BodyState::from_angles(
        &STAR,
        &EulerAngles { alpha: 0.1, beta: 1e-4, gamma: 0.0 },
        &EulerRates { alpha: 0.3, beta: 2e-4, gamma: 0.9 },
    );
    let slow = BodyState::from_angles(&STAR, &ANGLES, &EulerRates { alpha: 0.02, beta: -0.01, gamma: 0.03 });
    let swinging = BodyState::from_angles(&STAR, &ANGLES, &EulerRates { alpha: 0.0, beta: 0.2, gamma: 0.0 });
    let cases = [
        ("oblate tensor", tensor([0.02, 0.02, -0.03]), state()),
        ("prolate tensor", tensor([-0.01, 0.025, -0.01]), state()),
        ("strong tensor", tensor([0.2, 0.2, -0.3]), state()),
        ("nearly symmetric", tensor([0.02, 0.02 + 1e-9, -0.03]), state()),
        ("hardly turning", tensor([0.02, 0.02, -0.03]), slow),
        ("swinging over the equator", tensor([0.02, 0.02, -0.03]), swinging),
        ("near the pole", PrincipalCoefficients::new([0.02, 0.02, -0.03]).tensor(), upright),
    ];
    for (name, s, initial) in &cases {
        for span in [SPAN, BACK] {
            match SymmetricMotion::from_parts(&STAR, s, initial, span) {
                Ok(motion) => {
                    look(&mut table, &format!("{name} {span:?}"), &motion);
                    for elapsed in [3.0, -400.0, 1e7] {
                        table.number(&format!("{name}, truncation after {elapsed}"), motion.truncation(elapsed));
                        table.number(&format!("{name}, rounding after {elapsed}"), motion.rounding(elapsed));
                    }
                }
                Err(error) => table.error(name, &error),
            }
        }
    }
    table.check("symmetric_motions");
}

#[test]
fn mean_motions() {
    let mut table = Table::default();
    let cases = [
        ("general", general() * 0.1, state()),
        ("weak", general() * 1e-7, state()),
        ("two equal", tensor([0.002, 0.002, -0.003]), state()),
        ("upside down", general() * 0.1, BodyState { momentum: -state().momentum, ..state() }),
        ("n on L", general() * 0.01, BodyState { momentum: state().axis * 2.0, ..state() }),
    ];
    for (name, s, initial) in &cases {
        for order in [AveragingOrder::First, AveragingOrder::Second] {
            let name = format!("{name} {order:?}");
            let motion = match AveragedMotion::from_parts(&STAR, s, initial, SPAN, order) {
                Ok(motion) => motion,
                Err(error) => {
                    table.error(&name, &error);
                    continue;
                }
            };
            look(&mut table, &name, &motion);
            let mean = motion.mean();
            let rates = mean.rates();
            table.parts(&format!("{name}: mean rates"), [rates.slow, rates.about_momentum, rates.about_axis]);
            table.number(&format!("{name}: strength"), mean.relative_strength());
            for t in [0.5, 40.0, -7.0, 3e3] {
                table.number(&format!("{name}: truncation at {t}"), motion.truncation(t));
                table.number(&format!("{name}: rounding at {t}"), motion.rounding(t));
                table.number(&format!("{name}: error estimate at {t}"), mean.error_estimate(t));
                table.number(&format!("{name}: truncation of the mean at {t}"), mean.truncation(t));
                table.number(&format!("{name}: rounding of the mean at {t}"), mean.rounding(t));
            }
            let turns = motion.turns([25.0, 1e-3]);
            for (of, turns) in [("slow", turns.slow), ("about L", turns.about_momentum), ("about n", turns.about_axis)]
            {
                table.parts(&format!("{name}: turns {of}"), [turns.whole as f64, turns.fraction, turns.angle()]);
            }
            let near = motion.near([20.0, 0.5]).expect("within the span");
            look(&mut table, &format!("{name} near 20.5"), &near);
            table.refusal(&format!("{name} near 40"), &motion.near([40.0, 0.0]));
            table.refusal(&format!("{name}: derivatives"), &motion.require_derivatives());
        }
    }
    table.check("mean_motions");
}

#[test]
fn taylor_series() {
    let mut table = Table::default();
    let s = general();
    for accuracy in [1e-14, 1e-11, 1e-5] {
        for span in [SPAN, BACK] {
            let name = format!("accuracy {accuracy:e} over {span:?}");
            let forecast = taylor_forecast(&STAR, &s, &state(), true, span.1 - span.0, accuracy).expect("a forecast");
            table.row(&format!("{name}: forecast"), &[forecast.order as f64, forecast.steps, forecast.rounding]);
            let motion = propagate(&STAR, &s, &state(), span, accuracy).expect("a motion");
            table.parts(&format!("{name}: steps and order"), [motion.step_count() as f64, motion.order() as f64]);
            look(&mut table, &name, &motion);
            let axis = propagate_axis(&STAR, &s, &AxisState::from(&state()), span, accuracy).expect("a motion");
            table.parts(&format!("{name}: axis, steps and order"), [axis.step_count() as f64, axis.order() as f64]);
            let middle = 0.5 * (span.0 + span.1);
            table.axis_state(&format!("{name}: axis"), &axis.axis_state(middle).expect("a state"));
            table.number(&format!("{name}: axis, error estimate"), axis.error_estimate(middle));
        }
    }
    let times = [2.0, 3.5, 9.0, 9.0, 31.0];
    for estimates in [ErrorEstimates::Wanted, ErrorEstimates::NotWanted] {
        let found = states_at(&STAR, &s, &state(), SPAN.0, &times, 1e-11, estimates).expect("states");
        table.parts("samples: steps and order", [found.step_count as f64, found.order as f64]);
        for (t, state) in times.iter().zip(&found.states) {
            table.state(&format!("sample at {t}"), state);
        }
        for error in &found.error_estimates {
            table.number("samples: error estimate", *error);
        }
    }
    let axis = axis_states_at(&STAR, &s, &AxisState::from(&state()), 2.0, &[1.0, -5.0], 1e-9, ErrorEstimates::Wanted)
        .expect("states");
    for (state, error) in axis.states.iter().zip(&axis.error_estimates) {
        table.axis_state("axis backwards", state);
        table.number("axis backwards: error estimate", *error);
    }
    table.refusal(
        "times not in order",
        &states_at(&STAR, &s, &state(), 2.0, &[5.0, 4.0, 6.0], 1e-9, ErrorEstimates::NotWanted),
    );
    table.refusal("no times", &states_at(&STAR, &s, &state(), 2.0, &[], 1e-9, ErrorEstimates::NotWanted));
    dual_samples(&mut table);
    table.check("taylor_series");
}

/// By duals, which go without vectors of doubles.
fn dual_samples(table: &mut Table) {
    let seeded = |x: f64| Dual64::new(x, 1.0);
    let star =
        RigidSpheroid { inertia_xx: seeded(1.3), inertia_zz: Dual64::from_re(1.7), constant_c: Dual64::from_re(0.8) };
    let (s, given) = (general().map(Dual64::from_re), state());
    let lifted = |v: &Vector3<f64>| v.map(Dual64::from_re);
    let initial = BodyState {
        axis: lifted(&given.axis),
        momentum: lifted(&given.momentum),
        equatorial_axis: lifted(&given.equatorial_axis),
    };
    let found = states_at(&star, &s, &initial, 2.0, &[3.0, 12.0], 1e-11, ErrorEstimates::Wanted).expect("states");
    for state in &found.states {
        table.parts("derivative by I^xx: n", state.axis.iter().map(|x| x.eps));
        table.parts("derivative by I^xx: L", state.momentum.iter().map(|x| x.eps));
        table.parts("derivative by I^xx: e_x", state.equatorial_axis.iter().map(|x| x.eps));
        table.parts("with derivatives: e_x", state.equatorial_axis.iter().map(|x| x.re()));
    }
    for error in &found.error_estimates {
        table.number("with derivatives: error estimate", *error);
    }
    let motion = propagate(&star, &s, &initial, SPAN, 1e-11).expect("a motion");
    let t = Dual64::from_re(17.0);
    table.parts(
        "dense, derivative by I^xx: e_x",
        motion.state(t).expect("a state").equatorial_axis.iter().map(|x| x.eps),
    );
    let by_time = motion.state(Dual64::new(17.0, 1.0)).expect("a state");
    table.parts("dense, derivative by I^xx and t: n", by_time.axis.iter().map(|x| x.eps));
    table.number("dense, error estimate", motion.error_estimate(17.0));
}

#[test]
fn many_axes() {
    let mut table = Table::default();
    let times: Vec<Vec<f64>> = (0..11).map(|k| vec![0.5 * f64::from(k) + 1.0, 3.0 * f64::from(k) + 4.0]).collect();
    let scenes: Vec<AxisScene<'_>> = times
        .iter()
        .enumerate()
        .map(|(k, times)| AxisScene {
            spheroid: STAR,
            violation: general() * (1.0 + 0.1 * k as f64),
            initial: AxisState::from(&state()),
            start: 0.5,
            times,
            accuracy: if k == 3 { 1e-5 } else { 1e-11 },
        })
        .collect();
    let mut broken = scenes.clone();
    broken[5].initial.axis.x = 3.0;
    broken[7].accuracy = 1.0;
    // So many times that steps of a splitting would be cut short: series of three orders, in turn.
    let dense: Vec<Vec<f64>> =
        (0..13).map(|k| (0..110 + k).map(|j| 0.6 + 0.03 * f64::from(k) + 0.025 * f64::from(j)).collect()).collect();
    let mut series: Vec<AxisScene<'_>> = dense
        .iter()
        .enumerate()
        .map(|(k, times)| AxisScene {
            spheroid: if k % 4 == 1 { PROLATE } else { STAR },
            violation: general() * (1.0 + 0.1 * k as f64),
            initial: AxisState::from(&state()),
            start: if k == 6 { 5.0 } else { 0.5 },
            times,
            accuracy: [1e-5, 1e-15, 1e-10][k % 3],
        })
        .collect();
    // Backwards, and one that is too long for its steps.
    let back: Vec<f64> = dense[6].iter().rev().copied().collect();
    series[6].times = &back;
    let late = [1.0, 1e12];
    series[9] = AxisScene { times: &late, accuracy: 1e-15, ..series[9] };
    series[4].initial.momentum.x = f64::NAN;
    let few =
        |states: &[AxisState<f64>]| [0, 1, states.len() / 2, states.len() - 1].map(|k| states[k.min(states.len() - 1)]);
    for (k, found) in axis_states_of_many(&series).iter().enumerate() {
        match found {
            Ok(samples) => {
                table
                    .parts(&format!("series, {k}: steps and order"), [samples.step_count as f64, samples.order as f64]);
                for state in few(&samples.states) {
                    table.axis_state(&format!("series, {k}"), &state);
                }
            }
            Err(error) => table.error(&format!("series, {k}"), error),
        }
    }
    for (name, scenes) in [("all good", scenes), ("two refused", broken)] {
        for (k, found) in axis_states_of_many(&scenes).iter().enumerate() {
            match found {
                Ok(samples) => {
                    table.parts(
                        &format!("{name}, {k}: steps and order"),
                        [samples.step_count as f64, samples.order as f64],
                    );
                    for state in &samples.states {
                        table.axis_state(&format!("{name}, {k}"), state);
                    }
                }
                Err(error) => table.error(&format!("{name}, {k}"), error),
            }
        }
    }
    table.check("many_axes");
}

#[test]
fn splitting() {
    let mut table = Table::default();
    let s = general();
    let axis = AxisState::from(&state());
    for span in [SPAN, BACK, (0.0, 1e5)] {
        for accuracy in [1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 1e-16] {
            for (of, s) in [("s", s), ("s / 1e3", s * 1e-3)] {
                let name = format!("{of} over {span:?} to {accuracy:e}");
                match splitting_forecast(&STAR, &s, &axis, span, accuracy) {
                    Ok(found) => {
                        table.text(&format!("{name}: scheme"), found.scheme.name);
                        table.number(&format!("{name}: step"), found.step);
                        table.number(&format!("{name}: steps"), found.steps);
                        table.row(
                            &format!("{name}: truncation, coverage, rounding"),
                            &[found.truncation, found.coverage, found.rounding],
                        );
                    }
                    Err(error) => table.error(&name, &error),
                }
            }
        }
    }
    for scheme in SCHEMES {
        for (span, step) in [(SPAN, 0.21), (BACK, 0.4)] {
            let name = format!("{} over {span:?}", scheme.name);
            let motion = propagate_by_splitting(&STAR, &s, &axis, span, scheme, step).expect("a motion");
            table.parts(&format!("{name}: step, number"), [motion.step(), motion.step_count() as f64]);
            for share in [0.13, 1.0] {
                let t = span.0 + share * (span.1 - span.0);
                table.axis_state(&format!("{name} at {t:.2}"), &motion.axis_state(t).expect("a state"));
                table.number(&format!("{name} at {t:.2}: error estimate"), motion.error_estimate(t));
            }
        }
        let motion = propagate_orientation_by_splitting(&STAR, &s, &state(), SPAN, scheme, 0.3).expect("a motion");
        look(&mut table, &format!("{}, orientation", scheme.name), &motion);
    }
    for accuracy in [1e-4, 1e-9] {
        let motion = propagate_by_best_splitting(&STAR, &s, &axis, SPAN, accuracy).expect("a motion");
        table.text("best", motion.scheme().name);
        table.axis_state("best", &motion.axis_state(20.0).expect("a state"));
        let motion = propagate_orientation_by_best_splitting(&STAR, &s, &state(), SPAN, accuracy).expect("a motion");
        look(&mut table, "best, orientation", &motion);
    }
    table.check("splitting");
}

/// The state itself.
struct Whole;

impl StateFunction for Whole {
    fn len(&self) -> usize {
        9
    }

    fn values<S: Real>(&self, _: &RigidSpheroid<S>, _: &Matrix3<S>, state: &BodyState<S>, values: &mut [S]) {
        let BodyState { axis, momentum, equatorial_axis } = state;
        values.iter_mut().zip(axis.iter().chain(momentum).chain(equatorial_axis)).for_each(|(value, x)| *value = *x);
    }
}

#[test]
fn gradients() {
    let mut table = Table::default();
    let weak = Parameters { violation: general() * 1e-3, ..start() };
    let none = Parameters { violation: Matrix3::zeros(), ..start() };
    let symmetric = Parameters { violation: tensor([0.02, 0.02, -0.03]), ..start() };
    let scenes = [
        ("general", start(), vec![None, Some(Method::Taylor), Some(Method::Averaged), Some(Method::Splitting)]),
        ("weak", weak, vec![Some(Method::Averaged)]),
        ("none", none, vec![Some(Method::Free)]),
        ("symmetric", symmetric, vec![Some(Method::Symmetric)]),
    ];
    let times = [[2.0, 0.0], [5.0, 0.25], [20.0, 0.5]];
    for (name, start, methods) in scenes {
        for method in methods {
            for (what, outputs) in [("whole", Output::EquatorialAxis), ("axis", Output::AngularMomentum)] {
                let all = Parameter::OF_MOTION.to_vec();
                let without_tensor: Vec<_> =
                    all.iter().copied().filter(|parameter| !matches!(parameter, Parameter::S(..))).collect();
                for derivatives in [all, without_tensor, Vec::new()] {
                    let count = derivatives.len();
                    let request = Request { method, derivatives, ..Request::new(&[outputs], SPAN, 3, 1e-10) };
                    let name = format!("{name}, {what}, {method:?}, {count}");
                    let found = Plan::from_parts(&start.spheroid, &start.violation, &start.state(), &request)
                        .and_then(|plan| gradient_in_parts(&plan, &start, &Whole, &times));
                    match found {
                        Ok(gradient) => {
                            table.parts(&format!("{name}: values"), gradient.values.transpose().iter().copied());
                            for jacobian in &gradient.jacobians {
                                for (column, derivatives) in jacobian.column_iter().enumerate() {
                                    table.parts(
                                        &format!("{name}: {column}"),
                                        derivatives.iter().map(|x| (x * 1e6).round() / 1e6),
                                    );
                                }
                            }
                        }
                        Err(error) => table.error(&name, &error),
                    }
                }
            }
        }
    }
    table.check("gradients");
}

#[test]
fn angles_that_count_turns() {
    let mut table = Table::default();
    let motion = propagate(&STAR, &general(), &state(), SPAN, 1e-11).expect("a motion");
    let mut angles = ContinuousAngles::new(
        &motion,
        SPAN.0,
        &EulerAngles { alpha: ANGLES.alpha + 12.0 * std::f64::consts::PI, ..ANGLES },
    )
    .expect("angles");
    for t in [2.0, 9.0, 31.0, 4.0] {
        let found = angles.at(t).expect("angles");
        table.parts(&format!("angles at {t}"), [found.alpha, found.beta, found.gamma]);
    }
    table.parts("rates", [RATES.alpha, RATES.beta, RATES.gamma]);
    table.check("angles_that_count_turns");
}
