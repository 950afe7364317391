//! The first-order equations by differentiation of Eq. (25) with all terms, and a solution inserted into them.

use crate::prelude::*;

/// The unperturbed motion, free precession or a stationary spin, with its rate of `alpha`: that of free precession without Lorentz violation,
/// or `a^(1)` of the slow precession of a stationary spin about Z with `s^XX = s^YY`, of first order in `s`.
pub type Unperturbed<F> = (ZerothOrder<F>, F);

/// All first-order terms of Eq. (25). The first equation is divided by `sin^2 beta_0`, like Eq. (29).
pub fn first_order_equations<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    unperturbed: &Unperturbed<F>,
    first: &FirstOrderMotion<F>,
) -> [F; 2] {
    let [of_alpha, of_beta] = match unperturbed.0.kind {
        Precession::Twofold => about_free_precession(spheroid, s, unperturbed, first),
        Precession::Single => about_stationary_spin(spheroid, s, unperturbed, first),
    };
    let (sin_beta, _) = unperturbed.0.beta.sin_cos();
    [of_alpha / (sin_beta * sin_beta), of_beta]
}

/// Derivative with respect to a small parameter along the unperturbed motion plus the parameter times the first order.
/// `s^IJ` is proportional to the parameter.
fn about_free_precession<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    (zeroth, rate): &Unperturbed<F>,
    first: &FirstOrderMotion<F>,
) -> [F; 2] {
    let small = |x| F::first(F::zero(), x);
    let motion = AxisAngles {
        // At first order the potential is evaluated along the zeroth order: alpha1 does not enter.
        alpha: F::fixed(zeroth.alpha),
        beta: F::first(zeroth.beta, first.beta),
        alpha_rate: F::first(*rate, first.alpha_rate),
        beta_rate: small(first.beta_rate),
    };
    let accelerations = (small(first.alpha_acceleration), small(first.beta_acceleration));
    let s = PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(small));
    let (of_alpha, of_beta) =
        euler_angle_residuals(&fixed_spheroid(spheroid), &s, F::fixed(zeroth.spin), &motion, accelerations);
    [F::derivative(of_alpha), F::derivative(of_beta)]
}

/// Two small parameters: `e1`, the size of `s` and of the rates, and `e2`, that of `beta1` and of `s^XX - s^YY` relative to
/// `2 s^ZZ - s^XX - s^YY`. The result has the terms in `e1` (the slow precession about Z) and in `e1 e2`. The accelerations
/// are those of the homogeneous motion, whose frequency is not small and whose amplitude counts as `e1 e2`; slow ones are of
/// the order `e1^2`.
fn about_stationary_spin<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    (zeroth, rate): &Unperturbed<F>,
    first: &FirstOrderMotion<F>,
) -> [F; 2] {
    let zero = F::zero();
    let both_small = |x| F::second(zero, zero, zero, x);
    let (mean, half) = ((s.xx + s.yy) / 2.0, (s.xx - s.yy) / 2.0);
    let s = PrincipalCoefficients {
        xx: F::second(zero, mean, zero, half),
        yy: F::second(zero, mean, zero, -half),
        zz: F::second(zero, s.zz, zero, zero),
    };
    let motion = AxisAngles {
        // The potential depends on alpha only through s^XX - s^YY: alpha1 adds terms in e1 e2^2.
        alpha: F::constant(zeroth.alpha),
        beta: F::second(zeroth.beta, zero, first.beta, zero),
        alpha_rate: F::second(zero, *rate, zero, first.alpha_rate - *rate),
        beta_rate: both_small(first.beta_rate),
    };
    let accelerations = (both_small(first.alpha_acceleration), both_small(first.beta_acceleration));
    let spheroid = spheroid.map(F::constant);
    let (of_alpha, of_beta) = euler_angle_residuals(&spheroid, &s, F::constant(zeroth.spin), &motion, accelerations);
    [of_alpha, of_beta].map(|residual| F::derivative_1(residual) + F::derivative_12(residual))
}

/// A solution as a first-order motion at `t = 0` with its phases at the zeroth-order rate of `alpha` and the homogeneous frequency
/// `nu`. The part that Eq. (32) adds to `a` returns to the rate of `alpha1`, as in Eq. (30).
pub fn first_order_motion<F: Differentiable>(solution: &Perturbation<F>, nu: F) -> FirstOrderMotion<F> {
    let Constants { alpha_0, amplitude, phase, .. } = solution.constants;
    // About a stationary spin the forced beta1 is divided by a^(1), and the homogeneous one is smaller by the order of s.
    let (rate, amplitude_of_beta) = match solution.kind {
        Precession::Twofold => (solution.zeroth_rate, amplitude),
        Precession::Single => (solution.rate, F::zero()),
    };
    let of_beta = Perturbation {
        constants: Constants { amplitude: amplitude_of_beta, ..solution.constants },
        rate,
        homogeneous_frequency: nu,
        ..*solution
    };
    let moving = Perturbation {
        kind: solution.kind,
        constants: fixed_constants(&solution.constants),
        omega: F::fixed(solution.omega),
        rate: F::fixed(rate),
        zeroth_rate: F::fixed(solution.zeroth_rate),
        forced_rate: F::fixed(solution.forced_rate),
        c_tilde: F::fixed(solution.c_tilde),
        eta_alpha: F::fixed(solution.eta_alpha),
        eta_beta: F::fixed(solution.eta_beta),
        homogeneous_frequency: F::fixed(nu),
        homogeneous_ratio: F::fixed(solution.homogeneous_ratio),
    };
    let (alpha_rate, beta_rate) =
        moving.first_order_rates(F::first(phase, nu), F::first(alpha_0, solution.zeroth_rate));
    FirstOrderMotion {
        beta: of_beta.first_order(phase, alpha_0).1,
        alpha_rate: solution.rate - solution.zeroth_rate + F::value(alpha_rate),
        beta_rate: F::value(beta_rate),
        alpha_acceleration: F::derivative(alpha_rate),
        beta_acceleration: F::derivative(beta_rate),
    }
}

/// Constants of integration with zero derivatives.
pub fn fixed_constants<F: Differentiable>(c: &Constants<F>) -> Constants<F::First> {
    let [alpha_0, beta_0, amplitude, phase] = [c.alpha_0, c.beta_0, c.amplitude, c.phase].map(F::fixed);
    Constants { alpha_0, beta_0, amplitude, phase }
}
