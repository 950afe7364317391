//! Gravitational wave of a rotating star in the quadrupole approximation. Eqs. (59), (69)-(71).
//!
//! The source is `ddot I^{IJ}`, the second time derivative of the moment-of-inertia tensor, from
//! [`wave_tensor`](crate::dynamics::wave_source::wave_tensor),
//! [`spheroid_inertia_acceleration`] or, for the free
//! waveform, [`free_inertia_acceleration`](crate::dynamics::wave_source::free_inertia_acceleration).
//!
//! Everything is in geometrised units, or in those of the paper with `I^xx = t_c = r = 1`, where `h` counts multiples of
//! [`strain_unit`].
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::observables::gravitational_wave::{metric_perturbation, polarization_tensors, polarizations, wave_of_state};
//! use twofold::{AxisState, Observer, RigidSpheroid, dynamics::wave_source::spheroid_inertia_acceleration};
//!
//! let (star, s, observer) = (RigidSpheroid::in_units_of_tc(1.1_f64), Matrix3::zeros(), Observer::at(0.8, 0.0));
//! let state = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(-0.7, 0.1, 1.5) };
//! let wave = wave_of_state(&star, &s, &state, &observer);
//! // Step by step, Eqs. (59), (69) and (71).
//! let h = metric_perturbation(1.0, &spheroid_inertia_acceleration(&star, &s, &state.axis, &state.momentum));
//! assert_eq!(wave, polarizations(&observer, &h));
//! let [plus, cross] = polarization_tensors(&observer);
//! assert!((wave.plus - h.dot(&plus) / 2.0).abs() < 1e-14 && (wave.cross - h.dot(&cross) / 2.0).abs() < 1e-14);
//! ```

use nalgebra::Matrix3;

use crate::dynamics::wave_source::spheroid_inertia_acceleration;
use crate::dynamics::{AxisState, RigidSpheroid};
use crate::numerics::scalar::{Real, Scalar};
use crate::observables::Observer;
use crate::units::geometrised::{KILOGRAM, METRE};

/// Metric perturbation `h^{IJ} = -(2 / r) ddot I^{IJ}` at the distance `r`, Eq. (59), geometrised units.
///
/// `ddot I^{IJ}` is the second time derivative of the moment-of-inertia tensor `I = integral rho (x.x delta - x x)`. The mass
/// quadrupole `integral rho x x` has the opposite sign up to a constant; this is the reason for the minus sign.
pub fn metric_perturbation<S: Scalar>(distance: S, inertia_acceleration: &Matrix3<S>) -> Matrix3<S> {
    -(inertia_acceleration * (S::from_f64(2.0) / distance))
}

/// The two polarizations of a wave at an observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polarizations<S> {
    /// `h_+`.
    pub plus: S,
    /// `h_x`.
    pub cross: S,
}

/// Polarization tensors `e_+ = theta theta - phi phi` and `e_x = theta phi + phi theta` of an observer, Eq. (69).
pub fn polarization_tensors<S: Scalar>(observer: &Observer<S>) -> [Matrix3<S>; 2] {
    let (theta, phi) = (&observer.theta_hat, &observer.phi_hat);
    let mixed = theta * phi.transpose();
    [theta * theta.transpose() - phi * phi.transpose(), mixed + mixed.transpose()]
}

/// `h_+ = (1/2) e_+^{IJ} h^{IJ}` and `h_x = (1/2) e_x^{IJ} h^{IJ}` at an observer in the same inertial frame as `h^{IJ}`,
/// symmetric, Eq. (71) `[hpluscross]`.
///
/// They are the components of its transverse and trace-free part, `h_+ e_+ + h_x e_x`.
pub fn polarizations<S: Scalar>(observer: &Observer<S>, metric_perturbation: &Matrix3<S>) -> Polarizations<S> {
    let [plus, cross] =
        polarization_tensors(observer).map(|tensor| tensor.component_mul(metric_perturbation).sum() / 2.0);
    Polarizations { plus, cross }
}

/// `h_+` and `h_x` of a spheroid under the tensor `s^IJ` in a state of rotation, for an observer at unit distance: Eqs. (59), (69)-(71) with
/// [`spheroid_inertia_acceleration`].
pub fn wave_of_state<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &AxisState<S>,
    observer: &Observer<S>,
) -> Polarizations<S> {
    let source = spheroid_inertia_acceleration(spheroid, s, &state.axis, &state.momentum);
    polarizations(observer, &metric_perturbation(S::one(), &source))
}

/// The strain that corresponds to one unit of `h`, `G I^xx / (c^4 t_c^2 r)`, from `I^xx` (kg m^2), `t_c` (s) and the
/// distance `r` (m): the factor for [`polarizations`] with `I^xx = 1`, `t_c = 1`, `r = 1`.
///
/// For `ddot I^{IJ}` in J (kg m^2 / s^2) it is the factor with `I^xx = t_c = 1`. Its accuracy is that of G, 2.2e-5.
///
/// ```
/// use twofold::observables::gravitational_wave::strain_unit;
/// use twofold::units::si::KILOPARSEC;
///
/// // 1e38 kg m^2, t_c = 1 ms, 1 kpc.
/// let unit: f64 = strain_unit(1e38, 1e-3, KILOPARSEC);
/// assert!((unit / 2.6777e-20 - 1.0).abs() < 1e-4);
/// ```
pub fn strain_unit<S: Real>(inertia_xx: S, time_unit: S, distance: S) -> S {
    // One of the two factors METRE in I^xx cancels with that of the distance.
    inertia_xx * (KILOGRAM * METRE) / (time_unit * time_unit * distance)
}
