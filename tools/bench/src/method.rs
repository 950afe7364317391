//! The methods that are timed.

use std::fmt;

use nalgebra::Vector3;
use twofold::Scalar as _;
use twofold::dynamics::{AxisState, Problem, RotationState};
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, pulse_train};
use twofold::propagation::{Motion, SampledProblem, Samples, TorusMotion, states_of_many};

use super::runge_kutta;
use super::scene::BenchScene;
use twofold_verify::double_double::DoubleDouble;

/// The vectors that a method computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carries {
    /// Symmetry axis and angular momentum.
    Axis,
    /// The equatorial axis, and so the third angle, as well.
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

/// The state at which a method arrives, and its work.
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
    /// Number of right-hand sides; for a series, of coefficients; for a splitting, of rotations and kicks.
    pub evaluations: usize,
}

/// A method.
#[derive(Clone, Copy)]
pub struct Method {
    /// Name.
    pub name: &'static str,
    /// The vectors that it computes.
    pub carries: Carries,
    /// Accuracies, tolerances or steps, from coarse to fine.
    pub settings: &'static [f64],
    /// The state at a time, with one of the settings.
    pub run: fn(&BenchScene, f64, f64) -> Result<End, String>,
}

/// Times are compared with the time of this method, for the same vectors.
pub const BASELINE: &str = "numeris RKV98";

const ACCURACIES: &[f64] =
    &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16];

const SPLITTING_ACCURACIES: &[f64] =
    &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

const TOLERANCES: &[f64] = &[1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// All methods; each takes one line.
pub const METHODS: &[Method] = &[
    Method { name: "Taylor", carries: Carries::Axis, settings: ACCURACIES, run: taylor_axis },
    Method { name: "Taylor", carries: Carries::Orientation, settings: ACCURACIES, run: taylor },
    Method { name: "splitting", carries: Carries::Axis, settings: SPLITTING_ACCURACIES, run: splitting_axis },
    Method { name: "splitting", carries: Carries::Orientation, settings: SPLITTING_ACCURACIES, run: splitting },
    Method { name: BASELINE, carries: Carries::Axis, settings: TOLERANCES, run: runge_kutta::axis },
    Method { name: BASELINE, carries: Carries::Orientation, settings: TOLERANCES, run: runge_kutta::orientation },
];

/// Motions with the edges of every pulse, for the beam and the observer of the paper's figures.
pub const WITH_PULSES: &[Method] =
    &[Method { name: "Taylor", carries: Carries::Orientation, settings: ACCURACIES, run: taylor_with_pulses }];

/// Methods that compute several scenes together, with the number of scenes. The given scene is the first; each further `s` is larger by a part of 1e-4. The
/// final state is that of the first scene.
pub const MANY_SCENES: &[(Method, usize)] = &[
    (Method { name: "lanes, 8 scenes", carries: Carries::Axis, settings: ACCURACIES, run: in_lanes::<8> }, 8),
    (Method { name: "lanes, 16 scenes", carries: Carries::Axis, settings: ACCURACIES, run: in_lanes::<16> }, 16),
];

/// Number of states of a long motion, at equally spaced times up to its end.
const LONG_SAMPLES: usize = 10_000;

/// Motions with 10,000 states on the way; the times include the set-up.
pub const SAMPLED: &[Method] = &[
    Method { name: "torus", carries: Carries::Axis, settings: &[1e-6, 1e-8, 1e-10, 1e-12], run: torus_sampled },
    Method { name: "Taylor", carries: Carries::Axis, settings: LONG_ACCURACIES, run: taylor_sampled },
    Method { name: "Taylor, 32 digits", carries: Carries::Axis, settings: &[1e-10], run: taylor_of_32_digits_sampled },
    Method { name: "splitting", carries: Carries::Axis, settings: LONG_ACCURACIES, run: splitting_sampled },
];

const LONG_ACCURACIES: &[f64] = &[1e-4, 1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-14, 1e-16];

fn sample_times(duration: f64) -> Vec<f64> {
    (1..=LONG_SAMPLES).map(|i| duration * i as f64 / LONG_SAMPLES as f64).collect()
}

fn states_of(motion: &impl Motion<f64>, duration: f64) -> Result<Vec<AxisState<f64>>, String> {
    let states = sample_times(duration).into_iter().map(|t| motion.axis_state(t));
    Ok(states.collect::<Result<_, _>>()?)
}

fn torus_sampled(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let states = states_of(&TorusMotion::new(&scene.problem, (0.0, duration), tolerance)?, duration)?;
    Ok(End::new(&states[LONG_SAMPLES - 1], 0, 0))
}

fn taylor_sampled(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let times = sample_times(duration);
    let found = scene.problem.reduced().taylor_states(0.0, &times, tolerance)?;
    Ok(End::new(&found.states[LONG_SAMPLES - 1], found.step_count, found.step_count * found.order))
}

fn taylor_of_32_digits_sampled(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let (problem, times) = (scene.problem.reduced().map(DoubleDouble::from_f64), sample_times(duration));
    let found = problem.taylor_states(0.0, &times, tolerance)?;
    let AxisState { axis, momentum } = found.states[LONG_SAMPLES - 1];
    let end = AxisState { axis: axis.map(DoubleDouble::high), momentum: momentum.map(DoubleDouble::high) };
    Ok(End::new(&end, found.step_count, found.step_count * found.order))
}

fn splitting_sampled(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let motion = scene.problem.reduced().splitting((0.0, duration), tolerance)?;
    let (states, steps) = (states_of(&motion, duration)?, motion.step_count() as usize);
    Ok(End::new(&states[LONG_SAMPLES - 1], steps, 2 * steps * motion.scheme().stages()))
}

fn taylor_with_pulses(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let span = (0.0, duration);
    let motion = scene.problem.taylor(span, tolerance)?;
    std::hint::black_box(pulse_train(&motion, &beam, &observer.direction, span)?);
    Ok(End::new(&motion.state(duration)?, motion.step_count, motion.step_count * motion.order))
}

fn in_lanes<const COUNT: usize>(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let times = [duration];
    let near = |i: usize| SampledProblem { problem: scene.beside(i, 1e-4), start: 0.0, times: &times, tolerance };
    let mut found = states_of_many(&core::array::from_fn::<_, COUNT, _>(near));
    Ok(end_of(&found.swap_remove(0)?))
}

fn taylor_axis(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let found = scene.problem.reduced().taylor_states(0.0, &[duration], tolerance);
    Ok(end_of(&found?))
}

fn taylor(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    Ok(end_of(&scene.problem.taylor_states(0.0, &[duration], tolerance)?))
}

fn splitting_axis(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    end_of_splitting(&scene.problem.reduced(), duration, tolerance)
}

fn splitting(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    end_of_splitting(&scene.problem, duration, tolerance)
}

fn end_of_splitting<X: RotationState<f64>>(
    problem: &Problem<f64, X>,
    duration: f64,
    tolerance: f64,
) -> Result<End, String> {
    let motion = problem.splitting((0.0, duration), tolerance)?;
    let steps = motion.step_count() as usize;
    Ok(End::new(&motion.state(duration)?, steps, 2 * steps * motion.scheme().stages()))
}

/// The first of the states of a series.
fn end_of<X: RotationState<f64>>(Samples { states, step_count, order, .. }: &Samples<X>) -> End {
    End::new(&states[0], *step_count, step_count * order)
}

impl End {
    fn new<X: RotationState<f64>>(state: &X, steps: usize, evaluations: usize) -> Self {
        let [axis, momentum, equatorial_axis] = state.vectors();
        let equatorial_axis = (X::VECTORS == 3).then_some(equatorial_axis);
        Self { axis, momentum, equatorial_axis, steps, evaluations }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_converges_on_every_scene() {
        for scene in BenchScene::all() {
            for method in METHODS {
                let at = |setting: f64| {
                    (method.run)(&scene, 100.0, setting).map(|end| {
                        // Each step takes several right-hand sides, coefficients, or rotations and kicks.
                        let is_closed = (end.steps, end.evaluations) == (0, 0);
                        assert!(is_closed || end.evaluations >= 4 * end.steps, "{}: {end:?}", method.name);
                        scene.error(100.0, &end)
                    })
                };
                let errors: Vec<_> = method.settings.iter().map(|s| at(*s).expect("a motion")).collect();
                let best = errors.iter().copied().fold(f64::INFINITY, f64::min);
                let which = format!("{} of {} by {}: {errors:?}", method.carries, scene.name, method.name);
                assert!(best < 1e-12 && errors[0] > best, "{which}");
            }
        }
    }
}
