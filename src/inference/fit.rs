//! Weighted least squares: the unknowns that data are most likely of, by Levenberg and Marquardt's method with exact derivatives.

use std::collections::BTreeMap;

use nalgebra::DVector;
use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPSide, MPSuccess};

use super::signal::turning_rate;
use super::{Datum, Event, Fisher, InferenceError, Observable, Place, Signal, jacobian};
use crate::parameters::{Parameter, Parameters};

/// What a fit found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The parameters at the minimum, and the uncertainties of those fitted: `(J^T J)^-1` with the exact Jacobian there.
    pub fisher: Fisher,
    /// `sum (residual / sigma)^2`.
    pub chi_squared: f64,
    /// Data less unknowns.
    pub degrees: usize,
    /// Measured less fitted, in standard deviations, in the order of the data.
    pub residuals: Vec<f64>,
    /// Steps of the fit.
    pub iterations: usize,
    /// Largest cosine of the angle between residuals and the derivative by an unknown: zero at the minimum.
    pub cosine: f64,
}

/// Whether residuals are such as errors of the sizes stated give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Residuals {
    /// They are.
    AsStated,
    /// They are larger.
    Larger,
    /// They are smaller.
    Smaller,
}

impl Fit {
    /// Root mean square of the residuals, in standard deviations, each unknown counted as one datum less.
    pub fn root_mean_square(&self) -> f64 {
        (self.chi_squared / self.degrees as f64).sqrt()
    }

    /// Judges `chi^2` at six standard deviations. `(chi^2 / n)^(1/3)` of `n` degrees of freedom is nearly normal, of mean `1 - 2 / (9 n)` and
    /// variance `2 / (9 n)` (E. B. Wilson and M. M. Hilferty, Proc. Nat. Acad. Sci. 17, 684 (1931)).
    pub fn judged(&self) -> Residuals {
        let variance = 2.0 / (9.0 * self.degrees as f64);
        let score = ((self.chi_squared / self.degrees as f64).cbrt() - (1.0 - variance)) / variance.sqrt();
        match score {
            6.0.. => Residuals::Larger,
            ..=-6.0 => Residuals::Smaller,
            _ => Residuals::AsStated,
        }
    }
}

/// How far `chi^2` is from the parabola that error bars stand for: the largest of `|chi^2 - chi^2_min - 1|` one standard deviation
/// up and down each principal axis of the correlations. Where it is well below one, the error bars hold. It takes two motions for each unknown.
///
/// # Errors
/// Parameters there of a star that has no such data.
pub fn nonlinearity(fisher: &Fisher, data: &[Datum], end: f64) -> Result<f64, InferenceError> {
    let chi_squared = |parameters: &Parameters<f64>| compared(parameters, data, end).map(|found| squares(&found.0));
    let least = chi_squared(&fisher.parameters)?;
    let mut worst: f64 = 0.0;
    let count = fisher.unknowns.len();
    for axis in 0..count {
        let one = DVector::from_fn(count, |k, _| if k == axis { 1.0 } else { 0.0 });
        for sign in [1.0, -1.0] {
            worst = worst.max((chi_squared(&fisher.beside(&one, sign))? - least - 1.0).abs());
        }
    }
    Ok(worst)
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// The pulses of a signal that belong to turns of data, each turn with the time near which its pulse was seen. Turns are counted as the data
/// count them: the pulse nearest to the first of them has its turn.
fn events_as_counted(signal: &Signal, turns: &BTreeMap<i64, f64>) -> Result<Vec<Event>, InferenceError> {
    let Some((&turn, &near)) = turns.iter().min_by(|a, b| a.1.total_cmp(b.1)) else { return Ok(Vec::new()) };
    let mut events = signal.events()?;
    let distance = |event: &&Event| (event.midpoint() - near).abs();
    let nearest = events.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let shift = turn - nearest.ok_or(InferenceError::NoPulse { turn, near })?.turn;
    events.iter_mut().for_each(|event| event.turn += shift);
    Ok(events)
}

/// The data that a star has, less those measured, in standard deviations; and its pulses.
fn compared(parameters: &Parameters<f64>, data: &[Datum], end: f64) -> Result<(Vec<f64>, Vec<Event>), InferenceError> {
    let turn = std::f64::consts::TAU / turning_rate(parameters);
    let signal = Signal::new(parameters, end + 2.0 * turn)?;
    let of_pulses = data.iter().filter_map(|datum| match datum.place {
        Place::Turn { number, near } => Some((number, near)),
        Place::Time(_) => None,
    });
    let turns: BTreeMap<i64, f64> = of_pulses.collect();
    let events = if signal.is_long {
        signal.events_of_turns(&turns.into_iter().collect::<Vec<_>>())?
    } else {
        events_as_counted(&signal, &turns)?
    };
    let find = |turn: i64| events.binary_search_by_key(&turn, |event| event.turn).ok().map(|place| events[place]);
    let compare = |datum: &Datum| {
        let value = match datum.place {
            Place::Time(t) => signal.strain(datum.observable, t)?,
            Place::Turn { number, near } => {
                let event = find(number);
                let value = event.and_then(|event| event.value(find(number - 1).as_ref(), datum.observable));
                let value = value.ok_or(InferenceError::NoPulse { turn: number, near })?;
                let is_time = matches!(datum.observable, Observable::Arrivals | Observable::ClosestApproaches);
                let epoch = event.map_or(0.0, |event| event.epoch);
                if is_time { (epoch - datum.epoch) + value } else { value }
            }
        };
        Ok((value - datum.value) / datum.sigma)
    };
    Ok((data.iter().map(compare).collect::<Result<_, InferenceError>>()?, events))
}

/// The fit of `unknowns` to `data` from a start, over the time to `end`.
///
/// The unknowns move in units of their standard deviations at the start. A trial step to a star without the pulses of the data is
/// rejected. The minimum is the one that the start leads to: its pulses must be those of the data to less than half a turn at the first
/// datum, and its phase well known over the whole span.
///
/// # Errors
/// [`InferenceError::Degenerate`] for data that do not determine the unknowns, at the start or at the minimum; for others see
/// [`InferenceError`].
pub fn fit(start: &Parameters<f64>, data: &[Datum], unknowns: &[Parameter], end: f64) -> Result<Fit, InferenceError> {
    if data.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: data.len(), unknowns: unknowns.len() });
    }
    let (_, events) = compared(start, data, end)?;
    let scales = Fisher::of(start, &events, data, unknowns)?.determined()?.sigmas();
    let bounds = bounds(start, unknowns, &scales);
    let mut search = Search { start, data, unknowns, end, scales: &scales, bounds };
    let mut at = vec![0.0; unknowns.len()];
    let ended = search.mpfit(&mut at).map_err(|error| InferenceError::NotConverged {
        why: match error {
            MPError::Nan => "a derivative is not finite",
            MPError::InitBounds => "the start is outside the limits",
            _ => "the start could not be computed",
        },
        cosine: f64::NAN,
    })?;
    let parameters = search.parameters_at(&at);
    let (residuals, events) = compared(&parameters, data, end)?;
    let weighted = jacobian(&parameters, &events, data, unknowns)?.weighted(data);
    let chi_squared = squares(&residuals);
    let gradient = weighted.matrix.transpose() * DVector::from_column_slice(&residuals);
    let cosine = weighted
        .matrix
        .column_iter()
        .zip(&gradient)
        .fold(0.0, |most: f64, (column, product)| most.max((product / (column.norm() * chi_squared.sqrt())).abs()));
    let fisher = Fisher::of_jacobian(&weighted, unknowns, &parameters).determined()?;
    for (unknown, value) in unknowns.iter().zip(fisher.values()) {
        let (low, high) = unknown.limits();
        if low == Some(value) || high == Some(value) {
            return Err(InferenceError::OnLimit { unknown: unknown.symbol(), value });
        }
    }
    // What is left of the gradient moves no unknown by more than a hundredth of its error.
    let step = &fisher.covariance * &gradient;
    let left = step.iter().zip(fisher.sigmas()).fold(0.0, |most: f64, (step, sigma)| most.max((step / sigma).abs()));
    let is_off = ended.success == MPSuccess::MaxIter || left.is_nan() || left > 1e-2;
    let found = Fit {
        fisher,
        chi_squared,
        degrees: data.len() - unknowns.len(),
        residuals: residuals.iter().map(|residual| -residual).collect(),
        iterations: ended.n_iter,
        cosine,
    };
    if (is_off || found.judged() == Residuals::Larger)
        && let Some((observable, rounding)) = rounding_of_all(&found, data, end)?
    {
        return Err(InferenceError::Rounding { observable, rounding });
    }
    if is_off {
        return Err(InferenceError::NotConverged {
            why: if ended.success == MPSuccess::MaxIter { "too many steps" } else { "no step makes chi^2 less" },
            cosine,
        });
    }
    Ok(found)
}

/// If every residual is as small as the rounding of the model: the kind of data with the smallest errors against it, and that rounding.
fn rounding_of_all(fit: &Fit, data: &[Datum], end: f64) -> Result<Option<(Observable, f64)>, InferenceError> {
    let signal = Signal::new(&fit.fisher.parameters, end)?;
    let of_kinds: BTreeMap<Observable, f64> =
        data.iter().map(|datum| datum.observable).map(|kind| (kind, signal.rounding(kind))).collect();
    let rounding = |datum: &Datum| of_kinds[&datum.observable];
    if data.iter().zip(&fit.residuals).any(|(datum, residual)| residual.abs() * datum.sigma > rounding(datum)) {
        return Ok(None);
    }
    let finest = data.iter().max_by(|a, b| (rounding(a) / a.sigma).total_cmp(&(rounding(b) / b.sigma)));
    Ok(finest.map(|datum| (datum.observable, rounding(datum))))
}

/// The limits of the unknowns, in standard deviations from the start.
fn bounds(start: &Parameters<f64>, unknowns: &[Parameter], scales: &[f64]) -> Vec<MPPar> {
    let bound = |(unknown, scale): (&Parameter, &f64)| {
        let ((low, high), value) = (unknown.limits(), unknown.value(start));
        MPPar {
            limited_low: low.is_some(),
            limit_low: low.map_or(0.0, |low| (low - value) / scale),
            limited_up: high.is_some(),
            limit_up: high.map_or(0.0, |high| (high - value) / scale),
            side: MPSide::User,
            ..MPPar::new()
        }
    };
    unknowns.iter().zip(scales).map(bound).collect()
}

/// The search for the minimum, with numbers that count standard deviations from the start.
struct Search<'a> {
    start: &'a Parameters<f64>,
    data: &'a [Datum],
    unknowns: &'a [Parameter],
    end: f64,
    scales: &'a [f64],
    bounds: Vec<MPPar>,
}

impl Search<'_> {
    fn parameters_at(&self, at: &[f64]) -> Parameters<f64> {
        let changes: Vec<f64> = at.iter().zip(self.scales).map(|(at, scale)| at * scale).collect();
        self.start.moved(self.unknowns, &changes)
    }
}

impl MPFitter for Search<'_> {
    fn eval(&mut self, params: &[f64], deviates: &mut [f64]) -> Result<(), MPError> {
        /// Residual of data that a trial star lacks: more than any that a start with the pulses of the data can have.
        const LACKING: f64 = 1e12;
        match compared(&self.parameters_at(params), self.data, self.end) {
            Ok((residuals, _)) => deviates.copy_from_slice(&residuals),
            Err(_) => deviates.fill(LACKING),
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.data.len()
    }

    fn config(&self) -> &MPConfig {
        // Steps below 1e-6 of a standard deviation, and changes of chi^2 by 1e-12 of it, are of no account.
        static CONFIG: MPConfig = MPConfig { ftol: 1e-12, xtol: 1e-9, gtol: 1e-9, max_iter: 50, ..MPConfig::new() };
        &CONFIG
    }

    fn parameters(&self) -> &[MPPar] {
        &self.bounds
    }

    fn jacobian(
        &mut self,
        params: &[f64],
        deviates: &mut [f64],
        derivs: &mut [Option<Vec<f64>>],
    ) -> Result<(), MPError> {
        let parameters = self.parameters_at(params);
        let (residuals, events) = compared(&parameters, self.data, self.end).map_err(|_| MPError::Eval)?;
        deviates.copy_from_slice(&residuals);
        let found = jacobian(&parameters, &events, self.data, self.unknowns).map_err(|_| MPError::Eval)?;
        let weighted = found.weighted(self.data).matrix;
        for ((column, wanted), scale) in weighted.column_iter().zip(derivs).zip(self.scales) {
            if let Some(wanted) = wanted {
                wanted.iter_mut().zip(&column).for_each(|(place, derivative)| *place = derivative * scale);
            }
        }
        Ok(())
    }
}
