//! Where the approximate period and width follow the pulse train. Eqs. (51), (56) with (57).

use twofold::observables::pulsar::direction::cosine_of_colatitude;
use twofold::observables::pulsar::period::{approximate_period, azimuth_offset_rate};
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{Stamped, pulse_train};
use twofold::solutions::perturbation::shifted_rates;

use super::train::paper_signal;
use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::paper_examples::{COEFFICIENTS, SPIN, spheroid};

const SPAN: (f64, f64) = (0.0, 400.0);

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "pulse-series-fit-tp-1",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "Eqs. (51) and (56), with beta_0 and the shifted rates (57), follow the period and width series of tp-I",
            figure: "larger of the two root mean square deviations / that of the series from its mean",
            bound: Bound::AtMost(1.0 / 3.0),
            reason: "'they fit very well' read as leaving less than a third of the modulation",
            measure: fit_of_tp_1,
        },
        Check {
            id: "pulse-series-fail-tp-2",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "they fail for tp-II",
            figure: "smaller of the two root mean square deviations / that of the series from its mean",
            bound: Bound::AtLeast(1.0),
            reason: "'fail to approximate' read as no better than the mean of the series",
            measure: failure_of_tp_2,
        },
    ]
}

fn fit_of_tp_1() -> Result<Measured, String> {
    let (period, width) = deviations("tp-1")?;
    let mut worst = Worst::default();
    worst.see(period, || format!("period {period:.4}, width {width:.4}"));
    worst.see(width, || format!("period {period:.4}, width {width:.4}"));
    worst.finish()
}

fn failure_of_tp_2() -> Result<Measured, String> {
    let (period, width) = deviations("tp-2")?;
    let smaller = if period.is_nan() || width.is_nan() { f64::NAN } else { period.min(width) };
    Ok(Measured::new(smaller, format!("period {period:.4}, width {width:.4}")))
}

/// Deviation of Eqs. (51) and (56) from the period and width series of an example with chi = 0.5, theta_o = 0.8, rho = 0.6.
fn deviations(example: &str) -> Result<(f64, f64), String> {
    let message = |e: twofold::Error| e.to_string();
    let (motion, beam, observer) = paper_signal(example).map_err(message)?;
    let train = pulse_train(&motion, &beam, &observer, SPAN).map_err(message)?;
    let (beta_0, chi, theta_o) = (0.7, 0.5, 0.8);
    let rates = shifted_rates(&spheroid(), &COEFFICIENTS, SPIN, beta_0).map_err(message)?;
    let offset_rate = |t: f64| azimuth_offset_rate(beta_0, rates.gamma * t, rates.gamma, chi, 0.0);
    let period = |t: f64| Ok(approximate_period(rates.alpha, offset_rate(t)?));
    let duration = |t: f64| {
        let theta = cosine_of_colatitude(beta_0, rates.gamma * t, chi, 0.0).acos();
        match pulse_width(beam.half_opening, theta, theta_o) {
            PulseWidth::Pulsed(width) => Ok(width / (rates.alpha + offset_rate(t)?)),
            // The formula gives no pulse where the star does: a pulse of no length.
            PulseWidth::AlwaysOn | PulseWidth::NeverOn => Ok(0.0),
        }
    };
    let periods = deviation(&train.periods().collect::<Vec<_>>(), period).map_err(message)?;
    let widths = deviation(&train.durations().collect::<Vec<_>>(), duration).map_err(message)?;
    Ok((periods, widths))
}

/// Root mean square of series minus formula, in units of that of the series from its mean.
fn deviation(series: &[Stamped], formula: impl Fn(f64) -> Result<f64, twofold::Error>) -> Result<f64, twofold::Error> {
    let mean = series.iter().map(|p| p.value).sum::<f64>() / series.len() as f64;
    let (mut missed, mut modulation) = (0.0, 0.0);
    for point in series {
        missed += (point.value - formula(point.time)?).powi(2);
        modulation += (point.value - mean).powi(2);
    }
    Ok((missed / modulation).sqrt())
}
