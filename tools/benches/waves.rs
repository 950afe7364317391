//! Time of 3,000 samples of `h_+` and `h_x` of tp-I over 200 t_c, the motion included, on one core:
//!
//! ```sh
//! cargo bench -p twofold-tools --bench waves
//! ```
//!
//! Beside it the same samples by the Runge-Kutta method of another crate, at the largest tolerance at which its error is below
//! 1e-12 as well, and the errors of both against the waves of the 34-digit motion.

use std::hint::black_box;
use std::time::Instant;

use nalgebra::Matrix3;
use twofold::dynamics::AxisState;
use twofold::dynamics::RigidSpheroid;
use twofold::dynamics::wave_source::spheroid_inertia_acceleration;
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::{Polarizations, metric_perturbation, polarizations};
use twofold::propagation::Motion;
use twofold_verify::check::largest;
use twofold_verify::reference::{ReferenceMotion, reference_motion};
use twofold_verify::second_integrator::axis_states;

const SAMPLES: usize = 3000;
const END: f64 = 200.0;
const TOLERANCE: f64 = 1e-12;

/// The largest power of ten at which the error of the other method, too, is below 1e-12.
const BASELINE_TOLERANCE: f64 = 1e-13;

/// The waves of the states at given times.
type Method<'a> = &'a dyn Fn(&[f64]) -> Result<Vec<Polarizations<f64>>, String>;

fn main() -> Result<(), String> {
    let text = |e: twofold::Error| e.to_string();
    // Under `cargo test` a look that it runs is enough.
    let repeats = if std::env::args().any(|arg| arg == "--bench") { 200 } else { 3 };
    let scene = reference_motion("tp-1");
    let (problem, s) = (scene.problem(), scene.violation());
    let reduced = problem.reduced();
    let observer = Observer::at(0.8, 0.0);
    let wave = |state: &AxisState<f64>| wave(&observer, &scene.spheroid, &s, state);

    let by_axis = |times: &[f64]| {
        let motion = reduced.taylor((0.0, END), TOLERANCE).map_err(text)?;
        times.iter().map(|t| motion.axis_state(*t).map(|state| wave(&state)).map_err(text)).collect()
    };
    let by_whole_motion = |times: &[f64]| {
        let motion = problem.taylor((0.0, END), TOLERANCE).map_err(text)?;
        times.iter().map(|t| motion.state(*t).map(|state| wave(&(&state).into())).map_err(text)).collect()
    };
    let by_baseline = |times: &[f64]| {
        let states = axis_states(&reduced, times, BASELINE_TOLERANCE)?;
        Ok(states.iter().map(wave).collect())
    };
    let methods: [(&str, Method); 3] = [
        ("Taylor series of n and L", &by_axis),
        ("Taylor series of n, L and e_x", &by_whole_motion),
        ("baseline: numeris RKV98 of n and L", &by_baseline),
    ];
    println!("{SAMPLES} samples of h_+ and h_x of tp-I over {END} t_c, motion included; {repeats} repeats in turn");
    println!("{:36} {:>10} {:>10} {:>12}", "", "median", "least", "error of h");
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); methods.len()];
    let sampled: Vec<f64> = (0..SAMPLES).map(|i| END * i as f64 / (SAMPLES - 1) as f64).collect();
    for _ in 0..repeats {
        for ((_, method), times) in methods.iter().zip(&mut times) {
            let clock = Instant::now();
            black_box(method(&sampled)?);
            times.push(clock.elapsed().as_secs_f64() * 1e3);
        }
    }
    for ((name, method), times) in methods.iter().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        let error = error(&scene, &wave, method)?;
        println!("{name:36} {:>7.3} ms {:>7.3} ms {error:>12.1e}", times[times.len() / 2], times[0]);
    }
    Ok(())
}

fn wave(
    observer: &Observer<f64>,
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    state: &AxisState<f64>,
) -> Polarizations<f64> {
    let source = spheroid_inertia_acceleration(spheroid, s, &state.axis, &state.momentum);
    polarizations(observer, &metric_perturbation(1.0, &source))
}

/// Largest difference from the waves of the 34-digit states.
fn error(
    scene: &ReferenceMotion,
    wave: &dyn Fn(&AxisState<f64>) -> Polarizations<f64>,
    method: Method,
) -> Result<f64, String> {
    let expected: Vec<_> = scene.states.iter().filter(|(t, _)| *t <= END).collect();
    let times: Vec<f64> = expected.iter().map(|(t, _)| *t).collect();
    let found = method(&times)?;
    Ok(largest(found.iter().zip(expected).flat_map(|(ours, (_, state))| {
        let theirs = wave(&state.into());
        [(ours.plus - theirs.plus).abs(), (ours.cross - theirs.cross).abs()]
    })))
}
