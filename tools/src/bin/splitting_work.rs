//! Time against true error of every splitting scheme, and of the Taylor motion, for n and L of tp-II at 1000 t_c.
//!
//!     cargo run --release -p twofold-tools --bin splitting_work
//!
//! The end state is that of verify/oracles/mpmath/axis_end_state.py, 32 digits. Times are the shortest of 15 rounds over all methods.

use nalgebra::Vector3;
use twofold::dynamics::{AxisState, Problem, RotationState};
use twofold::propagation::Motion;
use twofold::propagation::splitting::SCHEMES;
use twofold_tools::least_time;
use twofold_verify::reference::reference_motion;

const END: f64 = 1000.0;

fn main() {
    let scene = reference_motion("tp-2");
    let problem = Problem::new(scene.spheroid, scene.violation(), scene.states[0].1.axis_state()).expect("tp-II");
    let row = include_str!("../../../verify/data/axis_end_state.csv").lines().last().expect("a row of data");
    let numbers: Vec<f64> = row.split(',').skip(2).map(|cell| cell.parse().expect("a number")).collect();
    let axis = Vector3::new(numbers[0], numbers[1], numbers[2]);

    type Run<'a> = Box<dyn Fn() -> Box<dyn Motion<f64, State = AxisState<f64>>> + 'a>;
    let mut runs: Vec<(String, Run)> = Vec::new();
    let (problem, span) = (&problem, (0.0, END));
    for scheme in SCHEMES {
        for k in 0..7 {
            let step = 0.4 * scheme.stages() as f64 / 1.5_f64.powi(k);
            let run = move || problem.splitting_by(scheme, span, step).expect("tp-II");
            runs.push((format!("{} {step:.4}", scheme.name), Box::new(move || Box::new(run()))));
        }
    }
    for exponent in [4, 6, 8, 10, 12, 14] {
        let tolerance = 10f64.powi(-exponent);
        let chosen = move || problem.splitting(span, tolerance).expect("tp-II");
        runs.push((format!("chosen {tolerance:e}"), Box::new(move || Box::new(chosen()))));
        let taylor = move || problem.taylor(span, tolerance).expect("tp-II");
        runs.push((format!("taylor {tolerance:e}"), Box::new(move || Box::new(taylor()))));
    }
    let mut best = vec![f64::INFINITY; runs.len()];
    for _ in 0..15 {
        for (time, (_, run)) in best.iter_mut().zip(&runs) {
            *time = time.min(least_time(1, run));
        }
    }
    println!("method, step or tolerance; time [ms]; error of n; estimate");
    for (time, (name, run)) in best.iter().zip(&runs) {
        let motion = run();
        let error = (motion.axis_state(END).expect("the end").axis - axis).amax();
        println!("{name}; {:.3}; {error:.1e}; {:.1e}", time * 1e3, motion.error_estimate(END));
    }
}
