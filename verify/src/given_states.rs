//! A motion defined only by its states, as a user of the library could write one.

use crate::prelude::*;
use twofold::propagation::Turning;

/// `Omega`, `Omega'` and `Omega''` at a time, and bounds on `|Omega|` and its first five derivatives.
pub type Law = (fn(f64) -> [Vector3<f64>; 3], [f64; 6]);

/// A motion whose states a function gives. It has none of the faster implementations of the library's motions.
#[derive(Debug)]
pub struct GivenStates<F> {
    /// The body.
    pub spheroid: RigidSpheroid<f64>,
    /// The tensor `s^IJ`.
    pub violation: Matrix3<f64>,
    /// First and last time.
    pub span: (f64, f64),
    /// The state at a time.
    pub state: F,
    /// Rotation of the body, if prescribed.
    pub law: Option<Law>,
}

impl<F: Fn(f64) -> Result<BodyState<f64>, Error>> GivenStates<F> {
    /// A motion with the body, the tensor and the span of another one, under the equations of motion.
    pub fn like<M: Motion<f64, State = BodyState<f64>>>(motion: &M, state: F) -> Self {
        Self { spheroid: *motion.spheroid(), violation: *motion.coefficients(), span: motion.span(), state, law: None }
    }
}

impl<F: Fn(f64) -> Result<BodyState<f64>, Error>> Motion<f64> for GivenStates<F> {
    type State = BodyState<f64>;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        &self.spheroid
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        &self.violation
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        (self.state)(t)
    }

    fn error_estimate(&self, _t: f64) -> f64 {
        f64::NAN
    }

    fn turning(&self) -> Turning<'_> {
        match self.law {
            None => Turning::Equations { bulge: 0.0 },
            Some((rates, bounds)) => Turning::Given { rates: Box::new(move |t| Ok(rates(t))), bounds },
        }
    }
}
