//! Sweeps, bounds and what is told of data, against the answers of a second program (`verify/second_program/further.py`).

mod common;

use std::fs;
use std::path::Path;

use common::{folder, stderr, twofold};
use serde_json::Value;

/// The rows of an output as texts: of a table, or what stands in an object at the places that the expected rows name.
fn rows(text: &str, output: &Value, expected: &[Value]) -> Vec<Vec<String>> {
    if output["separator"] == "json" {
        let object: Value = serde_json::from_str(text).expect("JSON");
        let at = |row: &Value| {
            let place = row[0].as_str().expect("a place");
            let found = match object.pointer(place) {
                None => "nothing".to_owned(),
                Some(Value::Null) => String::new(),
                Some(Value::String(words)) => words.clone(),
                Some(other) => other.to_string(),
            };
            vec![place.to_owned(), found]
        };
        return expected.iter().map(at).collect();
    }
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|record| record.expect("a row").iter().map(str::to_owned).collect()).collect()
}

/// The cells that differ from what is expected, in words. Each number has its tolerance; texts and whole numbers are the same.
fn differences(text: &str, output: &Value) -> Vec<String> {
    let expected = output["rows"].as_array().expect("rows");
    let found = rows(text, output, expected);
    if found.len() != expected.len() {
        return vec![format!("{} rows, expected are {}", found.len(), expected.len())];
    }
    let mut wrong = Vec::new();
    for (line, (found, expected)) in found.iter().zip(expected).enumerate() {
        let expected = expected.as_array().expect("a row");
        if found.len() != expected.len() {
            wrong.push(format!("row {line} has {} fields, expected are {}", found.len(), expected.len()));
            continue;
        }
        for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
            let tolerance = output["tolerances"][line][k].as_f64().expect("a tolerance");
            let same = match expected {
                Value::Number(exact) if exact.is_f64() => {
                    let exact = exact.as_f64().expect("a double");
                    found.parse::<f64>().is_ok_and(|found| (found - exact).abs() <= tolerance)
                }
                Value::String(words) => found == words,
                count => count.is_i64() && found.parse().ok() == count.as_i64(),
            };
            if !same {
                wrong.push(format!("row {line}, column {k}: {found}, expected is {expected} to {tolerance:e}"));
            }
        }
    }
    wrong
}

/// Where the estimated error of a sweep is below the true one of the symmetry axis, in words; the second program's own error is some 1e-13.
fn estimates_below(text: &str, output: &Value) -> Vec<String> {
    let found = rows(text, output, &[]);
    let number = |text: &str| text.parse::<f64>().ok();
    let mut wrong = Vec::new();
    let of_axis = |title: &str| ["e_z_X@", "e_z_Y@", "e_z_Z@"].iter().any(|name| title.starts_with(name));
    for (k, title) in found[0].iter().enumerate().filter(|(_, title)| of_axis(title)) {
        let time = title.split(['@', ' ']).nth(1).expect("a time");
        let estimate = format!("error_estimate@{time} [1]");
        let Some(estimate) = found[0].iter().position(|title| *title == estimate) else { continue };
        for (line, row) in found.iter().enumerate().skip(1) {
            let exact = output["rows"][line][k].as_f64().expect("a double");
            let (found, stated) = (number(&row[k]).expect("a number"), number(&row[estimate]).expect("an estimate"));
            if (found - exact).abs() > stated + 3e-13 {
                wrong.push(format!("row {line}, {title}: off by {:e}, estimated {stated:e}", (found - exact).abs()));
            }
        }
    }
    wrong
}

/// Compares every answer for a command.
fn compare(command: &str, least: usize) {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("second_program");
    let (mut compared, mut wrong) = (0, Vec::new());
    for entry in fs::read_dir(home.join("further_answers")).expect("answers") {
        let path = entry.expect("entry").path();
        let all: Value = serde_json::from_str(&fs::read_to_string(&path).expect("text")).expect("JSON");
        for answer in all.as_array().expect("commands").iter().filter(|answer| answer["arguments"][0] == command) {
            let out = folder();
            let (home, out_path) = (home.to_str().expect("UTF-8"), out.path().to_str().expect("UTF-8"));
            let arguments =
                answer["arguments"].as_array().expect("arguments").iter().map(|a| a.as_str().expect("text"));
            let arguments: Vec<_> = arguments.map(|a| a.replace("{here}", home).replace("{out}", out_path)).collect();
            let output = twofold(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
            assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
            for (name, expected) in answer["outputs"].as_object().expect("outputs") {
                let differences = match name.as_str() {
                    "stderr" => {
                        let (told, wanted) = (stderr(&output), expected.as_array().expect("texts"));
                        let missing = wanted.iter().filter(|words| !told.contains(words.as_str().expect("a text")));
                        missing.map(|words| format!("no {words} in {told}")).collect()
                    }
                    "stdout" => differences(&String::from_utf8_lossy(&output.stdout), expected),
                    file => {
                        let text = fs::read_to_string(out.path().join(file)).expect("a table");
                        let estimates = if command == "sweep" { estimates_below(&text, expected) } else { Vec::new() };
                        [differences(&text, expected), estimates].concat()
                    }
                };
                compared += 1;
                wrong.extend(differences.iter().map(|why| format!("{}: {name}: {why}", path.display())));
            }
        }
    }
    assert!(compared >= least, "only {compared} outputs of `{command}`");
    assert!(wrong.is_empty(), "{} differences:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn tables_of_sweeps_are_those_of_the_second_program() {
    compare("sweep", 8);
}

#[test]
fn fisher_matrices_are_those_of_derivatives_by_differences() {
    compare("fisher", 6);
}

/// Values, error bars, correlations and `chi^2`.
#[test]
fn fits_end_where_those_of_the_second_program_end() {
    compare("fit", 10);
}

#[test]
fn forecasts_are_those_of_the_second_program() {
    compare("forecast", 2);
}

#[test]
fn bounds_follow_from_the_numbers_of_the_tables() {
    compare("bounds", 3);
}
