//! `twofold pulses`: rows, turns and what it says where there are none.

use std::fs;
use std::path::Path;

use crate::common::{ends, file, folder, stderr, succeeds, twofold};

#[test]
fn pulses_are_written_like_a_motion() {
    let output = succeeds(&["pulses", "tp-1"]);
    let text = String::from_utf8(output.stdout).expect("text");
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(
        lines[0],
        "beam,pulse,start [t_c],end [t_c],midpoint [t_c],duration [t_c],cut,period [t_c],turn,closest_approach [t_c],W_56 [rad]"
    );
    assert!(lines[1].starts_with("1,1,0.0,0.0870381812") && lines[1].ends_with(",start,,,,"), "{}", lines[1]);
    assert_eq!(lines.len(), 98);
    let none = twofold(&["pulses", "tp-1", "--second-beam"]);
    assert_eq!(String::from_utf8_lossy(&none.stdout), text);
    assert!(stderr(&none).starts_with("note: no pulse of beam 2: "), "{}", stderr(&none));
    let both = twofold(&["pulses", "retrograde", "--second-beam"]);
    assert!(String::from_utf8_lossy(&both.stdout).contains("\n2,1,"));

    let folder = folder();
    let scene = folder.path().join("scene.toml");
    let of_built_in = |without: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scene/scenes/tp-1.toml");
        let text = fs::read_to_string(path).expect("scene");
        let kept = text.split("\n\n").filter(|section| !section.starts_with(without)).collect::<Vec<_>>();
        fs::write(&scene, kept.join("\n\n")).expect("file");
        twofold(&["pulses", scene.to_str().expect("UTF-8")])
    };
    for section in ["[observer]", "[pulsar]"] {
        let output = ends(of_built_in(section), 2);
        assert!(stderr(&output).contains(&format!("the scene lacks the section {section}")), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    let dark = fs::read_to_string(&scene).expect("scene");
    fs::write(&scene, format!("{dark}\n[pulsar]\nchi = 0.5\nrho = 1e-6\n")).expect("file");
    let output = twofold(&["pulses", scene.to_str().expect("UTF-8")]);
    assert_eq!(
        (output.status.code(), stderr(&output).contains("note: no pulse of beam 1")),
        (Some(0), true),
        "{}",
        stderr(&output)
    );
}

#[test]
fn pulses_have_turns_and_closest_approaches_where_turns_can_be_counted() {
    let text = String::from_utf8(twofold(&["pulses", "sp-2"]).stdout).expect("text");
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let whole: Vec<_> = rows.iter().filter(|row| row[6].is_empty()).collect();
    assert_eq!(whole[0][8], "0", "{text}");
    for row in &rows {
        assert_eq!((row[8].is_empty(), row[9].is_empty()), (!row[6].is_empty(), !row[6].is_empty()), "{row:?}");
    }
    for pair in whole.windows(2) {
        let turn = |row: &[&str]| row[8].parse::<i64>().expect("turn");
        assert!(turn(pair[0]) < turn(pair[1]));
    }
    for row in &whole {
        let at = |k: usize| row[k].parse::<f64>().expect("number");
        assert!(at(2) < at(9) && at(9) < at(3), "{row:?}");
    }
    // Free precession, seen along the angular momentum.
    let rate = 1.1 / 0.7_f64.cos();
    let text = format!(
        "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.0\n\
         beta = 0.7\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\nchi = 0.5\n\
         rho = 0.6\n[time]\nspan = 300.0\nsamples = 3\n"
    );
    let (_folder, scene) = file("along.toml", text);
    let output = succeeds(&["pulses", &scene]);
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(table.lines().count(), 6, "{table}");
    assert!(table.lines().skip(1).all(|line| line.ends_with(",,,")), "{table}");
    assert_eq!(
        stderr(&output).matches("note: turn and closest_approach are empty for 4 whole pulses of beam 1").count(),
        1
    );
}

/// A steady line of sight inside the beam has no closest approach to look for.
#[test]
fn a_beam_that_is_always_seen_is_one_pulse_without_a_turn() {
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.5\nrho = 0.6\n[time]\nspan = 3000.0\nsamples = 2\n";
    let (_folder, scene) = file("steady.toml", text);
    let output = twofold(&["pulses", &scene]);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(table.lines().nth(1), Some("1,1,0.0,3000.0,1500.0,3000.0,both,,,,"), "{table}");
    assert_eq!(table.lines().count(), 2);
}
