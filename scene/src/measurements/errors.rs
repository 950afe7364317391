//! Simulated errors of data, and starts of fits beside the truth.

use nalgebra::DVector;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use twofold::Error;
use twofold::inference::{Datum, Fisher, Model, TimingData};

/// The same data with an error each, normal with its standard deviation.
pub fn with_noise(data: &[Datum], random: &mut ChaCha8Rng) -> Vec<Datum> {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    data.iter().map(|datum| Datum { value: datum.value + datum.sigma * normal(), ..*datum }).collect()
}

/// Adds to every arrival time and width an error, normal with its standard deviation.
pub fn add_timing_noise(data: &mut TimingData, random: &mut ChaCha8Rng) {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    data.arrivals.iter_mut().for_each(|arrival| arrival.time[1] += arrival.sigma * normal());
    data.widths.iter_mut().for_each(|width| width.duration += width.sigma * normal());
}

/// A start for a fit: the parameters of a Fisher matrix with its unknowns moved by a draw of their normal distribution, `factor` times as wide.
pub fn beside<M: Model>(fisher: &Fisher<M>, factor: f64, random: &mut ChaCha8Rng) -> Result<M, Error> {
    let normal = DVector::from_fn(fisher.unknowns.len(), |_, _| StandardNormal.sample(random));
    fisher.beside(&normal, factor)
}
