//! A request: outputs, span, samples and tolerance.

use super::{Method, Output};
use crate::parameters::Parameter;

/// Times at which outputs are requested, in order away from the start of the span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    /// Number of samples.
    pub count: usize,
    /// The last sample.
    pub last: f64,
}

/// A request for the computation of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The outputs, without repetition.
    pub outputs: Vec<Output>,
    /// Time of the initial state, and the end of the span that may be used.
    pub span: (f64, f64),
    /// Samples, for the outputs that have values at samples.
    pub samples: Samples,
    /// Error tolerance in the components of `n`, `e_x` and of `L` in units of its size, excluding rounding.
    pub tolerance: f64,
    /// The method to use instead of the cheapest one.
    pub method: Option<Method>,
    /// Parameters with respect to which derivatives of the outputs are requested.
    pub derivatives: Vec<Parameter>,
}

impl Request {
    /// A request for `outputs` at `count` samples from the first to the last time of the span.
    pub fn new(outputs: &[Output], span: (f64, f64), count: usize, tolerance: f64) -> Self {
        Self {
            outputs: outputs.to_vec(),
            span,
            samples: Samples { count, last: span.1 },
            tolerance,
            method: None,
            derivatives: Vec::new(),
        }
    }
}
