//! Fundamental frequencies and strongest lines of the paper's pulsar and wave signals of tp-I and tp-II.

use super::{GoldenLine, GoldenTable, Printed};
use crate::checks::spectrum::signals::examples;

/// Lines shown of m.n and of each polarization, for each example.
const SHOWN: [[usize; 2]; 2] = [[5, 4], [9, 8]];

pub(super) fn table() -> Result<GoldenTable, String> {
    let mut lines = Vec::new();
    for (example, [of_pulsar, of_wave]) in examples()?.iter().zip(SHOWN) {
        for generator in &example.exact.frequencies().basis {
            let label = format!("{} {} [1/t_c]", example.name, generator.symbol);
            lines.push(GoldenLine::new(label, Printed::No, generator.rate));
        }
        for (signal, list) in example.signals() {
            let shown = if signal == "m.n" { of_pulsar } else { of_wave };
            for line in list.lines.iter().take(shown) {
                let what = line.combination.to_string();
                let label = format!("{} {signal}, {what}", example.name);
                lines.push(GoldenLine::new(format!("{label}: frequency [1/t_c]"), marked(&what), line.frequency));
                let amplitude = GoldenLine::new(format!("{label}: amplitude"), Printed::No, line.amplitude);
                lines.push(GoldenLine { digits: 6, ..amplitude });
            }
        }
    }
    Ok(GoldenTable {
        name: "spectral_lines",
        title: "Fundamental frequencies and strongest lines of m.n, h_+ and h_x (r = 1) of tp-I and tp-II; printed are the values of \
                free precession that the figures mark",
        lines,
    })
}

/// The value that the paper's figures mark for a line.
fn marked(what: &str) -> Printed {
    match what {
        "alpha'" => Printed::Decimal("1.438"),
        "2 alpha'" => Printed::Decimal("2.876"),
        _ => Printed::No,
    }
}
