//! A request: outputs, span, samples and tolerance.

use super::{Method, Output};
use crate::parameters::Parameter;

/// A request for the computation of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The outputs, without repetition.
    pub outputs: Vec<Output>,
    /// Time of the initial state, and the end of the span.
    pub span: (f64, f64),
    /// Number of samples from the first to the last time of the span, for the outputs that have values at samples.
    pub samples: usize,
    /// Error tolerance in the components of `n`, `e_x` and of `L` in units of its size, excluding rounding.
    pub tolerance: f64,
    /// The method to use instead of the cheapest one.
    pub method: Option<Method>,
    /// Parameters with respect to which derivatives of the outputs are requested.
    pub derivatives: Vec<Parameter>,
}

impl Request {
    /// A request for `outputs` by the cheapest method, without derivatives.
    pub fn new(outputs: &[Output], span: (f64, f64), samples: usize, tolerance: f64) -> Self {
        Self { outputs: outputs.to_vec(), span, samples, tolerance, method: None, derivatives: Vec::new() }
    }
}
