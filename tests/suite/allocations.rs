//! Heap use of plans, counted by an allocator: not more than listed, and none inside a step.

use allocation_counter::{AllocationInfo, measure};
use twofold::Error;
use twofold::plan::{Method, Output, Plan, Request, State};
use twofold::propagation::Motion;
use twofold_verify::reference::{ReferenceMotion, reference_motion};

/// Computes the motion of a plan at its samples; returns the heap use without the plan.
fn carried_out(scene: &ReferenceMotion, plan: &Plan) -> Result<AllocationInfo, Error> {
    let problem = scene.problem();
    let times = |i: usize| plan.span.1 * i as f64 / plan.samples.max(2) as f64;
    let mut result = Ok(());
    let info = measure(|| {
        result = match plan.state {
            State::Nothing => Ok(()),
            State::Axis | State::AxisAndMomentum => plan
                .motion(&problem.reduced())
                .and_then(|motion| (0..plan.samples).try_for_each(|i| motion.axis_state(times(i)).map(drop))),
            State::Orientation => plan
                .motion(&problem)
                .and_then(|motion| (0..plan.samples).try_for_each(|i| motion.state(times(i)).map(drop))),
        };
    });
    result.map(|()| info)
}

/// Every output alone, and all together, by every method that the scene allows: free rotation and steady precession use no heap, elliptic functions
/// some short lists for the roots of a quartic, a numerical motion the predicted size of its dense output, up to a factor of two for the predicted
/// steps and of four for a growing vector; samples use none.
#[test]
fn plans_take_no_more_than_listed() -> Result<(), Error> {
    let alone = Output::ALL.map(|output| vec![output]);
    let together = [Output::ALL.to_vec()];
    for name in ["free", "axisymmetric-violation", "tp-2"] {
        let scene = reference_motion(name);
        for outputs in alone.iter().chain(&together) {
            let mut first = None;
            for samples in [10, 1000] {
                let request = Request::new(outputs, (0.0, 200.0), samples, 1e-10);
                let plan = scene.problem().plan(&request)?;
                let info = carried_out(&scene, &plan)?;
                let Some(prediction) = plan.prediction else {
                    assert_eq!((plan.state, info.count_total), (State::Nothing, 0), "{name}: {outputs:?}");
                    continue;
                };
                let place = format!("{name}: {outputs:?} by {:?}", plan.method);
                let listed = match plan.method {
                    Some(Method::Taylor | Method::Splitting) => 8.0 * prediction.memory.of_a_segment(1) + 4096.0,
                    _ => prediction.memory.of_a_segment(1),
                };
                assert!(info.bytes_total as f64 <= listed, "{place}: {} bytes, at most {listed}", info.bytes_total);
                assert_eq!(info.count_current, 0, "{place}: all is given back");
                match first.filter(|(method, _)| *method == plan.method) {
                    Some((_, first)) => assert_eq!(info.count_total, first, "{place}: samples take nothing"),
                    None => first = Some((plan.method, info.count_total)),
                }
            }
        }
    }
    Ok(())
}

/// Sixteen times as many steps take four more doublings of three vectors: a step itself allocates nothing.
#[test]
fn steps_take_nothing() -> Result<(), Error> {
    let problem = reference_motion("tp-2").problem();
    let count = |span: f64, full: bool| {
        let mut steps = Ok(0);
        let info = measure(|| {
            steps = if full {
                problem.taylor((0.0, span), 1e-10).map(|motion| motion.step_count)
            } else {
                problem.reduced().taylor((0.0, span), 1e-10).map(|motion| motion.step_count)
            };
        });
        steps.map(|steps| (steps, info.count_total))
    };
    for full in [false, true] {
        let ((few_steps, few), (many_steps, many)) = (count(100.0, full)?, count(1600.0, full)?);
        assert!(many_steps > 15 * few_steps, "{few_steps} and {many_steps} steps");
        assert!(many <= few + 3 * 6, "{few} allocations in {few_steps} steps, {many} in {many_steps}");
    }
    Ok(())
}

/// A plan itself consists of a few short lists, unless it tries the series on the torus.
#[test]
fn a_plan_is_small() -> Result<(), Error> {
    let problem = reference_motion("tp-2").problem();
    let request = Request::new(&Output::ALL, (0.0, 5.0), 10, 1e-13);
    let mut made = Err(Error::NotConverged { what: "plan", iterations: 0, residual: 0.0 });
    let info = measure(|| made = problem.plan(&request));
    made?;
    assert!(info.bytes_total < 16_384, "{} bytes", info.bytes_total);
    Ok(())
}
