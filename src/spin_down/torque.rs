//! The braking torque of a wobbling star over one precession.

use crate::numerics::scalar::Scalar;

/// `sin^2 theta_m = constant + once cos(psi) + twice cos(2 psi)`, with `theta_m` the angle of the magnetic axis to `L`.
///
/// `psi` is the angle about `n` from the projection of the magnetic axis to the projection of `L`, both onto the plane normal to `n`:
/// `cos theta_m = cos theta cos chi + sin theta sin chi cos psi`, `theta` the wobble angle of `n` to `L` and `chi` the angle of the magnetic axis to
/// `n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueHarmonics<S> {
    /// Mean over a precession: `1 - cos^2 theta cos^2 chi - sin^2 theta sin^2 chi / 2`.
    pub constant: S,
    /// `-sin(2 theta) sin(2 chi) / 2`.
    pub once: S,
    /// `-sin^2 theta sin^2 chi / 2`.
    pub twice: S,
}

impl<S: Scalar> TorqueHarmonics<S> {
    /// The harmonics for the angles `theta` of the wobble and `chi` of the magnetic axis (rad).
    ///
    /// ```
    /// use twofold::spin_down::TorqueHarmonics;
    ///
    /// let (theta, chi, psi) = (0.3_f64, 1.2_f64, 2.1_f64);
    /// let found = TorqueHarmonics::new(theta, chi);
    /// let cos = theta.cos() * chi.cos() + theta.sin() * chi.sin() * psi.cos();
    /// let sum = found.constant + found.once * psi.cos() + found.twice * (2.0 * psi).cos();
    /// assert!((sum - (1.0 - cos * cos)).abs() < 1e-15);
    /// ```
    pub fn new(theta: S, chi: S) -> Self {
        let ((sin, cos), (s_chi, c_chi)) = (theta.sin_cos(), chi.sin_cos());
        let (along, across) = (cos * c_chi, sin * s_chi);
        let half = across * across * S::from_f64(0.5);
        // 1 - along^2 without the cancellation for both axes near L.
        let constant = sin * sin + cos * cos * s_chi * s_chi - half;
        Self { constant, once: -along * across * S::from_f64(2.0), twice: -half }
    }
}
