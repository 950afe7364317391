//! True error over estimate of the averaged motion: its distribution over random motions.
//!
//! `cargo run --release -p twofold-tools --bin mean_estimate [SCENES] [SEED] [RADIANS]`: 10,000 scenes of seed 1 that turn by up to
//! 3,000 rad unless said. Scenes whose estimate is below the error are listed.

use twofold::solutions::averaged::AveragingOrder;
use twofold_verify::averaged_scenes::AveragedScene;

fn main() {
    let arguments: Vec<u64> = std::env::args().skip(1).filter_map(|text| text.parse().ok()).collect();
    let argument = |index: usize, otherwise| arguments.get(index).copied().unwrap_or(otherwise);
    let (scenes, seed, turned) = (argument(0, 10_000), argument(1, 1), argument(2, 3000));
    println!("{scenes} scenes of seed {seed}, up to {turned} rad");
    for order in [AveragingOrder::First, AveragingOrder::Second] {
        let mut ratios = Vec::new();
        for number in 0..scenes {
            match AveragedScene::draw(seed, number, turned as f64).estimate_seen(order, number) {
                Ok(seen) => {
                    if seen.worst > 1.0 {
                        println!(
                            "scene {number}: {:.3} times the estimate; error, estimate, t {:?}",
                            seen.worst, seen.at
                        );
                    }
                    ratios.push(seen.worst);
                }
                Err(why) => println!("scene {number}: {why}"),
            }
        }
        ratios.sort_by(f64::total_cmp);
        let below = ratios.iter().filter(|ratio| **ratio > 1.0).count();
        let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
        println!(
            "{order:?}: {below} of {} below; error / estimate 1 % {:.1e}, 50 % {:.1e}, 99 % {:.2}, 99.9 % {:.2}, most {:.3}",
            ratios.len(),
            at(0.01),
            at(0.5),
            at(0.99),
            at(0.999),
            at(1.0)
        );
    }
}
