//! Errors of the perturbation solutions over their parameters.

use std::f64::consts::TAU;

use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::Kind;

use super::{GoldenLine, GoldenTable, Printed};
use crate::checks::regimes::perturbation_error::{Case, Form};

const DIGITS: usize = 3;

fn line(label: String, value: f64) -> GoldenLine {
    GoldenLine { digits: DIGITS, ..GoldenLine::new(label, Printed::No, value) }
}

/// Coefficients with the mean equatorial value and `s^ZZ` of the examples and the given `s^XX - s^YY`, scaled by `k`.
fn coefficients(asymmetry: f64, k: f64) -> PrincipalCoefficients<f64> {
    PrincipalCoefficients::new([0.015 + asymmetry / 2.0, 0.015 - asymmetry / 2.0, -0.04]).scaled(k)
}

/// Twofold precession: largest error of beta over 10 t_c, as printed and corrected.
pub(super) fn twofold() -> Result<GoldenTable, String> {
    let k = 1e-3;
    let mut lines = Vec::new();
    for (form, name) in [(Form::Printed(Kind::Twofold), "printed"), (Form::CorrectedTwofold, "corrected")] {
        let error = |asymmetry: f64, beta_0: f64, amplitude: f64| {
            Case { form, s: coefficients(asymmetry, k), beta_0, amplitude }.errors(10.0, 400).map(|errors| errors.beta)
        };
        for beta_0 in [0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.4] {
            lines.push(line(
                format!("{name}, beta_0 = {beta_0}, A = 0, s^XX - s^YY = 0.01 k"),
                error(0.01, beta_0, 0.0)?,
            ));
        }
        for amplitude in [1e-4, 1e-3, 1e-2, 1e-1] {
            lines.push(line(
                format!("{name}, beta_0 = 0.7, A = {amplitude}, s^XX - s^YY = 0.01 k"),
                error(0.01, 0.7, amplitude)?,
            ));
        }
        for asymmetry in [0.0, 0.001, 0.03, 0.1] {
            lines.push(line(
                format!("{name}, beta_0 = 0.7, A = 0, s^XX - s^YY = {asymmetry} k"),
                error(asymmetry, 0.7, 0.0)?,
            ));
        }
    }
    Ok(GoldenTable {
        name: "twofold_regimes",
        title: "Twofold perturbation solutions: largest error of beta over 10 t_c, s of tp-I scaled by k = 1e-3",
        lines,
    })
}

/// Single precession: largest distance of the true from the approximate axis over one forced period.
pub(super) fn single() -> Result<GoldenTable, String> {
    let error = |asymmetry: f64, k: f64, beta_0: f64, amplitude: f64| {
        let case = Case { form: Form::Printed(Kind::Single), s: coefficients(asymmetry, k), beta_0, amplitude };
        case.errors(TAU / case.solution()?.rate.abs(), 1000).map(|errors| errors.axis)
    };
    let mut lines = Vec::new();
    for beta_0 in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5] {
        lines.push(line(
            format!("beta_0 = {beta_0}, A = 0, k = 1, s^XX - s^YY = 0.01 k"),
            error(0.01, 1.0, beta_0, 0.0)?,
        ));
    }
    for amplitude in [0.003, 0.01, 0.03, 0.1] {
        lines.push(line(
            format!("beta_0 = 0.7, A = {amplitude}, k = 1, s^XX - s^YY = 0.01 k"),
            error(0.01, 1.0, 0.7, amplitude)?,
        ));
    }
    for asymmetry in [0.0, 0.001, 0.003, 0.03] {
        lines.push(line(
            format!("beta_0 = 0.7, A = 0, k = 1, s^XX - s^YY = {asymmetry} k"),
            error(asymmetry, 1.0, 0.7, 0.0)?,
        ));
    }
    for k in [0.1, 0.01] {
        lines.push(line(format!("beta_0 = 0.7, A = 0, k = {k}, s^XX - s^YY = 0.01 k"), error(0.01, k, 0.7, 0.0)?));
    }
    Ok(GoldenTable {
        name: "single_regimes",
        title: "Single perturbation solution: largest distance of the heads of the true and the approximate axis over one \
                forced period, s of sp-I scaled by k",
        lines,
    })
}
