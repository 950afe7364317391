//! `twofold compare` on files in the authors' format, made from our own motion, correct ones and ones with deliberate defects.

use std::process::{Command, Output};
use std::sync::OnceLock;

use crate::common::{Folder, altered, ends, has_all, is_refused, stderr, stdout};
use twofold_scene::scene_file::{Scene, built_in};
use twofold_scene::trajectory;

fn compare(folder: &Folder, extra: &[&str]) -> Output {
    folder.run(&[&["compare", "--authors-data", "."], extra].concat())
}

/// Rows of a CSV table with the fields in another order, separated by tabs.
fn rows(table: &[u8], fields: &[usize]) -> String {
    let text = std::str::from_utf8(table).expect("text");
    let row = |line: &str| {
        let values: Vec<_> = line.split(',').collect();
        fields.iter().map(|&i| values[i]).collect::<Vec<_>>().join("\t")
    };
    text.lines().skip(1).map(row).collect::<Vec<_>>().join("\n")
}

/// Columns of the motion of a built-in scene with other lines.
fn motion(name: &str, changes: &[(&str, &str)], columns: &[&str], fields: &[usize]) -> String {
    let mut scene = Scene::from_toml(name, &altered(name, changes)).expect("a scene");
    scene.choose_columns(columns).expect("columns");
    let mut table = Vec::new();
    trajectory::write_csv(&scene, &mut table, |_| Ok(())).expect("motion");
    rows(&table, fields)
}

/// `gwtp1.dat`, `sp1.dat`, `mntp1_widset.dat` and `mntp1_pset.dat` without any error.
fn files() -> &'static [(&'static str, String)] {
    static FILES: OnceLock<Vec<(&str, String)>> = OnceLock::new();
    FILES.get_or_init(|| {
        let samples = ("samples = 4001", "samples = 10000");
        // t, alpha (1), beta (2), gamma, e_x (4..7), e_z (7..10), alpha and beta by Eq. (33) (10, 11)
        let angles = motion(
            "sp-1",
            &[samples, ("span = 400", "span = 200")],
            &["angles", "perturbation", "e_x", "e_z"],
            &[0, 1, 10, 2, 11, 4, 5, 6, 7, 8, 9],
        );
        let waves = motion("tp-1", &[samples], &["h"], &[0, 1, 2]);
        let caption = "alpha = 1.5707963267948966\nbeta = 0.701\nalpha_rate = 1.509\nbeta_rate = 0.0\n\n[observer]";
        let (before, rest) = built_in("tp-1").expect("tp-1").toml.split_once("kind =").expect("constants");
        let (_, after) = rest.split_once("[observer]").expect("observer");
        let scene = Scene::from_toml("caption", &format!("{before}{caption}{after}")).expect("scene");
        let mut table = Vec::new();
        trajectory::write_pulses(&scene, &mut table, |_| Ok(())).expect("pulses");
        let widths: Vec<_> =
            rows(&table, &[4, 5, 6]).lines().filter_map(|row| row.strip_suffix('\t').map(String::from)).collect();
        let stamps: Vec<f64> =
            widths.iter().map(|row| row.split('\t').next().expect("stamp").parse().expect("number")).collect();
        let periods = stamps.windows(2).map(|pair| format!("{:?}\t{:?}", (pair[0] + pair[1]) / 2.0, pair[1] - pair[0]));
        vec![
            ("sp1.dat", angles),
            ("gwtp1.dat", waves),
            ("mntp1_pset.dat", periods.collect::<Vec<_>>().join("\n")),
            ("mntp1_widset.dat", widths.join("\n")),
        ]
    })
}

/// All correct files.
fn sound() -> Folder {
    let folder = Folder::new();
    for (file, text) in files() {
        folder.write(file, text);
    }
    folder
}

/// The correct text of a file.
fn text_of(name: &str) -> &'static str {
    &files().iter().find(|(file, _)| *file == name).expect("a file").1
}

/// One changed file, alone in its folder.
fn with_change(name: &str, change: impl Fn(&str) -> Vec<u8>) -> Folder {
    let folder = Folder::new();
    folder.write(name, change(text_of(name)));
    folder
}

/// The text with the line number `line`, from one, replaced.
fn with_line(text: &str, line: usize, replace: impl Fn(&str) -> String) -> Vec<u8> {
    let lines: Vec<_> =
        text.lines().enumerate().map(|(i, l)| if i + 1 == line { replace(l) } else { l.to_owned() }).collect();
    lines.join("\n").into_bytes()
}

#[test]
fn sound_files_agree_and_the_rest_is_told() {
    let folder = sound();
    folder.write("LICENSE", "MIT");
    folder.write("cross1.dat", "what it is nobody knows");
    // A name similar to a known one is not read: there is no third scene.
    folder.write("tp3.dat", "1\t2");
    has_all(
        &stdout(&ends(compare(&folder, &[]), 0)),
        &[
            "16 columns agree, none differs, 4 not judged",
            "not in the folder: tp1.dat, tp2.dat, sp2.dat, mntp1.dat, mntp2.dat, mntp2_pset.dat, mntp2_widset.dat, gwtp2.dat",
            "not read, since their names are not known: LICENSE, cross1.dat, tp3.dat",
        ],
    );
    let json: serde_json::Value = serde_json::from_slice(&compare(&folder, &["--json"]).stdout).expect("JSON");
    assert_eq!(json["differing"].as_array().map(Vec::len), Some(0));
    let file = |name: &str, start: &str| {
        let files = json["files"].as_array().expect("files");
        files.iter().find(|file| file["file"] == name && file["started_from"] == start).expect(name).clone()
    };
    for file in [file("sp1.dat", "Eq. (34)"), file("gwtp1.dat", "Eq. (34)"), file("mntp1_pset.dat", "caption")] {
        for column in file["columns"].as_array().expect("columns") {
            assert_eq!(column["verdict"], "agrees");
            assert!(column["largest_difference"].as_f64().expect("number") < 1e-10, "{column}");
            // The field is a time of the file, not a difference.
            let at = column["at"].as_f64().expect("a time");
            assert!((0.0..=500.0).contains(&at) && (at == 0.0 || at > 1e-3), "{column}");
        }
    }
    let other_start = &file("mntp1_pset.dat", "Eq. (34)")["columns"][0];
    assert_eq!(other_start["verdict"], "not judged");
    assert!((0.04..0.05).contains(&other_start["largest_difference"].as_f64().expect("number")));
}

/// The allowed differences are those of `docs/compare.md`: for each row of its table of results, and the errors in its table of reasons.
#[test]
fn what_the_page_says_is_allowed_is_allowed() {
    let folder = sound();
    let samples = ("samples = 4001", "samples = 10000");
    let angles = motion(
        "tp-1",
        &[samples, ("span = 400", "span = 200")],
        &["angles", "perturbation", "e_x", "e_z"],
        &[0, 1, 10, 2, 11, 4, 5, 6, 7, 8, 9],
    );
    // The curves in the file of m.n are not judged.
    let signal = motion("tp-1", &[samples], &["m.n"], &[0, 1, 1, 1]);
    for (name, text) in [("tp1.dat", angles), ("mntp1.dat", signal)] {
        folder.write(name, text);
    }
    let json: serde_json::Value = serde_json::from_slice(&compare(&folder, &["--json"]).stdout).expect("JSON");
    let allowed = |name: &str, column: &str| -> Option<f64> {
        let files = json["files"].as_array().expect("files").iter().filter(|file| file["file"] == name);
        let columns = files.flat_map(|file| file["columns"].as_array().expect("columns"));
        columns.filter(|found| found["column"] == column).find_map(|found| found["allowed"].as_f64())
    };
    let page = include_str!("../../../docs/compare.md");
    let cells = |line: &'static str| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>();
    let (mut file, mut judged) = ("", 0);
    let (_, results) = page.split_once("## What was found").expect("a section");
    for row in results.lines().filter(|line| line.starts_with("| ") && line.contains("e-")).map(cells) {
        file = if row[0].is_empty() { file } else { row[0].trim_matches('`') };
        let columns: &[&str] = match row[1] {
            "alpha by perturbation" => &["alpha, Eq. (33)"],
            "beta by perturbation" => &["beta, Eq. (33)"],
            "e_x" => &["e_x X", "e_x Y", "e_x Z"],
            "e_z X, Y" => &["e_z X", "e_z Y"],
            "stamp; period" => &["stamp", "period"],
            "stamp; duration" => &["stamp", "duration"],
            "h_+; h_x" => &["h_+", "h_x"],
            "curve of the period" => &["P, Eq. (51)"],
            "curve of the width" => &["W / <Phi'>"],
            other => &[other],
        };
        let stated: Vec<_> = row[4].split("; ").collect();
        for (i, column) in columns.iter().enumerate() {
            let stated = stated[i.min(stated.len() - 1)];
            match allowed(file, column) {
                // The last times of the published files differ from these by less than a percent.
                Some(limit) => {
                    let part = limit / stated.parse::<f64>().unwrap_or(f64::NAN);
                    assert!((part - 1.0).abs() < 1e-2, "{file}: {column}: {limit:e}, {stated} on the page");
                }
                None => assert_eq!(stated, "not judged", "{file}: {column}"),
            }
            judged += usize::from(stated != "not judged");
        }
    }
    assert_eq!(judged, 27, "columns that can be judged");
    // The errors of the files themselves have two digits, with up to half a unit more in the last.
    let (_, reasons) = page.split_once("## What is allowed").expect("a section");
    let half_more = |error: &str| {
        let digit = error.split_once('e').expect("a power").1.parse::<i32>().expect("a power") - 1;
        error.parse::<f64>().expect("a number") + 0.5 * 10f64.powi(digit)
    };
    for (row, places) in [
        (
            "alpha, beta of tp-I; of sp-I",
            &[("tp1.dat", "alpha"), ("tp1.dat", "beta"), ("sp1.dat", "alpha"), ("sp1.dat", "beta")][..],
        ),
        ("m.n of tp-I; h of tp-I", &[("mntp1.dat", "m.n"), ("gwtp1.dat", "h_+")]),
    ] {
        let line = reasons.lines().map(cells).find(|cells| cells[0] == row).expect(row);
        let errors: Vec<_> = line[1].split([',', ';']).map(str::trim).collect();
        assert_eq!(errors.len(), places.len());
        for (error, (file, column)) in errors.iter().zip(places) {
            let (found, stated) = (allowed(file, column).expect("a limit"), half_more(error));
            assert!((found / stated - 1.0).abs() < 1e-12, "{file} {column}: {found:e}, {error} on the page");
        }
    }
}

/// A file that differs by more than its known error gives status 1 and the place of the difference.
#[test]
fn a_difference_beyond_the_files_own_error_fails() {
    let shifted = |column: usize, by: f64| {
        move |line: &str| {
            let mut fields: Vec<String> = line.split('\t').map(String::from).collect();
            fields[column] = format!("{:?}", fields[column].parse::<f64>().expect("number") + by);
            fields.join("\t")
        }
    };
    for (file, line, column, by, within, named) in [
        ("gwtp1.dat", 5000, 2, 3.5e-6, 3.4e-6, "h_x"),
        ("sp1.dat", 7000, 1, -3.6e-6, 3.5e-6, "alpha "),
        ("sp1.dat", 7000, 2, 1e-13, 1e-14, "alpha, Eq. (33)"),
        ("sp1.dat", 10_000, 10, 1.5e-6, 1.3e-6, "e_z Z"),
        ("sp1.dat", 1, 5, 5e-5, 4e-5, "e_x X"),
        ("mntp1_widset.dat", 40, 0, 8e-5, 7e-5, "stamp"),
        ("mntp1_pset.dat", 40, 1, 2e-4, 1.4e-4, "period"),
    ] {
        let changed = |by| compare(&with_change(file, |text| with_line(text, line, shifted(column, by))), &[]);
        let output = ends(changed(by), 1);
        let text = stdout(&output);
        has_all(&stderr(&output), &[format!("files that differ by more than allowed: {file}")]);
        let row = text.lines().find(|line| line.contains("DIFFERS")).unwrap_or_else(|| panic!("{text}"));
        assert!(row.contains(named), "{row}");
        ends(changed(by.signum() * within), 0);
    }
    // One defective file among correct ones.
    let all = sound();
    all.write("mntp1_pset.dat", with_line(text_of("mntp1_pset.dat"), 40, shifted(1, 2e-4)));
    let text = stdout(&ends(compare(&all, &[]), 1));
    assert!(text.contains("\n15 columns agree, 1 DIFFERS, "), "{text}");
    let json: serde_json::Value = serde_json::from_slice(&compare(&all, &["--json"]).stdout).expect("JSON");
    assert_eq!(json["differing"], serde_json::json!(["mntp1_pset.dat"]));
    let columns =
        json["files"].as_array().expect("files").iter().flat_map(|file| file["columns"].as_array().expect("columns"));
    let differing: Vec<_> =
        columns.filter(|column| column["verdict"] == "differs").map(|column| &column["column"]).collect();
    assert_eq!(differing, ["period"]);
    // A pulse of another star.
    let other = with_change("mntp1_widset.dat", |text| with_line(text, 40, shifted(0, 1.7)));
    has_all(
        &stdout(&ends(compare(&other, &[]), 1)),
        &["1 row of the file has no counterpart of its own in ours within 1 t_c"],
    );
}

#[test]
fn malformed_files_are_named_with_line_and_column() {
    let (waves, periods) = (text_of("gwtp1.dat"), text_of("mntp1_pset.dat"));
    let first_rows: Vec<_> = waves.lines().take(9000).collect();
    let mut cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
        (
            "gwtp1.dat",
            with_line(waves, 57, |line| line.replace('\t', "\tx")),
            &["gwtp1.dat:57:", "`x", "is not a finite decimal number"],
        ),
        (
            "gwtp1.dat",
            with_line(waves, 4, |line| line.replacen("0.12", "0.02", 1)),
            &["gwtp1.dat:4:1: time 0.02", "times must increase"],
        ),
        (
            "gwtp1.dat",
            format!("{waves}\n400.1\t0.1\t0.2").into(),
            &["gwtp1.dat:10001:1: too many rows; the published file has 10000"],
        ),
        (
            "gwtp1.dat",
            first_rows.join("\n").into(),
            &["gwtp1.dat:9000:", "the file is incomplete; expected 10000 rows, found 9000"],
        ),
        (
            "gwtp1.dat",
            waves[..waves.len() - 30].into(),
            &["gwtp1.dat:10000:", "the row is incomplete; found 2 of 3 numbers"],
        ),
        ("gwtp1.dat", Vec::new(), &["gwtp1.dat: is empty"]),
        (
            "gwtp1.dat",
            [waves.as_bytes(), b"\n\xff\xfe"].concat(),
            &["gwtp1.dat: is not UTF-8 text (byte ", ", line 10001)"],
        ),
        ("gwtp1.dat", vec![0; 1000], &["gwtp1.dat:1:1: `\u{fffd}"]),
        (
            "mntp1_pset.dat",
            periods.split_once('\n').expect("lines").1.into(),
            &["mntp1_pset.dat:94:", "the file is incomplete; expected"],
        ),
    ];
    for (line, text, message) in [
        (3, "0.08\tNaN\t0.1", &["gwtp1.dat:3:6: `NaN` is not a finite"]),
        (3, "0.08\t0.1\t1e999", &["gwtp1.dat:3:10: `1e999`"]),
        (3, "0.08,0.1,0.2", &["gwtp1.dat:3:1: `0.08,0.1,0.2`"]),
        (3, "0.08\t0.1", &["gwtp1.dat:3:9: the row is incomplete; found 2 of 3 numbers"]),
        (3, "0.08\t0.1 0.2  7", &["gwtp1.dat:3:15: too many columns; the published file has 3 (t, h_+, h_x)"]),
        (4, "", &["gwtp1.dat:4:1: the line is empty"]),
        (1, "-1.0\t0.1\t0.2", &["gwtp1.dat:1:1: time -1.0: must be from 0 to 1100"]),
        (10_000, "1e9\t0.1\t0.2", &["gwtp1.dat:10000:1: time 1000000000.0: must be"]),
    ] {
        cases.push(("gwtp1.dat", with_line(waves, line, |_| text.to_owned()), message));
    }
    assert_eq!(cases.len(), 17);
    for (file, bytes, fragments) in cases {
        is_refused(&compare(&with_change(file, |_| bytes.clone()), &[]), fragments);
    }
    // All malformed files are reported at once; foreign line ends and a final line end are no fault.
    let folder = with_change("gwtp1.dat", |_| b"1 2".to_vec());
    folder.write("mntp1_pset.dat", "1 two");
    is_refused(&compare(&folder, &[]), &["gwtp1.dat:1:4: ", "mntp1_pset.dat:1:3: "]);
    let ends_of_windows = |text: &str| format!("{}\r\n", text.replace('\n', "\r\n")).into_bytes();
    ends(compare(&with_change("gwtp1.dat", ends_of_windows), &[]), 0);
}

#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_to_is_refused() {
    let folder = Folder::new();
    assert!(Command::new("mkfifo").arg(folder.at("sp1.dat")).status().expect("mkfifo").success());
    is_refused(&compare(&folder, &[]), &["sp1.dat: is not a regular file"]);
}
