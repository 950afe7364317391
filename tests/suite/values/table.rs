//! A table of named numbers.

use std::fmt::Write;

use nalgebra::Matrix3;
use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::propagation::AxisState;

/// Numbers below it are mostly roundings, of which two digits are kept; of those below a rounding of one, none.
const SMALL: f64 = 1e-12;
const NONE: f64 = 1e-16;

/// A number of any size.
fn written(value: f64, digits: usize) -> String {
    match value.abs() {
        0.0 => "0".to_string(),
        ..NONE => "below 1e-16".to_string(),
        ..SMALL => format!("{value:.1e}"),
        _ => format!("{value:.digits$e}"),
    }
}

#[derive(Default)]
pub struct Table(String);

impl Table {
    pub fn number(&mut self, name: &str, value: f64) {
        writeln!(self.0, "{name:<64} {:>16}", written(value, 6)).expect("a string takes all");
    }

    pub fn text(&mut self, name: &str, value: &str) {
        writeln!(self.0, "{name:<64} {value}").expect("a string takes all");
    }

    /// Numbers of order one, to ten decimals.
    pub fn parts(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        // What rounds to zero has no sign.
        let rounded = values.into_iter().map(|value| (value * 1e10).round() / 1e10 + 0.0);
        let parts: Vec<String> = rounded.map(|value| format!("{value:>14.10}")).collect();
        writeln!(self.0, "{name:<64} {}", parts.join(" ")).expect("a string takes all");
    }

    pub fn state(&mut self, name: &str, state: &BodyState<f64>) {
        self.parts(&format!("{name}: n"), state.axis.iter().copied());
        self.parts(&format!("{name}: L"), state.momentum.iter().copied());
        self.parts(&format!("{name}: e_x"), state.equatorial_axis.iter().copied());
    }

    pub fn axis_state(&mut self, name: &str, state: &AxisState<f64>) {
        self.parts(&format!("{name}: n"), state.axis.iter().copied());
        self.parts(&format!("{name}: L"), state.momentum.iter().copied());
    }

    pub fn matrix(&mut self, name: &str, matrix: &Matrix3<f64>) {
        self.parts(name, matrix.transpose().iter().copied());
    }

    /// What is refused, or that it is not.
    pub fn refusal<T>(&mut self, name: &str, found: &Result<T, Error>) {
        match found {
            Ok(_) => self.text(name, "accepted"),
            Err(error) => self.error(name, error),
        }
    }

    /// Why something is refused, without the number, which may be a rounding.
    pub fn error(&mut self, name: &str, error: &Error) {
        match error {
            Error::Domain { quantity, allowed, .. } => self.text(name, &format!("{quantity}: {allowed}")),
            Error::Unsupported { what, why } => self.text(name, &format!("{what}: {why}")),
            Error::NotConverged { what, .. } => self.text(name, &format!("{what}: no convergence")),
        }
    }

    /// Numbers of any size in one row.
    pub fn row(&mut self, name: &str, values: &[f64]) {
        let parts: Vec<String> = values.iter().map(|&value| written(value, 5)).collect();
        writeln!(self.0, "{name:<64} {}", parts.join(" ")).expect("a string takes all");
    }

    /// Compares with what was reviewed.
    pub fn check(self, name: &str) {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("../../golden/values");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, self.0));
    }
}
