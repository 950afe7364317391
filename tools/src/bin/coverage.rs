//! The coverage campaign of docs/inference.md: `cargo run --release -p twofold-tools --bin coverage -- [FIRST] [LAST]`.

use std::time::Instant;

use twofold_verify::coverage::Coverage;

fn main() {
    let mut numbers = std::env::args().skip(1).map(|text| text.parse().expect("a whole number"));
    let seeds = numbers.next().unwrap_or(0)..numbers.next().unwrap_or(1000);
    let begin = Instant::now();
    let coverage = Coverage::of(seeds);
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
