//! Measures the cost of the methods of a plan and prints the constants of `src/plan/cost.rs`:
//!
//! ```sh
//! cargo run -p twofold-tools --bin fit_cost
//! ```
//!
//! Each time is the shortest of many runs. The cost of a step is fitted by least squares of relative errors over the orders
//! for tolerances from 1e-2 to 1e-16, that of an evaluation over the same orders.

use std::hint::black_box;
use std::time::Instant;

use nalgebra::{DMatrix, DVector};
use twofold::Error;
use twofold::dynamics::{BodyState, Problem, RotationState};
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::wave_of_state;
use twofold::observables::pulsar::Beam;
use twofold::observables::spectrum::QuasiPeriodicMotion;
use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Cost, Method, Output, PlannedMotion, Request, State, gradient};
use twofold::propagation::Motion;
use twofold_tools::least_time;
use twofold_verify::reference::reference_motion;

/// The shortest time of many runs, in ns.
fn time<T>(mut run: impl FnMut() -> T) -> f64 {
    let once = 1e9 * least_time(3, &mut run);
    let runs = ((1e6 / once) as u32).clamp(1, 100_000);
    1e9 / f64::from(runs) * least_time(60, || (0..runs).for_each(|_| drop(black_box(run()))))
}

const SPAN: (f64, f64) = (0.0, 200.0);

/// The time of a state of a motion, evaluated by its axis, in ns.
fn time_of_state(axis_at: impl Fn(f64) -> Result<f64, Error>) -> f64 {
    time(|| (0..1000).map(|i| axis_at(0.2 * f64::from(i)).unwrap_or(0.0)).sum::<f64>()) / 1e3
}

/// A motion, the time to compute it and the time of one of its states, in ns.
fn measured<X: RotationState<f64>>(
    problem: &Problem<f64, X>,
    method: Method,
    tolerance: f64,
) -> Result<(PlannedMotion<X>, f64, f64), Error> {
    let make = || problem.motion_by(method, SPAN, tolerance);
    let motion = make()?;
    let each = time_of_state(|t| Ok(motion.state(t)?.axis_state().axis.x));
    Ok((motion, time(make), each))
}

/// The vectors that a problem's motions carry.
fn state_of<X: RotationState<f64>>() -> State {
    if X::VECTORS == 3 { State::Orientation } else { State::AxisAndMomentum }
}

/// The least-squares solution for relative errors.
fn fit(rows: &[(Vec<f64>, f64)]) -> Vec<f64> {
    let (n, m) = (rows.len(), rows[0].0.len());
    let a = DMatrix::from_fn(n, m, |i, j| rows[i].0[j] / rows[i].1);
    let b = DVector::from_element(n, 1.0);
    let normal = a.transpose() * &a;
    let solution = normal.lu().solve(&(a.transpose() * b)).expect("the orders differ");
    solution.iter().copied().collect()
}

fn taylor<X: RotationState<f64>>(problem: &Problem<f64, X>) -> Result<(), Error> {
    let state = state_of::<X>();
    let (mut steps, mut evaluations) = (Vec::new(), Vec::new());
    for exponent in [-2, -4, -6, -8, -10, -12, -14, -16] {
        let tolerance = 10f64.powi(exponent);
        let (motion, total, each) = measured(problem, Method::Taylor, tolerance)?;
        let PlannedMotion::Taylor(series) = &motion else { unreachable!("asked for") };
        let (order, count) = (series.order, series.step_count);
        let p = order as f64;
        steps.push((vec![1.0, p, p * p], total / count as f64));
        evaluations.push((vec![1.0, p], each));
        println!(
            "  {} tolerance {tolerance:.0e}: order {order}, {count} steps, {:.0} ns a step, {each:.1} ns an evaluation",
            state.name(),
            total / count as f64
        );
    }
    let (step, evaluation) = (fit(&steps), fit(&evaluations));
    let model = Cost::of(Method::Taylor, state);
    let off = |rows: &[(Vec<f64>, f64)], c: &[f64]| {
        rows.iter().map(|(x, y)| (x.iter().zip(c).map(|(x, c)| x * c).sum::<f64>() / y - 1.0).abs()).fold(0.0, f64::max)
    };
    println!(
        "taylor, {}: step {step:.2?} (off by {:.0} %), evaluation {evaluation:.2?} (off by {:.0} %)",
        state.name(),
        100.0 * off(&steps, &step),
        100.0 * off(&evaluations, &evaluation)
    );
    println!(
        "  in the model: step {:?} (off by {:.0} %), evaluation {:?} (off by {:.0} %)",
        model.step,
        100.0 * off(&steps, &model.step),
        model.evaluation,
        100.0 * off(&evaluations, &model.evaluation)
    );
    Ok(())
}

fn splitting<X: RotationState<f64>>(problem: &Problem<f64, X>) -> Result<(), Error> {
    let state = state_of::<X>();
    for exponent in [-2, -4, -6, -8, -10, -12] {
        let tolerance = 10f64.powi(exponent);
        let (motion, total, each) = measured(problem, Method::Splitting, tolerance)?;
        let work = motion.work();
        let flows = work.right_hand_sides / work.steps;
        let model = Cost::of(Method::Splitting, state);
        println!(
            "  splitting, {}, tolerance {tolerance:.0e}: {flows} flows, {} steps, {:.1} ns a flow, {each:.0} ns an evaluation; in the model {:.1} and {:.0}",
            state.name(),
            work.steps,
            total / work.right_hand_sides,
            (model.setup / work.steps + model.step[0] + model.step[1] * flows) / flows,
            model.evaluation[0] + model.evaluation[1] * flows,
        );
    }
    Ok(())
}

fn closed(problem: &Problem<f64>, method: Method) -> Result<(), Error> {
    let (motion, total, full) = measured(problem, method, 1e-12)?;
    let axis = time_of_state(|t| Ok(motion.axis_state(t)?.axis.x));
    println!(
        "{}: setup {:.0}, evaluation {axis:.1} (n, L), {full:.1} (n, L, e_x); in the model {:?}",
        method.name(),
        total,
        Cost::of(method, State::Orientation)
    );
    Ok(())
}

/// All named lines of m.n, h_+ and h_x above 1e-12 of the strongest.
fn lines(problem: &Problem<f64>) -> Result<(), Error> {
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let wave = |state: &BodyState<f64>| {
        wave_of_state(problem.spheroid(), problem.coefficients(), &state.axis_state(), &observer)
    };
    let mut best = [f64::INFINITY; 2];
    let mut counts = [0; 3];
    for _ in 0..20 {
        let start = Instant::now();
        let motion = QuasiPeriodicMotion::new(problem)?;
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        let pulsar =
            motion.lines(1e-12, |state| Ok::<_, Error>([beam.direction(state).dot(&observer.direction), 1.0]))?;
        let plus = motion.lines(1e-12, |state| Ok::<_, Error>([wave(state).plus, 1.0]))?;
        let cross = motion.lines(1e-12, |state| Ok::<_, Error>([wave(state).cross, 1.0]))?;
        best[1] = best[1].min(start.elapsed().as_secs_f64());
        counts = [pulsar, plus, cross].map(|list| list.lines.len());
    }
    println!(
        "lines: frequencies {:.2} ms, all with {counts:?} lines of m.n, h_+, h_x above 1e-12 {:.2} ms",
        1e3 * best[0],
        1e3 * best[1]
    );
    Ok(())
}

/// Derivatives on the torus by ten parameters: set-up with one state after 1e6 t_c, and each further state.
fn torus_gradient(problem: &Problem<f64>) -> Result<(), Error> {
    let (spheroid, initial) = (problem.spheroid(), problem.initial());
    let start = Parameters::new(*spheroid, *problem.coefficients(), initial.angles()?, initial.rates(spheroid)?);
    let request = Request {
        method: Some(Method::Torus),
        derivatives: Parameter::OF_MOTION[3..13].to_vec(),
        ..Request::new(&[Output::EquatorialAxis], (0.0, 1e6), 1, 1e-12)
    };
    let plan = problem.plan(&request)?;
    let of = |count: u32| {
        let times: Vec<f64> = (1..=count).map(|k| 1e6 * f64::from(k) / f64::from(count)).collect();
        time(|| gradient(&plan, &start, &times))
    };
    let (one, many) = (of(1), of(101));
    println!("torus, gradient by 10 parameters at 1e6 t_c: {one:.0}, each state more {:.0}", (many - one) / 100.0);
    Ok(())
}

fn main() -> Result<(), Error> {
    let problem = |name: &str| -> Problem<f64, BodyState<f64>> { reference_motion(name).problem() };
    closed(&problem("free"), Method::Free)?;
    closed(&problem("free"), Method::Steady)?;
    closed(&problem("axisymmetric-violation"), Method::Symmetric)?;
    let tp_2 = problem("tp-2");
    closed(&tp_2, Method::Torus)?;
    lines(&tp_2)?;
    torus_gradient(&tp_2)?;
    splitting(&tp_2.reduced())?;
    splitting(&tp_2)?;
    taylor(&tp_2.reduced())?;
    taylor(&tp_2)
}
