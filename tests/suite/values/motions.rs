//! Motions by every method: states, errors, steps, predictions, derivatives.

use nalgebra::{Matrix3, Vector3};
use twofold::Error;
use twofold::dynamics::{BodyState, Problem, RotationState};
use twofold::euler_angles::{EulerAngles, EulerRates, body_from_inertial};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Method, Output, Request, gradient};
use twofold::propagation::splitting::SCHEMES;
use twofold::propagation::{ContinuousAngles, Motion, SampledProblem, states_of_many};
use twofold::solutions::perturbation::Precession;
use twofold::solutions::steady::steady_precession_rate;

use crate::values::scene::{ANGLES, PROLATE, STAR, general, problem, start, state, tensor};
use crate::values::table::Table;

const SPAN: (f64, f64) = (2.0, 31.0);
const BACK: (f64, f64) = (2.0, -17.0);

/// A component of each vector, and the error estimate, at 31 % of the span. A time in two parts equals its sum.
fn look<M: Motion<f64, State = BodyState<f64>>>(table: &mut Table, name: &str, motion: &M) {
    let (from, to) = motion.span();
    let t = from + 0.31 * (to - from);
    let parts = [motion.state(t), motion.state_in_parts([0.75 * t, 0.25 * t])];
    let [state, whole] = parts.map(|state| state.expect("a state"));
    let axis = motion.axis_state_in_parts([0.5 * t, 0.5 * t]).expect("a state");
    let difference = (whole.axis - state.axis).norm() + (whole.equatorial_axis - state.equatorial_axis).norm();
    let of_axis = (axis.axis - state.axis).norm() + (axis.momentum - state.momentum).norm();
    assert!(difference < 1e-9 && of_axis < 1e-9, "{name} at {t}: {difference:e}, {of_axis:e}");
    assert!(motion.state(to + (to - from)).is_err(), "{name}: after its span");
    let components = Vector3::new(state.axis.z, state.momentum.x, state.equatorial_axis.y);
    table.row(name, format_args!("{components:?}, error {:.2e}", motion.error_estimate(t)));
}

/// Tensors with and without symmetry, and motions that are slow, steady, at rest, near a pole or in the opposite sense.
fn problems() -> Vec<(String, Result<Problem<f64>, Error>)> {
    let moving = |angles: EulerAngles<f64>, alpha, beta, gamma| {
        BodyState::from_angles(&STAR, &angles, &EulerRates { alpha, beta, gamma })
    };
    let upright = EulerAngles { alpha: 0.1, beta: 1e-4, gamma: 0.0 };
    let oblate = tensor([0.02, 0.02, -0.03]);
    let of = |name: &str, s, initial| (name.to_string(), Problem::new(STAR, s, initial));
    let mut problems = vec![
        of("general", general(), state()),
        of("weak", general() * 1e-7, state()),
        of("upside down", general() * 0.1, BodyState { momentum: -state().momentum, ..state() }),
        of("n on L", general() * 0.01, BodyState { momentum: state().axis * 2.0, ..state() }),
        of("oblate tensor", oblate, state()),
        of("prolate tensor", tensor([-0.01, 0.025, -0.01]), state()),
        of("strong tensor", tensor([0.2, 0.2, -0.3]), state()),
        of("nearly symmetric", tensor([0.02, 0.02 + 1e-9, -0.03]), state()),
        of("hardly turning", oblate, moving(ANGLES, 0.02, -0.01, 0.03)),
        of("swinging over the equator", oblate, moving(ANGLES, 0.0, 0.2, 0.0)),
        of("near the pole", Matrix3::from_diagonal(&Vector3::new(0.02, 0.02, -0.03)), moving(upright, 0.3, 2e-4, 0.9)),
    ];
    let (spin, beta) = (1.9, 0.8);
    let s = PrincipalCoefficients::new([0.02, 0.02, -0.03]);
    let turn = body_from_inertial(&EulerAngles { alpha: -0.3, beta: 0.6, gamma: 0.2 });
    for kind in [Precession::Twofold, Precession::Single] {
        let rate = steady_precession_rate(kind, &STAR, &s, spin, beta).expect("a rate");
        let angles = EulerAngles { alpha: 0.4, beta, gamma: 0.1 };
        let steady = moving(angles, rate, 0.0, spin - rate * beta.cos()).rotated(&turn.transpose());
        let beside = BodyState { momentum: steady.momentum * (1.0 + 1e-9), ..steady };
        let s = turn.transpose() * s.tensor() * turn;
        problems.push(of(&format!("steady {kind:?} at the rate {rate}"), s, steady));
        problems.push(of(&format!("beside steady {kind:?}"), s, beside));
    }
    for size in [3.0, 0.0, -2.0] {
        let at_rest = BodyState { axis: Vector3::z(), momentum: Vector3::z() * size, equatorial_axis: Vector3::x() };
        let s = Matrix3::from_diagonal(&Vector3::new(0.021, -0.004, 0.009));
        problems.push(of(&format!("axis at rest, L {size}"), s, at_rest));
    }
    problems
}

#[test]
fn motions() {
    let mut table = Table::default();
    for (name, problem) in problems() {
        let problem = problem.expect("a problem");
        for method in Method::ALL {
            let motions = [SPAN, BACK].map(|span| problem.motion_by(method, span, 1e-9));
            let name = format!("{name} by {}", method.name());
            table.found(&name, motions.into_iter().collect::<Result<Vec<_>, _>>(), |table, motions| {
                for (motion, end) in motions.iter().zip([SPAN.1, BACK.1]) {
                    look(table, &format!("{name} to {end}"), motion);
                }
            });
        }
    }
    let turned = EulerAngles { alpha: ANGLES.alpha + 12.0 * std::f64::consts::PI, ..ANGLES };
    let motion = problem(general()).taylor(SPAN, 1e-11).expect("a motion");
    let mut angles = ContinuousAngles::new(&motion, SPAN.0, &turned).expect("angles");
    for t in [2.0, 9.0, 31.0, 4.0] {
        table.result(&format!("angles that count turns, t {t}"), angles.at(t));
    }
    table.check("motions");
}

#[test]
fn numerical_motions() {
    let mut table = Table::default();
    for span in [SPAN, BACK, (0.0, 1e5)] {
        for tolerance in [1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 1e-16] {
            for (of, s) in [("s", general()), ("s / 1e3", general() * 1e-3)] {
                let (name, reduced) = (format!("{of} to {} within {tolerance:e}", span.1), problem(s).reduced());
                table.found(&name, reduced.splitting_forecast(span, tolerance), |table, found| {
                    let (scheme, step, steps) = (found.scheme.name, found.step, found.steps);
                    let (truncation, coverage, rounding) = (found.truncation, found.coverage, found.rounding);
                    let text = format!("{scheme}, step {step:?}, steps {steps:?}, truncation {truncation:?}");
                    table.row(&name, format_args!("{text}, coverage {coverage:?}, rounding {rounding:?}"));
                });
                table.result("  by", reduced.taylor_forecast(span.1 - span.0, tolerance));
            }
        }
    }
    for tolerance in [1e-14, 1e-11, 1e-5] {
        for span in [SPAN, BACK] {
            let name = format!("Taylor series to {} within {tolerance:e}", span.1);
            let motion = problem(general()).taylor(span, tolerance).expect("a motion");
            let reduced = problem(general()).reduced().taylor(span, tolerance).expect("a motion");
            let steps = [(motion.step_count, motion.order), (reduced.step_count, reduced.order)];
            table.row(&name, format_args!("(steps, order) {steps:?} with e_x and without"));
            look(&mut table, &name, &motion);
            let middle = 0.5 * (span.0 + span.1);
            let state = reduced.axis_state(middle).expect("a state");
            table.row(&name, format_args!("{state:?}, error {:.2e}", reduced.error_estimate(middle)));
        }
    }
    for scheme in SCHEMES {
        for (span, step) in [(SPAN, 0.21), (BACK, 0.4)] {
            let (name, t) = (format!("{} to {}", scheme.name, span.1), span.0 + 0.13 * (span.1 - span.0));
            let reduced = problem(general()).reduced().splitting_by(scheme, span, step).expect("a motion");
            let (state, error) = (reduced.axis_state(t).expect("a state"), reduced.error_estimate(t));
            let (step, steps) = (reduced.step(), reduced.step_count());
            table.row(&name, format_args!("step {step:?}, steps {steps}, {state:?}, error {error:.2e}"));
        }
        let motion = problem(general()).splitting_by(scheme, SPAN, 0.3).expect("a motion");
        look(&mut table, &format!("{}, orientation", scheme.name), &motion);
    }
    for tolerance in [1e-4, 1e-9] {
        let (reduced, motion) = (problem(general()).reduced().splitting(SPAN, tolerance), problem(general()));
        let scheme = reduced.expect("a motion").scheme().name;
        let motion = motion.splitting(SPAN, tolerance).expect("a motion");
        let name = format!("best within {tolerance:e}: {scheme}, with e_x {}", motion.scheme().name);
        look(&mut table, &name, &motion);
    }
    table.check("numerical_motions");
}

#[test]
fn samples() {
    let mut table = Table::default();
    let times = [2.0, 3.5, 9.0, 9.0, 31.0];
    let problem = problem(general());
    table.result("orientation", problem.taylor_states(SPAN.0, &times, 1e-11));
    let back = problem.reduced().taylor_states(2.0, &[1.0, -5.0], 1e-9);
    table.result("axis backwards", back);
    for (name, times) in [("times not in order", &[5.0, 4.0, 6.0][..]), ("no times", &[])] {
        table.result(name, problem.taylor_states(2.0, times, 1e-9));
    }
    table.check("samples");
}

/// With so many times that the steps of a splitting would be cut short, series of three orders run side by side: each motion is the same as alone.
#[test]
fn dense_samples_of_many_motions_are_those_of_each_alone() {
    let dense: Vec<Vec<f64>> =
        (0..13).map(|k| (0..110 + k).map(|j| 0.6 + 0.03 * f64::from(k) + 0.025 * f64::from(j)).collect()).collect();
    let back: Vec<f64> = dense[6].iter().rev().copied().collect();
    let mut motions: Vec<_> = (0..13)
        .map(|k| {
            let star = if k % 4 == 1 { PROLATE } else { STAR };
            let problem = Problem::new(star, general() * (1.0 + 0.1 * k as f64), state().axis_state());
            let tolerance = [1e-5, 1e-15, 1e-10][k % 3];
            SampledProblem { problem: problem.expect("a problem"), start: 0.5, times: &dense[k], tolerance }
        })
        .collect();
    // Backwards, too long for its steps, and refused.
    motions[6] = SampledProblem { start: 5.0, times: &back, ..motions[6] };
    motions[9] = SampledProblem { times: &[1.0, 1e12], tolerance: 1e-15, ..motions[9] };
    motions[11].tolerance = 1.0;
    for (k, (motion, found)) in motions.iter().zip(states_of_many(&motions)).enumerate() {
        let SampledProblem { problem, start, times, tolerance } = motion;
        let alone = problem.taylor_states(*start, times, *tolerance);
        assert_eq!(found.is_err(), [9, 11].contains(&k), "{k}: {found:?}");
        let (Ok(found), Ok(alone)) = (found, alone) else { continue };
        assert_eq!(found.states.len(), times.len(), "{k}");
        for (state, alone) in found.states.iter().zip(&alone.states) {
            let difference = (state.axis - alone.axis).norm() + (state.momentum - alone.momentum).norm();
            assert!(difference < 10.0 * tolerance.max(1e-13), "{k}: {difference:e}");
        }
    }
}

/// The size of the state's derivatives by each parameter. `gradient-both-ways` and `gradient-reference` test their components.
#[test]
fn gradients() {
    let mut table = Table::default();
    let of = |coefficients| Parameters { coefficients, ..start() };
    let scenes = [
        ("general", start(), vec![None, Some(Method::Taylor), Some(Method::Averaged), Some(Method::Splitting)]),
        ("weak", of(general() * 1e-3), vec![Some(Method::Averaged)]),
        ("none", of(Matrix3::zeros()), vec![Some(Method::Free)]),
        ("symmetric", of(tensor([0.02, 0.02, -0.03])), vec![Some(Method::Symmetric)]),
    ];
    let all = Parameter::OF_MOTION.to_vec();
    let without_tensor: Vec<_> = all.iter().copied().filter(|by| !matches!(by, Parameter::S(..))).collect();
    for (name, start, methods) in scenes {
        for method in methods {
            for output in [Output::EquatorialAxis, Output::AngularMomentum] {
                for derivatives in [all.clone(), without_tensor.clone(), Vec::new()] {
                    let name = format!("{name}, {}, {method:?}, {}", output.name(), derivatives.len());
                    let request = Request { method, derivatives, ..Request::new(&[output], SPAN, 3, 1e-10) };
                    let plan = Problem::new(start.spheroid, start.coefficients, start.state())
                        .and_then(|problem| problem.plan(&request));
                    let times = [2.0, 20.5];
                    let found = plan.and_then(|plan| gradient(&plan, &start, &times));
                    table.found(&name, found, |table, found| {
                        let sizes = found.jacobians[1].column_iter().map(|column| column.norm());
                        let by: Vec<_> = request.derivatives.iter().map(|by| by.symbol()).zip(sizes).collect();
                        table.row(&name, format_args!("value {:?}, by {by:?}", found.values.row(1).norm()));
                    });
                }
            }
        }
    }
    table.check("gradients");
}
