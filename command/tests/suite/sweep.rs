//! The command `twofold sweep` as a user meets it: tables, interruptions, shards, bad rows, refusals.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::common::{comes_to, ends, folder, is_refused, names_in, stderr, stdout, twofold};
use twofold_verify::random::Random;
use twofold_verify::refused_files::refused_files;

/// Draws and grids about tp-2; a tenth of the scenes is refused.
const SWEEP: &str = r#"
scene = "tp-2"
seed = 3
draws = 40

[[vary]]
parameter = "star.inertia_ratio"
grid = { from = 1.1, to = 2.1, points = 10 }

[[vary]]
parameter = "lorentz_violation.eigenvalues[0]"
random = { distribution = "normal", mean = 0.02, deviation = 0.005 }

[[vary]]
parameter = "initial.phase"
values = [0.5, 1.5]

[time]
times = [3.0, 20.0]

[output]
columns = ["e_z", "angles", "errors"]
summaries = ["lambda"]
"#;

fn written(folder: &Path, name: &str, text: &str) -> PathBuf {
    let file = folder.join(name);
    fs::write(&file, text).expect("file");
    file
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_twofold"));
    command.arg("sweep").args(args).current_dir(folder).stderr(Stdio::piped()).stdout(Stdio::piped());
    command
}

fn sweep(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().expect("the command starts")
}

/// A table by lines of fields.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn numbers(fields: &[String]) -> Vec<f64> {
    fields.iter().map(|field| field.parse().expect("a number")).collect()
}

#[test]
fn a_row_is_the_motion_of_its_scene() {
    let folder = folder();
    let scene = include_str!("../../../scene/scenes/tp-2.toml")
        .replace("span = 400 # [t_c]\nsamples = 4001", "times = [3.0, 20.0]");
    written(folder.path(), "base.toml", &scene);
    let text = SWEEP.replace("\"tp-2\"", "\"base.toml\"").replace("draws = 40", "draws = 1");
    let text = text.replace("[\"e_z\", \"angles\", \"errors\"]", "[\"e_z\", \"L\", \"lambda\", \"h\", \"integrals\"]");
    written(folder.path(), "sweep.toml", &text);
    ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 3);
    let table = rows(&folder.path().join("table.csv"));
    assert_eq!(table.len(), 21);
    let groups = "e_z,L,integrals,lambda,h";
    for row in table.iter().skip(1).filter(|row| row[4] == "ok") {
        let scene = scene
            .replace("inertia_ratio = 1.1", &format!("inertia_ratio = {}", row[1]))
            .replace("eigenvalues = [0.02", &format!("eigenvalues = [{}", row[2]))
            .replace("phase = 1.5707963267948966", &format!("phase = {}", row[3]));
        written(folder.path(), "one.toml", &scene);
        let one = twofold(&["run", folder.path().join("one.toml").to_str().expect("UTF-8"), "--columns", groups]);
        let run: Vec<_> = stdout(&one).lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        let run: &Vec<Vec<String>> = &run;
        let (found, width) = (numbers(&row[5..]), run[0].len() - 1);
        assert_eq!(found.len(), 2 * width + 3);
        for time in 0..2 {
            for (i, (x, y)) in found[time * width..].iter().zip(numbers(&run[time + 1][1..])).enumerate() {
                // Both are accurate to 1e-13, and h multiplies the error by second derivatives.
                assert!((x - y).abs() < 1e-11, "scene {}: {} is {x} and not {y}", row[0], run[0][i + 1]);
            }
        }
    }
    let header = &table[0];
    assert_eq!(header[5], "e_z_X@3.0 [1]");
    assert_eq!(header[header.len() - 1], "lambda_mean [rad]");
}

/// To the last digit: `n` and `L` of a method that is named are those of `run`, whether the sweep or its scene names it. At this tolerance
/// splitting and the series differ in every number.
#[test]
fn rows_are_computed_by_the_method_that_is_named() {
    let folder = folder();
    let scene = include_str!("../../../scene/scenes/tp-2.toml")
        .replace("span = 400 # [t_c]\nsamples = 4001", "times = [3.0, 20.0]");
    written(
        folder.path(),
        "plain.toml",
        &(scene.clone() + "\n[output]\ntolerance = 1e-6\ncolumns = [\"e_z\", \"L\"]\n"),
    );
    let sweep_of = |base: &str, output: &str| {
        format!(
            "scene = \"{base}\"\n[[vary]]\nparameter = \"star.inertia_ratio\"\nvalues = [1.1, 1.1]\n[time]\ntimes = [3.0, 20.0]\n\
             [output]\ncolumns = [\"e_z\", \"L\"]\ntolerance = 1e-6\n{output}"
        )
    };
    let mut all = Vec::new();
    for method in ["taylor", "splitting", "averaged"] {
        let key = format!("method = \"{method}\"\n");
        written(folder.path(), "named.toml", &(scene.clone() + "\n[output]\n" + &key));
        let args =
            ["run", folder.path().join("plain.toml").to_str().expect("UTF-8"), "--method", method].map(str::to_owned);
        let run = twofold(&args.each_ref().map(String::as_str));
        let lines: Vec<_> = stdout(&run).lines().skip(1).map(str::to_owned).collect();
        let expected: Vec<_> = lines.iter().flat_map(|line| line.split(',').skip(1).map(str::to_owned)).collect();
        assert_eq!(expected.len(), 12, "{}", stderr(&run));
        for (name, text) in [("of-scene", sweep_of("named.toml", "")), ("of-sweep", sweep_of("plain.toml", &key))] {
            written(folder.path(), "sweep.toml", &text);
            let table = format!("{method}-{name}.csv");
            ends(sweep(folder.path(), &["sweep.toml", "--out", &table]), 0);
            for row in rows(&folder.path().join(&table)).iter().skip(1) {
                assert_eq!(row[3..], expected[..], "{method}, {name}");
            }
        }
        all.push(expected);
    }
    assert!(all[0] != all[1] && all[0] != all[2] && all[1] != all[2]);
}

/// The example of `docs/sweep.md`, as it stands there.
#[test]
fn the_documented_sweep_runs() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/sweep.md")).expect("page");
    let example = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let folder = folder();
    written(folder.path(), "sweep.toml", example);
    ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv", "--shard", "3/500"]), 0);
    let table = rows(&folder.path().join("table.csv"));
    assert_eq!((table.len(), table[1][0].as_str()), (10, "18"));
}

#[test]
fn summaries_agree_with_the_other_commands() {
    let folder = folder();
    let text = "scene = \"tp-2\"\n[[vary]]\nparameter = \"pulsar.rho\"\nvalues = [0.6]\n[time]\nspan = 400\n[output]\ncolumns = []\n\
                summaries = [\"lambda\", \"pulses\", \"slow_precession\"]\n";
    written(folder.path(), "sweep.toml", text);
    ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 0);
    let found = numbers(&rows(&folder.path().join("table.csv"))[1][3..]);

    let run = stdout(&twofold(&["run", "tp-2", "--columns", "lambda"]));
    let angles: Vec<f64> = run
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(1).expect("a column").parse::<f64>().expect("a number").acos())
        .collect();
    let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = angles.iter().copied().fold(0.0, f64::max);
    // Samples 0.1 t_c apart miss an extremum of the cosine by at most rate^2 (0.05)^2 / 2.
    assert!(found[0] <= least && found[0].cos() - least.cos() < 3e-3, "{} {least}", found[0]);
    assert!(found[1] >= largest && largest.cos() - found[1].cos() < 3e-3, "{} {largest}", found[1]);
    let ends = (angles[0] + angles[angles.len() - 1]) / 2.0;
    let mean = (angles.iter().sum::<f64>() - ends) / (angles.len() - 1) as f64;
    assert!((found[2] - mean).abs() < 1e-5, "{} {mean}", found[2]);

    let pulses = stdout(&twofold(&["pulses", "tp-2"])).lines().count() - 1;
    assert_eq!(found[3], pulses as f64);
    // L goes round Z, backwards; the rate of the first order is within 5 % of the exact one for tp-II.
    assert_eq!(found[4], 3.0);
    assert!((found[5] + 0.035_464).abs() < 0.05 * 0.035_464, "{}", found[5]);
}

#[test]
fn threads_and_shards_do_not_change_a_byte() {
    let folder = folder();
    written(folder.path(), "sweep.toml", SWEEP);
    let run = |args: &[&str]| {
        let output = sweep(folder.path(), &[&["sweep.toml"], args].concat());
        assert_eq!(output.status.code(), Some(3), "{args:?}: {}", stderr(&output));
    };
    run(&["--out", "one.csv", "--threads", "1"]);
    run(&["--out", "four.csv", "--threads", "4"]);
    let read = |name: &str| fs::read(folder.path().join(name)).expect("file");
    assert_eq!(read("one.csv"), read("four.csv"));
    assert_eq!(read("one.csv.errors.csv"), read("four.csv.errors.csv"));
    let names: Vec<_> = (1..=7).map(|part| format!("part-{part}.csv")).collect();
    for (i, name) in names.iter().enumerate() {
        let output = sweep(folder.path(), &["sweep.toml", "--out", name, "--shard", &format!("{}/7", i + 1)]);
        assert!([Some(0), Some(3)].contains(&output.status.code()), "{}", stderr(&output));
    }
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    let merge =
        |parts: &[&str], out: &str| sweep(folder.path(), &[&["sweep.toml", "--out", out, "--merge"], parts].concat());
    ends(merge(&names, "merged.csv"), 3);
    assert_eq!(read("one.csv"), read("merged.csv"));
    assert_eq!(read("one.csv.errors.csv"), read("merged.csv.errors.csv"));
    for (parts, why) in [
        (&names[1..], "part-1.csv") as (&[&str], &str),
        (&names[..6], "is the last and ends before scene 685: the sweep has 800"),
        (&[names[0], names[0]], "has scene 0 where scene 114 is to come"),
        (&["sweep.toml"], "does not begin with the header"),
    ] {
        let refused = ends(merge(parts, "refused.csv"), 2);
        assert!(why == "part-1.csv" || stderr(&refused).contains(why), "{}", stderr(&refused));
        assert!(!names_in(folder.path()).iter().any(|name| name.contains("refused")), "{:?}", names_in(folder.path()));
    }
}

#[test]
fn bad_rows_are_reported_and_do_not_end_the_sweep() {
    let folder = folder();
    written(folder.path(), "sweep.toml", SWEEP);
    let output = ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 3);
    let message = stderr(&output);
    assert!(message.contains("note: 800 scenes in ") && message.contains("80 of 800 failed"), "{message}");
    assert!(message.contains("error: some scenes failed: table.csv.errors.csv says which and why\n"), "{message}");
    let table = rows(&folder.path().join("table.csv"));
    assert_eq!(table.len(), 801);
    let errors = rows(&folder.path().join("table.csv.errors.csv"));
    assert_eq!(
        errors[0],
        ["scene", "star.inertia_ratio", "lorentz_violation.eigenvalues[0]", "initial.phase", "error"]
    );
    let failed: Vec<_> = table.iter().skip(1).filter(|row| row[4] == "failed").collect();
    assert_eq!((failed.len(), errors.len()), (80, 81));
    for (row, error) in failed.iter().zip(&errors[1..]) {
        assert_eq!(row[..4], error[..4]);
        assert!(row[5..].iter().all(String::is_empty) && row.len() == table[0].len());
        assert!(error[4].contains("`star.inertia_ratio` = 2.1: allowed is from 1e-3 to 2"), "{error:?}");
    }
    for row in table.iter().skip(1).filter(|row| row[4] == "ok") {
        assert!(row[5..].iter().all(|field| field.parse::<f64>().is_ok_and(f64::is_finite)), "{row:?}");
    }
    assert_eq!(names_in(folder.path()), ["sweep.toml", "table.csv", "table.csv.errors.csv"]);
    // A later sweep without failures does not leave the old errors beside its table.
    written(folder.path(), "sweep.toml", &SWEEP.replace("to = 2.1", "to = 2.0"));
    let refused = ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 2);
    assert!(stderr(&refused).contains("--out table.csv: exists; --force replaces it"), "{}", stderr(&refused));
    ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv", "--force"]), 0);
    assert_eq!(names_in(folder.path()), ["sweep.toml", "table.csv"]);
}

/// Bytes of a file, none if it is not there.
fn length(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |found| found.len())
}

/// A sweep of seconds, killed again and again, at a mark of its journal or some rows after one, is in the end the uninterrupted one.
#[test]
fn a_killed_sweep_goes_on_to_the_same_bytes() {
    let folder = folder();
    // Many columns make short chunks: a mark is never far, and little is lost by a kill.
    let text = SWEEP.replace("draws = 40", "draws = 20").replace("times = [3.0, 20.0]", "span = 300\nsamples = 201");
    written(folder.path(), "sweep.toml", &text);
    ends(sweep(folder.path(), &["sweep.toml", "--out", "whole.csv"]), 3);
    let (rows, journal) = (folder.path().join("table.csv.partial"), folder.path().join("table.csv.partial.journal"));
    let (mut kills, mut continued) = (0, 0);
    let mut random = Random::with_seed(0x5eed);
    let last = loop {
        let threads = ["1", "2", "3"][kills % 3];
        let marked = length(&journal);
        let mut child = command(folder.path(), &["sweep.toml", "--out", "table.csv", "--threads", threads])
            .spawn()
            .expect("a process");
        // A new mark in every run: each gets further.
        let mut is_killed = comes_to(&mut child, || length(&journal) > marked);
        let more = length(&rows) + random.word() % 2_000_000;
        is_killed = is_killed && (kills % 2 == 0 || comes_to(&mut child, || length(&rows) > more));
        child.kill().expect("a signal");
        let output = child.wait_with_output().expect("status");
        continued += usize::from(stderr(&output).contains("scenes are there already"));
        if !is_killed || output.status.code().is_some() {
            break output;
        }
        kills += 1;
    };
    assert_eq!(last.status.code(), Some(3), "{}", stderr(&last));
    assert!(kills > 1 && continued > 0, "{kills} kills, continued {continued} times");
    let read = |name: &str| fs::read(folder.path().join(name)).expect("file");
    assert_eq!(read("whole.csv"), read("table.csv"), "after {kills} kills");
    assert_eq!(read("whole.csv.errors.csv"), read("table.csv.errors.csv"));
    assert!(!names_in(folder.path()).iter().any(|name| name.contains("partial")), "{:?}", names_in(folder.path()));
}

/// A billion scenes begin at once, take little memory, and are interrupted with what is there kept; the size of the table is foretold.
#[cfg(target_os = "linux")]
#[test]
fn a_huge_sweep_takes_little_memory_and_can_be_interrupted() {
    let folder = folder();
    let text = SWEEP.replace("draws = 40", "draws = 50000000").replace("times = [3.0, 20.0]", "end = 1.0");
    written(folder.path(), "sweep.toml", &text);
    let rows = folder.path().join("table.csv.partial");
    for continued in [false, true] {
        let megabyte_more = length(&rows) + 1_000_000;
        let mut child = command(folder.path(), &["sweep.toml", "--out", "table.csv"]).spawn().expect("a process");
        assert!(comes_to(&mut child, || length(&rows) > megabyte_more), "it ended by itself");
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).expect("/proc");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("VmHWM");
        let peak: u64 = peak.trim().trim_end_matches(" kB").parse().expect("a number");
        // Eight chunks of a few megabytes for each thread are the bound; these take far less.
        assert!(peak < 150_000, "{peak} kB");
        crate::common::send(&child, "TERM");
        let output = child.wait_with_output().expect("status");
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(130), "{message}");
        let left = "of 1000000000 scenes are in table.csv.partial; the same command goes on from there";
        assert!(message.contains("error: interrupted: ") && message.contains(left), "{message}");
        assert_eq!(message.contains("scenes are there already"), continued, "{message}");
        assert!(message.contains(" rows of 19 columns, about 361.0 GB") || continued, "{message}");
    }
    // A changed sweep does not go on, and leaves what is there.
    written(folder.path(), "sweep.toml", &text.replace("seed = 3", "seed = 4"));
    let before = fs::read(&rows).expect("a part");
    let refused = ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 2);
    let message = stderr(&refused);
    assert!(message.contains("line 3 was `seed = 3` and is `seed = 4`; --restart begins anew"), "{message}");
    assert!(before == fs::read(&rows).expect("a part"));
}

#[test]
fn bad_sweeps_are_refused_before_anything_is_written() {
    let files = refused_files("bad-sweeps");
    for (file, expected) in &files {
        let folder = folder();
        is_refused(&sweep(folder.path(), &[file, "--out", "table.csv"]), expected);
        assert!(names_in(folder.path()).is_empty(), "{file}");
    }
    assert!(files.len() >= 70, "only {} bad sweeps found", files.len());
}

#[test]
fn misuse_is_refused() {
    let folder = folder();
    written(folder.path(), "sweep.toml", SWEEP);
    for (args, why) in [
        (&["sweep.toml"] as &[&str], "--out <FILE>"),
        (&["sweep.toml", "--out", "-"], "is not standard output here"),
        (&["sweep.toml", "--out", "a.csv", "--shard", "5/4"], "allowed is i/n with whole numbers 1 <= i <= n"),
        (&["sweep.toml", "--out", "a.csv", "--threads", "0"], "0 is not in 1..=4096"),
        (&["sweep.toml", "--out", "none/a.csv"], "none/a.csv.partial"),
        (&["none.toml", "--out", "a.csv"], "none.toml: is not a readable file"),
        (&[".", "--out", "a.csv"], "is a directory: a sweep is a TOML file"),
        (&["sweep.toml", "--out", "a.csv", "--merge", "b.csv"], "--merge b.csv"),
    ] {
        let output = sweep(folder.path(), args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(why), "{args:?}: {}", stderr(&output));
        assert_eq!(names_in(folder.path()), ["sweep.toml"], "{args:?}");
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_is_refused_with_the_name_of_its_feature() {
    let folder = folder();
    written(folder.path(), "sweep.toml", SWEEP);
    let output = ends(sweep(folder.path(), &["sweep.toml", "--out", "a.parquet"]), 2);
    assert!(stderr(&output).contains("--features twofold-verify/parquet"), "{}", stderr(&output));
    assert_eq!(names_in(folder.path()), ["sweep.toml"]);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_does_not_depend_on_threads_shards_or_interruptions() {
    let folder = folder();
    written(folder.path(), "sweep.toml", SWEEP);
    let run = |args: &[&str]| {
        let output = sweep(folder.path(), &[&["sweep.toml"], args].concat());
        assert!([Some(0), Some(3)].contains(&output.status.code()), "{args:?}: {}", stderr(&output));
    };
    run(&["--out", "one.parquet", "--threads", "1"]);
    run(&["--out", "three.parquet", "--threads", "3"]);
    run(&["--out", "a.csv", "--shard", "1/2"]);
    run(&["--out", "b.csv", "--shard", "2/2"]);
    run(&["--out", "merged.parquet", "--merge", "a.csv", "b.csv"]);
    let read = |name: &str| fs::read(folder.path().join(name)).expect("file");
    assert!(read("one.parquet").starts_with(b"PAR1"));
    assert!(read("one.parquet") == read("three.parquet") && read("one.parquet") == read("merged.parquet"));
    assert!(!names_in(folder.path()).iter().any(|name| name.contains("partial")), "{:?}", names_in(folder.path()));
}

/// A coarse motion, of errors far above rounding: the column of each is what the columns of the integrals differ by between the start and a
/// later time, and what the length of `e_z` differs from one by.
#[test]
fn errors_are_the_changes_of_what_is_constant() {
    let folder = folder();
    written(
        folder.path(),
        "star.toml",
        "[star]\nmass = 1.4\nradius = 12.0\noblateness = 0.05\nspin_frequency = 100.0\n[lorentz_violation]\n\
         eigenvalues = [0.05, 0.01, -0.06]\n[initial]\nalpha = 0.4\nbeta = 0.8\nalpha_rate = 650.0\nbeta_rate = 40.0\n[time]\n\
         span = 1.0\nsamples = 2\n",
    );
    let text = "scene = \"star.toml\"\n[[vary]]\nparameter = \"initial.beta\"\nvalues = [0.8, 0.9]\n[time]\n\
                times = [0.0, 0.03, 0.2]\n[output]\ncolumns = [\"integrals\", \"e_z\", \"errors\"]\ntolerance = 1e-2\nmethod = \"taylor\"\n";
    written(folder.path(), "sweep.toml", text);
    ends(sweep(folder.path(), &["sweep.toml", "--out", "table.csv"]), 0);
    let table = rows(&folder.path().join("table.csv"));
    assert_eq!(table.len(), 3);
    for row in &table[1..] {
        let at = |head: &str| -> f64 {
            let place =
                table[0].iter().position(|found| found == head).unwrap_or_else(|| panic!("{head}: {:?}", table[0]));
            row[place].parse().expect("a number")
        };
        for time in ["0.03", "0.2"] {
            for (name, unit) in [("E", "[erg]"), ("Omega_z", "[rad/s]"), ("K", "[(g cm^2/s)^2]")] {
                let [now, start] = [time, "0.0"].map(|time| at(&format!("{name}@{time} {unit}")));
                let error = at(&format!("{name}_error@{time} {unit}"));
                // Each integral is rounded a few times.
                let rounding = 16.0 * f64::EPSILON * now.abs();
                assert!((error - (now - start)).abs() <= rounding, "{name}@{time}: {error:e}, {:e}", now - start);
                assert!(error.abs() > 1e3 * rounding, "{name}@{time}: {error:e} for {now:e}");
            }
            let length = ["X", "Y", "Z"].map(|i| at(&format!("e_z_{i}@{time} [1]")).powi(2)).iter().sum::<f64>().sqrt();
            let error = at(&format!("e_z_length_error@{time} [1]"));
            assert!((error - (length - 1.0)).abs() < 1e-15, "{error:e} and {:e}", length - 1.0);
            assert!(error.abs() > 1e-12, "{error:e}");
        }
    }
}
