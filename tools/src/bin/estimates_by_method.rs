//! Error estimates of every method compared with true errors, in random scenes for which the method is intended.
//!
//! `cargo run --release -p twofold-tools --bin estimates_by_method [SCENES] [SEED] [METHOD...]`; default: 10,000 scenes of seed 1 for
//! each method. An estimate below the true error is listed with the number of its scene and sets the exit status to 1.

use std::process::ExitCode;

use rayon::prelude::*;
use twofold::plan::Method;
use twofold_tools::{Ratios, argument, estimate_over_error};
use twofold_verify::error_scenes::ErrorScene;

/// Ratio of the estimate to the true error, or the reason why there is none.
enum Seen {
    Ratio(f64),
    Refused(String),
    NoSuchScene,
}

fn main() -> ExitCode {
    let (scenes, seed): (u64, u64) = (argument(0, 10_000), argument(1, 1));
    let named: Vec<Method> = std::env::args().skip(3).map(|name| Method::named(&name).expect("a method")).collect();
    println!("{scenes} scenes of seed {seed}; estimate / true error");
    println!(
        "{:<10} {:>7} {:>8} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9}",
        "method", "judged", "refused", "none", "below 1", "least", "1 %", "median", "99 %"
    );
    let mut all_above = true;
    for method in if named.is_empty() { Method::ALL.to_vec() } else { named } {
        all_above &= judge(method, scenes, seed);
    }
    if all_above { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Prints a line; returns whether no estimate was too small.
fn judge(method: Method, scenes: u64, seed: u64) -> bool {
    let rows: Vec<_> = (0..scenes).into_par_iter().map(|number| (number, look(method, seed, number))).collect();
    let (mut ratios, mut refusals, mut none) = (Vec::new(), Vec::new(), 0);
    for (number, seen) in &rows {
        match seen {
            Seen::Ratio(ratio) => {
                if *ratio < 1.0 {
                    println!("{} scene {number}: {ratio:.3} of the true error", method.name());
                }
                ratios.push(*ratio);
            }
            Seen::Refused(why) => refusals.push((number, why)),
            Seen::NoSuchScene => none += 1,
        }
    }
    let ratios: Ratios = ratios.into_iter().collect();
    let below = ratios.below(1.0);
    println!(
        "{:<10} {:>7} {:>8} {:>8} {:>8} {:>9.2} {:>9.2} {:>9.1} {:>9.1e}",
        method.name(),
        ratios.count(),
        refusals.len(),
        none,
        below,
        ratios.quantile(0.0),
        ratios.quantile(0.01),
        ratios.quantile(0.5),
        ratios.quantile(0.99)
    );
    if let Some((number, why)) = refusals.first() {
        println!("           refused first in scene {number}: {why}");
    }
    below == 0
}

fn look(method: Method, seed: u64, number: u64) -> Seen {
    let Some(scene) = ErrorScene::draw(seed, number).for_method(method, seed ^ number.wrapping_mul(0x9e37_79b9)) else {
        return Seen::NoSuchScene;
    };
    match scene.estimated_and_true(method) {
        Ok((estimate, error)) => Seen::Ratio(estimate_over_error(estimate, error)),
        Err(why) => Seen::Refused(why),
    }
}
