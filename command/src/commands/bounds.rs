//! `twofold bounds`.

use clap::Args;
use std::fmt::Write as _;

use serde_json::{Value, json};

use super::{Failure, print};
use crate::text_table::text_table;
use twofold_scene::pulsar_table::published::{PrintedBounds, printed_bounds, published};
use twofold_scene::pulsar_table::{
    COMBINATION, CONFIDENCE, CONSERVATIVE_ETA, Figure, Limit, Pulsar, ROUND_INERTIA_OVER_C, pulsars_in_file,
    recommended,
};

#[derive(Args)]
pub(crate) struct BoundsArgs {
    /// A table of pulsars (TOML)
    pub(crate) file: Option<String>,
    /// Print the same as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// What the recommended limit includes and what it neglects.
const INCLUDES: [&str; 5] = [
    "the error of Delta W, where one is given",
    "the uncertainties of the other numbers, as given or of their last digits",
    "directions, unless eta or beta_0 is given: an isotropic prior on the orientation of the axes of s, at the known lambda",
    "s symmetric about Z, which has the largest eta at 95 % if nothing is known of its axes",
    "the star's own deformation, unless I^zz/C is given: 4/Omega^2 by the paper's virial relation T_rot = 2C of a fluid",
];
const LEAVES_OUT: [&str; 2] = [
    "relativistic structure of the star, beams that are not cones, other causes of a change of width",
    "the gain from several pulses together and, for alpha_2, from the directions of w and of the pulsars",
];

/// Note for a pulse whose limits are rough.
const ROUGH: &str = "Note: within the uncertainties of the angles and the width Delta lambda changes by more than a third of itself. Limits are of first order \
in them: here they may hold at less than 95 %";

pub(super) fn bounds(args: &BoundsArgs) -> Result<(), Failure> {
    let pulsars: Vec<(Pulsar, Option<PrintedBounds>)> = match &args.file {
        None => printed_bounds().into_iter().map(|(pulsar, printed)| (pulsar, Some(printed))).collect(),
        Some(path) => {
            let pulsars = pulsars_in_file(path)?;
            pulsars.into_iter().map(|pulsar| (pulsar, None)).collect()
        }
    };
    let rows = pulsars
        .iter()
        .map(|(pulsar, printed)| Ok((pulsar, rows(pulsar, *printed)?)))
        .collect::<Result<Vec<_>, String>>()
        .map_err(Failure::Failed)?;
    let table: Vec<Pulsar> = pulsars.iter().map(|(pulsar, _)| pulsar.clone()).collect();
    let (chosen, limit) = recommended(&table).map_err(Failure::Failed)?;
    let of_chosen = rows.iter().find(|(pulsar, _)| *pulsar == chosen);
    if args.json {
        let pulses: Vec<_> = rows.iter().map(|(pulsar, rows)| as_json(pulsar, rows)).collect::<Result<_, _>>()?;
        let recommended = json!({
            "pulse": chosen.name, "source": chosen.source, "quantity": COMBINATION, "limit": limit.all,
            "limit_without_error": of_chosen.and_then(|(_, rows)| value_of(rows, "limit_without_error")),
            "alpha_2": of_chosen.and_then(|(_, rows)| value_of(rows, "alpha_2_limit")),
            "confidence": CONFIDENCE, "includes": INCLUDES, "leaves_out": LEAVES_OUT,
        });
        let published = published().map(|p| {
            json!({ "quantity": p.quantity, "limit": p.limit, "meaning": p.meaning, "source": p.source, "seen": p.seen })
        });
        let all = json!({
            "confidence": CONFIDENCE, "pulses": pulses, "recommended": recommended, "published": published.collect::<Vec<_>>(),
        });
        return print(&format!("{all:#}\n"));
    }
    let mut text = format!("Bounds and limits are on {COMBINATION}; limits hold at {}\n\n", percent());
    for (pulsar, rows) in &rows {
        let _ = writeln!(text, "{}", pulsar.name);
        if let Some(source) = &pulsar.source {
            let _ = writeln!(text, "Source: {source}");
        }
        if pulsar.measured_change().is_none() {
            let _ = writeln!(text, "Delta W has no error: it is taken as a limit");
        }
        let _ = writeln!(text, "{}", table_of(rows));
        if pulsar.is_rough().map_err(Failure::Failed)? {
            let _ = writeln!(text, "{ROUGH}");
        }
        text.push('\n');
    }
    text.push_str(&recommendation(chosen, &limit, of_chosen.map_or(&[], |(_, rows)| rows)));
    let _ = writeln!(
        text,
        "\nLimits published by others; components in the Sun-centred frame, most from fits with all of them free"
    );
    let _ = writeln!(text, "{}", published_table());
    print(&text)
}

/// A row in the table of a pulse.
struct Row {
    key: &'static str,
    label: String,
    value: f64,
    /// Standard uncertainties from the change of width and from the other numbers, for rows that are not limits.
    from_change: Option<f64>,
    from_inputs: Option<f64>,
    /// The paper's number.
    printed: Option<String>,
}

impl Row {
    fn over_printed(&self) -> Option<f64> {
        let printed: f64 = self.printed.as_ref()?.trim_start_matches('~').parse().ok()?;
        Some(self.value / printed)
    }
}

impl From<Figure> for Row {
    fn from(figure: Figure) -> Self {
        let Figure { key, label, value, from_change, from_inputs } = figure;
        Self { key, label, value, from_change, from_inputs: Some(from_inputs), printed: None }
    }
}

fn rows(pulsar: &Pulsar, printed: Option<PrintedBounds>) -> Result<Vec<Row>, String> {
    // The paper prints orders of magnitude in 1e-16, without eta and with eta = 10.
    let order = |text: &str| text.parse().map_or(text.to_owned(), |x: f64| format!("~{:.0e}", x * 1e-16));
    let over_eta = || printed.map(|printed| order(printed.bound));
    let with_ten = || printed.map(|printed| order(printed.conservative));
    let mut rows = Vec::new();
    for figure in pulsar.figures()? {
        let beside = match figure.key {
            "lambda_change" => printed.map(|printed| printed.lambda_change.to_owned()),
            "bound_over_eta_stated" | "bound_over_eta_own" => over_eta(),
            _ => None,
        };
        rows.push(Row { printed: beside, ..Row::from(figure.clone()) });
        // The paper's bounds are compared with those for its eta and its rounded I^zz/C.
        if printed.is_none() {
            continue;
        }
        let (label, value) = (&figure.label, figure.value);
        let scaled = |key, label, factor: f64, printed| {
            let from_change = figure.from_change.map(|x| x * factor);
            let from_inputs = Some(figure.from_inputs * factor);
            Row { key, label, value: value * factor, from_change, from_inputs, printed }
        };
        let ten = format!("{}, eta = {CONSERVATIVE_ETA}", label.trim_end_matches(" / eta"));
        match figure.key {
            "bound_over_eta_stated" => {
                rows.push(scaled("bound_eta_ten_stated", ten, CONSERVATIVE_ETA, with_ten()));
                let round = pulsar.bound_over_eta(ROUND_INERTIA_OVER_C)? / value;
                rows.push(scaled("bound_over_eta_round", format!("{label}, I^zz/C = 1e-5 s^2"), round, over_eta()));
            }
            "bound_over_eta_own" => rows.push(scaled("bound_eta_ten_own", ten, CONSERVATIVE_ETA, with_ten())),
            _ => {}
        }
    }
    let own = pulsar.figure("bound_over_eta_own")?;
    let limit = pulsar.limit(&own)?;
    let mut push = |key, label: &str, value, printed| {
        rows.push(Row { key, label: label.to_owned(), value, from_change: None, from_inputs: None, printed });
    };
    if let Some(by_change) = limit.over_eta_by_change {
        push("limit_over_eta_by_change", "(c) as (b), with the error of Delta W: limit / eta", by_change, over_eta());
        if printed.is_some() {
            let ten = format!("(c) as (b), with the error of Delta W: limit, eta = {CONSERVATIVE_ETA}");
            push("limit_eta_ten_by_change", &ten, by_change * CONSERVATIVE_ETA, with_ten());
        }
    }
    push("limit_over_eta_by_inputs", "input uncertainties only: limit / eta", limit.over_eta_by_inputs, None);
    let unknown = pulsar.directions()?.is_some();
    push("eta", if unknown { "directions only, lambda known: limit on eta" } else { "eta as given" }, limit.eta, None);
    if limit.over_eta_by_change.is_some() {
        let without = pulsar.limit(&Figure { from_change: None, ..own })?.all;
        push("limit_without_error", "all but the error of Delta W: limit", without, with_ten());
    }
    push("limit", "total: limit", limit.all, with_ten());
    if let Ok(alpha_2) = pulsar.figure("alpha_2_over_eta_own") {
        push("alpha_2_limit", "total: limit on |alpha_2|", pulsar.limit(&alpha_2)?.all, None);
    }
    Ok(rows)
}

fn table_of(rows: &[Row]) -> String {
    let measured = rows.iter().any(|row| row.from_change.is_some());
    let compares = rows.iter().any(|row| row.printed.is_some());
    let mut header = vec!["", "value"];
    header.extend(measured.then_some("+- by Delta W"));
    header.push("+- by inputs");
    header.extend(compares.then_some(["printed", "ours/printed"]).into_iter().flatten());
    let mut table = vec![header.into_iter().map(String::from).collect()];
    let cell = |x: Option<f64>| x.map(rounded).unwrap_or_default();
    for row in rows {
        let mut cells = vec![row.label.clone(), rounded(row.value)];
        cells.extend(measured.then(|| cell(row.from_change)));
        cells.push(cell(row.from_inputs));
        if compares {
            cells.extend([
                row.printed.clone().unwrap_or_default(),
                row.over_printed().map_or(String::new(), two_digits),
            ]);
        }
        table.push(cells);
    }
    text_table(&table, |column| column > 0, true)
}

fn published_table() -> String {
    let mut table = vec![["", "limit", "", "source", "seen"].map(String::from).to_vec()];
    for p in published() {
        let limit = format!("{:.1e}", p.limit);
        table.push([p.quantity, &limit, p.meaning, p.source, p.seen].map(String::from).to_vec());
    }
    text_table(&table, |column| column == 1, true)
}

fn recommendation(pulsar: &Pulsar, limit: &Limit, rows: &[Row]) -> String {
    let mut text = format!("Recommended: {COMBINATION} < {:.1e} at {} confidence", limit.all, percent());
    if let Some(alpha_2) = value_of(rows, "alpha_2_limit") {
        let _ = write!(text, ", so that |alpha_2| < {alpha_2:.1e}");
    }
    let _ = writeln!(text, "\n  from {}", pulsar.name);
    if let Some(source) = &pulsar.source {
        let _ = writeln!(text, "  Source: {source}");
    }
    if let Some(without) = value_of(rows, "limit_without_error") {
        let _ = writeln!(text, "  Without the error of Delta W, with its value taken as exact: {without:.1e}");
    }
    text.push_str(
        "  This pulse has the best expected sensitivity, the strongest limit for a Delta W of zero or for the limit given:\n\
         \x20 the choice depends on the errors, not on the measured values.",
    );
    text.push_str(match pulsar.measured_change() {
        Some(_) => " With random directions and errors the limit is above the true value in 95 % of cases or more.\n",
        None => " Delta W is taken as a limit: the confidence is that of the other numbers and directions.\n",
    });
    for (what, list) in [("Included", &INCLUDES[..]), ("Left out", &LEAVES_OUT[..])] {
        let _ = writeln!(text, "  {what}:");
        for item in list {
            let _ = writeln!(text, "  - {item}");
        }
    }
    text
}

fn value_of(rows: &[Row], key: &str) -> Option<f64> {
    rows.iter().find(|row| row.key == key).map(|row| row.value)
}

fn percent() -> String {
    format!("{:.0} %", CONFIDENCE * 100.0)
}

/// Three digits; two for a number with an exponent.
fn rounded(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-2..1e4).contains(&x.abs()) {
        format!("{x:.3}")
    } else {
        format!("{x:.2e}")
    }
}

fn two_digits(x: f64) -> String {
    if x.abs() < 9.95 { format!("{x:.*}", if x.abs() < 0.995 { 2 } else { 1 }) } else { format!("{x:.0}") }
}

fn as_json(pulsar: &Pulsar, rows: &[Row]) -> Result<Value, Failure> {
    let figure = |row: &Row| {
        json!({
            "figure": row.key,
            "label": row.label,
            "value": row.value,
            "uncertainty_by_change": row.from_change,
            "uncertainty_by_inputs": row.from_inputs,
            "printed": row.printed,
            "over_printed": row.over_printed(),
        })
    };
    Ok(json!({
        "name": pulsar.name,
        "source": pulsar.source,
        "change_is": if pulsar.measured_change().is_some() { "measured" } else { "a limit" },
        "is_rough": pulsar.is_rough().map_err(Failure::Failed)?,
        "figures": rows.iter().map(figure).collect::<Vec<_>>(),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text_table::cells;

    #[test]
    fn numbers_have_the_digits_that_are_read() {
        let three = [
            (0.0, "0"),
            (0.009_9, "9.90e-3"),
            (0.01, "0.010"),
            (-9999.9, "-9999.900"),
            (1e4, "1.00e4"),
            (-2.5e-16, "-2.50e-16"),
        ];
        for (x, text) in three {
            assert_eq!(rounded(x), text);
        }
        for (x, text) in [(0.994, "0.99"), (0.996, "1.0"), (9.94, "9.9"), (9.96, "10"), (-0.5, "-0.50"), (-20.4, "-20")]
        {
            assert_eq!(two_digits(x), text);
        }
    }

    fn row(from_change: Option<f64>, printed: Option<&str>) -> Row {
        let (key, label, printed) = ("limit", "a limit".to_owned(), printed.map(String::from));
        Row { key, label, value: 3.14e-16, from_change, from_inputs: Some(0.0), printed }
    }

    #[test]
    fn columns_without_numbers_are_left_out() {
        let (plain, measured, printed) = (row(None, None), row(Some(2e-17), None), row(None, Some("~1e-16")));
        let table = table_of(&[plain]);
        assert_eq!(cells(&table), [vec!["value", "+- by inputs"], vec!["a limit", "3.14e-16", "0"]]);
        let table = table_of(&[measured]);
        let header = vec!["value", "+- by Delta W", "+- by inputs"];
        assert_eq!(cells(&table), [header, vec!["a limit", "3.14e-16", "2.00e-17", "0"]]);
        let table = table_of(&[printed]);
        let header = vec!["value", "+- by inputs", "printed", "ours/printed"];
        assert_eq!(cells(&table), [header, vec!["a limit", "3.14e-16", "0", "~1e-16", "3.1"]]);
        // Words are on the left, numbers on the right, and a rule is below.
        let lines: Vec<_> = table.lines().collect();
        assert!(lines[2].starts_with(" a limit ") && lines[3].contains('─'), "{table}");
        assert_eq!(lines[0].find("value").map(|k| k + 5), lines[2].find("3.14e-16").map(|k| k + 8), "{table}");
    }

    #[test]
    fn limits_of_others_have_their_numbers_on_the_right() {
        let table = published_table();
        let lines: Vec<_> = table.lines().collect();
        assert!(lines[lines.len() - 1].contains('─'), "{table}");
        // The numbers have equal lengths and the title is shorter: it ends where they do.
        let limit = published().next().map(|first| format!("{:.1e}", first.limit)).expect("a limit");
        assert_eq!(lines[0].find("limit").map(|k| k + 5), lines[2].find(&limit).map(|k| k + limit.len()), "{table}");
        assert_eq!(lines[0].find("source"), lines[2].find("12 pulsar systems"), "{table}");
    }

    /// A measured change of width has the stated confidence; a change that is taken as a limit adds none.
    #[test]
    fn the_recommendation_tells_how_the_limit_was_chosen() {
        let text = |change: &str| {
            let pulsar = format!(
                "[[pulsar]]\nname = \"x\"\nspin_period = 4.1e-3\nwidth = 13\nwidth_change = {change}\nlambda = 95\nchi = 51\nyears = 15\n"
            );
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join("x.toml");
            std::fs::write(&path, pulsar).expect("a file");
            let table = pulsars_in_file(path.to_str().expect("a path")).expect("a table");
            let (chosen, limit) = recommended(&table).expect("a limit");
            recommendation(chosen, &limit, &rows(chosen, None).expect("rows"))
        };
        let (measured, stated) = (text("[0.020, 0.108]"), text("0.020"));
        for part in [
            "or for the limit given:\n  the choice depends on the errors, not on the measured values. ",
            "  Included:\n  - the error of Delta W",
        ] {
            assert!(measured.contains(part) && stated.contains(part), "{measured}{stated}");
        }
        assert!(
            measured.contains("above the true value in 95 % of cases or more.\n") && !stated.contains("95 % of cases")
        );
        assert!(stated.contains("Delta W is taken as a limit: ") && !measured.contains("taken as a limit"));
    }
}
