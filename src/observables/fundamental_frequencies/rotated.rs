//! A motion seen from another inertial frame.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::{AxisMotion, AxisState, Motion};

/// The motion `inner` in components of another frame.
pub(super) struct Rotated<'m, M> {
    inner: &'m M,
    other_from_this: Matrix3<f64>,
    violation: Matrix3<f64>,
}

impl<'m, M: Motion<f64>> Rotated<'m, M> {
    pub(super) fn new(inner: &'m M, other_from_this: &Matrix3<f64>) -> Self {
        let violation = other_from_this * inner.violation() * other_from_this.transpose();
        Self { inner, other_from_this: *other_from_this, violation }
    }
}

impl<M: AxisMotion<f64>> AxisMotion<f64> for Rotated<'_, M> {
    fn spheroid(&self) -> &RigidSpheroid<f64> {
        self.inner.spheroid()
    }

    fn violation(&self) -> &Matrix3<f64> {
        &self.violation
    }

    fn span(&self) -> (f64, f64) {
        self.inner.span()
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        Ok(self.inner.axis_state(t)?.rotated(&self.other_from_this))
    }

    fn error_estimate(&self, t: f64) -> f64 {
        self.inner.error_estimate(t)
    }
}

impl<M: Motion<f64>> Motion<f64> for Rotated<'_, M> {
    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        Ok(self.inner.state(t)?.rotated(&self.other_from_this))
    }
}
