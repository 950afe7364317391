//! The first-order equations by differentiating Eq. (25) once, with nothing dropped, and a solution put into them.

use twofold::dynamics::RigidSpheroid;
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_residuals};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::linearised::FirstOrderMotion;
use twofold::solutions::perturbation::{Constants, Perturbation};

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

/// A solution as a first-order motion at `t = 0` with its phases at the zeroth-order rate `a` and the homogeneous frequency
/// `nu`. What Eq. (32) adds to `a` is put back into the rate of `alpha1`, where Eq. (30) has it.
pub fn first_order_motion<F: Differentiable>(solution: &Perturbation<F>, nu: F) -> FirstOrderMotion<F> {
    let shift = solution.rate - solution.zeroth_rate;
    let moving = Perturbation {
        constants: Constants {
            alpha_0: F::fixed(solution.constants.alpha_0),
            beta_0: F::fixed(solution.constants.beta_0),
            amplitude: F::fixed(solution.constants.amplitude),
            phase: F::fixed(solution.constants.phase),
        },
        omega: F::fixed(solution.omega),
        rate: F::fixed(solution.zeroth_rate),
        zeroth_rate: F::fixed(solution.zeroth_rate),
        forced_rate: F::fixed(solution.forced_rate),
        c_tilde: F::fixed(solution.c_tilde),
        eta_alpha: F::fixed(solution.eta_alpha),
        eta_beta: F::fixed(solution.eta_beta),
        homogeneous_frequency: F::fixed(nu),
        homogeneous_ratio: F::fixed(solution.homogeneous_ratio),
    };
    let phases = (F::first(solution.constants.phase, nu), F::first(solution.constants.alpha_0, solution.zeroth_rate));
    let (alpha_rate, beta_rate) = moving.first_order_rates(phases.0, phases.1);
    // At rest (single precession) Eq. (33) would divide by zero, and beta1 has no part in the equations.
    let beta =
        if solution.zeroth_rate.is_zero() { F::zero() } else { F::value(moving.first_order(phases.0, phases.1).1) };
    FirstOrderMotion {
        beta,
        alpha_rate: shift + F::value(alpha_rate),
        beta_rate: F::value(beta_rate),
        alpha_acceleration: F::derivative(alpha_rate),
        beta_acceleration: F::derivative(beta_rate),
    }
}
