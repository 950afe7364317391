//! The error estimate of the averaged motion.

use std::sync::LazyLock;

use twofold::solutions::averaged::OfRotations;

use super::scenes::difference;
use crate::averaged_scenes::{AveragedScene, EstimateSeen};
use crate::prelude::*;

checks! {
    /// the error estimate of the averaged motion, of either order, is not below its error: any strength, symmetric tensors, near the separatrix, c
    /// = 1, c^2 = 1/3
    Property "mean-error-not-below" [25]: not_below;
    AtMost(1.0) "largest true error / estimate, 400 random motions at 12 times, up to 1,500 rad";
    because "an estimate below the true error is wrong";
    /// the estimate is not below the error beside the separatrix, closer to it than the terms that the order neglects, while L goes round a few
    /// times
    Property "mean-error-separatrix" [25]: beside_separatrix;
    AtMost(1.0) "largest true error / estimate, 300 random motions at 12 times, both orders";
    because "an estimate below the true error is wrong";
    /// the part of the estimate for rounding is not below the difference from the same theory in double-double numbers, nor a million times above it,
    /// and for most motions not a thousand times
    Property "mean-error-rounding" [25]: rounding;
    AtMost(0.0) "largest |log10| by which estimate / difference leaves [1, 1e6], or their median [1, 1e3], 60 motions after up to 1e12 rad";
    because "a bound for each of some hundred roundings, and near the separatrix those of the start grow";
    /// the error estimate of the averaged motion is not much above its error
    Property "mean-error-not-idle" [25]: not_idle;
    AtMost(50.0) "median of estimate / largest true error, second order, of the same motions";
    because "one and a half orders of magnitude: the coefficients of the estimate are those of the worst geometry";
}

/// The random motions of two checks, for both orders.
fn seen() -> Result<&'static [[EstimateSeen; 2]], String> {
    static SEEN: LazyLock<Result<Vec<[EstimateSeen; 2]>, String>> = LazyLock::new(|| {
        let seen = |number| Ok(AveragedScene::draw(11, number, 1500.0).estimates_seen(number)?);
        (0..400).map(seen).collect()
    });
    Ok(SEEN.as_ref()?)
}

/// The larger ratio of the two orders.
fn larger(seen: &[EstimateSeen; 2]) -> f64 {
    largest(seen.map(|seen| seen.worst))
}

fn not_below() -> Result<Measured, String> {
    worst_of(seen()?.iter().enumerate(), |(_, seen)| Ok(larger(seen)))
}

fn beside_separatrix() -> Result<Measured, String> {
    worst_of(0..300, |&number| {
        let scene = AveragedScene::beside_separatrix(13, number);
        Ok(larger(&scene.estimates_seen(number)?))
    })
}

fn rounding() -> Result<Measured, String> {
    let (mut random, mut ratios) = (Random::with_seed(64), Vec::new());
    let worst = worst_of(0..60, |&number| {
        let scene = AveragedScene::draw(19, number, 10.0);
        let averaged = scene.motion::<f64>(AveragingOrder::Second)?;
        let exact = scene.motion::<DoubleDouble>(AveragingOrder::Second)?;
        let t = 10f64.powf(random.within(0.0, 12.0));
        // The reference has only the phase errors that grow with time: it is the same theory, and its phases are reduced in double-double numbers.
        let rates = exact.rates();
        let phases = [rates.slow, rates.about_momentum, rates.about_axis].map(|rate| rate * DoubleDouble::from_f64(t));
        let tau = DoubleDouble::tau();
        let [slow, about_momentum, about_axis] =
            phases.map(|phase| phase - tau * DoubleDouble::from_f64((phase.high() / TAU).round()));
        let start = exact.phases_at([0.0; 2]);
        let right = exact.state_at(&OfRotations { slow: start.slow + slow, about_momentum, about_axis });
        let right = BodyState::from_vectors(right.vectors().map(|v| v.map(DoubleDouble::high)));
        let off = difference(&averaged.state(t), &right);
        let estimate = averaged.rounding(t);
        let ratio = (estimate / if off < 1e-16 { 1e-16 } else { off }).log10();
        ratios.push(ratio);
        let outside = if ratio.is_nan() { f64::INFINITY } else { (-ratio).max(ratio - 6.0).max(0.0) };
        Ok(Measured::new(outside, format!("at t = {t:e}: {off:.1e}, estimated {estimate:.1e}")))
    })?;
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    Ok(Measured::new(largest([worst.figure, median - 3.0]), format!("median 1e{median:.1}; {}", worst.detail)))
}

fn not_idle() -> Result<Measured, String> {
    let mut ratios: Vec<f64> = seen()?.iter().map(|[_, second]| 1.0 / second.worst).collect();
    ratios.sort_by(f64::total_cmp);
    Ok(Measured::new(ratios[ratios.len() / 2], format!("median of {} motions", ratios.len())))
}
