//! States of the motions of scenes at the times of a sweep.

use twofold::Error;
use twofold::euler_angles::EulerAngles;
use twofold::plan::{Method, Output, Plan, PlannedAxisMotion, PlannedMotion, State};
use twofold::propagation::{AxisScene, AxisState, Motion, axis_states_of_many};

use super::spin_axis_angle::SpinAxisAngle;
use crate::columns::Carried;
use crate::scene_file::Scene;
use crate::trajectory::{PlannedState, Stretches, since_start, since_start_within};

/// One of the times.
pub(super) struct Instant {
    /// Time since the start, in t_c.
    pub(super) since_start: f64,
    /// State, as far as it is needed.
    pub(super) state: Carried,
    /// Euler angles with their turns, where they are needed and exist.
    pub(super) angles: Option<EulerAngles<f64>>,
    /// Estimated error, see [`Motion::error_estimate`], where it is needed.
    pub(super) error_estimate: Option<f64>,
}

/// What is asked of the motions besides the states.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    /// What a plan takes the columns for.
    pub(super) outputs: Vec<Output>,
    /// Whether estimated errors are.
    pub(super) errors: bool,
}

/// The states at their times of those of the `scenes` that need `n` and `L` by numerical motion and nothing else, and name no method: many at
/// once, each by splitting or by the series as suits its times. None for the others.
pub(super) fn instants_of_many(scenes: &[&Scene], asked: &Asked) -> Vec<Option<Result<Vec<Instant>, Error>>> {
    let mut found: Vec<_> = scenes.iter().map(|_| None).collect();
    if asked.errors {
        return found;
    }
    let is_plain = |plan: Plan| {
        !plan.forced
            && matches!(plan.state, State::Axis | State::AxisAndMomentum)
            && matches!(plan.method, Some(Method::Taylor | Method::Splitting))
    };
    let plain: Vec<_> = (0..scenes.len()).filter(|&i| scenes[i].plan(&asked.outputs).is_ok_and(is_plain)).collect();
    let times = |&i: &usize| scenes[i].times.iter().map(|time| since_start(scenes[i], time)).collect::<Vec<_>>();
    let times: Vec<_> = plain.iter().map(times).collect();
    let motion = |(&i, times): (&usize, _)| AxisScene {
        spheroid: scenes[i].spheroid,
        violation: scenes[i].violation,
        initial: AxisState::from(&scenes[i].initial),
        start: 0.0,
        times,
        accuracy: scenes[i].accuracy,
    };
    let motions: Vec<_> = plain.iter().zip(times.iter().map(Vec::as_slice)).map(motion).collect();
    for ((i, times), samples) in plain.into_iter().zip(&times).zip(axis_states_of_many(&motions)) {
        let instant = |(&since_start, state)| Instant {
            since_start,
            state: Carried::Axis(state),
            angles: None,
            error_estimate: None,
        };
        found[i] = Some(samples.map(|samples| times.iter().zip(samples.states).map(instant).collect()));
    }
    found
}

/// The states of `scene` at its times, by the method of a plan. `angle` is shown the whole motion.
///
/// # Errors
/// A motion that cannot be computed.
pub(super) fn instants(scene: &Scene, asked: &Asked, angle: Option<&mut SpinAxisAngle>) -> Result<Vec<Instant>, Error> {
    let plan = scene.plan(&asked.outputs)?;
    match plan.state {
        State::Nothing => {
            let instant = |time| Instant {
                since_start: since_start(scene, time),
                state: Carried::Nothing,
                angles: None,
                error_estimate: None,
            };
            Ok(scene.times.iter().map(instant).collect())
        }
        State::Axis | State::AxisAndMomentum => instants_along::<PlannedAxisMotion>(scene, &plan, asked, angle),
        State::Orientation => instants_along::<PlannedMotion>(scene, &plan, asked, angle),
    }
}

fn instants_along<M: PlannedState>(
    scene: &Scene,
    plan: &Plan,
    asked: &Asked,
    mut angle: Option<&mut SpinAxisAngle>,
) -> Result<Vec<Instant>, Error> {
    let mut instants = Vec::new();
    let mut times = scene.times.iter().peekable();
    let counts_turns = plan.outputs.contains(&Output::EulerAngles);
    let mut stretches = Stretches::<M>::new(scene, plan)?;
    let mut start_angles = scene.initial_angles;
    let mut earlier = EarlierErrors::default();
    while let Some(stretch) = stretches.next()? {
        let (motion, from, to) = (&stretch.motion, stretch.from, stretch.to);
        if let Some(angle) = &mut angle {
            angle.add(motion, from, to)?;
        }
        let mut angles: Box<dyn FnMut(f64) -> Option<EulerAngles<f64>>> =
            if counts_turns { M::angles(motion, from, &start_angles)? } else { Box::new(|_| None) };
        while let Some(time) = times.next_if(|time| stretch.is_last || since_start(scene, *time).abs() <= to.abs()) {
            let parts = since_start_within(scene, time, from, to);
            let t = parts[0];
            let error = || earlier.at(t, scene.turning_rate()) + motion.error_estimate(t);
            instants.push(Instant {
                since_start: t,
                state: M::carried(motion, parts)?,
                angles: angles(t),
                error_estimate: asked.errors.then(error),
            });
        }
        if counts_turns && !stretch.is_last {
            start_angles = angles(to).unwrap_or(start_angles);
        }
        drop(angles);
        if asked.errors && !stretch.is_last && !plan.method.is_some_and(Method::is_closed_form) {
            earlier.add(to, motion.error_estimate(to));
        }
    }
    Ok(instants)
}

/// Errors at the ends of the stretches before: each grows linearly with the phase that it shifts.
#[derive(Default)]
struct EarlierErrors {
    sum: f64,
    times: f64,
}

impl EarlierErrors {
    fn add(&mut self, time: f64, error: f64) {
        self.sum += error;
        self.times += error * time.abs();
    }

    fn at(&self, time: f64, rate: f64) -> f64 {
        self.sum + rate * (self.sum * time.abs() - self.times)
    }
}

#[cfg(test)]
mod tests {
    use super::EarlierErrors;

    #[test]
    fn each_earlier_error_grows_with_the_rotation_since() {
        for sense in [1.0, -1.0] {
            let mut earlier = EarlierErrors::default();
            let errors = [(2.0, 1e-9), (5.0, 3e-9)];
            errors.iter().for_each(|(time, error)| earlier.add(sense * time, *error));
            let expected: f64 = errors.map(|(time, error)| error * (1.0 + 1.5 * (8.0 - time))).iter().sum();
            assert!((earlier.at(sense * 8.0, 1.5) / expected - 1.0).abs() < 1e-14);
        }
    }
}
