//! The angle between the spin axis and a fixed direction. Eqs. (37)-(39).

use crate::checks::observer::observer;
use crate::checks::perturbation_equations::constants;
use crate::paper_examples::problem_from;
use crate::prelude::*;

checks! {
    /// Eq. (37) is e_z . n-hat, and changes sign with the direction
    spin_axis_angle: Property "spin-axis-angle" [37, 46];
    /// Eq. (38) is the derivative of Eq. (37) along any change of alpha and beta
    spin_axis_change: Autodiff "spin-axis-change" [37, 38];
    /// the rate of cos lambda from n and L is Eq. (38) with the Euler rates
    spin_axis_rate: Property "spin-axis-rate" [22, 37, 38];
    /// the rates of the single solution at t = 0 times Delta t are Eq. (39) as printed
    single_precession_changes: Property "single-precession-changes" [30, 31, 39];
    /// Eq. (38) with the changes (39) misses the change of cos lambda of the numerical motion at second order in Delta t
    Regime "spin-axis-changes-order-in-time" [37, 38, 39]:
        || order_of_error(&[1e-3, 3e-3, 1e-2, 3e-2, 1e-1], |interval| error(&COEFFICIENTS, 0.01, interval));
    Within(1.9, 2.1) "slope of log(error of Delta cos lambda) against log Delta t, 1e-3 to 1e-1 t_c, sp-I";
    because "the rates at t = 0 are the motion's own, its acceleration is neglected; the third order shifts the slope by about Delta t";
    /// with A = 0 and s^XX = s^YY, Eqs. (38) and (39) hold over many turns of the star to second order in s
    Regime "spin-axis-changes-order-in-s" [37, 38, 39]:
        || order_of_error(&[1e-1, 3e-2, 1e-2, 3e-3, 1e-3], |k| error(&SYMMETRIC.scaled(k), 0.0, 10.0));
    Within(1.9, 2.1) "slope of log(error of Delta cos lambda after 10 t_c) against log k, s of sp-I scaled by k = 1e-1 to 1e-3";
    because "a^(1) is the rate to first order in s; the next orders shift the slope by about k";
    /// the terms of (39) in A are not a drift: over many turns the error is of first order, like the change itself
    Regime "spin-axis-changes-oscillation" [37, 38, 39]:
        || order_of_error(&[1e-2, 3e-3, 1e-3, 3e-4, 1e-4], |k| error(&SYMMETRIC.scaled(k), 0.01 * k, 10.0));
    Within(0.9, 1.1) "slope of log(error of Delta cos lambda after 10 t_c) against log k, s and A = 0.01 scaled by k = 1e-2 to 1e-4";
    because "A sin(phi) Delta t stands for (A / omega) times a difference of cosines, which has another size of the same order; the second order \
     shifts the slope by at most some 7 k";
}

fn spin_axis_angle<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let in_angles = cos_lambda_in_angles(p.frame.beta, p.frame.alpha, p.angles.alpha, p.angles.beta);
    let (direction, axis) = (observer(p).direction, symmetry_axis(p.angles.alpha, p.angles.beta));
    vec![in_angles - direction.dot(&axis)]
}

fn spin_axis_change<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (theta, phi) = (p.frame.beta, p.frame.alpha);
    let moving = moving_angles(&p.angles, &p.rates);
    let exact = cos_lambda_in_angles(F::fixed(theta), F::fixed(phi), moving.alpha, moving.beta);
    let change = (p.rates.alpha, p.rates.beta);
    vec![cos_lambda_change(theta, phi, (p.angles.alpha, p.angles.beta), change) - F::derivative(exact)]
}

fn spin_axis_rate<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v) = (&p.angles, &p.rates);
    let state = BodyState::from_angles(&p.spheroid, q, v);
    let rate = cos_lambda_rate(&p.spheroid, &observer(p).direction, &state.axis, &state.momentum);
    vec![rate - cos_lambda_change(p.frame.beta, p.frame.alpha, (q.alpha, q.beta), (v.alpha, v.beta))]
}

fn single_precession_changes<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (spin, interval) = (p.rates.gamma, p.numbers[2]);
    let c = constants(p);
    let solution = Perturbation::new_unchecked(Form::Printed, Precession::Single, &p.spheroid, &p.s, spin, &c);
    let (alpha, beta) = changes_from_start(&solution, interval);
    let ((sin_b, cos_b), (sin_phi, cos_phi)) = (c.beta_0.sin_cos(), c.phase.sin_cos());
    let (sin_a, cos_a) = c.alpha_0.sin_cos();
    let (sin_2a, cos_2a) = (sin_a * cos_a * 2.0, cos_a * cos_a - sin_a * sin_a);
    let (a1, c_tilde) = (solution.forced_rate, solution.c_tilde);
    let printed_alpha =
        (F::one() + c.amplitude / (a1 * sin_b) * sin_phi + cos_b * c_tilde / a1 * cos_2a) * a1 * interval;
    let printed_beta = (c.amplitude / a1 * cos_phi + sin_b * c_tilde / a1 * sin_2a) * a1 * interval;
    vec![alpha - printed_alpha, beta - printed_beta]
}

/// Error of the change of `cos lambda` by Eqs. (38) and (39) over `interval`, for the motion with the initial values (34).
fn error(s: &PrincipalCoefficients<f64>, amplitude: f64, interval: f64) -> Result<f64, String> {
    // A general phase, azimuth and direction, so that all terms of Eqs. (38) and (39) contribute.
    let constants = Constants { alpha_0: 0.9, beta_0: 0.7, amplitude, phase: 0.4 };
    let solution = Perturbation::new(Form::Printed, Precession::Single, &spheroid(), s, SPIN, &constants)?;
    let start = solution.at(0.0);
    let problem = problem_from(s, &start)?;
    let end = problem.taylor((0.0, interval), 1e-15)?.state(interval)?;
    let (theta, phi) = (0.8, 0.5);
    let moved = end.axis - problem.initial().axis;
    let changes = changes_from_start(&solution, interval);
    let by_motion = Observer::at(theta, phi).direction.dot(&moved);
    Ok((by_motion - cos_lambda_change(theta, phi, (start.alpha, start.beta), changes)).abs())
}

/// The coefficients of the examples without their asymmetry about Z.
const SYMMETRIC: PrincipalCoefficients<f64> = PrincipalCoefficients { xx: 0.015, yy: 0.015, zz: -0.04 };
