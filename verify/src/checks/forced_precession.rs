//! Forced precession: the shift of the steady rates to first order in `s^IJ`. Eqs. (26), (31), (32), (57).

use crate::checks::perturbation_equations::{KINDS, constants, unperturbed_motion};
use crate::derivation::first_order::{first_order_equations, first_order_motion};
use crate::prelude::*;

checks! {
    /// for s^XX = s^YY and A = 0 the printed rates are constant at constant inclination, and solve Eq. (25), so Eq. (26), to first order in s
    steady_precession: Autodiff "steady-precession-first-order" [25, 26, 28, 30, 31, 32];
    /// the derivative of Eq. (26) by the size of s, at s = 0, is the forced precession -+a^(1)
    Autodiff "forced-precession-limit" [26, 28, 31, 32]: steady_rates_to_first_order;
    AtMost(8.0) "largest difference / (2.2e-16 x a^(1) with the magnitudes of its terms), 200 random points";
    because "some ten factors on each side, half an ulp each, and their derivatives";
    /// the shifted rates are a and Omega^z - a cos b0 of twofold precession, and the free ones without s
    Property "shifted-rates" [22, 48, 57]: shifted_rates_of_spin;
    AtMost(4.0) "largest difference / (2.2e-16 x sum of magnitudes of the terms), 200 random points";
    because "three or four products and as many sums on each side, half an ulp each";
}

fn steady_precession<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let symmetric = PrincipalCoefficients { yy: p.s.xx, ..p.s };
    let constants = Constants { amplitude: F::zero(), ..constants(p) };
    components![KINDS.map(|kind| {
        let printed =
            Perturbation::new_unchecked(Form::Printed, kind, &p.spheroid, &symmetric, p.rates.gamma, &constants);
        let first = first_order_motion(&printed, printed.homogeneous_frequency);
        let equations = first_order_equations(&p.spheroid, &symmetric, &unperturbed_motion(kind, p), &first);
        [equations, [first.beta, first.beta_rate], [first.alpha_acceleration, first.beta_acceleration]]
    })]
}

/// Bodies, coefficients symmetric about Z and spins large enough for both roots of Eq. (26) to be real:
/// `(I^zz Omega^z)^2 >= 9`, above `8 |s^ZZ - s^XX| C I^xx < 6.4`.
fn worst_of_symmetric_points(
    figure: impl Fn(&Point<f64>, &PrincipalCoefficients<f64>, f64) -> Result<f64, String>,
) -> Result<Measured, String> {
    worst_of_draws(26, 200, |random| {
        let point = Point::<f64>::draw(random);
        let momentum = (3.0 + point.numbers[0].abs()).copysign(point.numbers[1]);
        let symmetric = PrincipalCoefficients { yy: point.s.xx, ..point.s };
        figure(&point, &symmetric, momentum / point.spheroid.inertia_zz)
    })
}

fn steady_rates_to_first_order() -> Result<Measured, String> {
    worst_of_symmetric_points(|p, s, spin| {
        largest_of(KINDS.map(|kind| {
            let small = PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(|x| Dual64::new(0.0, x)));
            let (spheroid, beta) = (fixed_spheroid(&p.spheroid), Dual64::from(p.angles.beta));
            let slope = steady_precession_rate(kind, &spheroid, &small, Dual64::from(spin), beta)?.eps;
            let printed = Perturbation::new(Form::Printed, kind, &p.spheroid, s, spin, &constants(p))?;
            let shift = -kind.sign() * printed.forced_rate;
            let cancelled = 2.0 * (s.zz.abs() + s.xx.abs()) / s.combination().abs();
            Ok((slope - shift).abs() / (f64::EPSILON * shift.abs() * cancelled))
        }))
    })
}

fn shifted_rates_of_spin() -> Result<Measured, String> {
    worst_of_symmetric_points(|p, s, spin| {
        let (beta, spheroid) = (p.angles.beta, &p.spheroid);
        let printed = Perturbation::new_unchecked(Form::Printed, Precession::Twofold, spheroid, s, spin, &constants(p));
        let shifted = shifted_rates(spheroid, s, spin, beta)?;
        let unshifted = shifted_rates(spheroid, &PrincipalCoefficients::new([0.0; 3]), spin, beta)?;
        let free = free_precession_rates(spheroid, spin, beta)?;
        let cos_beta = beta.cos();
        let differences = [
            (shifted.alpha - printed.rate) * cos_beta,
            shifted.gamma - (spin - printed.rate * cos_beta),
            (unshifted.alpha - free.alpha) * cos_beta,
            unshifted.gamma - free.gamma,
            // Eq. (22): the rates make up the spin.
            free.alpha * cos_beta + free.gamma - spin,
        ];
        let terms = spin.abs() + printed.omega.abs() + (printed.forced_rate * cos_beta).abs();
        Ok(largest(differences.map(f64::abs)) / (f64::EPSILON * terms))
    })
}
