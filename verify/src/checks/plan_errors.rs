//! The predicted errors of plans compared with true ones, for every method in random scenes for which it is intended.

use twofold::plan::{Output, Plan, Promise, Request, gradient};

use super::plans::first_state;
use crate::prelude::*;

checks! {
    /// a bound or an estimate that a plan predicts, with its rounding, is not below the true error: free, steady, symmetric, averaged and exact motion,
    /// 100 random scenes each up to 60 rad
    Oracle "plan-error-bounds" [25]: bounds;
    AtMost(1.0) "largest true error / (predicted error of the method + of rounding)";
    because "a bound or an estimate below the true error is wrong";
    /// the share of random motions that miss the goal of their plan is not above the share that the plan states: splitting, the states of splitting with
    /// derivatives, and Taylor series, 300 scenes of every kind each up to 60 rad, four in ten of them beside the middle axis
    Oracle "plan-error-goals" [25]: goals;
    AtMost(1.0) "largest share of true errors above (predicted error of the method + of rounding) / the share allowed";
    because "the shares, 1, 5 and 1 %, are those of 3,000 such scenes to 2,000 t_c and of 10,000 with strong torques (0.6, 3.5 and 0.3 % at most), \
     rounded up";
    /// splitting predicts its goal from its steps instead of repeating the tolerance: in the same scenes the goal is not far above the true error
    /// either
    Oracle "plan-error-goals-not-idle" [25]: not_idle;
    AtMost(100.0) "median of (predicted error of the method + of rounding) / true error";
    because "ten times the model of the error, which for half of the motions is less than ten times the true one";
    /// the rounding that a plan predicts for a numerical motion agrees with the motion's error estimate: tolerance 1e-16, off the middle axis,
    /// 200 random scenes by Taylor series and by splitting, from 5 rad to 2000 t_c
    Property "plan-rounding" [25]: rounding;
    AtMost(0.05) "share of estimates more than ten times above or below the prediction";
    because "the forecast takes equal steps, the largest torque and constants rounded by half a unit in the last place; over a radian or less the \
     estimate of splitting is far above the forecast and above the true error";
}

/// Seed of the scenes.
const SEED: u64 = 5;

/// Longest rotation of motions that are compared with true ones (rad).
const LONGEST: f64 = 60.0;

/// Scenes for which a method is made, ending at the requested time.
fn scenes(method: Method) -> impl Iterator<Item = (u64, ErrorScene)> {
    (0_u64..).filter_map(move |number| {
        let seed = SEED ^ number.wrapping_mul(0x9e37_79b9);
        let scene = ErrorScene::draw(SEED, number).for_method(method, seed)?;
        Some((number, ErrorScene { span: (scene.span.0, scene.time), ..scene }))
    })
}

fn plan(scene: &ErrorScene, method: Method, derivatives: &[Parameter]) -> Result<Plan, twofold::Error> {
    let request = Request {
        method: Some(method),
        derivatives: derivatives.to_vec(),
        ..Request::new(&[Output::EquatorialAxis], scene.span, 3, scene.tolerance)
    };
    scene.problem.plan(&request)
}

/// Predicted error, true error and the promise of the plan; `None` if the method refuses the scene.
fn foreseen_and_true(
    scene: &ErrorScene,
    method: Method,
    derivatives: &[Parameter],
) -> Result<Option<(f64, f64, Promise)>, String> {
    let Ok(plan) = plan(scene, method, derivatives) else { return Ok(None) };
    let prediction = plan.prediction.ok_or("a plan without a prediction")?;
    let state = if derivatives.is_empty() {
        plan.motion(&scene.problem)?.state(scene.time)?
    } else {
        let (spheroid, initial) = (*scene.problem.spheroid(), scene.problem.initial());
        let (Ok(angles), Ok(rates)) = (initial.angles(), initial.rates(&spheroid)) else { return Ok(None) };
        let start = Parameters::new(spheroid, *scene.problem.coefficients(), angles, rates);
        first_state(&gradient(&plan, &start, &[scene.time])?.values)
    };
    let error = scene.true_error(&state);
    Ok(Some((prediction.truncation + prediction.rounding, error, prediction.promise)))
}

/// The first `count` motions of a method that are short enough, each with the number of its scene.
fn found(method: Method, derivatives: &[Parameter], count: usize) -> Result<Vec<(u64, f64, f64, Promise)>, String> {
    let mut all = Vec::new();
    for (number, scene) in scenes(method).filter(|(_, scene)| scene.turned() < LONGEST).take(3 * count) {
        let found = foreseen_and_true(&scene, method, derivatives)
            .map_err(|why| format!("{}, scene {number} of seed {SEED}: {why}", method.name()))?;
        if let Some((foreseen, error, promise)) = found {
            all.push((number, foreseen, error, promise));
        }
        if all.len() == count {
            return Ok(all);
        }
    }
    Err(format!("{}: only {} of {} scenes were computed", method.name(), all.len(), 3 * count))
}

fn bounds() -> Result<Measured, String> {
    worst_of([Method::Free, Method::Steady, Method::Symmetric, Method::Averaged, Method::Torus], |&method| {
        worst_of(found(method, &[], 100)?, |(_, foreseen, error, promise)| match promise {
            Promise::Goal(_) => Err(format!("{} promises {promise:?}", method.name())),
            _ => Ok(error / foreseen),
        })
    })
}

/// Splitting, with derivatives where the processor has them, and Taylor series.
fn goals() -> Result<Measured, String> {
    let with_derivatives = (Method::Splitting, &[Parameter::Beta, Parameter::S(0, 1)][..]);
    let with_derivatives = super::plans::has_vectors().then_some(with_derivatives);
    let methods = [(Method::Splitting, &[][..]), (Method::Taylor, &[])].into_iter().chain(with_derivatives);
    worst_of(methods, |(method, derivatives)| {
        let found = found(*method, derivatives, 300)?;
        let Some((.., Promise::Goal(share))) = found.first() else {
            return Err(format!("{} promises no share", method.name()));
        };
        let missed = found.iter().filter(|(_, foreseen, error, _)| error.is_nan() || error > foreseen).count();
        Ok(missed as f64 / found.len() as f64 / (1.0 - share))
    })
}

fn not_idle() -> Result<Measured, String> {
    let mut ratios: Vec<f64> =
        found(Method::Splitting, &[], 300)?.iter().map(|(_, foreseen, error, _)| foreseen / error).collect();
    ratios.sort_by(f64::total_cmp);
    let quantile = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
    Ok(Measured::new(quantile(0.5), format!("quarters {:.1} and {:.1}", quantile(0.25), quantile(0.75))))
}

fn rounding() -> Result<Measured, String> {
    let (mut far, mut all, mut farthest) = (0, 0, Worst::default());
    for method in [Method::Taylor, Method::Splitting] {
        for (number, scene) in
            scenes(method).filter(|(_, scene)| !scene.near_middle_axis && scene.turned() > 5.0).take(200)
        {
            let scene = ErrorScene { tolerance: 1e-16, ..scene };
            let fault = |error: twofold::Error| format!("{}, scene {number} of seed {SEED}: {error}", method.name());
            let plan = plan(&scene, method, &[]).map_err(fault)?;
            let prediction = plan.prediction.ok_or("a plan without a prediction")?;
            let motion = plan.motion(&scene.problem).map_err(fault)?;
            let ratio = motion.error_estimate(scene.time) / prediction.rounding;
            let off = ratio.max(1.0 / ratio);
            all += 1;
            far += usize::from(off.is_nan() || off > 10.0);
            farthest.see(off, || format!("{}, scene {number}: a factor of {off:.1}", method.name()));
        }
    }
    Ok(Measured::new(f64::from(far as u32) / f64::from(all), farthest.finish()?.detail))
}
