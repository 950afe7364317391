//! What is asked of a scene.

use super::{Method, Output};
use crate::parameters::Parameter;

/// Times at which outputs are wanted, leading away from the start of the span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    /// How many.
    pub count: usize,
    /// The last of them.
    pub last: f64,
}

/// What is asked of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Outputs, none twice.
    pub outputs: Vec<Output>,
    /// Time of the initial state, and the end of what may be looked at.
    pub span: (f64, f64),
    /// Samples, for the outputs that have values at samples.
    pub samples: Samples,
    /// Largest error wanted in the components of `n`, `e_x` and of `L` in units of its size, rounding apart.
    pub tolerance: f64,
    /// The method to use, rather than the cheapest one.
    pub method: Option<Method>,
    /// Parameters by which derivatives of the outputs are wanted.
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
