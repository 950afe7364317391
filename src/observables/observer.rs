//! Direction of a distant observer and the basis normal to it. Eqs. (46), (70).

use nalgebra::{Matrix3, Vector3};

use crate::numerics::scalar::Scalar;

/// A distant observer: three unit vectors in inertial components, `theta_hat x phi_hat = direction`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observer<S> {
    /// `n-hat`, from the star to the observer, Eq. (46).
    pub direction: Vector3<S>,
    /// `theta-hat_o`, towards growing colatitude, Eq. (70) `[thphinertial]`.
    pub theta_hat: Vector3<S>,
    /// `phi-hat_o`, towards growing azimuth, Eq. (70) `[thphinertial]`.
    pub phi_hat: Vector3<S>,
}

impl<S: Scalar> Observer<S> {
    /// The observer at colatitude `theta_o` and azimuth `phi_o` (rad) in X-Y-Z, Eqs. (46), (70) `[thphinertial]`:
    ///
    /// ```text
    /// n-hat     = ( sin t cos p, sin t sin p,  cos t)
    /// theta-hat = ( cos t cos p, cos t sin p, -sin t)
    /// phi-hat   = (-sin p,       cos p,        0    )
    /// ```
    ///
    /// Regular at the poles too, where `phi_o` only sets the orientation of the basis.
    pub fn at(theta_o: S, phi_o: S) -> Self {
        let (st, ct) = theta_o.sin_cos();
        let (sp, cp) = phi_o.sin_cos();
        Self {
            direction: Vector3::new(st * cp, st * sp, ct),
            theta_hat: Vector3::new(ct * cp, ct * sp, -st),
            phi_hat: Vector3::new(-sp, cp, S::zero()),
        }
    }

    /// The same observer in another inertial frame: every vector multiplied by the rotation `other_from_this`.
    pub fn rotated(&self, other_from_this: &Matrix3<S>) -> Self {
        Self {
            direction: other_from_this * self.direction,
            theta_hat: other_from_this * self.theta_hat,
            phi_hat: other_from_this * self.phi_hat,
        }
    }
}
