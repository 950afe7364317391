//! How well an unknown will be known: its standard deviation against span, number of data and their errors.

use super::{Datum, Fisher, InferenceError, Noise, Observable, Signal, data_of};
use crate::numerics::straight_line::{Slope, slope};
use crate::parameters::{Parameter, Parameters};

/// What a campaign of measurements will tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Time from the start to the last datum.
    pub span: f64,
    /// Epochs, equally spaced: the next pulse of each, and a sample of the strain.
    pub epochs: usize,
    /// Different pulses that these are, where pulses are observed; otherwise the epochs.
    pub data: usize,
    /// Standard deviation of the target for the errors given, all others unknown as well; NaN where the data do not determine it, and
    /// where it is none of the unknowns.
    /// It is proportional to the errors.
    pub sigma: f64,
}

/// The standard deviation of `target` for every pair of a span and a number of epochs.
///
/// # Errors
/// A motion that cannot be computed; [`InferenceError::PeriodsForecast`].
pub fn forecast(
    parameters: &Parameters<f64>,
    noise: &[Noise],
    unknowns: &[Parameter],
    target: Parameter,
    spans: &[f64],
    epochs: &[usize],
) -> Result<Vec<Forecast>, InferenceError> {
    if noise.iter().any(|(observable, _)| *observable == Observable::Periods) {
        return Err(InferenceError::PeriodsForecast);
    }
    let mut found = Vec::new();
    for &span in spans {
        let signal = Signal::new(parameters, span)?;
        for &count in epochs {
            // So that the last pulse ends within the span.
            let last = (span - 2.2 * signal.turn()).max(0.0);
            let times: Vec<f64> = (0..count).map(|k| last * k as f64 / (count - 1).max(1) as f64).collect();
            let has_pulses = noise.iter().any(|(observable, _)| observable.is_of_pulses());
            let events = if has_pulses { signal.events_after(&times)? } else { Vec::new() };
            let data: Vec<Datum> = data_of(&signal, &events, &times, noise)?;
            let sigma = match Fisher::of(parameters, &events, &data, unknowns) {
                Ok(fisher) => fisher.sigma(target).unwrap_or(f64::NAN),
                Err(InferenceError::TooFew { .. }) => f64::NAN,
                Err(error) => return Err(error),
            };
            let different = if has_pulses { events.len() } else { count };
            found.push(Forecast { span, epochs: count, data: different, sigma });
        }
    }
    Ok(found)
}

/// Powers of the span and of the number of epochs that the standard deviation goes with, where three or more of each are there.
pub fn scaling(forecasts: &[Forecast]) -> [Option<Slope>; 2] {
    let mean_slope = |same: fn(&Forecast) -> u64, x: fn(&Forecast) -> f64| {
        // Lines with a common slope: each group about its own mean.
        let mut groups: Vec<u64> = forecasts.iter().map(same).collect();
        groups.sort_unstable();
        groups.dedup();
        let mut points = Vec::new();
        for group in groups {
            let of_group: Vec<(f64, f64)> = forecasts
                .iter()
                .filter(|forecast| same(forecast) == group && forecast.sigma.is_finite())
                .map(|forecast| (x(forecast).log10(), forecast.sigma.log10()))
                .collect();
            let count = of_group.len().max(1) as f64;
            let (x_mean, y_mean) = of_group.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
            points.extend(of_group.into_iter().map(|(x, y)| (x - x_mean, y - y_mean)));
        }
        slope(&points).ok().filter(|slope| slope.value.is_finite())
    };
    [
        mean_slope(|forecast| forecast.epochs as u64, |forecast| forecast.span),
        mean_slope(|forecast| forecast.span.to_bits(), |forecast| forecast.data as f64),
    ]
}
