//! The command `twofold bounds` as a user meets it: status, messages, output.

use std::path::Path;

use crate::common::{Folder, ends, has_all, is_refused, stdout, succeeds, twofold};
use twofold_verify::refused_files::refused_files;

#[test]
fn bad_tables_are_refused() {
    let files = refused_files("bad-pulsars");
    for (file, expected) in &files {
        is_refused(&twofold(&["bounds", file, "--json"]), expected);
        is_refused(&twofold(&["bounds", file]), expected);
    }
    assert!(files.len() >= 50, "only {} bad tables found", files.len());
}

/// The value of a figure of a pulse.
fn value(json: &serde_json::Value, pulse: usize, key: &str) -> f64 {
    let figures = json["pulses"][pulse]["figures"].as_array().expect("figures");
    let figure = figures.iter().find(|figure| figure["figure"] == key).unwrap_or_else(|| panic!("no figure {key}"));
    figure["value"].as_f64().expect("number")
}

fn bounds_as_json(folder: &Folder, arguments: &[&str]) -> serde_json::Value {
    let output = ends(folder.run(&[&["bounds", "--json"], arguments].concat()), 0);
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn the_built_in_table_is_printed_beside_the_paper() {
    let output = succeeds(&["bounds"]);
    assert!(output.stderr.is_empty());
    let text = stdout(&output);
    has_all(&text, &["PSR B1937+21, main pulse", "PSR B1937+21, interpulse", "PSR J1744-1134"]);
    assert!(text.contains("printed") && text.contains("-18.861"), "{text}");
    assert_eq!(text.matches("Recommended: |2 s^ZZ - s^XX - s^YY| < 2.8e-14 at 95 % confidence").count(), 1, "{text}");
    assert!(
        text.matches("second-hand, its source could not be opened").count() == 4,
        "three pulses and one choice: {text}"
    );
    for reading in ["(a) bound / eta ", "(b) bound / eta ", "(c) as (b), by the error of Delta W: limit / eta "] {
        assert_eq!(text.matches(reading).count(), 3, "{reading} for each pulse in {text}");
    }
    has_all(&text, &["arXiv:2311.11038", "arXiv:1706.06294", "arXiv:1307.2552", "arXiv:1209.4503", "arXiv:1412.2320"]);
}

/// The readings of the paper's table: with the stated star, with the star's own deformation, with the measured error, all together.
#[test]
fn the_three_readings_and_what_is_recommended() {
    let json = bounds_as_json(&Folder::new(), &[]);
    assert_eq!(json["pulses"][2]["name"], "PSR J1744-1134");
    let expected = [
        ("lambda_change", [-18.861, -5.206, 1.566]),
        ("bound_over_eta_stated", [4.81e-14, 1.328e-14, 1.577e-15]),
        ("bound_over_eta_round", [2.689e-14, 7.424e-15, 8.815e-16]),
        ("bound_over_eta_own", [6.98e-16, 1.926e-16, 1.501e-16]),
        ("limit_over_eta_by_change", [1.92e-15, 7.95e-16, 1.616e-15]),
        ("eta", [88.636, 88.636, 87.623]),
        ("limit_without_error", [6.179e-14, 1.7066e-14, 1.3154e-14]),
        ("limit", [7.098e-14, 2.7621e-14, 5.485e-14]),
    ];
    for (key, values) in expected {
        for (pulse, expected) in values.into_iter().enumerate() {
            let found = value(&json, pulse, key);
            assert!((found / expected - 1.0).abs() < 3e-3, "{key} of pulse {pulse}: {found:e}, not {expected:e}");
        }
    }
    let recommended = &json["recommended"];
    assert_eq!(recommended["pulse"], "PSR B1937+21, interpulse");
    assert_eq!(recommended["limit"].as_f64(), Some(value(&json, 1, "limit")));
    assert_eq!(recommended["confidence"].as_f64(), Some(0.95));
    assert!(recommended["source"].as_str().expect("a source").contains("second-hand"));
    assert!(json["published"].as_array().expect("published limits").len() > 10);
}

/// A table of one pulse with the given change of width and further lines.
fn one_pulse(change: &str, further: &str) -> serde_json::Value {
    let text = format!(
        "[[pulsar]]\nname = \"x\"\nspin_period = 4.1e-3\nwidth = 13\nwidth_change = {change}\nlambda = 95\nchi = 51\n\
         years = 15\n{further}"
    );
    bounds_as_json(&Folder::with(&[("pulsar.toml", &text)]), &["pulsar.toml"])
}

#[test]
fn a_bare_change_is_a_limit_and_one_with_an_error_is_measured() {
    let (bare, measured) = (one_pulse("0.020", ""), one_pulse("[0.020, 0.108]", ""));
    assert_eq!(
        (&bare["pulses"][0]["change_is"], &measured["pulses"][0]["change_is"]),
        (&"a limit".into(), &"measured".into())
    );
    assert!(value(&measured, 0, "limit") > 3.0 * value(&bare, 0, "limit"));
    let keys = |json: &serde_json::Value| json["pulses"][0]["figures"].to_string();
    assert!(keys(&measured).contains("limit_over_eta_by_change") && !keys(&bare).contains("limit_over_eta_by_change"));
    // A change of nothing is a measurement too, if it has an error.
    assert!(value(&one_pulse("[0, 0.108]", ""), 0, "limit") > 0.0);
}

/// Directions count unless they are known, and what is given for eta is used.
#[test]
fn eta_follows_from_what_is_known() {
    let limit_of_eta = |further: &str| value(&one_pulse("[0.020, 0.108]", further), 0, "eta");
    assert_eq!(limit_of_eta("eta = 10\n"), 10.0);
    // 1 / (sin(95 deg) sin(45 deg) cos(45 deg)), and one azimuth in twenty within 4.5 degrees of no motion along the line of sight.
    let expected = 2.0 / (95f64.to_radians().sin() * 4.5f64.to_radians().sin());
    assert!((limit_of_eta("beta_0 = 45\n") / expected - 1.0).abs() < 1e-9);
    assert!(limit_of_eta("") > 87.0);
    let given = one_pulse("0.020", "inertia_over_c = 1e-5\neta = [10, 0]\n");
    assert!((value(&given, 0, "bound_over_eta_own") / 8.815e-16 - 1.0).abs() < 1e-3);
    assert!((value(&given, 0, "limit") / value(&given, 0, "limit_over_eta_by_inputs") - 10.0).abs() < 1e-9);
}

#[test]
fn a_table_of_ones_own_has_no_printed_numbers() {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scene/pulsars/paper.toml");
    let table = table.to_str().expect("path in UTF-8");
    let text = stdout(&twofold(&["bounds", table]));
    assert!(text.contains("-18.861") && !text.contains("printed"), "{text}");
    assert!(bounds_as_json(&Folder::new(), &[table])["pulses"][0]["figures"][0]["printed"].is_null());
}
