//! Rows of results, compared with reviewed ones.

use std::fmt::{Debug, Write};

use twofold::Error;

/// Maximum length of a line.
const WIDTH: usize = 116;
/// Numbers below `SMALL` are mostly rounding and keep two digits; numbers below `NONE` keep none.
const SMALL: f64 = 1e-12;
const NONE: f64 = 1e-16;

/// Six digits of a number.
fn written(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().expect("a number");
    match x.abs() {
        0.0 => "0".to_string(),
        ..NONE => "below 1e-16".to_string(),
        ..SMALL => format!("{x:.1e}"),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// Six decimals of a component, which is of order one. A rounded zero has no sign.
fn component(x: f64) -> String {
    format!("{:.6}", (x * 1e6).round() / 1e6 + 0.0)
}

/// A debug text in which every unquoted number with a point or an exponent is rounded, those in `[[ ]]` as components of a vector.
fn rounded(text: &str) -> String {
    let (mut out, mut rest, mut brackets) = (String::new(), text, Vec::new());
    let mut quoted = false;
    while let Some(next) = rest.chars().next() {
        let in_word = quoted || out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let length = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit() || ".e-".contains(c)).len();
        match rest[..length].parse::<f64>() {
            Ok(number) if !in_word && rest[..length].contains(['.', 'e']) => {
                out += &if brackets.ends_with(&['[', '[']) { component(number) } else { written(number) };
                rest = &rest[length..];
                continue;
            }
            _ => {}
        }
        match next {
            '[' | '(' | '{' => brackets.push(next),
            ']' | ')' | '}' => drop(brackets.pop()),
            '"' => quoted = !quoted,
            _ => {}
        }
        let taken = if length > 0 { length } else { next.len_utf8() };
        out += &rest[..taken];
        rest = &rest[taken..];
    }
    out
}

#[derive(Default)]
pub struct Table(String);

impl Table {
    /// Writes `name: found`, in as many lines as necessary.
    pub fn row(&mut self, name: &str, found: impl Debug) {
        let text = format!("{}: {}", name.trim_start(), rounded(&format!("{found:?}")));
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

    /// Writes rows for a result, or the reason why there is none, without the number in it, which may be rounding.
    pub fn found<T>(&mut self, name: &str, found: Result<T, Error>, rows: impl FnOnce(&mut Self, T)) {
        match found {
            Ok(found) => rows(self, found),
            Err(Error::Domain { quantity, allowed, .. }) => {
                self.row(name, format_args!("refused, {quantity} to be {allowed}"));
            }
            Err(Error::Unsupported { what, why }) => self.row(name, format_args!("refused, {what} since {why}")),
            Err(Error::NotConverged { what, .. }) => self.row(name, format_args!("no convergence, {what}")),
        }
    }

    /// Writes a row for a result, or the reason why there is none.
    pub fn result<T: Debug>(&mut self, name: &str, found: Result<T, Error>) {
        self.found(name, found, |table, found| table.row(name, found));
    }

    /// Compares with the reviewed table.
    pub fn check(self, name: &str) {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("../../../golden/values");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, self.0));
    }
}
