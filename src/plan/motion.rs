//! Motions by the method of a plan.

use nalgebra::{Matrix3, Vector3};

use super::{Method, Work};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::splitting::{
    SplittingMotion, propagate_by_best_splitting, propagate_orientation_by_best_splitting,
};
use crate::propagation::{
    AveragedMotion, AxisMotion, AxisState, Motion, SeriesProjection, SymmetricMotion, TaylorAxisMotion, TaylorMotion,
    Turning, UniformMotion, propagate, propagate_axis,
};
use crate::solutions::mean::MeanOrder;

/// A motion of the symmetry axis and the angular momentum, by any method.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time, and nothing on the heap")]
pub enum PlannedAxisMotion {
    /// [`Method::Free`] or [`Method::Steady`].
    Uniform(UniformMotion<f64>),
    /// [`Method::Symmetric`].
    Symmetric(SymmetricMotion<f64>),
    /// [`Method::Mean`].
    Mean(AveragedMotion<f64>),
    /// [`Method::Splitting`].
    Splitting(SplittingMotion),
    /// [`Method::Taylor`].
    Taylor(TaylorAxisMotion<f64>),
}

/// A motion of the full orientation, by any method that has it.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time, and nothing on the heap")]
pub enum PlannedMotion {
    /// [`Method::Free`] or [`Method::Steady`].
    Uniform(UniformMotion<f64>),
    /// [`Method::Symmetric`].
    Symmetric(SymmetricMotion<f64>),
    /// [`Method::Mean`].
    Mean(AveragedMotion<f64>),
    /// [`Method::Splitting`].
    Splitting(SplittingMotion<3>),
    /// [`Method::Taylor`].
    Taylor(TaylorMotion<f64>),
}

impl PlannedAxisMotion {
    /// The motion from `initial` at `span.0`, by a given method.
    ///
    /// # Errors
    /// Those of the method.
    pub fn by(
        method: Method,
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        initial: &BodyState<f64>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error> {
        Ok(match method {
            Method::Free => Self::Uniform(UniformMotion::free(spheroid, s, initial, span)),
            Method::Steady => Self::Uniform(UniformMotion::steady(spheroid, s, initial, span)?),
            Method::Symmetric => Self::Symmetric(SymmetricMotion::new(spheroid, s, initial, span)?),
            Method::Mean => Self::Mean(AveragedMotion::new(spheroid, s, initial, span, MeanOrder::Second)?),
            Method::Splitting => {
                let initial = AxisState::from(initial);
                Self::Splitting(propagate_by_best_splitting(spheroid, s, &initial, span, accuracy)?)
            }
            Method::Taylor => Self::Taylor(propagate_axis(spheroid, s, &AxisState::from(initial), span, accuracy)?),
        })
    }

    /// Steps and right-hand sides that it took.
    pub fn work(&self) -> Work {
        match self {
            Self::Uniform(_) | Self::Symmetric(_) | Self::Mean(_) => Work::default(),
            Self::Splitting(motion) => Work::of_splitting(motion),
            Self::Taylor(motion) => Work::of_series(motion.step_count(), motion.order()),
        }
    }
}

impl PlannedMotion {
    /// The motion from `initial` at `span.0`, by a given method.
    ///
    /// # Errors
    /// Those of the method.
    pub fn by(
        method: Method,
        spheroid: &RigidSpheroid<f64>,
        s: &Matrix3<f64>,
        initial: &BodyState<f64>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error> {
        Ok(match method {
            Method::Free => Self::Uniform(UniformMotion::free(spheroid, s, initial, span)),
            Method::Steady => Self::Uniform(UniformMotion::steady(spheroid, s, initial, span)?),
            Method::Symmetric => Self::Symmetric(SymmetricMotion::new(spheroid, s, initial, span)?),
            Method::Mean => Self::Mean(AveragedMotion::new(spheroid, s, initial, span, MeanOrder::Second)?),
            Method::Splitting => {
                Self::Splitting(propagate_orientation_by_best_splitting(spheroid, s, initial, span, accuracy)?)
            }
            Method::Taylor => Self::Taylor(propagate(spheroid, s, initial, span, accuracy)?),
        })
    }

    /// Steps and right-hand sides that it took.
    pub fn work(&self) -> Work {
        match self {
            Self::Uniform(_) | Self::Symmetric(_) | Self::Mean(_) => Work::default(),
            Self::Splitting(motion) => Work::of_splitting(motion),
            Self::Taylor(motion) => Work::of_series(motion.step_count(), motion.order()),
        }
    }
}

/// The arms of both: the enums differ in what the numerical methods carry.
macro_rules! planned {
    ($planned:ident, $($method:ident),+) => {
        impl AxisMotion<f64> for $planned {
            fn spheroid(&self) -> &RigidSpheroid<f64> {
                match self {
                    $(Self::$method(motion) => motion.spheroid(),)+
                }
            }

            fn violation(&self) -> &Matrix3<f64> {
                match self {
                    $(Self::$method(motion) => motion.violation(),)+
                }
            }

            fn span(&self) -> (f64, f64) {
                match self {
                    $(Self::$method(motion) => motion.span(),)+
                }
            }

            fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
                match self {
                    $(Self::$method(motion) => motion.axis_state(t),)+
                }
            }

            fn axis_state_in_parts(&self, t: [f64; 2]) -> Result<AxisState<f64>, Error> {
                match self {
                    $(Self::$method(motion) => motion.axis_state_in_parts(t),)+
                }
            }

            fn error_estimate(&self, t: f64) -> f64 {
                match self {
                    $(Self::$method(motion) => motion.error_estimate(t),)+
                }
            }
        }
    };
}

planned!(PlannedAxisMotion, Uniform, Symmetric, Mean, Splitting, Taylor);
planned!(PlannedMotion, Uniform, Symmetric, Mean, Splitting, Taylor);

impl Motion<f64> for PlannedMotion {
    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        match self {
            Self::Uniform(motion) => motion.state(t),
            Self::Symmetric(motion) => motion.state(t),
            Self::Mean(motion) => motion.state(t),
            Self::Splitting(motion) => motion.state(t),
            Self::Taylor(motion) => motion.state(t),
        }
    }

    fn state_in_parts(&self, t: [f64; 2]) -> Result<BodyState<f64>, Error> {
        match self {
            Self::Mean(motion) => motion.state_in_parts(t),
            _ => self.state(t[0] + t[1]),
        }
    }

    fn turning(&self) -> Turning<'_> {
        Turning::Equations
    }

    fn projection(&self, in_body: &Vector3<f64>, direction: &Vector3<f64>) -> Option<SeriesProjection<'_>> {
        match self {
            Self::Uniform(motion) => motion.projection(in_body, direction),
            Self::Symmetric(motion) => motion.projection(in_body, direction),
            Self::Mean(motion) => motion.projection(in_body, direction),
            Self::Splitting(motion) => motion.projection(in_body, direction),
            Self::Taylor(motion) => motion.projection(in_body, direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::euler_angles::{EulerAngles, EulerRates};

    #[test]
    fn a_time_in_two_parts_is_their_sum() {
        let star = RigidSpheroid::in_units_of_tc(1.1);
        let s = Matrix3::from_diagonal(&Vector3::new(2e-6, 1e-6, -3e-6));
        let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
        let initial = BodyState::from_angles(&star, &angles, &EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 });
        for method in [Method::Free, Method::Mean, Method::Splitting, Method::Taylor] {
            let motion = PlannedMotion::by(method, &star, &s, &initial, (0.0, 10.0), 1e-9).unwrap();
            let (parts, sum) = (motion.state_in_parts([5.0, 0.375]).unwrap(), motion.state(5.375).unwrap());
            assert!((parts.axis - sum.axis).amax() < 1e-14, "{method:?}");
        }
    }
}
