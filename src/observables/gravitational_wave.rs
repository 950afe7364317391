//! Metric perturbation of a rotating star in the quadrupole approximation. Eq. (59).

use nalgebra::Matrix3;

use crate::scalar::Scalar;

/// Metric perturbation `h^{IJ} = -(2 / r) ddot I^{IJ}` at the distance `r`, Eq. (59), geometrised units.
///
/// `ddot I^{IJ}` is the second time derivative of the moment-of-inertia tensor `I = integral rho (x.x delta - x x)`, from
/// [`wave_tensor`](crate::dynamics::inertia_tensor_rate::wave_tensor) or
/// [`spheroid_inertia_acceleration`](crate::dynamics::inertia_tensor_rate::spheroid_inertia_acceleration). The mass
/// quadrupole `integral rho x x` has the opposite sign up to a constant, hence the minus.
pub fn metric_perturbation<S: Scalar>(distance: S, inertia_acceleration: &Matrix3<S>) -> Matrix3<S> {
    -(inertia_acceleration * (S::from_f64(2.0) / distance))
}
