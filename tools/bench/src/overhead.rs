//! What events, dense output, gradients, nested duals and wider numbers cost on top of a motion.

use std::hint::black_box;

use nalgebra::SVector;
use num_dual::{Derivative, Dual, Dual2_64, Dual64, DualSVec64, HyperDual64};
use twofold::numerics::scalar::Real;
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, pulse_train};
use twofold::parameters::{Parameter, Parameters};
use twofold::plan::{Output, Request, gradient};
use twofold::propagation::Motion;

use super::Effort;
use super::method::Carries;
use super::scene::{BenchScene, DURATION};
use super::timing::{Times, in_turn};
use twofold_verify::double_double::DoubleDouble;

/// Tolerance of the motions.
pub const TOLERANCE: f64 = 1e-12;

const PARAMETERS: [Parameter; 10] = [
    Parameter::InertiaXx,
    Parameter::InertiaZz,
    Parameter::ConstantC,
    Parameter::S(0, 0),
    Parameter::S(1, 1),
    Parameter::S(2, 2),
    Parameter::Beta,
    Parameter::AlphaRate,
    Parameter::BetaRate,
    Parameter::GammaRate,
];

/// The cost of something in addition to a motion, or of a motion in another number type.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the case.
    pub what: &'static str,
    /// The vectors that its motion computes.
    pub carries: Carries,
    /// Run times.
    pub times: Times,
    /// Least time relative to that of the bare motion with the same `carries`; for a gradient, relative to the state at the end alone.
    pub ratio: f64,
}

type Case<'a> = (&'static str, Carries, Box<dyn FnMut() -> Result<(), String> + 'a>);

/// Measures all cases on tp-II; `done` receives the fraction of the work that is over.
pub fn measure(effort: &Effort, done: impl FnMut(f64)) -> Result<Vec<Row>, String> {
    let scene = &BenchScene::named("tp-II");
    let span = (0.0, DURATION);
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let whole = || Ok::<_, String>(scene.problem.taylor(span, TOLERANCE)?);
    let reduced = scene.problem.reduced();
    let axis = || Ok::<_, String>(reduced.taylor(span, TOLERANCE)?);
    let sampled = |count: usize| {
        move || {
            let motion = axis()?;
            for i in 0..count {
                black_box(motion.state(DURATION * i as f64 / count as f64)?);
            }
            Ok(())
        }
    };
    let (n, full) = (Carries::Axis, Carries::Orientation);
    let mut cases: Vec<Case> = vec![
        ("the motion alone", n, Box::new(|| axis().map(drop))),
        ("the motion alone", full, Box::new(|| whole().map(drop))),
        (
            "162 pulses, both edges of each",
            full,
            Box::new(|| Ok(pulse_train(&whole()?, &beam, &observer.direction, span).map(drop)?)),
        ),
        ("1,000 samples", n, Box::new(sampled(1000))),
        ("10,000 samples", n, Box::new(sampled(10_000))),
        (
            "1,000 samples",
            full,
            Box::new(|| {
                let motion = whole()?;
                for i in 0..1000 {
                    black_box(motion.state(f64::from(i))?);
                }
                Ok(())
            }),
        ),
        ("the state at the end alone", n, Box::new(|| at_end(scene, n))),
        ("the state at the end alone", full, Box::new(|| at_end(scene, full))),
        ("its gradient by 10 parameters", n, Box::new(|| gradient_at_end(scene, n))),
        ("its gradient by 10 parameters", full, Box::new(|| gradient_at_end(scene, full))),
        ("derivative by one parameter (Dual64)", n, Box::new(|| axis_over(scene, Dual64::from_re))),
        ("gradient by 10 parameters (DualSVec64)", n, Box::new(|| axis_over(scene, seeded()))),
        ("gradient by 10 parameters (DualSVec64)", full, Box::new(|| whole_over(scene, seeded()))),
        ("second derivative (Dual2_64)", n, Box::new(|| axis_over(scene, Dual2_64::from_re))),
        ("second derivative (HyperDual64)", n, Box::new(|| axis_over(scene, HyperDual64::from_re))),
        (
            "nested duals (Dual<Dual64>)",
            n,
            Box::new(|| axis_over(scene, |x| Dual::new(Dual64::new(x, 1.0), Dual64::new(1.0, 0.0)))),
        ),
        ("double-double numbers", n, Box::new(|| axis_over(scene, <DoubleDouble as twofold::Scalar>::from_f64))),
    ];
    let mut runs: Vec<_> = cases.iter_mut().map(|(_, _, run)| run).collect();
    let times = in_turn(&mut runs, effort.rounds, done)?;
    let all = &times;
    // The bare motion of the first two rows is stored, which most other rows need; a gradient does not need it.
    let place = |sought: &str| cases.iter().position(|(what, ..)| *what == sought).unwrap_or_default();
    let (kept, at_end) = (place("the motion alone"), place("the state at the end alone"));
    let base = |what: &str| if what.starts_with("its gradient") { at_end } else { kept };
    let row = |(&(what, carries, _), times): (&Case, &Times)| Row {
        what,
        carries,
        times: *times,
        ratio: times.least / all[base(what) + usize::from(carries == full)].least,
    };
    Ok(cases.iter().zip(all).map(row).collect())
}

/// Numbers with a derivative with respect to each of the parameters. The values of the derivatives do not affect the time, but none of them may be known to be
/// zero.
fn seeded() -> impl Fn(f64) -> DualSVec64<{ PARAMETERS.len() }> {
    |x| DualSVec64::new(x, Derivative::some(SVector::from_element(x)))
}

/// Computes the state at the end of the motion, of which nothing else is stored.
fn at_end(scene: &BenchScene, carries: Carries) -> Result<(), String> {
    match carries {
        Carries::Axis => drop(black_box(scene.problem.reduced().taylor_states(0.0, &[DURATION], TOLERANCE)?)),
        Carries::Orientation => drop(black_box(scene.problem.taylor_states(0.0, &[DURATION], TOLERANCE)?)),
    }
    Ok(())
}

/// Computes the state at the end of the motion, with its derivatives.
fn gradient_at_end(scene: &BenchScene, carries: Carries) -> Result<(), String> {
    let (spheroid, initial) = (scene.problem.spheroid(), scene.problem.initial());
    let output = if carries == Carries::Axis { Output::AngularMomentum } else { Output::EquatorialAxis };
    let request =
        Request { derivatives: PARAMETERS.to_vec(), ..Request::new(&[output], (0.0, DURATION), 1, TOLERANCE) };
    let plan = scene.problem.plan(&request)?;
    let (angles, rates) = (initial.angles()?, initial.rates(spheroid)?);
    let start = Parameters::new(*spheroid, *scene.problem.coefficients(), angles, rates);
    Ok(gradient(&plan, &start, &[DURATION]).map(|found| drop(black_box(found)))?)
}

/// Computes the motion of `n` and `L` in another number type.
fn axis_over<S: Real>(scene: &BenchScene, lift: impl Fn(f64) -> S) -> Result<(), String> {
    drop(scene.problem.map(lift).reduced().taylor((0.0, DURATION), TOLERANCE)?);
    Ok(())
}

/// Computes the whole motion in another number type.
fn whole_over<S: Real>(scene: &BenchScene, lift: impl Fn(f64) -> S) -> Result<(), String> {
    drop(scene.problem.map(lift).taylor((0.0, DURATION), TOLERANCE)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An addition to a whole motion is compared with the whole motion, an addition to the motion of `n` and `L` with the motion of these.
    #[test]
    fn what_comes_on_top_is_compared_with_a_motion_that_carries_the_same() {
        let rows = measure(&Effort { rounds: 1, longest: 1e3 }, |_| ()).expect("motions");
        for row in &rows {
            let alone =
                if row.what.starts_with("its gradient") { "the state at the end alone" } else { "the motion alone" };
            let base = rows.iter().find(|base| base.what == alone && base.carries == row.carries).expect("its motion");
            assert_eq!(row.ratio, row.times.least / base.times.least, "{}", row.what);
        }
    }
}
