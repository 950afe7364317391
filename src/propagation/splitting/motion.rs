//! A motion kept as states at the steps of a splitting scheme.

use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::propagation::input::check_input;
use crate::propagation::splitting::error::ErrorEstimate;
use crate::propagation::splitting::flows::{Field, Pair, dot};
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::splitting::stepper::Steps;
use crate::propagation::{ACCURACY_RANGE, AxisMotion, AxisState};
use crate::rounding::two_product;

/// Most steps of one motion.
pub const SPLITTING_STEP_LIMIT: f64 = 1e10;

/// Most states that one motion keeps: 100 bytes each.
const MOST_STATES: u64 = 100_000;

/// The body and its surroundings in the principal frame of `s^IJ`.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    pub(super) field: Field<f64>,
    inertia: f64,
    principal_from_given: Matrix3<f64>,
    pub(super) start: Pair<f64>,
    /// `w.n`, constant.
    pub(super) casimir: f64,
    /// `2 |C| (s_max - s_min) / I^xx`, the most that `|w|^2` can change.
    pub(super) spread: f64,
    /// Bound of `|w|` by the energy.
    pub(super) largest_rate: f64,
}

impl Scene {
    pub(super) fn new(
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        initial: &AxisState<f64>,
    ) -> Result<Self, Error> {
        let frame = principal_frame(s)?;
        let turn = frame.principal_from_given;
        let eigenvalues = [frame.coefficients.xx, frame.coefficients.yy, frame.coefficients.zz];
        let inertia = spheroid.inertia_xx;
        let strength = 2.0 * spheroid.constant_c / inertia;
        let field = Field::new(strength, eigenvalues);
        let start = Pair::new((turn * initial.axis).into(), (turn * initial.momentum / inertia).into());
        let spread = strength.abs() * (eigenvalues[0] - eigenvalues[2]);
        let largest_rate = (dot(&start.rate, &start.rate) + spread).sqrt();
        Error::unless(
            largest_rate.is_finite(),
            "rate at which the body turns",
            largest_rate,
            "within the range of doubles with its square: choose other units",
        )?;
        Ok(Self {
            field,
            inertia,
            principal_from_given: turn,
            start,
            casimir: dot(&start.rate, &start.axis),
            spread,
            largest_rate,
        })
    }

    pub(super) fn state(&self, pair: &Pair<f64>) -> AxisState<f64> {
        let back = self.principal_from_given.transpose();
        AxisState { axis: back * Vector3::from(pair.axis), momentum: back * Vector3::from(pair.rate) * self.inertia }
    }
}

/// The motion of `n` and `L` by a splitting scheme, kept as states at its steps.
///
/// Between two kept states the motion is found by whole steps and one partial step of the same scheme; no more than one
/// whole step for spans below 100,000 steps, and in any case a number that does not depend on the time asked.
#[derive(Debug, Clone)]
pub struct SplittingMotion {
    spheroid: RigidSpheroid<f64>,
    violation: Matrix3<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    pub(super) scene: Scene,
    step: f64,
    step_count: u64,
    /// Whole steps between two kept states.
    stride: u64,
    steps: Steps<f64>,
    /// Open states, every `stride` steps from the start.
    states: Vec<Pair<f64>>,
    /// Found when it is first asked for.
    estimate: OnceLock<ErrorEstimate>,
}

/// The motion of `n` and `L` from `initial` at `span.0` to `span.1` (forwards or backwards), by equal steps of `scheme` no longer
/// than `step`; their number is even, for the sake of the error estimate.
///
/// Every step is a composition of exact flows, so that `|n|` and `L.n` keep their values to rounding for any number of
/// steps and the energy has no secular error. `s` is the tensor `s^IJ` in the inertial frame of `initial`, which may be any.
///
/// # Errors
/// [`Error::Domain`] for a state, parameter or span that is not finite, an axis that is not a unit vector (to 1e-9), moments of
/// inertia that are not positive, a tensor that is not symmetric, a step that is not above zero, and more than
/// [`SPLITTING_STEP_LIMIT`] steps.
pub fn propagate_by_splitting(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &AxisState<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    step: f64,
) -> Result<SplittingMotion, Error> {
    check_splitting_input(spheroid, s, initial, span, ACCURACY_RANGE.0)?;
    let scene = Scene::new(spheroid, s, initial)?;
    propagate_checked(spheroid, s, span, scheme, scene, step)
}

/// Refuses what is not finite, not a unit vector or out of range.
pub(super) fn check_splitting_input(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &AxisState<f64>,
    span: (f64, f64),
    accuracy: f64,
) -> Result<(), Error> {
    check_input(spheroid, s, &[initial.axis, initial.momentum], span, accuracy)
}

/// The motion from input that has been checked.
pub(super) fn propagate_checked(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    scene: Scene,
    step: f64,
) -> Result<SplittingMotion, Error> {
    Error::unless(step > 0.0 && step.is_finite(), "step", step, "above zero and finite")?;
    let duration = span.1 - span.0;
    let count = 2.0 * (duration.abs() / step / 2.0 * (1.0 - 1e-14)).ceil().max(1.0);
    Error::unless(count <= SPLITTING_STEP_LIMIT, "number of steps", count, "at most 1e10")?;
    Ok(SplittingMotion::run(spheroid, s, span, scheme, scene, duration / count, count as u64))
}

impl SplittingMotion {
    fn run(
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        span: (f64, f64),
        scheme: &'static Scheme,
        scene: Scene,
        step: f64,
        step_count: u64,
    ) -> Self {
        let stride = step_count.div_ceil(MOST_STATES);
        let steps = Steps::new(scheme, &scene.field, step, scene.largest_rate);
        let mut states = Vec::with_capacity((step_count / stride + 1) as usize);
        let mut state = scene.start;
        steps.open(&mut state);
        states.push(state);
        for _ in 0..step_count / stride {
            steps.advance(&mut state, scene.casimir, stride);
            states.push(state);
        }
        let (spheroid, violation) = (*spheroid, *s);
        Self {
            spheroid,
            violation,
            span,
            scheme,
            scene,
            step,
            step_count,
            stride,
            steps,
            states,
            estimate: OnceLock::new(),
        }
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

    /// The state after a number of whole steps.
    pub(super) fn after(&self, whole: u64) -> Pair<f64> {
        let kept = whole / self.stride;
        let mut state = self.states[kept as usize];
        self.steps.advance(&mut state, self.scene.casimir, whole - kept * self.stride);
        self.steps.close(&mut state);
        state
    }

    /// The state at time `t` of the span.
    fn at(&self, t: f64) -> Pair<f64> {
        let elapsed = t - self.span.0;
        let whole = ((elapsed / self.step).floor().max(0.0) as u64).min(self.step_count);
        let mut state = self.after(whole);
        // The time of the step without the rounding of its product.
        let (time, lost) = two_product(whole as f64, self.step);
        let offset = (elapsed - time) - lost;
        if offset != 0.0 {
            let partial = Steps::new(self.scheme, &self.scene.field, offset, self.scene.largest_rate);
            partial.single(&mut state, self.scene.casimir);
        }
        state
    }
}

impl AxisMotion<f64> for SplittingMotion {
    fn spheroid(&self) -> &RigidSpheroid<f64> {
        &self.spheroid
    }

    fn violation(&self) -> &Matrix3<f64> {
        &self.violation
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        let (first, last) = self.span;
        Error::unless(
            first.min(last) <= t && t <= first.max(last),
            "time t",
            t,
            "within the span for which the motion was propagated",
        )?;
        Ok(self.scene.state(&self.at(t)))
    }

    /// Three times the difference from a motion by a better scheme, found when it is first asked for: that motion takes about
    /// two and a half times as long as this one, five times for the scheme of order 2.
    fn error_estimate(&self, t: f64) -> f64 {
        let (first, last) = self.span;
        if !(first.min(last) <= t && t <= first.max(last)) {
            return f64::NAN;
        }
        let estimate = self.estimate.get_or_init(|| ErrorEstimate::new(self));
        estimate.at((t - first).abs())
    }
}
