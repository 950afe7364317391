//! A motion seen from another inertial frame.

use nalgebra::Matrix3;

use crate::dynamics::{AxisState, BodyState, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::propagation::{Motion, Turning};

/// The motion `inner` in components of another frame.
pub(super) struct Rotated<'m, M> {
    inner: &'m M,
    other_from_this: Matrix3<f64>,
    coefficients: Matrix3<f64>,
}

impl<'m, M: Motion<f64>> Rotated<'m, M> {
    pub(super) fn new(inner: &'m M, other_from_this: &Matrix3<f64>) -> Self {
        let coefficients = other_from_this * inner.coefficients() * other_from_this.transpose();
        Self { inner, other_from_this: *other_from_this, coefficients }
    }
}

impl<M: Motion<f64, State = BodyState<f64>>> Motion<f64> for Rotated<'_, M> {
    type State = BodyState<f64>;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        self.inner.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        &self.coefficients
    }

    fn span(&self) -> (f64, f64) {
        self.inner.span()
    }

    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        Ok(self.inner.state(t)?.rotated(&self.other_from_this))
    }

    fn axis_state(&self, t: f64) -> Result<AxisState<f64>, Error> {
        Ok(self.inner.axis_state(t)?.rotated(&self.other_from_this))
    }

    fn error_estimate(&self, t: f64) -> f64 {
        self.inner.error_estimate(t)
    }

    fn turning(&self) -> Turning<'_> {
        self.inner.turning().rotated(&self.other_from_this)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;
    use crate::observables::tests::Made;

    #[test]
    fn scalars_are_the_same_in_both_frames() {
        let given = BodyState {
            axis: Vector3::new(0.6, 0.0, 0.8),
            momentum: Vector3::new(0.3, -0.7, 1.1),
            equatorial_axis: Vector3::y(),
        };
        let motion = Made {
            coefficients: Matrix3::new(0.3, -0.5, 0.8, -0.5, 0.6, 0.35, 0.8, 0.35, -0.2),
            ..Made::new((0.0, 3.0), |_| Ok(given))
        };
        let turned = Rotated::new(&motion, Rotation3::from_euler_angles(0.3, -0.8, 1.7).matrix());
        let state = turned.state(1.0).unwrap();
        for (u, v, u_turned, v_turned) in [
            (given.axis, given.axis, state.axis, state.axis),
            (given.axis, given.momentum, state.axis, state.momentum),
            (given.momentum, given.equatorial_axis, state.momentum, state.equatorial_axis),
        ] {
            assert!(
                (u.dot(&(motion.coefficients * v)) - u_turned.dot(&(turned.coefficients() * v_turned))).abs() < 1e-14
            );
            assert!((u.dot(&v) - u_turned.dot(&v_turned)).abs() < 1e-14);
        }
        assert!((state.axis - given.axis).norm() > 0.1);
    }
}
