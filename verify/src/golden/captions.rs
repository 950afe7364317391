//! Captions of the figures of the four examples, and the values that follow from their parameters.

use super::{GoldenLine, GoldenTable, Printed};
use crate::prelude::*;
use crate::printed;

/// Initial values of the four examples, Eq. (34).
pub(super) fn initial_values() -> Result<GoldenTable, Error> {
    let line = |(label, printed, ours)| GoldenLine::new(label, Printed::Decimal(printed), ours);
    Ok(GoldenTable {
        name: "caption_initial_values",
        title: "Initial values in the captions of the four examples, Eq. (34); the printed pi/2 is written 1.5707963",
        lines: printed::caption_values()?.into_iter().map(line).collect(),
    })
}

/// Constants of the perturbation solutions of the examples, and the rates marked in the spectra.
pub(super) fn constants() -> Result<GoldenTable, Error> {
    let mut lines = Vec::new();
    let free = free_precession_rates(&spheroid(), SPIN, 0.7)?;
    for (label, printed, ours) in [
        ("free precession, alpha rate [1/t_c], Eq. (48)", "1.438", free.alpha),
        ("twice that, the second wave line", "2.876", 2.0 * free.alpha),
        ("free precession, |gamma rate| [1/t_c], Eq. (48)", "0.1", free.gamma.abs()),
    ] {
        lines.push(GoldenLine::new(label, Printed::Decimal(printed), ours));
    }
    // tp-I and tp-II share all of these: they differ in A alone.
    for (name, example) in ["twofold", "", "sp-I", "sp-II"].into_iter().zip(paper_examples()) {
        if name.is_empty() {
            continue;
        }
        let solution =
            |form| Perturbation::new(form, example.kind, &spheroid(), &COEFFICIENTS, SPIN, &example.constants);
        let (p, c) = (solution(Form::Printed)?, solution(Form::Corrected)?);
        for (label, value) in [
            ("a^(1), Eq. (31)", p.forced_rate),
            ("a, Eq. (32)", p.rate),
            ("C~, Eq. (31)", p.c_tilde),
            ("eta_alpha, Eq. (31)", p.eta_alpha),
            ("eta_beta, Eq. (31)", p.eta_beta),
            ("eta_alpha, corrected", c.eta_alpha),
            ("eta_beta, corrected", c.eta_beta),
        ] {
            lines.push(GoldenLine::new(format!("{name} {label}"), Printed::No, value));
        }
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
