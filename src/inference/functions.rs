//! For tests: a model of three numbers, and data that are arbitrary functions of them. The result that a fit should find is
//! known in closed form.

use nalgebra::{DMatrix, DVector};

use super::least_squares::{Comparison, Fit};
use super::{InferenceError, Jacobian, Model, Observable, Symmetry, Unknown};
use crate::error::Error;

/// The names of the three numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Name {
    A,
    B,
    /// From 0 to 1.
    Fraction,
}

pub(super) use Name::{A, B, Fraction};

impl Unknown for Name {
    fn key(self) -> &'static str {
        self.symbol()
    }

    fn symbol(self) -> &'static str {
        match self {
            A => "a",
            B => "b",
            Fraction => "f",
        }
    }

    fn limits(self) -> (Option<f64>, Option<f64>) {
        if self == Fraction { (Some(0.0), Some(1.0)) } else { (None, None) }
    }
}

/// The three numbers, with their properties.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    pub(super) values: [f64; 3],
    pub(super) ranges: [f64; 3],
    pub(super) symmetries: Vec<Symmetry<Name>>,
}

impl Numbers {
    pub(super) fn new(values: [f64; 3], ranges: [f64; 3]) -> Self {
        Self { values, ranges, symmetries: Vec::new() }
    }

    /// With ranges so large that no direction is weak.
    pub(super) fn unbounded(values: [f64; 3]) -> Self {
        Self::new(values, [1e100; 3])
    }
}

impl Model for Numbers {
    type Unknown = Name;

    fn value(&self, unknown: Name) -> f64 {
        self.values[unknown as usize]
    }

    fn moved(&self, unknowns: &[Name], changes: &[f64]) -> Result<Self, Error> {
        let mut moved = self.clone();
        unknowns.iter().zip(changes).for_each(|(unknown, change)| moved.values[*unknown as usize] += change);
        Ok(moved)
    }

    fn range(&self, unknown: Name) -> f64 {
        self.ranges[unknown as usize]
    }

    fn symmetries(&self) -> Vec<Symmetry<Name>> {
        self.symmetries.clone()
    }
}

/// Data: residuals as functions of the three numbers, `None` where the model has no such data, and the derivatives of each.
pub(super) struct Functions {
    pub(super) count: usize,
    pub(super) residuals: fn([f64; 3]) -> Option<Vec<f64>>,
    pub(super) derivatives: fn([f64; 3]) -> Vec<[f64; 3]>,
    /// Whether all residuals are to be treated as rounding.
    pub(super) all_rounding: bool,
}

/// The error for residuals that are to be treated as rounding.
pub(super) const ROUNDING: InferenceError = InferenceError::Rounding { observable: Observable::Widths, rounding: 0.0 };

impl Comparison<Numbers> for Functions {
    fn len(&self) -> usize {
        self.count
    }

    fn residuals(&self, model: &Numbers) -> Result<Vec<f64>, InferenceError> {
        (self.residuals)(model.values).ok_or(InferenceError::NoPulse { turn: 0, near: 0.0 })
    }

    fn linearised(&self, model: &Numbers, unknowns: &[Name]) -> Result<(Vec<f64>, Jacobian), InferenceError> {
        let rows = (self.derivatives)(model.values);
        let matrix = DMatrix::from_fn(rows.len(), unknowns.len(), |row, column| rows[row][unknowns[column] as usize]);
        Ok((self.residuals(model)?, exact(matrix)))
    }

    fn rounding(&self, _: &Fit<Numbers>) -> Result<Option<InferenceError>, InferenceError> {
        Ok(self.all_rounding.then_some(ROUNDING))
    }
}

/// A Jacobian whose entries are accurate to a few roundings.
pub(super) fn exact(matrix: DMatrix<f64>) -> Jacobian {
    Jacobian { magnitudes: matrix.abs(), rounding: DVector::zeros(matrix.nrows()), matrix, relative_error: 1e-15 }
}
