//! Motions of every method: states, steps, estimates, forecasts.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use twofold::Real;
use twofold::dynamics::AxisState;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use twofold::euler_angles::{EulerAngles, EulerRates, body_from_inertial};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Method, Output, Request, StateFunction, gradient};
use twofold::propagation::splitting::SCHEMES;
use twofold::propagation::{
    AveragedMotion, ContinuousAngles, ErrorEstimates, Motion, SampledProblem, SymmetricMotion, UniformMotion,
    states_of_many,
};
use twofold::solutions::averaged::AveragingOrder;
use twofold::solutions::free::{free_precession_rates, free_rotation};
use twofold::solutions::perturbation::Precession;
use twofold::solutions::steady::steady_precession_rate;

use crate::values::scene::{ANGLES, PROLATE, STAR, general, start, state, tensor};
use crate::values::table::Table;

const SPAN: (f64, f64) = (2.0, 31.0);
const BACK: (f64, f64) = (2.0, -17.0);

/// States and error estimates of a motion; times in two parts are the same as their sum.
fn look<M: Motion<f64, State = BodyState<f64>>>(table: &mut Table, name: &str, motion: &M) {
    let (from, to) = motion.span();
    for share in [0.31, 1.0] {
        let t = from + share * (to - from);
        table.found(name, motion.state(t), |table, state| {
            table.row(&format!("{name}, t {t:.2}"), &[("", &state), ("error", &motion.error_estimate(t))]);
            if let (Ok(whole), Ok(axis)) =
                (motion.state_in_parts([0.75 * t, 0.25 * t]), motion.axis_state_in_parts([0.5 * t, 0.5 * t]))
            {
                let difference =
                    (whole.axis - state.axis).norm() + (whole.equatorial_axis - state.equatorial_axis).norm();
                let of_axis = (axis.axis - state.axis).norm() + (axis.momentum - state.momentum).norm();
                assert!(difference < 1e-9 && of_axis < 1e-9, "{name} at {t}: {difference:e}, {of_axis:e}");
            }
        });
    }
    assert!(motion.state(to + (to - from)).is_err(), "{name}: after its span");
}

#[test]
fn closed_forms() {
    let mut table = Table::default();
    for (name, span) in [("free", SPAN), ("free backwards", BACK)] {
        let motion = UniformMotion::free(&Problem::new(STAR, general() * 1e-6, state()).expect("a problem"), span);
        look(&mut table, name, &motion);
        for t in [5.0, 1e6] {
            let (truncation, rounding) = (motion.truncation(t), motion.rounding(t));
            table.row(&format!("{name}, after {t}"), &[("truncation", &truncation), ("rounding", &rounding)]);
        }
    }
    table.row("free rotation", &[("", &free_rotation(&STAR, &state(), 7.3))]);
    let rates = free_precession_rates(&STAR, 1.9, 0.8).expect("rates");
    table.row("free precession", &[("alpha, beta, gamma", &[rates.alpha, rates.beta, rates.gamma])]);
    steady(&mut table);
    table.check("closed_forms");
}

/// About the symmetry axis of a tensor, with either root; and at rest on a principal axis.
fn steady(table: &mut Table) {
    let s = PrincipalCoefficients::new([0.02, 0.02, -0.03]);
    let turn = body_from_inertial(&EulerAngles { alpha: -0.3, beta: 0.6, gamma: 0.2 });
    let look_at = |table: &mut Table, name: &str, s: &Matrix3<f64>, initial: &BodyState<f64>, span| {
        table.found(
            name,
            Problem::new(STAR, *s, *initial).and_then(|problem| UniformMotion::steady(&problem, span)),
            |table, motion| {
                look(table, name, &motion);
                let (rounding, truncation) = (motion.rounding(50.0), motion.truncation(50.0));
                table.row(&format!("{name}, after 50"), &[("rounding", &rounding), ("truncation", &truncation)]);
            },
        );
    };
    for kind in [Precession::Twofold, Precession::Single] {
        let (spin, beta) = (1.9, 0.8);
        let rate = steady_precession_rate(kind, &STAR, &s, spin, beta).expect("a rate");
        table.row(&format!("steady {kind:?}"), &[("rate", &rate)]);
        let angles = EulerAngles { alpha: 0.4, beta, gamma: 0.1 };
        let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
        let given = BodyState::from_angles(&STAR, &angles, &rates).rotated(&turn.transpose());
        let s = turn.transpose() * s.tensor() * turn;
        for span in [SPAN, BACK] {
            look_at(table, &format!("steady {kind:?} to {}", span.1), &s, &given, span);
        }
        let off = BodyState { momentum: given.momentum * (1.0 + 1e-9), ..given };
        table.refusal(
            &format!("not steady {kind:?}"),
            Problem::new(STAR, s, off).and_then(|problem| UniformMotion::steady(&problem, SPAN)),
        );
    }
    let s = PrincipalCoefficients::new([0.021, -0.004, 0.009]).tensor();
    for size in [3.0, 0.0, -2.0] {
        let at_rest = BodyState { axis: Vector3::z(), momentum: Vector3::z() * size, equatorial_axis: Vector3::x() };
        look_at(table, &format!("axis at rest, L {size}"), &s, &at_rest, SPAN);
    }
}

#[test]
fn symmetric_motions() {
    let mut table = Table::default();
    let moving = |angles: EulerAngles<f64>, alpha, beta, gamma| {
        BodyState::from_angles(&STAR, &angles, &EulerRates { alpha, beta, gamma })
    };
    let upright = moving(EulerAngles { alpha: 0.1, beta: 1e-4, gamma: 0.0 }, 0.3, 2e-4, 0.9);
    let oblate = tensor([0.02, 0.02, -0.03]);
    for (name, s, initial) in [
        ("oblate tensor", oblate, state()),
        ("prolate tensor", tensor([-0.01, 0.025, -0.01]), state()),
        ("strong tensor", tensor([0.2, 0.2, -0.3]), state()),
        ("nearly symmetric", tensor([0.02, 0.02 + 1e-9, -0.03]), state()),
        ("hardly turning", oblate, moving(ANGLES, 0.02, -0.01, 0.03)),
        ("swinging over the equator", oblate, moving(ANGLES, 0.0, 0.2, 0.0)),
        ("near the pole", PrincipalCoefficients::new([0.02, 0.02, -0.03]).tensor(), upright),
    ] {
        for span in [SPAN, BACK] {
            let name = format!("{name} to {}", span.1);
            table.found(
                &name,
                Problem::new(STAR, s, initial).and_then(|problem| SymmetricMotion::new(&problem, span)),
                |table, motion| {
                    look(table, &name, &motion);
                    for t in [-400.0, 1e7] {
                        let (truncation, rounding) = (motion.truncation(t), motion.rounding(t));
                        table.row(
                            &format!("{name}, after {t}"),
                            &[("truncation", &truncation), ("rounding", &rounding)],
                        );
                    }
                },
            );
        }
    }
    table.check("symmetric_motions");
}

#[test]
fn mean_motions() {
    let mut table = Table::default();
    for (name, s, initial) in [
        ("general", general() * 0.1, state()),
        ("weak", general() * 1e-7, state()),
        ("two equal", tensor([0.002, 0.002, -0.003]), state()),
        ("upside down", general() * 0.1, BodyState { momentum: -state().momentum, ..state() }),
        ("n on L", general() * 0.01, BodyState { momentum: state().axis * 2.0, ..state() }),
    ] {
        for order in [AveragingOrder::First, AveragingOrder::Second] {
            let name = format!("{name}, {order:?}");
            table.found(
                &name,
                Problem::new(STAR, s, initial).and_then(|problem| AveragedMotion::new(&problem, SPAN, order)),
                |table, motion| {
                    look(table, &name, &motion);
                    let mean = &motion.mean;
                    let rates = &mean.rates;
                    table.row(
                        &name,
                        &[
                            ("rates", &[rates.slow, rates.about_momentum, rates.about_axis]),
                            ("strength", &mean.relative_strength),
                        ],
                    );
                    for t in [40.0, -7.0] {
                        table.row(
                            &format!("{name}, t {t}"),
                            &[
                                ("truncation", &mean.truncation(t - SPAN.0)),
                                ("rounding", &mean.rounding(t - SPAN.0)),
                                ("of the averaged motion", &mean.truncation(t)),
                                ("and", &mean.rounding(t)),
                                ("error", &mean.error_estimate(t)),
                            ],
                        );
                    }
                    let turns = mean.turns([25.0 - SPAN.0, 1e-3]);
                    let turns = [turns.slow, turns.about_momentum, turns.about_axis];
                    table.row(
                        &format!("{name}, turns"),
                        &[
                            ("whole", &turns.map(|turns| turns.whole as f64)),
                            ("fraction", &turns.map(|turns| turns.fraction)),
                            ("angle", &turns.map(|turns| turns.angle())),
                        ],
                    );
                    look(table, &format!("{name}, near 20.5"), &motion.near([20.0, 0.5]).expect("within the span"));
                    table.refusal(&format!("{name}, near 40"), motion.near([40.0, 0.0]));
                    table.refusal(&format!("{name}, derivatives"), mean.require_derivatives());
                },
            );
        }
    }
    table.check("mean_motions");
}

#[test]
fn taylor_series() {
    let mut table = Table::default();
    let s = general();
    let axis = AxisState::from(&state());
    for tolerance in [1e-14, 1e-11, 1e-5] {
        for span in [SPAN, BACK] {
            let name = format!("{tolerance:e} to {}", span.1);
            let forecast = Problem::new(STAR, s, state())
                .and_then(|problem| problem.taylor_forecast(span.1 - span.0, tolerance))
                .expect("a forecast");
            table.row(
                &format!("{name}, forecast"),
                &[("order", &forecast.order), ("steps", &forecast.steps), ("rounding", &forecast.rounding)],
            );
            let motion =
                Problem::new(STAR, s, state()).and_then(|problem| problem.taylor(span, tolerance)).expect("a motion");
            table.row(&name, &[("steps", &motion.step_count), ("order", &motion.order)]);
            look(&mut table, &name, &motion);
            let motion =
                Problem::new(STAR, s, axis).and_then(|problem| problem.taylor(span, tolerance)).expect("a motion");
            let middle = 0.5 * (span.0 + span.1);
            table.row(
                &format!("{name}, axis"),
                &[
                    ("steps", &motion.step_count),
                    ("order", &motion.order),
                    ("", &motion.axis_state(middle).expect("a state")),
                    ("error", &motion.error_estimate(middle)),
                ],
            );
        }
    }
    let times = [2.0, 3.5, 9.0, 9.0, 31.0];
    for estimates in [ErrorEstimates::Wanted, ErrorEstimates::NotWanted] {
        let found = Problem::new(STAR, s, state())
            .and_then(|problem| problem.taylor_states(SPAN.0, &times, 1e-11, estimates))
            .expect("states");
        table.row("samples", &[("steps", &found.step_count), ("order", &found.order)]);
        for (i, state) in found.states.iter().enumerate() {
            let error = found.error_estimates.get(i).copied();
            table.row(&format!("sample at {}", times[i]), &[("", state), ("error", &error)]);
        }
    }
    let back = Problem::new(STAR, s, axis)
        .and_then(|problem| problem.taylor_states(2.0, &[1.0, -5.0], 1e-9, ErrorEstimates::Wanted))
        .expect("states");
    for (state, error) in back.states.iter().zip(&back.error_estimates) {
        table.row("axis backwards", &[("", state), ("error", error)]);
    }
    for (name, times) in [("times not in order", &[5.0, 4.0, 6.0][..]), ("no times", &[])] {
        table.refusal(
            name,
            Problem::new(STAR, s, state())
                .and_then(|problem| problem.taylor_states(2.0, times, 1e-9, ErrorEstimates::NotWanted)),
        );
    }
    dual_samples(&mut table);
    table.check("taylor_series");
}

/// By duals, which go without vectors of doubles.
fn dual_samples(table: &mut Table) {
    let (lift, slope) = (Dual64::from_re, |v: &Vector3<Dual64>| v.map(|x| x.eps));
    let star = RigidSpheroid { inertia_xx: Dual64::new(1.3, 1.0), inertia_zz: lift(1.7), constant_c: lift(0.8) };
    let (s, given) = (general().map(lift), state());
    let initial = BodyState {
        axis: given.axis.map(lift),
        momentum: given.momentum.map(lift),
        equatorial_axis: given.equatorial_axis.map(lift),
    };
    let found = Problem::new(star, s, initial)
        .and_then(|problem| problem.taylor_states(2.0, &[3.0, 12.0], 1e-11, ErrorEstimates::Wanted))
        .expect("states");
    for (state, error) in found.states.iter().zip(&found.error_estimates) {
        let BodyState { axis, momentum, equatorial_axis } = *state;
        let slopes =
            BodyState { axis: slope(&axis), momentum: slope(&momentum), equatorial_axis: slope(&equatorial_axis) };
        let value = equatorial_axis.map(|x| x.re());
        table.row("by I^xx", &[("derivatives", &slopes), ("e_x", &value), ("error", error)]);
    }
    let motion = Problem::new(star, s, initial).and_then(|problem| problem.taylor(SPAN, 1e-11)).expect("a motion");
    table.row(
        "dense, t 17",
        &[
            ("e_x by I^xx", &slope(&motion.state(lift(17.0)).expect("a state").equatorial_axis)),
            ("n by I^xx and t", &slope(&motion.state(Dual64::new(17.0, 1.0)).expect("a state").axis)),
            ("error", &motion.error_estimate(17.0)),
        ],
    );
}

/// Each motion is that of its own, within the tolerance.
#[test]
fn many_axes() {
    let mut table = Table::default();
    let mut look = |name: &str, motions: &[SampledProblem<'_>]| {
        for (k, (motion, found)) in motions.iter().zip(states_of_many(motions)).enumerate() {
            let SampledProblem { problem, start, times, tolerance } = motion;
            let name = format!("{name}, {k}");
            table.found(&name, found, |table, found| {
                let last = found.states.last().expect("a state");
                table.row(&name, &[("steps", &found.step_count), ("order", &found.order), ("last", last)]);
                let tolerance = tolerance.max(1e-13);
                let alone = problem.taylor_states(*start, times, tolerance, ErrorEstimates::NotWanted).expect("states");
                assert_eq!(found.states.len(), times.len(), "{name}");
                for (state, alone) in found.states.iter().zip(&alone.states) {
                    let difference = (state.axis - alone.axis).norm() + (state.momentum - alone.momentum).norm();
                    assert!(difference < 10.0 * tolerance, "{name}: {difference:e}");
                }
            });
        }
    };
    let times: Vec<Vec<f64>> = (0..11).map(|k| vec![0.5 * f64::from(k) + 1.0, 3.0 * f64::from(k) + 4.0]).collect();
    let motion = |star, k: usize, times, tolerance| {
        let problem = Problem::new(star, general() * (1.0 + 0.1 * k as f64), AxisState::from(&state()));
        SampledProblem { problem: problem.expect("a problem"), start: 0.5, times, tolerance }
    };
    let mut motions: Vec<_> =
        times.iter().enumerate().map(|(k, times)| motion(STAR, k, times, if k == 3 { 1e-5 } else { 1e-11 })).collect();
    look("all good", &motions);
    motions[7].tolerance = 1.0;
    look("one refused", &motions);
    // So many times that steps of a splitting would be cut short: series of three orders, in turn.
    let dense: Vec<Vec<f64>> =
        (0..13).map(|k| (0..110 + k).map(|j| 0.6 + 0.03 * f64::from(k) + 0.025 * f64::from(j)).collect()).collect();
    let star = |k: usize| if k % 4 == 1 { PROLATE } else { STAR };
    let tolerance = |k: usize| [1e-5, 1e-15, 1e-10][k % 3];
    let mut series: Vec<_> =
        dense.iter().enumerate().map(|(k, times)| motion(star(k), k, times, tolerance(k))).collect();
    // Backwards, and one that is too long for its steps.
    let back: Vec<f64> = dense[6].iter().rev().copied().collect();
    series[6] = SampledProblem { start: 5.0, times: &back, ..series[6] };
    series[9] = SampledProblem { times: &[1.0, 1e12], tolerance: 1e-15, ..series[9] };
    look("series", &series);
    table.check("many_axes");
}

#[test]
fn splitting() {
    let mut table = Table::default();
    let s = general();
    let axis = AxisState::from(&state());
    for span in [SPAN, BACK, (0.0, 1e5)] {
        for tolerance in [1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 1e-16] {
            for (of, s) in [("s", s), ("s / 1e3", s * 1e-3)] {
                let name = format!("{of} to {} within {tolerance:e}", span.1);
                table.found(
                    &name,
                    Problem::new(STAR, s, axis).and_then(|problem| problem.splitting_forecast(span, tolerance)),
                    |table, found| {
                        table.row(
                            &name,
                            &[
                                ("", &found.scheme.name),
                                ("step", &found.step),
                                ("steps", &found.steps),
                                ("truncation", &found.truncation),
                                ("coverage", &found.coverage),
                                ("rounding", &found.rounding),
                            ],
                        );
                    },
                );
            }
        }
    }
    let see = |table: &mut Table, name: &str, motion: &dyn Motion<f64, State = AxisState<f64>>, t: f64| {
        let (state, error) = (motion.axis_state(t).expect("a state"), motion.error_estimate(t));
        table.row(&format!("{name}, t {t:.2}"), &[("", &state), ("error", &error)]);
    };
    for scheme in SCHEMES {
        for (span, step) in [(SPAN, 0.21), (BACK, 0.4)] {
            let name = format!("{} to {}", scheme.name, span.1);
            let motion = Problem::new(STAR, s, axis)
                .and_then(|problem| problem.splitting_by(scheme, span, step))
                .expect("a motion");
            table.row(&name, &[("step", &motion.step), ("steps", &motion.step_count)]);
            see(&mut table, &name, &motion, span.0 + 0.13 * (span.1 - span.0));
        }
        let motion = Problem::new(STAR, s, state())
            .and_then(|problem| problem.splitting_by(scheme, SPAN, 0.3))
            .expect("a motion");
        look(&mut table, &format!("{}, orientation", scheme.name), &motion);
    }
    for tolerance in [1e-4, 1e-9] {
        let motion =
            Problem::new(STAR, s, axis).and_then(|problem| problem.splitting(SPAN, tolerance)).expect("a motion");
        see(&mut table, &format!("best, {}", motion.scheme.name), &motion, 20.0);
        let motion =
            Problem::new(STAR, s, state()).and_then(|problem| problem.splitting(SPAN, tolerance)).expect("a motion");
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

/// The size of the state's derivatives by each parameter. Their components are held by `gradient-both-ways` and `gradient-reference`.
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
                    let found = plan.and_then(|plan| gradient(&plan, &start, &Whole, &times));
                    table.found(&name, found, |table, found| {
                        let value = found.values.row(1).norm();
                        let sizes: Vec<f64> = found.jacobians[1].column_iter().map(|column| column.norm()).collect();
                        let names = request.derivatives.iter().map(|by| by.symbol());
                        let mut cells: Vec<(&str, &dyn super::table::Written)> = vec![("value", &value)];
                        cells.extend(names.zip(&sizes).map(|(name, size)| (name, size as _)));
                        table.row(&name, &cells);
                    });
                }
            }
        }
    }
    table.check("gradients");
}

#[test]
fn angles_that_count_turns() {
    let mut table = Table::default();
    let motion =
        Problem::new(STAR, general(), state()).and_then(|problem| problem.taylor(SPAN, 1e-11)).expect("a motion");
    let turned = EulerAngles { alpha: ANGLES.alpha + 12.0 * std::f64::consts::PI, ..ANGLES };
    let mut angles = ContinuousAngles::new(&motion, SPAN.0, &turned).expect("angles");
    for t in [2.0, 9.0, 31.0, 4.0] {
        let found = angles.at(t).expect("angles");
        table.row(&format!("t {t}"), &[("alpha, beta, gamma", &[found.alpha, found.beta, found.gamma])]);
    }
    table.check("angles_that_count_turns");
}
