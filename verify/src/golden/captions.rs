//! Captions of the figures of the four examples, and what their parameters give.

use twofold::Error;
use twofold::solutions::free::free_precession_rates;
use twofold::solutions::perturbation::{Form, Perturbation, shifted_rates};

use super::{GoldenLine, GoldenTable, Printed};
use crate::paper_examples::{COEFFICIENTS, SPIN, paper_examples, spheroid};

/// Initial values of the four examples, Eq. (34).
pub(crate) fn initial_values() -> Result<GoldenTable, Error> {
    let printed = [
        ["1.5707963", "0.701", "1.509", "0"],
        ["1.5707963", "1.065", "0.889", "0"],
        ["1.5707963", "0.671", "-0.068", "0"],
        ["1.5707963", "1.146", "-0.008", "0"],
    ];
    let mut lines = Vec::new();
    for (example, printed) in paper_examples().iter().zip(printed) {
        let q = example.initial_values()?;
        let values = [
            ("alpha [rad]", q.alpha),
            ("beta [rad]", q.beta),
            ("alpha rate [1/t_c]", q.alpha_rate),
            ("beta rate [1/t_c]", q.beta_rate),
        ];
        for ((label, ours), printed) in values.into_iter().zip(printed) {
            lines.push(GoldenLine::new(format!("{} {label} at t = 0", example.name), Printed::Decimal(printed), ours));
        }
    }
    Ok(GoldenTable {
        name: "caption_initial_values",
        title: "Initial values in the captions of the four examples, Eq. (34); the printed pi/2 is written 1.5707963",
        lines,
    })
}

/// Constants of the perturbation solutions of the examples, and the rates marked in the spectra.
pub(super) fn constants() -> Result<GoldenTable, Error> {
    let mut lines = Vec::new();
    let free = free_precession_rates(&spheroid(), SPIN, 0.7)?;
    lines.push(GoldenLine::new("free precession, alpha rate [1/t_c], Eq. (48)", Printed::Decimal("1.438"), free.alpha));
    lines.push(GoldenLine::new("twice that, the second wave line", Printed::Decimal("2.876"), 2.0 * free.alpha));
    lines.push(GoldenLine::new(
        "free precession, |gamma rate| [1/t_c], Eq. (48)",
        Printed::Decimal("0.1"),
        free.gamma.abs(),
    ));
    // tp-I and tp-II share all of these: they differ in A alone.
    for (name, example) in ["twofold", "", "sp-I", "sp-II"].into_iter().zip(paper_examples()) {
        if name.is_empty() {
            continue;
        }
        let p = Perturbation::new(Form::Printed, example.kind, &spheroid(), &COEFFICIENTS, SPIN, &example.constants)?;
        for (label, value) in [
            ("a^(1), Eq. (31)", p.forced_rate),
            ("a, Eq. (32)", p.rate),
            ("C~, Eq. (31)", p.c_tilde),
            ("eta_alpha, Eq. (31)", p.eta_alpha),
            ("eta_beta, Eq. (31)", p.eta_beta),
        ] {
            lines.push(GoldenLine::new(format!("{name} {label}"), Printed::No, value));
        }
        let c = Perturbation::new(Form::Corrected, example.kind, &spheroid(), &COEFFICIENTS, SPIN, &example.constants)?;
        lines.push(GoldenLine::new(format!("{name} eta_alpha, corrected"), Printed::No, c.eta_alpha));
        lines.push(GoldenLine::new(format!("{name} eta_beta, corrected"), Printed::No, c.eta_beta));
    }
    let shifted = shifted_rates(&spheroid(), &COEFFICIENTS, SPIN, 0.7)?;
    lines.push(GoldenLine::new("twofold, shifted alpha rate [1/t_c], Eq. (57)", Printed::No, shifted.alpha));
    lines.push(GoldenLine::new("twofold, shifted gamma rate [1/t_c], Eq. (57)", Printed::No, shifted.gamma));
    Ok(GoldenTable {
        name: "perturbation_constants",
        title: "Constants of the perturbation solutions of the examples, and the rates marked in the spectra",
        lines,
    })
}
