//! `twofold pulses`: turns and closest approaches.

use twofold::observables::pulsar::PulsarClock;
use twofold::propagation::PhasedMotion;
use twofold_scene::scene_file::Scene;

use crate::common::{Folder, cells, ends, stderr, stdout, succeeds, twofold};

#[test]
fn pulses_have_turns_and_closest_approaches_where_turns_can_be_counted() {
    let text = stdout(&succeeds(&["pulses", "sp-2"]));
    let rows = &cells(&text)[1..];
    let whole: Vec<_> = rows.iter().filter(|row| row[6].is_empty()).collect();
    assert_eq!(whole[0][8], "0", "{text}");
    for row in rows {
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
    let output = Folder::with(&[("along.toml", &text)]).succeeds(&["pulses", "along.toml"]);
    let table = stdout(&output);
    assert_eq!(table.lines().count(), 6, "{table}");
    assert!(table.lines().skip(1).all(|line| line.ends_with(",,,")), "{table}");
    assert_eq!(
        stderr(&output).matches("note: turn and closest_approach are empty for 4 whole pulses of beam 1").count(),
        1
    );
}

/// A window of the span of a scene has the pulses of the whole; after 1e9 t_c the count starts again.
#[test]
fn a_window_may_be_late() {
    let rows = |args: &[&str]| {
        let text = stdout(&succeeds(args));
        let number = |row: &[&str], k: usize| row[k].parse::<f64>().expect("a number");
        let rows: Vec<_> = cells(&text)[1..]
            .iter()
            .filter(|row| row[6].is_empty())
            .map(|row| (number(row, 4), number(row, 5), number(row, 8)))
            .collect();
        rows
    };
    let (all, part) = (rows(&["pulses", "tp-2"]), rows(&["pulses", "tp-2", "--from", "100", "--to", "200"]));
    let first = all.iter().position(|row| row.0 > part[0].0 - 1e-6).expect("the first pulse");
    for (a, b) in all[first..].iter().zip(&part) {
        assert!((a.0 - b.0).abs() < 1e-10 && (a.1 - b.1).abs() < 1e-10 && a.2 - all[first].2 == b.2, "{a:?} {b:?}");
    }
    assert!(part.len() > 10);
    let late = rows(&["pulses", "tp-2", "--from", "1e11", "--to", "100000000100"]);
    let scene = Scene::named("tp-2").expect("a scene");
    let (beam, observer) = (scene.pulsar.expect("a beam").beam(), scene.observer.expect("an observer").basis());
    let motion = PhasedMotion::torus(&scene.problem, 1e11).expect("a torus");
    let clock = PulsarClock::new(motion, &beam, &observer).expect("a clock");
    for (midpoint, duration, _) in &late {
        let pulse = clock.pulse_near([*midpoint, 0.0]).expect("a time").expect("a pulse");
        // Doubles are 1.5e-5 apart there.
        assert!((pulse.midpoint[0] - midpoint).abs() < 2e-5 && (pulse.duration - duration).abs() < 1e-10, "{midpoint}");
    }
    assert!(late.len() > 10 && late[0].2 == 0.0);
    let angles = stdout(&succeeds(&["run", "tp-1", "--columns", "angles", "--from", "1e9", "--to", "1000000010"]));
    let alpha = |row: &[&str]| row[1].parse::<f64>().expect("an angle");
    let rows = cells(&angles);
    assert!(
        alpha(&rows[1]).abs() < 3.15 && (alpha(&rows[4001]) - alpha(&rows[1]) - 15.12).abs() < 0.5,
        "{}",
        rows[4001].join(",")
    );
    for (args, part) in [
        (&["pulses", "tp-2", "--from", "0", "--to", "1e9"][..], "rad of rotation: must be at most"),
        (&["pulses", "tp-2", "--from", "1e9", "--to", "1000000100", "--method", "taylor"], "rotation over the span"),
        (&["pulses", "tp-2", "--from", "1e9"], "after the end of the scene"),
        (&["pulses", "tp-2", "--from", "7", "--to", "7"], "a window from 7.0 to 7.0"),
        (&["pulses", "tp-2", "--from", "1e14", "--to", "2e14"], "resolve a thousandth"),
        (&["run", "tp-2", "--from", "7", "--columns", "perturbation"], "not where a window"),
    ] {
        let message = stderr(&ends(twofold(args), 2));
        assert!(message.contains(part), "{args:?}: {message}");
    }
}
