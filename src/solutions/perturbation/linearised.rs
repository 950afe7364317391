//! First-order equations for `alpha1`, `beta1`: Eq. (29) as printed, and with the terms that it omits.

use crate::dynamics::RigidSpheroid;
use crate::dynamics::potential::potential_gradient_in_angles;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;
use crate::solutions::perturbation::Precession;

/// First-order parts of the angles and their time derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstOrderMotion<S> {
    /// `beta1` itself, for single precession without its homogeneous part, which is of the order `s` times the rest.
    /// `alpha1` does not enter the equations.
    pub beta: S,
    /// Rate of `alpha1`, the constant `-+a^(1)` included.
    pub alpha_rate: S,
    /// Rate of `beta1`.
    pub beta_rate: S,
    /// Acceleration of `alpha1`.
    pub alpha_acceleration: S,
    /// Acceleration of `beta1`.
    pub beta_acceleration: S,
}

/// The expansion point: `alpha = alpha_0 + a t` (as `alpha`), `beta = beta_0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZerothOrder<S> {
    /// Upper signs (twofold) or lower signs (single).
    pub kind: Precession,
    /// Spin component `Omega^z`.
    pub spin: S,
    /// `alpha_0 + a t` (rad).
    pub alpha: S,
    /// `beta_0` (rad).
    pub beta: S,
}

/// Residuals of Eq. (29) `[eleq1]` as printed:
///
/// ```text
/// alpha1'' +- (omega / sin b0) beta1'  + (1/(I^xx sin^2 b0)) d(delta U)/d alpha
/// beta1''  -+ omega sin b0 alpha1'     + (1/I^xx)            d(delta U)/d beta
/// ```
pub fn printed_residuals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    zeroth: &ZerothOrder<S>,
    first: &FirstOrderMotion<S>,
) -> (S, S) {
    let (sb, _) = zeroth.beta.sin_cos();
    let omega = spheroid.free_precession_constant(zeroth.spin) * zeroth.kind.sign();
    let (by_alpha, by_beta) = potential_gradient_in_angles(spheroid.constant_c, s, zeroth.alpha, zeroth.beta);
    (
        first.alpha_acceleration + omega / sb * first.beta_rate + by_alpha / (spheroid.inertia_xx * sb * sb),
        first.beta_acceleration - omega * sb * first.alpha_rate + by_beta / spheroid.inertia_xx,
    )
}

/// Residuals of the full first-order equations: Eq. (29) `[eleq1]` plus, on the left of the second one, the term in `beta1`
/// that it omits by setting `beta` to `beta_0`,
///
/// ```text
/// twofold:  a^2 sin^2(b0) beta1,                          a = omega / cos b0
/// single:   (C / I^xx) (2 s^ZZ - s^XX - s^YY) sin^2(b0) beta1
/// ```
///
/// Twofold: the linearisation of Eq. (25) `[eleq]` about free precession. The term is the derivative with respect to `beta`
/// of `-(1/2) sin 2b a^2 + omega sin b a`, and is of first order because `a` is not small.
///
/// Single: Eq. (25) at leading order in `s` and at first order in `r = (s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)`, the size of
/// `beta1`. The term is the derivative with respect to `beta` of `omega sin b a^(1) + (1/I^xx) d(delta U)/d beta` without
/// `s^XX - s^YY`. It is of the order `s r`, like the terms with `s^XX - s^YY` that Eq. (29) keeps.
pub fn full_residuals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    zeroth: &ZerothOrder<S>,
    first: &FirstOrderMotion<S>,
) -> (S, S) {
    let (along_alpha, along_beta) = printed_residuals(spheroid, s, zeroth, first);
    let (sb, cb) = zeroth.beta.sin_cos();
    let stiffness = match zeroth.kind {
        Precession::Twofold => {
            let a = spheroid.free_precession_constant(zeroth.spin) / cb;
            a * a
        }
        Precession::Single => spheroid.constant_c * s.combination() / spheroid.inertia_xx,
    };
    (along_alpha, along_beta + stiffness * sb * sb * first.beta)
}
