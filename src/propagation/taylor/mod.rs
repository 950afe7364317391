//! Numerical motion by Taylor series with adaptive steps and dense output.

mod clock;
mod error_growth;
mod errors;
mod forecast;
mod frame;
#[cfg(target_arch = "x86_64")]
mod lanes;
mod linearised_flow;
mod projection;
mod samples;
mod scaled_problem;
mod series;
mod shared_rounding;
mod step_size;
mod stepper;

use core::any::TypeId;
use core::marker::PhantomData;
use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::numerics::arithmetic::{LoadStore, Padded, plain};
use crate::numerics::compensated::Compensated;
use crate::numerics::fused::{Fused, detect_fused, run_fused};
use crate::numerics::scalar::{Real, cast, cast_ref};
use crate::propagation::Motion;
use clock::StepLimit;
pub(crate) use errors::ErrorAtEnd as TaylorErrorAtEnd;
use errors::{StepError, TaylorErrors};
pub use forecast::TaylorForecast;
#[cfg(target_arch = "x86_64")]
pub(super) use lanes::axis_states_in_lanes;
pub use projection::SeriesProjection;
pub use samples::Samples;
#[cfg(target_arch = "x86_64")]
pub(super) use samples::span_of;

use scaled_problem::ScaledProblem;
use series::{AXIS, MOMENTUM, Vectors};
use step_size::Work;

/// Smallest and largest tolerance of a numerical motion.
pub const TOLERANCE_RANGE: (f64, f64) = (1e-16, 1e-2);

/// Largest number of stored steps of one motion: each has about 2 kB of coefficients for `f64`.
pub const STEP_LIMIT: usize = 500_000;

/// Memory is reserved for this many times the number of steps that the span would have if all were as long as the first. Memory that no step
/// reaches costs nothing; with too little, all series are copied.
pub(crate) const ROOM_FOR_STEPS: f64 = 1.5;

const LIMIT: StepLimit = StepLimit {
    steps: STEP_LIMIT,
    allowed: "at most 500,000 steps; use a shorter span (and continue from its end) or a larger tolerance",
};

/// A motion stored as Taylor series on adjoining steps: [`Problem::taylor`].
#[derive(Debug, Clone)]
pub struct TaylorMotion<S, X = BodyState<S>> {
    /// Number of steps.
    pub step_count: usize,
    /// Order of the series.
    pub order: usize,
    kept: Kept<S>,
    state: PhantomData<X>,
}

#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time")]
enum Kept<S> {
    Axis(KeptSeries<S, 2>),
    Body(KeptSeries<S, 3>),
}

/// Applies an expression to either kind of series.
macro_rules! of_either {
    ($motion:expr, $series:ident => $work:expr) => {
        match &$motion.kept {
            Kept::Axis($series) => $work,
            Kept::Body($series) => $work,
        }
    };
}

/// The series of the `V` vectors `n`, `L` and, with `V = 3`, a vector normal to `n` from which `e_x` follows by a rotation about `n`
/// at a constant rate.
#[derive(Debug, Clone)]
struct KeptSeries<S, const V: usize> {
    setup: ScaledProblem<S, V>,
    /// The instructions for summing the series, for doubles.
    fused: Option<Fused>,
    steps: Steps<S, V>,
    /// The estimated error of the start, if another motion led to it.
    earlier: Option<TaylorErrorAtEnd>,
    /// Computed at the first request, because most motions never need it.
    errors: OnceLock<Errors>,
}

/// The estimated error of each step, and of the motion at its end.
#[derive(Debug, Clone)]
struct Errors {
    of_steps: Vec<StepError>,
    at_end: TaylorErrorAtEnd,
}

/// Adjoining steps with their series.
#[derive(Debug, Clone)]
struct Steps<S, const V: usize> {
    /// Start of each step: time since the start of the motion, positive in either direction.
    starts: Vec<Compensated>,
    /// Coefficients of each step, with spare capacity.
    coefficients: Vec<Vectors<Padded<S>, V>>,
    /// Number of coefficients of one step, `order + 1`.
    length: usize,
}

/// A loop rather than `map`, which is not always inlined and then loses the instructions of `a`.
#[inline(always)]
fn stored<A: LoadStore, const V: usize>(a: A, vectors: &Vectors<A::Vector, V>) -> Vectors<Padded<A::Scalar>, V> {
    let mut stored = [Padded::zero(); V];
    for i in 0..V {
        stored[i] = a.store(vectors[i]);
    }
    stored
}

#[inline(always)]
fn loaded<A: LoadStore, const V: usize>(a: A, stored: &Vectors<Padded<A::Scalar>, V>) -> Vectors<A::Vector, V> {
    let mut vectors = [a.zero(); V];
    for i in 0..V {
        vectors[i] = a.load(&stored[i]);
    }
    vectors
}

impl<S: Real, const V: usize> Steps<S, V> {
    #[inline(always)]
    fn kept<A: LoadStore<Scalar = S>>(setup: &ScaledProblem<S, V>, a: A) -> Result<Self, Error> {
        let mut steps = Self { starts: Vec::new(), coefficients: Vec::new(), length: setup.order + 1 };
        setup.drive().run(a, LIMIT, |step, series| {
            if let [_] = steps.starts.as_slice() {
                // Steps of one motion have similar lengths, so memory for all of them is reserved at once.
                steps.reserve(setup.duration() / step.start.high, series.len());
            }
            steps.keep(a, step.start, series);
            Ok(())
        })?;
        Ok(steps)
    }

    #[inline(always)]
    fn keep<A: LoadStore<Scalar = S>>(&mut self, a: A, start: Compensated, series: &[Vectors<A::Vector, V>]) {
        self.starts.push(start);
        self.coefficients.extend(series.iter().map(
            #[inline(always)]
            |vectors| stored(a, vectors),
        ));
    }

    fn count(&self) -> usize {
        self.starts.len()
    }

    /// The coefficients of one step.
    fn series(&self, step: usize) -> &[Vectors<Padded<S>, V>] {
        &self.coefficients[step * self.length..][..self.length]
    }

    /// Reserves memory for some more steps than `count`, if that is not excessive.
    fn reserve(&mut self, count: f64, coefficients: usize) {
        let count = (ROOM_FOR_STEPS * count).min(STEP_LIMIT as f64 / 50.0) as usize;
        self.starts.reserve(count);
        self.coefficients.reserve(count * coefficients);
    }

    /// The vectors at the time `t` from the series of one step, in the given frame.
    #[inline(always)]
    fn sum<A: LoadStore<Scalar = S>>(&self, setup: &ScaledProblem<S, V>, a: A, step: usize, t: S) -> [Padded<S>; V] {
        let series = self.series(step);
        setup.sum(
            a,
            #[inline(always)]
            |k| loaded(a, &series[k]),
            &self.starts[step],
            t,
        )
    }

    /// Index of the step that contains a time since the start. Steps have similar lengths, so the search begins where the
    /// step would be if they were equal; from there it is bracketed by strides that double.
    fn index_at(&self, elapsed: f64, duration: f64) -> usize {
        let starts = &self.starts;
        let guess = ((elapsed / duration * starts.len() as f64) as usize).min(starts.len() - 1);
        let (mut low, mut high, mut stride) = (guess, guess + 1, 1);
        while low > 0 && starts[low].high > elapsed {
            (high, low, stride) = (low, low.saturating_sub(stride), 2 * stride);
        }
        stride = 1;
        while high < starts.len() && starts[high].high <= elapsed {
            (low, high, stride) = (high, (high + stride).min(starts.len()), 2 * stride);
        }
        low + starts[low..high].partition_point(|start| start.high <= elapsed).max(1) - 1
    }

    /// As [`index_at`](Self::index_at), fast if it is the step `near` or one close to it.
    fn index_near(&self, near: usize, elapsed: f64, duration: f64) -> usize {
        let starts = &self.starts;
        let mut step = near;
        for _ in 0..6 {
            if starts[step].high > elapsed && step > 0 {
                step -= 1;
            } else if starts.get(step + 1).is_some_and(|next| next.high <= elapsed) {
                step += 1;
            } else {
                return step;
            }
        }
        self.index_at(elapsed, duration)
    }
}

/// The instructions for doubles, if the processor has them and `S` is `f64`, which is known at compile time.
fn fused_for<S: Real>() -> Option<Fused> {
    if TypeId::of::<S>() == TypeId::of::<f64>() { detect_fused() } else { None }
}

/// Whether the series is computed in the principal frame, and how its work grows, with those instructions or without.
fn work_of(fused: Option<Fused>) -> (bool, Work) {
    if fused.is_some() { (true, Work::Waiting) } else { (false, Work::Quadratic) }
}

impl<S: Real, const V: usize> KeptSeries<S, V> {
    fn new<X: RotationState<S>>(problem: &Problem<S, X>, span: (f64, f64), tolerance: f64) -> Result<Self, Error> {
        if let Some(fused) = fused_for::<S>() {
            let setup = ScaledProblem::<_, V>::new(work_of(Some(fused)), &problem.map(S::re), span, tolerance)?;
            let steps = run_fused(
                fused,
                #[inline(always)]
                || Steps::kept(&setup, fused),
            )?;
            let motion = KeptSeries { setup, fused: Some(fused), steps, earlier: None, errors: OnceLock::new() };
            return Ok(cast(motion).expect("the scalar is f64"));
        }
        let setup = ScaledProblem::new(work_of(None), problem, span, tolerance)?;
        let steps = Steps::kept(&setup, plain())?;
        Ok(Self { setup, fused: None, steps, earlier: None, errors: OnceLock::new() })
    }

    /// Index of the step that contains the time `t`, and the time since the start.
    fn step_at(&self, t: f64) -> Result<(usize, f64), Error> {
        let elapsed = self.setup.elapsed(t)?;
        Ok((self.steps.index_at(elapsed, self.setup.duration()), elapsed))
    }

    /// The vectors of the series at time `t`, in the given frame.
    #[inline(always)]
    fn at(&self, t: S) -> Result<[Vector3<S>; V], Error> {
        let (index, _) = self.step_at(t.re())?;
        if let (Some(fused), Some(motion)) = (self.fused, cast_ref::<_, KeptSeries<f64, V>>(self)) {
            let vectors = run_fused(
                fused,
                #[inline(always)]
                || motion.steps.sum(&motion.setup, fused, index, t.re()),
            );
            return Ok(vectors.map(|v| v.vector().map(S::from_f64)));
        }
        Ok(self.steps.sum(&self.setup, plain(), index, t).map(|v| v.vector()))
    }

    /// Length of one step, positive in either direction.
    fn length(&self, step: usize) -> f64 {
        let Steps { starts, .. } = &self.steps;
        let end = starts.get(step + 1).copied().unwrap_or(Compensated::new(self.setup.duration()));
        (end.high - starts[step].high) + (end.low - starts[step].low)
    }

    fn errors(&self) -> &Errors {
        self.errors.get_or_init(|| {
            let mut errors = TaylorErrors::of(&self.setup, self.earlier.as_ref());
            let of_steps = (0..self.steps.count()).map(|step| {
                let h = self.length(step) * self.setup.direction() / self.setup.scale.time;
                errors.step(self.steps.series(step), |v| v.vector().map(S::re), h)
            });
            let of_steps = of_steps.collect();
            Errors { of_steps, at_end: errors.at_end(self.setup.error_of_time(self.setup.span.1)) }
        })
    }

    fn error_estimate(&self, t: f64) -> f64 {
        let Ok((index, elapsed)) = self.step_at(t) else { return f64::NAN };
        let error = self.errors().of_steps[index];
        let (into, length) = (elapsed - self.steps.starts[index].high, self.length(index));
        let into = if into > 0.0 { into / length } else { 0.0 };
        error.at(into, self.setup.order) + self.setup.error_of_time(t)
    }
}

impl<S: Real, X: RotationState<S>> Problem<S, X> {
    /// The numerical motion from the initial state at `span.0` to `span.1` (forwards or backwards), by Taylor series. Without `e_x` a third
    /// of the work is saved.
    ///
    /// `tolerance` is the truncation error allowed in the components of `n`, `e_x` and of `L` in units of `|L| + sqrt(2 I^xx C |s|)` at
    /// the end of the span, in [`TOLERANCE_RANGE`]; rounding adds about `2e-16 sqrt(steps)` and its growth, see
    /// [`Motion::error_estimate`]. A truncation error below rounding costs little: the order of the series rises by one for each factor of
    /// four.
    ///
    /// Step sizes and order depend on the real parts alone, so that derivatives (duals) are those of the motion and not of the
    /// choice of steps. Motion in doubles uses fused multiply-add and vector instructions if the processor has them: the last
    /// digits may differ between processors, but never between runs.
    ///
    /// # Errors
    /// [`Error::Domain`] for a tolerance out of range, a span that is not finite, and one that needs more than [`STEP_LIMIT`] steps.
    pub fn taylor(&self, span: (f64, f64), tolerance: f64) -> Result<TaylorMotion<S, X>, Error> {
        let kept = if const { X::VECTORS == 3 } {
            Kept::Body(KeptSeries::new(self, span, tolerance)?)
        } else {
            Kept::Axis(KeptSeries::new(self, span, tolerance)?)
        };
        let (step_count, order) = match &kept {
            Kept::Axis(series) => (series.steps.count(), series.setup.order),
            Kept::Body(series) => (series.steps.count(), series.setup.order),
        };
        Ok(TaylorMotion { step_count, order, kept, state: PhantomData })
    }
}

impl<S: Real, X> TaylorMotion<S, X> {
    /// The error at the end, for a motion that goes on from there.
    pub(crate) fn error_at_end(&self) -> TaylorErrorAtEnd {
        of_either!(self, series => series.errors().at_end.clone())
    }

    /// This motion with an error of its start.
    pub(crate) fn with_initial_error(mut self, error: TaylorErrorAtEnd) -> Self {
        match &mut self.kept {
            Kept::Axis(series) => (series.earlier, series.errors) = (Some(error), OnceLock::new()),
            Kept::Body(series) => (series.earlier, series.errors) = (Some(error), OnceLock::new()),
        }
        self
    }
}

impl<S: Real, X: RotationState<S>> Motion<S> for TaylorMotion<S, X> {
    type State = X;

    fn spheroid(&self) -> &RigidSpheroid<S> {
        of_either!(self, series => &series.setup.spheroid)
    }

    fn coefficients(&self) -> &Matrix3<S> {
        of_either!(self, series => &series.setup.tensor)
    }

    fn span(&self) -> (f64, f64) {
        of_either!(self, series => series.setup.span)
    }

    fn state(&self, t: S) -> Result<X, Error> {
        Ok(X::from_vectors(match &self.kept {
            Kept::Axis(series) => {
                let [n, l] = series.at(t)?;
                [n, l, Vector3::zeros()]
            }
            Kept::Body(series) => series.setup.body_state(series.at(t)?, t).vectors(),
        }))
    }

    fn axis_state(&self, t: S) -> Result<AxisState<S>, Error> {
        let [axis, momentum] = of_either!(self, series => {
            let vectors = series.at(t)?;
            [vectors[AXIS], vectors[MOMENTUM]]
        });
        Ok(AxisState { axis, momentum })
    }

    /// The truncation of each step from its defect and the rounding that all steps share (of the constants, of the frame), with
    /// their signs, and the size of the other rounding of each step, are carried along the motion by the linearised equations. This
    /// covers both the linear growth of phases and the exponential growth near the unstable middle axis. The estimate is computed
    /// for all steps at the first call, which takes longer than the propagation.
    ///
    /// Over 50,000 random motions, drawn as described in `docs/accuracy.md`, it is most often three to thirty times the true error, in 0.7 %
    /// of them above a hundred times, and in none of them below. Once it reaches one, the phase is no longer known, and the estimate is 2.5
    /// from there on.
    fn error_estimate(&self, t: f64) -> f64 {
        of_either!(self, series => series.error_estimate(t))
    }

    /// For doubles, on a processor with vector instructions.
    fn projection(&self, in_body: &Vector3<f64>, direction: &Vector3<f64>) -> Option<SeriesProjection<'_>> {
        let Kept::Body(series) = &self.kept else { return None };
        let KeptSeries { setup, steps, fused, .. } = cast_ref::<_, KeptSeries<f64, 3>>(series)?;
        Some(SeriesProjection::new(setup, steps, (*fused)?, in_body, direction))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::fixture::{AXIS_STATE, axis_problem};

    /// The step is found also for a time that rounding puts before the first of the stored steps.
    #[test]
    fn the_step_of_a_time_does_not_depend_on_that_before() {
        let starts = [3.0, 5.0, 6.0, 9.0].map(Compensated::new).to_vec();
        let steps = Steps::<f64, 2> { starts, coefficients: Vec::new(), length: 1 };
        let times = [(2.9, 0), (3.0, 0), (4.9, 0), (5.0, 1), (5.9, 1), (6.0, 2), (8.9, 2), (9.0, 3), (11.9, 3)];
        for (elapsed, step) in times {
            assert_eq!(steps.index_at(elapsed, 12.0), step, "{elapsed}");
            for near in 0..4 {
                assert_eq!(steps.index_near(near, elapsed, 12.0), step, "{elapsed} near {near}");
            }
        }
    }

    #[test]
    fn without_vector_instructions_the_frame_is_the_given_one() {
        assert_eq!(work_of(None), (false, Work::Quadratic));
        if let Some(fused) = detect_fused() {
            assert_eq!(work_of(Some(fused)), (true, Work::Waiting));
        }
    }

    /// The truncation error of a step grows with the time since its start, to the power of the order.
    #[test]
    fn the_error_within_a_step_begins_with_what_is_carried() {
        let motion = axis_problem([0.02, 0.01, -0.03]).taylor((0.0, 3.0), 1e-5).unwrap();
        let Kept::Axis(series) = &motion.kept else { panic!("of the axis alone") };
        assert!(series.steps.count() > 1);
        let (second, length) = (series.steps.starts[1].high, series.length(0));
        let at = |part: f64| motion.error_estimate(part * length);
        assert!(at(0.0) < 1e-15 && at(0.3) < at(0.6) && at(0.6) < at(0.9), "{:?}", [0.0, 0.3, 0.6, 0.9].map(at));
        assert!(at(0.9) > 1e3 * at(0.3) && length < 1.0 && series.length(1) < 1.0);
        // The error carried from there on is the larger of both ends of the step: no less than the incoming error.
        assert!(motion.error_estimate(second) < 3.0 * at(1.0 - 1e-9), "{:e}", motion.error_estimate(second));
    }

    /// The start is lost in the rounding of the time since it. The steps are the same, and the estimate adds the rotation in the lost time.
    #[test]
    fn what_rounding_makes_of_the_time_is_in_the_estimated_error() {
        let problem = axis_problem([0.02, 0.01, -0.03]);
        let kept = |start: f64| problem.taylor((start, 30.0), 1e-6).unwrap().error_estimate(30.0);
        let momentum = AXIS_STATE.momentum.norm() + (2.6 * 0.7 * 14e-4_f64.sqrt()).sqrt();
        let turning = momentum / 1.3 * (1.0 + 0.2 / 1.1);
        // Half a unit in the last place of 30 is 1.8e-15.
        for start in [1.5e-15, -1.5e-15] {
            let more = kept(start) - kept(0.0);
            assert_relative_eq!(more, 1.5e-15 * turning, epsilon = 0.0, max_relative = 1e-3);
        }
    }
}
