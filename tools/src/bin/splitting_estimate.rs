//! Error estimate over true error of splitting motions, and true error over the accuracy asked, in random scenes.
//!
//!     cargo run --release -p twofold-tools --bin splitting_estimate [SCENES, default 3000] [SEED, default 777]
//!
//! Half of the scenes leave the choice of scheme to the accuracy, the others go through all schemes. True errors by the Taylor
//! motion at accuracy 1e-15.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::RigidSpheroid;
use twofold::propagation::splitting::{SCHEMES, propagate_by_best_splitting, propagate_by_splitting};
use twofold::propagation::{AxisState, Motion, propagate_axis};
use twofold_verify::check::{largest, largest_component};
use twofold_verify::random::Random;

fn main() {
    let cases: usize = std::env::args().nth(1).map_or(3000, |text| text.parse().expect("a number of scenes"));
    let mut random = Random::with_seed(std::env::args().nth(2).map_or(777, |text| text.parse().expect("a seed")));
    let body = RigidSpheroid::in_units_of_tc(1.1);
    let (mut ratios, mut reached) = (Vec::new(), Vec::new());
    let mut refused = 0;
    for case in 0..cases {
        let mut vector = |size: f64| Vector3::from([0; 3].map(|_| random.within(-size, size)));
        let (axis, momentum, sign) = (vector(1.0).normalize(), vector(2.0), vector(1.0));
        let s = Matrix3::from_diagonal(&sign.map(|x| x.signum() * 10f64.powf(random.within(-8.0, -0.523))));
        let start = AxisState { axis, momentum };
        let (end, accuracy) = (random.within(5.0, 105.0), 10f64.powf(random.within(-10.0, -3.0)));
        let turn_per_stage = random.within(0.1, 0.5);
        let span = (0.0, end);
        let truth = propagate_axis(&body, &s, &start, span, 1e-15).expect("in the domain");
        let chosen = case % 2 == 0;
        let motion = if chosen {
            propagate_by_best_splitting(&body, &s, &start, span, accuracy)
        } else {
            let scheme = SCHEMES[case / 2 % SCHEMES.len()];
            let step = turn_per_stage * scheme.stages() as f64 / momentum.norm().max(0.3);
            propagate_by_splitting(&body, &s, &start, span, scheme, step)
        };
        // A forced step of many radians can overflow, which is an error and not an estimate.
        let Ok(motion) = motion else {
            refused += 1;
            continue;
        };
        let size = momentum.norm() + (2.0 * s.norm()).sqrt();
        let error = |t: f64| {
            let (a, b) = (motion.axis_state(t).expect("in the span"), truth.axis_state(t).expect("in the span"));
            largest([largest_component(&(a.axis - b.axis)), largest_component(&(a.momentum - b.momentum)) / size])
        };
        for part in [0.1, 0.5, 0.7, 1.0] {
            let t = part * end;
            ratios.push((motion.error_estimate(t) / error(t).max(f64::MIN_POSITIVE), case));
        }
        if chosen {
            reached.push((error(end) / accuracy, case));
        }
    }
    println!("{refused} motions refused");
    for (name, figures) in [("estimate / true error", &mut ratios), ("true error / accuracy asked", &mut reached)] {
        figures.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = |quantile: f64| figures[((figures.len() - 1) as f64 * quantile) as usize].0;
        let below = figures.iter().filter(|(x, _)| x.is_nan() || *x < 1.0).count();
        let above = figures.iter().filter(|(x, _)| x.is_nan() || *x > 100.0).count();
        println!("{name}: {} figures, {below} below 1, {above} above 100, least {:?}", figures.len(), figures[0]);
        println!(
            "  quantiles 1 % {:.2e}, 5 % {:.2e}, 50 % {:.2e}, 95 % {:.2e}, 99 % {:.2e}, most {:.2e}",
            at(0.01),
            at(0.05),
            at(0.5),
            at(0.95),
            at(0.99),
            at(1.0)
        );
    }
}
