//! Error estimate over true error of splitting motions, and true error over the tolerance, in random scenes.
//!
//!     cargo run --release -p twofold-tools --bin splitting_estimate [SCENES, default 3000] [SEED, default 777]
//!
//! Half of the scenes leave the choice of scheme to the tolerance, the others go through all schemes. True errors come from the
//! Taylor motion at tolerance 1e-15.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::{AxisState, Problem, RigidSpheroid};
use twofold::propagation::Motion;
use twofold::propagation::splitting::SCHEMES;
use twofold_tools::{Ratios, argument};
use twofold_verify::check::largest_difference;
use twofold_verify::random::Random;

fn main() {
    let cases: usize = argument(0, 3000);
    let mut random = Random::with_seed(argument(1, 777));
    let (mut ratios, mut reached) = (Vec::new(), Vec::new());
    let mut refused = 0;
    for case in 0..cases {
        let mut vector = |size: f64| Vector3::from([0; 3].map(|_| random.within(-size, size)));
        let (axis, momentum, sign) = (vector(1.0).normalize(), vector(2.0), vector(1.0));
        let s = Matrix3::from_diagonal(&sign.map(|x| x.signum() * 10f64.powf(random.within(-8.0, -0.523))));
        let start = AxisState { axis, momentum };
        let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start).expect("in the domain");
        let (end, tolerance) = (random.within(5.0, 105.0), 10f64.powf(random.within(-10.0, -3.0)));
        let turn_per_stage = random.within(0.1, 0.5);
        let span = (0.0, end);
        let truth = problem.taylor(span, 1e-15).expect("in the domain");
        let chosen = case % 2 == 0;
        let motion = if chosen {
            problem.splitting(span, tolerance)
        } else {
            let scheme = SCHEMES[case / 2 % SCHEMES.len()];
            let step = turn_per_stage * scheme.stages() as f64 / momentum.norm().max(0.3);
            problem.splitting_by(scheme, span, step)
        };
        // An imposed step of many radians can overflow, which is an error and not an estimate.
        let Ok(motion) = motion else {
            refused += 1;
            continue;
        };
        let size = momentum.norm() + (2.0 * s.norm()).sqrt();
        let state = |motion: &dyn Motion<f64, State = AxisState<f64>>, t| motion.state(t).expect("in the span");
        let error = |t: f64| largest_difference(&state(&motion, t), &state(&truth, t), size);
        for part in [0.1, 0.5, 0.7, 1.0] {
            let t = part * end;
            ratios.push(motion.error_estimate(t) / error(t).max(f64::MIN_POSITIVE));
        }
        if chosen {
            reached.push(error(end) / tolerance);
        }
    }
    println!("{refused} motions refused");
    for (name, figures) in [("estimate / true error", ratios), ("true error / tolerance", reached)] {
        let figures: Ratios = figures.into_iter().collect();
        println!(
            "{name}: {} figures, {} below 1, {} above 100, least {:.2e}",
            figures.count(),
            figures.below(1.0),
            figures.above(100.0),
            figures.quantile(0.0)
        );
        let quantiles = [("1 %", 0.01), ("5 %", 0.05), ("50 %", 0.5), ("95 %", 0.95), ("99 %", 0.99), ("most", 1.0)]
            .map(|(name, part)| format!("{name} {:.2e}", figures.quantile(part)));
        println!("  quantiles {}", quantiles.join(", "));
    }
}
