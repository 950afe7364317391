//! Many motions at once by splitting, one in each lane of the vector registers.

use crate::dynamics::AxisState;
use crate::error::Error;
use crate::numerics::registers::Register;
use crate::numerics::side_by_side::SideBySide;
use crate::propagation::input::check_request;
use crate::propagation::splitting::choice::{SampledForecast, sampled_forecast};
use crate::propagation::splitting::flows::{Angles, Field, Moved, Moving};
use crate::propagation::splitting::motion::PrincipalProblem;
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::splitting::stepper::{STEPS_BETWEEN_PROJECTIONS, Steps, angles};
use crate::propagation::{SampledProblem, Samples};

type Outcome = Result<Samples<AxisState<f64>>, Error>;

/// A motion prepared for a lane.
pub(in crate::propagation) struct Ready<'t> {
    /// Its index among the results.
    index: usize,
    scene: PrincipalProblem,
    start: f64,
    times: &'t [f64],
    scheme: &'static Scheme,
    /// Largest step.
    step: f64,
    steps: u64,
    angles: Angles,
}

impl<'t> Ready<'t> {
    /// The prepared motion of a scene whose times are in order; `None` if splitting does not reach its tolerance.
    ///
    /// # Errors
    /// The reason why the scene is not valid.
    pub(in crate::propagation) fn new(index: usize, motion: &SampledProblem<'t>) -> Result<Option<Self>, Error> {
        let SampledProblem { problem, start, times, tolerance } = motion;
        let span = (*start, times.last().copied().unwrap_or(*start));
        check_request(span, *tolerance)?;
        let scene = PrincipalProblem::new(problem)?;
        let Some(SampledForecast { scheme, step, steps }) = sampled_forecast(&scene, *start, times, *tolerance) else {
            return Ok(None);
        };
        let angles = angles(scheme, step * scene.largest_rate);
        Ok(Some(Self { index, scene, start: *start, times, scheme, step, steps, angles }))
    }

    /// Length and number of the equal steps from the previous sample to the time of a sample.
    fn steps_to(&self, sample: usize) -> (f64, u64) {
        let before = if sample == 0 { self.start } else { self.times[sample - 1] };
        let interval = self.times[sample] - before;
        let count = (interval.abs() / self.step).ceil();
        if count > 0.0 { (interval / count, count as u64) } else { (0.0, 0) }
    }
}

/// Carries the motions to their times in the lanes of `register` and records their states.
pub(in crate::propagation) fn propagate_in_lanes<R: Register>(
    register: R,
    mut ready: Vec<Ready<'_>>,
    outcomes: &mut [Option<Outcome>],
) {
    // Motions side by side share the scheme and have similar numbers of steps.
    ready.sort_by_key(|ready| (ready.scheme.name, ready.angles, ready.steps));
    for alike in ready.chunk_by(|a, b| a.scheme == b.scheme && a.angles == b.angles) {
        for motions in alike.chunks(SideBySide::<R, 2>::COUNT) {
            register.run(
                #[inline(always)]
                || match motions.len() <= R::COUNT {
                    true => propagate_side_by_side::<R, 1>(register, motions, outcomes),
                    false => propagate_side_by_side::<R, 2>(register, motions, outcomes),
                },
            );
        }
    }
}

/// The position of a motion in its steps.
struct Progress<'r, 't> {
    ready: &'r Ready<'t>,
    states: Vec<AxisState<f64>>,
    /// Number of steps to the next sample.
    left: u64,
}

/// Carries at most as many motions as there are lanes; a lane that has finished runs on, and its results are ignored.
///
/// All motions start at the same step, so that the rounding of each is removed after the same steps as for the motion alone.
#[inline(always)]
fn propagate_side_by_side<R: Register, const N: usize>(
    register: R,
    motions: &[Ready<'_>],
    outcomes: &mut [Option<Outcome>],
) {
    // A lane without a motion computes a copy of the first.
    let at = |place: usize| motions.get(place).unwrap_or(&motions[0]);
    let (scheme, angles) = (motions[0].scheme, motions[0].angles);
    let field = Field::<SideBySide<R, N>>::gather(register, |place| &at(place).scene.field);
    let casimir = SideBySide::gather(register, |place| at(place).scene.casimir);
    let mut step = SideBySide::gather(register, |place| at(place).steps_to(0).0);
    let mut steps = Steps::turning(scheme, &field, step, angles);
    let mut state = Moving::gather(register, |place| &at(place).scene.start);
    steps.open(&mut state);
    let mut progress: Vec<_> = motions
        .iter()
        .map(|ready| Progress { ready, states: Vec::with_capacity(ready.times.len()), left: ready.steps_to(0).1 })
        .collect();
    let mut since_projection = 0;
    loop {
        let underway = progress.iter().filter(|motion| motion.states.len() < motion.ready.times.len());
        let Some(to_event) = underway.map(|motion| motion.left).min() else { break };
        let now = to_event.min(STEPS_BETWEEN_PROJECTIONS - since_projection);
        steps.run(&mut state, now);
        since_projection += now;
        if since_projection == STEPS_BETWEEN_PROJECTIONS {
            state.project(casimir);
            since_projection = 0;
        }
        if now < to_event {
            for motion in &mut progress {
                motion.left = motion.left.saturating_sub(now);
            }
            continue;
        }
        // Every motion at a sample is recorded, and begins the steps to its next one.
        let mut opened = state;
        steps.close(&mut opened);
        let mut turning = Vec::new();
        for (place, motion) in progress.iter_mut().enumerate() {
            let Progress { ready, states, left } = motion;
            if states.len() == ready.times.len() {
                continue;
            }
            *left -= now;
            if *left > 0 {
                continue;
            }
            let closed = ready.scene.state(&opened.take(place));
            while *left == 0 && states.len() < ready.times.len() {
                states.push(closed);
                if states.len() < ready.times.len() {
                    let (length, count) = ready.steps_to(states.len());
                    step.set(place, length);
                    *left = count;
                }
            }
            if *left > 0 {
                turning.push(place);
            }
        }
        if !turning.is_empty() {
            steps = Steps::turning(scheme, &field, step, angles);
            steps.open(&mut opened);
            for place in turning {
                state.put(place, &opened.take(place));
            }
        }
    }
    for Progress { ready, states, .. } in progress {
        let (step_count, order) = (ready.steps as usize, scheme.order() as usize);
        outcomes[ready.index] = Some(Ok(Samples { states, step_count, order }));
    }
}

impl<R: Register, const N: usize, const V: usize> Moving<SideBySide<R, N>, V> {
    /// The states of motions, by index.
    #[inline(always)]
    pub(crate) fn gather<'m>(register: R, state: impl Fn(usize) -> &'m Moving<f64, V>) -> Self {
        let vector = |v: usize| SideBySide::gather_vector(register, |place| state(place).vectors[v]);
        Moving::new(core::array::from_fn(vector))
    }

    /// The state of one motion.
    #[inline(always)]
    pub(crate) fn take(&self, place: usize) -> Moving<f64, V> {
        let of = |v: &[SideBySide<R, N>; 3]| v.each_ref().map(|component| component.get(place));
        Moving { vectors: self.vectors.each_ref().map(of), low: self.low.each_ref().map(of) }
    }

    /// Replaces the state of one motion.
    #[inline(always)]
    pub(crate) fn put(&mut self, place: usize, state: &Moving<f64, V>) {
        for v in 0..V {
            for i in 0..3 {
                self.vectors[v][i].set(place, state.vectors[v][i]);
                self.low[v][i].set(place, state.low[v][i]);
            }
        }
    }
}

impl<R: Register, const N: usize> Field<SideBySide<R, N>> {
    /// The fields of motions, by index.
    #[inline(always)]
    pub(crate) fn gather<'f>(register: R, field: impl Fn(usize) -> &'f Field<f64>) -> Self {
        Field {
            strength: SideBySide::gather(register, |place| field(place).strength),
            tensor: SideBySide::gather_vector(register, |place| field(place).tensor),
            torque: SideBySide::gather_vector(register, |place| field(place).torque),
        }
    }
}

#[cfg(test)]
mod tests {
    use pulp::x86::V3;

    use super::*;
    use crate::dynamics::fixture::{AXIS_STATE, axis_problem};
    use crate::propagation::splitting::NEAR_INTEGRABLE_6_2;
    use crate::propagation::splitting::double_steps::DoubleSteps;
    use crate::solutions::free::rotated_by;

    fn scene(s: [f64; 3], momentum: f64, start: f64, times: &[f64], tolerance: f64) -> SampledProblem<'_> {
        let initial = AxisState { momentum: AXIS_STATE.momentum * momentum, ..AXIS_STATE };
        let problem = axis_problem(s).starting_from(initial).unwrap();
        SampledProblem { problem, start, times, tolerance }
    }

    fn states(register: V3, ready: Ready<'_>) -> Vec<AxisState<f64>> {
        let mut outcomes = [None];
        propagate_in_lanes(register, vec![ready], &mut outcomes);
        let [outcome] = outcomes;
        outcome.unwrap().unwrap().states
    }

    /// Without torque the flows are exact, however large the angles of a step.
    #[test]
    fn fast_free_rotation_is_exact_both_ways() {
        let Some(register) = V3::try_new() else { return };
        for way in [1.0, -1.0] {
            let times = [0.0, 0.01, 3.0, 6.0].map(|elapsed| 1.0 + way * elapsed);
            let scene = scene([0.0; 3], 15.0, 1.0, &times, 1e-3);
            let states = states(register, Ready::new(0, &scene).unwrap().unwrap());
            for (state, time) in states.iter().zip(times) {
                let AxisState { axis, momentum } = scene.problem.initial();
                let turn = momentum * ((time - 1.0) / 1.3);
                assert!((state.axis - rotated_by(&turn, axis)).amax() < 3e-13, "{time}: {state:?}");
            }
        }
    }

    #[test]
    fn steps_to_a_sample_are_equal_and_none_to_the_same_time() {
        let times = [1.0, 1.25, 1.25, 0.0];
        let scene = scene([0.2, 0.1, -0.3], 1.0, 1.0, &times, 1e-3);
        let ready = Ready { step: 0.3, ..Ready::new(0, &SampledProblem { times: &[2.0], ..scene }).unwrap().unwrap() };
        let ready = Ready { times: &times, ..ready };
        assert_eq!([0, 1, 2, 3].map(|sample| ready.steps_to(sample)), [(0.0, 0), (0.25, 1), (0.0, 0), (-0.25, 5)]);
    }

    /// A single motion with the same fused operations also removes its rounding after every 64 steps.
    #[test]
    fn a_lane_gives_the_bits_of_one_motion_alone() {
        let Some(register) = V3::try_new() else { return };
        let (scheme, step) = (&NEAR_INTEGRABLE_6_2, 0.3);
        let times = [256.0 * step];
        let scene = scene([0.2, 0.1, -0.3], 1.0, 0.0, &times, 1e-3);
        let ready = Ready::new(0, &scene).unwrap().unwrap();
        let of_body = ready.scene.clone();
        let angles = angles(scheme, step * of_body.largest_rate);
        let mut outcomes = [None];
        propagate_in_lanes(register, vec![Ready { scheme, step, steps: 256, angles, ..ready }], &mut outcomes);
        let [Some(Ok(Samples { states, step_count, order }))] = outcomes else { panic!("a motion") };
        assert_eq!((step_count, order), (256, 2));

        let alone = DoubleSteps::new(scheme, &of_body.field, step, of_body.largest_rate);
        let mut state = of_body.start;
        alone.open(&mut state);
        alone.advance(&mut state, of_body.casimir, 256);
        alone.close(&mut state);
        assert_eq!(states, [of_body.state(&state)]);
    }
}
