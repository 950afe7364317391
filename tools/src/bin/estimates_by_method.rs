//! Error estimates of every method beside true errors, in random scenes that the method is made for.
//!
//! `cargo run --release -p twofold-tools --bin estimates_by_method [SCENES] [SEED] [METHOD...]`: 10,000 scenes of seed 1 for each method
//! unless said. An estimate below the true error is listed with the number of its scene and makes the exit status 1.

use std::process::ExitCode;

use rayon::prelude::*;
use twofold::plan::Method;
use twofold_verify::error_scenes::ErrorScene;

/// Ratio of the estimate to the true error, or why there is none.
enum Seen {
    Ratio(f64),
    Refused(String),
    NoSuchScene,
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let scenes: u64 = arguments.next().map_or(10_000, |text| text.parse().expect("a number of scenes"));
    let seed: u64 = arguments.next().map_or(1, |text| text.parse().expect("a seed"));
    let named: Vec<Method> = arguments.map(|name| Method::named(&name).expect("a method")).collect();
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

/// A line of the table; whether no estimate was below.
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
    ratios.sort_by(f64::total_cmp);
    let below = ratios.iter().filter(|ratio| **ratio < 1.0).count();
    let at =
        |part: f64| ratios.get((ratios.len().saturating_sub(1) as f64 * part) as usize).copied().unwrap_or(f64::NAN);
    println!(
        "{:<10} {:>7} {:>8} {:>8} {:>8} {:>9.2} {:>9.2} {:>9.1} {:>9.1e}",
        method.name(),
        ratios.len(),
        refusals.len(),
        none,
        below,
        at(0.0),
        at(0.01),
        at(0.5),
        at(0.99)
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
    match scene.estimated_and_true_by(method) {
        // What is not a number counts as below, and an exact state as above.
        Ok((estimate, error)) if estimate.is_nan() || error.is_nan() => Seen::Ratio(0.0),
        Ok((estimate, error)) => Seen::Ratio(if error == 0.0 { f64::INFINITY } else { estimate / error }),
        Err(why) => Seen::Refused(why),
    }
}
