//! What commands say beside their tables: estimated errors, plans, notes and progress.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{comes_to, file, folder, stderr, succeeds, twofold};
use twofold_scene::scene_file::BUILT_IN;

/// The note at the end of `run` is not below the largest difference of the last row from that of a motion a million times as accurate, and
/// not ten times above it.
#[test]
fn the_estimated_error_that_run_prints_is_that_of_its_last_row() {
    let folder = folder();
    let built_in = BUILT_IN.iter().find(|scene| scene.name == "tp-2").expect("tp-2").toml;
    let last_row = |tolerance: &str, method: &str| {
        let text = built_in.replace("tolerance = 1e-13", "");
        let path = folder.path().join("scene.toml");
        fs::write(&path, format!("{text}\n[output]\ncolumns = [\"e_x\", \"e_z\"]\ntolerance = {tolerance}\n"))
            .expect("scene");
        let output = succeeds(&["run", path.to_str().expect("path in UTF-8"), "--method", method]);
        let table = String::from_utf8(output.stdout.clone()).expect("text");
        let row: Vec<f64> =
            table.lines().last().expect("a row").split(',').skip(1).map(|x| x.parse().expect("a number")).collect();
        let notes = stderr(&output);
        let (_, note) = notes.rsplit_once("at the end of the span: ").expect("a note");
        (row, note.trim().parse::<f64>().expect("a number"))
    };
    let (exact, _) = last_row("1e-13", "taylor");
    for method in ["taylor", "splitting"] {
        let (row, stated) = last_row("1e-7", method);
        let off = row.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off > 1e-12 && (off..30.0 * off).contains(&stated), "{method}: off by {off:e}, {stated:e} is printed");
    }
}

/// `--explain` prints the plan and computes nothing.
#[test]
fn a_plan_is_explained() {
    let explain = |args: &[&str]| {
        let output = twofold(args);
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let wave = explain(&["run", "tp-1", "--columns", "h", "--explain"]);
    for fragment in
        ["state        n, L\n", "method       taylor", "the third angle (e_x): the outputs depend on n and L alone"]
    {
        assert!(wave.contains(fragment), "{fragment}: {wave}");
    }
    let free = explain(&["run", "free", "--columns", "h", "--explain"]);
    assert!(free.contains("method       free") && free.contains("integration: the motion has a closed form"), "{free}");
    let pulses = explain(&["pulses", "tp-1", "--explain"]);
    assert!(pulses.contains("samples: events are found on the dense output"), "{pulses}");
    let forced = explain(&["spectrum", "free", "--of", "h_plus", "--unidentified", "--method", "taylor", "--explain"]);
    assert!(forced.contains("method       taylor") && forced.contains("as asked"), "{forced}");
}

/// What is allowed and looks like a mistake is said.
#[test]
fn a_spin_beyond_break_up_and_a_julian_date_are_noted() {
    let folder = folder();
    let built_in = include_str!("../../../scene/scenes/b1937+21.toml");
    let notes = |name: &str, from: &str, to: &str, args: &[&str]| {
        assert!(built_in.contains(from), "{from}");
        fs::write(folder.path().join(name), built_in.replace(from, to)).expect("scene");
        let scene = folder.path().join(name);
        let output = succeeds(&[&args[..1], &[scene.to_str().expect("UTF-8")], &args[1..]].concat());
        stderr(&output)
    };
    let out = folder.path().join("out");
    let out = out.to_str().expect("UTF-8");
    let spin = built_in.lines().find(|line| line.starts_with("spin_frequency")).expect("spin");
    let epoch = built_in.lines().find(|line| line.starts_with("epoch")).expect("epoch");
    let run = ["run", "--columns", "h"];
    let fast = notes("fast.toml", spin, "spin_frequency = 3000.0", &run);
    assert!(fast.contains("fast.toml: `star.spin_frequency` = 3000.0: above ") && fast.contains("break-up"), "{fast}");
    let julian = notes("julian.toml", epoch, "epoch = \"2455321.75\"", &run);
    assert!(julian.contains("`time.epoch` = \"2455321.75\": looks like a Julian date"), "{julian}");
    assert!(julian.contains("in the year 8581. If 55321.25 is meant"), "{julian}");
    let option = ["timing", "--from", "2455321.5", "--to", "2455322.5", "--epochs", "3", "--out", out];
    let option = notes("as-it-is.toml", spin, spin, &option);
    assert!(
        option.contains("note: --from: looks like a Julian date") && option.contains("If 55321.0 is meant"),
        "{option}"
    );
    let none = notes("as-it-is.toml", spin, spin, &run);
    assert!(!none.contains("Julian") && !none.contains("break-up"), "{none}");
}

/// Where no terminal is, a long run writes a line now and then.
#[cfg(target_os = "linux")]
#[test]
fn a_long_run_without_a_terminal_tells_how_far_it_is() {
    use std::io::{BufRead, BufReader};
    let folder = folder();
    let scene = folder.path().join("long.toml");
    fs::write(&scene, include_str!("../../../scene/scenes/tp-1.toml").replace("span = 400", "span = 4e7"))
        .expect("scene");
    let mut child = Command::new(env!("CARGO_BIN_EXE_twofold"))
        .args(["run", scene.to_str().expect("UTF-8"), "--columns", "e_z", "--out", "motion.csv"])
        .current_dir(folder.path())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let begun = || fs::read_dir(folder.path()).expect("folder").count() > 1;
    assert!(comes_to(&mut child, begun), "it ended by itself");
    // The first line comes after ten seconds; others use the processor until then.
    crate::common::send(&child, "STOP");
    std::thread::sleep(Duration::from_secs(10));
    crate::common::send(&child, "CONT");
    let lines = BufReader::new(child.stderr.take().expect("standard error")).lines();
    let line = lines.map(|line| line.expect("text")).find(|line| line.contains("% done")).expect("a line");
    crate::common::send(&child, "TERM");
    assert_eq!(child.wait().expect("status").code(), Some(130));
    assert!(line.starts_with("note: ") && line.contains(" % done after "), "{line}");
}

/// A star that spins about its axis at 20 Hz, along Z, and whose beam just touches the line of sight: at the azimuth of the observer, 0.1 rad after the start.
const GRAZING: &str = "[star]\nmass = 1.4\nradius = 12.0\noblateness = 0.01\nspin_frequency = 20.0\n\
    [lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.3\nbeta = 0.0\nalpha_rate = 1.0\nbeta_rate = 0.0\n\
    [observer]\ntheta_o = 0.9\nphi_o = 0.4\n[pulsar]\nchi = 0.5\nrho = 0.4\n[time]\nstart = 7.0\nspan = 0.2\nsamples = 3\n";

/// The number that follows a phrase in a text.
fn number_after(text: &str, phrase: &str) -> f64 {
    let rest = text.split(phrase).nth(1).unwrap_or_else(|| panic!("`{phrase}` in {text}"));
    let number = rest.split_whitespace().next().expect("a word");
    number.trim_end_matches([',', ';']).parse().unwrap_or_else(|why| panic!("{number}: {why}"))
}

#[test]
fn notes_and_plans_of_a_physical_star_have_its_times_in_seconds() {
    let (_folder, scene) = file("scene.toml", GRAZING);
    let told = stderr(&twofold(&["pulses", &scene]));
    let first = 7.0 + 0.1 / (40.0 * std::f64::consts::PI);
    assert!((number_after(&told, "first at t = ") - first).abs() < 1e-8, "{told}");
    let plan = twofold(&["run", &scene, "--columns", "e_z", "--method", "taylor", "--explain"]);
    let plan = String::from_utf8_lossy(&plan.stdout).into_owned();
    let line = plan.lines().find(|line| line.starts_with("stretch ")).expect("a stretch");
    let [_, from, "to", to, "s"] = line.split_whitespace().collect::<Vec<_>>()[..] else { panic!("{line}") };
    assert!(
        [(from, 7.0), (to, 7.2)].iter().all(|(text, t)| (text.parse::<f64>().expect("a time") - t).abs() < 1e-12),
        "{line}"
    );
}

/// The method named as next is the cheapest of the others that meet the tolerance, and the ratio is that of their costs.
#[test]
fn the_next_method_is_the_second_cheapest() {
    // Without violation all methods are good enough.
    let plan = twofold(&["run", "free", "--columns", "e_z", "--explain"]);
    let plan = String::from_utf8_lossy(&plan.stdout).into_owned();
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

/// A motion of more turns than are kept is computed in stretches, and has no estimate of its own.
#[test]
fn an_error_that_is_foreseen_is_not_called_estimated() {
    let folder = folder();
    let scene = folder.path().join("scene.toml");
    let tp_1 = BUILT_IN.iter().find(|scene| scene.name == "tp-1").expect("tp-1").toml;
    let (before, _) = tp_1.split_once("[time]").expect("times");
    for (span, words) in [(100.0, "note: estimated error"), (45_000.0, "note: error that the plan foresaw")] {
        let times = format!("[time]\nspan = {span}\nsamples = 2\n[output]\ntolerance = 1e-6\nmethod = \"taylor\"\n");
        fs::write(&scene, format!("{before}{times}")).expect("scene");
        let told = stderr(&twofold(&["run", scene.to_str().expect("path in UTF-8"), "--columns", "e_z"]));
        assert!(told.contains(&format!("{words} of n")), "{told}");
    }
}
