//! Where the approximate period and width follow the pulse train. Eqs. (51), (56) with (57).

use nalgebra::{DMatrix, DVector};
use twofold::observables::pulsar::direction::cosine_of_colatitude;
use twofold::observables::pulsar::period::{approximate_period, azimuth_offset_rate, instantaneous_period};
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{PulseTrain, Stamped, pulse_train};
use twofold::propagation::{ContinuousAngles, Motion};
use twofold::solutions::perturbation::{ShiftedRates, shifted_rates};

use super::cases::{Signal, paper_signal};
use crate::check::{Bound, Check, Kind, Measured, largest};
use crate::paper_examples::{COEFFICIENTS, SPIN, spheroid};

const SPAN: (f64, f64) = (0.0, 400.0);

/// `beta_0` of both examples.
const BETA_0: f64 = 0.7;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "pulse-series-fit-tp-1",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "with beta_0 and the mean rates of the motion, Eqs. (51) and (56) follow the period and width series of tp-I over 400 t_c",
            figure: "largest root mean square deviation / that of the series from its mean",
            bound: Bound::AtMost(0.5),
            reason: "'they fit very well' read as leaving less than half of the modulation; DeltaPhi' / alpha' reaches a third, so (51) has a tenth of P to err by",
            measure: fit_of_tp_1,
        },
        Check {
            id: "pulse-series-drift-tp-1",
            kind: Kind::Regime,
            equations: &[51, 52, 56, 57],
            statement: "with the shifted rates (57) they follow tp-I through one modulation of 40 t_c but not over 400 t_c, where gamma is a radian off",
            figure: "smallest deviation over 400 t_c / largest over 40 t_c",
            bound: Bound::AtLeast(2.0),
            reason: "the rate of gamma in (57) is off by 0.003 per t_c: 0.1 rad over one modulation, more than 1 rad over ten",
            measure: drift_of_tp_1,
        },
        Check {
            id: "pulse-series-fail-tp-2",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "they fail for tp-II, with the mean rates and with (57)",
            figure: "smallest root mean square deviation / that of the series from its mean",
            bound: Bound::AtLeast(1.0),
            reason: "'fail to approximate' read as no better than the mean of the series",
            measure: failure_of_tp_2,
        },
        Check {
            id: "pulse-series-not-of-gamma-tp-2",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "they fail for any choice of their constants: a function of gamma, as they are, leaves most of the series of tp-II, which have the \
                 slow period of the angular momentum as well, but little of those of tp-I",
            figure: "what the harmonics of gamma up to the sixth leave: least of tp-II / most of tp-I",
            bound: Bound::AtLeast(3.0),
            reason: "four fifths of the modulation of tp-II is most, a quarter of that of tp-I little",
            measure: functions_of_gamma,
        },
    ]
}

fn fit_of_tp_1() -> Result<Measured, String> {
    let [mean, _] = both_rates("tp-1", SPAN.1)?;
    Ok(Measured::new(largest(mean), format!("2 pi / (alpha' + DeltaPhi'), (51), (56): {mean:.3?}")))
}

fn drift_of_tp_1() -> Result<Measured, String> {
    let ([_, long], [_, short]) = (both_rates("tp-1", SPAN.1)?, both_rates("tp-1", 40.0)?);
    let detail = format!("2 pi / (alpha' + DeltaPhi'), (51), (56): {long:.3?} over 400 t_c, {short:.3?} over 40 t_c");
    Ok(Measured::new(smallest(long) / largest(short), detail))
}

fn failure_of_tp_2() -> Result<Measured, String> {
    let [fit, _] = both_rates("tp-1", SPAN.1)?;
    // Formulas with a slip in them would fit nothing: the misfit counts only of those that fit tp-I.
    let fits = largest(fit) < 0.5;
    if !fits {
        return Err(format!("the same formulas do not fit tp-I: {fit:.3?}"));
    }
    let [mean, shifted] = both_rates("tp-2", SPAN.1)?;
    let detail = format!(
        "2 pi / (alpha' + DeltaPhi'), (51), (56): {mean:.3?} with mean rates, {shifted:.3?} with (57); tp-I {fit:.3?}"
    );
    Ok(Measured::new(smallest([smallest(mean), smallest(shifted)]), detail))
}

fn functions_of_gamma() -> Result<Measured, String> {
    let (tp_1, tp_2) = (left_by_functions_of_gamma("tp-1")?, left_by_functions_of_gamma("tp-2")?);
    let detail = format!("left of the periods and widths of tp-I {tp_1:.3?}, of tp-II {tp_2:.3?}");
    Ok(Measured::new(smallest(tp_2) / largest(tp_1), detail))
}

/// What the best sum of harmonics of gamma up to the sixth leaves of the period and the width series, root mean square in
/// units of that of the series from its mean.
fn left_by_functions_of_gamma(example: &str) -> Result<[f64; 2], String> {
    let message = |e: twofold::Error| e.to_string();
    let Signal { motion, beam, observer } = paper_signal(example).map_err(message)?;
    let train = pulse_train(&motion, &beam, &observer, SPAN).map_err(message)?;
    let start = motion.state(0.0).and_then(|state| state.angles()).map_err(message)?;
    let mut angles = ContinuousAngles::new(&motion, 0.0, &start).map_err(message)?;
    let mut left = |series: Vec<Stamped>| -> Result<f64, String> {
        let mut functions = DMatrix::zeros(series.len(), 13);
        for (row, point) in series.iter().enumerate() {
            let gamma = angles.at(point.time).map_err(message)?.gamma;
            for (k, value) in functions.row_mut(row).iter_mut().enumerate() {
                let (sin, cos) = (k.div_ceil(2) as f64 * gamma).sin_cos();
                *value = if k % 2 == 0 { cos } else { sin };
            }
        }
        let values = DVector::from_iterator(series.len(), series.iter().map(|point| point.value));
        let amplitudes = functions.clone().svd(true, true).solve(&values, 1e-12)?;
        let modulation = values.add_scalar(-values.mean());
        Ok((functions * amplitudes - values).norm() / modulation.norm())
    };
    Ok([left(train.periods().collect())?, left(train.durations().collect())?])
}

/// The smallest of some figures; NaN if one is NaN.
fn smallest(figures: impl IntoIterator<Item = f64>) -> f64 {
    1.0 / largest(figures.into_iter().map(|x| 1.0 / x))
}

/// Deviations up to the time `end` with the mean rates of the whole motion, and with the shifted rates (57).
fn both_rates(example: &str, end: f64) -> Result<[[f64; 3]; 2], String> {
    let message = |e: twofold::Error| e.to_string();
    let Signal { motion, beam, observer } = paper_signal(example).map_err(message)?;
    let train = pulse_train(&motion, &beam, &observer, (0.0, end)).map_err(message)?;
    let start = motion.state(0.0).and_then(|state| state.angles()).map_err(message)?;
    let last = ContinuousAngles::new(&motion, 0.0, &start).and_then(|mut angles| angles.at(SPAN.1)).map_err(message)?;
    let mean = ShiftedRates { alpha: (last.alpha - start.alpha) / SPAN.1, gamma: (last.gamma - start.gamma) / SPAN.1 };
    let shifted = shifted_rates(&spheroid(), &COEFFICIENTS, SPIN, BETA_0).map_err(message)?;
    let of = |rates| deviations(&train, beam.half_opening, rates).map_err(message);
    Ok([of(mean)?, of(shifted)?])
}

/// Deviations from the period series of `2 pi / (alpha' + DeltaPhi')` and its first order, Eq. (51), and from the width
/// series of Eq. (56), with chi = 0.5, theta_o = 0.8.
fn deviations(train: &PulseTrain, rho: f64, rates: ShiftedRates<f64>) -> Result<[f64; 3], twofold::Error> {
    let (chi, theta_o) = (0.5, 0.8);
    let offset_rate = |t: f64| azimuth_offset_rate(BETA_0, rates.gamma * t, rates.gamma, chi, 0.0);
    let exact_period = |t: f64| Ok(instantaneous_period(rates.alpha + offset_rate(t)?));
    let period = |t: f64| Ok(approximate_period(rates.alpha, offset_rate(t)?));
    let duration = |t: f64| {
        let theta = cosine_of_colatitude(BETA_0, rates.gamma * t, chi, 0.0).acos();
        match pulse_width(rho, theta, theta_o) {
            PulseWidth::Pulsed(width) => Ok(width / (rates.alpha + offset_rate(t)?)),
            // The formula gives no pulse where the star does: a pulse of no length.
            PulseWidth::AlwaysOn | PulseWidth::NeverOn => Ok(0.0),
        }
    };
    let (periods, widths): (Vec<_>, Vec<_>) = (train.periods().collect(), train.durations().collect());
    Ok([deviation(&periods, exact_period)?, deviation(&periods, period)?, deviation(&widths, duration)?])
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
