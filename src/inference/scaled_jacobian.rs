//! Singular value decomposition of a Jacobian.

use nalgebra::{DMatrix, DVector};

use super::Jacobian;

/// A Jacobian with columns of unit length, decomposed.
pub(super) struct ScaledJacobian {
    /// Lengths of the columns.
    pub(super) lengths: DVector<f64>,
    /// Columns that are rounding only: the data do not depend on these unknowns.
    pub(super) idle: Vec<usize>,
    /// Singular values, largest first, without idle columns.
    pub(super) values: DVector<f64>,
    /// Right singular vectors as columns, in the order of the values; idle components are zero.
    pub(super) vectors: DMatrix<f64>,
    /// Largest value that rounding can give to a singular value that is zero.
    pub(super) rounding: f64,
}

impl ScaledJacobian {
    /// `ranges` are the largest possible changes of the unknowns.
    pub(super) fn new(jacobian: &Jacobian, ranges: &DVector<f64>) -> Self {
        let Jacobian { matrix, magnitudes, relative_error, rounding } = jacobian;
        let columns = matrix.ncols();
        let lengths = DVector::from_fn(columns, |j, _| matrix.column(j).norm());
        let errors: Vec<f64> = (0..columns).map(|j| relative_error * magnitudes.column(j).norm()).collect();
        let is_rounding =
            |j: usize| matrix.column(j).iter().zip(rounding).all(|(slope, least)| slope.abs() * ranges[j] <= *least);
        let (idle, used): (Vec<usize>, Vec<usize>) =
            (0..columns).partition(|&j| lengths[j] <= errors[j] || is_rounding(j));
        if used.is_empty() {
            let (values, vectors) = (DVector::zeros(0), DMatrix::zeros(columns, 0));
            return Self { lengths, idle, values, vectors, rounding: 0.0 };
        }
        let mut scaled = matrix.select_columns(&used);
        for (mut column, &j) in scaled.column_iter_mut().zip(&used) {
            column /= lengths[j];
        }
        let svd = scaled.svd(false, true);
        // Thin decomposition: as many vectors as columns, since there are at least as many rows.
        let rows = svd.v_t.expect("asked for");
        let mut vectors = DMatrix::zeros(columns, rows.nrows());
        for (place, &j) in used.iter().enumerate() {
            vectors.row_mut(j).copy_from(&rows.column(place).transpose());
        }
        // Weyl: no singular value changes by more than the norm of the perturbation of the matrix.
        let rounding = used.iter().map(|&j| (errors[j] / lengths[j]).powi(2)).sum::<f64>().sqrt();
        Self { lengths, idle, values: svd.singular_values, vectors, rounding }
    }

    /// Number of undetermined directions, without idle columns: they are the last ones.
    pub(super) fn nullity(&self) -> usize {
        self.values.iter().filter(|value| **value <= self.rounding).count()
    }

    /// `(J^T J)^-1` of the unknowns that no degenerate direction changes.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        /// A unit vector with a component below this does not affect the unknown: the resulting error bar is accurate to as many
        /// digits.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::functions::exact;

    /// Numbers that no datum depends on leave nothing to be decomposed.
    #[test]
    fn a_jacobian_of_zeros_has_no_singular_values() {
        let zeros = ScaledJacobian::new(&exact(DMatrix::zeros(4, 3)), &DVector::from_element(3, 1.0));
        assert_eq!((zeros.idle, zeros.values.len(), zeros.rounding), (vec![0, 1, 2], 0, 0.0));
        assert_eq!((zeros.vectors.nrows(), zeros.vectors.ncols(), zeros.lengths.len()), (3, 0, 3));
    }
}
