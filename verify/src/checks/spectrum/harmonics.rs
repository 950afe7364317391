//! The paper's statements about the harmonics and peaks of its spectra.

use std::ops::Range;

use super::signals::{Example, examples, strongest};
use crate::prelude::*;

/// Ranges about the fundamental, the second, third and fourth harmonic, for both examples [1/t_c].
const FUNDAMENTAL: Range<f64> = 1.0..2.0;
const SECOND: Range<f64> = 2.5..3.5;
const THIRD: Range<f64> = 4.0..5.0;
const FOURTH: Range<f64> = 5.4..6.4;

checks! {
    /// h of tp-I has a third harmonic at exactly three times its fundamental, alpha'
    Oracle "third-harmonic-tp-1" [71]: || third_harmonic(0, 0.0);
    AtMost(1e-14) "|3 w_1 - w_3| of the highest lines about 1.5 and 4.5, h_+ and h_x [1/t_c]";
    because "lines are exact to rounding: 4e-16 of 4.5";
    /// in tp-II the highest line about the third harmonic is 3 alpha' - l', not three times the fundamental alpha'; the line 3 alpha' is there and
    /// lower
    Oracle "third-harmonic-tp-2" [71]: || third_harmonic(1, 0.03546);
    AtMost(1e-5) "largest ||3 w_1 - w_3| - 0.03546| of the highest lines about 1.4 and 4.2, h_+ and h_x [1/t_c]";
    because "the slow frequency, given to 1e-5; zero is claimed";
    /// the third harmonic of tp-I is weaker than that of tp-II
    Oracle "third-harmonic-weaker" [71]: third_harmonic_ratio;
    AtMost(0.5) "largest ratio of the two, each the highest line there over the highest about the fundamental, h_+ and h_x";
    because "'further suppressed' read as at most half";
    /// 'frequencies higher than the third harmonic have even much smaller amplitudes' does not hold in tp-I: the fourth has about half the
    /// amplitude of the third, or more
    Oracle "fourth-harmonic-tp-1" [71]: || Ok(extreme(smallest, ratios(&examples()?[0], FOURTH, THIRD)?));
    AtLeast(0.4) "smallest ratio of the highest lines about the fourth and the third harmonic, h_+ and h_x";
    because "'much smaller' would be a fifth or less";
    /// in tp-II the fourth harmonic is much smaller than the third
    Oracle "fourth-harmonic-tp-2" [71]: || Ok(extreme(largest, ratios(&examples()?[1], FOURTH, THIRD)?));
    AtMost(0.2) "largest ratio of the highest lines about the fourth and the third harmonic, h_+ and h_x";
    because "'much smaller' read as at most a fifth";
    /// the highest lines about the fundamental are at the mean rates of alpha, not at the 1.438 / t_c of free precession that the figures mark
    Oracle "spectra-peaks" [47, 48, 71]: peaks;
    AtMost(1e-14) "largest distance of the highest line between 1 and 2 from the mean rate of alpha, m.n, h_+ and h_x of tp-I and tp-II [1/t_c]";
    because "lines are exact to rounding; 1.438 is 0.04 and 0.07 away";
    /// the waves of tp-II have not only harmonics of the mean rate of alpha: combinations with the slow frequency have a share of their power
    Oracle "wave-lines-not-harmonics" [71]: not_harmonics;
    AtLeast(0.01) "least share of the sum of squared amplitudes in lines that are no multiple of alpha', h_+ and h_x";
    because "none is claimed by 'all harmonics of the average rate of alpha'; a hundredth is far above the lines' errors";
    /// h of tp-I and tp-II has lines at alpha' to 4 alpha' and none higher from the third on than a tenth of the second
    Oracle "wave-harmonics-fall" [71]: harmonics_fall;
    AtMost(0.1) "largest ratio of the highest line about the third or fourth harmonic to that about the second, h_+ and h_x; infinite if a multiple \
     is missing";
    because "'decrease rapidly' read as at most a tenth";
}

/// The amplitude of the highest line about a harmonic over that about another one, for `h_+` and for `h_x`.
fn ratios(example: &Example, harmonic: Range<f64>, other: Range<f64>) -> Result<[f64; 2], String> {
    let ratio = |list: &LineList| {
        Ok::<_, String>(strongest(list, harmonic.clone())?.amplitude / strongest(list, other.clone())?.amplitude)
    };
    Ok([ratio(&example.plus)?, ratio(&example.cross)?])
}

/// The smallest or the largest of the values for `h_+` and `h_x`.
fn extreme(of: fn([f64; 2]) -> f64, values: [f64; 2]) -> Measured {
    Measured::new(of(values), format!("h_+ {:.3}, h_x {:.3}", values[0], values[1]))
}

fn third_harmonic(index: usize, expected: f64) -> Result<Measured, String> {
    let example = &examples()?[index];
    let (mut differences, mut details) = (Vec::new(), Vec::new());
    for (signal, list) in example.waves() {
        let (first, third) = (strongest(list, FUNDAMENTAL)?, strongest(list, THIRD)?);
        differences.push(((3.0 * first.frequency - third.frequency).abs() - expected).abs());
        let exact = strongest(list, 3.0 * first.frequency - 1e-12..3.0 * first.frequency + 1e-12)?;
        details.push(format!(
            "{signal}: {} ({:.2e}), {} ({:.2e}), three times the first ({:.2e})",
            first.combination, first.amplitude, third.combination, third.amplitude, exact.amplitude
        ));
    }
    Ok(Measured::new(largest(differences), details.join("; ")))
}

fn third_harmonic_ratio() -> Result<Measured, String> {
    let [weak, strong] = examples()?;
    let (weak, strong) = (ratios(weak, THIRD, FUNDAMENTAL)?, ratios(strong, THIRD, FUNDAMENTAL)?);
    let quotients = [weak[0] / strong[0], weak[1] / strong[1]];
    Ok(Measured::new(largest(quotients), format!("h_+ and h_x: {weak:.5?} in tp-I, {strong:.5?} in tp-II")))
}

fn peaks() -> Result<Measured, String> {
    let (mut distances, mut details) = (Vec::new(), Vec::new());
    for example in examples()? {
        let alpha = example.rate("alpha'")?;
        for (signal, list) in example.signals() {
            let line = strongest(list, FUNDAMENTAL)?;
            distances.push((line.frequency - alpha).abs());
            details.push(format!("{} {signal} {:.4}", example.name, line.frequency));
        }
    }
    Ok(Measured::new(largest(distances), details.join(", ")))
}

fn harmonics_fall() -> Result<Measured, String> {
    worst_of(examples()?, |example| {
        let alpha = example.rate("alpha'")?;
        for (_, list) in example.waves() {
            for multiple in [1.0, 2.0, 3.0, 4.0].map(|k| k * alpha) {
                strongest(list, multiple - 1e-12..multiple + 1e-12)?;
            }
        }
        worst_of([THIRD, FOURTH], |higher| Ok(largest(ratios(example, higher.clone(), SECOND)?)))
    })
}

fn not_harmonics() -> Result<Measured, String> {
    let example = &examples()?[1];
    let share = |list: &LineList| {
        let power = |line: &SpectralLine| line.amplitude * line.amplitude;
        let harmonic = |line: &&SpectralLine| line.combination.terms[1..].iter().all(|(k, _)| *k == 0);
        let total: f64 = list.lines.iter().map(power).sum();
        1.0 - list.lines.iter().filter(harmonic).map(power).sum::<f64>() / total
    };
    Ok(extreme(smallest, [share(&example.plus), share(&example.cross)]))
}
