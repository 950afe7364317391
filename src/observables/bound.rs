//! Bounds on Lorentz violation from a limit on the drift of the spin axis. Eqs. (40)-(42).
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::observables::bound::{SpinAxisDrift, eta_from_inclination, fluid_inertia_over_c, lambda_change, preferred_frame_bound};
//!
//! // The pulse width (rad) has changed by 1e-4 in 15 years: by Eq. (42), how far did the spin axis move?
//! let (lambda, chi, width, spin) = (2.0_f64, 0.8, 0.3, 4e3);
//! let cos_lambda_change = lambda.sin() * lambda_change(lambda, chi, width, 1e-4)?;
//! let drift = SpinAxisDrift { polar_inertia_over_c: fluid_inertia_over_c(spin), spin, interval: 4.7e8, cos_lambda_change };
//! let bound = drift.combination_bound(eta_from_inclination(2.5)?)?; // of |2 s^ZZ - s^XX - s^YY|
//! assert!(bound < 1e-14 && preferred_frame_bound(bound, &Vector3::new(0.0, 0.0, 1.2e-3))? > bound);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::Vector3;

use crate::error::Error;
use crate::lorentz_violation::squared_velocity;
use crate::numerics::scalar::{Real, Scalar};

/// An observed limit on the motion of the spin axis of a star: the largest change of `cos lambda` that the observations
/// allow, and the time between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpinAxisDrift<S> {
    /// `I^zz / C`, a time squared; for an estimate see [`inertia_over_c_estimate`](crate::star::estimates::inertia_over_c_estimate).
    pub polar_inertia_over_c: S,
    /// Spin `Omega^z`, an angular frequency in rad per unit of time.
    pub spin: S,
    /// Time `Delta t` between the observations.
    pub interval: S,
    /// Change of `cos lambda`, of either sign.
    pub cos_lambda_change: S,
}

impl<S: Real> SpinAxisDrift<S> {
    /// Bound `|2 s^ZZ - s^XX - s^YY| <~ eta |I^zz Omega^z Delta cos lambda / (C Delta t)|`, Eq. (41) `[est1]`.
    ///
    /// The paper's estimate sets the factors by which Eq. (38) depends on the directions to one. Then `eta` is
    /// [`eta_from_inclination`] for `beta_0` up to about 1.1; according to the paper it is at most 10.
    /// [`eta`](super::eta) gives the `eta` that corresponds to the root mean square of the drift, and
    /// [`eta_distribution`](super::eta_distribution) the value that `eta` does not exceed with a given probability. `eta`
    /// has no mean.
    ///
    /// # Errors
    /// [`Error::Domain`] for an interval of zero.
    pub fn combination_bound(&self, eta: S) -> Result<S, Error> {
        let interval = self.interval.re();
        Error::ensure(interval.abs() > 0.0, "interval Delta t", interval, "nonzero")?;
        Ok((eta * self.polar_inertia_over_c * self.spin * self.cos_lambda_change / self.interval).abs())
    }
}

/// `eta = 1 / |cos b0|`; with it Eq. (41) `[est1]` becomes the estimate (40) `[est]`. `beta_0` is the angle (rad) between the symmetry axis
/// and the principal axis of `s^IJ` about which it precesses.
///
/// # Errors
/// [`Error::Domain`] where `|cos b0|` is not above 2.2e-16. The perturbation solution behind it fails long before.
pub fn eta_from_inclination<S: Real>(beta_0: S) -> Result<S, Error> {
    let (_, cb) = beta_0.sin_cos();
    let allowed = "above 2.2e-16 in size; the estimate (40) divides by it";
    Error::ensure(cb.re().abs() > f64::EPSILON, "cosine of the mean inclination, cos beta_0", cb.re(), allowed)?;
    Ok(S::one() / cb.abs())
}

/// `I^zz / C = 4 / (Omega^z)^2` of a star whose oblateness is entirely due to its spin.
///
/// This is the virial relation `T_rot = 2 C` of a fluid star in equilibrium, which the paper derives from Eq. (14), with
/// `T_rot = I^zz (Omega^z)^2 / 2`: density profile, radius and the size of the oblateness do not matter. The errors are those of
/// Newtonian gravity and of treating the star as a fluid. Eq. (43) with Eq. (20) `[epf]` gives the same to first order in the
/// oblateness for a uniform star, whose `eps = (5/4) (Omega^z)^2 R^3 / M` (Eq. (20) sets the coefficient 5/4 to one). With this
/// `I^zz / C` and Eq. (5) `[replace]` the spin axis precesses about `w` at the right-handed rate
/// `-(alpha_2 / 2) |w|^2 Omega^z cos(beta)`, which has the magnitude of Nordtvedt's rate. The result is a time squared, with `spin`
/// in rad per unit of time.
pub fn fluid_inertia_over_c<S: Scalar>(spin: S) -> S {
    S::from_f64(4.0) / (spin * spin)
}

/// Bound on `|alpha_2|` of the PPN form, from a bound on `|2 s^ZZ - s^XX - s^YY|` and a given velocity `w` relative to the
/// preferred frame (units of c): `|alpha_2| <= combination / (2 |w|^2)`.
///
/// With the replacement (5) `[replace]` the tensor `-alpha_2 w w` is symmetric about `w` and the star precesses about `w`.
/// So Z lies along `w` and the combination is `-2 alpha_2 |w|^2`. The bound on the combination must be computed with
/// `beta_0` equal to the angle between the spin axis and `w`.
///
/// # Errors
/// [`Error::Domain`] for `|w|` below 1e-75.
pub fn preferred_frame_bound<S: Real>(combination_bound: S, w: &Vector3<S>) -> Result<S, Error> {
    let w2 = squared_velocity(w)?;
    Ok(combination_bound.abs() / (w2 * 2.0))
}

/// `cos rho = cos chi cos zeta + sin chi sin zeta cos(W/2)`: opening angle `rho` of the beam cone whose axis is at the angle
/// `chi` from the spin axis, if a pulse of width `W` is seen from the angle `zeta` between the spin axis and the direction
/// from the star to the observer (all rad).
pub fn cos_opening_angle<S: Scalar>(zeta: S, chi: S, width: S) -> S {
    let ((sz, cz), (sc, cc)) = (zeta.sin_cos(), chi.sin_cos());
    let (_, cos_half) = (width / 2.0).sin_cos();
    cc * cz + sc * sz * cos_half
}

/// Change of the paper's `lambda`, the angle between the spin axis and the direction **from** the observer to the star,
/// `lambda = pi - zeta`, for a small change of the pulse width `W`, Eq. (42) `[dela]` (all rad):
///
/// ```text
/// Delta lambda = (1/2) sin(W/2) / (cot lambda cos(W/2) + cot chi) Delta W
/// ```
///
/// If `lambda` of Eq. (37) is counted from `n-hat` of Eq. (46), it is `zeta`, and [`zeta_change_terms`] applies.
///
/// # Errors
/// [`Error::Domain`] where the denominator vanishes to rounding: there the width is stationary and does not constrain
/// `lambda`.
pub fn lambda_change<S: Real>(lambda: S, chi: S, width: S, width_change: S) -> Result<S, Error> {
    let [sine, turning] = lambda_change_terms(lambda, chi, width);
    Error::ensure(
        turning.re().abs() > f64::EPSILON,
        "derivative of cos rho by the angle to the line of sight",
        turning.re(),
        "above 2.2e-16 in size; where it is zero the width is stationary, and Eq. (42) divides by it",
    )?;
    Ok(sine / turning * width_change)
}

/// Numerator and denominator of `d zeta / d W` for the angle `zeta` between the spin axis and the direction from the star **to** the observer.
/// They follow from a constant [`cos_opening_angle`]; multiplied by `sin chi sin zeta`, they hold in an exact field:
/// `(1/2) sin chi sin zeta sin(W/2)` and `sin chi cos zeta cos(W/2) - cos chi sin zeta`.
pub fn zeta_change_terms<S: Scalar>(zeta: S, chi: S, width: S) -> [S; 2] {
    let ((sz, cz), (sc, cc)) = (zeta.sin_cos(), chi.sin_cos());
    let (sin_half, cos_half) = (width / 2.0).sin_cos();
    [sc * sz * sin_half / 2.0, sc * cz * cos_half - cc * sz]
}

/// Numerator and denominator of `d lambda / d W` in Eq. (42) `[dela]`; multiplied by `sin chi sin lambda`, they hold in an
/// exact field: `(1/2) sin chi sin lambda sin(W/2)` and `sin chi cos lambda cos(W/2) + cos chi sin lambda`.
pub fn lambda_change_terms<S: Scalar>(lambda: S, chi: S, width: S) -> [S; 2] {
    let ((sl, cl), (sc, cc)) = (lambda.sin_cos(), chi.sin_cos());
    let (sin_half, cos_half) = (width / 2.0).sin_cos();
    [sc * sl * sin_half / 2.0, sc * cl * cos_half + cc * sl]
}
