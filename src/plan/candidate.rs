//! Predictions for each method before it is used: whether it is applicable to a scene, and how large its error and its work
//! will be.

use super::{Cost, Method, Output, Request, State, Work};
use crate::dynamics::Problem;
use crate::error::Error;
use crate::lorentz_violation::{error_of_principal_frame_along, principal_frame};
use crate::propagation::splitting::{Goal, MOST_STATES, SplittingForecast};
use crate::propagation::{
    AveragedMotion, ROOM_FOR_STEPS, SymmetricMotion, TaylorForecast, TorusMotion, UniformMotion, largest_torque,
};
use crate::solutions::torus::error_of_derivatives;

/// How the predicted error of a method relates to the true error, excluding rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Promise {
    /// A proven upper bound.
    Bound,
    /// An estimate: it was exceeded in none of the random motions of its test ([averaged](Method::Averaged):
    /// `docs/averaged-solution.md`).
    Estimate,
    /// A target for which the steps are chosen: this fraction of random motions of every kind stays below it. Most of the others start
    /// near the unstable middle axis, whose growth is not predicted.
    Goal(f64),
}

/// The predicted performance of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Truncation error of the method at the end of the span, without rounding.
    pub truncation: f64,
    /// How the predicted truncation error relates to the true error.
    pub promise: Promise,
    /// The rounding error that the motion's [`error_estimate`](crate::propagation::Motion::error_estimate) will report at
    /// the end.
    pub rounding: f64,
    /// Order of the series; zero if there is none.
    pub order: usize,
    /// Work. Turns and events are counted with typical numbers; with derivatives, it includes all motions that are computed for
    /// them.
    pub work: Work,
    /// Heap memory of the motion.
    pub memory: Memory,
    /// Time in ns on the [machine](super::MACHINE) on which the costs were fitted.
    pub cost: f64,
}

/// Heap memory of a motion. A growing vector takes up to four times as much in total; evaluations take none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// Memory for what is computed once, in bytes.
    pub table: f64,
    /// Number of steps of the motion.
    pub steps: f64,
    /// Largest number of steps that are stored.
    pub most_stored: f64,
    /// Memory for each step stored, in bytes.
    pub per_step: f64,
}

impl Memory {
    /// Memory, in bytes, of one segment, if the motion is computed in `count` segments of equal length one after the other.
    pub fn of_a_segment(&self, count: usize) -> f64 {
        self.table + self.per_step * (self.steps / count as f64).min(self.most_stored)
    }
}

/// A method with its prediction, or the reason why it cannot be used.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: Method,
    /// Its prediction.
    pub prediction: Result<Prediction, Error>,
}

impl Candidate {
    /// Considers a method for `evaluations` of a `state` up to the end of `span`.
    pub(super) fn of(
        method: Method,
        problem: &Problem<f64>,
        request: &Request,
        state: State,
        span: (f64, f64),
        evaluations: f64,
    ) -> Self {
        let errors = match method {
            Method::Free => free(problem, request, span),
            Method::Steady => steady(problem, request, span),
            Method::Symmetric => symmetric(problem, request, span),
            Method::Averaged => averaged(problem, request, span),
            Method::Torus => torus(problem, request, span),
            Method::Splitting => splitting(problem, request, span),
            Method::Taylor => taylor(problem, request, state, span),
        };
        Self {
            method,
            prediction: errors.map(|errors| errors.with_work(method, state, evaluations, request.derivatives.len())),
        }
    }
}

/// Errors and steps of a method.
struct Forecast {
    truncation: f64,
    promise: Promise,
    rounding: f64,
    order: usize,
    steps: f64,
    /// Heap memory in addition to the steps, in bytes.
    table: f64,
}

impl Forecast {
    fn closed(promise: Promise, truncation: f64, rounding: f64) -> Self {
        Self { truncation, promise, rounding, order: 0, steps: 0.0, table: 0.0 }
    }

    fn with_work(self, method: Method, state: State, evaluations: f64, derivatives: usize) -> Prediction {
        let Self { truncation, promise, rounding, order, steps, table } = self;
        let full = state == State::Orientation;
        let vectors = if full { 3.0 } else { 2.0 };
        // Each step of a series stores its coefficients, padded to registers, and its start; some room is added.
        let (per_step, most_stored) = if method == Method::Splitting {
            (4.0 + 48.0 * vectors, MOST_STATES as f64)
        } else {
            (ROOM_FOR_STEPS * ((order as f64 + 1.0) * 32.0 * vectors + 16.0), f64::INFINITY)
        };
        let memory = Memory { table, steps, most_stored, per_step };
        let motions = method.motions_for(derivatives) as f64;
        let (all_steps, all_evaluations) = (motions * steps, motions * evaluations);
        Prediction {
            truncation,
            promise,
            rounding,
            order,
            work: Work {
                steps: all_steps,
                right_hand_sides: all_steps * order as f64,
                axis_evaluations: if full { 0.0 } else { all_evaluations },
                orientation_evaluations: if full { all_evaluations } else { 0.0 },
            },
            memory,
            cost: Cost::with_derivatives(method, state, derivatives).total(order, steps, evaluations),
        }
    }
}

/// A closed form for a family of tensors has no derivatives with respect to changes of the tensor that leave the family.
fn refuse_derivatives(request: &Request, why: &'static str) -> Result<(), Error> {
    let by_tensor = request.derivatives.iter().any(|parameter| parameter.is_of_s());
    if by_tensor { Err(Error::Unsupported { what: "derivatives by components of s^IJ", why }) } else { Ok(()) }
}

fn free(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    refuse_derivatives(request, "free rotation does not depend on s^IJ")?;
    if !request.derivatives.is_empty() {
        problem.require_rigid()?;
    }
    let torque = largest_torque(problem.spheroid(), problem.coefficients());
    Error::ensure(
        request.derivatives.is_empty() || torque == 0.0,
        "largest torque C |s^IJ|",
        torque,
        "zero, for derivatives",
    )?;
    let motion = UniformMotion::free(problem, span);
    let elapsed = span.1 - span.0;
    Ok(Forecast::closed(Promise::Bound, motion.truncation(elapsed), motion.rounding(elapsed)))
}

fn steady(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    if !request.derivatives.is_empty() {
        return Err(Error::Unsupported { what: "derivatives", why: "a steady precession is a single state" });
    }
    let motion = UniformMotion::steady(problem, span)?;
    Ok(Forecast::closed(Promise::Bound, 0.0, motion.rounding(span.1 - span.0)))
}

fn symmetric(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    refuse_derivatives(request, "the elliptic solution needs two equal eigenvalues")?;
    let motion = SymmetricMotion::new(problem, span)?;
    let elapsed = span.1 - span.0;
    let truncation = motion.truncation(elapsed);
    Error::ensure(
        request.derivatives.is_empty() || truncation == 0.0,
        "truncation error of the elliptic solution",
        truncation,
        "zero within rounding, for derivatives",
    )?;
    // Computing the rounding costs more than the motion, so it is done only for a motion that may be used.
    let usable = truncation <= request.tolerance || request.method == Some(Method::Symmetric);
    let rounding = if usable { motion.rounding(elapsed) } else { f64::NAN };
    // The roots of the quartic are found once, with a few short lists.
    Ok(Forecast { table: 1024.0, ..Forecast::closed(Promise::Bound, truncation, rounding) })
}

fn averaged(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    let motion = AveragedMotion::new(problem, span)?;
    let elapsed = span.1 - span.0;
    let (mut truncation, rounding) = (motion.mean.truncation(elapsed), motion.mean.rounding(elapsed));
    if !request.derivatives.is_empty() {
        motion.mean.require_derivatives()?;
        // A derivative with respect to s^IJ is accurate to one order less, in its own unit.
        truncation /= motion.mean.relative_strength + motion.mean.bulge_strength();
        truncation += error_of_principal_frame_along(principal_frame(problem.coefficients())?.coefficients);
    }
    Ok(Forecast::closed(Promise::Estimate, truncation, rounding))
}

fn torus(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    let motion = TorusMotion::new(problem, span, request.tolerance)?;
    let solution = motion.solution();
    let mut rounding = solution.rounding(span.1 - span.0);
    if !request.derivatives.is_empty() {
        rounding = rounding.max(error_of_derivatives(solution, problem)?);
    }
    let closed = Forecast::closed(Promise::Estimate, solution.truncation(), rounding);
    // At most eight doubles for a pair of frequencies, in vectors that have grown.
    Ok(Forecast { table: 128.0 * solution.term_counts().iter().sum::<usize>() as f64, ..closed })
}

fn splitting(problem: &Problem<f64>, request: &Request, span: (f64, f64)) -> Result<Forecast, Error> {
    let goal = if request.derivatives.is_empty() { Goal::State } else { Goal::Derivatives };
    let SplittingForecast { scheme, steps, truncation, coverage, rounding, .. } =
        problem.splitting_forecast_for(goal, span, request.tolerance)?;
    // Rotations and kicks.
    let order = 2 * scheme.stages();
    Ok(Forecast { truncation, promise: Promise::Goal(coverage), rounding, order, steps, table: 0.0 })
}

/// Fraction of random motions whose error by Taylor series, excluding rounding, stays below the tolerance: it was exceeded by none of
/// 10,000 with strong torques, and by 0.3 % of 3,000 of every kind (`docs/plans.md`).
const TAYLOR_COVERAGE: f64 = 0.99;

fn taylor(problem: &Problem<f64>, request: &Request, state: State, span: (f64, f64)) -> Result<Forecast, Error> {
    let duration = (span.1 - span.0).abs();
    let TaylorForecast { order, steps, rounding } = if state == State::Orientation {
        problem.taylor_forecast(duration, request.tolerance)?
    } else {
        problem.reduced().taylor_forecast(duration, request.tolerance)?
    };
    Ok(Forecast {
        truncation: request.tolerance,
        promise: Promise::Goal(TAYLOR_COVERAGE),
        rounding,
        order,
        steps,
        table: 0.0,
    })
}

/// Number of evaluations that the outputs of a request need for a rotation by `rotation` rad.
pub(super) fn evaluations(request: &Request, rotation: f64) -> f64 {
    use super::Evaluations as E;
    let needs = || request.outputs.iter().map(|output: &Output| output.need().evaluations);
    let samples = request.samples as f64;
    let at_samples = needs().any(|e| matches!(e, E::AtSamples | E::CountingTurns { .. }));
    let beside: f64 = needs()
        .map(|e| match e {
            E::Never | E::AtSamples => 0.0,
            // Two states for each piece between samples, or for each piece that is fine enough.
            E::CountingTurns { per_radian } => (3.0 * samples).max(rotation * per_radian),
            E::ForEvents { per_radian } => rotation * per_radian,
        })
        .sum();
    beside + if at_samples { samples } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::fixture::problem;
    use crate::parameters::Parameter;

    /// The prediction for a method over a span, for a tensor with the principal values `s`.
    fn forecast(method: Method, s: [f64; 3], span: (f64, f64), derivatives: Vec<Parameter>) -> Candidate {
        let request = Request { derivatives, ..Request::new(&[Output::SymmetryAxis], span, 5, 1e-9) };
        Candidate::of(method, &problem(s), &request, State::Axis, span, 5.0)
    }

    #[test]
    fn a_segment_stores_its_share_of_the_steps() {
        let memory = Memory { table: 10.0, steps: 100.0, most_stored: 30.0, per_step: 2.0 };
        assert_eq!([1, 4, 50].map(|count| memory.of_a_segment(count)), [70.0, 60.0, 14.0]);
    }

    #[test]
    fn free_rotation_names_the_torque_that_forbids_its_derivatives() {
        let free = forecast(Method::Free, [0.02, 0.01, -0.03], (0.0, 1.0), vec![Parameter::Beta]);
        let Err(Error::Domain { value, .. }) = free.prediction else { panic!("{free:?}") };
        // C times the root of two times the norm.
        assert_relative_eq!(value, 0.7 * (2.0 * 14e-4_f64).sqrt(), max_relative = 1e-12);
    }

    /// Only a proven bound is called a bound: the averaged motion and the series on the torus have estimates, whatever their tests
    /// found.
    #[test]
    fn no_estimate_is_called_a_bound() {
        let cases = [
            (Method::Free, [2e-9, 1e-9, -3e-9], Promise::Bound),
            (Method::Steady, [0.0; 3], Promise::Bound),
            (Method::Symmetric, [0.2, 0.2, -0.4], Promise::Bound),
            (Method::Averaged, [2e-7, 1e-7, -3e-7], Promise::Estimate),
            (Method::Torus, [0.2, 0.1, -0.3], Promise::Estimate),
        ];
        for (method, s, promise) in cases {
            assert_eq!(forecast(method, s, (0.0, 7.0), Vec::new()).prediction.unwrap().promise, promise, "{method:?}");
        }
        for method in [Method::Splitting, Method::Taylor] {
            let found = forecast(method, [0.2, 0.1, -0.3], (0.0, 7.0), Vec::new()).prediction.unwrap().promise;
            assert!(matches!(found, Promise::Goal(share) if share > 0.9 && share < 1.0), "{method:?}: {found:?}");
        }
    }

    #[test]
    fn errors_and_work_go_by_the_length_of_the_span_alone() {
        // Free motion with its error from a torque, a steady motion, two equal eigenvalues and nearly equal ones, a weak violation, and a strong
        // one.
        let cases = [
            (Method::Free, [0.0; 3]),
            (Method::Free, [2e-9, 1e-9, -3e-9]),
            (Method::Steady, [0.0; 3]),
            (Method::Symmetric, [0.2, 0.2, -0.4]),
            (Method::Symmetric, [0.2, 0.2 + 1e-13, -0.4]),
            (Method::Averaged, [2e-7, 1e-7, -3e-7]),
            (Method::Torus, [0.2, 0.1, -0.3]),
            (Method::Splitting, [0.2, 0.1, -0.3]),
            (Method::Taylor, [0.2, 0.1, -0.3]),
        ];
        for (method, s) in cases {
            let first = forecast(method, s, (0.0, 7.0), Vec::new()).prediction.unwrap();
            assert_eq!(forecast(method, s, (3.0, 10.0), Vec::new()).prediction, Ok(first), "{method:?}");
            // The rounding of the elliptic solution is sampled, at different times for a backward motion.
            let back = forecast(method, s, (3.0, -4.0), Vec::new()).prediction.unwrap();
            assert_relative_eq!(back.rounding, first.rounding, max_relative = 0.05);
            assert_eq!(Prediction { rounding: first.rounding, ..back }, first, "{method:?}");
        }
    }

    /// Steady precession has no truncation error, and its rounding is not zero.
    #[test]
    fn a_steady_precession_has_rounding_alone() {
        let found = forecast(Method::Steady, [0.0; 3], (0.0, 7.0), Vec::new()).prediction.unwrap();
        assert!(found.truncation == 0.0 && found.rounding > 0.0 && found.rounding < 1e-12, "{found:?}");
    }

    /// A derivative with respect to `s^IJ` is less accurate in proportion as `s` is small, and by the rotation of the principal frame where two
    /// eigenvalues are nearly equal.
    #[test]
    fn averaged_derivatives_have_an_error_of_their_own() {
        for s in [[2e-7, 1e-7, -3e-7], [2e-7, 2e-7 - 1e-17, -4e-7]] {
            let [values, derivatives] = [vec![], vec![Parameter::SAxial]]
                .map(|by| forecast(Method::Averaged, s, (0.0, 7.0), by).prediction.unwrap().truncation);
            let motion = AveragedMotion::new(&problem(s), (0.0, 7.0)).unwrap();
            let frame =
                error_of_principal_frame_along(principal_frame(problem(s).coefficients()).unwrap().coefficients);
            assert_relative_eq!(derivatives, values / motion.mean.relative_strength + frame, max_relative = 1e-12);
        }
        let stiff = problem([2e-7, 1e-7, -3e-7]).with_bulge(0.5).unwrap();
        let request =
            |derivatives| Request { derivatives, ..Request::new(&[Output::SymmetryAxis], (0.0, 7.0), 5, 1e-9) };
        let truncation = |by| averaged(&stiff, &request(by), (0.0, 7.0)).unwrap().truncation;
        let mean = AveragedMotion::new(&stiff, (0.0, 7.0)).unwrap().mean;
        assert!(mean.bulge_strength() > 0.1 * mean.relative_strength, "{:e}", mean.bulge_strength());
        let expected = truncation(vec![]) / (mean.relative_strength + mean.bulge_strength());
        assert_relative_eq!(truncation(vec![Parameter::Spin]), expected, max_relative = 1e-6);
    }

    /// On a thin torus derivatives lose accuracy, but values do not.
    #[test]
    fn derivatives_on_a_torus_have_an_error_of_their_own() {
        let problem = problem([0.2, 0.1, -0.3]);
        let rounding = |end: f64, derivatives| {
            let request = Request { derivatives, ..Request::new(&[Output::SymmetryAxis], (0.0, end), 5, 1e-15) };
            torus(&problem, &request, (0.0, end)).unwrap().rounding
        };
        let solution = TorusMotion::new(&problem, (0.0, 7.0), 1e-15).unwrap();
        let expected = error_of_derivatives(solution.solution(), &problem).unwrap();
        assert!(rounding(7.0, vec![]) < expected, "{expected:e}");
        assert_eq!(rounding(7.0, vec![Parameter::Spin]), expected);
        // After so long a time the error of the phases is larger, for both.
        assert!(rounding(1e20, vec![]) > expected);
        assert_eq!(rounding(1e20, vec![Parameter::Spin]), rounding(1e20, vec![]));
    }

    #[test]
    fn evaluations_are_of_the_state_that_is_carried() {
        let span = (0.0, 7.0);
        let request = Request::new(&[Output::EquatorialAxis], span, 5, 1e-9);
        let of = |state| {
            Candidate::of(Method::Taylor, &problem([0.2, 0.1, -0.3]), &request, state, span, 5.0)
                .prediction
                .unwrap()
                .work
        };
        let (axis, orientation) = (of(State::Axis), of(State::Orientation));
        assert_eq!((axis.axis_evaluations, axis.orientation_evaluations), (5.0, 0.0));
        assert_eq!((orientation.axis_evaluations, orientation.orientation_evaluations), (0.0, 5.0));
    }

    /// Counted turns take at least two states between each pair of samples, in addition to the samples.
    #[test]
    fn turns_are_counted_on_two_states_for_each_sample() {
        let request = |count: usize| Request::new(&[Output::EulerAngles], (0.0, 7.0), count, 1e-9);
        assert_eq!(evaluations(&request(1000), 1e-3), 4_000.0);
        let by_rotation = evaluations(&request(2), 1e4) - 2.0;
        assert_eq!(evaluations(&request(2), 2e4) - 2.0, 2.0 * by_rotation);
    }
}
