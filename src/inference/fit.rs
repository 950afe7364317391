//! Weighted least squares: the unknowns that data are most likely of, by Levenberg and Marquardt's method with exact derivatives.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPSide, MPSuccess};

use super::{Datum, Event, Fisher, InferenceError, Model, Observable, Place, Signal, Unknown, jacobian};

/// What a fit found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The model at the minimum.
    pub model: Model<f64>,
    /// The unknowns.
    pub unknowns: Vec<Unknown>,
    /// Their values.
    pub values: Vec<f64>,
    /// Their covariance: `(J^T J)^-1` with the exact Jacobian at the minimum.
    pub covariance: DMatrix<f64>,
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

    /// Standard deviations of the unknowns.
    pub fn sigmas(&self) -> Vec<f64> {
        self.covariance.diagonal().iter().map(|variance| variance.sqrt()).collect()
    }

    /// [`nonlinearity`] at the minimum.
    ///
    /// # Errors
    /// A model beside it that has no such data.
    pub fn nonlinearity(&self, data: &[Datum], end: f64) -> Result<f64, InferenceError> {
        nonlinearity(&self.model, &self.unknowns, &self.covariance, data, end)
    }
}

/// How far `chi^2` is from the parabola that error bars stand for: the largest of `|chi^2 - chi^2_min - 1|` one standard deviation
/// up and down each principal axis of the correlations. Well below one, the
/// bars hold. It takes two motions for each unknown.
///
/// # Errors
/// A model there that has no such data.
pub fn nonlinearity(
    model: &Model<f64>,
    unknowns: &[Unknown],
    covariance: &DMatrix<f64>,
    data: &[Datum],
    end: f64,
) -> Result<f64, InferenceError> {
    let chi_squared = |model: &Model<f64>| {
        residuals(model, data, end).map(|found| found.iter().map(|residual| residual * residual).sum::<f64>())
    };
    let least = chi_squared(model)?;
    let scale = covariance.diagonal().map(f64::sqrt);
    let correlation = DMatrix::from_fn(scale.len(), scale.len(), |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
    let axes = correlation.symmetric_eigen();
    let mut worst: f64 = 0.0;
    for (value, axis) in axes.eigenvalues.iter().zip(axes.eigenvectors.column_iter()) {
        for sign in [1.0, -1.0] {
            let change = axis.component_mul(&scale) * (sign * value.max(0.0).sqrt());
            worst = worst.max((chi_squared(&model.moved(unknowns, change.as_slice()))? - least - 1.0).abs());
        }
    }
    Ok(worst)
}

/// The pulses of a signal with turns counted as the data count them: the pulse nearest to the first datum of one has its turn.
fn events_as_counted(signal: &Signal, data: &[Datum]) -> Result<Vec<Event>, InferenceError> {
    let of_pulses = data.iter().filter_map(|datum| match datum.place {
        Place::Turn { number, near } => Some((number, near)),
        Place::Time(_) => None,
    });
    let Some((number, near)) = of_pulses.min_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(Vec::new()) };
    let mut events = signal.events()?;
    let distance = |event: &&Event| (event.midpoint() - near).abs();
    let nearest = events.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let shift = number - nearest.ok_or(InferenceError::NoPulse { turn: number, near })?.turn;
    events.iter_mut().for_each(|event| event.turn += shift);
    Ok(events)
}

/// The data that a model has, less those measured, in standard deviations; and its pulses.
fn compared(model: &Model<f64>, data: &[Datum], end: f64) -> Result<(Vec<f64>, Vec<Event>), InferenceError> {
    let signal = Signal::new(model, end + 2.0 * turn(model))?;
    let events = if signal.is_long() {
        let turns = data.iter().filter_map(|datum| match datum.place {
            Place::Turn { number, near } => Some((number, near)),
            Place::Time(_) => None,
        });
        signal.events_of_turns(&turns.collect::<BTreeMap<_, _>>().into_iter().collect::<Vec<_>>())?
    } else {
        events_as_counted(&signal, data)?
    };
    let find = |turn: i64| events.binary_search_by_key(&turn, |event| event.turn).ok().map(|place| events[place]);
    let compare = |datum: &Datum| {
        let value = match datum.place {
            Place::Time(t) => signal.strain(datum.observable, t)?,
            Place::Turn { number, near } => {
                let event = find(number).and_then(|event| event.value(find(number - 1).as_ref(), datum.observable));
                let value = event.ok_or(InferenceError::NoPulse { turn: number, near })?;
                let is_time = matches!(datum.observable, Observable::Arrivals | Observable::ClosestApproaches);
                let epoch = find(number).map_or(0.0, |event| event.epoch);
                if is_time { (epoch - datum.epoch) + value } else { value }
            }
        };
        Ok((value - datum.value) / datum.sigma)
    };
    Ok((data.iter().map(compare).collect::<Result<_, InferenceError>>()?, events))
}

fn residuals(model: &Model<f64>, data: &[Datum], end: f64) -> Result<Vec<f64>, InferenceError> {
    compared(model, data, end).map(|(residuals, _)| residuals)
}

fn turn(model: &Model<f64>) -> f64 {
    std::f64::consts::TAU / model.start().state().momentum.norm()
}

/// The fit of `unknowns` to `data` from a start, over the time to `end`.
///
/// The unknowns move in units of their standard deviations at the start. A trial step to a model without the pulses of the data is
/// rejected. The minimum is the one that the start leads to: its pulses must be those of the data to less than half a turn at the first
/// datum, and its phase well known over the whole span.
///
/// # Errors
/// [`InferenceError::Degenerate`] for data that do not determine the unknowns, at the start or at the minimum; for others see
/// [`InferenceError`].
pub fn fit(start: &Model<f64>, data: &[Datum], unknowns: &[Unknown], end: f64) -> Result<Fit, InferenceError> {
    if data.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: data.len(), unknowns: unknowns.len() });
    }
    let (_, events) = compared(start, data, end)?;
    let scales = determined(start, data, unknowns, &events)?.sigmas();
    let mut problem = Problem { start, data, unknowns, end, scales: &scales, bounds: bounds(start, unknowns, &scales) };
    let mut at = vec![0.0; unknowns.len()];
    let ended = problem.mpfit(&mut at).map_err(|error| InferenceError::NotConverged {
        why: match error {
            MPError::Nan => "a derivative is not finite",
            MPError::InitBounds => "the start is outside the limits",
            _ => "the start could not be computed",
        },
        cosine: f64::NAN,
    })?;
    let model = problem.model(&at);
    let (residuals, events) = compared(&model, data, end)?;
    let weighted = jacobian(&model, &events, data, unknowns)?.weighted(data);
    let chi_squared: f64 = residuals.iter().map(|residual| residual * residual).sum();
    let gradient = weighted.matrix.transpose() * DVector::from_column_slice(&residuals);
    let cosine = weighted
        .matrix
        .column_iter()
        .zip(&gradient)
        .fold(0.0, |most: f64, (column, product)| most.max((product / (column.norm() * chi_squared.sqrt())).abs()));
    let fisher = Fisher::of_jacobian(&weighted, unknowns, &model);
    if !fisher.degenerate.is_empty() || !fisher.weak.is_empty() {
        return Err(InferenceError::Degenerate([fisher.degenerate, fisher.weak].concat()));
    }
    for (unknown, value) in unknowns.iter().zip(model.values(unknowns)) {
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
        values: model.values(unknowns),
        model,
        unknowns: unknowns.to_vec(),
        covariance: fisher.covariance,
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
    let signal = Signal::new(&fit.model, end)?;
    let of_kinds: BTreeMap<Observable, f64> =
        data.iter().map(|datum| datum.observable).map(|kind| (kind, signal.rounding(kind))).collect();
    let rounding = |datum: &Datum| of_kinds.get(&datum.observable).copied().unwrap_or(0.0);
    if data.iter().zip(&fit.residuals).any(|(datum, residual)| residual.abs() * datum.sigma > rounding(datum)) {
        return Ok(None);
    }
    let finest = data.iter().max_by(|a, b| (rounding(a) / a.sigma).total_cmp(&(rounding(b) / b.sigma)));
    Ok(finest.map(|datum| (datum.observable, rounding(datum))))
}

/// The Fisher matrix of data that determine all unknowns.
fn determined(
    model: &Model<f64>,
    data: &[Datum],
    unknowns: &[Unknown],
    events: &[Event],
) -> Result<Fisher, InferenceError> {
    let fisher = Fisher::of(model, events, data, unknowns)?;
    if fisher.degenerate.is_empty() && fisher.weak.is_empty() {
        Ok(fisher)
    } else {
        Err(InferenceError::Degenerate([fisher.degenerate, fisher.weak].concat()))
    }
}

/// The limits of the unknowns, in standard deviations from the start.
fn bounds(start: &Model<f64>, unknowns: &[Unknown], scales: &[f64]) -> Vec<MPPar> {
    let bound = |(unknown, scale): (&Unknown, &f64)| {
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

struct Problem<'a> {
    start: &'a Model<f64>,
    data: &'a [Datum],
    unknowns: &'a [Unknown],
    end: f64,
    scales: &'a [f64],
    bounds: Vec<MPPar>,
}

impl Problem<'_> {
    fn model(&self, at: &[f64]) -> Model<f64> {
        let changes: Vec<f64> = at.iter().zip(self.scales).map(|(at, scale)| at * scale).collect();
        self.start.moved(self.unknowns, &changes)
    }
}

impl MPFitter for Problem<'_> {
    fn eval(&mut self, params: &[f64], deviates: &mut [f64]) -> Result<(), MPError> {
        /// Residual of data that a trial model lacks: more than any that a start with the pulses of the data can have.
        const LACKING: f64 = 1e12;
        match residuals(&self.model(params), self.data, self.end) {
            Ok(residuals) => deviates.copy_from_slice(&residuals),
            Err(_) => deviates.fill(LACKING),
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.data.len()
    }

    fn config(&self) -> &MPConfig {
        // Numbers count standard deviations: steps below 1e-6 of one, and changes of chi^2 by 1e-12 of it, are of no account.
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
        let model = self.model(params);
        let (residuals, events) = compared(&model, self.data, self.end).map_err(|_| MPError::Eval)?;
        deviates.copy_from_slice(&residuals);
        let found = jacobian(&model, &events, self.data, self.unknowns).map_err(|_| MPError::Eval)?;
        let weighted = found.weighted(self.data).matrix;
        for ((column, wanted), scale) in weighted.column_iter().zip(derivs).zip(self.scales) {
            if let Some(wanted) = wanted {
                wanted.iter_mut().zip(&column).for_each(|(place, derivative)| *place = derivative * scale);
            }
        }
        Ok(())
    }
}
