//! The estimated error of a numerical motion against its true one, over the whole space of motions.

use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::error_scenes::ErrorScene;

/// Checks of this subject. `cargo run --release -p twofold-verify --example estimate_ratio` is the same over 10,000 scenes.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "error-estimate-not-below",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the estimated error of a motion is not below its true error",
            figure: "largest true / estimated error, 200 random scenes up to 60 rad, accuracies 1e-3 to 1e-16, and 6 hard ones",
            bound: Bound::AtMost(1.0),
            reason: "what an estimate is",
            measure: true_over_estimated,
        },
        Check {
            id: "error-estimate-not-far-above",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the estimated error of a motion is rarely more than a hundred times its true error",
            figure: "share of estimates above 100 times the true error, the same scenes",
            bound: Bound::AtMost(0.05),
            reason: "required; errors that happen to vanish at the time asked are among them",
            measure: far_above,
        },
    ]
}

/// Seed of the scenes.
const SEED: u64 = 3;

/// Scenes, each as seed and number, whose error is mostly one of the rounding that all steps share (of the constants, of the frame, of
/// the factors of the series), or that pass near the separatrix again and again.
const HARD: [(u64, u64); 6] = [(22, 3645), (22, 9181), (22, 5925), (22, 1197), (102, 3999), (103, 9216)];

/// The first 200 scenes of the seed that are short enough for a suite, with the ratio of true to estimated error.
fn ratios() -> impl Iterator<Item = Result<(u64, f64), String>> {
    let scenes =
        (0..).map(|number| (number, ErrorScene::draw(SEED, number))).filter(|(_, scene)| scene.turned() < 60.0);
    scenes.take(200).map(|(number, scene)| Ok((number, ratio(&scene, SEED, number)?)))
}

fn ratio(scene: &ErrorScene, seed: u64, number: u64) -> Result<f64, String> {
    let (estimate, error) =
        scene.estimated_and_true().map_err(|why| format!("scene {number} of seed {seed}: {why}"))?;
    Ok(error / estimate)
}

fn true_over_estimated() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for ratio in ratios() {
        let (number, ratio) = ratio?;
        worst.see(ratio, || format!("scene {number} of seed {SEED}"));
    }
    for (seed, number) in HARD {
        let ratio = ratio(&ErrorScene::draw(seed, number), seed, number)?;
        worst.see(ratio, || format!("scene {number} of seed {seed}"));
    }
    worst.finish()
}

fn far_above() -> Result<Measured, String> {
    let ratios = ratios().collect::<Result<Vec<_>, _>>()?;
    let far = ratios.iter().filter(|(_, ratio)| *ratio < 0.01 || ratio.is_nan()).count();
    Ok(Measured::new(far as f64 / ratios.len() as f64, format!("{far} of {} scenes of seed {SEED}", ratios.len())))
}
