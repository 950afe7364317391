//! The first-order equations by differentiating Eq. (25) once, with nothing dropped.

use twofold::dynamics::RigidSpheroid;
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_residuals};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::linearised::FirstOrderMotion;

use crate::derivation::Differentiable;
use crate::derivation::spheroid_motion::fixed_spheroid;

/// Zeroth order of a perturbed motion: `alpha' = rate`, `beta` constant, without Lorentz violation.
#[derive(Debug, Clone, Copy)]
pub struct UnperturbedMotion<F> {
    /// Spin component `Omega^z`.
    pub spin: F,
    /// Angle `alpha` at the moment.
    pub alpha: F,
    /// Inclination.
    pub beta: F,
    /// Rate of `alpha`.
    pub rate: F,
}

/// Derivative by a small parameter of the residuals of Eq. (25) along the zeroth order plus the parameter times the first
/// order, with `s^IJ` proportional to the parameter. The first equation is divided by `sin^2 beta_0`, as Eq. (29) is.
pub fn linearised_equations<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    zeroth: &UnperturbedMotion<F>,
    first: &FirstOrderMotion<F>,
) -> [F; 2] {
    let small = |x| F::first(F::zero(), x);
    let motion = AxisAngles {
        // At first order the potential is taken along the zeroth order: alpha1 does not enter.
        alpha: F::fixed(zeroth.alpha),
        beta: F::first(zeroth.beta, first.beta),
        alpha_rate: F::first(zeroth.rate, first.alpha_rate),
        beta_rate: small(first.beta_rate),
    };
    let accelerations = (small(first.alpha_acceleration), small(first.beta_acceleration));
    let s = PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(small));
    let (of_alpha, of_beta) =
        euler_angle_residuals(&fixed_spheroid(spheroid), &s, F::fixed(zeroth.spin), &motion, accelerations);
    let (sin_beta, _) = zeroth.beta.sin_cos();
    [F::derivative(of_alpha) / (sin_beta * sin_beta), F::derivative(of_beta)]
}
