//! What events, dense output, gradients, nested duals and wider numbers cost on top of a motion.

use nalgebra::SVector;
use num_dual::{Derivative, Dual, Dual2_64, Dual64, DualSVec64, HyperDual64};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, propagated_pulse_train, pulse_train};
use twofold::propagation::{AxisMotion, AxisState, Motion, propagate, propagate_axis};
use twofold::scalar::Real;

use super::Effort;
use super::method::{Carries, text};
use super::scene::{BenchScene, DURATION};
use super::timing::{Times, in_turn};
use crate::double_double::DoubleDouble;

/// Accuracy of the motions.
pub const ACCURACY: f64 = 1e-12;

/// Number of parameters of the gradient: the inertias, C, the eigenvalues of `s`, `L` and a tilt of `n`.
const PARAMETERS: usize = 10;

/// Something beside a motion, or a motion over other numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What it is.
    pub what: &'static str,
    /// What the motion carries.
    pub carries: Carries,
    /// Times (s).
    pub times: Times,
    /// Over the least time of the bare motion of the same `carries`.
    pub ratio: f64,
}

type Case<'a> = (&'static str, Carries, Box<dyn FnMut() -> Result<(), String> + 'a>);

/// All of them on tp-II; `done` hears which part is over.
///
/// # Errors
/// What a motion or a search reports.
pub fn measure(effort: &Effort, done: impl FnMut(f64)) -> Result<Vec<Row>, String> {
    let scene = &BenchScene::named("tp-II");
    let span = (0.0, DURATION);
    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let whole = || propagate(&scene.spheroid, &scene.violation, &scene.initial, span, ACCURACY).map_err(text);
    let axis =
        || propagate_axis(&scene.spheroid, &scene.violation, &scene.initial_axis(), span, ACCURACY).map_err(text);
    let sampled = |count: usize| {
        move || {
            let motion = axis()?;
            for i in 0..count {
                std::hint::black_box(motion.axis_state(DURATION * i as f64 / count as f64).map_err(text)?);
            }
            Ok(())
        }
    };
    let (n, full) = (Carries::Axis, Carries::Orientation);
    let mut cases: Vec<Case> = vec![
        ("the motion alone", n, Box::new(|| axis().map(drop))),
        ("the motion alone", full, Box::new(|| whole().map(drop))),
        (
            "162 pulses, both edges of each",
            full,
            Box::new(|| pulse_train(&whole()?, &beam, &observer.direction, span).map(drop).map_err(text)),
        ),
        (
            "162 pulses, the motion not kept",
            full,
            Box::new(|| {
                let BenchScene { spheroid, violation, initial, .. } = scene;
                let n = &observer.direction;
                propagated_pulse_train(spheroid, violation, initial, span, ACCURACY, &beam, n).map(drop).map_err(text)
            }),
        ),
        ("1,000 samples", n, Box::new(sampled(1000))),
        ("10,000 samples", n, Box::new(sampled(10_000))),
        (
            "1,000 samples",
            full,
            Box::new(|| {
                let motion = whole()?;
                for i in 0..1000 {
                    std::hint::black_box(motion.state(f64::from(i)).map_err(text)?);
                }
                Ok(())
            }),
        ),
        ("derivative by one parameter (Dual64)", n, Box::new(|| over(scene, Dual64::from_re, n))),
        ("gradient by 10 parameters (DualSVec64)", n, Box::new(|| over(scene, seeded(), n))),
        ("gradient by 10 parameters (DualSVec64)", full, Box::new(|| over(scene, seeded(), full))),
        ("second derivative (Dual2_64)", n, Box::new(|| over(scene, Dual2_64::from_re, n))),
        ("second derivative (HyperDual64)", n, Box::new(|| over(scene, HyperDual64::from_re, n))),
        (
            "nested duals (Dual<Dual64>)",
            n,
            Box::new(|| over(scene, |x| Dual::new(Dual64::new(x, 1.0), Dual64::new(1.0, 0.0)), n)),
        ),
        ("double-double numbers", n, Box::new(|| over(scene, <DoubleDouble as twofold::Scalar>::from_f64, n))),
    ];
    let mut runs: Vec<_> = cases.iter_mut().map(|(_, _, run)| run).collect();
    let times = in_turn(&mut runs, effort.rounds, done)?;
    let bare = |carries: Carries| times[usize::from(carries == full)].least;
    let row = |(&(what, carries, _), times): (&Case, &Times)| Row {
        what,
        carries,
        times: *times,
        ratio: times.least / bare(carries),
    };
    Ok(cases.iter().zip(&times).map(row).collect())
}

/// Numbers that carry a derivative by each of the parameters. What the derivatives are does not matter to the time; that none
/// is known to be zero does.
fn seeded() -> impl Fn(f64) -> DualSVec64<PARAMETERS> {
    |x| DualSVec64::new(x, Derivative::some(SVector::from_element(x)))
}

/// The motion over another scalar.
fn over<S: Real>(scene: &BenchScene, lift: impl Fn(f64) -> S, carries: Carries) -> Result<(), String> {
    let spheroid = RigidSpheroid {
        inertia_xx: lift(scene.spheroid.inertia_xx),
        inertia_zz: lift(scene.spheroid.inertia_zz),
        constant_c: lift(scene.spheroid.constant_c),
    };
    let s = scene.violation.map(&lift);
    let BodyState { axis, momentum, equatorial_axis } = scene.initial;
    let (axis, momentum, span) = (axis.map(&lift), momentum.map(&lift), (0.0, DURATION));
    match carries {
        Carries::Axis => propagate_axis(&spheroid, &s, &AxisState { axis, momentum }, span, ACCURACY).map(drop),
        Carries::Orientation => {
            let state = BodyState { axis, momentum, equatorial_axis: equatorial_axis.map(&lift) };
            propagate(&spheroid, &s, &state, span, ACCURACY).map(drop)
        }
    }
    .map_err(text)
}
