//! The motion of a scene at the times of its output. A long motion is computed segment by segment, so that memory does not grow with its span.

use twofold::Error;
use twofold::dynamics::{AxisState, BodyState, Problem, RotationState};
use twofold::euler_angles::EulerAngles;
use twofold::plan::{Counted, Method, Output, Plan, PlannedMotion, State, Work};
use twofold::propagation::{ContinuousAngles, Motion, TOLERANCE_RANGE};

use crate::scene_file::Scene;

/// Rotation, in rad, up to which a motion is one series: memory for it is requested from the system only once.
const ROTATION_AS_A_WHOLE: f64 = 5e4;

/// Rotation per segment of a longer motion, in rad. Its series take some 14 MB; segments ten times as long took five times
/// as long in all, because each had to get fresh memory from the system.
const ROTATION_PER_SEGMENT: f64 = 5e3;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time since the start, in t_c.
    pub since_start: f64,
    pub state: SampledState,
    /// The Euler angles including whole turns, if the plan counts turns; `None` if the symmetry axis is at a pole.
    pub angles: Option<EulerAngles<f64>>,
    /// Estimated error, see [`Motion::error_estimate`], if requested.
    pub error_estimate: Option<f64>,
}

/// The part of a state that a plan computes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SampledState {
    Nothing,
    Axis(AxisState<f64>),
    Orientation(BodyState<f64>),
}

impl Sample {
    pub fn new(since_start: f64, state: SampledState) -> Self {
        Self { since_start, state, angles: None, error_estimate: None }
    }

    pub fn axis(&self) -> AxisState<f64> {
        match &self.state {
            SampledState::Axis(state) => *state,
            SampledState::Orientation(state) => state.axis_state(),
            SampledState::Nothing => panic!("the output needs no state"),
        }
    }

    pub fn orientation(&self) -> &BodyState<f64> {
        match &self.state {
            SampledState::Orientation(state) => state,
            SampledState::Nothing | SampledState::Axis(_) => panic!("the output needs no orientation"),
        }
    }
}

/// The errors of a motion that are estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ErrorEstimates {
    None,
    AtEnd,
    OfEachSample,
}

/// The estimated error of a motion at the end of its span, if requested, and the work for the motion.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sampled {
    pub(crate) error: Option<f64>,
    pub(crate) work: Work,
}

/// `n` and `L` of a motion at a time.
pub(crate) type AxisStateAt<'m> = dyn Fn(f64) -> Result<AxisState<f64>, Error> + 'm;

/// Computes the motion of `scene` by `plan`. `take` receives each time of the output with the sample there; `after_segment` receives the
/// motion of each segment with its first and last time, after the samples in it.
pub(crate) fn for_each_sample<E: From<Error>>(
    scene: &Scene,
    plan: &Plan,
    estimates: ErrorEstimates,
    mut take: impl FnMut(f64, &Sample) -> Result<(), E>,
    after_segment: impl FnMut(&AxisStateAt<'_>, f64, f64) -> Result<(), E>,
) -> Result<Sampled, E> {
    match plan.state {
        State::Nothing => {
            for time in scene.times.iter() {
                take(time, &Sample::new(scene.since_start(time), SampledState::Nothing))?;
            }
            Ok(Sampled::default())
        }
        State::Axis | State::AxisAndMomentum => {
            sample_segments::<AxisState<f64>, E>(scene, plan, estimates, take, after_segment)
        }
        State::Orientation => sample_segments::<BodyState<f64>, E>(scene, plan, estimates, take, after_segment),
    }
}

fn sample_segments<X: SegmentState, E: From<Error>>(
    scene: &Scene,
    plan: &Plan,
    estimates: ErrorEstimates,
    mut take: impl FnMut(f64, &Sample) -> Result<(), E>,
    mut after_segment: impl FnMut(&AxisStateAt<'_>, f64, f64) -> Result<(), E>,
) -> Result<Sampled, E> {
    let counts_turns = plan.outputs.contains(&Output::EulerAngles);
    let mut times = scene.times.iter().peekable();
    let mut segments = Segments::<X>::new(scene, plan)?;
    let mut start_angles = scene.initial_angles;
    let mut earlier = None;
    let mut sampled = Sampled::default();
    while let Some(Segment { mut motion, from, to, is_last }) = segments.next()? {
        if let Some(earlier) = earlier.take() {
            motion.motion = motion.motion.continuing_from(earlier)?;
        }
        let mut angles: Angles<'_> =
            if counts_turns { X::angles(&motion, from, &start_angles)? } else { Box::new(|_| None) };
        while let Some(time) = times.next_if(|time| is_last || scene.since_start(*time).abs() <= to.abs()) {
            let parts = since_start_within(scene, time, from, to);
            let t = parts[0];
            let error_estimate = (estimates == ErrorEstimates::OfEachSample).then(|| motion.error_estimate(t));
            let (state, angles) = (X::sampled(&motion, parts)?, angles(t));
            take(time, &Sample { since_start: t, state, angles, error_estimate })?;
        }
        if !is_last {
            start_angles = angles(to).unwrap_or(start_angles);
        }
        drop(angles);
        after_segment(&|t| motion.axis_state(t), from, to)?;
        if estimates == ErrorEstimates::AtEnd && is_last {
            sampled.error = Some(motion.error_estimate(to));
        }
        sampled.work += motion.evaluations();
        if estimates != ErrorEstimates::None && !is_last {
            earlier = motion.motion.error_at_end();
        }
    }
    sampled.work += segments.work;
    Ok(sampled)
}

/// The Euler angles at a time, if they exist.
type Angles<'m> = Box<dyn FnMut(f64) -> Option<EulerAngles<f64>> + 'm>;

/// A state of the segments of a motion: `n` and `L`, or the whole orientation.
pub(crate) trait SegmentState: RotationState<f64> {
    /// The state of a motion at the time `t[0] + t[1]`.
    fn sampled(motion: &Counted<PlannedMotion<Self>>, t: [f64; 2]) -> Result<SampledState, Error>;

    /// The Euler angles including whole turns from the time `from`, where they are `start`; `None` if they do not exist.
    fn angles<'m>(
        motion: &'m Counted<PlannedMotion<Self>>,
        from: f64,
        start: &EulerAngles<f64>,
    ) -> Result<Angles<'m>, Error>;
}

impl SegmentState for AxisState<f64> {
    fn sampled(motion: &Counted<PlannedMotion<Self>>, t: [f64; 2]) -> Result<SampledState, Error> {
        motion.axis_state_in_parts(t).map(SampledState::Axis)
    }

    fn angles<'m>(_: &'m Counted<PlannedMotion<Self>>, _: f64, _: &EulerAngles<f64>) -> Result<Angles<'m>, Error> {
        Ok(Box::new(|_| None))
    }
}

impl SegmentState for BodyState<f64> {
    fn sampled(motion: &Counted<PlannedMotion<Self>>, t: [f64; 2]) -> Result<SampledState, Error> {
        motion.state_in_parts(t).map(SampledState::Orientation)
    }

    fn angles<'m>(
        motion: &'m Counted<PlannedMotion<Self>>,
        from: f64,
        start: &EulerAngles<f64>,
    ) -> Result<Angles<'m>, Error> {
        let mut angles = ContinuousAngles::new(motion, from, start)?;
        Ok(Box::new(move |t| angles.at(t).ok()))
    }
}

/// The motion of a scene over the span of a plan, segment by segment.
pub(crate) struct Segments<'s, X> {
    scene: &'s Scene,
    method: Method,
    /// Length of the span in t_c, negative for a span backwards in time.
    total: f64,
    count: usize,
    next: usize,
    from: f64,
    /// The problem with the initial state of the scene.
    problem: Problem<f64, X>,
    /// State at the start of the next segment.
    state: X,
    /// Steps and right-hand sides so far.
    pub(crate) work: Work,
}

/// One segment; times since the start, in t_c.
pub(crate) struct Segment<X> {
    pub motion: Counted<PlannedMotion<X>>,
    pub from: f64,
    pub to: f64,
    pub is_last: bool,
}

/// Number of segments in which a plan for `scene` is computed.
pub(crate) fn segment_count(scene: &Scene, plan: &Plan) -> usize {
    let most =
        if integrated_rotation(scene, plan) > ROTATION_AS_A_WHOLE { ROTATION_PER_SEGMENT } else { f64::INFINITY };
    segments_of(scene, plan, most)
}

/// Number of segments with a rotation of at most `most` rad each.
fn segments_of(scene: &Scene, plan: &Plan, most: f64) -> usize {
    (integrated_rotation(scene, plan) / most).ceil().max(1.0) as usize
}

/// Rotation over the span of a plan, in rad; zero for a method that reaches any time directly.
fn integrated_rotation(scene: &Scene, plan: &Plan) -> f64 {
    if plan.costs_the_same_at_any_time() { 0.0 } else { plan.span.1.abs() * scene.turning_rate() }
}

impl<'s, X: SegmentState> Segments<'s, X> {
    /// The segments of a plan for `scene`, at least one.
    pub fn new(scene: &'s Scene, plan: &Plan) -> Result<Self, Error> {
        Self::of_number(scene, plan, segment_count(scene, plan))
    }

    /// The segments of a plan for `scene` with a rotation of at most `most` rad each.
    #[cfg(test)]
    pub(crate) fn with_rotation(scene: &'s Scene, plan: &Plan, most: f64) -> Result<Self, Error> {
        Self::of_number(scene, plan, segments_of(scene, plan, most))
    }

    fn of_number(scene: &'s Scene, plan: &Plan, count: usize) -> Result<Self, Error> {
        let (what, why) = ("motion of the plan", "none of its outputs needs one");
        let method = plan.method.ok_or(Error::Unsupported { what, why })?;
        let total = plan.span.1;
        let initial = X::from_vectors(scene.problem.initial().vectors());
        let problem = Problem::new(*scene.problem.spheroid(), *scene.problem.coefficients(), initial)?;
        let problem = problem.with_bulge(scene.problem.bulge())?;
        Ok(Self { scene, method, total, count, next: 0, from: 0.0, problem, state: initial, work: Work::default() })
    }

    /// Computes the next segment, if there is one.
    pub fn next(&mut self) -> Result<Option<Segment<X>>, Error> {
        if self.next == self.count {
            return Ok(None);
        }
        self.next += 1;
        let (from, to) = (self.from, self.total * (self.next as f64 / self.count as f64));
        let motion = if self.method.is_closed_form() {
            // The motion starts at the beginning of the scene, so that no error accumulates from segment to segment.
            self.problem.motion_by(self.method, (0.0, self.total), self.scene.tolerance)?
        } else {
            let problem = self.problem.starting_from(self.state)?;
            let motion = problem.motion_by(self.method, (from, to), self.share_of_tolerance(to - from))?;
            self.state = motion.state(to)?.orthonormal();
            motion
        };
        self.work += motion.work();
        self.from = to;
        Ok(Some(Segment { motion: Counted::new(motion), from, to, is_last: self.next == self.count }))
    }

    /// Makes the next segment begin earlier, at a time of this one.
    pub fn resume_at(&mut self, segment: &Segment<X>, time: f64) -> Result<(), Error> {
        self.state = segment.motion.motion.state(time)?.orthonormal();
        self.from = time;
        Ok(())
    }

    /// The fraction of the scene's tolerance that a segment may use, such that the truncation per unit of time is that of
    /// one motion over the whole span: an error made at the time `t` grows with the rotation from `t` on.
    fn share_of_tolerance(&self, length: f64) -> f64 {
        // The length and the total have the same sign.
        let growth = |duration: f64| duration * (1.0 + self.scene.turning_rate() * duration.abs() / 2.0);
        if self.total == 0.0 {
            return self.scene.tolerance;
        }
        // Rounding may exceed both ends of the range that a motion accepts.
        (self.scene.tolerance * growth(length) / growth(self.total)).clamp(TOLERANCE_RANGE.0, TOLERANCE_RANGE.1)
    }
}

/// Converts a time of the output to the time since the start, in t_c, in two doubles. The result is restricted to the segment, because the end of
/// a segment may be a rounding before a time that belongs to it.
fn since_start_within(scene: &Scene, time: f64, from: f64, to: f64) -> [f64; 2] {
    let parts = scene.since_start_in_parts(time);
    let t = parts[0].clamp(from.min(to), from.max(to));
    if t == parts[0] { parts } else { [t, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_without_a_motion_has_no_segments() {
        let scene = Scene::named("tp-2").unwrap();
        let plan = scene.plan(&[]).unwrap();
        let why = Segments::<AxisState<f64>>::new(&scene, &plan).err().unwrap().to_string();
        assert_eq!(why, "motion of the plan: none of its outputs needs one");
    }

    /// An error made at the time `t` grows to `1 + rate (end - t)` times itself by the end. The sum over all segments must stay below the tolerance.
    #[test]
    fn the_errors_of_all_segments_are_within_the_tolerance() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.tolerance = 1e-8;
        scene.choose_method("taylor").unwrap();
        scene.choose_columns(&["e_z"]).unwrap();
        let plan = scene.plan(&scene.columns).unwrap();
        let rate = scene.turning_rate();
        let end = plan.span.1;
        let mut segments = Segments::<AxisState<f64>>::with_rotation(&scene, &plan, rate * end / 20.5).unwrap();
        let (mut sum, mut count) = (0.0, 0);
        while let Some(segment) = segments.next().unwrap() {
            sum += segment.motion.error_estimate(segment.to) * (1.0 + rate * (end - segment.to));
            count += 1;
        }
        assert_eq!(count, 21);
        assert!(sum < scene.tolerance, "{sum:e}");
    }

    /// Neither the start nor the unit of time is a short binary number: the times since the start are rounded.
    #[test]
    fn the_last_time_of_a_scene_is_within_its_span() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.units.time = 0.02156407;
        scene.choose_method("taylor").unwrap();
        scene.choose_columns(&["e_z"]).unwrap();
        for (start, k) in [0.1, 0.3, 0.7].into_iter().flat_map(|start| (1..=30).map(move |k| (start, k))) {
            let last = start + 0.01 * f64::from(k);
            scene.times = crate::scene_file::Times::Listed { start, times: vec![last] };
            let plan = scene.plan(&scene.columns).unwrap();
            let mut taken = Vec::new();
            let take = |time: f64, _: &Sample| -> Result<(), Error> {
                taken.push(time);
                Ok(())
            };
            for_each_sample(&scene, &plan, ErrorEstimates::None, take, |_, _, _| Ok(())).unwrap();
            assert_eq!(taken, [last]);
        }
    }

    /// A scene that rotates by a given number of radians, with samples at these rotations.
    fn scene(name: &str, method: &str, columns: &[&str], rotations: &[f64]) -> (Scene, Plan) {
        let mut scene = Scene::named(name).unwrap();
        scene.choose_method(method).unwrap();
        scene.choose_columns(columns).unwrap();
        let times = rotations.iter().map(|rotation| rotation / scene.turning_rate()).collect();
        scene.times = crate::scene_file::Times::Listed { start: 0.0, times };
        let plan = scene.plan(&scene.columns).unwrap();
        (scene, plan)
    }

    /// A segment begins where and with the state in which the previous one ends, or where it is resumed; the last one ends like a single
    /// motion, to some tolerances of it.
    #[test]
    fn segments_follow_one_another_in_either_sense() {
        for sense in [1.0, -1.0] {
            let (scene, plan) = scene("tp-2", "taylor", &["e_z"], &[sense * 30.0]);
            let mut segments = Segments::<AxisState<f64>>::with_rotation(&scene, &plan, 12.0).unwrap();
            let (mut from, mut state, mut count) = (0.0, scene.problem.initial().axis_state(), 0);
            while let Some(segment) = segments.next().unwrap() {
                let found = segment.motion.motion.state(from).unwrap();
                assert!((found.axis - state.axis).norm() + (found.momentum - state.momentum).norm() < 1e-14);
                assert!(segment.from == from && (segment.to - from) * sense > 0.0, "{from} to {}", segment.to);
                from = if count == 0 { segment.to / 2.0 } else { segment.to };
                state = segment.motion.motion.state(from).unwrap();
                if count == 0 {
                    segments.resume_at(&segment, from).unwrap();
                }
                count += 1;
            }
            let whole = scene.problem.taylor((0.0, scene.duration()), 1e-13).unwrap().state(scene.duration()).unwrap();
            assert!((state.axis - whole.axis).norm() < 10.0 * scene.tolerance && from == scene.duration());
            assert_eq!(count, 3);
        }
    }

    /// Samples are taken from the segments that contain them, also backwards in time: as from the series on the torus.
    #[test]
    fn samples_are_taken_from_their_segments() {
        for sense in [1.0, -1.0] {
            let rotations = [2.8e4, 2.9e4, 5.2e4].map(|rotation| sense * rotation);
            let (mut scene, plan) = scene("tp-2", "splitting", &["e_z"], &rotations);
            scene.tolerance = 1e-8;
            let whole = scene.problem.motion_by(Method::Torus, (0.0, scene.duration()), 1e-12).unwrap();
            let mut count = 0;
            let take = |time: f64, sample: &Sample| {
                let (found, expected) = (sample.axis(), whole.axis_state(time).unwrap());
                assert!((found.axis - expected.axis).norm() < 1e-7, "{time}");
                count += 1;
                Ok::<_, Error>(())
            };
            for_each_sample(&scene, &plan, ErrorEstimates::None, take, |_, _, _| Ok(())).unwrap();
            assert_eq!((count, segment_count(&scene, &plan)), (3, 11));
        }
    }

    /// So that memory does not grow with the span, a motion of more than 5e4 rad is in segments of at most 5e3 rad: 5.2e4 rad are eleven. An error does
    /// not decrease with time at the end of a segment. The error of a closed form, which begins with the scene, does not grow with the number of earlier segments. The
    /// error is requested only at the end, or at the samples.
    #[test]
    fn errors_go_on_over_the_ends_of_segments() {
        // The sixth segment ends at 2.836e4 rad.
        let rotations = [2.8e4, 2.9e4, 5.2e4];
        let errors = |scene: &Scene, plan: &Plan, estimates| {
            let (mut errors, mut ends) = (Vec::new(), vec![0.0]);
            let take = |_, sample: &Sample| {
                errors.extend(sample.error_estimate);
                Ok::<_, Error>(())
            };
            let after = |_: &AxisStateAt<'_>, from: f64, to: f64| {
                assert_eq!(Some(&from), ends.last());
                ends.push(to);
                Ok(())
            };
            let sampled = for_each_sample(scene, plan, estimates, take, after).unwrap();
            assert_eq!(sampled.error.is_some(), estimates == ErrorEstimates::AtEnd);
            (errors, ends.len() - 1)
        };
        let (mut numeric, plan) = scene("tp-2", "taylor", &["e_z"], &rotations);
        numeric.tolerance = 1e-4;
        let (found, segments) = errors(&numeric, &plan, ErrorEstimates::OfEachSample);
        assert!(found.len() == 3 && found.is_sorted(), "{found:?}");
        assert_eq!(segments, 11);
        let (closed, in_segments) = scene("free", "free", &["angles"], &rotations);
        let (of_segments, segments) = errors(&closed, &in_segments, ErrorEstimates::OfEachSample);
        let (of_one, one) =
            errors(&closed, &closed.plan(&[Output::SymmetryAxis]).unwrap(), ErrorEstimates::OfEachSample);
        assert_eq!((segments, one), (11, 1));
        assert_eq!(of_segments, of_one);
        let (short, plan) = scene("tp-2", "taylor", &["e_z"], &[1.0]);
        for estimates in [ErrorEstimates::None, ErrorEstimates::AtEnd] {
            assert_eq!(errors(&short, &plan, estimates), (Vec::new(), 1));
        }
    }

    /// Errors of the same size in every unit of time grow to `1 + rate (T - t)` times themselves, in total to `T + rate T^2 / 2`: with `rate T = 2`
    /// this is `2 T`, and over half of the span `3 T / 4`.
    #[test]
    fn half_of_a_span_has_less_than_half_of_the_tolerance() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.tolerance = 1e-6;
        for sense in [1.0, -1.0] {
            let last = sense * 2.0 / scene.turning_rate();
            scene.times = crate::scene_file::Times::Listed { start: 0.0, times: vec![last] };
            let plan = scene.plan(&scene.columns).unwrap();
            let segments = Segments::<BodyState<f64>>::new(&scene, &plan).unwrap();
            let share = segments.share_of_tolerance(last / 2.0);
            assert!((share / 0.375e-6 - 1.0).abs() < 8.0 * f64::EPSILON, "{share:e}");
        }
    }

    /// A span of zero length gives its whole tolerance to a segment of zero length.
    #[test]
    fn a_span_of_no_length_has_all_of_the_tolerance() {
        let (scene, plan) = scene("tp-2", "taylor", &["e_z"], &[0.0]);
        let segments = Segments::<BodyState<f64>>::new(&scene, &plan).unwrap();
        assert_eq!(segments.share_of_tolerance(0.0), scene.tolerance);
    }

    /// The time of a sample has two parts, and is set to the end if it exceeds it by rounding.
    #[test]
    fn samples_are_kept_within_their_segment() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.times = crate::scene_file::Times::Even { start: 1.0, end: 4.0, samples: 2 };
        let within = |time, from, to| since_start_within(&scene, time, from, to);
        // 0.3 is not a double: the rounding error of the difference from 1 is in the second part.
        assert_eq!(within(1.3, 0.0, 3.0), scene.since_start_in_parts(1.3));
        assert_eq!(within(1.3, 3.0, 0.0), scene.since_start_in_parts(1.3));
        assert_eq!(within(4.0, 0.0, 3.0_f64.next_down()), [3.0_f64.next_down(), 0.0]);
        assert_eq!(within(4.0, 3.0_f64.next_up(), 3.5), [3.0_f64.next_up(), 0.0]);
        assert_eq!(within(4.0, 3.5, 3.0_f64.next_up()), [3.0_f64.next_up(), 0.0]);
    }
}
