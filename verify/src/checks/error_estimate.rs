//! The estimated error of a numerical motion compared with the true one, over the whole space of motions.

use crate::prelude::*;

// `cargo run --release -p twofold-tools --bin estimate_ratio` does the same for 10,000 scenes.
checks! {
    /// the estimated error of a motion is not below its true error
    Oracle "error-estimate-not-below" [25]: || worst_of(scenes().chain(HARD), ratio);
    AtMost(1.0) "largest true / estimated error, 200 random scenes up to 60 rad, tolerances 1e-3 to 1e-16, and 6 hard ones";
    because "an estimate below the true error is wrong";
    /// the estimated error of a motion that starts near a state of rest, stable or not, is not below its true error
    Oracle "error-estimate-near-rest" [25]: || worst_of(short(near_rest).take(2000), |&number| estimate_ratio(&near_rest(number)));
    AtMost(1.0) "largest true / estimated error, 2,000 random scenes that start 1e-12 to 1e-1 off a state of rest or of spin about an axis of s, tolerances 1e-6 to 1e-2, up to 60 rad";
    because "an estimate below the true error is wrong";
    /// the estimated error of a motion in parts, each of which continues the one before, is not below its true error
    Oracle "error-estimate-in-parts" [25]: || worst_of(in_parts(), ratio_in_parts);
    AtMost(1.0) "largest true / estimated error by Taylor series and by splitting in two to five parts at a time in the last, 200 random scenes and 300 near a state of rest, up to 60 rad, and 3 hard ones";
    because "an estimate below the true error is wrong";
    /// the estimated error of a motion is rarely more than a hundred times its true error
    Oracle "error-estimate-not-far-above" [25]: far_above;
    AtMost(0.03) "share of estimates above 100 times the true error, the same scenes";
    because "an error A sin(phi) is below A / 100 at (2 / pi) asin(1 / 100) = 0.64 % of random phases phi, 1.3 of 200 scenes. The probability of more than six in 200 is 4e-4 (Poisson)";
}

/// Seed of the scenes.
const SEED: u64 = 3;

/// Scenes, each as seed and number, whose error is mostly one rounding common to all steps (of the constants, of the frame or of the
/// factors of the series), or that pass near the separatrix again and again.
const HARD: [(u64, u64); 6] = [(22, 3645), (22, 9181), (22, 5925), (22, 1197), (102, 3999), (103, 9216)];

/// True over estimated error of a scene.
fn ratio(&(seed, number): &(u64, u64)) -> Result<f64, String> {
    estimate_ratio(&ErrorScene::draw(seed, number))
}

fn estimate_ratio(scene: &ErrorScene) -> Result<f64, String> {
    ratio_of(scene.estimated_and_true(Method::Taylor))
}

fn ratio_of(estimated_and_true: Result<(f64, f64), String>) -> Result<f64, String> {
    estimated_and_true.map(|(estimate, error)| error / estimate)
}

/// A scene that starts near rest or anywhere, with a method and a number of parts.
#[derive(Debug)]
struct InParts {
    near_rest: bool,
    number: u64,
    method: Method,
    parts: u32,
}

/// Motions in parts with a large error of `L.n` or of the length of `n` at the end of a part, and one with nearly equal eigenvalues.
const HARD_IN_PARTS: [InParts; 3] = [
    InParts { near_rest: false, number: 2686, method: Method::Taylor, parts: 4 },
    InParts { near_rest: true, number: 5433, method: Method::Taylor, parts: 3 },
    InParts { near_rest: true, number: 1288, method: Method::Splitting, parts: 2 },
];

fn in_parts() -> impl Iterator<Item = InParts> {
    let scenes =
        scenes().map(|(_, number)| (false, number)).chain(short(near_rest).take(300).map(|number| (true, number)));
    let scenes = scenes.zip((2..=5).cycle()).flat_map(|((near_rest, number), parts)| {
        [Method::Taylor, Method::Splitting].map(|method| InParts { near_rest, number, method, parts })
    });
    scenes.chain(HARD_IN_PARTS)
}

fn ratio_in_parts(case: &InParts) -> Result<f64, String> {
    let scene = if case.near_rest { near_rest(case.number) } else { ErrorScene::draw(SEED, case.number) };
    // In the last part, which continues all others.
    let last = 1.0 / f64::from(case.parts);
    let (start, end) = scene.span;
    let part_of_span = (scene.time - start) / (end - start);
    let scene = ErrorScene { time: start + (end - start) * (1.0 - last + last * part_of_span), ..scene };
    ratio_of(scene.estimated_and_true_in_parts(case.method, case.parts))
}

fn near_rest(number: u64) -> ErrorScene {
    ErrorScene::draw(SEED, number).started_near_rest(number)
}

/// Numbers of the scenes that are short enough for the test suite.
fn short(draw: impl Fn(u64) -> ErrorScene) -> impl Iterator<Item = u64> {
    (0..).filter(move |&number| draw(number).turned() < 60.0)
}

/// The first 200 short scenes of the seed.
fn scenes() -> impl Iterator<Item = (u64, u64)> {
    short(|number| ErrorScene::draw(SEED, number)).map(|number| (SEED, number)).take(200)
}

fn far_above() -> Result<Measured, String> {
    let ratios = scenes().map(|scene| ratio(&scene)).collect::<Result<Vec<_>, _>>()?;
    let far = ratios.iter().filter(|ratio| **ratio < 0.01 || ratio.is_nan()).count();
    Ok(Measured::new(far as f64 / ratios.len() as f64, format!("{far} of {} scenes of seed {SEED}", ratios.len())))
}
