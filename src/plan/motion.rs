//! Motions computed by the method of a plan.

use nalgebra::{Matrix3, Vector3};

use super::{Method, Output, Plan, Request, Work};
use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::propagation::splitting::{SplittingErrorAtEnd, SplittingMotion};
use crate::propagation::taylor::TaylorErrorAtEnd;
use crate::propagation::{
    AveragedMotion, Motion, SeriesProjection, SymmetricMotion, TaylorMotion, TorusMotion, Turning, UniformMotion,
};

/// A motion by any method, with the states of its problem.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time, and nothing on the heap")]
pub enum PlannedMotion<X = BodyState<f64>> {
    /// [`Method::Free`] or [`Method::Steady`].
    Uniform(UniformMotion<f64>),
    /// [`Method::Symmetric`].
    Symmetric(SymmetricMotion<f64>),
    /// [`Method::Averaged`].
    Averaged(AveragedMotion<f64>),
    /// [`Method::Torus`].
    Torus(TorusMotion),
    /// [`Method::Splitting`].
    Splitting(SplittingMotion<X>),
    /// [`Method::Taylor`].
    Taylor(TaylorMotion<f64, X>),
}

/// The error at the end of a numerical motion, from which the error of a motion that starts there continues to grow:
/// [`PlannedMotion::error_at_end`].
#[derive(Debug, Clone)]
pub struct ErrorAtEnd {
    time: f64,
    spheroid: RigidSpheroid<f64>,
    coefficients: Matrix3<f64>,
    error: Growing,
}

#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one at a time, and nothing on the heap")]
enum Growing {
    Taylor(TaylorErrorAtEnd),
    Splitting(SplittingErrorAtEnd),
}

/// Number of samples for which [`Problem::motion`] chooses the cheapest method.
const SAMPLES: usize = 1000;

impl<X: RotationState<f64>> Problem<f64, X> {
    /// The motion from the initial state at `span.0` to `span.1` (forwards or backwards), by the cheapest method that is predicted to meet
    /// the `tolerance`: the largest allowed error at the end in the components of `n`, `e_x` and of `L` in units of its size, excluding
    /// rounding.
    ///
    /// # Errors
    /// As for [`plan`](Self::plan) and [`taylor`](Self::taylor).
    pub fn motion(&self, span: (f64, f64), tolerance: f64) -> Result<PlannedMotion<X>, Error> {
        let output = if X::VECTORS == 3 { Output::EquatorialAxis } else { Output::AngularMomentum };
        self.plan(&Request::new(&[output], span, SAMPLES, tolerance))?.motion(self)
    }

    /// The motion from the initial state at `span.0`, by a given method.
    ///
    /// # Errors
    /// The errors of the method.
    pub fn motion_by(&self, method: Method, span: (f64, f64), tolerance: f64) -> Result<PlannedMotion<X>, Error> {
        // Closed forms give either type of state from a problem with e_x.
        let problem = self.with_equatorial_axis();
        Ok(match method {
            Method::Free => PlannedMotion::Uniform(UniformMotion::free(&problem, span)),
            Method::Steady => PlannedMotion::Uniform(UniformMotion::steady(&problem, span)?),
            Method::Symmetric => PlannedMotion::Symmetric(SymmetricMotion::new(&problem, span)?),
            Method::Averaged => PlannedMotion::Averaged(AveragedMotion::new(&problem, span)?),
            Method::Torus => PlannedMotion::Torus(TorusMotion::new(&problem, span, tolerance)?),
            Method::Splitting => PlannedMotion::Splitting(self.splitting(span, tolerance)?),
            Method::Taylor => PlannedMotion::Taylor(self.taylor(span, tolerance)?),
        })
    }

    /// The plan for a request: the cheapest of the methods whose [predicted error](super::Prediction::truncation) is at most the tolerance.
    ///
    /// A method requested by name is used if it is applicable at all, whatever its error, which [`prediction`](Plan::prediction)
    /// reports.
    ///
    /// # Errors
    /// [`Error::Domain`] for a requested method that the problem does not allow, and for requests that no method accepts
    /// (tolerance out of range).
    pub fn plan(&self, request: &Request) -> Result<Plan, Error> {
        Plan::new(self, request)
    }
}

impl<X: RotationState<f64>> PlannedMotion<X> {
    /// The error at the end of a numerical motion, for one that goes on from there; `None` for a closed form, which is exact from its own start.
    pub fn error_at_end(&self) -> Option<ErrorAtEnd> {
        let error = match self {
            Self::Taylor(motion) => Growing::Taylor(motion.error_at_end()),
            Self::Splitting(motion) => Growing::Splitting(motion.error_at_end()),
            Self::Uniform(_) | Self::Symmetric(_) | Self::Averaged(_) | Self::Torus(_) => return None,
        };
        let (time, spheroid, coefficients) = (self.span().1, *self.spheroid(), *self.coefficients());
        Some(ErrorAtEnd { time, spheroid, coefficients, error })
    }

    /// This motion with the error of another one that led to its start. A long numerical motion can thus be computed in parts, each of which
    /// states the [error](Motion::error_estimate) of all parts so far. The start must be the state at the end of the other motion,
    /// [made orthonormal](RotationState::orthonormal).
    ///
    /// # Errors
    /// [`Error::Unsupported`] for another method, another body or another time than those at the end of the other motion.
    pub fn continuing_from(self, earlier: ErrorAtEnd) -> Result<Self, Error> {
        let ErrorAtEnd { time, spheroid, coefficients, error } = earlier;
        let refused = |why| Err(Error::Unsupported { what: "motion that goes on from another", why });
        if time != self.span().0 || spheroid != *self.spheroid() || coefficients != *self.coefficients() {
            return refused("it must be of the same body and start at the time at which the other ends");
        }
        match (self, error) {
            (Self::Taylor(motion), Growing::Taylor(error)) => Ok(Self::Taylor(motion.with_initial_error(error))),
            (Self::Splitting(motion), Growing::Splitting(error)) => {
                Ok(Self::Splitting(motion.with_initial_error(error)))
            }
            _ => refused("both must use the same numerical method"),
        }
    }

    /// Steps and right-hand sides used so far.
    pub fn work(&self) -> Work {
        match self {
            Self::Uniform(_) | Self::Symmetric(_) | Self::Averaged(_) | Self::Torus(_) => Work::default(),
            Self::Splitting(motion) => Work::of_series(motion.step_count as usize, 2 * motion.scheme.stages()),
            Self::Taylor(motion) => Work::of_series(motion.step_count, motion.order),
        }
    }
}

/// Applies an expression to a motion, whichever its method.
macro_rules! by_any {
    ($planned:expr, $motion:ident => $work:expr) => {
        match $planned {
            PlannedMotion::Uniform($motion) => $work,
            PlannedMotion::Symmetric($motion) => $work,
            PlannedMotion::Averaged($motion) => $work,
            PlannedMotion::Torus($motion) => $work,
            PlannedMotion::Splitting($motion) => $work,
            PlannedMotion::Taylor($motion) => $work,
        }
    };
}

impl<X: RotationState<f64>> Motion<f64> for PlannedMotion<X> {
    type State = X;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        by_any!(self, motion => motion.spheroid())
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        by_any!(self, motion => motion.coefficients())
    }

    fn span(&self) -> (f64, f64) {
        by_any!(self, motion => motion.span())
    }

    fn state(&self, t: f64) -> Result<X, Error> {
        // Without e_x if it is not requested.
        Ok(X::from_vectors(if X::VECTORS == 3 {
            by_any!(self, motion => motion.state(t)?.vectors())
        } else {
            self.axis_state(t)?.vectors()
        }))
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        by_any!(self, motion => motion.axis_state(t))
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<X, Error> {
        Ok(X::from_vectors(if X::VECTORS == 3 {
            by_any!(self, motion => motion.state_in_parts(t)?.vectors())
        } else {
            self.axis_state_in_parts(t)?.vectors()
        }))
    }

    fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<f64>, Error> {
        by_any!(self, motion => motion.axis_state_in_parts(t))
    }

    fn error_estimate(&self, t: f64) -> f64 {
        by_any!(self, motion => motion.error_estimate(t))
    }

    fn turning(&self) -> Turning<'_> {
        by_any!(self, motion => motion.turning())
    }

    fn projection(&self, in_body: &Vector3<f64>, direction: &Vector3<f64>) -> Option<SeriesProjection<'_>> {
        by_any!(self, motion => motion.projection(in_body, direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    use crate::dynamics::RigidSpheroid;
    use crate::dynamics::fixture::problem;
    use crate::numerics::double_double::DoubleDouble;
    use crate::numerics::scalar::Real;
    use crate::propagation::splitting::GRADIENT_8_8_6;
    use crate::solutions::free::free_rotation;

    /// The law of rotation includes the bulge, and with it the derivatives of what an observer sees.
    #[test]
    fn a_star_with_a_bulge_turns_by_the_equations_that_have_it() {
        let problem = problem([2e-6, 1e-6, -3e-6]).with_bulge(0.2).unwrap();
        let motion = problem.motion((0.0, 10.0), 1e-9).unwrap();
        assert!(matches!(motion.turning(), Turning::Equations { bulge } if bulge == problem.bulge() && bulge != 0.0));
    }

    #[test]
    fn a_time_in_two_parts_is_their_sum() {
        let problem = problem([2e-6, 1e-6, -3e-6]);
        for method in [Method::Free, Method::Averaged, Method::Splitting, Method::Taylor] {
            let motion = problem.motion_by(method, (0.0, 10.0), 1e-9).unwrap();
            let (parts, sum) = (motion.state_in_parts([5.0, 0.375]).unwrap(), motion.state(5.375).unwrap());
            assert!((parts.axis - sum.axis).amax() < 1e-14, "{method:?}");
        }
    }

    /// `L` is almost normal to `n`: the rounding of `L.n` would turn `e_x` by 1e-13 in each unit of time.
    #[test]
    fn the_third_angle_of_a_needle_is_within_its_estimate() {
        let needle = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1e-3, constant_c: 1.0 };
        let axis = Vector3::new(0.36, -0.48, 0.8);
        let equatorial_axis = Vector3::new(0.8, 0.6, 0.0);
        let momentum = axis.cross(&Vector3::new(0.7, 0.1, -0.9)) - axis * 1e-3;
        let start = BodyState { axis, momentum, equatorial_axis };
        let problem = |s: [f64; 3]| Problem::new(needle, Matrix3::from_diagonal(&s.into()), start).unwrap();
        let (free, moved) = (problem([0.0; 3]), problem([0.2, 0.1, -0.3]));
        let [axis, momentum, equatorial_axis] = start.vectors().map(|v| v.map(DoubleDouble::from));
        let wide = BodyState { axis, momentum, equatorial_axis };
        let exact = free_rotation(&needle.map(DoubleDouble::from), &wide, 60.0.into());
        // For long spans the torus is computed with 32 digits.
        let long = moved.motion_by(Method::Torus, (0.0, 1e9), 1e-13).unwrap();
        for (problem, exact, methods) in [
            (free, exact.equatorial_axis.map(Real::re), &[Method::Free, Method::Steady][..]),
            (moved, long.state(60.0).unwrap().equatorial_axis, &[Method::Torus, Method::Splitting, Method::Taylor]),
        ] {
            for method in methods {
                let motion = problem.motion_by(*method, (0.0, 60.0), 1e-12).unwrap();
                let off = (motion.state(60.0).unwrap().equatorial_axis - exact).amax();
                let estimate = motion.error_estimate(60.0);
                assert!(off < estimate && off < 2e-13, "{method:?}: {off:e} {estimate:e}");
            }
        }
    }

    /// Estimated errors at two times, the middle of the last part but one and the end: of a motion in equal parts, and of the motion as a whole.
    fn in_parts_and_whole<X: RotationState<f64>>(
        problem: &Problem<f64, X>,
        (start, end): (f64, f64),
        parts: u32,
        motion: impl Fn(&Problem<f64, X>, (f64, f64)) -> PlannedMotion<X>,
    ) -> [[f64; 2]; 2] {
        let whole = motion(problem, (start, end));
        let length = (end - start) / f64::from(parts);
        let (mut problem, mut from, mut earlier) = (*problem, start, None);
        let (mut late, mut last) = ([0.0; 2], 0.0);
        for part in 1..=parts {
            let to = start + length * f64::from(part);
            let mut motion = motion(&problem, (from, to));
            if let Some(earlier) = earlier {
                motion = motion.continuing_from(earlier).unwrap();
            }
            if part + 1 == parts {
                late = [from + 0.5 * length, motion.error_estimate(from + 0.5 * length)];
            }
            last = motion.error_estimate(to);
            problem = problem.starting_from(motion.state(to).unwrap().orthonormal()).unwrap();
            (from, earlier) = (to, motion.error_at_end());
        }
        [[late[1], last], [late[0], end].map(|t| whole.error_estimate(t))]
    }

    /// Near the unstable middle axis an error grows by e^4 from one part to the next. The error of the parts is that of the motion as a whole,
    /// although the steps of the parts and the rounding between them differ.
    #[test]
    fn the_error_of_a_motion_goes_on_from_part_to_part() {
        let s = [0.2, 0.05, -0.15];
        let axis = Vector3::new(1e-12, 1.0, 2e-12).normalize();
        let (momentum, equatorial_axis) = (Vector3::new(1e-12, 0.0, 0.0), axis.cross(&Vector3::x()).normalize());
        let start = BodyState { axis, momentum, equatorial_axis };
        let problem = problem(s).starting_from(start).unwrap();
        fn compared([parts, whole]: [[f64; 2]; 2]) {
            for (part, whole) in parts.into_iter().zip(whole) {
                assert!((0.4..2.5).contains(&(part / whole)), "{part:e} {whole:e}");
            }
            assert!(whole[1] > 20.0 * whole[0] && whole[1] < 0.1, "{whole:?}");
        }
        // The tolerance of a part is in proportion to its length.
        let tolerance = |(from, to): (f64, f64)| 1e-13 * (to - from) / 60.0;
        compared(in_parts_and_whole(&problem, (-5.0, 55.0), 3, |problem, span| {
            PlannedMotion::Taylor(problem.taylor(span, tolerance(span)).unwrap())
        }));
        compared(in_parts_and_whole(&problem.reduced(), (-5.0, 55.0), 3, |problem, span| {
            PlannedMotion::Taylor(problem.taylor(span, tolerance(span)).unwrap())
        }));
        compared(in_parts_and_whole(&problem, (-5.0, 55.0), 3, |problem, span| {
            PlannedMotion::Splitting(problem.splitting_by(&GRADIENT_8_8_6, span, 0.03125).unwrap())
        }));
        compared(in_parts_and_whole(&problem.reduced(), (-5.0, 55.0), 3, |problem, span| {
            PlannedMotion::Splitting(problem.splitting_by(&GRADIENT_8_8_6, span, 0.03125).unwrap())
        }));
    }

    /// The error of a regular motion in many parts is that of the motion, too: each part takes over the error and adds its own once. The error of
    /// `e_x` is not compared for the Taylor series, as its rate about `n` is rounded in each part.
    #[test]
    fn the_error_of_many_parts_is_that_of_the_motion() {
        let problem = problem([2e-2, 1e-2, -3e-2]);
        let by_splitting = |problem: &Problem<f64>, span| {
            PlannedMotion::Splitting(problem.splitting_by(&GRADIENT_8_8_6, span, 0.125).unwrap())
        };
        let by_taylor = |problem: &Problem<f64, AxisState<f64>>, span: (f64, f64)| {
            PlannedMotion::Taylor(problem.taylor(span, 1e-10 * ((span.1 - span.0) / 1000.0).powi(2)).unwrap())
        };
        let splitting = in_parts_and_whole(&problem, (0.0, 1000.0), 100, by_splitting);
        let taylor = in_parts_and_whole(&problem.reduced(), (0.0, 1000.0), 100, by_taylor);
        // At each end `L` is rounded to half a unit, which after many turns is more than all that the steps of a Taylor series round.
        for ([parts, whole], most) in [(splitting, 2.0), (taylor, 8.0)] {
            for (part, whole) in parts.into_iter().zip(whole) {
                assert!((0.5..most).contains(&(part / whole)), "{splitting:?} {taylor:?}");
            }
        }
    }

    #[test]
    fn a_motion_goes_on_only_from_one_by_the_same_numerical_method() {
        let problem = problem([2e-6, 1e-6, -3e-6]);
        let motion = |method, span| problem.motion_by(method, span, 1e-9).unwrap();
        let earlier = motion(Method::Taylor, (0.0, 10.0)).error_at_end().unwrap();
        for (method, span, why) in [
            (Method::Splitting, (10.0, 20.0), "same numerical method"),
            (Method::Free, (10.0, 20.0), "same numerical method"),
            (Method::Taylor, (10.5, 20.0), "start at the time"),
        ] {
            let error = motion(method, span).continuing_from(earlier.clone()).unwrap_err().to_string();
            assert!(error.starts_with("motion that goes on from another: ") && error.contains(why), "{error}");
        }
        let other = super::tests::problem([2e-6, 1e-6, -4e-6]).motion_by(Method::Taylor, (10.0, 20.0), 1e-9).unwrap();
        assert!(other.continuing_from(earlier).unwrap_err().to_string().contains("same body"));
        assert!(motion(Method::Averaged, (0.0, 10.0)).error_at_end().is_none());
    }

    /// `n` and `L` do not depend on the arbitrary equatorial axis that a closed form of a reduced problem is given.
    #[test]
    fn a_reduced_motion_is_that_of_n_and_l() {
        for (method, s) in Method::ALL.into_iter().zip([[0.0; 3], [0.0; 3], [0.1, 0.1, -0.2], [0.02, 0.01, -0.03]]) {
            let problem = problem(s);
            let whole = problem.motion_by(method, (0.0, 10.0), 1e-9).unwrap();
            let reduced = problem.reduced().motion_by(method, (0.0, 10.0), 1e-9).unwrap();
            for t in [0.0, 0.7, 7.3] {
                assert_eq!(whole.axis_state(t).unwrap(), reduced.state(t).unwrap(), "{method:?}");
            }
        }
    }
}
