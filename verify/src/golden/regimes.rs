//! Errors of the perturbation solutions as functions of their parameters.

use super::{GoldenLine, GoldenTable, Printed};
use crate::checks::regimes::perturbation_error::Case;
use crate::prelude::*;

const DIGITS: usize = 3;

const FORMS: [(Form, &str); 2] = [(Form::Printed, "printed"), (Form::Corrected, "corrected")];

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
    for (form, name) in FORMS {
        let error = |asymmetry: f64, beta_0: f64, amplitude: f64| {
            Case { form, kind: Precession::Twofold, s: coefficients(asymmetry, k), beta_0, amplitude }
                .errors(10.0, 400)
                .map(|errors| errors.beta)
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

/// Single precession: largest distance between the true and the approximate axis over one forced period, printed and corrected.
pub(super) fn single() -> Result<GoldenTable, String> {
    let inclinations = [0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5].map(|beta_0| (0.01, 1.0, beta_0, 0.0));
    let amplitudes = [0.003, 0.01, 0.03, 0.1].map(|amplitude| (0.01, 1.0, 0.7, amplitude));
    let asymmetries = [0.0, 0.001, 0.003, 0.03].map(|asymmetry| (asymmetry, 1.0, 0.7, 0.0));
    let scales = [0.1, 0.01].map(|k| (0.01, k, 0.7, 0.0));
    let mut lines = Vec::new();
    for (form, name) in FORMS {
        let cases = inclinations.iter().chain(&amplitudes).chain(&asymmetries).chain(&scales);
        for &(asymmetry, k, beta_0, amplitude) in cases {
            let case = Case { form, kind: Precession::Single, s: coefficients(asymmetry, k), beta_0, amplitude };
            let label = format!("{name}, beta_0 = {beta_0}, A = {amplitude}, k = {k}, s^XX - s^YY = {asymmetry} k");
            lines.push(line(label, case.errors_over_forced_period()?.axis));
        }
    }
    Ok(GoldenTable {
        name: "single_regimes",
        title: "Single perturbation solutions: largest distance of the heads of the true and the approximate axis over one \
                forced period, s of sp-I scaled by k",
        lines,
    })
}
