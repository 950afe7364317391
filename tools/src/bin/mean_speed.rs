//! What the averaged motion costs, and how much less that is than a numerical motion of the same error:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin mean_speed
//! ```
//!
//! Times are the least of many runs, in the work of this thread where the system tells it.

use std::hint::black_box;

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::plan::{Method, PlannedMotion};
use twofold::propagation::{AveragedMotion, ErrorEstimates, Motion, states_at};
use twofold::solutions::averaged::AveragingOrder;
use twofold_command::bench::timing::clock;

/// The least time of some runs (s).
fn least<T>(runs: usize, mut run: impl FnMut() -> T) -> f64 {
    (0..runs).fold(f64::INFINITY, |least, _| {
        let start = clock();
        black_box(run());
        least.min(clock() - start)
    })
}

/// Geometry of tp-II with the given largest `s`.
fn scene(size: f64) -> (RigidSpheroid<f64>, Matrix3<f64>, BodyState<f64>) {
    let scene = twofold_verify::reference::reference_motion("tp-2");
    (scene.spheroid, scene.violation() * (size / 0.04), scene.initial())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (body, s, initial) = scene(1e-9);
    let set_up = least(200, || {
        (0..100)
            .filter(|_| {
                AveragedMotion::from_parts(&body, &s, black_box(&initial), (0.0, 1e17), AveragingOrder::Second).is_ok()
            })
            .count()
    });
    println!("set-up {:.2} us", set_up * 1e4);
    let motion = AveragedMotion::from_parts(&body, &s, &initial, (0.0, 1e17), AveragingOrder::Second)?;
    for t in [1.0, 1e5, 1e10, 1e15] {
        let each = least(500, || {
            (0..1000)
                .map(|i| motion.state(black_box(t * (1.0 + 1e-6 * f64::from(i)))).map_or(0.0, |x| x.axis.x))
                .sum::<f64>()
        });
        println!("a state at t = {t:e} t_c: {:.0} ns", each * 1e6);
    }

    // 642 Hz and 15 years, t_c = sqrt(I^xx / C) of 10 ms: some 4e11 turns.
    let spin = 642.0 * core::f64::consts::TAU * 0.01;
    let body = RigidSpheroid::in_units_of_tc(1.001);
    let axis = Vector3::new(0.3, 0.1, (1.0_f64 - 0.1).sqrt());
    let initial = BodyState {
        axis,
        momentum: axis * (spin * body.inertia_zz),
        equatorial_axis: axis.cross(&Vector3::new(0.2, -0.5, 0.3)).normalize(),
    };
    let fifteen_years = 15.0 * 365.25 * 86_400.0 / 0.01;
    let sampled = least(50, || {
        let motion = AveragedMotion::from_parts(&body, &s, &initial, (0.0, fifteen_years), AveragingOrder::Second)
            .expect("fast");
        (0..10_000)
            .map(|i| {
                let t = fifteen_years * f64::from(i) / 9_999.0;
                motion.state(t.min(fifteen_years)).map_or(0.0, |x| x.equatorial_axis.x)
            })
            .sum::<f64>()
    });
    println!("10,000 epochs over 15 years at 642 Hz, set-up included: {:.2} ms", sampled * 1e3);

    // s = 1e-6 over 1e7 t_c: 100 states. The averaged motion is the reference: its own error is far below, which checks show.
    let (body, s, initial) = scene(1e-6);
    let times: Vec<f64> = (1..=100).map(|i| 1e5 * f64::from(i)).collect();
    let last = 1e7;
    let mean = || AveragedMotion::from_parts(&body, &s, &initial, (0.0, last), AveragingOrder::Second);
    let states = || -> Result<Vec<BodyState<f64>>, twofold::Error> {
        let mean = mean()?;
        times.iter().map(|&t| mean.state(t)).collect()
    };
    let right = states()?;
    let mean_time = least(100, states);
    println!(
        "s = 1e-6 over 1e7 t_c, 100 states: averaged motion {:.1} us, its error estimate {:.1e}",
        mean_time * 1e6,
        mean()?.error_estimate(last)
    );
    let off = |found: &[BodyState<f64>]| {
        let differences = found
            .iter()
            .zip(&right)
            .map(|(a, b)| (a.axis - b.axis).amax().max((a.equatorial_axis - b.equatorial_axis).amax()));
        differences.fold(0.0, f64::max)
    };
    for accuracy in [1e-8, 1e-12] {
        let series = || {
            states_at(&body, &s, &initial, 0.0, &times, accuracy, ErrorEstimates::NotWanted).map(|found| found.states)
        };
        let time = least(2, series);
        println!(
            "  taylor    at {accuracy:.0e}: {time:.2} s, off by {:.1e}, {:.0} times the time",
            off(&series()?),
            time / mean_time
        );
        let splitting = || -> Result<Vec<BodyState<f64>>, twofold::Error> {
            let motion = PlannedMotion::by(Method::Splitting, &body, &s, &initial, (0.0, last), accuracy)?;
            times.iter().map(|&t| motion.state(t)).collect()
        };
        match splitting() {
            Ok(found) => {
                let time = least(2, splitting);
                println!(
                    "  splitting at {accuracy:.0e}: {time:.2} s, off by {:.1e}, {:.0} times the time",
                    off(&found),
                    time / mean_time
                );
            }
            Err(why) => println!("  splitting at {accuracy:.0e}: {why}"),
        }
    }
    Ok(())
}
