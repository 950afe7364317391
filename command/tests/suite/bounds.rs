//! The command `twofold bounds` as a user sees it: status, messages, output.

use crate::common::{Folder, ends, is_refused, number_after, twofold};
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
    // A change of zero is a measurement, too, if it has an error.
    assert!(value(&one_pulse("[0, 0.108]", ""), 0, "limit") > 0.0);
}

/// Directions enter unless they are known, and a given eta is used.
#[test]
fn eta_follows_from_what_is_known() {
    let limit_of_eta = |further: &str| value(&one_pulse("[0.020, 0.108]", further), 0, "eta");
    assert_eq!(limit_of_eta("eta = 10\n"), 10.0);
    // 1 / (sin(95 deg) sin(45 deg) cos(45 deg)); one azimuth in twenty is within 4.5 degrees of those without motion along the line of sight.
    let expected = 2.0 / (95f64.to_radians().sin() * 4.5f64.to_radians().sin());
    assert!((limit_of_eta("beta_0 = 45\n") / expected - 1.0).abs() < 1e-9);
    assert!(limit_of_eta("") > 87.0);
    let given = one_pulse("0.020", "inertia_over_c = 1e-5\neta = [10, 0]\n");
    assert!((value(&given, 0, "bound_over_eta_own") / 8.815e-16 - 1.0).abs() < 1e-3);
    assert!((value(&given, 0, "limit") / value(&given, 0, "limit_over_eta_by_inputs") - 10.0).abs() < 1e-9);
}

/// The recommended limits are those of the pulse that is named, at 95 %.
#[test]
fn the_recommended_limits_are_those_of_their_pulse() {
    let page = String::from_utf8(ends(twofold(&["bounds"]), 0).stdout).expect("text");
    let json = bounds_as_json(&Folder::new(), &[]);
    let recommended = &json["recommended"];
    let pulse =
        json["pulses"].as_array().expect("pulses").iter().position(|pulse| pulse["name"] == recommended["pulse"]);
    let pulse = pulse.unwrap_or_else(|| panic!("{recommended}"));
    let printed = number_after(&page, "so that |alpha_2| < ");
    let of_pulse = value(&json, pulse, "alpha_2_limit");
    assert_eq!(recommended["alpha_2"].as_f64(), Some(of_pulse));
    assert!((printed / of_pulse - 1.0).abs() < 0.05, "{printed:e} {of_pulse:e}");
}

/// Limits of others follow below a title line, each with its source.
#[test]
fn limits_of_others_are_listed() {
    let page = String::from_utf8(ends(twofold(&["bounds"]), 0).stdout).expect("text");
    let after = page.split("published by others").nth(1).expect("a table");
    let lines: Vec<_> = after.lines().skip(1).collect();
    assert_eq!(lines[0].split_whitespace().collect::<Vec<_>>(), ["limit", "source", "seen"]);
    assert!(lines[1].chars().all(|c| c == '─') && !lines[1].is_empty(), "{}", lines[1]);
    assert!(lines[2].starts_with(" s^XX + s^YY - 2 s^ZZ") && lines[2].contains("4.1e-11"), "{}", lines[2]);
}
