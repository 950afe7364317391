//! Comparison with a second derivation: SymPy derives the equations from the Lagrangian (`verify/oracles/symbolic/`), and its exact values at
//! rational points are stored in `verify/data/symbolic.json`. The comparison does not need Python.
//!
//! An angle of a point is given by `t = tan(angle / 2)`, so that any rational function of sines and cosines is rational in `t`. Such kernels
//! are compared twice: in the prime field, where a rational number has an exact image and nothing is rounded, and in doubles, in ulp of the
//! sum of the magnitudes of their terms. Kernels with roots or inverse functions are compared in doubles only.

use crate::prelude::*;

mod closed_kernels;
mod compare;
mod document;
mod kernels;
mod point;

pub(crate) use compare::{compare_closed, compare_doubles, compare_field};
pub use document::{Document, Layout};
pub use point::{Coded, RationalPoint};

/// The file that `verify/oracles/symbolic` writes.
pub const DATA: &str = include_str!("../../data/symbolic.json");

/// A kernel whose values are rational functions of its input, over the three types of numbers of the comparison.
#[derive(Clone, Copy)]
pub struct RationalKernel {
    /// Name of the quantity in the file.
    pub name: &'static str,
    /// Over the prime field.
    pub field: fn(&RationalPoint<Fp>) -> Vec<Fp>,
    /// In doubles.
    pub doubles: fn(&RationalPoint<f64>) -> Vec<f64>,
    /// With the magnitudes of the terms.
    pub conditioned: fn(&RationalPoint<Conditioned>) -> Vec<Conditioned>,
}

/// A kernel with roots or inverse functions, in doubles only. An error of a kernel is a failure of the comparison.
#[derive(Clone, Copy)]
pub struct ClosedKernel {
    /// Name of the quantity in the file.
    pub name: &'static str,
    /// Its components at a point.
    pub values: fn(&RationalPoint<f64>) -> Result<Vec<f64>, twofold::Error>,
}

/// All kernels with rational values.
pub fn rational_kernels() -> Vec<RationalKernel> {
    kernels::all()
}

/// All others.
pub fn closed_kernels() -> Vec<ClosedKernel> {
    closed_kernels::all()
}
