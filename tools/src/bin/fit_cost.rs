//! Measures what the methods of a plan cost and prints the constants of `src/plan/cost.rs`:
//!
//! ```sh
//! cargo run -p twofold-tools --bin fit_cost
//! ```
//!
//! Each time is the least of many runs. The cost of a step is fitted over the orders that accuracies from 1e-2 to 1e-16 give,
//! that of an evaluation over the same orders, by least squares of relative errors.

use std::hint::black_box;
use std::time::Instant;

use nalgebra::{DMatrix, DVector, Matrix3};
use twofold::Error;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::plan::{Cost, Method, PlannedAxisMotion, PlannedMotion, State};
use twofold::propagation::Motion;
use twofold_verify::reference::reference_motion;

/// The least time of many runs, in ns.
fn time<T>(mut run: impl FnMut() -> T) -> f64 {
    let mut best = f64::INFINITY;
    let mut runs = 1;
    for _ in 0..60 {
        let start = Instant::now();
        for _ in 0..runs {
            black_box(run());
        }
        let each = start.elapsed().as_secs_f64() * 1e9 / f64::from(runs);
        best = best.min(each);
        runs = ((1e6 / each) as u32).clamp(1, 100_000);
    }
    best
}

struct Case {
    spheroid: RigidSpheroid<f64>,
    s: Matrix3<f64>,
    initial: BodyState<f64>,
}

/// The least-squares solution that makes relative errors small.
fn fit(rows: &[(Vec<f64>, f64)]) -> Vec<f64> {
    let (n, m) = (rows.len(), rows[0].0.len());
    let a = DMatrix::from_fn(n, m, |i, j| rows[i].0[j] / rows[i].1);
    let b = DVector::from_element(n, 1.0);
    let normal = a.transpose() * &a;
    let solution = normal.lu().solve(&(a.transpose() * b)).expect("the orders differ");
    solution.iter().copied().collect()
}

fn taylor(case: &Case, state: State) -> Result<(), Error> {
    let Case { spheroid, s, initial } = case;
    let span = (0.0, 200.0);
    let (mut steps, mut evaluations) = (Vec::new(), Vec::new());
    for exponent in [-2, -4, -6, -8, -10, -12, -14, -16] {
        let accuracy = 10f64.powi(exponent);
        let times: Vec<f64> = (0..1000).map(|i| 0.2 * f64::from(i)).collect();
        let (order, count, total, each) = if state == State::Orientation {
            let make = || PlannedMotion::by(Method::Taylor, spheroid, s, initial, span, accuracy);
            let motion = make()?;
            let PlannedMotion::Taylor(series) = &motion else { unreachable!("asked for") };
            let each = time(|| times.iter().map(|&t| motion.state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
            (series.order(), series.step_count(), time(make), each)
        } else {
            let make = || PlannedAxisMotion::axis_by(Method::Taylor, spheroid, s, initial, span, accuracy);
            let motion = make()?;
            let PlannedAxisMotion::Taylor(series) = &motion else { unreachable!("asked for") };
            let each =
                time(|| times.iter().map(|&t| motion.axis_state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
            (series.order(), series.step_count(), time(make), each)
        };
        let p = order as f64;
        steps.push((vec![1.0, p, p * p], total / count as f64));
        evaluations.push((vec![1.0, p], each));
        println!(
            "  {} accuracy {accuracy:.0e}: order {order}, {count} steps, {:.0} ns a step, {each:.1} ns an evaluation",
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

fn splitting(case: &Case, state: State) -> Result<(), Error> {
    let Case { spheroid, s, initial } = case;
    let span = (0.0, 200.0);
    for exponent in [-2, -4, -6, -8, -10, -12] {
        let accuracy = 10f64.powi(exponent);
        let times: Vec<f64> = (0..1000).map(|i| 0.2 * f64::from(i)).collect();
        let (work, total, each) = if state == State::Orientation {
            let make = || PlannedMotion::by(Method::Splitting, spheroid, s, initial, span, accuracy);
            let motion = make()?;
            let each = time(|| times.iter().map(|&t| motion.state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
            (motion.work(), time(make), each)
        } else {
            let make = || PlannedAxisMotion::axis_by(Method::Splitting, spheroid, s, initial, span, accuracy);
            let motion = make()?;
            let each =
                time(|| times.iter().map(|&t| motion.axis_state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
            (motion.work(), time(make), each)
        };
        let flows = work.right_hand_sides / work.steps;
        let model = Cost::of(Method::Splitting, state);
        println!(
            "  splitting, {}, accuracy {accuracy:.0e}: {flows} flows, {} steps, {:.1} ns a flow, {each:.0} ns an evaluation; in the model {:.1} and {:.0}",
            state.name(),
            work.steps,
            total / work.right_hand_sides,
            (model.setup / work.steps + model.step[0] + model.step[1] * flows) / flows,
            model.evaluation[0] + model.evaluation[1] * flows,
        );
    }
    Ok(())
}

fn closed(case: &Case, method: Method) -> Result<(), Error> {
    let Case { spheroid, s, initial } = case;
    let make = || PlannedMotion::by(method, spheroid, s, initial, (0.0, 200.0), 1e-12);
    let motion = make()?;
    let times: Vec<f64> = (0..1000).map(|i| 0.2 * f64::from(i)).collect();
    let axis = time(|| times.iter().map(|&t| motion.axis_state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
    let full = time(|| times.iter().map(|&t| motion.state(t).map_or(0.0, |x| x.axis.x)).sum::<f64>()) / 1e3;
    println!(
        "{}: setup {:.0}, evaluation {axis:.1} (n, L), {full:.1} (n, L, e_x); in the model {:?}",
        method.name(),
        time(make),
        Cost::of(method, State::Orientation)
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    let case = |name: &str| {
        let scene = reference_motion(name);
        Case { spheroid: scene.spheroid, s: scene.violation(), initial: scene.initial() }
    };
    closed(&case("free"), Method::Free)?;
    closed(&case("free"), Method::Steady)?;
    closed(&case("axisymmetric-violation"), Method::Symmetric)?;
    splitting(&case("tp-2"), State::AxisAndMomentum)?;
    splitting(&case("tp-2"), State::Orientation)?;
    taylor(&case("tp-2"), State::AxisAndMomentum)?;
    taylor(&case("tp-2"), State::Orientation)
}
