//! The perturbation solutions and the equations that they solve. Eqs. (27)-(33).

use twofold::Scalar;
use twofold::solutions::perturbation::linearised::{FirstOrderMotion, ZerothOrder, full_residuals, printed_residuals};
use twofold::solutions::perturbation::{Constants, Kind as Precession, Perturbation};

use crate::check::{Check, Kind};
use crate::derivation::Differentiable;
use crate::derivation::first_order::{UnperturbedMotion, first_order_motion, linearised_equations};
use crate::derivation::spheroid_motion::{fixed_coefficients, fixed_spheroid};
use crate::identity::{self, Identity};
use crate::random::Point;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identity::checks::<Linearisation>(),
        identity::checks::<TermThatIsMissing>(),
        identity::checks::<PrintedSolution>(),
        identity::checks::<CorrectedSolution>(),
        identity::checks::<TimeIntegral>(),
    ]
    .concat()
}

pub(super) const KINDS: [Precession; 2] = [Precession::Twofold, Precession::Single];

pub(super) fn constants<F: Scalar>(p: &Point<F>) -> Constants<F> {
    Constants {
        alpha_0: p.angles.alpha,
        beta_0: p.angles.beta,
        amplitude: p.numbers[0],
        // A phase coded like every other angle.
        phase: p.angles.gamma,
    }
}

fn zeroth_order<F: Scalar>(kind: Precession, p: &Point<F>) -> ZerothOrder<F> {
    ZerothOrder { kind, spin: p.rates.gamma, alpha: p.angles.alpha, beta: p.angles.beta }
}

/// Eq. (28), from what the two kinds mean: free precession has `L` along Z, `I^zz Omega^z = L cos b`, `a = L / I^xx`.
pub(super) fn unperturbed_motion<F: Scalar>(kind: Precession, p: &Point<F>) -> UnperturbedMotion<F> {
    let (_, cos_beta) = p.angles.beta.sin_cos();
    let rate = match kind {
        Precession::Twofold => p.spheroid.inertia_zz * p.rates.gamma / cos_beta / p.spheroid.inertia_xx,
        Precession::Single => F::zero(),
    };
    UnperturbedMotion { spin: p.rates.gamma, alpha: p.angles.alpha, beta: p.angles.beta, rate }
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

struct Linearisation;

impl Identity for Linearisation {
    const ID: &'static str = "full-first-order-equations";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "full-first-order-equations-autodiff");
    const EQUATIONS: &'static [u8] = &[25, 27, 28, 29];
    const STATEMENT: &'static str =
        "Eq. (29) with the term a^2 sin^2(b0) beta1 is the derivative of Eq. (25) about either zeroth order";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let first = any_first_order(p);
        KINDS
            .into_iter()
            .flat_map(|kind| {
                let [of_alpha, of_beta] = linearised_equations(&p.spheroid, &p.s, &unperturbed_motion(kind, p), &first);
                let (full_alpha, full_beta) = full_residuals(&p.spheroid, &p.s, &zeroth_order(kind, p), &first);
                [of_alpha - full_alpha, of_beta - full_beta]
            })
            .collect()
    }
}

struct TermThatIsMissing;

impl Identity for TermThatIsMissing {
    const ID: &'static str = "missing-first-order-term";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "missing-first-order-term-autodiff");
    const EQUATIONS: &'static [u8] = &[25, 27, 28, 29];
    const STATEMENT: &'static str = "Eq. (29) as printed is the derivative of Eq. (25) for the lower signs, and for the upper ones short by exactly \
         a^2 sin^2(b0) beta1 in the second equation";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let first = any_first_order(p);
        let (sin_beta, _) = p.angles.beta.sin_cos();
        KINDS
            .into_iter()
            .flat_map(|kind| {
                let unperturbed = unperturbed_motion(kind, p);
                let [of_alpha, of_beta] = linearised_equations(&p.spheroid, &p.s, &unperturbed, &first);
                let (printed_alpha, printed_beta) =
                    printed_residuals(&p.spheroid, &p.s, &zeroth_order(kind, p), &first);
                let across = unperturbed.rate * sin_beta;
                [of_alpha - printed_alpha, of_beta - printed_beta - across * across * first.beta]
            })
            .collect()
    }
}

struct PrintedSolution;

impl Identity for PrintedSolution {
    const ID: &'static str = "printed-perturbation-solution";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "printed-perturbation-solution-autodiff");
    const EQUATIONS: &'static [u8] = &[28, 29, 30, 31, 32];
    const STATEMENT: &'static str = "the printed rates solve the printed Eq. (29), both signs, any A and phi";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        KINDS
            .into_iter()
            .flat_map(|kind| {
                let spin = p.rates.gamma;
                let printed = Perturbation::printed_unchecked(kind, &p.spheroid, &p.s, spin, &constants(p));
                let first = first_order_motion(&printed, printed.homogeneous_frequency);
                let (of_alpha, of_beta) = printed_residuals(&p.spheroid, &p.s, &zeroth_order(kind, p), &first);
                [of_alpha, of_beta, printed.zeroth_rate - unperturbed_motion(kind, p).rate]
            })
            .collect()
    }
}

struct CorrectedSolution;

impl Identity for CorrectedSolution {
    const ID: &'static str = "corrected-perturbation-solution";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "corrected-perturbation-solution-autodiff");
    const EQUATIONS: &'static [u8] = &[25, 27, 28, 30, 31, 32, 33];
    const STATEMENT: &'static str =
        "the corrected twofold solution solves the derivative of Eq. (25) about free precession, any A and phi";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let solution = Perturbation::corrected_twofold_unchecked(&p.spheroid, &p.s, p.rates.gamma, &constants(p));
        // To first order the homogeneous frequency is the zeroth-order rate.
        let first = first_order_motion(&solution, solution.zeroth_rate);
        let unperturbed = unperturbed_motion(Precession::Twofold, p);
        linearised_equations(&p.spheroid, &p.s, &unperturbed, &first).to_vec()
    }
}

struct TimeIntegral;

impl Identity for TimeIntegral {
    const ID: &'static str = "perturbed-angles";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "perturbed-angles-autodiff");
    const EQUATIONS: &'static [u8] = &[27, 30, 32, 33];
    const STATEMENT: &'static str =
        "the rates are the time derivatives of the angles, printed (both signs) and corrected, any A and phi";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (spheroid, s, spin) = (fixed_spheroid(&p.spheroid), fixed_coefficients(&p.s), F::fixed(p.rates.gamma));
        let at_rest = constants(p);
        let constants = Constants {
            alpha_0: F::fixed(at_rest.alpha_0),
            beta_0: F::fixed(at_rest.beta_0),
            amplitude: F::fixed(at_rest.amplitude),
            phase: F::fixed(at_rest.phase),
        };
        let printed = KINDS.map(|kind| Perturbation::printed_unchecked(kind, &spheroid, &s, spin, &constants));
        let corrected = Perturbation::corrected_twofold_unchecked(&spheroid, &s, spin, &constants);
        printed
            .into_iter()
            .chain([corrected])
            .flat_map(|solution| {
                // Time as an infinitesimal about zero: phases, which are sums of angles, keep their real parts.
                let moving = solution.at(F::first(F::zero(), F::one()));
                [
                    F::derivative(moving.alpha) - F::value(moving.alpha_rate),
                    F::derivative(moving.beta) - F::value(moving.beta_rate),
                ]
            })
            .collect()
    }
}
