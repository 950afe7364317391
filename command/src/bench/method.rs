//! The methods that are timed.

use std::fmt;

use nalgebra::Vector3;
use twofold::dynamics::BodyState;
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, propagated_pulse_train};
use twofold::propagation::splitting::{propagate_by_best_splitting, propagate_orientation_by_best_splitting};
use twofold::propagation::{
    AxisScene, AxisState, ErrorEstimates, Motion, Samples, axis_states_at, axis_states_of_many, states_at,
};

use super::runge_kutta;
use super::scene::BenchScene;

/// What a method carries along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carries {
    /// Symmetry axis and angular momentum.
    Axis,
    /// The third angle as well.
    Orientation,
}

impl Carries {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Axis, Self::Orientation];
}

impl fmt::Display for Carries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Axis => "n L",
            Self::Orientation => "n L e_x",
        })
    }
}

/// What a method arrives at, and its work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// Symmetry axis `n`.
    pub axis: Vector3<f64>,
    /// Angular momentum `L`.
    pub momentum: Vector3<f64>,
    /// Equatorial axis `e_x`, where it is carried.
    pub equatorial_axis: Option<Vector3<f64>>,
    /// Steps.
    pub steps: usize,
    /// Right-hand sides, for a series its coefficients, for a splitting its rotations and kicks.
    pub evaluations: usize,
}

/// A method.
#[derive(Clone, Copy)]
pub struct Method {
    /// Name.
    pub name: &'static str,
    /// What it carries.
    pub carries: Carries,
    /// Accuracies, tolerances or steps, from coarse to fine.
    pub settings: &'static [f64],
    /// The state at a time, with one of the settings.
    pub run: fn(&BenchScene, f64, f64) -> Result<End, String>,
}

/// The ratios of times are those to this method, of what it carries.
pub const BASELINE: &str = "numeris RKV98";

const ACCURACIES: &[f64] =
    &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16];

const SPLITTING_ACCURACIES: &[f64] =
    &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

const TOLERANCES: &[f64] = &[1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// All methods; a further one takes a line.
pub const METHODS: &[Method] = &[
    Method { name: "Taylor", carries: Carries::Axis, settings: ACCURACIES, run: taylor_axis },
    Method { name: "Taylor", carries: Carries::Orientation, settings: ACCURACIES, run: taylor },
    Method { name: "splitting", carries: Carries::Axis, settings: SPLITTING_ACCURACIES, run: splitting },
    Method {
        name: "splitting",
        carries: Carries::Orientation,
        settings: SPLITTING_ACCURACIES,
        run: splitting_orientation,
    },
    Method { name: BASELINE, carries: Carries::Axis, settings: TOLERANCES, run: runge_kutta::axis },
    Method { name: BASELINE, carries: Carries::Orientation, settings: TOLERANCES, run: runge_kutta::orientation },
];

/// Motions with the edges of every pulse of the beam of the paper's figures, seen as there.
pub const WITH_PULSES: &[Method] =
    &[Method { name: "Taylor", carries: Carries::Orientation, settings: ACCURACIES, run: taylor_with_pulses }];

/// Scenes near the one given, which is the first: their `s` differ by parts of 1e-4. The state is that of the first; the second number is
/// how many there are.
pub const MANY_SCENES: &[(Method, usize)] = &[
    (Method { name: "lanes, 8 scenes", carries: Carries::Axis, settings: ACCURACIES, run: in_lanes::<8> }, 8),
    (Method { name: "lanes, 16 scenes", carries: Carries::Axis, settings: ACCURACIES, run: in_lanes::<16> }, 16),
];

fn taylor_with_pulses(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let BenchScene { spheroid, violation, initial, .. } = scene;
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let span = (0.0, duration);
    let found = propagated_pulse_train(spheroid, violation, initial, span, accuracy, &beam, &observer.direction);
    let (train, end) = found.map_err(text)?;
    std::hint::black_box(train);
    let state = end.states[0];
    let equatorial_axis = Some(state.equatorial_axis);
    let (steps, evaluations) = (end.step_count, end.step_count * end.order);
    Ok(End { axis: state.axis, momentum: state.momentum, equatorial_axis, steps, evaluations })
}

fn in_lanes<const COUNT: usize>(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let times = [duration];
    let near = |i: usize| AxisScene {
        spheroid: scene.spheroid,
        violation: scene.violation * (1.0 + 1e-4 * i as f64),
        initial: scene.initial_axis(),
        start: 0.0,
        times: &times,
        accuracy,
    };
    let mut found = axis_states_of_many(&core::array::from_fn::<_, COUNT, _>(near));
    end_of_axis(found.swap_remove(0).map_err(text)?)
}

fn taylor_axis(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let (start, estimates) = (scene.initial_axis(), ErrorEstimates::NotWanted);
    let found = axis_states_at(&scene.spheroid, &scene.violation, &start, 0.0, &[duration], accuracy, estimates);
    end_of_axis(found.map_err(text)?)
}

fn splitting(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let (spheroid, s, start) = (&scene.spheroid, &scene.violation, scene.initial_axis());
    let motion = propagate_by_best_splitting(spheroid, s, &start, (0.0, duration), accuracy).map_err(text)?;
    let AxisState { axis, momentum } = motion.axis_state(duration).map_err(text)?;
    let steps = motion.step_count() as usize;
    let evaluations = 2 * steps * motion.scheme().stages();
    Ok(End { axis, momentum, equatorial_axis: None, steps, evaluations })
}

fn splitting_orientation(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let (spheroid, s, start) = (&scene.spheroid, &scene.violation, &scene.initial);
    let motion = propagate_orientation_by_best_splitting(spheroid, s, start, (0.0, duration), accuracy);
    let motion = motion.map_err(text)?;
    let BodyState { axis, momentum, equatorial_axis } = motion.state(duration).map_err(text)?;
    let steps = motion.step_count() as usize;
    let evaluations = 2 * steps * motion.scheme().stages();
    Ok(End { axis, momentum, equatorial_axis: Some(equatorial_axis), steps, evaluations })
}

fn end_of_axis(Samples { states, step_count, order, .. }: Samples<AxisState<f64>>) -> Result<End, String> {
    let AxisState { axis, momentum } = states[0];
    Ok(End { axis, momentum, equatorial_axis: None, steps: step_count, evaluations: step_count * order })
}

fn taylor(scene: &BenchScene, duration: f64, accuracy: f64) -> Result<End, String> {
    let (start, estimates) = (&scene.initial, ErrorEstimates::NotWanted);
    let found = states_at(&scene.spheroid, &scene.violation, start, 0.0, &[duration], accuracy, estimates);
    let Samples { states, step_count, order, .. } = found.map_err(text)?;
    let BodyState { axis, momentum, equatorial_axis } = states[0];
    let evaluations = step_count * order;
    Ok(End { axis, momentum, equatorial_axis: Some(equatorial_axis), steps: step_count, evaluations })
}

pub(super) fn text(error: twofold::Error) -> String {
    error.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_converges_on_every_scene() {
        for scene in BenchScene::all() {
            for method in METHODS {
                let at = |setting: f64| (method.run)(&scene, 100.0, setting).map(|end| scene.error(100.0, &end));
                let errors: Vec<_> = method.settings.iter().map(|s| at(*s).expect("a motion")).collect();
                let best = errors.iter().copied().fold(f64::INFINITY, f64::min);
                let which = format!("{} of {} by {}: {errors:?}", method.carries, scene.name, method.name);
                assert!(best < 1e-12 && errors[0] > best, "{which}");
            }
        }
    }
}
