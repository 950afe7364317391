//! The command `twofold spectrum` as a user meets it: status, messages, output.

use std::process::Output;

use crate::common::{Folder, ends, has_all, numbers, stderr, stdout, succeeds, twofold};

/// Rows of a list of lines: numbers, and what each is.
fn lines_of(output: &Output) -> Vec<(Vec<f64>, String)> {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    let row = |line: &str| {
        let (numbers, name) = line.rsplit_once(',').expect("columns");
        (numbers.split(',').map(|field| field.parse().expect("number")).collect(), name.to_owned())
    };
    stdout(output).lines().skip(1).map(row).collect()
}

/// The highest point of an amplitude spectrum above a frequency: frequency and amplitude.
fn highest_point(table: &str, above: f64) -> [f64; 2] {
    let points = numbers(table).into_iter().filter(|row| row[0] > above).map(|row| [row[0], row[1]]);
    points.max_by(|a, b| a[1].total_cmp(&b[1])).expect("rows")
}

#[test]
fn lines_of_a_spectrum_are_identified() {
    let output = twofold(&["spectrum", "tp-1", "--of", "h_plus", "--span", "4000", "--least", "0.1"]);
    let header = "frequency [rad/t_c],amplitude [1],phase [rad],uncertainty [rad/t_c],combination";
    assert_eq!(stdout(&output).lines().next(), Some(header));
    // Free precession: the fundamental and its second harmonic.
    let lines = lines_of(&output);
    assert_eq!(lines.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>(), ["2 alpha'", "alpha'"]);
    let notes = stderr(&output);
    let told = |name: &str| -> f64 {
        let line = notes.lines().find_map(|line| line.strip_prefix(&format!("note: {name} = "))).expect(name);
        line.split(' ').next().expect("number").parse().expect("number")
    };
    assert!((lines[0].0[0] - 2.0 * told("alpha'")).abs() < 1e-10 && (lines[1].0[0] - told("alpha'")).abs() < 1e-10);
    assert!((told("l'") + 0.027_972_468_2).abs() < 1e-9, "{notes}");
    assert!(
        notes.contains("chosen from the rotation rate") && notes.contains("h_plus has the constant term"),
        "{notes}"
    );

    // The other way in time the same lines: amplitude cos(frequency (t - start) + phase), the motion is symmetric in time.
    let back = lines_of(&twofold(&["spectrum", "tp-1", "--of", "h_plus", "--span", "-4000", "--least", "0.1"]));
    for ((one, _), (other, _)) in lines.iter().zip(&back) {
        assert!((one[0] - other[0]).abs() < 1e-10 && (one[1] - other[1]).abs() < 1e-8);
        assert!((one[2].cos() - other[2].cos()).abs() < 1e-6, "{one:?} {other:?}");
    }
    assert_eq!(lines_of(&twofold(&["spectrum", "tp-1", "--of", "h_plus", "--span", "4000", "--most", "3"])).len(), 3);
}

#[test]
fn a_spectrum_of_a_physical_star_is_in_seconds_from_its_start() {
    let folder = Folder::with(&[("star.toml", include_str!("../cases/physical.toml"))]);
    let output = folder.run(&["spectrum", "star.toml", "--of", "cos_lambda"]);
    let lines = lines_of(&output);
    assert!(stdout(&output).starts_with("frequency [rad/s],"));
    // Free precession: n goes round L at |L| / I^xx, here once in 9 ms; the line is cos lambda less its constant term.
    assert_eq!((lines.len(), lines[0].1.as_str()), (1, "alpha'"));
    let (spin, beta) = (1.001 * std::f64::consts::TAU * 100.0, 0.5_f64);
    let along = spin * beta.cos() + 700.0 * beta.sin().powi(2);
    let across = (700.0 * beta.cos() - spin) * beta.sin();
    assert!((lines[0].0[0] / along.hypot(across) - 1.0).abs() < 1e-10, "{lines:?}");
    let table = stdout(&folder.run(&["run", "star.toml", "--columns", "lambda"]));
    let notes = stderr(&output);
    let constant = notes.split("constant term ").nth(1).and_then(|rest| rest.lines().next()).expect("constant");
    let constant: f64 = constant.parse().expect("number");
    for row in numbers(&table) {
        let [frequency, amplitude, phase, _] = lines[0].0[..] else { panic!("four numbers") };
        let line = constant + amplitude * (frequency * (row[0] - 3.0) + phase).cos();
        assert!((line - row[1]).abs() < 1e-9, "{line} at {row:?}");
    }
    // The amplitude spectrum in steps of 2 pi over the span of 2 s; between two steps the window takes a few hundredths.
    let text = stdout(&folder.run(&["spectrum", "star.toml", "--of", "cos_lambda", "--table", "spectrum"]));
    assert!(text.starts_with("frequency [rad/s],amplitude [1]\n"), "{text}");
    // The window spreads the constant term over some steps.
    let highest = highest_point(&text, 100.0);
    assert!((highest[0] - lines[0].0[0]).abs() < std::f64::consts::PI, "{highest:?} {lines:?}");
    assert!((0.9..1.001).contains(&(highest[1] / lines[0].0[1])), "{highest:?} {lines:?}");
}

#[test]
fn an_amplitude_spectrum_and_lines_without_names_need_no_long_span() {
    let text = stdout(&succeeds(&["spectrum", "tp-2", "--of", "m.n", "--table", "spectrum"]));
    assert!(text.starts_with("frequency [rad/t_c],amplitude [1]\n0.0,"), "{text}");
    let highest = highest_point(&text, 0.5);
    let lines = lines_of(&twofold(&["spectrum", "tp-2", "--of", "m.n", "--unidentified", "--least", "0.1"]));
    assert!(lines.iter().all(|(_, name)| name == "unidentified"));
    assert!(lines.iter().any(|(line, _)| (line[0] - highest[0]).abs() < 0.02), "{highest:?} {lines:?}");

    let short = ends(twofold(&["spectrum", "tp-2", "--of", "m.n"]), 1);
    has_all(&stderr(&short), &["too short", "--span", "--unidentified"]);
    let shorter = ends(twofold(&["spectrum", "tp-2", "--of", "m.n", "--span", "50"]), 1);
    assert!(stderr(&shorter).contains("turns of n about L") && stderr(&shorter).contains("--unidentified"));
    let hardly = twofold(&["spectrum", "tp-2", "--of", "m.n", "--span", "1e-9"]);
    let value =
        stderr(&hardly).split("turns of n about L = ").nth(1).and_then(|rest| rest.split(':').next()).map(String::from);
    let value = value.expect("the number");
    let mantissa = value.split('e').next().unwrap_or_default();
    let digits = mantissa.trim_start_matches(['0', '.']).chars().filter(char::is_ascii_digit).count();
    assert!((1..=3).contains(&digits), "{}", stderr(&hardly));
}

/// 150 t_c are too short for lines that are 0.035 / t_c apart and as far from zero.
#[test]
fn lines_that_the_span_cannot_tell_apart_are_said_to_be_several() {
    for (scene, column) in
        [("tp-2", "m.n"), ("tp-2", "h_plus"), ("sp-2", "m.n"), ("sp-2", "h_plus"), ("sp-1", "h_plus")]
    {
        let near = twofold(&["spectrum", scene, "--of", column, "--span", "150", "--least", "1e-2", "--unidentified"]);
        let lines = lines_of(&near);
        let notes = stderr(&near);
        assert!(lines.iter().any(|(_, name)| name == "unresolved"), "{scene} {column}: {lines:?}");
        for (line, name) in &lines {
            // The series is one step longer than the span.
            let turns = line[3] * 150.0;
            assert!(if name == "unresolved" { turns > 0.99 } else { turns <= 1.0 }, "{scene} {column}: {lines:?}");
            assert!(
                line[0] > 0.0 && line[1] < 1.0,
                "{scene} {column}: a frequency {} with an amplitude {}",
                line[0],
                line[1]
            );
        }
        has_all(
            &notes,
            &[
                "lines are missing: ",
                "of the strongest line, which the uncertainties count; lines nearer than about 5.3e-2 rad/t_c (8 / span)",
                "longer --span",
                "of the lines listed are `unresolved`: the frequency is uncertain by more than 1 / span",
            ],
        );
    }
    let longer = twofold(&["spectrum", "tp-2", "--of", "m.n", "--span", "1500", "--least", "1e-2", "--unidentified"]);
    let strongest = &lines_of(&longer)[0];
    assert!((strongest.0[0] - 1.394_678).abs() < 1e-5 && strongest.1 == "unidentified", "{strongest:?}");
}

#[test]
fn rounding_beside_a_constant_is_not_listed() {
    for (scene, column, span, floor) in [
        // A star that spins about its axis: what oscillates in its wave is 1e13 times below the constant term.
        ("b1937+21", "h_plus", "20", "six times the noise"),
        // A component of L that is 1e-13 of |L|.
        ("b1828-11", "L_Y", "600", "the scene's tolerance is 1e-13, of 2.5e46 g cm^2/s"),
        ("tp-1", "E", "400", "the scene's tolerance is 1e-13, of 1.0e0 C"),
    ] {
        let output = twofold(&["spectrum", scene, "--of", column, "--span", span, "--unidentified"]);
        assert!(lines_of(&output).is_empty(), "{scene} {column}: {}", stdout(&output));
        let no_line = "has no line of an amplitude above";
        has_all(&stderr(&output), &["constant term", "lines below ", " are not listed: ", floor, no_line]);
    }
}

#[test]
fn a_motion_without_frequencies_has_lines_without_names() {
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.8\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.5\nrho = 0.6\n[time]\nspan = 3000.0\nsamples = 3\n";
    let folder = Folder::with(&[("upright.toml", text)]);
    let spectrum = |of: &str| folder.run(&["spectrum", "upright.toml", "--of", of]);
    let output = spectrum("m.n");
    let lines = lines_of(&output);
    assert_eq!((lines.len(), lines[0].1.as_str()), (1, "unidentified"));
    assert!((lines[0].0[0] - 1.0).abs() < 1e-12, "{lines:?}");
    assert!(stderr(&output).contains("no line is identified: the motion has no fundamental frequencies"));
    // Nothing moves here but rounding.
    let constant = spectrum("L_Z");
    assert!(lines_of(&constant).is_empty() && stderr(&constant).contains("L_Z has no line"), "{}", stderr(&constant));
    let output = ends(spectrum("beta"), 1);
    assert!(stderr(&output).contains("`beta` does not exist at t = 0.0 t_c"), "{}", stderr(&output));
}
