//! The averaged motion in any frame and over any span.

use nalgebra::Matrix3;

use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::{PrincipalCoefficients, principal_frame_with_derivatives};
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::Real;
use crate::propagation::input::check_time;
use crate::propagation::{Motion, Turning};
use crate::solutions::averaged::{AveragedSolution, AveragingOrder, OfRotations};

/// A motion by [`AveragedSolution`], of second order, for a tensor given in any frame: for a body whose rotation is fast compared with the effect of the
/// torque, over any number of turns.
#[derive(Debug, Clone, Copy)]
pub struct AveragedMotion<S> {
    problem: Problem<S>,
    span: (f64, f64),
    /// The motion in the principal frame of `s`, and its rates. Times are counted from the initial state.
    pub mean: AveragedSolution<S>,
    pub(in crate::propagation) given_from_principal: Matrix3<S>,
}

impl<S: Real> AveragedMotion<S> {
    /// The motion from the initial state at `span.0`.
    ///
    /// # Errors
    /// As for [`AveragedSolution::new`] and [`principal_frame_with_derivatives`].
    pub fn new(problem: &Problem<S>, span: (f64, f64)) -> Result<Self, Error> {
        Self::in_frame(problem, span, principal_frame_with_derivatives(problem.coefficients())?)
    }

    /// As [`new`](Self::new), with the eigenvalues of `s` and the proper rotation to its principal frame given. This is for derivatives, which
    /// include those of the frame (see [`principal_frame_along`](crate::lorentz_violation::principal_frame_along)).
    ///
    /// # Errors
    /// As for [`AveragedSolution::new`].
    pub fn in_frame(
        problem: &Problem<S>,
        span: (f64, f64),
        (coefficients, principal_from_given): (PrincipalCoefficients<S>, Matrix3<S>),
    ) -> Result<Self, Error> {
        let initial = problem.initial();
        let turned = initial.rotated(&principal_from_given);
        let principal = Problem::unchecked(*problem.spheroid(), coefficients.tensor(), turned);
        let principal = principal.with_bulge(problem.bulge())?;
        Ok(Self {
            problem: *problem,
            span,
            mean: AveragedSolution::with_free_rotation_of(initial, &principal, AveragingOrder::Second)?,
            given_from_principal: principal_from_given.transpose(),
        })
    }

    fn phases(&self, t: [f64; 2]) -> Result<OfRotations<S>, Error> {
        check_time(self.span, t[0] + t[1])?;
        let elapsed = DoubleDouble::sum(t[0], t[1]) + DoubleDouble::from(-self.span.0);
        Ok(self.mean.phases_at([elapsed.high, elapsed.low]))
    }

    pub(in crate::propagation) fn state_of(&self, phases: &OfRotations<S>) -> BodyState<S> {
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
        let later = |phases: OfRotations<S>| phases.later(&self.mean.rates, t - S::from_f64(t.re()));
        Ok(self.state_of(&if S::HAS_DERIVATIVES { later(phases) } else { phases }))
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<BodyState<S>, Error> {
        Ok(self.state_of(&self.phases(t)?))
    }

    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<S>, Error> {
        self.state_in_parts(t).map(|state| state.axis_state())
    }

    fn turning(&self) -> Turning<'_> {
        Turning::Equations { bulge: self.problem.bulge().re() }
    }

    /// The error estimate of the [averaged motion](AveragedSolution::error_estimate); the rounding of `t` itself is not
    /// included.
    fn error_estimate(&self, t: f64) -> f64 {
        self.mean.error_estimate(t - self.span.0)
    }
}

#[cfg(test)]
mod tests {
    use num_dual::Dual64;

    use super::*;
    use crate::dynamics::fixture::problem;
    use crate::propagation::SymmetricMotion;

    /// The derivative by the time is the slope between states a little before and after.
    #[test]
    fn a_state_has_a_derivative_by_the_time() {
        let problem = problem([2e-6, 1e-6, -3e-6]);
        let motion = AveragedMotion::new(&problem, (0.0, 100.0)).unwrap();
        let lifted = AveragedMotion::new(&problem.map(Dual64::from_re), (0.0, 100.0)).unwrap();
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
    /// With two equal eigenvalues `L` rests in their plane and moves slowly next to it: neighbouring solutions separate in proportion to time. The
    /// motion is compared with the elliptic solution, which is exact.
    #[test]
    fn the_error_in_the_plane_of_two_equal_eigenvalues_is_estimated() {
        for (off_plane, values) in
            [(0.0, [2e-6, 2e-6, -4e-6]), (1e-12, [4e-6, -2e-6, -2e-6]), (1e-9, [2e-6, 2e-6, -4e-6])]
        {
            let momentum = if values[1] > 0.0 { [2.0, 0.5, off_plane] } else { [off_plane, 2.0, 0.5] };
            let given = problem(values);
            let state = BodyState { momentum: momentum.into(), ..*given.initial() };
            let given = given.starting_from(state).unwrap();
            for end in [1e3, 1e6, 1e8] {
                let averaged = AveragedMotion::new(&given, (0.0, end)).unwrap();
                let exact = SymmetricMotion::new(&given, (0.0, end)).unwrap();
                let [found, expected] = [averaged.state(end), exact.state(end)].map(Result::unwrap);
                let error = (found.axis - expected.axis).norm().max((found.momentum - expected.momentum).norm() / 2.0);
                let stated = averaged.error_estimate(end);
                assert!(
                    error < stated + exact.error_estimate(end),
                    "{off_plane:e} {end:e}: {error:e}, stated {stated:e}"
                );
                assert!(stated < 1e-4, "{off_plane:e} {end:e}: {stated:e}");
            }
        }
    }
}
