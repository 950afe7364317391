//! `twofold bounds`.

use std::fmt::Write as _;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, LineStyle, Table};
use serde_json::{Value, json};

use super::{BoundsArgs, Failure, print};
use crate::golden::pulsar_bounds::{PrintedBounds, columns};
use crate::golden::{GoldenLine, Printed};
use crate::pulsar_table::{CONFIDENCE, Figure, Pulsar, eta_at_confidence, pulsars_in_file};

pub(super) fn bounds(args: &BoundsArgs) -> Result<(), Failure> {
    let pulsars: Vec<(Pulsar, Option<PrintedBounds>)> = match &args.file {
        None => columns().into_iter().map(|(pulsar, printed)| (pulsar, Some(printed))).collect(),
        Some(path) => {
            let pulsars = pulsars_in_file(path).map_err(|error| Failure::BadInput(error.to_string()))?;
            pulsars.into_iter().map(|pulsar| (pulsar, None)).collect()
        }
    };
    let rows = pulsars
        .iter()
        .map(|(pulsar, printed)| Ok((pulsar.name.as_str(), rows(pulsar, *printed)?)))
        .collect::<Result<Vec<_>, twofold::Error>>()
        .map_err(|error| Failure::Failed(error.to_string()))?;
    if args.json {
        return print(&format!("{:#}\n", Value::Array(rows.iter().map(|(name, rows)| as_json(name, rows)).collect())));
    }
    let mut text = String::new();
    for (name, rows) in &rows {
        let _ = writeln!(text, "{name}\n{}\n", table(rows).trim_fmt());
    }
    let _ = writeln!(
        text,
        "Uncertainties are standard ones, from those of the input: as given, or of the last digit written. The bounds in eta are\n\
         orders of magnitude: eta = {:.0} is not exceeded with {:.0} % probability by a star of whose spin axis and line of sight\n\
         nothing is known, if the tensor has one axis of symmetry. docs/bounds.md says how eta is found.",
        eta_at_confidence(),
        CONFIDENCE * 100.0
    );
    print(&text)
}

/// A figure and what the paper prints for it.
type Row = (Figure, Option<GoldenLine>);

fn rows(pulsar: &Pulsar, printed: Option<PrintedBounds>) -> Result<Vec<Row>, twofold::Error> {
    let beside = |figure: Figure| {
        let printed = printed.and_then(|printed| match figure.key {
            "lambda_change" => Some((Printed::Decimal(printed.lambda_change), 1.0)),
            "bound_over_eta" | "bound_over_eta_round" => Some((Printed::Order(printed.bound), 1e16)),
            "bound" => Some((Printed::Order(printed.conservative), 1e16)),
            _ => None,
        });
        let line = printed.map(|(printed, unit)| GoldenLine::new("", printed, figure.value * unit));
        (figure, line)
    };
    Ok(pulsar.figures()?.into_iter().map(beside).collect())
}

/// The printed number: a decimal as it stands, a power of ten in units of one.
fn as_printed(line: &GoldenLine) -> String {
    match line.printed {
        Printed::Decimal(text) => text.to_owned(),
        Printed::Order(text) => text.parse().map_or(text.to_owned(), |x: f64| format!("~{:.0e}", x * 1e-16)),
        Printed::No => String::new(),
    }
}

fn table(rows: &[Row]) -> Table {
    let compares = rows.iter().any(|(_, line)| line.is_some());
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table.load_style(NOTHING.header_separator(line).bottom_border(line));
    let header = ["", "value", "+-", "printed", "verdict"];
    table.set_header(&header[..if compares { 5 } else { 3 }]);
    for column in [1, 2, 3] {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    // The paper's round number is of interest beside the paper's bounds alone.
    for (figure, line) in rows.iter().filter(|(figure, _)| compares || figure.key != "bound_over_eta_round") {
        let mut cells = vec![figure.label.clone(), rounded(figure.value), rounded(figure.uncertainty)];
        if compares {
            cells.push(line.as_ref().map(as_printed).unwrap_or_default());
            cells.push(line.as_ref().map_or("", GoldenLine::verdict).to_owned());
        }
        table.add_row(cells);
    }
    table
}

/// Three digits, two of an exponent if there is one.
fn rounded(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-2..1e4).contains(&x.abs()) {
        format!("{x:.3}")
    } else {
        format!("{x:.2e}")
    }
}

fn as_json(name: &str, rows: &[Row]) -> Value {
    let figure = |(figure, line): &Row| {
        json!({
            "figure": figure.key,
            "label": figure.label,
            "value": figure.value,
            "uncertainty": figure.uncertainty,
            "printed": line.as_ref().map(as_printed),
            "verdict": line.as_ref().map(GoldenLine::verdict),
        })
    };
    json!({ "name": name, "figures": rows.iter().map(figure).collect::<Vec<_>>() })
}
