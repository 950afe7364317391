//! The exact motion as a Fourier series, in the frame of the caller and over a span.

use nalgebra::Matrix3;
use num_dual::Dual64;

use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::Motion;
use crate::propagation::input::{check_request, check_time};
use crate::solutions::torus::{TorusDerivative, TorusSolution};

/// A motion by [`TorusSolution`], for any anisotropic `s` off the separatrix; the cost of an evaluation does not depend on
/// the time.
#[derive(Debug, Clone)]
pub struct TorusMotion {
    problem: Problem<f64>,
    span: (f64, f64),
    solution: TorusSolution,
}

impl TorusMotion {
    /// The motion from the initial state at `span.0`, with the error tolerance `tolerance`.
    ///
    /// # Errors
    /// As for [`TorusSolution::new`], and [`Error::Domain`] for a tolerance out of its range.
    pub fn new(problem: &Problem<f64>, span: (f64, f64), tolerance: f64) -> Result<Self, Error> {
        check_request(span, tolerance)?;
        Ok(Self { problem: *problem, span, solution: TorusSolution::new(problem, tolerance, span.1 - span.0)? })
    }

    /// The series and their angles; times are counted from the initial state.
    pub(crate) fn solution(&self) -> &TorusSolution {
        &self.solution
    }

    /// States as functions of one parameter of the same problem: [`TorusDerivative`].
    ///
    /// # Errors
    /// As for [`TorusDerivative::new`]; at a time, [`Error::Domain`] for one outside the span.
    pub(crate) fn states_by(
        &self,
        problem: &Problem<Dual64>,
    ) -> Result<impl Fn([f64; 2]) -> Result<BodyState<Dual64>, Error>, Error> {
        let derivative = TorusDerivative::new(&self.solution, problem)?;
        Ok(move |t| Ok(derivative.state(self.elapsed(t)?)))
    }

    /// Time since the start, in two parts.
    fn elapsed(&self, t: [f64; 2]) -> Result<[f64; 2], Error> {
        check_time(self.span, t[0] + t[1])?;
        Ok((DoubleDouble::sum(t[0], t[1]) - DoubleDouble::from(self.span.0)).into())
    }
}

impl Motion<f64> for TorusMotion {
    type State = BodyState<f64>;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        self.problem.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        self.problem.coefficients()
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        Ok(self.solution.state(self.elapsed([t, 0.0])?))
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        Ok(self.solution.axis_state(self.elapsed([t, 0.0])?))
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<BodyState<f64>, Error> {
        Ok(self.solution.state(self.elapsed(t)?))
    }

    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<f64>, Error> {
        Ok(self.solution.axis_state(self.elapsed(t)?))
    }

    fn error_estimate(&self, t: f64) -> f64 {
        self.solution.error_estimate(t - self.span.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::problem;

    #[test]
    fn a_time_lies_in_the_span_with_both_its_parts() {
        let motion = TorusMotion::new(&problem([0.2, 0.1, -0.3]), (0.0, 100.0), 1e-9).unwrap();
        assert!(motion.elapsed([110.0, -20.0]).is_ok() && motion.elapsed([-20.0, 30.0]).is_ok());
        assert!(motion.elapsed([90.0, 20.0]).is_err() && motion.elapsed([60.0, -70.0]).is_err());
    }

    /// The solution accepts zero and large tolerances, too; the motion accepts only the tolerances that every other motion
    /// accepts.
    #[test]
    fn tolerances_that_are_none_are_refused() {
        let problem = problem([0.2, 0.1, -0.3]);
        for (tolerance, of_solution, of_motion) in [
            (1e-9, true, true),
            (0.0, true, false),
            (0.02, true, false),
            (-1.0, false, false),
            (f64::NAN, false, false),
        ] {
            assert_eq!(TorusSolution::new(&problem, tolerance, 1.0).is_ok(), of_solution, "{tolerance}");
            assert_eq!(TorusMotion::new(&problem, (0.0, 1.0), tolerance).is_ok(), of_motion, "{tolerance}");
        }
    }
}
