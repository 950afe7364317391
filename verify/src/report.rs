//! Checks and their results, as tables for a reader and as JSON for a program.

use std::fmt::Write as _;

use crate::prelude::*;
use comfy_table::presets::{NOTHING, UTF8_HORIZONTAL_ONLY};
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table, Width};
use serde_json::{Value, json};

/// A check and its outcome.
pub type Result = (Check, Outcome);

/// The kinds of checks in the order of the list, with a description of each.
pub const KINDS: [(Kind, &str); 5] = [
    (Kind::Exact, "identities over a prime field, no tolerance"),
    (Kind::Autodiff, "the paper's formulas against automatic derivatives"),
    (Kind::Oracle, "another method or another source"),
    (Kind::Property, "invariants, symmetries and round trips at random points"),
    (Kind::Regime, "errors of approximations, and where they hold"),
];

/// A table per kind of check, `width` characters wide, and below them each failure with its reason; if `detailed`, also
/// the meaning of each figure.
pub fn tables(results: &[Result], width: u16, detailed: bool) -> String {
    let longest_id = results.iter().map(|(check, _)| check.id.len()).max().unwrap_or(0);
    let id_width = u16::try_from(longest_id).unwrap_or(u16::MAX).max(6).saturating_add(2);
    let mut text = String::new();
    for (kind, about) in KINDS {
        let of_kind: Vec<_> = results.iter().filter(|(check, _)| check.kind == kind).collect();
        if !of_kind.is_empty() {
            let _ = writeln!(
                text,
                "\n{} ({}): {about}\n{}",
                kind.name(),
                of_kind.len(),
                table(&of_kind, id_width, width, detailed).trim_fmt()
            );
        }
    }
    for (check, outcome) in results.iter().filter(|(_, outcome)| !outcome.passed) {
        let _ = writeln!(text, "\n{}", failure(check, outcome));
    }
    text
}

fn table(results: &[&Result], id_width: u16, width: u16, detailed: bool) -> Table {
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table
        .load_style(if detailed { UTF8_HORIZONTAL_ONLY } else { NOTHING.header_separator(line).bottom_border(line) })
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(width)
        .set_header([
            "check",
            "Eqs.",
            if detailed { "statement, and the number measured for it" } else { "statement" },
            "measured",
            "bound",
            "verdict",
        ]);
    // The widths are fixed, so that the tables of all kinds line up. The text gets the rest.
    let (others, separators) = ([9, 12, 18, 9], 5);
    let text = width.saturating_sub(id_width + others.iter().sum::<u16>() + separators).max(30);
    let [equations_width, measured_width, bound_width, verdict_width] = others;
    let widths = [id_width, equations_width, text, measured_width, bound_width, verdict_width];
    for (column, width) in table.column_iter_mut().zip(widths) {
        column.set_constraint(ColumnConstraint::Absolute(Width::Fixed(width)));
    }
    if let Some(column) = table.column_mut(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    for (check, outcome) in results {
        table.add_row([
            check.id.to_owned(),
            equations(check.equations),
            if detailed { format!("{}\n[{}]", check.statement, check.figure) } else { check.statement.to_owned() },
            measured(outcome),
            check.bound.to_string(),
            verdict(outcome).to_owned(),
        ]);
    }
    table
}

/// One line: the number of passed checks, and the total time.
pub fn summary(results: &[Result], seconds: f64) -> String {
    let failed = results.iter().filter(|(_, outcome)| !outcome.passed).count();
    let checks = if results.len() == 1 { "check" } else { "checks" };
    let verdict = if failed == 0 { "all pass".to_owned() } else { format!("{failed} FAIL") };
    format!("{} {checks} in {seconds:.1} s: {verdict}", results.len())
}

/// The results as a JSON array, one object per check in the order of the list. A figure that is not finite is `null`.
pub fn json(results: &[Result]) -> String {
    let objects: Vec<Value> = results
        .iter()
        .map(|(check, outcome)| {
            let measured = outcome.measured.as_ref();
            json!({
                "id": check.id,
                "kind": check.kind.name(),
                "equations": check.equations,
                "statement": check.statement,
                "figure": check.figure,
                "measured": measured.map(|m| m.figure).ok(),
                "detail": measured.map(|m| m.detail.as_str()).ok(),
                "error": measured.err(),
                "bound": match check.bound {
                    Bound::AtMost(limit) => json!({ "at_most": limit }),
                    Bound::AtLeast(limit) => json!({ "at_least": limit }),
                    Bound::Within(low, high) => json!({ "at_least": low, "at_most": high }),
                },
                "reason": check.reason,
                "passed": outcome.passed,
                "seconds": outcome.seconds,
            })
        })
        .collect();
    format!("{:#}", Value::Array(objects))
}

fn failure(check: &Check, outcome: &Outcome) -> String {
    let found = match &outcome.measured {
        Ok(measured) => format!("{}: {:e}\n    {}", check.figure, measured.figure, measured.detail),
        Err(message) => message.clone(),
    };
    format!("FAIL {}: {}\n    {found}\n    required {} ({})", check.id, check.statement, check.bound, check.reason)
}

/// The measured figure with four digits.
pub fn measured(outcome: &Outcome) -> String {
    match &outcome.measured {
        Ok(measured) if measured.figure == 0.0 => "0".to_owned(),
        Ok(measured) if (1e-2..1e5).contains(&measured.figure.abs()) => format!("{:.4}", measured.figure),
        Ok(measured) => format!("{:.3e}", measured.figure),
        Err(_) => "none".to_owned(),
    }
}

/// The verdict in a word.
pub fn verdict(outcome: &Outcome) -> &'static str {
    if outcome.passed { "pass" } else { "FAIL" }
}

/// Equation numbers with runs combined: `21-25, 36`.
fn equations(numbers: &[u8]) -> String {
    let mut runs: Vec<(u8, u8)> = Vec::new();
    for &n in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == n => *last = n,
            _ => runs.push((n, n)),
        }
    }
    let run = |&(first, last): &(u8, u8)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first}-{last}"),
    };
    runs.iter().map(run).collect::<Vec<_>>().join(", ")
}
