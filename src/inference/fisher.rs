//! The Fisher matrix of data with independent errors: uncertainties, correlations, and what is not determined.
//!
//! The Fisher matrix is `F = J^T J` with the Jacobian `J` of the data, each in units of its standard deviation. It is never formed:
//! squaring would halve the digits. Everything is taken of the singular values of `J` with columns of unit length, which is within
//! the square root of the number of unknowns of the best scaling that there is (van der Sluis 1969).

use nalgebra::{DMatrix, DVector};

use super::degenerate::{directions, weak_directions};
use super::{Datum, Direction, Event, InferenceError, Jacobian, Model, Unknown, jacobian};

/// What data of given errors tell of unknowns.
#[derive(Debug, Clone)]
pub struct Fisher {
    /// The unknowns.
    pub unknowns: Vec<Unknown>,
    /// Their values.
    pub values: Vec<f64>,
    /// Number of data.
    pub data: usize,
    /// Singular values of the Jacobian with columns of unit length, largest first.
    pub singular_values: Vec<f64>,
    /// What rounding can make of a singular value that is zero.
    pub rounding: f64,
    /// Directions that the data do not determine at all: singular values below [`rounding`](Self::rounding).
    pub degenerate: Vec<Direction>,
    /// Directions along which the whole [`range`](Unknown::range) of the unknowns is less than one standard deviation of the data.
    pub weak: Vec<Direction>,
    /// Covariance of the unknowns. NaN in the rows and columns of those that a degenerate direction moves.
    pub covariance: DMatrix<f64>,
}

impl Fisher {
    /// For data of a model with its pulses.
    ///
    /// # Errors
    /// Those of [`jacobian`], and fewer data than unknowns.
    pub fn of(
        model: &Model<f64>,
        events: &[Event],
        data: &[Datum],
        unknowns: &[Unknown],
    ) -> Result<Self, InferenceError> {
        if data.len() < unknowns.len() {
            return Err(InferenceError::TooFew { data: data.len(), unknowns: unknowns.len() });
        }
        Ok(Self::of_jacobian(&jacobian(model, events, data, unknowns)?.weighted(data), unknowns, model))
    }

    /// From a Jacobian in units of the standard deviations.
    pub fn of_jacobian(jacobian: &Jacobian, unknowns: &[Unknown], model: &Model<f64>) -> Self {
        let scaled = ScaledJacobian::new(jacobian);
        let range = |unknown: &Unknown| unknown.range(model);
        let degenerate = directions(&scaled, unknowns, model);
        let weak = weak_directions(&scaled, unknowns, model, &unknowns.iter().map(range).collect::<Vec<_>>());
        Self {
            unknowns: unknowns.to_vec(),
            values: model.values(unknowns),
            data: jacobian.matrix.nrows(),
            covariance: scaled.covariance(),
            singular_values: scaled.values.iter().copied().collect(),
            rounding: scaled.rounding,
            degenerate,
            weak,
        }
    }

    /// Standard deviation of an unknown with all others unknown; NaN where it is not determined, none if it is none of the unknowns.
    pub fn sigma(&self, unknown: Unknown) -> Option<f64> {
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
}

/// A Jacobian with columns of unit length, decomposed.
pub(super) struct ScaledJacobian {
    /// Lengths of the columns.
    pub(super) lengths: DVector<f64>,
    /// Columns of which rounding is all: data do not depend on these unknowns.
    pub(super) idle: Vec<usize>,
    /// Singular values, largest first, idle columns left out.
    pub(super) values: DVector<f64>,
    /// Right singular vectors as columns, in the order of the values; idle components are zero.
    pub(super) vectors: DMatrix<f64>,
    /// What rounding can make of a singular value that is zero.
    pub(super) rounding: f64,
}

impl ScaledJacobian {
    pub(super) fn new(jacobian: &Jacobian) -> Self {
        let Jacobian { matrix, magnitudes, relative_error } = jacobian;
        let columns = matrix.ncols();
        let lengths = DVector::from_fn(columns, |j, _| matrix.column(j).norm());
        let errors: Vec<f64> = (0..columns).map(|j| relative_error * magnitudes.column(j).norm()).collect();
        let (idle, used): (Vec<usize>, Vec<usize>) = (0..columns).partition(|&j| lengths[j] <= errors[j]);
        if used.is_empty() {
            let (values, vectors) = (DVector::zeros(0), DMatrix::zeros(columns, 0));
            return Self { lengths, idle, values, vectors, rounding: 0.0 };
        }
        let mut scaled = matrix.select_columns(&used);
        for (mut column, &j) in scaled.column_iter_mut().zip(&used) {
            column /= lengths[j];
        }
        let svd = scaled.svd(false, true);
        // Thin: as many vectors as columns, since there are at least as many rows.
        let rows = svd.v_t.expect("asked for");
        let mut vectors = DMatrix::zeros(columns, rows.nrows());
        for (place, &j) in used.iter().enumerate() {
            vectors.row_mut(j).copy_from(&rows.column(place).transpose());
        }
        // Weyl: no singular value moves by more than the norm of what is added to the matrix.
        let rounding = used.iter().map(|&j| (errors[j] / lengths[j]).powi(2)).sum::<f64>().sqrt();
        Self { lengths, idle, values: svd.singular_values, vectors, rounding }
    }

    /// How many directions are not determined, idle columns left out: the last ones.
    pub(super) fn nullity(&self) -> usize {
        self.values.iter().filter(|value| **value <= self.rounding).count()
    }

    /// `(J^T J)^-1`, of the unknowns that no degenerate direction moves.
    fn covariance(&self) -> DMatrix<f64> {
        /// A unit vector with a component below this does not move the unknown: an error bar that it leaves is right to as many digits.
        const MOVED: f64 = 1e-4;
        let rank = self.values.len() - self.nullity();
        let size = self.lengths.len();
        let mut covariance = DMatrix::zeros(size, size);
        for k in 0..rank {
            let unit = self.vectors.column(k).component_div(&self.lengths) / self.values[k];
            covariance += &unit * unit.transpose();
        }
        let null = self.vectors.columns(rank, self.values.len() - rank);
        let moved = (0..size).filter(|j| self.idle.contains(j) || null.row(*j).norm() > MOVED);
        for j in moved {
            covariance.row_mut(j).fill(f64::NAN);
            covariance.column_mut(j).fill(f64::NAN);
        }
        covariance
    }
}
