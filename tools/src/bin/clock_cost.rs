//! Cost of arrival times over decades: `cargo run --release -p twofold-tools --bin clock_cost`. The shortest of 20 rounds for 10,000 epochs in 15
//! years.

use std::hint::black_box;

use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::scene_file::{PULSARS, Scene};
use twofold_tools::least_time;

const EPOCHS: u32 = 10_000;
/// Shortest time of 20 rounds (ms).
fn least(work: impl FnMut()) -> f64 {
    least_time(20, work) * 1e3
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "scene        set-up [ms]  states [ms]  pulses [ms]  with fit [ms]  phases [ms]  with 12 derivatives [ms]"
    );
    for built_in in PULSARS {
        let scene = Scene::named(built_in.name)?;
        let pulsar = PulsarScene::new(&scene)?;
        let step = 15.0 * 31_557_600.0 / f64::from(EPOCHS);
        let epochs = (0..EPOCHS).map(|k| pulsar.epoch.after([f64::from(k) * step, 0.0]));
        let epochs: Vec<_> = epochs.collect::<Result<_, _>>()?;
        let times: Vec<_> = epochs.iter().map(|at| at.seconds_since(&pulsar.epoch)).collect();
        let set_up = least(|| drop(black_box(PulsarScene::new(&scene))));
        let motion = pulsar.clock.motion();
        let states = least(|| times.iter().for_each(|t| _ = black_box(motion.state(*t))));
        let pulses = least(|| times.iter().for_each(|t| _ = black_box(pulsar.clock.pulse_near(*t))));
        let with_fit = least(|| drop(black_box(pulsar.timed(&epochs, 2))));
        let model = pulsar.clock.timing_model()?;
        let phases = least(|| times.iter().for_each(|t| _ = black_box(model.phase(*t))));
        let slopes = least(|| times.iter().for_each(|t| _ = black_box(model.phase_and_derivatives(*t))));
        println!(
            "{:11} {set_up:12.4} {states:12.2} {pulses:12.2} {with_fit:14.2} {phases:12.3} {slopes:25.2}",
            built_in.name
        );
    }
    Ok(())
}
