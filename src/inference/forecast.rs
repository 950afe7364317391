//! Forecasts: the standard deviation of an unknown as a function of span, number of data and their errors.

use super::signal::time_for_a_pulse;
use super::{Datum, Fisher, InferenceError, Noise, Observable, Signal, data_of};
use crate::error::Error;
use crate::numerics::straight_line::{Slope, slope};
use crate::parameters::{Parameter, Parameters};

/// What a forecast may be of, in words.
pub const ALLOWED_IN_FORECASTS: &str =
    "a forecast can use arrivals, closest_approaches, widths, h_plus, h_cross and strain, which need no second pulse";

/// The expected result of an observing campaign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Time from the start to the last datum.
    pub span: f64,
    /// Number of epochs, equally spaced. Each gives the next pulse and a sample of the strain.
    pub epochs: usize,
    /// Number of distinct pulses at these epochs if pulses are observed, otherwise the number of epochs.
    pub data: usize,
    /// Marginalised standard deviation of the target for the given errors; NaN if the data do not determine it or if it is not one of
    /// the unknowns. It is proportional to the errors.
    pub sigma: f64,
}

/// The standard deviation of `target` for every pair of a span and a number of epochs. The epochs are equally spaced from the start to the end of the
/// span or, where pulses are observed, to [`time_for_a_pulse`] before its end.
///
/// # Errors
/// A motion that cannot be computed; a span with no time for a pulse, if pulses are observed; [`Error::Unsupported`] for periods: each epoch of a
/// forecast has one pulse, and a period requires two.
pub fn forecast(
    parameters: &Parameters<f64>,
    noise: &[Noise],
    unknowns: &[Parameter],
    target: Parameter,
    spans: &[f64],
    epochs: &[usize],
) -> Result<Vec<Forecast>, InferenceError> {
    if noise.iter().any(|(observable, _)| *observable == Observable::Periods) {
        return Err(Error::Unsupported { what: Observable::Periods.key(), why: ALLOWED_IN_FORECASTS }.into());
    }
    let has_pulses = noise.iter().any(|(observable, _)| observable.is_of_pulses());
    let margin = if has_pulses { time_for_a_pulse(parameters) } else { 0.0 };
    let mut found = Vec::new();
    for &span in spans {
        Error::ensure(span > margin, "span of a forecast", span, "more than 2.2 turns for pulses, and above zero")?;
        let signal = Signal::new(parameters, span)?;
        let last = span - margin;
        for &count in epochs {
            let times: Vec<f64> = (0..count).map(|k| last * (k as f64 / (count - 1).max(1) as f64)).collect();
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

/// Exponents of the span and of the number of epochs in the standard deviation, if there are three or more values of each.
pub fn scaling(forecasts: &[Forecast]) -> [Option<Slope>; 2] {
    let mean_slope = |same: fn(&Forecast) -> u64, x: fn(&Forecast) -> f64| {
        // Lines with a common slope, each group about its own mean.
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
        slope(&points).ok()
    };
    [
        mean_slope(|forecast| forecast.epochs as u64, |forecast| forecast.span),
        mean_slope(|forecast| forecast.span.to_bits(), |forecast| forecast.data as f64),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::stars;
    use crate::parameters::ThirdRate;

    #[test]
    fn periods_are_refused() {
        let noise = [(Observable::Arrivals, 1e-3), (Observable::Periods, 1e-3)];
        let found = forecast(&stars::slow(), &noise, &[Parameter::Spin], Parameter::Spin, &[100.0], &[3]);
        let expected = Error::Unsupported { what: "periods", why: ALLOWED_IN_FORECASTS };
        assert_eq!(found.err(), Some(InferenceError::Model(expected)));
    }

    /// Epochs of strains are equally spaced from the start to the end, in a span of any length.
    #[test]
    fn epochs_of_strains_fill_the_span() {
        let star = stars::slow();
        let noise = [(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 2e-3)];
        let unknowns = [Parameter::Spin, Parameter::Beta];
        let turn = std::f64::consts::TAU / star.state().momentum.norm();
        let spans = [1.5 * turn, 10.0 * turn];
        let found = forecast(&star, &noise, &unknowns, Parameter::Spin, &spans, &[3, 7]).expect("forecasts");
        assert_eq!(found.len(), 4);
        for (place, (span, epochs)) in spans.into_iter().flat_map(|span| [(span, 3), (span, 7)]).enumerate() {
            let times: Vec<f64> = (0..epochs).map(|k| span * f64::from(k) / f64::from(epochs - 1)).collect();
            let signal = Signal::new(&star, span).expect("a motion");
            let data = data_of(&signal, &[], &times, &noise).expect("data");
            let sigma = Fisher::of(&star, &[], &data, &unknowns).expect("derivatives").sigma(Parameter::Spin);
            let Forecast { span: of, epochs: counted, data: different, sigma: told } = found[place];
            assert_eq!((of, counted, different), (span, epochs as usize, epochs as usize));
            let sigma = sigma.expect("one of the unknowns");
            assert!((told / sigma - 1.0).abs() < 1e-9, "{told:e} {sigma:e}");
        }
        // The scale of the strain, determined by each: at the start alone, and by two epochs at both ends.
        let of_strain = |epochs: usize| {
            forecast(&star, &noise, &[Parameter::Strain], Parameter::Strain, &spans, &[epochs]).expect("forecasts")
        };
        let signal = Signal::new(&star, spans[1]).expect("a motion");
        let weight = |t: f64| {
            let h = |(kind, sigma)| signal.strain(kind, t).expect("a strain") / sigma;
            h(noise[0]).powi(2) + h(noise[1]).powi(2)
        };
        for (found, weights) in of_strain(1)
            .into_iter()
            .zip([weight(0.0); 2])
            .chain(of_strain(2).into_iter().zip(spans.map(|end| weight(0.0) + weight(end))))
        {
            assert!((found.sigma * weights.sqrt() - 1.0).abs() < 1e-9, "{found:?}");
        }
    }

    /// The last pulse of a forecast ends within the span: its epoch is 2.2 turns before the end.
    #[test]
    fn a_span_without_time_for_a_pulse_is_refused() {
        let star = stars::precessing();
        let least = time_for_a_pulse(&star);
        let of = |star: &Parameters<f64>, span: f64| {
            let noise = [(Observable::Arrivals, 1e-6), (Observable::StrainPlus, 1e-3)];
            forecast(star, &noise, &[Parameter::Spin], Parameter::Spin, &[span], &[5])
        };
        assert!(of(&star, 2.0 * least).is_ok());
        match of(&star, 0.999 * least) {
            Err(InferenceError::Model(Error::Domain { value, .. })) => assert_eq!(value, 0.999 * least),
            other => panic!("{other:?}"),
        }
        let at_rest = Parameters { alpha_rate: 0.0, beta_rate: 0.0, third_rate: ThirdRate::Spin(0.0), ..star };
        assert!(time_for_a_pulse(&at_rest).is_infinite() && of(&at_rest, 50.0).is_err());
        let noise = [(Observable::StrainPlus, 1e-3)];
        let found = forecast(&at_rest, &noise, &[Parameter::Beta], Parameter::Beta, &[5.0, 50.0], &[9]);
        let [short, long] = found.expect("forecasts")[..] else { panic!("two spans") };
        assert!(short.sigma.is_finite() && (long.sigma / short.sigma - 1.0).abs() > 0.01, "{short:?} {long:?}");
    }

    /// A few epochs for very many pulses each give a different one; if a pulse is the next one of several epochs, it is
    /// counted once.
    #[test]
    fn a_pulse_is_counted_once() {
        let star = stars::precessing();
        let signal = Signal::new(&star, 60.0).expect("a motion");
        let pulses = signal.events().expect("pulses").len();
        let of = |epochs: usize| {
            let noise = [(Observable::Arrivals, 1e-6)];
            forecast(&star, &noise, &[Parameter::Spin], Parameter::Spin, &[60.0], &[epochs]).expect("forecasts")[0]
        };
        assert_eq!(of(4).data, 4);
        let many = of(200).data;
        assert!((pulses - 3..=pulses).contains(&many), "{many} of {pulses}");
        assert!(of(0).sigma.is_nan(), "fewer data than unknowns");
    }

    /// Two groups of different slopes and lengths, in any order, and a group of one: lines with a common slope are fitted, each group about its own
    /// mean.
    #[test]
    fn powers_are_common_slopes_of_groups() {
        let of = |epochs: usize, log_span: f64, log_sigma: f64| Forecast {
            span: 10_f64.powf(log_span),
            epochs,
            data: epochs,
            sigma: 10_f64.powf(log_sigma),
        };
        // 25 epochs: slope -1 at 0, 1, 2. 100 epochs: slope -3 at 0, 1, 2, 3, 4. Mixed, with a single point and one that is NaN.
        let mut forecasts: Vec<Forecast> = (0..5).map(|k| of(100, f64::from(k), 7.0 - 3.0 * f64::from(k))).collect();
        for (place, k) in [(0, 0.0), (2, 1.0), (6, 2.0)] {
            forecasts.insert(place, of(25, k, -k));
        }
        forecasts.push(of(7, 3.0, 55.0));
        forecasts.push(Forecast { sigma: f64::NAN, ..of(100, 9.0, 0.0) });
        let [by_span, _] = scaling(&forecasts);
        let by_span = by_span.expect("a slope");
        // The weights are the sums of squared distances from the means, 2 and 10.
        assert!((by_span.value - (-2.0 - 30.0) / 12.0).abs() < 1e-12, "{by_span:?}");
        // Remaining variance: (slope difference)^2 times these weights, over 9 points less 2, over 12.
        let left = 2.0 * (5.0_f64 / 3.0).powi(2) + 10.0 * (1.0_f64 / 3.0).powi(2);
        assert!((by_span.error - (left / 7.0 / 12.0).sqrt()).abs() < 1e-12, "{by_span:?}");
        let by_number: Vec<Forecast> = (1..6).map(|k| of(10_usize.pow(k), 2.0, -0.5 * f64::from(k))).collect();
        let [by_span, of_number] = scaling(&by_number);
        assert!(by_span.is_none(), "one span has no slope");
        assert!((of_number.expect("a slope").value + 0.5).abs() < 1e-12);
        assert!(scaling(&by_number[..2])[1].is_none(), "two points are too few");
    }
}
