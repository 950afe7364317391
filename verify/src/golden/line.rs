//! One number of the paper: as printed, as computed, and the verdict.

use crate::printed::rounds_to;

/// How the paper gives a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Printed {
    /// A decimal number as printed, `0.701`: ours must round to it.
    Decimal(&'static str),
    /// An order of magnitude, `1e-5`: ours must be within half a decade.
    Order(&'static str),
    /// Not printed: derived by the paper's formula.
    No,
}

/// One labelled number of a table.
#[derive(Debug, Clone)]
pub struct GoldenLine {
    /// Label with symbol, unit and equation.
    pub label: String,
    /// The paper's number.
    pub printed: Printed,
    /// Our number.
    pub ours: f64,
    /// Significant digits shown: those that are the same on every machine.
    pub digits: usize,
}

impl GoldenLine {
    /// A line with nine significant digits.
    pub fn new(label: impl Into<String>, printed: Printed, ours: f64) -> Self {
        Self { label: label.into(), printed, ours, digits: 9 }
    }

    /// `confirmed`, `differs`, or `derived` if nothing is printed.
    pub fn verdict(&self) -> &'static str {
        let agrees = match self.printed {
            Printed::No => return "derived",
            Printed::Decimal(text) => rounds_to(self.ours, text),
            Printed::Order(text) => {
                let printed: f64 = text.parse().expect("printed numbers are numbers");
                (self.ours / printed).log10().abs() <= 0.5
            }
        };
        if agrees { "confirmed" } else { "differs" }
    }

    /// The paper's number; an order of magnitude has `~` before it.
    pub fn printed_text(&self) -> String {
        match self.printed {
            Printed::Decimal(text) => text.to_string(),
            Printed::Order(text) => format!("~{text}"),
            Printed::No => "-".to_string(),
        }
    }

    /// Our number.
    pub fn ours_text(&self) -> String {
        significant(self.ours, self.digits)
    }
}

/// Formats a number. Below 1e-15 it is the rounding of a zero in these tables.
fn significant(value: f64, digits: usize) -> String {
    if value.abs() < 1e-15 { "0".into() } else { format!("{value:.*e}", digits - 1) }
}
