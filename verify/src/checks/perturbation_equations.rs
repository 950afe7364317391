//! The perturbation solutions and the equations that they solve. Eqs. (27)-(33).

use crate::derivation::first_order::{Unperturbed, first_order_equations, first_order_motion, fixed_constants};
use crate::derivation::spheroid_motion::fixed_coefficients;
use crate::prelude::*;

checks! {
    /// the full first-order equations are the terms of first order of Eq. (25), about free precession and about a stationary spin
    linearisation: Autodiff "full-first-order-equations" [25, 27, 28, 29];
    /// Eq. (29) as printed lacks in the second equation, and only there, a^2 sin^2(b0) beta1 for the upper signs and (C / I^xx) (2 s^ZZ - s^XX -
    /// s^YY) sin^2(b0) beta1 for the lower ones
    term_that_is_missing: Autodiff "missing-first-order-term" [25, 27, 28, 29];
    /// the printed rates solve the printed Eq. (29), both signs, any A and phi
    printed_solution: Autodiff "printed-perturbation-solution" [28, 29, 30, 31, 32];
    /// the corrected solutions solve the full first-order equations, both kinds, any A and phi
    corrected_solution: Autodiff "corrected-perturbation-solution" [25, 27, 28, 30, 31, 32, 33];
    /// the rates are the time derivatives of the angles, both kinds, printed and corrected, any A and phi
    rates_of_angles: Autodiff "perturbed-angles" [27, 30, 32, 33];
}

pub(super) const KINDS: [Precession; 2] = [Precession::Twofold, Precession::Single];

pub(super) const FORMS: [Form; 2] = [Form::Printed, Form::Corrected];

pub(super) fn constants<F: Scalar>(p: &Point<F>) -> Constants<F> {
    Constants {
        alpha_0: p.angles.alpha,
        beta_0: p.angles.beta,
        amplitude: p.numbers[0],
        // The phase is coded like every other angle.
        phase: p.angles.gamma,
    }
}

/// The unperturbed motions: free precession has `L` along Z, `I^zz Omega^z = L cos b`, `a = L / I^xx`, Eq. (28). The torque of a
/// tensor with `s^XX = s^YY` turns a spinning star about Z at `a^(1)`, Eq. (31).
pub(super) fn unperturbed_motion<F: Scalar>(kind: Precession, p: &Point<F>) -> Unperturbed<F> {
    let (_, cos_beta) = p.angles.beta.sin_cos();
    let momentum = p.spheroid.inertia_zz * p.rates.gamma;
    let rate = match kind {
        Precession::Twofold => momentum / cos_beta / p.spheroid.inertia_xx,
        Precession::Single => p.spheroid.constant_c * p.s.combination() * cos_beta / momentum,
    };
    (ZerothOrder { kind, spin: p.rates.gamma, alpha: p.angles.alpha, beta: p.angles.beta }, rate)
}

/// Any first-order motion, solution or not.
fn any_first_order<F: Scalar>(p: &Point<F>) -> FirstOrderMotion<F> {
    FirstOrderMotion {
        beta: p.numbers[1],
        alpha_rate: p.rates.alpha,
        beta_rate: p.rates.beta,
        alpha_acceleration: p.accelerations.alpha,
        beta_acceleration: p.accelerations.beta,
    }
}

fn solution_of<F: Differentiable>(form: Form, kind: Precession, p: &Point<F>) -> Perturbation<F> {
    Perturbation::new_unchecked(form, kind, &p.spheroid, &p.s, p.rates.gamma, &constants(p))
}

fn linearisation<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let first = any_first_order(p);
    components![KINDS.map(|kind| {
        let unperturbed = unperturbed_motion(kind, p);
        let [of_alpha, of_beta] = first_order_equations(&p.spheroid, &p.s, &unperturbed, &first);
        let (full_alpha, full_beta) = full_residuals(&p.spheroid, &p.s, &unperturbed.0, &first);
        [of_alpha - full_alpha, of_beta - full_beta]
    })]
}

fn term_that_is_missing<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let first = any_first_order(p);
    let (sin_beta, _) = p.angles.beta.sin_cos();
    components![KINDS.map(|kind| {
        let unperturbed = unperturbed_motion(kind, p);
        let [of_alpha, of_beta] = first_order_equations(&p.spheroid, &p.s, &unperturbed, &first);
        let (printed_alpha, printed_beta) = printed_residuals(&p.spheroid, &p.s, &unperturbed.0, &first);
        let stiffness = match kind {
            Precession::Twofold => unperturbed.1 * unperturbed.1,
            Precession::Single => p.spheroid.constant_c * p.s.combination() / p.spheroid.inertia_xx,
        };
        let dropped = stiffness * sin_beta * sin_beta * first.beta;
        [of_alpha - printed_alpha, of_beta - printed_beta - dropped]
    })]
}

fn printed_solution<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    components![KINDS.map(|kind| {
        let (zeroth, expected) = unperturbed_motion(kind, p);
        let printed = solution_of(Form::Printed, kind, p);
        let first = first_order_motion(&printed, printed.homogeneous_frequency);
        let (of_alpha, of_beta) = printed_residuals(&p.spheroid, &p.s, &zeroth, &first);
        // Eq. (28) at zeroth order; about a stationary spin Eq. (32).
        let rate = match kind {
            Precession::Twofold => printed.zeroth_rate,
            Precession::Single => printed.rate,
        };
        [of_alpha, of_beta, rate - expected]
    })]
}

fn corrected_solution<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    components![KINDS.map(|kind| {
        let solution = solution_of(Form::Corrected, kind, p);
        // To first order the homogeneous frequency of the twofold solution is the rate at zeroth order.
        let nu = match kind {
            Precession::Twofold => solution.zeroth_rate,
            Precession::Single => solution.homogeneous_frequency,
        };
        first_order_equations(&p.spheroid, &p.s, &unperturbed_motion(kind, p), &first_order_motion(&solution, nu))
    })]
}

fn rates_of_angles<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (spheroid, s, spin) = (fixed_spheroid(&p.spheroid), fixed_coefficients(&p.s), F::fixed(p.rates.gamma));
    let constants = fixed_constants(&constants(p));
    components![FORMS.map(|form| {
        KINDS.map(|kind| {
            let solution = Perturbation::new_unchecked(form, kind, &spheroid, &s, spin, &constants);
            // Time is an infinitesimal about zero: phases, which are sums of angles, keep their real parts.
            let moving = solution.at(F::first(F::zero(), F::one()));
            [
                F::derivative(moving.alpha) - F::value(moving.alpha_rate),
                F::derivative(moving.beta) - F::value(moving.beta_rate),
            ]
        })
    })]
}
