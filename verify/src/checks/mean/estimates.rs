//! The error estimate of the mean motion.

use twofold::solutions::mean::MeanOrder;

use super::scenes::text;
use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::mean_scenes::MeanScene;

/// Checks of this subject.
pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "mean-error-not-below",
            kind: Kind::Property,
            equations: &[25],
            statement: "the error estimate of the mean motion, of either order, is not below its error: any strength, symmetric tensors, near the separatrix, c = 1, c^2 = 1/3",
            figure: "largest true error / estimate, 400 random motions at 12 times, up to 1,500 rad",
            bound: Bound::AtMost(1.0),
            reason: "what an estimate is for",
            measure: not_below,
        },
        Check {
            id: "mean-error-not-idle",
            kind: Kind::Property,
            equations: &[25],
            statement: "nor is it much above it",
            figure: "median of estimate / largest true error, second order, of the same motions",
            bound: Bound::AtMost(50.0),
            reason: "one and a half orders: coefficients are those of the worst geometry",
            measure: not_idle,
        },
    ]
}

const SCENES: u64 = 400;

fn seen(order: MeanOrder) -> Result<Vec<(u64, crate::mean_scenes::EstimateSeen)>, String> {
    (0..SCENES)
        .map(|number| {
            let scene = MeanScene::draw(11, number, 1500.0);
            scene.estimate_seen(order, number).map(|seen| (number, seen)).map_err(text)
        })
        .collect()
}

fn not_below() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for order in [MeanOrder::First, MeanOrder::Second] {
        for (number, seen) in seen(order)? {
            let [error, estimate, t] = seen.at;
            worst.see(seen.worst, || {
                format!("scene {number} of seed 11, {order:?}: {error:.2e} at t = {t}, estimated {estimate:.2e}")
            });
        }
    }
    worst.finish()
}

fn not_idle() -> Result<Measured, String> {
    let mut ratios: Vec<f64> = seen(MeanOrder::Second)?.iter().map(|(_, seen)| 1.0 / seen.worst).collect();
    ratios.sort_by(f64::total_cmp);
    Ok(Measured::new(ratios[ratios.len() / 2], format!("median of {} motions", ratios.len())))
}
