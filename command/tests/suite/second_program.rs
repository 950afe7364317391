//! The output of the command compared with the answers of a second, completely independent program: `verify/oracles/second_program`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{Folder, stderr, twofold};
use rayon::prelude::*;
use serde_json::Value;

fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../verify/oracles/second_program")
}

/// All files of answers.
fn answers() -> Vec<Value> {
    let mut paths: Vec<_> =
        fs::read_dir(home().join("answers")).expect("answers").map(|entry| entry.expect("entry").path()).collect();
    paths.sort();
    let read = |path: &PathBuf| serde_json::from_str(&fs::read_to_string(path).expect("text")).expect("JSON");
    paths.iter().map(read).collect()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn text_of(value: &Value) -> &str {
    value.as_str().expect("a text")
}

/// The rows of an output as texts: of a table, of words, or the entries of an object at the places in the expected rows.
fn rows(text: &str, output: &Value) -> Vec<Vec<String>> {
    let owned = |row: Vec<&str>| row.into_iter().map(str::to_owned).collect();
    match text_of(&output["separator"]) {
        "json" => {
            let object: Value = serde_json::from_str(text).expect("JSON");
            let at = |folder: &str| match object.pointer(folder) {
                None => "nothing".to_owned(),
                Some(Value::Null) => String::new(),
                Some(Value::String(words)) => words.clone(),
                Some(other) => other.to_string(),
            };
            list(&output["rows"])
                .iter()
                .map(|row| text_of(&row[0]))
                .map(|folder| vec![folder.to_owned(), at(folder)])
                .collect()
        }
        "," => {
            let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
            reader.records().map(|record| owned(record.expect("a row").iter().collect())).collect()
        }
        _ => text.lines().map(|line| owned(line.split_whitespace().collect())).collect(),
    }
}

/// The first difference between a text and the expected output, in words. A double may differ by the tolerance of its column, or of its cell if it
/// has one; whole numbers and texts must agree; `*` matches any number.
fn difference(text: &str, output: &Value) -> Option<String> {
    let (found, expected) = (rows(text, output), list(&output["rows"]));
    if found.len() != expected.len() {
        return Some(format!("{} rows, expected are {}", found.len(), expected.len()));
    }
    for (line, (cells, row)) in found.iter().zip(expected).enumerate() {
        let row = list(row);
        if cells.len() != row.len() {
            return Some(format!("{cells:?} has {} fields, expected are {}", cells.len(), row.len()));
        }
        for (k, (cell, expected)) in cells.iter().zip(row).enumerate() {
            let number = cell.parse::<f64>();
            let of_line = &output["tolerances"][line];
            let tolerance = if of_line.is_array() { &of_line[k] } else { &output["tolerances"][k] };
            let same = match expected {
                Value::Number(exact) if exact.is_f64() => {
                    let (exact, tolerance) =
                        (exact.as_f64().expect("a double"), tolerance.as_f64().expect("a tolerance"));
                    number.is_ok_and(|x| (x - exact).abs() <= tolerance)
                }
                Value::Number(count) => *cell == count.to_string(),
                Value::String(any) if any == "*" => number.is_ok(),
                Value::String(words) => cell == words,
                _ => false,
            };
            if !same {
                return Some(format!("column {k}: {cell}, expected is {expected} to {tolerance} in\n{cells:?}"));
            }
        }
    }
    None
}

/// Cases in which the estimated error of a sweep is below the true one of the symmetry axis, in words; the second program's own error is about 1e-13.
fn estimate_below(text: &str, output: &Value) -> Option<String> {
    let found = rows(text, output);
    let of_axis = |title: &str| ["e_z_X@", "e_z_Y@", "e_z_Z@"].iter().any(|name| title.starts_with(name));
    for (k, title) in found[0].iter().enumerate().filter(|(_, title)| of_axis(title)) {
        let time = title.split(['@', ' ']).nth(1).expect("a time");
        let estimate = format!("error_estimate@{time} [1]");
        let Some(estimate) = found[0].iter().position(|title| *title == estimate) else { continue };
        for (line, row) in found.iter().enumerate().skip(1) {
            let exact = output["rows"][line][k].as_f64().expect("a double");
            let number = |cell: &str| cell.parse::<f64>().expect("a number");
            let (off, stated) = ((number(&row[k]) - exact).abs(), number(&row[estimate]));
            if off > stated + 3e-13 {
                return Some(format!("row {line}, {title}: off by {off:e}, estimated {stated:e}"));
            }
        }
    }
    None
}

/// The parts of a dotted key such as `lorentz_violation.w[1]`: the section, if there is one, the name and the indices.
fn parts(key: &str) -> (&str, &str, Vec<usize>) {
    let (section, name) = key.split_once('.').unwrap_or(("", key));
    let mut pieces = name.split(['[', ']']).filter(|piece| !piece.is_empty());
    let name = pieces.next().expect("a name");
    (section, name, pieces.map(|index| index.parse().expect("an index")).collect())
}

/// A scene file with the line of a key replaced by another value.
fn with_value(text: &str, key: &str, value: &Value) -> String {
    let (section, name, indices) = parts(key);
    let (mut here, mut replaced) = ("", 0);
    let mut lines = Vec::new();
    for line in text.lines() {
        if let Some(title) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            here = title;
        }
        match line.split_once(" = ") {
            Some((found, old)) if here == section && found == name => {
                // Numbers, texts and lists have the same form in TOML and JSON.
                let mut whole =
                    if indices.is_empty() { value.clone() } else { serde_json::from_str(old).expect("a list") };
                if !indices.is_empty() {
                    *indices.iter().fold(&mut whole, |list, &index| &mut list[index]) = value.clone();
                }
                lines.push(format!("{name} = {whole}"));
                replaced += 1;
            }
            _ => lines.push(line.to_owned()),
        }
    }
    assert_eq!(replaced, 1, "{key}");
    lines.join("\n") + "\n"
}

/// The text of the scene of a file of answers.
fn scene_text(answer: &Value) -> String {
    let name = answer["scene"].as_str().expect("a name");
    let text = fs::read_to_string(home().join("scenes").join(format!("{name}.toml"))).expect("a scene");
    let changed = answer["changed"].as_object().expect("keys that are changed");
    changed.iter().fold(text, |text, (key, value)| with_value(&text, key, value))
}

/// The differences in the outputs of one command. Its scene is written with the changed keys, unless it names its files itself.
fn failures(answer: &Value, command: &Value) -> Vec<String> {
    let (out, home) = (Folder::new(), home());
    let about = format!("{} {}", answer["scene"], answer["changed"]);
    let path = out.path().join(format!("{}.toml", answer["scene"].as_str().unwrap_or("none")));
    if answer["scene"].is_string() {
        fs::write(&path, scene_text(answer)).expect("a scene");
    }
    let places = [("{scene}", path.as_path()), ("{here}", &home), ("{out}", out.path())];
    let placed = |text: &str| {
        places.iter().fold(text.to_owned(), |text, (name, path)| text.replace(name, path.to_str().expect("UTF-8")))
    };
    let arguments: Vec<_> = list(&command["arguments"]).iter().map(|argument| placed(text_of(argument))).collect();
    let output = twofold(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    if !output.status.success() {
        return vec![format!("{about}: {arguments:?}: {}", stderr(&output))];
    }
    let outputs = command["outputs"].as_object().expect("outputs");
    let wrong = outputs.iter().filter_map(|(name, expected)| {
        let told = || if name == "stdout" { String::from_utf8_lossy(&output.stdout).into() } else { stderr(&output) };
        let why = match name.as_str() {
            "stdout" | "stderr" if expected.is_array() => {
                let told = told();
                let missing = list(expected).iter().map(text_of).find(|words| !told.contains(words));
                missing.map(|words| format!("no `{words}` in {told}"))
            }
            "stdout" => difference(&told(), expected),
            file => match fs::read_to_string(out.path().join(file)) {
                Ok(text) if arguments[0] == "sweep" => {
                    difference(&text, expected).or_else(|| estimate_below(&text, expected))
                }
                Ok(text) => difference(&text, expected),
                Err(why) => Some(why.to_string()),
            },
        };
        why.map(|why| format!("{arguments:?} {about}: {name}: {why}"))
    });
    wrong.collect()
}

/// The commands with this name in a file of answers.
fn commands<'a>(answer: &'a Value, name: &str) -> impl Iterator<Item = &'a Value> {
    let all = answer["commands"].as_array().expect("commands");
    all.iter().filter(move |command| command["arguments"][0] == name)
}

/// Compares all commands with this name.
fn compare(name: &str, least: usize) {
    let all = answers();
    let pairs: Vec<_> =
        all.iter().flat_map(|answer| commands(answer, name).map(move |command| (answer, command))).collect();
    assert!(pairs.len() >= least, "only {} answers for `{name}`", pairs.len());
    let wrong: Vec<_> = pairs.par_iter().flat_map_iter(|(answer, command)| failures(answer, command)).collect();
    assert!(wrong.is_empty(), "{} of {} outputs:\n{}", wrong.len(), pairs.len(), wrong.join("\n"));
}

/// The differences of a one-scene sweep with one value of its key from the answers for the scene with that value in the file.
fn failure_of_sweep(answer: &Value, key: &str, value: &Value) -> Option<String> {
    let out = Folder::new();
    let text =
        fs::read_to_string(home().join("scenes").join(format!("{}.toml", text_of(&answer["scene"])))).expect("a scene");
    let scene = out.path().join("scene.toml");
    fs::write(&scene, &text).expect("a scene");
    let time = text.split("[time]\n").nth(1).and_then(|text| text.split("\n[").next()).expect("times");
    let run = commands(answer, "run").next().expect("a table");
    let columns: Vec<_> = text_of(&run["arguments"][3]).split(',').collect();
    let has_pulses = commands(answer, "pulses").next().is_some();
    let summaries = if has_pulses { "[\"pulses\"]" } else { "[]" };
    let sweep = format!(
        "scene = {scene:?}\n[[vary]]\nparameter = \"{key}\"\nvalues = [{value}]\n[time]\n{time}\n\
         [output]\ncolumns = {columns:?}\nsummaries = {summaries}\n"
    );
    let (file, table) = (out.path().join("sweep.toml"), out.path().join("table.csv"));
    fs::write(&file, &sweep).expect("a sweep");
    let output = twofold(&["sweep", file.to_str().expect("UTF-8"), "--out", table.to_str().expect("UTF-8")]);
    let Ok(table) = fs::read_to_string(&table) else { return Some(format!("{key}: {}\n{sweep}", stderr(&output))) };
    let rows: Vec<Vec<_>> = table.lines().map(|line| line.split(',').collect()).collect();
    let expected = &run["outputs"]["stdout"];
    let cell = |row: usize, column: usize| &expected["rows"][row][column];
    let titles: Vec<_> = list(&expected["rows"][0]).iter().map(text_of).collect();
    let mut compared = 0;
    for (title, found) in rows[0].iter().zip(&rows[1]) {
        let found_number = found.parse::<f64>();
        let (right, what) = if let Some((name, rest)) = title.split_once('@') {
            let (time, unit) = rest.split_once(' ').expect("a unit");
            let column = titles.iter().position(|title| *title == format!("{name} {unit}")).expect(title);
            // Equal steps may be rounded differently.
            let time: f64 = time.parse().expect("a time");
            let at = |row: &usize| cell(*row, 0).as_f64().is_some_and(|t| (t - time).abs() <= 1e-15 * time.abs());
            let row = (1..list(&expected["rows"]).len()).find(at).expect(title);
            let (exact, tolerance) = (
                cell(row, column).as_f64().expect("a number"),
                expected["tolerances"][column].as_f64().expect("a tolerance"),
            );
            compared += 1;
            (found_number.is_ok_and(|x| (x - exact).abs() <= tolerance), format!("{exact} to {tolerance}"))
        } else if *title == "pulses [1]" {
            let pulses = &commands(answer, "pulses").next().expect("pulses")["outputs"]["stdout"]["rows"];
            let count = list(pulses).len() - 1;
            (found_number == Ok(count as f64), count.to_string())
        } else if *title == key {
            (found_number.ok() == value.as_f64(), value.to_string())
        } else {
            (matches!((*title, *found), ("scene", "0") | ("status", "ok")), "0, ok".to_owned())
        };
        if !right {
            return Some(format!("sweep of {key} = {value}: {title}: {found}, expected is {what}"));
        }
    }
    let numbers = (titles.len() - 1) * (list(&expected["rows"]).len() - 1);
    (compared != numbers).then(|| format!("sweep of {key}: {compared} numbers of {numbers}"))
}

#[test]
fn columns_of_run_are_those_of_the_second_program() {
    compare("run", 100);
}

#[test]
fn pulses_are_those_of_the_second_program() {
    compare("pulses", 90);
}

#[test]
fn timing_files_are_those_of_the_second_program() {
    compare("timing", 40);
}

#[test]
fn fits_and_limits_over_decades_are_those_of_the_second_program() {
    compare("limits", 5);
}

#[test]
fn a_key_of_a_sweep_does_what_it_does_in_the_file() {
    let all = answers();
    let swept: Vec<_> = all
        .iter()
        .flat_map(|answer| {
            answer["changed"].as_object().expect("keys").iter().map(move |(key, value)| (answer, key, value))
        })
        .filter(|(_, key, value)| !["time", "output"].contains(&parts(key).0) && value.is_number())
        .collect();
    assert!(swept.len() >= 31, "only {} keys", swept.len());
    let wrong: Vec<_> =
        swept.par_iter().filter_map(|(answer, key, value)| failure_of_sweep(answer, key, value)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_documented_key_of_a_scene_is_changed_once() {
    let all = answers();
    let changed: Vec<_> = all
        .iter()
        .flat_map(|answer| answer["changed"].as_object().expect("keys").keys())
        .map(|key| parts(key))
        .collect();
    let documented = include_str!("../../../docs/scenes.md");
    let sections = documented.split("\n### `[").skip(1);
    let mut count = 0;
    for section in sections {
        let (name, text) = section.split_once(']').expect("a title");
        // Its keys are of `timing` and `limits`: scenes have them, none is changed.
        if name == "spin_down" {
            continue;
        }
        let text = text.split("\n## ").next().expect("a text");
        for row in text.lines().filter(|line| line.starts_with("| `")) {
            let keys = row.split('|').nth(1).expect("a column");
            for key in keys.split('`').skip(1).step_by(2).flat_map(|key| key.split(" and ")) {
                let key = key.split(" = ").next().expect("a key");
                // `frame` has one value: where it stands the place of the star is changed.
                if (name, key) == ("observer", "frame") {
                    continue;
                }
                count += 1;
                assert!(
                    changed.iter().any(|(section, found, _)| *section == name && *found == key),
                    "[{name}] {key} is never changed"
                );
            }
        }
    }
    assert!(count >= 45, "only {count} keys are found");
}

#[test]
fn spectral_lines_are_those_of_the_second_program() {
    compare("spectrum", 6);
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
    compare("fit", 5);
}

#[test]
fn forecasts_are_those_of_the_second_program() {
    compare("forecast", 2);
}

#[test]
fn bounds_follow_from_the_numbers_of_the_tables() {
    compare("bounds", 3);
}
