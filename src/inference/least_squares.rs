//! Weighted least squares with the method of Levenberg and Marquardt and exact derivatives.

use nalgebra::DVector;
use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPSide, MPSuccess};

use super::{Fisher, InferenceError, Jacobian, Model, Unknown};
use crate::error::Error;
use crate::parameters::Parameters;

/// The data that a model is compared with.
pub(super) trait Comparison<M: Model> {
    /// Number of data.
    fn len(&self) -> usize;

    /// Data of the model minus measured data, in standard deviations.
    fn residuals(&self, model: &M) -> Result<Vec<f64>, InferenceError>;

    /// The same residuals with their derivatives.
    fn linearised(&self, model: &M, unknowns: &[M::Unknown]) -> Result<(Vec<f64>, Jacobian), InferenceError>;

    /// If all residuals are rounding, the error that says so. It explains why a fit ended away from a minimum, or with residuals that are too large.
    fn rounding(&self, found: &Fit<M>) -> Result<Option<InferenceError>, InferenceError>;
}

/// The result of a fit.
#[derive(Debug, Clone)]
pub struct Fit<M: Model = Parameters<f64>> {
    /// The parameters at the minimum, and the uncertainties of the fitted ones: `(J^T J)^-1` with the exact Jacobian there.
    pub fisher: Fisher<M>,
    /// `sum (residual / sigma)^2`.
    pub chi_squared: f64,
    /// Number of data minus number of unknowns.
    pub degrees: usize,
    /// Measured minus fitted, in standard deviations, in the order of the data.
    pub residuals: Vec<f64>,
    /// Number of iterations of the fit.
    pub iterations: usize,
    /// Largest cosine of the angle between the residuals and the derivative with respect to an unknown: zero at the minimum.
    pub cosine: f64,
}

/// Whether the residuals agree with the stated errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Residuals {
    /// They agree with the stated errors.
    Consistent,
    /// They are larger than the stated errors.
    Larger,
    /// They are smaller than the stated errors.
    Smaller,
}

impl<M: Model> Fit<M> {
    /// Root mean square of the residuals in standard deviations, per degree of freedom.
    pub fn root_mean_square(&self) -> f64 {
        (self.chi_squared / self.degrees as f64).sqrt()
    }

    /// Judges `chi^2` at six standard deviations. For `n` degrees of freedom `(chi^2 / n)^(1/3)` is nearly normal, with mean `1 - 2 / (9 n)`
    /// and variance `2 / (9 n)` (E. B. Wilson and M. M. Hilferty, Proc. Nat. Acad. Sci. 17, 684 (1931)).
    pub fn consistency(&self) -> Residuals {
        let variance = 2.0 / (9.0 * self.degrees as f64);
        let score = ((self.chi_squared / self.degrees as f64).cbrt() - (1.0 - variance)) / variance.sqrt();
        match score {
            6.0.. => Residuals::Larger,
            ..=-6.0 => Residuals::Smaller,
            _ => Residuals::Consistent,
        }
    }
}

/// Departure of `chi^2` from the parabola that error bars assume: the largest of `|chi^2 - chi^2_min - 1|` one standard deviation
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
            worst = worst.max((chi_squared(&fisher.displaced(&one, sign)?)? - least - 1.0).abs());
        }
    }
    Ok(worst)
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// Fits from a starting model. The unknowns are stepped in units of their standard deviations there. A trial step to a model without the data
/// is rejected.
pub(super) fn least_squares<M: Model>(
    start: &M,
    comparison: &impl Comparison<M>,
    unknowns: &[M::Unknown],
) -> Result<Fit<M>, InferenceError> {
    if comparison.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: comparison.len(), least: unknowns.len() + 1 });
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
    for ((unknown, at), bound) in unknowns.iter().zip(&at).zip(&search.bounds) {
        let (low, high) = unknown.limits();
        for (limit, end) in [(low, bound.limit_low), (high, bound.limit_up)] {
            if let Some(value) = limit
                && *at == end
            {
                return Err(InferenceError::OnLimit { unknown: unknown.symbol(), value });
            }
        }
    }
    // The remaining gradient moves no unknown by more than a hundredth of its error.
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
    if (is_off || found.consistency() == Residuals::Larger)
        && let Some(rounding) = comparison.rounding(&found)?
    {
        return Err(rounding);
    }
    if is_off {
        let steps = unknowns.iter().map(|unknown| model.last_digit(*unknown));
        let steps = steps.zip(found.fisher.sigmas()).map(|(digit, sigma)| digit / sigma);
        if let Some((unknown, step)) = unknowns.iter().zip(steps).find(|(_, step)| *step > 1e-2) {
            return Err(InferenceError::Coarse { unknown: unknown.symbol(), step });
        }
        return Err(InferenceError::NotConverged {
            why: if ended.success == MPSuccess::MaxIter { "too many steps" } else { "no step reduces chi^2" },
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

/// The search for the minimum, in numbers that count standard deviations from the start.
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
        /// Residual of data that a trial model does not have: larger than any at a start that has the data.
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
        // Steps below 1e-6 of a standard deviation, and changes of chi^2 by 1e-12 of it, are negligible.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::functions::{A, B, Fraction, Functions, Name, Numbers, ROUNDING};

    /// Seven measurements of a straight line `a + b x`: x, y, sigma.
    const POINTS: [[f64; 3]; 7] = [
        [0.0, 1.1, 0.1],
        [1.0, 2.9, 0.2],
        [2.0, 5.2, 0.1],
        [3.0, 6.8, 0.3],
        [4.0, 9.1, 0.1],
        [5.0, 11.4, 0.2],
        [6.0, 12.8, 0.1],
    ];

    const LINE: Functions = Functions {
        count: 7,
        residuals: |[a, b, _]| Some(POINTS.iter().map(|[x, y, sigma]| (a + b * x - y) / sigma).collect()),
        derivatives: |_| POINTS.iter().map(|[x, _, sigma]| [1.0 / sigma, x / sigma, 0.0]).collect(),
        all_rounding: false,
    };

    /// Sums of `f(x, y)` over the points, weighted by `sigma^-2`.
    fn sum(f: impl Fn(f64, f64) -> f64) -> f64 {
        POINTS.iter().map(|[x, y, sigma]| f(*x, *y) / (sigma * sigma)).sum()
    }

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1e-3), "{found:e}, expected {expected:e}");
    }

    fn why(found: Result<Fit<Numbers>, InferenceError>) -> (&'static str, f64) {
        match found {
            Err(InferenceError::NotConverged { why, cosine }) => (why, cosine),
            other => panic!("{other:?}"),
        }
    }

    /// Compared with the textbook sums.
    #[test]
    fn a_straight_line_has_its_closed_form() {
        let found = least_squares(&Numbers::unbounded([30.0, -7.0, 0.0]), &LINE, &[A, B]).expect("a fit");
        let [s, sx, sy] = [sum(|_, _| 1.0), sum(|x, _| x), sum(|_, y| y)];
        let [sxx, sxy] = [sum(|x, _| x * x), sum(|x, y| x * y)];
        let determinant = s * sxx - sx * sx;
        let (a, b) = ((sxx * sy - sx * sxy) / determinant, (s * sxy - sx * sy) / determinant);
        let [found_a, found_b] = found.fisher.values()[..] else { panic!("two values") };
        close(found_a, a);
        close(found_b, b);
        close(found.fisher.covariance[(0, 0)], sxx / determinant);
        close(found.fisher.covariance[(1, 1)], s / determinant);
        close(found.fisher.covariance[(0, 1)], -sx / determinant);
        close(found.chi_squared, sum(|x, y| (y - a - b * x).powi(2)));
        assert_eq!(found.degrees, 5);
        close(found.root_mean_square(), (found.chi_squared / 5.0).sqrt());
        assert_eq!(found.residuals.len(), 7);
        for (residual, [x, y, sigma]) in found.residuals.iter().zip(POINTS) {
            assert!((residual - (y - a - b * x) / sigma).abs() < 1e-11, "measured less fitted");
        }
        assert!(found.cosine < 1e-9 && found.iterations > 0, "{found:?}");
        assert_eq!(found.consistency(), Residuals::Consistent);
    }

    /// `chi^2` that corresponds to six standard deviations of a normal distribution, from the incomplete gamma function to
    /// 25 digits (mpmath).
    #[test]
    fn chi_squared_is_judged_at_six_standard_deviations() {
        let fitted = least_squares(&Numbers::unbounded([1.0, 2.0, 0.0]), &LINE, &[A, B]).expect("a fit");
        let judged = |chi_squared: f64, degrees: usize| Fit { chi_squared, degrees, ..fitted.clone() }.consistency();
        for (degrees, edge, exact_to) in [(100, 209.367_631, 5e-3), (1000, 1_292.074_00, 5e-4)] {
            assert_eq!(judged(edge * (1.0 - exact_to), degrees), Residuals::Consistent, "{degrees}");
            assert_eq!(judged(edge * (1.0 + exact_to), degrees), Residuals::Larger, "{degrees}");
        }
        assert_eq!(judged(754.551_951 * (1.0 + 5e-4), 1000), Residuals::Consistent);
        assert_eq!(judged(754.551_951 * (1.0 - 5e-4), 1000), Residuals::Smaller);
    }

    #[test]
    fn too_few_data_and_no_unknowns_are_refused() {
        let two = Functions { count: 2, ..LINE };
        let found = least_squares(&Numbers::unbounded([1.0; 3]), &two, &[A, B, Fraction]).expect_err("too few");
        assert_eq!(found, InferenceError::TooFew { data: 2, least: 4 });
        let found = least_squares(&Numbers::unbounded([1.0; 3]), &Functions { count: 2, ..LINE }, &[A, B])
            .expect_err("as many");
        assert_eq!(found, InferenceError::TooFew { data: 2, least: 3 });
        let found = least_squares(&Numbers::unbounded([1.0; 3]), &LINE, &[]).expect_err("none");
        assert!(matches!(found, InferenceError::Model(Error::Unsupported { what: "a fit", .. })), "{found:?}");
    }

    /// The data are fitted best by a fraction beyond either end of its interval: from any start the search ends on that end, whatever the
    /// rounding of the steps.
    #[test]
    fn a_fit_that_ends_on_a_limit_is_refused() {
        let fraction = |target: fn([f64; 3]) -> Option<Vec<f64>>| Functions {
            count: 3,
            residuals: target,
            derivatives: |_| vec![[0.0, 0.0, 3.0], [0.0, 0.0, 7.0], [0.0, 0.0, 1.1]],
            all_rounding: false,
        };
        let above = fraction(|[.., f]| Some([3.0, 7.0, 1.1].map(|scale| scale * (f - 1.5)).to_vec()));
        let below = fraction(|[.., f]| Some([3.0, 7.0, 1.1].map(|scale| scale * (f + 0.5)).to_vec()));
        let within = fraction(|[.., f]| Some([3.0, 7.0, 1.1].map(|scale| scale * (f - 0.999)).to_vec()));
        for k in 1..100 {
            let start = Numbers::unbounded([0.0, 0.0, f64::from(k) / 100.0]);
            for (data, limit) in [(&above, 1.0), (&below, 0.0)] {
                match least_squares(&start, data, &[Fraction]) {
                    Err(InferenceError::OnLimit { unknown: "f", value }) => {
                        assert_eq!(value, limit)
                    }
                    other => panic!("from {start:?}: {other:?}"),
                }
            }
            let found = least_squares(&start, &within, &[Fraction]).expect("a fit");
            assert!((found.fisher.values()[0] - 0.999).abs() < 1e-12);
        }
        let outside = least_squares(&Numbers::unbounded([0.0, 0.0, 1.5]), &above, &[Fraction]);
        assert_eq!(why(outside).0, "the start is outside the limits");
    }

    /// A derivative of the wrong sign leads uphill, so the fit stays at its start. There the residuals (3, 4) have a cosine of 3/5 with the
    /// derivative (1, 0), and of 4/5 with the derivative (0, 1) of the other number.
    #[test]
    fn a_fit_that_ends_off_a_minimum_is_refused() {
        let uphill = |derivatives: fn([f64; 3]) -> Vec<[f64; 3]>| Functions {
            count: 3,
            residuals: |[a, b, _]| Some(vec![3.0 + a, 4.0 + b, 0.0]),
            derivatives,
            all_rounding: false,
        };
        let wrong = uphill(|_| vec![[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0; 3]]);
        let start = Numbers::unbounded([0.0; 3]);
        let (what, cosine) = why(least_squares(&start, &wrong, &[A]));
        assert_eq!(what, "no step reduces chi^2");
        assert!((cosine - 0.6).abs() < 1e-6, "{cosine}");
        let (_, cosine) = why(least_squares(&start, &wrong, &[A, B]));
        assert!((cosine - 0.8).abs() < 1e-6, "{cosine}");
        let (_, cosine) = why(least_squares(&start, &wrong, &[B, A]));
        assert!((cosine - 0.8).abs() < 1e-6, "{cosine}");
        // A remaining step of 0.03 standard deviations is too long, in either direction; one of 0.003 is not.
        for (off, refused) in [(0.03, true), (-0.03, true), (0.003, false), (-0.003, false)] {
            let near = Numbers::unbounded([-3.0 + off, 0.0, 0.0]);
            assert_eq!(least_squares(&near, &wrong, &[A]).is_err(), refused, "{off}");
        }
        let undefined = uphill(|[a, ..]| vec![[if a == 0.0 { 1.0 } else { f64::NAN }, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
        assert_eq!(why(least_squares(&start, &undefined, &[A])).0, "a derivative is not finite");
    }

    /// The last digit of 2e15, taken as `2^-52` of it, is 0.44. With a standard deviation of 1 it is a step of 0.44 standard deviations, which is too
    /// long; with one of 100, of 0.0044. The derivatives have the wrong sign, so that neither fit ends at its minimum.
    #[test]
    fn a_number_too_coarse_for_its_error_is_named() {
        let uphill = |residuals: fn([f64; 3]) -> Option<Vec<f64>>, derivatives: fn([f64; 3]) -> Vec<[f64; 3]>| {
            least_squares(
                &Numbers::unbounded([2e15, 0.0, 0.0]),
                &Functions { count: 2, residuals, derivatives, all_rounding: false },
                &[A],
            )
        };
        let coarse = uphill(|[a, ..]| Some(vec![3.0 + (a - 2e15), 0.0]), |_| vec![[-1.0, 0.0, 0.0], [0.0; 3]]);
        match coarse {
            Err(InferenceError::Coarse { unknown: "a", step }) => close(step, 2e15 * f64::EPSILON),
            other => panic!("{other:?}"),
        }
        let fine = uphill(|[a, ..]| Some(vec![3.0 + 0.01 * (a - 2e15), 0.0]), |_| vec![[-0.01, 0.0, 0.0], [0.0; 3]]);
        assert_eq!(why(fine).0, "no step reduces chi^2");
    }

    /// `exp(-a)` has no minimum: every step has length one, without end.
    #[test]
    fn too_many_steps_are_told() {
        let endless = Functions {
            count: 2,
            residuals: |[a, ..]| Some(vec![(-a).exp(), 0.0]),
            derivatives: |[a, ..]| vec![[-(-a).exp(), 0.0, 0.0], [0.0; 3]],
            all_rounding: false,
        };
        assert_eq!(why(least_squares(&Numbers::unbounded([0.0; 3]), &endless, &[A])).0, "too many steps");
    }

    /// The first step from 5 to the minimum of `ln(a)^2` leads below zero, where the logarithm is undefined.
    #[test]
    fn steps_to_models_without_the_data_are_rejected() {
        let logarithm = Functions {
            count: 2,
            residuals: |[a, ..]| (a > 0.0).then(|| vec![10.0 * a.ln(), 1.0]),
            derivatives: |[a, ..]| vec![[10.0 / a, 0.0, 0.0], [0.0; 3]],
            all_rounding: false,
        };
        let found = least_squares(&Numbers::unbounded([5.0, 0.0, 0.0]), &logarithm, &[A]).expect("a fit");
        assert!((found.fisher.values()[0] - 1.0).abs() < 1e-6 && (found.chi_squared - 1.0).abs() < 1e-9, "{found:?}");
    }

    /// Residuals that are rounding are reported if they are too large or if the fit ends away from a minimum, and only then.
    #[test]
    fn rounding_is_told_where_it_matters() {
        let small = Functions { all_rounding: true, ..LINE };
        assert!(least_squares(&Numbers::unbounded([1.0, 2.0, 0.0]), &small, &[A, B]).is_ok());
        let large = |all_rounding: bool| Functions {
            residuals: |[a, ..]| Some((0..7).map(|k| a + 100.0 * f64::from(k)).collect()),
            derivatives: |_| vec![[1.0, 0.0, 0.0]; 7],
            all_rounding,
            ..LINE
        };
        let found = least_squares(&Numbers::unbounded([0.0; 3]), &large(false), &[A]).expect("a fit");
        assert_eq!(found.consistency(), Residuals::Larger);
        let found = least_squares(&Numbers::unbounded([0.0; 3]), &large(true), &[A]).expect_err("rounding");
        assert_eq!(found, ROUNDING);
        let off = Functions {
            count: 3,
            residuals: |[a, ..]| Some(vec![1.0 + a, 0.0, 0.0]),
            derivatives: |_| vec![[-1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]],
            all_rounding: true,
        };
        let found = least_squares(&Numbers::unbounded([0.0; 3]), &off, &[A]).expect_err("rounding");
        assert_eq!(found, ROUNDING);
    }

    /// For `r = (x + curvature x^2 + cubic x^3, constant)`, one standard deviation from x = 0 changes `chi^2` by `(1 + curvature + cubic)^2`, or by
    /// this with the opposite sign of the curvature.
    #[test]
    fn nonlinearity_is_the_largest_difference_from_a_parabola() {
        let of = |residuals: fn([f64; 3]) -> Option<Vec<f64>>, unknowns: &[Name]| {
            let data = Functions {
                count: 3,
                residuals,
                derivatives: |_| vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]],
                all_rounding: false,
            };
            let at = Numbers::unbounded([0.0; 3]);
            let (_, jacobian) = data.linearised(&at, unknowns).expect("derivatives");
            nonlinearity(&Fisher::of_jacobian(&jacobian, unknowns, &at), &data).expect("data")
        };
        let curved = |[a, ..]: [f64; 3]| Some(vec![a + 0.1 * a * a, 0.0, 3.0]);
        assert!((of(curved, &[A]) - 0.21).abs() < 1e-12);
        let the_other_way = |[a, ..]: [f64; 3]| Some(vec![a - 0.1 * a * a, 0.0, 3.0]);
        assert!((of(the_other_way, &[A]) - 0.21).abs() < 1e-12);
        let flatter = |[a, ..]: [f64; 3]| Some(vec![a - 0.3 * a * a * a, 0.0, 3.0]);
        assert!((of(flatter, &[A]) - 0.51).abs() < 1e-12);
        let in_the_second = |[a, b, _]: [f64; 3]| Some(vec![a, b + 0.2 * b * b, 3.0]);
        assert!((of(in_the_second, &[A, B]) - 0.44).abs() < 1e-12);
        assert!(of(|[a, b, _]| Some(vec![a, b, 3.0]), &[A, B]) < 1e-12);
    }
}
