//! The coverage campaigns of docs/inference.md: `cargo run --release -p twofold-tools --bin coverage -- [FIRST] [LAST] [pulsars]`. Motions, or pulsars with spin-down and torque.

use std::time::Instant;

use twofold_tools::argument;
use twofold_verify::coverage::{Case, Coverage};

fn main() {
    let seeds = argument(0, 0)..argument(1, 1000);
    let case =
        if std::env::args().nth(3).is_some_and(|kind| kind == "pulsars") { Case::of_pulsar } else { Case::of_motion };
    let begin = Instant::now();
    let coverage = Coverage::of(seeds, case);
    let seconds = begin.elapsed().as_secs_f64();
    for (seed, error) in &coverage.failed {
        println!("seed {seed}: {error}");
    }
    let iterations = coverage.cases.iter().map(|case| case.iterations).sum::<usize>() as f64;
    let refused: usize = coverage.cases.iter().map(|case| case.refused).sum();
    println!(
        "{} fits, {} failed, {refused} scenes not taken, {:.1} steps each, {seconds:.1} s",
        coverage.cases.len(),
        coverage.failed.len(),
        iterations / coverage.cases.len() as f64
    );
    for score in coverage.scores() {
        println!("{:<34}{:>9.4}  expected {:.4}  score {:+.2}", score.what, score.found, score.expected, score.score);
    }
    let mut worst: Vec<_> = coverage.cases.iter().collect();
    worst.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    for case in worst.iter().take(5) {
        println!("seed {}: chi^2 of the unknowns {:.1} of {}", case.seed, case.distance, case.pulls.len());
    }
}
