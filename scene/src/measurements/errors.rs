//! Simulated errors of data, and starting points of fits near the true parameters.

use nalgebra::DVector;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use twofold::Error;
use twofold::inference::{Datum, Fisher, Model, TimingData, Unknown};

/// Largest number of draws of a start; it ends with the first that is within the limits of the unknowns.
const DRAWS: usize = 100;

/// The data with a random error added to each, drawn from a normal distribution with the standard deviation of the datum.
pub fn with_noise(data: &[Datum], random: &mut ChaCha8Rng) -> Vec<Datum> {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    data.iter().map(|datum| Datum { value: datum.value + datum.sigma * normal(), ..*datum }).collect()
}

/// Adds a random error to every arrival time and width, drawn from a normal distribution with the standard deviation of the measurement.
pub fn add_timing_noise(data: &mut TimingData, random: &mut ChaCha8Rng) {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    data.arrivals.iter_mut().for_each(|arrival| arrival.time[1] += arrival.sigma * normal());
    data.widths.iter_mut().for_each(|width| width.duration += width.sigma * normal());
}

/// A starting point for a fit: the parameters of a Fisher matrix with its unknowns displaced by a draw from their normal distribution, `factor`
/// times as wide, within the limits of the unknowns.
///
/// # Errors
/// As for [`Fisher::displaced`]; no draw of a hundred is within the limits.
pub fn beside<M: Model>(fisher: &Fisher<M>, factor: f64, random: &mut ChaCha8Rng) -> Result<M, Error> {
    for _ in 0..DRAWS {
        let normal = DVector::from_fn(fisher.unknowns.len(), |_, _| StandardNormal.sample(random));
        let start = fisher.displaced(&normal, factor)?;
        let is_allowed = |unknown: &M::Unknown| {
            let ((low, high), value) = (unknown.limits(), start.value(*unknown));
            low.is_none_or(|low| low <= value) && high.is_none_or(|high| value <= high)
        };
        if fisher.unknowns.iter().all(is_allowed) {
            return Ok(start);
        }
    }
    Err(Error::Unsupported {
        what: "a simulated start",
        why: "none of a hundred draws is within the limits of the unknowns",
    })
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use twofold::inference::{MeasuredArrival, MeasuredWidth, Signal};

    use super::*;
    use crate::measurements::Measurement;
    use crate::scene_file::Scene;

    /// Draws some 1e4 rad wide: an angle to Z is at most half a turn.
    #[test]
    fn a_start_that_is_never_allowed_is_refused() {
        let measurement = Measurement::new(Scene::named("tp-2").unwrap(), "arrivals:1e-6", Some("beta")).unwrap();
        let signal = Signal::new(&measurement.parameters, measurement.end).unwrap();
        let (events, data) = (measurement.events(&signal).unwrap(), measurement.simulated(&signal).unwrap());
        let fisher = Fisher::of(&measurement.parameters, &events, &data, &measurement.unknowns).unwrap();
        let factor = 1e4 / fisher.sigmas()[0];
        let start = |factor: f64| beside(&fisher, factor, &mut ChaCha8Rng::seed_from_u64(1));
        assert!(start(1.0).is_ok());
        let why = start(factor).unwrap_err().to_string();
        assert_eq!(why, "a simulated start: none of a hundred draws is within the limits of the unknowns");
    }

    /// The random numbers are used first for arrivals and then for widths, in standard deviations of each.
    #[test]
    fn arrivals_and_then_widths_are_off_by_normal_numbers() {
        let arrivals = [1e-3, 4.0].map(|sigma| MeasuredArrival { time: [1e9, 0.5], sigma, number: Some(7) }).to_vec();
        let widths = vec![MeasuredWidth { time: 1e9, duration: 2.0, sigma: 0.25 }];
        let mut data = TimingData { arrivals, widths, priors: Vec::new() };
        add_timing_noise(&mut data, &mut ChaCha8Rng::seed_from_u64(1));
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let normal: [f64; 3] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
        let found = [(data.arrivals[0].time[1] - 0.5) / 1e-3, (data.arrivals[1].time[1] - 0.5) / 4.0];
        let found = [found[0], found[1], (data.widths[0].duration - 2.0) / 0.25];
        for (found, normal) in found.iter().zip(normal) {
            // A rounding of the sum, divided by the smallest deviation.
            assert!((found - normal).abs() < 4.0 * f64::EPSILON / 1e-3, "{found} and {normal}");
        }
        assert!(data.arrivals.iter().all(|arrival| arrival.time[0] == 1e9) && data.widths[0].time == 1e9);
    }
}
