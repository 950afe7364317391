//! The fit of a [`TimingModel`] to arrival times and pulse widths over decades.

use nalgebra::{DMatrix, DVector};

use super::least_squares::{self, Comparison, Fit, least_squares};
use super::{Fisher, InferenceError, Jacobian};
use crate::error::Error;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter, check_turns};
use crate::solutions::averaged::Turns;

/// The arrival of a pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredArrival {
    /// Time of arrival (s since the epoch of the model), the unevaluated sum of two doubles.
    pub time: [f64; 2],
    /// Its standard deviation (s).
    pub sigma: f64,
    /// Number of the pulse, counted from an arbitrary origin, if it is known; otherwise the nearest turn of the model at the start of
    /// the fit is used.
    pub number: Option<i64>,
}

impl MeasuredArrival {
    /// The residual in standard deviations, from the phase and its rate at the time of arrival. For a pulse that arrives late the phase is then already above
    /// the number of the pulse.
    fn residual(&self, phase: &Turns, rate: f64) -> f64 {
        let turns = (phase.whole - self.number.unwrap_or(phase.whole)) as f64 + phase.fraction;
        -turns / rate / self.sigma
    }
}

/// The width of a pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredWidth {
    /// Time of the pulse (s since the epoch of the model).
    pub time: f64,
    /// Time from edge to edge (s).
    pub duration: f64,
    /// Its standard deviation (s).
    pub sigma: f64,
}

impl MeasuredWidth {
    fn residual(&self, duration: f64) -> f64 {
        (duration - self.duration) / self.sigma
    }
}

/// Prior for a parameter: a normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// The parameter.
    pub parameter: TimingParameter,
    /// Mean of the distribution.
    pub mean: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

impl Prior {
    fn residual(&self, model: &TimingModel) -> f64 {
        (model.value(self.parameter) - self.mean) / self.sigma
    }
}

/// Measurements of the pulses of a star, with independent errors, and priors.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TimingData {
    /// Arrival times.
    pub arrivals: Vec<MeasuredArrival>,
    /// Widths.
    pub widths: Vec<MeasuredWidth>,
    /// Priors, which are meant for unknowns only.
    pub priors: Vec<Prior>,
}

/// Relative error of the derivatives of a timing model: some hundred roundings.
const DERIVATIVES: f64 = 1e-13;

/// Largest derivative and residual in standard deviations: sums of their squares remain finite doubles.
const LARGEST: f64 = 1e150;

/// Rounding of the residual of an arrival time (turns): of the geometry, of the timing delay and of the fraction of a turn.
const ROUNDING: f64 = 1e-14;

impl TimingData {
    /// The data with every pulse numbered as in the model: the first numbered arrival is assigned to the nearest turn of the model, which fixes the
    /// offset; an arrival without a number is assigned to the turn nearest to it.
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
        for arrival in &self.arrivals {
            residuals.push(arrival.residual(&model.phase(arrival.time)?, model.phase_rate(arrival.time)?));
        }
        for width in &self.widths {
            residuals.push(width.residual(model.width(width.time)?));
        }
        residuals.extend(self.priors.iter().map(|prior| prior.residual(model)));
        Ok(residuals)
    }

    fn linearised(
        &self,
        model: &TimingModel,
        unknowns: &[TimingParameter],
    ) -> Result<(Vec<f64>, Jacobian), InferenceError> {
        let mut matrix = DMatrix::zeros(self.len(), unknowns.len());
        let mut residuals = Vec::with_capacity(self.len());
        let mut add = |residual: f64, of: &dyn Fn(TimingParameter) -> f64| {
            let row = residuals.len();
            residuals.push(residual);
            unknowns.iter().enumerate().for_each(|(column, unknown)| matrix[(row, column)] = of(*unknown));
        };
        for arrival in &self.arrivals {
            let (phase, derivatives) = model.phase_and_derivatives(arrival.time)?;
            let rate = model.phase_rate(arrival.time)?;
            add(arrival.residual(&phase, rate), &|unknown| -derivatives[unknown as usize] / rate / arrival.sigma);
        }
        for width in &self.widths {
            let (duration, derivatives) = model.width_and_derivatives(width.time)?;
            add(width.residual(duration), &|unknown| derivatives[unknown as usize] / width.sigma);
        }
        for prior in &self.priors {
            add(prior.residual(model), &|unknown| if unknown == prior.parameter { 1.0 / prior.sigma } else { 0.0 });
        }
        for value in matrix.iter().chain(&residuals) {
            let what = "derivative or residual of a datum, in its standard deviations";
            Error::ensure(value.abs() <= LARGEST, what, *value, "a number of at most 1e150 in size")?;
        }
        let magnitudes = matrix.abs();
        Ok((
            residuals,
            Jacobian { rounding: DVector::zeros(matrix.nrows()), matrix, magnitudes, relative_error: DERIVATIVES },
        ))
    }

    fn rounding(&self, found: &Fit<TimingModel>) -> Result<Option<InferenceError>, InferenceError> {
        let rounding = ROUNDING / found.fisher.parameters.value(TimingParameter::F0);
        let is_rounding = |(arrival, residual): (&MeasuredArrival, &f64)| residual.abs() * arrival.sigma <= rounding;
        let all = self.widths.is_empty() && self.arrivals.iter().zip(&found.residuals).all(is_rounding);
        Ok(all.then_some(InferenceError::NotConverged {
            why: "the residuals are only rounding errors",
            cosine: found.cosine,
        }))
    }
}

/// Fits a timing model from a start whose pulses agree with those of the data to less than half a turn at the first datum, and whose phase is well
/// known over the whole span. F0 is stepped in 32 digits, so that it is accurate for any number of turns.
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

/// Constraints that timing data place on unknowns, evaluated at a given model: uncertainties and correlations.
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
        return Err(InferenceError::TooFew { data: data.len(), least: unknowns.len() });
    }
    Ok(Fisher::of_jacobian(&data.numbered(model)?.linearised(model, unknowns)?.1, unknowns, model))
}

/// Departure of `chi^2` of a fit from the parabola that its error bars assume, as in [`nonlinearity`](super::nonlinearity).
///
/// # Errors
/// The model a standard deviation away is not valid.
pub fn timing_nonlinearity(fisher: &Fisher<TimingModel>, data: &TimingData) -> Result<f64, InferenceError> {
    least_squares::nonlinearity(fisher, &data.numbered(&fisher.parameters)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::{Model, Residuals};
    use TimingParameter::*;

    /// A wobbling pulsar whose pulses have widths.
    fn star() -> TimingModel {
        let rate = core::f64::consts::TAU / 4e7;
        let star = [
            (F1, -3e-13),
            (Wobble, 0.05),
            (Chi, 1.3),
            (PrecessionRate, rate),
            (TorqueShare, 1.0),
            (Inclination, 1.2),
            (Rho, 0.3),
        ];
        TimingModel::new([10.0, 0.0], &star).expect("a model")
    }

    /// Arrivals at the times of the model, each later by `late` (s).
    fn arrivals(model: &TimingModel, numbers: &[i64], late: f64, sigma: f64) -> Vec<MeasuredArrival> {
        let of = |number: &i64| {
            let [time, rest] = model.arrival(*number).expect("a pulse");
            MeasuredArrival { time: [time, rest + late], sigma, number: Some(*number) }
        };
        numbers.iter().map(of).collect()
    }

    /// Two arrivals, two widths and two priors.
    fn mixed(model: &TimingModel) -> TimingData {
        let width =
            |time: f64| MeasuredWidth { time, duration: model.width(time).expect("a width") + 2e-4, sigma: 1e-4 };
        let priors = vec![
            Prior { parameter: Chi, mean: 1.25, sigma: 0.1 },
            Prior { parameter: F1, mean: -3.5e-13, sigma: 1e-13 },
        ];
        TimingData {
            arrivals: arrivals(model, &[-4_000_000, 7_000_000], 3e-5, 1e-5),
            widths: vec![width(1e5), width(7e6)],
            priors,
        }
    }

    /// Residuals are model minus measurement, in standard deviations: late arrivals and long pulses have negative residuals.
    #[test]
    fn residuals_are_the_model_less_the_data() {
        let model = star();
        let data = mixed(&model);
        assert_eq!(data.len(), 6);
        let residuals = data.residuals(&model).expect("data of the model");
        for (found, expected) in residuals.iter().zip([-3.0, -3.0, -2.0, -2.0, 0.5, 0.5]) {
            assert!((found - expected).abs() < 1e-6, "{residuals:?}");
        }
        assert_eq!(residuals.len(), 6);
    }

    /// A star that slows down by a twentieth: its late pulses are late by the same time, in more of its turns at first and fewer at last.
    #[test]
    fn residuals_are_times_however_fast_the_star_turns() {
        let model = TimingModel::new([30.0, 0.0], &[(F1, -3e-10), (F2, 9e-21)]).expect("a model");
        let numbers = [-90_000_000_000, 1, 150_000_000_000];
        let data = TimingData { arrivals: arrivals(&model, &numbers, 3e-4, 1e-4), ..TimingData::default() };
        let (residuals, jacobian) = data.linearised(&model, &[Phase]).expect("data of the model");
        for (arrival, (residual, derivative)) in
            data.arrivals.iter().zip(residuals.iter().zip(jacobian.matrix.column(0).iter()))
        {
            assert!((residual + 3.0).abs() < 1e-6, "{residuals:?}");
            // The next pulse is a turn later.
            let number = arrival.number.expect("a number");
            let [[t, rest], [next, more]] = [number, number + 1].map(|number| model.arrival(number).expect("a pulse"));
            let turn = (next - t) + (more - rest);
            assert!((-derivative * 1e-4 / turn - 1.0).abs() < 1e-9, "{derivative} {turn}");
        }
    }

    /// Compared with central differences, for a change that moves the largest residual by a thousandth of a standard
    /// deviation.
    #[test]
    fn derivatives_of_residuals_are_their_differences() {
        let model = star();
        let data = mixed(&model);
        let unknowns = [Phase, F0, F1, Chi, Wobble, PrecessionPhase, Rho];
        let (residuals, jacobian) = data.linearised(&model, &unknowns).expect("derivatives");
        assert_eq!(residuals, data.residuals(&model).expect("data of the model"));
        assert_eq!((jacobian.matrix.nrows(), jacobian.matrix.ncols()), (6, 7));
        assert_eq!(jacobian.magnitudes, jacobian.matrix.abs());
        assert_eq!(jacobian.relative_error, 1e-13);
        for (column, unknown) in unknowns.into_iter().enumerate() {
            let derivative = jacobian.matrix.column(column);
            let step = 1e-3 / derivative.amax();
            let at = |sign: f64| {
                let moved = Model::moved(&model, &[unknown], &[sign * step]).expect("a model");
                data.residuals(&moved).expect("data of the model")
            };
            for (row, (up, down)) in at(1.0).into_iter().zip(at(-1.0)).enumerate() {
                let difference = (up - down) / (2.0 * step);
                assert!(
                    (difference - derivative[row]).abs() < 1e-5 * derivative.amax(),
                    "{unknown:?} {row}: {difference} {}",
                    derivative[row]
                );
            }
        }
    }

    /// Numbers of the data may begin anywhere: the first numbered pulse gets the number of its turn, and a pulse without a number that of the nearest
    /// turn.
    #[test]
    fn pulses_are_numbered_as_the_model_counts() {
        let model = star();
        let turns = [20, 21, 25, 40];
        let mut arrivals = arrivals(&model, &turns, 0.02, 1e-5);
        for (arrival, number) in arrivals.iter_mut().zip([None, Some(1021), Some(1025), Some(1041)]) {
            arrival.number = number;
        }
        let data = TimingData { arrivals, ..TimingData::default() };
        let numbers: Vec<_> =
            data.numbered(&model).expect("turns").arrivals.iter().map(|arrival| arrival.number).collect();
        // The last pulse was numbered one too high, which the residuals then show.
        assert_eq!(numbers, [Some(20), Some(21), Some(25), Some(41)]);
    }

    /// `chi^2` grows by one at one standard deviation, whichever pulse the data call the first.
    #[test]
    fn a_linear_model_has_no_nonlinearity_whatever_the_numbers() {
        let model = TimingModel::new([10.0, 0.0], &[]).expect("a model");
        for origin in [0, 1000] {
            let mut data =
                TimingData { arrivals: arrivals(&model, &[20, 21, 25, 41], 0.0, 1e-5), ..TimingData::default() };
            data.arrivals.iter_mut().for_each(|arrival| arrival.number = arrival.number.map(|number| number + origin));
            let fisher = timing_fisher(&model, &data, &[Phase]).expect("derivatives");
            let off = timing_nonlinearity(&fisher, &data).expect("data of the model");
            assert!(off < 1e-9, "{origin}: {off:e}");
        }
    }

    /// Two measurements of one number and a prior for it: the result is their weighted mean.
    #[test]
    fn what_is_known_beforehand_counts_as_data() {
        let priors = vec![
            Prior { parameter: Phase, mean: 0.1, sigma: 0.01 },
            Prior { parameter: Phase, mean: 0.2, sigma: 0.02 },
        ];
        let data = TimingData { priors, ..TimingData::default() };
        let model = TimingModel::new([10.0, 0.0], &[]).expect("a model");
        let found = fit_timing(&model, &data, &[Phase]).expect("a fit");
        assert!((found.fisher.values()[0] - 0.12).abs() < 1e-12, "{found:?}");
        assert!((found.fisher.sigmas()[0] - 12_500_f64.powf(-0.5)).abs() < 1e-12, "{found:?}");
        assert!((found.chi_squared - 20.0).abs() < 1e-9, "{found:?}");
        assert!(timing_nonlinearity(&found.fisher, &data).expect("data of the model") < 1e-9);
    }

    #[test]
    fn errors_that_are_none_are_refused() {
        let model = star();
        for sigma in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            for which in 0..3 {
                let mut data = mixed(&model);
                match which {
                    0 => data.arrivals[1].sigma = sigma,
                    1 => data.widths[1].sigma = sigma,
                    _ => data.priors[1].sigma = sigma,
                }
                let refused = timing_fisher(&model, &data, &[Phase]).expect_err("no standard deviation");
                assert!(
                    matches!(refused, InferenceError::Model(Error::Domain { quantity: "standard deviation", .. })),
                    "{refused:?}"
                );
            }
        }
        let few =
            TimingData { priors: vec![Prior { parameter: Phase, mean: 0.0, sigma: 1.0 }], ..TimingData::default() };
        let refused = timing_fisher(&model, &few, &[Phase, F0]).expect_err("too few");
        assert_eq!(refused, InferenceError::TooFew { data: 1, least: 2 });
        let enough = timing_fisher(&model, &few, &[Phase]).expect("one of each");
        assert!((enough.sigmas()[0] - 1.0).abs() < 1e-12);
    }

    /// With errors far below rounding, data from the model itself are reported as rounding, and data that are off by a hundred times as much are
    /// not.
    #[test]
    fn residuals_that_are_rounding_are_told() {
        let model = TimingModel::new([300.0, 0.0], &[]).expect("a model");
        let numbers: Vec<i64> = (-6..6).map(|k| k * 1_234_567).collect();
        // In turns: 1e-14 is rounding.
        let off_by = |turns: f64| {
            let mut data = TimingData { arrivals: arrivals(&model, &numbers, 0.0, 1e-21), ..TimingData::default() };
            let shift = |arrival: (usize, &mut MeasuredArrival)| {
                arrival.1.time[1] += if arrival.0.is_multiple_of(2) { turns / 300.0 } else { -turns / 300.0 }
            };
            data.arrivals.iter_mut().enumerate().for_each(shift);
            fit_timing(&model, &data, &[Phase])
        };
        match off_by(5e-15) {
            Err(InferenceError::NotConverged { why, .. }) => assert_eq!(why, "the residuals are only rounding errors"),
            other => panic!("{other:?}"),
        }
        for turns in [3e-14, 1e-12] {
            match off_by(turns) {
                Ok(found) => assert_eq!(found.consistency(), Residuals::Larger),
                Err(InferenceError::NotConverged { why, .. }) => {
                    assert_ne!(why, "the residuals are only rounding errors")
                }
                Err(other) => panic!("{other:?}"),
            }
        }
    }

    /// Widths ten standard deviations above and below the model in turn have residuals larger than stated, without arrivals and beside exact ones.
    #[test]
    fn widths_that_disagree_are_no_rounding() {
        let model = star();
        let width = |k: i32| {
            let (time, off) = (1e6 * f64::from(k), if k % 2 == 0 { 1e-3 } else { -1e-3 });
            MeasuredWidth { time, duration: model.width(time).expect("a width") + off, sigma: 1e-4 }
        };
        for numbers in [vec![], vec![-4_000_000, 7_000_000]] {
            let arrivals = arrivals(&model, &numbers, 0.0, 1e-5);
            let data = TimingData { arrivals, widths: (0..6).map(width).collect(), priors: Vec::new() };
            let found = fit_timing(&model, &data, &[Rho]).expect("a fit");
            assert_eq!(found.consistency(), Residuals::Larger, "{numbers:?}");
        }
    }

    #[test]
    fn frequencies_differ_in_both_doubles() {
        let model = |frequency: [f64; 2]| TimingModel::new(frequency, &[(F1, -1e-15)]).expect("a model");
        let (here, there) = (model([300.0, 3e-16]), model([299.0, -5e-15]));
        assert_eq!(here.difference(&there, F0), 1.0 + 5.3e-15);
        assert_eq!(model([300.0, 3e-16]).difference(&model([300.0, -5e-15]), F0), 5.3e-15);
        assert_eq!(here.difference(&model([300.0, 0.0]), F1), 0.0);
        for unknown in TimingParameter::ALL {
            let is_rate = [F0, F1, F2, PrecessionRate, InclinationRate].contains(&unknown);
            assert_eq!(here.range(unknown), if is_rate { 300.0 } else { 1.0 }, "{unknown:?}");
        }
    }
}
