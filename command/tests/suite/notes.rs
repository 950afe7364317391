//! Messages of commands besides their tables: estimated errors, plans, notes and progress.

use crate::common::{Folder, altered, comes_to, number_after, numbers, stderr, stdout, twofold, with_lines};
use twofold_scene::scene_file::built_in;

/// The note at the end of `run` is between one and ten times the largest difference of the last row from that of a motion a million times
/// as accurate.
#[test]
fn the_estimated_error_that_run_prints_is_that_of_its_last_row() {
    let last_row = |tolerance: &str, method: &str| {
        let output = format!("\n[output]\ncolumns = [\"e_x\", \"e_z\"]\ntolerance = {tolerance}\n");
        let folder = Folder::with(&[("scene.toml", &(altered("tp-2", &[]) + &output))]);
        let output = folder.succeeds(&["run", "scene.toml", "--method", method]);
        let row = numbers(&stdout(&output)).pop().expect("a row").split_off(1);
        (row, number_after(&stderr(&output), "at the end of the span: "))
    };
    let (exact, _) = last_row("1e-13", "taylor");
    for method in ["taylor", "splitting"] {
        let (row, stated) = last_row("1e-7", method);
        let off = row.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off > 1e-12 && (off..30.0 * off).contains(&stated), "{method}: off by {off:e}, {stated:e} is printed");
    }
}

/// Allowed input that is probably a mistake is noted.
#[test]
fn a_spin_beyond_break_up_and_a_julian_date_are_noted() {
    let notes = |lines: &[(&str, &str)], args: &[&str]| {
        let folder = Folder::with(&[("star.toml", &with_lines("b1937+21", lines))]);
        stderr(&folder.succeeds(&[&args[..1], &["star.toml"], &args[1..]].concat()))
    };
    let run = ["run", "--columns", "h"];
    let fast = notes(&[("spin_frequency", "spin_frequency = 3000.0")], &run);
    assert!(fast.contains("star.toml: `star.spin_frequency` = 3000.0: above ") && fast.contains("break-up"), "{fast}");
    let julian = notes(&[("epoch", "epoch = \"2455321.75\"")], &run);
    assert!(julian.contains("`time.epoch` = \"2455321.75\": looks like a Julian date"), "{julian}");
    assert!(julian.contains("in the year 8581. If 55321.25 is meant"), "{julian}");
    // In 6500 years the bulge turns the beam out of the line of sight.
    let option = notes(
        &[("bulge", "bulge = 0.0")],
        &["timing", "--from", "2455321.5", "--to", "2455322.5", "--epochs", "3", "--out", "out"],
    );
    assert!(
        option.contains("note: --from: looks like a Julian date") && option.contains("If 55321.0 is meant"),
        "{option}"
    );
    let none = notes(&[], &run);
    assert!(!none.contains("Julian") && !none.contains("break-up"), "{none}");
}

/// Where no terminal is, a long run writes a line of progress when the signal USR1 asks for one.
#[cfg(unix)]
#[test]
fn a_long_run_without_a_terminal_tells_how_far_it_is() {
    use std::io::{BufRead, BufReader};
    let folder = Folder::with(&[("long.toml", &altered("tp-1", &[("span = 400", "span = 4e7")]))]);
    // The series in time takes minutes, that on the torus milliseconds.
    let mut run =
        folder.command(&["run", "long.toml", "--method", "taylor", "--columns", "e_z", "--out", "motion.csv"]);
    let mut child = run.spawn().expect("the command starts");
    assert!(comes_to(&mut child, || folder.names().len() > 1), "it ended by itself");
    // An incomplete file is hidden, next to its final name.
    let names = folder.names();
    assert!(names[0].starts_with(".motion.csv.") && names[0].ends_with(".part"), "{names:?}");
    crate::common::send(&child, "USR1");
    let lines = BufReader::new(child.stderr.take().expect("standard error")).lines();
    let line = lines.map(|line| line.expect("text")).find(|line| line.contains("% done")).expect("a line");
    crate::common::send(&child, "TERM");
    assert_eq!(child.wait().expect("status").code(), Some(130));
    assert!(line.starts_with("note: ") && line.contains(" % done after "), "{line}");
}

/// A star that spins about its axis at 20 Hz, along Z, with a beam that just touches the line of sight: at the azimuth of the observer, 0.1 rad after
/// the start.
const GRAZING: &str = "[star]\nmass = 1.4\nradius = 12.0\noblateness = 0.01\nspin_frequency = 20.0\n\
    [lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.3\nbeta = 0.0\nalpha_rate = 1.0\nbeta_rate = 0.0\n\
    [observer]\ntheta_o = 0.9\nphi_o = 0.4\n[pulsar]\nchi = 0.5\nrho = 0.4\n[time]\nstart = 7.0\nspan = 0.2\nsamples = 3\n";

#[test]
fn notes_and_plans_of_a_physical_star_have_its_times_in_seconds() {
    let folder = Folder::with(&[("scene.toml", GRAZING)]);
    let told = stderr(&folder.run(&["pulses", "scene.toml"]));
    let first = 7.0 + 0.1 / (40.0 * std::f64::consts::PI);
    assert!((number_after(&told, "first at t = ") - first).abs() < 1e-8, "{told}");
    let plan = stdout(&folder.run(&["run", "scene.toml", "--columns", "e_z", "--method", "taylor", "--explain"]));
    let line = plan.lines().find(|line| line.starts_with("span ")).expect("a span");
    let [_, from, "to", to, "s"] = line.split_whitespace().collect::<Vec<_>>()[..] else { panic!("{line}") };
    assert!(
        [(from, 7.0), (to, 7.2)].iter().all(|(text, t)| (text.parse::<f64>().expect("a time") - t).abs() < 1e-12),
        "{line}"
    );
}

/// The method named second is the cheapest of the others that meet the tolerance, and the ratio is that of their costs.
#[test]
fn the_next_method_is_the_second_cheapest() {
    // Without violation all methods are accurate enough.
    let plan = stdout(&twofold(&["run", "free", "--columns", "e_z", "--explain"]));
    let unit = |unit: &str| match unit {
        "ns," => 1.0,
        "us," => 1e3,
        "ms," => 1e6,
        "s," => 1e9,
        other => panic!("{other}"),
    };
    let costs = plan.split("methods considered").nth(1).expect("methods").lines().filter_map(|line| {
        let words: Vec<_> = line.split_whitespace().collect();
        let cost = words.get(1)?.parse::<f64>().ok()? * unit(words[2]);
        Some((cost, words[0].trim_end_matches(':')))
    });
    let mut costs: Vec<_> = costs.collect();
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(costs.len() >= 3, "{plan}");
    assert!(plan.contains(&format!("next is {},", costs[1].1)), "{plan}");
    let ratio = number_after(&plan, &format!("next is {},", costs[1].1));
    // Costs are printed to a tenth of their unit, the ratio to a tenth.
    assert!((ratio - costs[1].0 / costs[0].0).abs() < 0.06 + 0.1 * ratio, "{ratio} {costs:?}");
}

/// A motion with more turns than can be kept is computed in segments. The error continues from one to the next and has grown with the phase at the
/// end.
#[test]
fn the_error_of_a_long_motion_is_that_at_its_end() {
    let (before, _) = built_in("tp-1").expect("tp-1").toml.split_once("[time]").expect("times");
    let error = |span: f64| {
        let times = format!("[time]\nspan = {span}\nsamples = 2\n[output]\ntolerance = 1e-12\nmethod = \"taylor\"\n");
        let folder = Folder::with(&[("scene.toml", &format!("{before}{times}"))]);
        let told = stderr(&folder.run(&["run", "scene.toml", "--columns", "e_z"]));
        number_after(&told, "at the end of the span:")
    };
    let (short, long) = (error(100.0), error(45_000.0));
    assert!(1000.0 * short < long && long < 1e-8, "{short:e} {long:e}");
}
