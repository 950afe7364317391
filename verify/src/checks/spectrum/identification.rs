//! Identification of known and of random frequencies.

use crate::prelude::*;
use twofold::observables::spectrum::{FrequencyBasis, Generator, Identification};

checks! {
    /// frequencies that are no combination are reported as unidentified: of 20,000 random ones no more than the chance of 1e-3 allows are taken for
    /// one
    Property "line-identification-random" [47, 71]: random_frequencies;
    AtMost(1.68) "share identified / 1e-3, with an error of 1e-5; infinite if one is identified with an error of 1e-11, or if none is with 1e-5";
    because "1e-3 is allowed: 20 of 20,000, and three standard deviations are 13.4";
    /// every combination up to order 8 of the frequencies of tp-II, given with an error of 1e-10, is identified as itself
    Property "line-identification-known" [47, 71]: known_combinations;
    AtMost(0.0) "combinations not identified, or as another one";
    because "no two combinations of orders up to 10 are within 1e-9 of each other";
}

/// The frequencies of tp-II.
fn basis(uncertainty: f64) -> Result<FrequencyBasis, String> {
    let generators = [("alpha'", 1.39467831103), ("gamma'", -0.14421753117), ("l'", -0.03546436867)];
    let generator = |(symbol, frequency)| Generator { symbol, frequency, uncertainty };
    FrequencyBasis::new(generators.map(generator).to_vec()).map_err(String::from)
}

fn random_frequencies() -> Result<Measured, String> {
    let (basis, mut random) = (basis(1e-13)?, Random::with_seed(7));
    let (mut taken, mut taken_if_precise) = (0, 0);
    let cases = 20_000;
    for _ in 0..cases {
        let frequency = random.within(0.0, 4.5);
        let identified = |error| matches!(basis.identify(frequency, error), Identification::Identified(_));
        taken += usize::from(identified(1e-5));
        taken_if_precise += usize::from(identified(1e-11));
    }
    let share = taken as f64 / cases as f64 / 1e-3;
    let figure = if taken_if_precise == 0 && taken > 0 { share } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("seed 7: {taken} with an error of 1e-5, {taken_if_precise} with 1e-11")))
}

fn known_combinations() -> Result<Measured, String> {
    let basis = basis(1e-12)?;
    let (mut wrong, mut total, mut first) = (0, 0, String::new());
    for a in -8_i32..=8 {
        for g in -8_i32..=8 {
            for l in -8_i32..=8 {
                if a.abs() + g.abs() + l.abs() > 8 {
                    continue;
                }
                total += 1;
                let value: f64 =
                    basis.generators().iter().zip([a, g, l]).map(|(f, k)| f.frequency * f64::from(k)).sum();
                let identified = basis.identify(value + 2e-10, 1e-10);
                if identified.combination().map(|c| c.integers()) != Some(vec![a, g, l]) {
                    wrong += 1;
                    first = format!("; last {:?}: {identified}", [a, g, l]);
                }
            }
        }
    }
    Ok(Measured::new(f64::from(wrong), format!("of {total} combinations{first}")))
}
