//! Rows of labelled numbers, compared with what was reviewed.

use std::fmt::Write;

use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::AxisState;
use twofold::dynamics::BodyState;

/// Longest line.
const WIDTH: usize = 116;
/// Numbers below it are mostly roundings, of which two digits are kept; of those below a rounding of one, none.
const SMALL: f64 = 1e-12;
const NONE: f64 = 1e-16;

/// What can stand in a row.
pub trait Written {
    fn written(&self) -> String;
}

impl Written for f64 {
    /// To six digits.
    fn written(&self) -> String {
        let rounded: f64 = format!("{self:.5e}").parse().expect("a number");
        match self.abs() {
            0.0 => "0".to_string(),
            ..NONE => "below 1e-16".to_string(),
            ..SMALL => format!("{self:.1e}"),
            1e-3..1e6 => rounded.to_string(),
            _ => format!("{rounded:e}"),
        }
    }
}

/// Numbers of order one, to six decimals. What rounds to zero has no sign.
fn parts<'a>(values: impl IntoIterator<Item = &'a f64>) -> String {
    let parts: Vec<_> = values.into_iter().map(|x| format!("{:.6}", (x * 1e6).round() / 1e6 + 0.0)).collect();
    format!("({})", parts.join(", "))
}

impl<const N: usize> Written for [f64; N] {
    fn written(&self) -> String {
        parts(self)
    }
}

impl Written for Vector3<f64> {
    fn written(&self) -> String {
        parts(self)
    }
}

impl Written for AxisState<f64> {
    fn written(&self) -> String {
        format!("n {}, L {}", parts(&self.axis), parts(&self.momentum))
    }
}

impl Written for BodyState<f64> {
    fn written(&self) -> String {
        format!("n {}, L {}, e_x {}", parts(&self.axis), parts(&self.momentum), parts(&self.equatorial_axis))
    }
}

impl<T: Written> Written for Option<T> {
    fn written(&self) -> String {
        self.as_ref().map_or("none".to_string(), T::written)
    }
}

macro_rules! as_displayed {
    ($($type:ty),*) => { $(impl Written for $type { fn written(&self) -> String { self.to_string() } })* };
}

as_displayed!(bool, usize, u64, i64, &str, String);

#[derive(Default)]
pub struct Table(String);

impl Table {
    /// `name: label value, label value`, in as many lines as it takes.
    pub fn row(&mut self, name: &str, cells: &[(&str, &dyn Written)]) {
        let cells: Vec<_> = cells.iter().map(|(label, value)| format!("{label} {}", value.written())).collect();
        let text = format!("{}: {}", name.trim_start(), cells.join(", "));
        let mut line = " ".repeat(name.len() - name.trim_start().len());
        for word in text.split_whitespace() {
            if line.len() + word.len() > WIDTH {
                writeln!(self.0, "{}", line.trim_end()).expect("a string takes all");
                line = " ".repeat(6);
            }
            line = line + word + " ";
        }
        writeln!(self.0, "{}", line.trim_end()).expect("a string takes all");
    }

    /// Rows of what was found, or why there is nothing, without the number in it, which may be a rounding.
    pub fn found<T>(&mut self, name: &str, found: Result<T, Error>, rows: impl FnOnce(&mut Self, T)) {
        match found {
            Ok(found) => rows(self, found),
            Err(Error::Domain { quantity, allowed, .. }) => {
                self.row(name, &[("refused,", &quantity.to_string()), ("to be", &allowed.to_string())]);
            }
            Err(Error::Unsupported { what, why }) => {
                self.row(name, &[("refused,", &what.to_string()), ("since", &why.to_string())]);
            }
            Err(Error::NotConverged { what, .. }) => self.row(name, &[("no convergence,", &what.to_string())]),
        }
    }

    /// Why something is refused, or that it is not.
    pub fn refusal<T>(&mut self, name: &str, found: Result<T, Error>) {
        self.found(name, found, |table, _| table.row(name, &[("accepted", &"")]));
    }

    /// Compares with what was reviewed.
    pub fn check(self, name: &str) {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("../../../golden/values");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, self.0));
    }
}
