//! The perturbation solutions and the equations that they solve. Eqs. (26)-(33), (57).

use num_dual::Dual64;
use twofold::Scalar;
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_residuals};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::linearised::{FirstOrderMotion, ZerothOrder, full_residuals, printed_residuals};
use twofold::solutions::perturbation::{Constants, Kind as Precession, Perturbation};
use twofold::solutions::steady::steady_precession_rate;

use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::derivation::Differentiable;
use crate::derivation::first_order::{UnperturbedMotion, linearised_equations};
use crate::derivation::spheroid_motion::{fixed_coefficients, fixed_spheroid};
use crate::identity::{self, Identity};
use crate::random::{Point, Random};

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identity::checks::<Linearisation>(),
        identity::checks::<TermThatIsMissing>(),
        identity::checks::<PrintedSolution>(),
        identity::checks::<CorrectedSolution>(),
        identity::checks::<TimeIntegral>(),
        identity::checks::<SteadyPrecession>(),
    ]
    .into_iter()
    .flatten()
    .chain([
        Check {
            id: "steady-precession-equation",
            kind: Kind::Property,
            equations: &[25, 26],
            statement: "both roots of Eq. (26) solve Eq. (25) at constant inclination, for s^XX = s^YY",
            figure: "largest residual / (2.2e-16 x sum of magnitudes of the terms of Eq. (25)), 200 random points",
            bound: Bound::AtMost(4.0),
            reason: "a root has about eight roundings of half an ulp, and enters the terms with degree one or two",
            measure: steady_rates_in_equation,
        },
        Check {
            id: "steady-precession-limit",
            kind: Kind::Autodiff,
            equations: &[26, 28, 31, 32],
            statement: "the derivative of Eq. (26) by the size of s, at s = 0, is the forced precession -+a^(1)",
            figure: "largest difference / (2.2e-16 x a^(1) with the magnitudes of its terms), 200 random points",
            bound: Bound::AtMost(8.0),
            reason: "some ten factors on each side, half an ulp each, and their derivatives",
            measure: steady_rates_to_first_order,
        },
    ])
    .collect()
}

const KINDS: [Precession; 2] = [Precession::Twofold, Precession::Single];

fn constants<F: Scalar>(p: &Point<F>) -> Constants<F> {
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
fn unperturbed_motion<F: Scalar>(kind: Precession, p: &Point<F>) -> UnperturbedMotion<F> {
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

/// A solution as a first-order motion at `t = 0` with its phases at the zeroth-order rate `a` and the homogeneous frequency
/// `nu`. What Eq. (32) adds to `a` is put back into the rate of `alpha1`, where Eq. (30) has it.
fn first_order_motion<F: Differentiable>(solution: &Perturbation<F>, nu: F) -> FirstOrderMotion<F> {
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

struct SteadyPrecession;

impl Identity for SteadyPrecession {
    const ID: &'static str = "steady-precession-first-order";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "steady-precession-first-order-autodiff");
    const EQUATIONS: &'static [u8] = &[25, 26, 28, 30, 31, 32];
    const STATEMENT: &'static str = "for s^XX = s^YY and A = 0 the printed rates are constant at constant inclination, and solve Eq. (25), so Eq. (26), to \
         first order in s";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let symmetric = PrincipalCoefficients { yy: p.s.xx, ..p.s };
        KINDS
            .into_iter()
            .flat_map(|kind| {
                let constants = Constants { amplitude: F::zero(), ..constants(p) };
                let printed = Perturbation::printed_unchecked(kind, &p.spheroid, &symmetric, p.rates.gamma, &constants);
                let first = first_order_motion(&printed, printed.homogeneous_frequency);
                let unperturbed = unperturbed_motion(kind, p);
                let [of_alpha, of_beta] = linearised_equations(&p.spheroid, &symmetric, &unperturbed, &first);
                [of_alpha, of_beta, first.beta, first.beta_rate, first.alpha_acceleration, first.beta_acceleration]
            })
            .collect()
    }
}

/// Bodies, coefficients symmetric about Z and spins large enough for both roots of Eq. (26) to be real:
/// `(I^zz Omega^z)^2 >= 9`, above `8 |s^ZZ - s^XX| C I^xx < 6.4`.
fn symmetric_points() -> impl Iterator<Item = (Point<f64>, PrincipalCoefficients<f64>, f64)> {
    let mut random = Random::with_seed(26);
    (0..200).map(move |_| {
        let point = Point::<f64>::draw(&mut random);
        let momentum = (3.0 + point.numbers[0].abs()).copysign(point.numbers[1]);
        let symmetric = PrincipalCoefficients { yy: point.s.xx, ..point.s };
        (point, symmetric, momentum / point.spheroid.inertia_zz)
    })
}

fn steady_rates_in_equation() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (index, (p, s, spin)) in symmetric_points().enumerate() {
        for kind in KINDS {
            let beta = p.angles.beta;
            let rate = steady_precession_rate(kind, &p.spheroid, &s, spin, beta).map_err(|e| e.to_string())?;
            let motion = AxisAngles { alpha: p.angles.alpha, beta, alpha_rate: rate, beta_rate: 0.0 };
            let (of_alpha, of_beta) = euler_angle_residuals(&p.spheroid, &s, spin, &motion, (0.0, 0.0));
            let (sb, cb) = beta.sin_cos();
            let potential = 2.0 * p.spheroid.constant_c * (s.xx.abs() + s.zz.abs()) / p.spheroid.inertia_xx;
            let spin_term = p.spheroid.free_precession_constant(spin) * sb * rate;
            let terms = sb * cb.abs() * rate * rate + spin_term.abs() + potential * sb * cb.abs();
            let place = || format!("{kind:?}, point {index} of seed 26, residuals {of_alpha:e}, {of_beta:e}");
            worst.see(of_alpha.abs().max(of_beta.abs()) / (f64::EPSILON * terms), place);
        }
    }
    worst.finish()
}

fn steady_rates_to_first_order() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (index, (p, s, spin)) in symmetric_points().enumerate() {
        for kind in KINDS {
            let (beta, constants) = (Dual64::from(p.angles.beta), constants(&p));
            let small = PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(|x| Dual64::new(0.0, x)));
            let spheroid = fixed_spheroid(&p.spheroid);
            let exact = steady_precession_rate(kind, &spheroid, &small, Dual64::from(spin), beta);
            let printed = Perturbation::printed(kind, &p.spheroid, &s, spin, &constants).map_err(|e| e.to_string())?;
            let shift = -kind.sign() * printed.forced_rate;
            let slope = exact.map_err(|e| e.to_string())?.eps;
            let cancelled = 2.0 * (s.zz.abs() + s.xx.abs()) / s.combination().abs();
            let place = || format!("{kind:?}, point {index} of seed 26: {slope:e}, a^(1) {shift:e}");
            worst.see((slope - shift).abs() / (f64::EPSILON * shift.abs() * cancelled), place);
        }
    }
    worst.finish()
}
