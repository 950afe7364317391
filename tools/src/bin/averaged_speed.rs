//! Cost of the averaged motion compared with a numerical motion of the same error:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin averaged_speed
//! ```
//!
//! The shortest of many runs, in processor time of this thread if available.

use std::hint::black_box;

use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::plan::Method;
use twofold::propagation::{AveragedMotion, Motion};
use twofold_tools::least_time;
use twofold_verify::check::largest_difference;
use twofold_verify::reference::reference_motion;

/// Geometry of tp-II with the given largest `s`.
fn problem(size: f64) -> Result<Problem<f64>, Error> {
    let scene = reference_motion("tp-2");
    Problem::new(scene.spheroid, scene.violation() * (size / 0.04), scene.initial())
}

/// The averaged motion of second order.
fn averaged(problem: &Problem<f64>, end: f64) -> Result<AveragedMotion<f64>, Error> {
    AveragedMotion::new(black_box(problem), (0.0, end))
}

fn states(motion: &impl Motion<f64, State = BodyState<f64>>, times: &[f64]) -> Result<Vec<BodyState<f64>>, Error> {
    times.iter().map(|&t| motion.state(t)).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let slow = problem(1e-9)?;
    let set_up = least_time(200, || (0..100).filter(|_| averaged(&slow, 1e17).is_ok()).count());
    println!("set-up {:.2} us", set_up * 1e4);
    let motion = averaged(&slow, 1e17)?;
    for t in [1.0, 1e5, 1e10, 1e15] {
        let each = least_time(500, || {
            (0..1000)
                .map(|i| motion.state(black_box(t * (1.0 + 1e-6 * f64::from(i)))).map_or(0.0, |x| x.axis.x))
                .sum::<f64>()
        });
        println!("a state at t = {t:e} t_c: {:.0} ns", each * 1e6);
    }

    // 642 Hz and 15 years with t_c = sqrt(I^xx / C) = 10 ms: about 4e11 turns.
    let spin = 642.0 * core::f64::consts::TAU * 0.01;
    let body = RigidSpheroid::in_units_of_tc(1.001);
    let axis = Vector3::new(0.3, 0.1, (1.0_f64 - 0.1).sqrt());
    let initial = BodyState {
        axis,
        momentum: axis * (spin * body.inertia_zz),
        equatorial_axis: axis.cross(&Vector3::new(0.2, -0.5, 0.3)).normalize(),
    };
    let fast = Problem::new(body, *slow.coefficients(), initial)?;
    let fifteen_years = 15.0 * 365.25 * 86_400.0 / 0.01;
    let times: Vec<f64> = (0..10_000).map(|i| (fifteen_years * f64::from(i) / 9_999.0).min(fifteen_years)).collect();
    let sampled = least_time(50, || states(&averaged(&fast, fifteen_years)?, &times));
    println!("10,000 epochs over 15 years at 642 Hz, set-up included: {:.2} ms", sampled * 1e3);

    // s = 1e-6 over 1e7 t_c with 100 states. The averaged motion is the reference: checks show that its error is far below the others.
    let problem = problem(1e-6)?;
    let times: Vec<f64> = (1..=100).map(|i| 1e5 * f64::from(i)).collect();
    let last = 1e7;
    let by_average = || states(&averaged(&problem, last)?, &times);
    let right = by_average()?;
    let average_time = least_time(100, by_average);
    println!(
        "s = 1e-6 over 1e7 t_c, 100 states: averaged motion {:.1} us, its error estimate {:.1e}",
        average_time * 1e6,
        averaged(&problem, last)?.error_estimate(last)
    );
    let report = |name: &str, tolerance: f64, run: &dyn Fn() -> Result<Vec<BodyState<f64>>, Error>| match run() {
        Ok(found) => {
            let time = least_time(2, run);
            // Errors of n and e_x.
            let off =
                found.iter().zip(&right).map(|(a, b)| largest_difference(a, b, f64::INFINITY)).fold(0.0, f64::max);
            println!(
                "  {name:9} at {tolerance:.0e}: {time:.2} s, off by {off:.1e}, {:.0} times the time",
                time / average_time
            );
        }
        Err(why) => println!("  {name:9} at {tolerance:.0e}: {why}"),
    };
    for tolerance in [1e-8, 1e-12] {
        report("taylor", tolerance, &|| Ok(problem.taylor_states(0.0, &times, tolerance)?.states));
        report("splitting", tolerance, &|| {
            states(&problem.motion_by(Method::Splitting, (0.0, last), tolerance)?, &times)
        });
    }
    Ok(())
}
