//! A motion stored as states at the steps of a splitting scheme.

use core::marker::PhantomData;
use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::numerics::rounding::two_product;
use crate::propagation::input::{check_request, check_time};
use crate::propagation::splitting::choice::{Goal, SplittingForecast, cheapest};
use crate::propagation::splitting::double_steps::DoubleSteps;
pub(crate) use crate::propagation::splitting::error::ErrorAtEnd as SplittingErrorAtEnd;
use crate::propagation::splitting::error::ErrorEstimate;
use crate::propagation::splitting::flows::{AXIS, Field, Moving, RATE, dot};
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::third_angle::body_state;
use crate::propagation::{Motion, TOLERANCE_RANGE};

/// Largest number of steps of one motion.
pub const SPLITTING_STEP_LIMIT: f64 = 1e10;

/// Largest number of states stored for one motion: 100 bytes each.
pub(crate) const MOST_STATES: u64 = 100_000;

/// A problem in the principal frame of `s^IJ`, with the `V` vectors that the flows move.
#[derive(Debug, Clone)]
pub(super) struct PrincipalProblem<const V: usize = 2> {
    pub(super) field: Field<f64>,
    /// Eigenvalues of `s^IJ`, in descending order.
    pub(super) eigenvalues: [f64; 3],
    pub(super) inertia: f64,
    pub(super) principal_from_given: Matrix3<f64>,
    pub(super) start: Moving<f64, V>,
    /// Rate at which `e_x` rotates about `n` relative to the vector carried along.
    pub(super) rate_about_axis: f64,
    /// `w.n`, constant.
    pub(super) casimir: f64,
    /// `2 |C| (s_max - s_min) / I^xx`, the largest possible change of `|w|^2`.
    pub(super) spread: f64,
    /// Bound of `|w|` from the energy.
    pub(super) largest_rate: f64,
}

impl<const V: usize> PrincipalProblem<V> {
    pub(super) fn new<X: RotationState<f64>>(problem: &Problem<f64, X>) -> Result<Self, Error> {
        problem.require_rigid()?;
        let (spheroid, initial) = (problem.spheroid(), problem.start::<V>());
        let frame = principal_frame(problem.coefficients())?;
        let turn = frame.principal_from_given;
        let eigenvalues = [frame.coefficients.xx, frame.coefficients.yy, frame.coefficients.zz];
        let inertia = spheroid.inertia_xx;
        let strength = 2.0 * spheroid.constant_c / inertia;
        let field = Field::new(strength, eigenvalues);
        let start = moving(&turn, inertia, &initial);
        let [axis, rate] = [start.vectors[AXIS], start.vectors[RATE]];
        let spread = strength.abs() * (eigenvalues[0] - eigenvalues[2]);
        let largest_rate = (dot(&rate, &rate) + spread).sqrt();
        Error::ensure(
            largest_rate.is_finite(),
            "rate at which the body turns",
            largest_rate,
            "within the range of doubles, and so must its square; choose other units",
        )?;
        Ok(Self {
            field,
            eigenvalues,
            inertia,
            principal_from_given: turn,
            start,
            rate_about_axis: spheroid.rate_about_axis(&initial[AXIS], &initial[RATE]),
            casimir: dot(&rate, &axis),
            spread,
            largest_rate,
        })
    }

    /// `n`, `L` and the vector carried along, in the frame of the given tensor.
    fn given(&self, moving: &Moving<f64, V>) -> [Vector3<f64>; V] {
        let back = self.principal_from_given.transpose();
        let mut vectors = moving.vectors.map(|v| back * Vector3::from(v));
        vectors[RATE] *= self.inertia;
        vectors
    }

    /// `n`, `L` and, if it is followed, `e_x`, which has turned about `n` by an angle.
    pub(super) fn vectors(&self, moving: &Moving<f64, V>, turned: f64) -> [Vector3<f64>; 3] {
        match self.given(moving)[..] {
            [axis, momentum, companion] => body_state([axis, momentum, companion], turned).vectors(),
            ref reduced => [reduced[AXIS], reduced[RATE], Vector3::zeros()],
        }
    }

    /// The start of a motion with the given `n`, `L` and `e_x`.
    pub(super) fn moving(&self, vectors: &[Vector3<f64>; 3]) -> Moving<f64, V> {
        moving(&self.principal_from_given, self.inertia, &core::array::from_fn(|i| vectors[i]))
    }

    pub(super) fn state(&self, moving: &Moving<f64, V>) -> AxisState<f64> {
        let vectors = self.given(moving);
        AxisState { axis: vectors[AXIS], momentum: vectors[RATE] }
    }
}

impl PrincipalProblem<3> {
    /// The state of the body at a time since the start.
    pub(super) fn body_state(&self, moving: &Moving<f64, 3>, elapsed: f64) -> BodyState<f64> {
        body_state(self.given(moving), self.rate_about_axis * elapsed)
    }
}

fn moving<const V: usize>(turn: &Matrix3<f64>, inertia: f64, vectors: &[Vector3<f64>; V]) -> Moving<f64, V> {
    let mut turned = vectors.map(|v| (turn * v).into());
    turned[RATE] = (turn * vectors[RATE] / inertia).into();
    Moving::new(turned)
}

/// A motion by a splitting scheme, stored as states at its steps: [`Problem::splitting`].
///
/// Between two stored states the motion is computed by whole steps and one partial step of the same scheme: at most one
/// whole step for spans below 100,000 steps, and in any case a number that does not depend on the requested time.
#[derive(Debug, Clone)]
pub struct SplittingMotion<X = BodyState<f64>> {
    pub(crate) scheme: &'static Scheme,
    step: f64,
    pub(crate) step_count: u64,
    kept: Kept,
    state: PhantomData<X>,
}

#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time")]
enum Kept {
    Axis(KeptStates<2>),
    Body(KeptStates<3>),
}

/// Applies an expression to either kind of states.
macro_rules! of_either {
    ($motion:expr, $states:ident => $work:expr) => {
        match &$motion.kept {
            Kept::Axis($states) => $work,
            Kept::Body($states) => $work,
        }
    };
}

/// The states of `n`, `L` and, with `V = 3`, the vector carried along.
#[derive(Debug, Clone)]
pub(super) struct KeptStates<const V: usize> {
    spheroid: RigidSpheroid<f64>,
    coefficients: Matrix3<f64>,
    span: (f64, f64),
    pub(super) scheme: &'static Scheme,
    pub(super) scene: PrincipalProblem<V>,
    pub(super) step: f64,
    pub(super) step_count: u64,
    /// Number of whole steps between two stored states.
    stride: u64,
    steps: DoubleSteps,
    /// Open states, every `stride` steps from the start.
    states: Vec<Moving<f64, V>>,
    /// The error of the start, if another motion led to it.
    pub(super) earlier: Option<SplittingErrorAtEnd>,
    /// Computed at the first request.
    estimate: OnceLock<ErrorEstimate>,
}

/// The steps of a motion.
#[derive(Clone, Copy)]
enum Steps {
    /// Steps of a given scheme with a largest length.
    Of(&'static Scheme, f64),
    /// The cheapest steps for a tolerance.
    For { tolerance: f64 },
}

impl<X: RotationState<f64>> Problem<f64, X> {
    /// The motion from the initial state at `span.0` to `span.1` (forwards or backwards), by equal steps of `scheme` no longer than `step`.
    /// Their number is even, as the error estimate requires.
    ///
    /// Every step is a composition of exact flows, so that `|n|` and `L.n` are conserved to rounding for any number of steps
    /// and the energy has no secular error. The third angle adds little cost, because the axis does not depend on it.
    ///
    /// # Errors
    /// [`Error::Domain`] for a span that is not finite, a step that is not above zero or is so long that the numbers of the
    /// motion overflow (several radians), and more than [`SPLITTING_STEP_LIMIT`] steps.
    pub fn splitting_by(
        &self,
        scheme: &'static Scheme,
        span: (f64, f64),
        step: f64,
    ) -> Result<SplittingMotion<X>, Error> {
        check_request(span, TOLERANCE_RANGE.0)?;
        self.split(span, Steps::Of(scheme, step))
    }

    /// The motion by the scheme and the step that a model of cost and error chooses for `tolerance` at the end of the
    /// span (components of `n`, and of `L` in units of `|L| + sqrt(2 I^xx C |s|)`), between 1e-16 and 1e-2.
    ///
    /// The model is one formula for all motions. It does not predict the growth of errors near the unstable middle axis;
    /// [`error_estimate`](Motion::error_estimate) does. Rounding limits the accuracy to some 1e-16 times the rotation angle.
    ///
    /// # Errors
    /// As for [`splitting_by`](Self::splitting_by), and for a tolerance out of range.
    pub fn splitting(&self, span: (f64, f64), tolerance: f64) -> Result<SplittingMotion<X>, Error> {
        check_request(span, tolerance)?;
        self.split(span, Steps::For { tolerance })
    }

    fn split(&self, span: (f64, f64), steps: Steps) -> Result<SplittingMotion<X>, Error> {
        let kept = if const { X::VECTORS == 3 } {
            Kept::Body(KeptStates::new(self, span, steps)?)
        } else {
            Kept::Axis(KeptStates::new(self, span, steps)?)
        };
        let (scheme, step, step_count) = match &kept {
            Kept::Axis(states) => (states.scheme, states.step, states.step_count),
            Kept::Body(states) => (states.scheme, states.step, states.step_count),
        };
        Ok(SplittingMotion { scheme, step, step_count, kept, state: PhantomData })
    }
}

impl<const V: usize> KeptStates<V> {
    fn new<X: RotationState<f64>>(problem: &Problem<f64, X>, span: (f64, f64), steps: Steps) -> Result<Self, Error> {
        let scene = PrincipalProblem::new(problem)?;
        let (scheme, step) = match steps {
            Steps::Of(scheme, step) => (scheme, step),
            Steps::For { tolerance } => {
                let SplittingForecast { scheme, step, .. } = cheapest(&scene, span, tolerance, Goal::State);
                (scheme, step)
            }
        };
        Error::ensure(step > 0.0 && step.is_finite(), "step", step, "above zero and finite")?;
        let duration = span.1 - span.0;
        let count = 2.0 * (duration.abs() / step / 2.0 * (1.0 - 1e-14)).ceil().max(1.0);
        Error::ensure(count <= SPLITTING_STEP_LIMIT, "number of steps", count, "at most 1e10")?;
        let (step_count, whole) = (count as u64, duration / count);
        let stride = step_count.div_ceil(MOST_STATES);
        let steps = DoubleSteps::new(scheme, &scene.field, whole, scene.largest_rate);
        let mut states = Vec::with_capacity((step_count / stride + 1) as usize);
        let mut state = scene.start;
        steps.open(&mut state);
        states.push(state);
        steps.keep(&mut state, scene.casimir, (stride, step_count / stride), &mut states);
        let end = states.last().map_or(0.0, |state| state.vectors.iter().flatten().sum());
        Error::ensure(end.is_finite(), "step", step, "shorter; with this step the motion leaves the range of doubles")?;
        let (spheroid, coefficients, estimate) = (*problem.spheroid(), *problem.coefficients(), OnceLock::new());
        Ok(Self {
            spheroid,
            coefficients,
            span,
            scheme,
            scene,
            step: whole,
            step_count,
            stride,
            steps,
            states,
            earlier: None,
            estimate,
        })
    }

    /// The state after a number of whole steps.
    pub(super) fn after(&self, whole: u64) -> Moving<f64, V> {
        let kept = whole / self.stride;
        let mut state = self.states[kept as usize];
        self.steps.advance(&mut state, self.scene.casimir, whole - kept * self.stride);
        self.steps.close(&mut state);
        state
    }

    /// The state at time `t` of the span.
    fn at(&self, t: f64) -> Result<Moving<f64, V>, Error> {
        check_time(self.span, t)?;
        let elapsed = t - self.span.0;
        let whole = ((elapsed / self.step).floor().max(0.0) as u64).min(self.step_count);
        let mut state = self.after(whole);
        // The time of the step, including the rounding error of its product.
        let (time, lost) = two_product(whole as f64, self.step);
        let offset = (elapsed - time) - lost;
        if offset != 0.0 {
            let partial = DoubleSteps::new(self.scheme, &self.scene.field, offset, self.scene.largest_rate);
            partial.single(&mut state, self.scene.casimir);
        }
        Ok(state)
    }

    fn error_estimate(&self, t: f64) -> f64 {
        if check_time(self.span, t).is_err() {
            return f64::NAN;
        }
        self.estimate().at((t - self.span.0).abs())
    }

    fn estimate(&self) -> &ErrorEstimate {
        self.estimate.get_or_init(|| ErrorEstimate::new(self))
    }

    /// Decrease of the rate at which `e_x` turns about `n` if `w.n` is larger by `casimir`.
    pub(super) fn rate_about_axis_for(&self, casimir: f64) -> f64 {
        let RigidSpheroid { inertia_xx, inertia_zz, .. } = self.spheroid;
        self.spheroid.oblateness() * inertia_xx / inertia_zz * casimir
    }
}

impl<X> SplittingMotion<X> {
    /// The error at the end, for a motion that goes on from there.
    pub(crate) fn error_at_end(&self) -> SplittingErrorAtEnd {
        of_either!(self, states => states.estimate().at_end.clone())
    }

    /// This motion with an error of its start.
    pub(crate) fn with_initial_error(mut self, error: SplittingErrorAtEnd) -> Self {
        match &mut self.kept {
            Kept::Axis(states) => (states.earlier, states.estimate) = (Some(error), OnceLock::new()),
            Kept::Body(states) => (states.earlier, states.estimate) = (Some(error), OnceLock::new()),
        }
        self
    }

    /// The scheme.
    pub fn scheme(&self) -> &'static Scheme {
        self.scheme
    }

    /// Length of one step, negative for a motion backwards in time.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Number of steps, even.
    pub fn step_count(&self) -> u64 {
        self.step_count
    }
}

impl<X: RotationState<f64>> Motion<f64> for SplittingMotion<X> {
    type State = X;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        of_either!(self, states => &states.spheroid)
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        of_either!(self, states => &states.coefficients)
    }

    fn span(&self) -> (f64, f64) {
        of_either!(self, states => states.span)
    }

    fn state(&self, t: f64) -> Result<X, Error> {
        Ok(X::from_vectors(match &self.kept {
            Kept::Axis(states) => states.scene.state(&states.at(t)?).vectors(),
            Kept::Body(states) => states.scene.body_state(&states.at(t)?, t - states.span.0).vectors(),
        }))
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        of_either!(self, states => Ok(states.scene.state(&states.at(t)?)))
    }

    /// Six times the difference from a motion by a more accurate scheme. It is computed at the first request: that motion
    /// takes at least two and a half times as long as this one.
    fn error_estimate(&self, t: f64) -> f64 {
        of_either!(self, states => states.error_estimate(t))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::fixture::axis_problem;
    use crate::propagation::splitting::{STRANG, Splitting};

    const S: [f64; 3] = [0.3, 0.1, -0.4];

    impl SplittingMotion<AxisState<f64>> {
        pub(in crate::propagation::splitting) fn axis_states(&self) -> &KeptStates<2> {
            let Kept::Axis(states) = &self.kept else { unreachable!("it has no e_x") };
            states
        }
    }

    /// With `w.n = c` the rotation about `n` is that of `L.n = I^xx c`.
    #[test]
    fn the_rate_about_the_axis_is_that_of_the_momentum() {
        let motion = motion((0.0, 1.0), 0.1).unwrap();
        let (states, star) = (motion.axis_states(), motion.spheroid());
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let expected = star.rate_about_axis(&axis, &(axis * (star.inertia_xx * 0.3)));
        assert_relative_eq!(states.rate_about_axis_for(0.3), -expected, max_relative = 1e-15, epsilon = 0.0);
    }

    fn motion(span: (f64, f64), step: f64) -> Result<SplittingMotion<AxisState<f64>>, Error> {
        axis_problem(S).splitting_by(&STRANG, span, step)
    }

    #[test]
    fn steps_are_finite_and_above_zero() {
        for step in [0.0, -0.1, f64::INFINITY, f64::NAN] {
            let Err(Error::Domain { quantity, allowed, .. }) = motion((0.0, 1.0), step) else { panic!("{step}") };
            assert_eq!((quantity, allowed), ("step", "above zero and finite"));
        }
    }

    #[test]
    fn the_number_of_steps_is_the_least_even_one_but_for_rounding() {
        let count = |duration: f64, step: f64| motion((0.0, duration), step).unwrap().step_count;
        // 1.1 / 0.1 / 2 and the like exceed an integer by a rounding.
        for (duration, step, expected) in [(1.0, 7.0, 2), (1.0, 0.3, 4), (0.6, 0.1, 6), (2.2, 0.1, 22), (6.6, 1.1, 6)] {
            assert_eq!(count(duration, step), expected, "{duration} / {step}");
            assert_eq!(count(-duration, step), expected, "{duration} / {step}");
        }
        let above = 1.0 + 2.0 * f64::EPSILON;
        assert_eq!([count(8.0 * above, 1.0), count(8.0 + 8e-12, 1.0)], [8, 10]);
    }

    /// Of 200,002 steps every third state is stored, and the storage has exactly this size.
    #[test]
    fn long_motions_keep_some_of_their_states() {
        let (step, count) = (0.01, 200_002);
        let motion = motion((0.0, step * count as f64), step).unwrap();
        let long = motion.axis_states();
        assert_eq!((long.step_count, long.stride), (count, 3));
        assert_eq!((long.states.len(), long.states.capacity()), (66_668, 66_668));
        let mut alone = Splitting::new(&axis_problem(S), &STRANG, long.step).unwrap();
        let mut done = 0;
        for whole in [1, 2, 3, 1004, 9998] {
            alone.advance(whole - done);
            done = whole;
            let found = long.scene.state(&long.after(whole));
            assert!((found.axis - alone.state().axis).amax() < 1e-11, "{whole}");
            assert!((found.momentum - alone.state().momentum).amax() < 1e-11, "{whole}");
        }
        assert_relative_eq!(motion.axis_state(step * count as f64).unwrap().axis.norm(), 1.0, max_relative = 1e-12);
    }

    /// The rounding error of the product of the number of steps and their length is computed here with a fused product.
    #[test]
    fn the_time_of_a_step_is_taken_without_its_rounding() {
        let motion = motion((0.0, 700.0), 0.7).unwrap();
        let lost = |whole: u64| (-(whole as f64)).mul_add(motion.step, whole as f64 * motion.step);
        let late: Vec<u64> = (740..1000).filter(|&whole| lost(whole) > 4e-14).collect();
        assert!(late.len() > 3);
        for whole in late {
            let kept = motion.axis_states();
            let mut state = kept.after(whole);
            let rest = DoubleSteps::new(&STRANG, &kept.scene.field, lost(whole), kept.scene.largest_rate);
            rest.single(&mut state, kept.scene.casimir);
            let found = motion.axis_state(whole as f64 * motion.step).unwrap();
            assert!((found.axis - kept.scene.state(&state).axis).amax() < 1e-15, "{whole}");
        }
    }

    /// A time within the first step is reached by one shorter step from the start.
    #[test]
    fn the_first_step_begins_at_the_start() {
        for sense in [1.0, -1.0] {
            let whole = motion((0.0, 4.0 * sense), 0.5).unwrap();
            for t in [0.1, 0.3, 0.45] {
                let alone = whole.axis_states();
                let partial = DoubleSteps::new(&STRANG, &alone.scene.field, t * sense, alone.scene.largest_rate);
                let mut state = alone.after(0);
                partial.single(&mut state, alone.scene.casimir);
                assert_eq!(alone.at(t * sense).unwrap().vectors, state.vectors, "{t}");
            }
        }
    }
}
