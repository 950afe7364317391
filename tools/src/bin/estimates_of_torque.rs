//! Stated truncation error of stretched time compared with the true one, for random stars that slow down.
//!
//! `cargo run --release -p twofold-tools --bin estimates_of_torque [STARS] [SEED]`; default: 100,000 stars of seed 1. The true delay is the law
//! itself, integrated by Gauss' formula. A star with a delay error above the stated one is listed with its number and sets the exit status to 1.

use std::process::ExitCode;

use rayon::prelude::*;
use twofold_tools::{Ratios, argument};
use twofold_verify::braked_stars::BrakedStar;

fn main() -> ExitCode {
    let (stars, seed): (u64, u64) = (argument(0, 100_000), argument(1, 1));
    println!("{stars} stars of seed {seed}; error stated / true error of the delay");
    println!(
        "{:<10} {:>7} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9} {:>9}",
        "star", "judged", "refused", "rounding", "below 1", "least", "1 %", "median", "99 %"
    );
    let mut all_above = true;
    for (name, damped) in [("any index", false), ("damped", true)] {
        let seen: Vec<_> = (0..stars)
            .into_par_iter()
            .map(|number| (number, BrakedStar::draw(seed, number, damped).stated_over_true()))
            .collect();
        let refused = seen.iter().filter(|(_, seen)| seen.is_err()).count();
        let judged: Vec<_> =
            seen.iter().filter_map(|(number, seen)| Some((number, seen.as_ref().ok()?.as_ref()?))).collect();
        for (number, ratio) in judged.iter().filter(|(_, ratio)| ratio.is_nan() || **ratio < 1.0).take(20) {
            println!("{name} star {number}: {ratio:.3} {:?}", BrakedStar::draw(seed, **number, damped));
        }
        let rounding = seen.len() - refused - judged.len();
        let ratios: Ratios = judged.iter().map(|(_, ratio)| **ratio).collect();
        all_above &= ratios.below(1.0) == 0;
        println!(
            "{name:<10} {:>7} {refused:>8} {rounding:>9} {:>8} {:>9.2} {:>9.2} {:>9.1} {:>9.1e}",
            ratios.count(),
            ratios.below(1.0),
            ratios.quantile(0.0),
            ratios.quantile(0.01),
            ratios.quantile(0.5),
            ratios.quantile(0.99)
        );
    }
    if all_above { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
