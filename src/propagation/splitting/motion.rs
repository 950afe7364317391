//! A motion kept as states at the steps of a splitting scheme.

use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::propagation::input::{check_input, check_time};
use crate::propagation::splitting::error::ErrorEstimate;
use crate::propagation::splitting::flows::{AXIS, Field, Moving, RATE, dot};
use crate::propagation::splitting::one_motion::OneMotion;
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::third_angle::{body_state, rate_about_axis};
use crate::propagation::{ACCURACY_RANGE, AxisMotion, AxisState, Motion, Turning};
use crate::rounding::two_product;

/// Most steps of one motion.
pub const SPLITTING_STEP_LIMIT: f64 = 1e10;

/// Most states that one motion keeps: 100 bytes each.
const MOST_STATES: u64 = 100_000;

/// The body and its surroundings in the principal frame of `s^IJ`.
#[derive(Debug, Clone)]
pub(super) struct Scene<const V: usize = 2> {
    pub(super) field: Field<f64>,
    /// Of `s^IJ`, in descending order.
    pub(super) eigenvalues: [f64; 3],
    pub(super) inertia: f64,
    pub(super) principal_from_given: Matrix3<f64>,
    pub(super) start: Moving<f64, V>,
    /// Rate at which `e_x` turns about `n` against the vector carried along.
    pub(super) rate_about_axis: f64,
    /// `w.n`, constant.
    pub(super) casimir: f64,
    /// `2 |C| (s_max - s_min) / I^xx`, the most that `|w|^2` can change.
    pub(super) spread: f64,
    /// Bound of `|w|` by the energy.
    pub(super) largest_rate: f64,
}

impl<const V: usize> Scene<V> {
    /// `initial` has `n`, `L` and, with `V = 3`, `e_x`.
    pub(super) fn new(
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        initial: &[Vector3<f64>; V],
    ) -> Result<Self, Error> {
        let frame = principal_frame(s)?;
        let turn = frame.principal_from_given;
        let eigenvalues = [frame.coefficients.xx, frame.coefficients.yy, frame.coefficients.zz];
        let inertia = spheroid.inertia_xx;
        let strength = 2.0 * spheroid.constant_c / inertia;
        let field = Field::new(strength, eigenvalues);
        let mut start = initial.map(|v| (turn * v).into());
        start[RATE] = (turn * initial[RATE] / inertia).into();
        let start = Moving::new(start);
        let [axis, rate] = [start.vectors[AXIS], start.vectors[RATE]];
        let spread = strength.abs() * (eigenvalues[0] - eigenvalues[2]);
        let largest_rate = (dot(&rate, &rate) + spread).sqrt();
        Error::unless(
            largest_rate.is_finite(),
            "rate at which the body turns",
            largest_rate,
            "within the range of doubles with its square: choose other units",
        )?;
        Ok(Self {
            field,
            eigenvalues,
            inertia,
            principal_from_given: turn,
            start,
            rate_about_axis: rate_about_axis(spheroid, &initial[AXIS], &initial[RATE]),
            casimir: dot(&rate, &axis),
            spread,
            largest_rate,
        })
    }

    /// `n`, `L` and the vector carried along, in the frame of the tensor given.
    fn given(&self, moving: &Moving<f64, V>) -> [Vector3<f64>; V] {
        let back = self.principal_from_given.transpose();
        let mut vectors = moving.vectors.map(|v| back * Vector3::from(v));
        vectors[RATE] *= self.inertia;
        vectors
    }

    pub(super) fn state(&self, moving: &Moving<f64, V>) -> AxisState<f64> {
        let vectors = self.given(moving);
        AxisState { axis: vectors[AXIS], momentum: vectors[RATE] }
    }
}

impl Scene<3> {
    /// The state of the body at a time since the start.
    pub(super) fn body_state(&self, moving: &Moving<f64, 3>, elapsed: f64) -> BodyState<f64> {
        body_state(self.given(moving), self.rate_about_axis * elapsed)
    }
}

/// The motion of `n`, `L` and, with `V = 3`, `e_x` by a splitting scheme, kept as states at its steps.
///
/// Between two kept states the motion is found by whole steps and one partial step of the same scheme; no more than one
/// whole step for spans below 100,000 steps, and in any case a number that does not depend on the time asked.
#[derive(Debug, Clone)]
pub struct SplittingMotion<const V: usize = 2> {
    spheroid: RigidSpheroid<f64>,
    violation: Matrix3<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    pub(super) scene: Scene<V>,
    step: f64,
    step_count: u64,
    /// Whole steps between two kept states.
    stride: u64,
    steps: OneMotion,
    /// Open states, every `stride` steps from the start.
    states: Vec<Moving<f64, V>>,
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
/// inertia that are not positive, a tensor that is not symmetric, a step that is not above zero, or so long that the numbers of the
/// motion overflow (several radians), and more than [`SPLITTING_STEP_LIMIT`] steps.
pub fn propagate_by_splitting(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &AxisState<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    step: f64,
) -> Result<SplittingMotion, Error> {
    propagate_by(spheroid, s, &vectors_of_axis(initial), span, scheme, step)
}

/// The whole rotation by equal steps of `scheme` no longer than `step`, as [`propagate_by_splitting`]: the third angle costs little
/// beside the axis, which does not wait for it.
///
/// # Errors
/// As for [`propagate_by_splitting`], and for `e_x` that is not a unit vector normal to the axis (to 1e-9).
pub fn propagate_orientation_by_splitting(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &BodyState<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    step: f64,
) -> Result<SplittingMotion<3>, Error> {
    propagate_by(spheroid, s, &vectors_of_body(initial), span, scheme, step)
}

pub(super) fn vectors_of_axis(state: &AxisState<f64>) -> [Vector3<f64>; 2] {
    [state.axis, state.momentum]
}

pub(super) fn vectors_of_body(state: &BodyState<f64>) -> [Vector3<f64>; 3] {
    [state.axis, state.momentum, state.equatorial_axis]
}

fn propagate_by<const V: usize>(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &[Vector3<f64>; V],
    span: (f64, f64),
    scheme: &'static Scheme,
    step: f64,
) -> Result<SplittingMotion<V>, Error> {
    check_input(spheroid, s, initial, span, ACCURACY_RANGE.0)?;
    let scene = Scene::new(spheroid, s, initial)?;
    propagate_checked(spheroid, s, span, scheme, scene, step)
}

/// The motion from input that has been checked.
pub(super) fn propagate_checked<const V: usize>(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    span: (f64, f64),
    scheme: &'static Scheme,
    scene: Scene<V>,
    step: f64,
) -> Result<SplittingMotion<V>, Error> {
    Error::unless(step > 0.0 && step.is_finite(), "step", step, "above zero and finite")?;
    let duration = span.1 - span.0;
    let count = 2.0 * (duration.abs() / step / 2.0 * (1.0 - 1e-14)).ceil().max(1.0);
    Error::unless(count <= SPLITTING_STEP_LIMIT, "number of steps", count, "at most 1e10")?;
    let motion = SplittingMotion::run(spheroid, s, span, scheme, scene, duration / count, count as u64);
    let end = motion.states.last().map_or(0.0, |state| state.vectors.iter().flatten().sum());
    Error::unless(end.is_finite(), "step", step, "shorter: with this one the motion leaves the range of numbers")?;
    Ok(motion)
}

impl<const V: usize> SplittingMotion<V> {
    fn run(
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        span: (f64, f64),
        scheme: &'static Scheme,
        scene: Scene<V>,
        step: f64,
        step_count: u64,
    ) -> Self {
        let stride = step_count.div_ceil(MOST_STATES);
        let steps = OneMotion::new(scheme, &scene.field, step, scene.largest_rate);
        let mut states = Vec::with_capacity((step_count / stride + 1) as usize);
        let mut state = scene.start;
        steps.open(&mut state);
        states.push(state);
        steps.keep(&mut state, scene.casimir, (stride, step_count / stride), &mut states);
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
        // The time of the step without the rounding of its product.
        let (time, lost) = two_product(whole as f64, self.step);
        let offset = (elapsed - time) - lost;
        if offset != 0.0 {
            let partial = OneMotion::new(self.scheme, &self.scene.field, offset, self.scene.largest_rate);
            partial.single(&mut state, self.scene.casimir);
        }
        Ok(state)
    }
}

impl<const V: usize> AxisMotion<f64> for SplittingMotion<V> {
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
        Ok(self.scene.state(&self.at(t)?))
    }

    /// Six times the difference from a motion by a better scheme, found when it is first asked for: that motion takes at least
    /// two and a half times as long as this one.
    fn error_estimate(&self, t: f64) -> f64 {
        if check_time(self.span, t).is_err() {
            return f64::NAN;
        }
        let estimate = self.estimate.get_or_init(|| ErrorEstimate::new(self));
        estimate.at((t - self.span.0).abs())
    }
}

impl Motion<f64> for SplittingMotion<3> {
    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        Ok(self.scene.body_state(&self.at(t)?, t - self.span.0))
    }

    fn turning(&self) -> Turning<'_> {
        Turning::Equations
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::propagation::splitting::{STRANG, Splitting};

    const STAR: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 };

    fn tensor() -> Matrix3<f64> {
        Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, -0.4))
    }

    fn start() -> AxisState<f64> {
        AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.3, -0.7, 1.1) }
    }

    fn motion(span: (f64, f64), step: f64) -> Result<SplittingMotion, Error> {
        propagate_by_splitting(&STAR, &tensor(), &start(), span, &STRANG, step)
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
        let count = |duration: f64, step: f64| motion((0.0, duration), step).unwrap().step_count();
        // 1.1 / 0.1 / 2 and the like are a rounding above a whole number.
        for (duration, step, expected) in [(1.0, 7.0, 2), (1.0, 0.3, 4), (0.6, 0.1, 6), (2.2, 0.1, 22), (6.6, 1.1, 6)] {
            assert_eq!(count(duration, step), expected, "{duration} / {step}");
            assert_eq!(count(-duration, step), expected, "{duration} / {step}");
        }
        let above = 1.0 + 2.0 * f64::EPSILON;
        assert_eq!([count(8.0 * above, 1.0), count(8.0 + 8e-12, 1.0)], [8, 10]);
    }

    /// 200,002 steps are kept at every third of them, with room for no more.
    #[test]
    fn long_motions_keep_some_of_their_states() {
        let (step, count) = (0.01, 200_002);
        let long = motion((0.0, step * count as f64), step).unwrap();
        assert_eq!((long.step_count(), long.stride), (count, 3));
        assert_eq!((long.states.len(), long.states.capacity()), (66_668, 66_668));
        let mut alone = Splitting::new(&STAR, &tensor(), &start(), &STRANG, long.step()).unwrap();
        let mut done = 0;
        for whole in [1, 2, 3, 1004, 9998] {
            alone.advance(whole - done);
            done = whole;
            let found = long.scene.state(&long.after(whole));
            assert!((found.axis - alone.state().axis).amax() < 1e-11, "{whole}");
            assert!((found.momentum - alone.state().momentum).amax() < 1e-11, "{whole}");
        }
        assert_relative_eq!(long.axis_state(step * count as f64).unwrap().axis.norm(), 1.0, max_relative = 1e-12);
    }

    #[test]
    fn between_its_steps_a_motion_goes_by_one_step_of_the_rest() {
        let motion = motion((0.0, 8.0), 2.0).unwrap();
        for (time, whole, rest) in [(0.7, 0, 0.7), (1.0, 0, 1.0), (4.5, 2, 0.5), (7.0, 3, 1.0)] {
            let mut state = motion.after(whole);
            let partial = OneMotion::new(&STRANG, &motion.scene.field, rest, motion.scene.largest_rate);
            partial.single(&mut state, motion.scene.casimir);
            let (found, expected) = (motion.axis_state(time).unwrap(), motion.scene.state(&state));
            assert!((found.axis - expected.axis).amax() < 1e-15 && (found.momentum - expected.momentum).amax() < 1e-15);
        }
    }

    /// What the product of the number of steps and their length loses is known by a fused product here.
    #[test]
    fn the_time_of_a_step_is_taken_without_its_rounding() {
        let motion = motion((0.0, 700.0), 0.7).unwrap();
        let lost = |whole: u64| (-(whole as f64)).mul_add(motion.step(), whole as f64 * motion.step());
        let late: Vec<u64> = (740..1000).filter(|&whole| lost(whole) > 4e-14).collect();
        assert!(late.len() > 3);
        for whole in late {
            let mut state = motion.after(whole);
            let rest = OneMotion::new(&STRANG, &motion.scene.field, lost(whole), motion.scene.largest_rate);
            rest.single(&mut state, motion.scene.casimir);
            let found = motion.axis_state(whole as f64 * motion.step()).unwrap();
            assert!((found.axis - motion.scene.state(&state).axis).amax() < 1e-15, "{whole}");
        }
    }
}
