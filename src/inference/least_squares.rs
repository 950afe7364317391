//! Weighted least squares: the unknowns that data are most likely of, by Levenberg and Marquardt's method with exact derivatives.

use nalgebra::DVector;
use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPSide, MPSuccess};

use super::{Fisher, InferenceError, Jacobian, Model, Unknown};
use crate::error::Error;
use crate::parameters::Parameters;

/// What a model is compared with.
pub(super) trait Comparison<M: Model> {
    /// How many data there are.
    fn len(&self) -> usize;

    /// The data that a model has, less those measured, in standard deviations.
    fn residuals(&self, model: &M) -> Result<Vec<f64>, InferenceError>;

    /// The same with their derivatives.
    fn linearised(&self, model: &M, unknowns: &[M::Unknown]) -> Result<(Vec<f64>, Jacobian), InferenceError>;

    /// Why a fit ended off a minimum, or with residuals that are too large, if they are all rounding.
    fn rounding(&self, found: &Fit<M>) -> Result<Option<InferenceError>, InferenceError>;
}

/// What a fit found.
#[derive(Debug, Clone)]
pub struct Fit<M: Model = Parameters<f64>> {
    /// The parameters at the minimum, and the uncertainties of those fitted: `(J^T J)^-1` with the exact Jacobian there.
    pub fisher: Fisher<M>,
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

impl<M: Model> Fit<M> {
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
/// up and down each principal axis of the correlations.
pub(super) fn nonlinearity<M: Model>(
    fisher: &Fisher<M>,
    comparison: &impl Comparison<M>,
) -> Result<f64, InferenceError> {
    let chi_squared = |model: &M| comparison.residuals(model).map(|found| squares(&found));
    let least = chi_squared(&fisher.parameters)?;
    let mut worst: f64 = 0.0;
    let count = fisher.unknowns.len();
    for axis in 0..count {
        let one = DVector::from_fn(count, |k, _| if k == axis { 1.0 } else { 0.0 });
        for sign in [1.0, -1.0] {
            worst = worst.max((chi_squared(&fisher.beside(&one, sign)?)? - least - 1.0).abs());
        }
    }
    Ok(worst)
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// The fit from a start. The unknowns move in units of their standard deviations there. A trial step to a model without the data is rejected.
pub(super) fn least_squares<M: Model>(
    start: &M,
    comparison: &impl Comparison<M>,
    unknowns: &[M::Unknown],
) -> Result<Fit<M>, InferenceError> {
    if comparison.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: comparison.len(), unknowns: unknowns.len() });
    }
    if unknowns.is_empty() {
        return Err(Error::Unsupported { what: "a fit", why: "it has no unknowns" }.into());
    }
    let (_, at_start) = comparison.linearised(start, unknowns)?;
    let scales = Fisher::of_jacobian(&at_start, unknowns, start).determined()?.sigmas();
    let bounds = bounds(start, unknowns, &scales);
    let mut search = Search { start, comparison, unknowns, scales: &scales, bounds };
    let mut at = vec![0.0; unknowns.len()];
    let ended = search.mpfit(&mut at).map_err(|error| InferenceError::NotConverged {
        why: match error {
            MPError::Nan => "a derivative is not finite",
            MPError::InitBounds => "the start is outside the limits",
            _ => "the start could not be computed",
        },
        cosine: f64::NAN,
    })?;
    let model = search.model_at(&at)?;
    let (residuals, weighted) = comparison.linearised(&model, unknowns)?;
    let chi_squared = squares(&residuals);
    let gradient = weighted.matrix.transpose() * DVector::from_column_slice(&residuals);
    let cosine = weighted
        .matrix
        .column_iter()
        .zip(&gradient)
        .fold(0.0, |most: f64, (column, product)| most.max((product / (column.norm() * chi_squared.sqrt())).abs()));
    let fisher = Fisher::of_jacobian(&weighted, unknowns, &model).determined()?;
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
        degrees: comparison.len() - unknowns.len(),
        residuals: residuals.iter().map(|residual| -residual).collect(),
        iterations: ended.n_iter,
        cosine,
    };
    if (is_off || found.judged() == Residuals::Larger)
        && let Some(rounding) = comparison.rounding(&found)?
    {
        return Err(rounding);
    }
    if is_off {
        return Err(InferenceError::NotConverged {
            why: if ended.success == MPSuccess::MaxIter { "too many steps" } else { "no step makes chi^2 less" },
            cosine,
        });
    }
    Ok(found)
}

/// The limits of the unknowns, in standard deviations from the start.
fn bounds<M: Model>(start: &M, unknowns: &[M::Unknown], scales: &[f64]) -> Vec<MPPar> {
    let bound = |(unknown, scale): (&M::Unknown, &f64)| {
        let ((low, high), value) = (unknown.limits(), start.value(*unknown));
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
struct Search<'a, M: Model, C> {
    start: &'a M,
    comparison: &'a C,
    unknowns: &'a [M::Unknown],
    scales: &'a [f64],
    bounds: Vec<MPPar>,
}

impl<M: Model, C: Comparison<M>> Search<'_, M, C> {
    fn model_at(&self, at: &[f64]) -> Result<M, InferenceError> {
        let changes: Vec<f64> = at.iter().zip(self.scales).map(|(at, scale)| at * scale).collect();
        Ok(self.start.moved(self.unknowns, &changes)?)
    }
}

impl<M: Model, C: Comparison<M>> MPFitter for Search<'_, M, C> {
    fn eval(&mut self, params: &[f64], deviates: &mut [f64]) -> Result<(), MPError> {
        /// Residual of data that a trial model lacks: more than any that a start with the data can have.
        const LACKING: f64 = 1e12;
        match self.model_at(params).and_then(|model| self.comparison.residuals(&model)) {
            Ok(residuals) => deviates.copy_from_slice(&residuals),
            Err(_) => deviates.fill(LACKING),
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.comparison.len()
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
        let found = self.model_at(params).and_then(|model| self.comparison.linearised(&model, self.unknowns));
        let (residuals, weighted) = found.map_err(|_| MPError::Eval)?;
        deviates.copy_from_slice(&residuals);
        for ((column, wanted), scale) in weighted.matrix.column_iter().zip(derivs).zip(self.scales) {
            if let Some(wanted) = wanted {
                wanted.iter_mut().zip(&column).for_each(|(place, derivative)| *place = derivative * scale);
            }
        }
        Ok(())
    }
}
