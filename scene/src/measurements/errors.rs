//! Simulated errors of data, and starts of fits beside the truth.

use nalgebra::DVector;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use twofold::inference::{Datum, Fisher};
use twofold::parameters::Parameters;

/// The same data with an error each, normal with its standard deviation.
pub fn with_noise(data: &[Datum], random: &mut ChaCha8Rng) -> Vec<Datum> {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    data.iter().map(|datum| Datum { value: datum.value + datum.sigma * normal(), ..*datum }).collect()
}

/// A start for a fit: the parameters of a Fisher matrix with its unknowns moved by a draw of their normal distribution, `factor` times as wide.
pub fn beside(fisher: &Fisher, factor: f64, random: &mut ChaCha8Rng) -> Parameters<f64> {
    let normal = DVector::from_fn(fisher.unknowns.len(), |_, _| StandardNormal.sample(random));
    fisher.beside(&normal, factor)
}
