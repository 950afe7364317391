//! The averaged motion in any frame and over any span.

use nalgebra::Matrix3;

use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::{PrincipalCoefficients, principal_frame_with_derivatives};
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::Real;
use crate::propagation::input::check_time;
use crate::propagation::{Motion, Turning};
use crate::solutions::averaged::{AveragedPhases, AveragedSolution, AveragingOrder};

/// A motion by [`AveragedSolution`] for a tensor given in any frame: for a body whose rotation is fast compared with the effect of the
/// torque, over any number of turns.
#[derive(Debug, Clone, Copy)]
pub struct AveragedMotion<S> {
    problem: Problem<S>,
    span: (f64, f64),
    /// Time of the initial state, in two parts.
    origin: [f64; 2],
    /// The motion in the principal frame of `s`, and its rates. Times are counted from the initial state, or from the epoch of
    /// [`near`](Self::near).
    pub mean: AveragedSolution<S>,
    pub(in crate::propagation) given_from_principal: Matrix3<S>,
}

impl<S: Real> AveragedMotion<S> {
    /// The motion from the initial state at `span.0`.
    ///
    /// # Errors
    /// As for [`AveragedSolution::new`] and [`principal_frame_with_derivatives`].
    pub fn new(problem: &Problem<S>, span: (f64, f64), order: AveragingOrder) -> Result<Self, Error> {
        Self::in_frame(problem, span, order, principal_frame_with_derivatives(problem.coefficients())?)
    }

    /// As [`new`](Self::new), with the eigenvalues of `s` and the proper rotation to its principal frame given. This is for derivatives, which
    /// include those of the frame (see [`principal_frame_along`](crate::lorentz_violation::principal_frame_along)).
    ///
    /// # Errors
    /// As for [`AveragedSolution::new`].
    pub fn in_frame(
        problem: &Problem<S>,
        span: (f64, f64),
        order: AveragingOrder,
        (coefficients, principal_from_given): (PrincipalCoefficients<S>, Matrix3<S>),
    ) -> Result<Self, Error> {
        let initial = problem.initial();
        let turned = initial.rotated(&principal_from_given);
        let principal = Problem::unchecked(*problem.spheroid(), coefficients.tensor(), turned);
        let principal = principal.with_bulge(problem.bulge())?;
        Ok(Self {
            problem: *problem,
            span,
            origin: [span.0, 0.0],
            mean: AveragedSolution::with_free_rotation_of(initial, &principal, order)?,
            given_from_principal: principal_from_given.transpose(),
        })
    }

    /// The same motion with the time counted from `epoch[0] + epoch[1]`: near the epoch a double is precise enough for a time, after any
    /// number of turns.
    ///
    /// # Errors
    /// [`Error::Domain`] for an epoch outside the span.
    pub fn near(&self, epoch: [f64; 2]) -> Result<Self, Error> {
        check_time(self.span, epoch[0] + epoch[1])?;
        let elapsed = self.elapsed(epoch);
        Ok(Self {
            span: (self.span.0 - epoch[0] - epoch[1], self.span.1 - epoch[0] - epoch[1]),
            origin: [0.0; 2],
            mean: self.mean.near(elapsed),
            ..*self
        })
    }

    /// Time since the one from which phases are counted.
    fn elapsed(&self, t: [f64; 2]) -> [f64; 2] {
        let sum = DoubleDouble::sum(t[0], t[1]) + DoubleDouble::sum(-self.origin[0], -self.origin[1]);
        [sum.high, sum.low]
    }

    fn phases(&self, t: [f64; 2]) -> Result<AveragedPhases<S>, Error> {
        check_time(self.span, t[0] + t[1])?;
        Ok(self.mean.phases_at(self.elapsed(t)))
    }

    pub(in crate::propagation) fn state_of(&self, phases: &AveragedPhases<S>) -> BodyState<S> {
        self.mean.state_at(phases).rotated(&self.given_from_principal)
    }
}

impl<S: Real> Motion<S> for AveragedMotion<S> {
    type State = BodyState<S>;

    fn spheroid(&self) -> &RigidSpheroid<S> {
        self.problem.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<S> {
        self.problem.coefficients()
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn state(&self, t: S) -> Result<BodyState<S>, Error> {
        let phases = self.phases([t.re(), 0.0])?;
        let later = |phases: AveragedPhases<S>| phases.later(&self.mean.rates, t - S::from_f64(t.re()));
        Ok(self.state_of(&if S::HAS_DERIVATIVES { later(phases) } else { phases }))
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<BodyState<S>, Error> {
        Ok(self.state_of(&self.phases(t)?))
    }

    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<S>, Error> {
        self.state_in_parts(t).map(|state| AxisState::from(&state))
    }

    fn turning(&self) -> Turning<'_> {
        Turning::Equations { bulge: self.problem.bulge().re() }
    }

    /// The error estimate of the [averaged motion](AveragedSolution::error_estimate); the rounding of `t` itself is not
    /// included.
    fn error_estimate(&self, t: f64) -> f64 {
        self.mean.error_estimate(t - self.origin[0])
    }
}

#[cfg(test)]
mod tests {
    use num_dual::Dual64;

    use super::*;
    use crate::dynamics::fixture::problem;

    /// The derivative by the time is the slope between states a little before and after.
    #[test]
    fn a_state_has_a_derivative_by_the_time() {
        let problem = problem([2e-6, 1e-6, -3e-6]);
        let motion = AveragedMotion::new(&problem, (0.0, 100.0), AveragingOrder::Second).unwrap();
        let lifted = AveragedMotion::new(&problem.map(Dual64::from_re), (0.0, 100.0), AveragingOrder::Second).unwrap();
        let (t, h) = (40.0, 1e-4);
        let found = lifted.state(Dual64::new(t, 1.0)).unwrap();
        let [before, after] = [t - h, t + h].map(|t| motion.state(t).unwrap());
        for (found, difference) in [
            (found.axis, after.axis - before.axis),
            (found.equatorial_axis, after.equatorial_axis - before.equatorial_axis),
        ] {
            let slope = difference / (2.0 * h);
            // The third derivative times h^2, and the rounding of a state over h.
            assert!(slope.norm() > 1e-2 && (found.map(|x| x.eps) - slope).norm() < 1e-7, "{found:?} {slope:?}");
        }
    }

    #[test]
    fn an_epoch_lies_in_the_span_with_both_its_parts() {
        let motion = AveragedMotion::new(&problem([2e-6, 1e-6, -3e-6]), (0.0, 100.0), AveragingOrder::Second).unwrap();
        let allows = |epoch| motion.near(epoch).is_ok();
        assert!(allows([110.0, -20.0]) && allows([40.0, 50.0]) && allows([-20.0, 30.0]));
        assert!(!allows([90.0, 20.0]) && !allows([60.0, -70.0]));
        let later = AveragedMotion::new(&problem([2e-6, 1e-6, -3e-6]), (10.0, 100.0), AveragingOrder::Second).unwrap();
        assert_eq!(later.near([30.0, 5.0]).unwrap().span, (-25.0, 65.0));
    }
}
