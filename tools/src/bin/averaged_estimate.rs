//! True error over estimate of the averaged motion: the distribution over random motions.
//!
//! `cargo run --release -p twofold-tools --bin averaged_estimate [SCENES] [SEED] [RADIANS]`; defaults: 10,000 scenes of seed 1 that
//! turn by up to 3,000 rad. Scenes with an estimate below the error are listed.

use twofold_tools::{Ratios, argument};
use twofold_verify::averaged_scenes::AveragedScene;

fn main() {
    let (scenes, seed, turned) = (argument(0, 10_000), argument(1, 1), argument(2, 3000));
    println!("{scenes} scenes of seed {seed}, up to {turned} rad");
    let look = |number| match AveragedScene::draw(seed, number, f64::from(turned)).estimates_seen(number) {
        Ok(seen) => {
            for (order, seen) in ["first", "second"].iter().zip(&seen).filter(|(_, seen)| seen.worst > 1.0) {
                println!(
                    "scene {number}, {order} order: {:.3} times the estimate; error, estimate, t {:?}",
                    seen.worst, seen.at
                );
            }
            Some(seen)
        }
        Err(why) => {
            println!("scene {number}: {why}");
            None
        }
    };
    let seen: Vec<_> = (0..scenes).filter_map(look).collect();
    for (index, order) in ["first", "second"].into_iter().enumerate() {
        let ratios: Ratios = seen.iter().map(|orders| orders[index].worst).collect();
        println!(
            "{order} order: {} of {} below; error / estimate 1 % {:.1e}, 50 % {:.1e}, 99 % {:.2}, 99.9 % {:.2}, most {:.3}",
            ratios.above(1.0),
            ratios.count(),
            ratios.quantile(0.01),
            ratios.quantile(0.5),
            ratios.quantile(0.99),
            ratios.quantile(0.999),
            ratios.quantile(1.0)
        );
    }
}
