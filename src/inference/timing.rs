//! The fit of a [`TimingModel`] to arrival times and pulse widths over decades.

use nalgebra::DMatrix;

use super::least_squares::{self, Comparison, Fit, least_squares};
use super::{Fisher, InferenceError, Jacobian};
use crate::error::Error;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter, check_turns};

/// The arrival of a pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredArrival {
    /// When (s since the epoch of the model), the unevaluated sum of two doubles.
    pub time: [f64; 2],
    /// Its standard deviation (s).
    pub sigma: f64,
    /// Number of the pulse, counted from any one, if it is known; else the turn is the one nearest in the model at the start of the fit.
    pub number: Option<i64>,
}

/// The width of a pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredWidth {
    /// When (s since the epoch of the model).
    pub time: f64,
    /// Time from edge to edge (s).
    pub duration: f64,
    /// Its standard deviation (s).
    pub sigma: f64,
}

/// What is known of a parameter beforehand: a normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// The parameter.
    pub parameter: TimingParameter,
    /// Its mean.
    pub mean: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

/// Measurements of the pulses of a star, with independent errors, and what is known of it beforehand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TimingData {
    /// MeasuredArrival times.
    pub arrivals: Vec<MeasuredArrival>,
    /// Widths.
    pub widths: Vec<MeasuredWidth>,
    /// What is known beforehand. A parameter that is no unknown has none.
    pub priors: Vec<Prior>,
}

/// Relative error of the derivatives of a timing model: some hundred roundings.
const DERIVATIVES: f64 = 1e-13;

/// Largest derivative and residual in standard deviations: sums of their squares are doubles.
const LARGEST: f64 = 1e150;

/// Rounding of the residual of an arrival time (turns): of the geometry, of the lateness and of the fraction of a turn.
const ROUNDING: f64 = 1e-14;

impl TimingData {
    /// The data with every pulse numbered as the model counts: the first arrival that has a number belongs to the turn nearest in the model, and one without a
    /// number to the turn nearest to it.
    ///
    /// # Errors
    /// [`Error::Domain`] for numbers above 9e15 in size; as for [`TimingModel::phase`].
    pub fn numbered(&self, model: &TimingModel) -> Result<Self, Error> {
        let mut shift = None;
        let mut data = self.clone();
        for arrival in &mut data.arrivals {
            let nearest = model.phase(arrival.time)?.whole;
            arrival.number = Some(match arrival.number {
                None => nearest,
                Some(number) => {
                    check_turns(number as f64)?;
                    number + *shift.get_or_insert(nearest - number)
                }
            });
        }
        Ok(data)
    }

    fn check(&self) -> Result<(), Error> {
        let of_arrivals = self.arrivals.iter().map(|arrival| arrival.sigma);
        let sigmas = of_arrivals.chain(self.widths.iter().map(|width| width.sigma));
        for sigma in sigmas.chain(self.priors.iter().map(|prior| prior.sigma)) {
            Error::ensure(sigma > 0.0 && sigma.is_finite(), "standard deviation", sigma, "a finite number above zero")?;
        }
        Ok(())
    }
}

impl Comparison<TimingModel> for TimingData {
    fn len(&self) -> usize {
        self.arrivals.len() + self.widths.len() + self.priors.len()
    }

    fn residuals(&self, model: &TimingModel) -> Result<Vec<f64>, InferenceError> {
        let mut residuals = Vec::with_capacity(self.len());
        let frequency = model.value(TimingParameter::F0);
        for arrival in &self.arrivals {
            let phase = model.phase(arrival.time)?;
            let turns = (phase.whole - arrival.number.unwrap_or(phase.whole)) as f64 + phase.fraction;
            // A pulse that is late has gone past its turn.
            residuals.push(-turns / frequency / arrival.sigma);
        }
        for width in &self.widths {
            residuals.push((model.width(width.time)? - width.duration) / width.sigma);
        }
        for prior in &self.priors {
            residuals.push((model.value(prior.parameter) - prior.mean) / prior.sigma);
        }
        Ok(residuals)
    }

    fn linearised(
        &self,
        model: &TimingModel,
        unknowns: &[TimingParameter],
    ) -> Result<(Vec<f64>, Jacobian), InferenceError> {
        let frequency = model.value(TimingParameter::F0);
        let mut matrix = DMatrix::zeros(self.len(), unknowns.len());
        let mut fill = |row: usize, of: &dyn Fn(TimingParameter) -> f64| {
            unknowns.iter().enumerate().for_each(|(column, unknown)| matrix[(row, column)] = of(*unknown));
        };
        let (arrivals, widths) = (self.arrivals.len(), self.widths.len());
        for (row, arrival) in self.arrivals.iter().enumerate() {
            let (_, derivatives) = model.phase_and_derivatives(arrival.time)?;
            fill(row, &|unknown| -derivatives[unknown as usize] / frequency / arrival.sigma);
        }
        for (row, width) in self.widths.iter().enumerate() {
            let (_, derivatives) = model.width_and_derivatives(width.time)?;
            fill(arrivals + row, &|unknown| derivatives[unknown as usize] / width.sigma);
        }
        for (row, prior) in self.priors.iter().enumerate() {
            fill(arrivals + widths + row, &|unknown| if unknown == prior.parameter { 1.0 / prior.sigma } else { 0.0 });
        }
        let residuals = self.residuals(model)?;
        for value in matrix.iter().chain(&residuals) {
            let what = "derivative or residual of a datum, in its standard deviations";
            Error::ensure(value.abs() <= LARGEST, what, *value, "a number up to 1e150 in size")?;
        }
        let magnitudes = matrix.abs();
        Ok((residuals, Jacobian { matrix, magnitudes, relative_error: DERIVATIVES }))
    }

    fn rounding(&self, found: &Fit<TimingModel>) -> Result<Option<InferenceError>, InferenceError> {
        let rounding = ROUNDING / found.fisher.parameters.value(TimingParameter::F0);
        let is_rounding = |(arrival, residual): (&MeasuredArrival, &f64)| residual.abs() * arrival.sigma <= rounding;
        let all = self.widths.is_empty() && self.arrivals.iter().zip(&found.residuals).all(is_rounding);
        Ok(all.then_some(InferenceError::NotConverged { why: "the residuals are rounding", cosine: found.cosine }))
    }
}

/// The fit of a timing model from a start whose pulses are those of the data to less than half a turn at the first datum, and whose phase is well known over the whole span.
/// F0 moves in 32 digits, so that it is right however many turns there are.
///
/// # Errors
/// As for [`fit`](super::fit).
///
/// ```
/// use twofold::inference::{MeasuredArrival, Model, TimingData, fit_timing};
/// use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter::*};
///
/// // Of a star of 300 Hz 20 arrivals to 1 microsecond over 20 years, each 0.1 ms late.
/// let star = TimingModel::new([300.0, 1e-15], &[(F1, -1e-15)])?;
/// let arrival = |k: i64| {
///     let [time, rest] = star.arrival(10_000_000_000 * k)?;
///     Ok(MeasuredArrival { time: [time, rest + 1e-4], sigma: 1e-6, number: Some(k * 10_000_000_000) })
/// };
/// let arrivals = (-10..10).map(arrival).collect::<Result<_, twofold::Error>>()?;
/// let data = TimingData { arrivals, ..TimingData::default() };
/// let start = TimingModel::new([300.0, 0.0], &[(F1, -1.0001e-15)])?;
/// let found = fit_timing(&start, &data, &[Phase, F0, F1])?;
/// let (model, sigmas) = (&found.fisher.parameters, found.fisher.sigmas());
/// assert!((model.value(Phase) + 0.03).abs() < 0.01 * sigmas[0]);
/// assert!(sigmas[1] < 1e-12 && model.difference(&star, F0).abs() < 0.01 * sigmas[1]);
/// # Ok::<(), twofold::inference::InferenceError>(())
/// ```
pub fn fit_timing(
    start: &TimingModel,
    data: &TimingData,
    unknowns: &[TimingParameter],
) -> Result<Fit<TimingModel>, InferenceError> {
    data.check()?;
    least_squares(start, &data.numbered(start)?, unknowns)
}

/// What timing data tell of unknowns, at a model: uncertainties and correlations.
///
/// # Errors
/// As for [`Fisher::of`].
pub fn timing_fisher(
    model: &TimingModel,
    data: &TimingData,
    unknowns: &[TimingParameter],
) -> Result<Fisher<TimingModel>, InferenceError> {
    data.check()?;
    if data.len() < unknowns.len() {
        return Err(InferenceError::TooFew { data: data.len(), unknowns: unknowns.len() });
    }
    Ok(Fisher::of_jacobian(&data.numbered(model)?.linearised(model, unknowns)?.1, unknowns, model))
}

/// How far `chi^2` of a fit is from the parabola that its error bars stand for, as [`nonlinearity`](super::nonlinearity) says it.
///
/// # Errors
/// A model a standard deviation away that cannot be.
pub fn timing_nonlinearity(fisher: &Fisher<TimingModel>, data: &TimingData) -> Result<f64, InferenceError> {
    least_squares::nonlinearity(fisher, &data.numbered(&fisher.parameters)?)
}
