//! Steady precession at constant inclination when `s^IJ` is symmetric about Z. Eq. (26).
//!
//! # Example
//!
//! ```
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::solutions::perturbation::Precession;
//! use twofold::solutions::steady::steady_precession_rate;
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1);
//! // Without Lorentz violation the two roots are free precession and rest.
//! let none = PrincipalCoefficients::new([0.0; 3]);
//! let rate = |kind| steady_precession_rate(kind, &star, &none, 1.0, 0.7_f64);
//! assert!((rate(Precession::Twofold)? - 1.1 / 0.7_f64.cos()).abs() < 1e-14);
//! assert_eq!(rate(Precession::Single)?, 0.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Real;
use crate::solutions::perturbation::Precession;

/// Rate `a'` of exact steady precession at constant `beta`, Eq. (26) `[sol1]` with `s^ZZ` read as `s^ZZ - s^XX` for
/// `s^XX = s^YY`:
///
/// ```text
/// a' = [ I^zz Omega^z +- sqrt((I^zz Omega^z)^2 - 8 (s^ZZ - s^XX) C I^xx cos^2 b) ] / (2 I^xx cos b)
/// ```
///
/// [`Precession::Twofold`] is the root that becomes free precession as `s -> 0`, [`Precession::Single`] the one that becomes a
/// stationary spin: the upper and lower sign for positive spin. The smaller root is computed from the product of the two, so
/// that neither loses digits however small `s` is.
///
/// Derivatives (duals) are within `s^XX = s^YY`: the common derivative of the two is taken from `s^XX`, that of `s^YY` is
/// ignored.
///
/// # Errors
/// [`Error::Domain`] if `s^XX != s^YY` (no steady precession exists), and if the root is not real; for the twofold root where
/// `|cos beta|` is not above 2.2e-16; for the single root where both the spin and the square root vanish.
pub fn steady_precession_rate<S: Real>(
    kind: Precession,
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    beta: S,
) -> Result<S, Error> {
    let asymmetry = s.asymmetry().re();
    Error::ensure(asymmetry == 0.0, "s^XX - s^YY", asymmetry, "zero; Eq. (26) holds for s symmetric about Z")?;
    let (_, cb) = beta.sin_cos();
    let momentum = spheroid.inertia_zz * spin;
    let well = (s.zz - s.xx) * spheroid.constant_c * spheroid.inertia_xx * cb * cb * 8.0;
    let radicand = momentum * momentum - well;
    Error::ensure(
        radicand.re() >= 0.0,
        "(I^zz Omega^z)^2 - 8 (s^ZZ - s^XX) C I^xx cos^2 beta",
        radicand.re(),
        "at least zero; below it there is no steady precession at this beta",
    )?;
    let root = if radicand.re() == 0.0 { S::zero() } else { radicand.sqrt() };
    let larger = (if momentum.re() < 0.0 { momentum - root } else { momentum + root }) / 2.0;
    match kind {
        Precession::Twofold => {
            Error::ensure(
                cb.re().abs() > f64::EPSILON,
                "cosine of the inclination, cos beta",
                cb.re(),
                "above 2.2e-16 in size for the twofold root of Eq. (26)",
            )?;
            Ok(larger / (spheroid.inertia_xx * cb))
        }
        Precession::Single => {
            Error::ensure(
                larger.re() != 0.0,
                "I^zz Omega^z",
                momentum.re(),
                "nonzero where the square root vanishes; the two roots are not distinct",
            )?;
            Ok((s.zz - s.xx) * spheroid.constant_c * cb * 2.0 / larger)
        }
    }
}

#[cfg(test)]
pub(crate) mod fixture {
    use super::*;
    use crate::dynamics::Problem;
    use crate::dynamics::fixture::{ANGLES, STAR};
    use crate::euler_angles::{EulerAngles, EulerRates};

    /// The star in steady precession about Z at the angle `beta`, with the spin `gamma-dot + alpha-dot cos beta`, and its rate `alpha-dot`.
    pub(crate) fn steady_precession(spin: f64, beta: f64) -> (Problem<f64>, f64) {
        let s = PrincipalCoefficients::new([0.2, 0.2, -0.4]);
        let rate = steady_precession_rate(Precession::Twofold, &STAR, &s, spin, beta).unwrap();
        let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
        (Problem::from_angles(STAR, s.tensor(), &EulerAngles { beta, ..ANGLES }, &rates).unwrap(), rate)
    }
}
