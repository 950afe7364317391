//! The Fisher matrix of data with independent errors: uncertainties, correlations, and undetermined directions.
//!
//! The Fisher matrix is `F = J^T J` with the Jacobian `J` of the data, each in units of its standard deviation. It is never formed,
//! because squaring would halve the number of digits. All results are computed from the singular values of `J` with columns of unit
//! length, a scaling that is within the square root of the number of unknowns of the best possible one (van der Sluis 1969).

use nalgebra::{DMatrix, DVector};

use super::degenerate::Directions;
use super::scaled_jacobian::ScaledJacobian;
use super::{Datum, Direction, Event, InferenceError, Jacobian, Model, jacobian};
use crate::error::Error;
use crate::parameters::{Parameter, Parameters};

/// Constraints on unknowns from data with given errors.
#[derive(Debug, Clone)]
pub struct Fisher<M: Model = Parameters<f64>> {
    /// The model at which the matrix is evaluated.
    pub parameters: M,
    /// The unknown parameters of the model.
    pub unknowns: Vec<M::Unknown>,
    /// Singular values of the Jacobian with columns of unit length, largest first.
    pub singular_values: Vec<f64>,
    /// Largest value that rounding can give to a singular value that is zero.
    pub rounding: f64,
    /// Directions that the data do not determine at all: singular values below [`rounding`](Self::rounding).
    pub degenerate: Vec<Direction<M::Unknown>>,
    /// Directions along which the data change by less than one standard deviation over the whole range of the unknowns (a radian, the
    /// rate of rotation, one).
    pub weak: Vec<Direction<M::Unknown>>,
    /// Covariance of the unknowns. NaN in the rows and columns of the unknowns that a degenerate direction changes.
    pub covariance: DMatrix<f64>,
}

impl Fisher {
    /// The Fisher matrix for data of a star with its pulses.
    ///
    /// # Errors
    /// The errors of [`jacobian`], and fewer data than unknowns.
    pub fn of(
        parameters: &Parameters<f64>,
        events: &[Event],
        data: &[Datum],
        unknowns: &[Parameter],
    ) -> Result<Self, InferenceError> {
        if data.len() < unknowns.len() {
            return Err(InferenceError::TooFew { data: data.len(), least: unknowns.len() });
        }
        Ok(Self::of_jacobian(&jacobian(parameters, events, data, unknowns)?.weighted(data), unknowns, parameters))
    }
}

impl<M: Model> Fisher<M> {
    /// The Fisher matrix from a Jacobian in units of the standard deviations.
    pub fn of_jacobian(jacobian: &Jacobian, unknowns: &[M::Unknown], parameters: &M) -> Self {
        let ranges = unknowns.iter().map(|unknown| parameters.range(*unknown));
        let ranges = DVector::from_iterator(unknowns.len(), ranges);
        let scaled = ScaledJacobian::new(jacobian, &ranges);
        let directions = Directions::new(&scaled, unknowns, ranges);
        Self {
            parameters: parameters.clone(),
            unknowns: unknowns.to_vec(),
            degenerate: directions.degenerate(parameters),
            weak: directions.weak(),
            covariance: scaled.covariance(),
            singular_values: scaled.values.iter().copied().collect(),
            rounding: scaled.rounding,
        }
    }

    /// Returns the Fisher matrix if the data determine all unknowns.
    ///
    /// # Errors
    /// [`InferenceError::Degenerate`] with the undetermined directions.
    pub fn determined(self) -> Result<Self, InferenceError> {
        if self.degenerate.is_empty() && self.weak.is_empty() {
            Ok(self)
        } else {
            let directions = self.degenerate.iter().chain(&self.weak);
            Err(InferenceError::Degenerate(directions.map(ToString::to_string).collect()))
        }
    }

    /// Values of the unknowns.
    pub fn values(&self) -> Vec<f64> {
        self.unknowns.iter().map(|unknown| self.parameters.value(*unknown)).collect()
    }

    /// Marginalised standard deviation of an unknown; NaN if it is undetermined, `None` if the parameter is not one of the unknowns.
    pub fn sigma(&self, unknown: M::Unknown) -> Option<f64> {
        let place = self.unknowns.iter().position(|other| *other == unknown)?;
        Some(self.covariance[(place, place)].sqrt())
    }

    /// Standard deviations of all unknowns.
    pub fn sigmas(&self) -> Vec<f64> {
        self.covariance.diagonal().iter().map(|variance| variance.sqrt()).collect()
    }

    /// Correlation coefficients.
    pub fn correlations(&self) -> DMatrix<f64> {
        let sigmas = self.sigmas();
        DMatrix::from_fn(sigmas.len(), sigmas.len(), |i, j| self.covariance[(i, j)] / (sigmas[i] * sigmas[j]))
    }

    /// The parameters with the unknowns displaced along the principal axes of their correlations, by `deviations` standard deviations along each, all
    /// times `factor`.
    ///
    /// # Errors
    /// [`Error::Domain`] for an unknown that the data do not determine; as for [`Model::moved`].
    pub fn displaced(&self, deviations: &DVector<f64>, factor: f64) -> Result<M, Error> {
        let correlations = self.correlations();
        for entry in &correlations {
            Error::ensure(
                entry.is_finite(),
                "correlation of unknowns",
                *entry,
                "finite; the data must determine the unknowns",
            )?;
        }
        let axes = correlations.symmetric_eigen();
        let along = deviations.zip_map(&axes.eigenvalues, |deviation, value| deviation * value.max(0.0).sqrt());
        let change = (axes.eigenvectors * along).component_mul(&DVector::from_vec(self.sigmas())) * factor;
        self.parameters.moved(&self.unknowns, change.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::functions::{A, B, Fraction, Numbers, exact};
    use crate::inference::{Observable, Place, stars};

    /// Correlated data of three numbers.
    fn rows() -> DMatrix<f64> {
        DMatrix::from_row_slice(4, 3, &[2.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.5, 0.0, 4.0, 1.0, 1.0, 1.0])
    }

    fn fisher() -> Fisher<Numbers> {
        Fisher::of_jacobian(&exact(rows()), &[A, B, Fraction], &Numbers::unbounded([1.0, 2.0, 0.5]))
    }

    #[test]
    fn the_covariance_is_the_inverse_of_the_fisher_matrix() {
        let fisher = fisher();
        let information = rows().transpose() * rows();
        assert!((&fisher.covariance * &information - DMatrix::identity(3, 3)).norm() < 1e-13);
        assert_eq!(fisher.values(), [1.0, 2.0, 0.5]);
        let (sigmas, correlations) = (fisher.sigmas(), fisher.correlations());
        for (i, name) in [A, B, Fraction].into_iter().enumerate() {
            assert_eq!(fisher.sigma(name), Some(sigmas[i]));
            assert!((sigmas[i].powi(2) - fisher.covariance[(i, i)]).abs() < 1e-15);
            for j in 0..3 {
                let product = correlations[(i, j)] * sigmas[i] * sigmas[j];
                assert!((product - fisher.covariance[(i, j)]).abs() < 1e-15);
            }
        }
        let of_two =
            Fisher::of_jacobian(&exact(rows().columns(0, 2).into_owned()), &[A, B], &Numbers::unbounded([0.0; 3]));
        assert_eq!(of_two.sigma(Fraction), None);
        assert!(fisher.determined().is_ok());
    }

    /// For a linear model, displacements by given numbers of standard deviations along the principal axes of the correlations add the sum of their
    /// squares to `chi^2`; the axes are orthogonal in units of the standard deviations.
    #[test]
    fn parameters_beside_are_so_many_standard_deviations_away() {
        let fisher = fisher();
        let change = |deviations: [f64; 3], factor: f64| {
            let beside = fisher.displaced(&DVector::from_row_slice(&deviations), factor).expect("all are determined");
            DVector::from_iterator(3, beside.values.into_iter().zip(fisher.values()).map(|(there, here)| there - here))
        };
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|one| change(one, 1.0));
        let sigmas = DVector::from_vec(fisher.sigmas());
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                let one = if i == j { 1.0 } else { 0.0 };
                assert!(((rows() * a).dot(&(rows() * b)) - one).abs() < 1e-12, "{i} {j}");
                let cosine = a.component_div(&sigmas).dot(&b.component_div(&sigmas));
                assert!(i == j || cosine.abs() < 1e-12, "{cosine}");
            }
        }
        assert!(((rows() * change([1.0, -2.0, 3.0], 0.5)).norm_squared() - 3.5).abs() < 1e-11);
        let opposite = change([1.0, -2.0, 3.0], -0.5) + change([1.0, -2.0, 3.0], 0.5);
        assert!(opposite.norm() < 1e-14);
    }

    #[test]
    fn fewer_data_than_unknowns_are_refused() {
        let star = stars::precessing();
        let datum =
            Datum { observable: Observable::StrainPlus, place: Place::Time(1.0), epoch: 0.0, value: 0.0, sigma: 1.0 };
        let refused = Fisher::of(&star, &[], &[datum], &[Parameter::Spin, Parameter::Beta]).expect_err("too few");
        assert_eq!(refused, InferenceError::TooFew { data: 1, least: 2 });
        assert!(Fisher::of(&star, &[], &[datum], &[Parameter::Spin]).is_ok());
    }

    #[test]
    fn what_is_not_determined_is_refused() {
        let of = |matrix: DMatrix<f64>, ranges: [f64; 3]| {
            Fisher::of_jacobian(&exact(matrix), &[A, B], &Numbers::new([0.0; 3], ranges))
        };
        let refused = |fisher: Fisher<Numbers>| match fisher.determined() {
            Err(InferenceError::Degenerate(directions)) => directions,
            other => panic!("{other:?}"),
        };
        let degenerate = of(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]), [1.0; 3]);
        assert!(degenerate.sigma(A).is_some_and(f64::is_nan));
        let beside = degenerate.displaced(&DVector::from_row_slice(&[1.0, 0.0]), 1.0);
        assert!(matches!(beside, Err(Error::Domain { quantity: "correlation of unknowns", .. })), "{beside:?}");
        assert!(refused(degenerate)[0].starts_with("d(a) : d(b) = 1.0000 : -0.5000"));
        let weak = of(DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 1.0]), [0.5, 2.0, 1.0]);
        assert!(weak.degenerate.is_empty());
        assert!(refused(weak)[0].starts_with("d(a) alone"));
        let both = of(DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]), [0.5, 2.0, 1.0]);
        assert_eq!(refused(both).len(), 2);
    }
}
