//! Estimated over true error of random motions: the distribution, by class.
//!
//! `cargo run --release -p twofold-tools --bin estimate_ratio [SCENES] [SEED] [FIRST]`; default: 10,000 scenes of seed
//! 1. Scenes below one, above 100,000 and the lowest are listed with their numbers; `1 SEED NUMBER` runs one again.

use rayon::prelude::*;
use twofold::plan::Method;
use twofold_tools::{Ratios, argument, estimate_over_error};
use twofold_verify::error_scenes::ErrorScene;

/// Number of a scene, the scene, the ratio and the true error.
type Row = (u64, ErrorScene, f64, f64);

fn main() {
    let (scenes, seed, first): (u64, u64, u64) = (argument(0, 10_000), argument(1, 1), argument(2, 0));
    let draw = |number| {
        let scene = ErrorScene::draw(seed, number);
        (number, scene, scene.estimated_and_true(Method::Taylor))
    };
    let rows: Vec<_> = (first..first + scenes).into_par_iter().map(draw).collect();
    let mut found: Vec<Row> = Vec::new();
    for (number, scene, result) in rows {
        match result {
            Ok((estimate, error)) => found.push((number, scene, estimate_over_error(estimate, error), error)),
            Err(why) => println!("scene {number}: {why}"),
        }
    }
    println!(
        "{:26} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>8}",
        "class", "scenes", "min", "1 %", "median", "95 %", "99 %", "max", "< 1", "> 100"
    );
    let within = |x: f64, low: f64, high: f64| low <= x && x < high;
    row("all", &found, |_| true);
    for (low, high) in [(1e-8, 1e-6), (1e-6, 1e-4), (1e-4, 1e-2), (1e-2, 0.1), (0.1, 1.0)] {
        row(&format!("s from {low:e} to {high:e}"), &found, |scene| within(scene.strength, low, high));
    }
    for (low, high) in [(1e-16, 1e-14), (1e-14, 1e-12), (1e-12, 1e-8), (1e-8, 1e-5), (1e-5, 1e-3)] {
        row(&format!("tolerance {low:e} to {high:e}"), &found, |scene| within(scene.tolerance, low, high));
    }
    row("L near the middle axis", &found, |scene| scene.near_middle_axis);
    row("L = 0", &found, |scene| scene.problem.initial().momentum.norm() == 0.0);
    for (low, high) in [(0.0, 3.0), (3.0, 30.0), (30.0, 300.0), (300.0, 1e6)] {
        row(&format!("turned by {low} to {high} rad"), &found, |scene| within(scene.turned(), low, high));
    }
    row("backwards", &found, |scene| scene.span.1 < scene.span.0);
    found.sort_by(|a, b| a.2.total_cmp(&b.2));
    for (index, (number, scene, ratio, error)) in found.iter().enumerate() {
        if index < 3 || *ratio < 1.0 || *ratio > 1e5 {
            println!(
                "scene {number}: ratio {ratio:.3e}, true error {error:.2e}, tolerance {:.1e}, s {:.1e}, {:.1} rad",
                scene.tolerance,
                scene.strength,
                scene.turned()
            );
        }
    }
}

fn row(name: &str, found: &[Row], belongs: impl Fn(&ErrorScene) -> bool) {
    let ratios: Ratios = found.iter().filter(|row| belongs(&row.1)).map(|row| row.2).collect();
    if ratios.count() == 0 {
        return;
    }
    let quantiles = [0.0, 0.01, 0.5, 0.95, 0.99, 1.0].map(|q| format!("{:>9}", Short(ratios.quantile(q))));
    let above = 100.0 * ratios.above(100.0) as f64 / ratios.count() as f64;
    println!("{name:26} {:>6} {} {:>6} {above:>6.2} %", ratios.count(), quantiles.join(" "), ratios.below(1.0));
}

struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = if self.0 < 1e4 { format!("{:.2}", self.0) } else { format!("{:.1e}", self.0) };
        f.pad_integral(true, "", &text)
    }
}
