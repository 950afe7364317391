//! What the command writes against the answers of a second program, which shares nothing with this one: `verify/second_program`.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{folder, stderr, twofold};
use rayon::prelude::*;
use serde_json::Value;

fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("second_program")
}

/// All files of answers.
fn answers() -> Vec<Value> {
    let mut paths: Vec<_> =
        fs::read_dir(home().join("answers")).expect("answers").map(|entry| entry.expect("entry").path()).collect();
    paths.sort();
    let read = |path: &PathBuf| serde_json::from_str(&fs::read_to_string(path).expect("text")).expect("JSON");
    paths.iter().map(read).collect()
}

/// The first difference between a text and the table that is expected, in words. A double may differ by the tolerance of its column; whole numbers and
/// texts are the same; `*` is any number.
fn difference(text: &str, table: &Value) -> Option<String> {
    let rows = table["rows"].as_array().expect("rows");
    let tolerances = table["tolerances"].as_array().expect("tolerances");
    let comma = table["separator"] == ",";
    let lines: Vec<_> = text.lines().collect();
    if lines.len() != rows.len() {
        return Some(format!("{} lines, expected are {}", lines.len(), rows.len()));
    }
    for (line, row) in lines.iter().zip(rows) {
        let row = row.as_array().expect("a row");
        let cells: Vec<_> = if comma { line.split(',').collect() } else { line.split_whitespace().collect() };
        if cells.len() != row.len() {
            return Some(format!("`{line}` has {} fields, expected are {}", cells.len(), row.len()));
        }
        for (k, (cell, expected)) in cells.iter().zip(row).enumerate() {
            let number = cell.parse::<f64>();
            let same = match expected {
                Value::Number(exact) if exact.is_f64() => {
                    let (exact, tolerance) =
                        (exact.as_f64().expect("a double"), tolerances[k].as_f64().expect("a tolerance"));
                    number.is_ok_and(|x| (x - exact).abs() <= tolerance)
                }
                Value::Number(count) => *cell == count.to_string(),
                Value::String(any) if any == "*" => number.is_ok(),
                Value::String(words) => cell == words,
                _ => false,
            };
            if !same {
                return Some(format!("column {k}: {cell}, expected is {expected} to {} in\n{line}", tolerances[k]));
            }
        }
    }
    None
}

/// What is wrong with the outputs of one command, or nothing.
fn failures(scene: &str, command: &Value) -> Vec<String> {
    let out = folder();
    let path = home().join("scenes").join(format!("{scene}.toml"));
    let (path, out_path) = (path.to_str().expect("UTF-8"), out.path().to_str().expect("UTF-8"));
    let arguments = command["arguments"].as_array().expect("arguments").iter().map(|a| a.as_str().expect("a text"));
    let arguments: Vec<_> = arguments.map(|a| a.replace("{scene}", path).replace("{out}", out_path)).collect();
    let output = twofold(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    if !output.status.success() {
        return vec![format!("{arguments:?}: {}", stderr(&output))];
    }
    let outputs = command["outputs"].as_object().expect("outputs");
    let wrong = outputs.iter().filter_map(|(name, table)| {
        let text = match name.as_str() {
            "stdout" => String::from_utf8_lossy(&output.stdout).into_owned(),
            file => fs::read_to_string(out.path().join(file)).unwrap_or_else(|why| format!("{file}: {why}")),
        };
        difference(&text, table).map(|why| format!("{} {scene}: {name}: {why}", arguments[0]))
    });
    wrong.collect()
}

/// Compares every command of a name.
fn compare(command_name: &str, least: usize) {
    let all = answers();
    let commands: Vec<_> = all
        .iter()
        .flat_map(|answer| answer["commands"].as_array().expect("commands").iter().map(move |c| (&answer["scene"], c)))
        .filter(|(_, command)| command["arguments"][0] == command_name)
        .collect();
    assert!(commands.len() >= least, "only {} answers for `{command_name}`", commands.len());
    let wrong: Vec<_> = commands
        .par_iter()
        .flat_map_iter(|(scene, command)| failures(scene.as_str().expect("a name"), command))
        .collect();
    assert!(wrong.is_empty(), "{} of {} outputs:\n{}", wrong.len(), commands.len(), wrong.join("\n"));
}

#[test]
fn columns_of_run_are_those_of_the_second_program() {
    compare("run", 57);
}

#[test]
fn pulses_are_those_of_the_second_program() {
    compare("pulses", 57);
}

#[test]
fn timing_files_are_those_of_the_second_program() {
    compare("timing", 16);
}
