//! Single precession: where the perturbation solution mimics the motion, and what its small parameter is.

use std::f64::consts::TAU;

use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::Kind as Precession;

use super::perturbation_error::{Case, Errors, Form};
use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::fit::order;

const SINGLE: Form = Form::Printed(Precession::Single);

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "single-mimics-small-inclination",
            kind: Kind::Regime,
            equations: &[33, 34],
            statement: "for beta_0 up to 1 the single-precession solution follows the motion through one forced period",
            figure: "largest distance of the heads of the true and the approximate axis over one forced period, beta_0 = 0.1 to 1",
            bound: Bound::AtMost(1.0 / 3.0),
            reason: "'mimic' read as staying within a third of the unit sphere's radius, with the coefficients of the examples",
            measure: small_inclinations,
        },
        Check {
            id: "single-fails-near-right-angle",
            kind: Kind::Regime,
            equations: &[33, 34],
            statement: "towards beta_0 = pi/2 the single-precession solution fails completely, however small s is",
            figure: "smallest distance reached over one forced period, beta_0 = 1.4 and 1.5, s scaled by 1, 0.1, 0.01",
            bound: Bound::AtLeast(1.0),
            reason: "'fails completely' read as losing the axis by more than the unit sphere's radius, 60 degrees",
            measure: failure_near_right_angle,
        },
        Check {
            id: "single-error-not-of-order-s",
            kind: Kind::Regime,
            equations: &[30, 33],
            statement: "at a fixed ratio of s^XX - s^YY to 2 s^ZZ - s^XX - s^YY the error over a forced period does not vanish with s",
            figure: "slope of log(error of beta over one forced period) against log k, s scaled by k = 1e-2 to 1e-3",
            bound: Bound::Within(-0.05, 0.05),
            reason: "alpha1 and beta1 have the size of the ratio, not of s: order zero in s",
            measure: order_in_s,
        },
        Check {
            id: "single-error-order-in-asymmetry",
            kind: Kind::Regime,
            equations: &[30, 33],
            statement: "the small parameter of the single-precession solution is the ratio of s^XX - s^YY to 2 s^ZZ - s^XX - s^YY",
            figure: "slope of log(error of beta over one forced period) against log of the ratio, 0.027 to 0.009, s scaled by 1e-3",
            bound: Bound::Within(1.8, 2.3),
            reason: "order two, not one or three: the third order in the ratio raises the measured slope, terms of the order s times the ratio lower it",
            measure: order_in_asymmetry,
        },
    ]
}

fn over_one_period(case: &Case) -> Result<Errors, String> {
    case.errors(TAU / case.solution()?.rate.abs(), 1000)
}

fn small_inclinations() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for beta_0 in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
        for amplitude in [0.0, 0.01] {
            let errors = over_one_period(&Case::paper(SINGLE, 1.0, beta_0, amplitude))?;
            worst.see(errors.axis, || format!("beta_0 = {beta_0}, A = {amplitude}: alpha off by {:.3}", errors.alpha));
        }
    }
    worst.finish()
}

fn failure_near_right_angle() -> Result<Measured, String> {
    let mut least = Measured::new(f64::INFINITY, "");
    for k in [1.0, 0.1, 0.01] {
        for beta_0 in [1.4, 1.5] {
            let errors = over_one_period(&Case::paper(SINGLE, k, beta_0, 0.0))?;
            if errors.axis < least.figure {
                least =
                    Measured::new(errors.axis, format!("beta_0 = {beta_0}, k = {k}: alpha off by {:.2}", errors.alpha));
            }
        }
    }
    Ok(least)
}

fn order_in_s() -> Result<Measured, String> {
    let points = [1e-2, 10f64.powf(-2.5), 1e-3]
        .into_iter()
        .map(|k| Ok((k, over_one_period(&Case::paper(SINGLE, k, 0.7, 0.0))?.beta)))
        .collect::<Result<Vec<_>, String>>()?;
    Ok(order(&points, 0.0)?.measured(&points))
}

fn order_in_asymmetry() -> Result<Measured, String> {
    let points = [0.3, 0.2, 0.1_f64]
        .into_iter()
        .map(|r| {
            let s = PrincipalCoefficients::new([0.015 + 0.005 * r, 0.015 - 0.005 * r, -0.04]).scaled(1e-3);
            let ratio = (s.asymmetry() / s.combination()).abs();
            Ok((ratio, over_one_period(&Case { form: SINGLE, s, beta_0: 0.7, amplitude: 0.0 })?.beta))
        })
        .collect::<Result<Vec<_>, String>>()?;
    Ok(order(&points, 0.0)?.measured(&points))
}
