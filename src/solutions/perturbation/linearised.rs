//! First-order equations for `alpha1`, `beta1`: Eq. (29) as printed, and the full linearisation of Eq. (25).

use crate::dynamics::RigidSpheroid;
use crate::dynamics::potential::potential_gradient_in_angles;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::scalar::Scalar;
use crate::solutions::perturbation::Kind;

/// First-order parts of the angles and their time derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstOrderMotion<S> {
    /// `beta1` itself; `alpha1` does not enter.
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

/// The point about which is expanded: `alpha = alpha_0 + a t` (as `alpha`), `beta = beta_0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZerothOrder<S> {
    /// Upper signs (twofold) or lower signs (single).
    pub kind: Kind,
    /// Spin component `Omega^z`.
    pub spin: S,
    /// `alpha_0 + a t` [rad].
    pub alpha: S,
    /// `beta_0` [rad].
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

/// Residuals of the full first-order equations, the linearisation of Eq. (25) `[eleq]` about free precession or a stationary
/// spin: Eq. (29) and, in the second one for twofold precession, the term `a^2 sin^2(b0) beta1` with `a = omega / cos b0`.
///
/// It is the derivative by `beta` of `-(1/2) sin 2b a^2 + omega sin b a`, and of first order because `a` is not small. It
/// vanishes for single precession, where `a = 0`.
pub fn full_residuals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    zeroth: &ZerothOrder<S>,
    first: &FirstOrderMotion<S>,
) -> (S, S) {
    let (along_alpha, along_beta) = printed_residuals(spheroid, s, zeroth, first);
    let (sb, cb) = zeroth.beta.sin_cos();
    let missing = match zeroth.kind {
        Kind::Twofold => {
            let a = spheroid.free_precession_constant(zeroth.spin) / cb;
            a * a * sb * sb * first.beta
        }
        Kind::Single => S::zero(),
    };
    (along_alpha, along_beta + missing)
}
