//! The command `twofold spectrum` as a user sees it: status, messages, output.

use std::process::Output;

use crate::common::{Folder, ends, has_all, numbers, stderr, stdout, twofold};

/// Rows of a list of lines: their numbers and their names.
fn lines_of(output: &Output) -> Vec<(Vec<f64>, String)> {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    let row = |line: &str| {
        let (numbers, name) = line.rsplit_once(',').expect("columns");
        (numbers.split(',').map(|field| field.parse().expect("number")).collect(), name.to_owned())
    };
    stdout(output).lines().skip(1).map(row).collect()
}

/// The number after some words in the notes.
fn noted(output: &Output, words: &str) -> f64 {
    let notes = stderr(output);
    let rest = notes.split(words).nth(1).unwrap_or_else(|| panic!("{words}: {notes}"));
    rest.split_whitespace().next().expect("number").parse().expect("number")
}

#[test]
fn lines_of_a_spectrum_are_named() {
    let output = twofold(&["spectrum", "tp-1", "--of", "h_plus", "--least", "0.1"]);
    let header = "frequency [rad/t_c],amplitude [1],phase [rad],uncertainty [rad/t_c],combination";
    assert_eq!(stdout(&output).lines().next(), Some(header));
    // Free precession: the fundamental and its second harmonic.
    let lines = lines_of(&output);
    assert_eq!(lines.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>(), ["2 alpha'", "alpha'"]);
    let alpha = noted(&output, "alpha' = ");
    assert!((lines[0].0[0] - 2.0 * alpha).abs() < 1e-15 && (lines[1].0[0] - alpha).abs() < 1e-15);
    assert!((noted(&output, "l' = ") + 0.027_972_468_2).abs() < 1e-10);
    assert!(stderr(&output).contains("h_plus has the constant term"), "{}", stderr(&output));
    assert_eq!(lines_of(&twofold(&["spectrum", "tp-1", "--of", "h_plus", "--most", "3"])).len(), 3);
    // Without --least the limit is 1e-6 of the largest line.
    let by_default = stdout(&twofold(&["spectrum", "tp-1", "--of", "h_plus"]));
    assert_eq!(by_default, stdout(&twofold(&["spectrum", "tp-1", "--of", "h_plus", "--least", "1e-6"])));
    // Frequencies in turns.
    let turns = twofold(&["spectrum", "tp-1", "--of", "h_plus", "--least", "0.1", "--hertz"]);
    assert!(stdout(&turns).starts_with("frequency [turns/t_c],"));
    assert!((lines_of(&turns)[1].0[0] * std::f64::consts::TAU - alpha).abs() < 1e-15);
}

/// The table of `run` is the constant term plus the sum of the lines.
#[test]
fn columns_are_sums_of_their_lines() {
    let physical = ("physical.toml", include_str!("../cases/physical.toml"));
    let folder = Folder::with(&[physical]);
    for (scene, column, group, unit, start) in [
        ("physical.toml", "cos_lambda", "lambda", "[rad/s]", 3.0),
        ("tp-2", "m.n", "m.n", "[rad/t_c]", 0.0),
        ("sp-1", "h_cross", "h", "[rad/t_c]", 0.0),
        ("tp-2", "beta", "angles", "[rad/t_c]", 0.0),
        ("sp-1", "beta_rate", "rates", "[rad/t_c]", 0.0),
        ("prolate", "L_Z", "L", "[rad/t_c]", 0.0),
        ("retrograde", "e_z_Z", "e_z", "[rad/t_c]", 0.0),
        ("axisymmetric-violation", "e_x_X", "e_x", "[rad/t_c]", 0.0),
    ] {
        let output = folder.run(&["spectrum", scene, "--of", column, "--least", "1e-11", "--most", "2000"]);
        let lines = lines_of(&output);
        assert!(stdout(&output).contains(unit), "{}", stdout(&output));
        let table = folder.run(&["run", scene, "--columns", group]);
        let header = stdout(&table);
        let titles = header.lines().next().expect("a header").split(',').map(|title| title.split(' ').next());
        let place = titles.into_iter().position(|title| title == Some(column)).expect(column);
        let constant = noted(&output, "constant term ");
        let rows = numbers(&header);
        let largest = rows.iter().map(|row| row[place].abs()).fold(0.0, f64::max);
        for row in rows {
            let value = |line: &[f64]| line[1] * (line[0] * (row[0] - start) + line[2]).cos();
            let sum = constant + lines.iter().map(|(line, _)| value(line)).sum::<f64>();
            assert!((sum - row[place]).abs() < 1e-9 * largest, "{scene} {column}: {sum} at {row:?}");
        }
    }
    // Free precession: n circles L at |L| / I^xx, here once in 9 ms.
    let lines = lines_of(&folder.run(&["spectrum", "physical.toml", "--of", "cos_lambda", "--hertz"]));
    assert_eq!((lines.len(), lines[0].1.as_str()), (1, "alpha'"));
    let (spin, beta) = (1.001 * std::f64::consts::TAU * 100.0, 0.5_f64);
    let along = spin * beta.cos() + 700.0 * beta.sin().powi(2);
    let across = (700.0 * beta.cos() - spin) * beta.sin();
    let expected = along.hypot(across) / std::f64::consts::TAU;
    assert!((lines[0].0[0] / expected - 1.0).abs() < 1e-14, "{lines:?}");
}

/// The slow precession of a pulsar takes twenty million years, and is still resolved as a line.
#[test]
fn lines_of_a_pulsar_are_told_apart() {
    let output = twofold(&["spectrum", "b1828-11", "--of", "m.n", "--hertz"]);
    let lines = lines_of(&output);
    let named = |wanted: &str| lines.iter().find(|(_, name)| name == wanted).map(|(line, _)| line[0]).expect(wanted);
    assert!(stdout(&output).starts_with("frequency [Hz],"));
    let (slow, spin) = (named("-alpha'"), named("gamma'"));
    assert!(slow > 0.0 && slow < 1e-14 && (spin - 2.47).abs() < 0.01, "{lines:?}");
    assert!(noted(&output, "alpha' = ") == -slow);
    // Frequencies are accurate to their last digits, though they are small differences of large ones.
    let apart = named("-alpha' - gamma' + nu'") - named("-gamma' + nu'");
    assert!((apart / slow - 1.0).abs() < 1e-5, "{apart:e} {slow:e}");
}

#[test]
fn rounding_beside_a_constant_is_not_listed() {
    for (scene, column) in [("b1937+21", "h_plus"), ("tp-1", "E")] {
        let output = twofold(&["spectrum", scene, "--of", column]);
        assert!(lines_of(&output).is_empty(), "{scene} {column}: {}", stdout(&output));
        has_all(
            &stderr(&output),
            &["constant term", "lines below ", "because rounding alone gives such lines", "has no line"],
        );
    }
}

#[test]
fn a_star_that_spins_about_its_axis_has_one_line() {
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.8\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.5\nrho = 0.6\n[time]\nspan = 3000.0\nsamples = 3\n";
    let folder = Folder::with(&[("upright.toml", text)]);
    let spectrum = |of: &str| folder.run(&["spectrum", "upright.toml", "--of", of]);
    let output = spectrum("m.n");
    let lines = lines_of(&output);
    assert_eq!((lines.len(), lines[0].1.as_str()), (1, "psi'"));
    assert!((lines[0].0[0] - 1.0).abs() < 1e-15, "{lines:?}");
    // This column is constant.
    let constant = spectrum("L_Z");
    assert!(lines_of(&constant).is_empty() && stderr(&constant).contains("L_Z has no line"), "{}", stderr(&constant));
    let output = ends(spectrum("beta"), 1);
    assert!(stderr(&output).contains("`beta` has no lines: it is undefined in some states"), "{}", stderr(&output));
}

#[test]
fn what_has_no_lines_is_refused_with_a_reason() {
    for (scene, column, words) in [
        ("tp-1", "alpha", "grows without bound"),
        ("tp-1", "beta_printed", "a formula in time"),
        ("tp-1", "gravity", "not a column"),
    ] {
        let output = ends(twofold(&["spectrum", scene, "--of", column]), 2);
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    let least = ends(twofold(&["spectrum", "tp-1", "--of", "m.n", "--least", "1e-13"]), 2);
    assert!(stderr(&least).contains("--least 1e-13: must be from 1e-12 to 1"), "{}", stderr(&least));
}
