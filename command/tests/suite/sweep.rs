//! The command `twofold sweep` as a user sees it: tables, interruptions, shards, bad rows, refusals.

use std::fs;
use std::path::Path;

use crate::common::{Folder, altered, cells, comes_to, ends, is_refused, number_after, stderr, stdout, twofold};
use twofold_scene::sweep::{Identity, Spool, SpoolFiles, SweepText};
use twofold_verify::random::Random;
use twofold_verify::refused_files::refused_files;

/// Draws and grids about tp-2; a tenth of the scenes are refused.
const SWEEP: &str = include_str!("../cases/sweep.toml");

/// tp-2 at two times.
fn two_times() -> String {
    altered("tp-2", &[("span = 400 # [t_c]\nsamples = 4001", "times = [3.0, 20.0]")])
}

/// The fields of a table, line by line.
fn rows(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    cells(&folder.read(name)).into_iter().map(|row| row.into_iter().map(str::to_owned).collect()).collect()
}

fn numbers(fields: &[impl AsRef<str>]) -> Vec<f64> {
    fields.iter().map(|field| field.as_ref().parse().expect("a number")).collect()
}

#[test]
fn a_row_is_the_motion_of_its_scene() {
    let folder = Folder::new();
    let scene = two_times();
    folder.write("base.toml", &scene);
    let text = SWEEP.replace("\"tp-2\"", "\"base.toml\"").replace("draws = 40", "draws = 1");
    let text = text.replace("[\"e_z\", \"angles\", \"errors\"]", "[\"e_z\", \"L\", \"lambda\", \"h\", \"integrals\"]");
    folder.write("sweep.toml", &text);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), 3);
    let table = rows(&folder, "table.csv");
    assert_eq!(table.len(), 21);
    let groups = "e_z,L,integrals,lambda,h";
    for row in table.iter().skip(1).filter(|row| row[4] == "ok") {
        let scene = scene
            .replace("inertia_ratio = 1.1", &format!("inertia_ratio = {}", row[1]))
            .replace("eigenvalues = [0.02", &format!("eigenvalues = [{}", row[2]))
            .replace("phase = 1.5707963267948966", &format!("phase = {}", row[3]));
        folder.write("one.toml", &scene);
        let one = stdout(&folder.run(&["run", "one.toml", "--columns", groups]));
        let run = cells(&one);
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

/// `n` and `L` of a named method agree with `run` to the last digit, whether the sweep or its scene names it. At this tolerance splitting
/// and the series differ in every number.
#[test]
fn rows_are_computed_by_the_method_that_is_named() {
    let folder = Folder::new();
    let scene = two_times();
    folder.write("plain.toml", &(scene.clone() + "\n[output]\ntolerance = 1e-6\ncolumns = [\"e_z\", \"L\"]\n"));
    let sweep_of = |base: &str, output: &str| {
        format!(
            "scene = \"{base}\"\n[[vary]]\nparameter = \"star.inertia_ratio\"\nvalues = [1.1, 1.1]\n[time]\ntimes = [3.0, 20.0]\n\
             [output]\ncolumns = [\"e_z\", \"L\"]\ntolerance = 1e-6\n{output}"
        )
    };
    let mut all = Vec::new();
    for method in ["taylor", "splitting", "averaged"] {
        let key = format!("method = \"{method}\"\n");
        folder.write("named.toml", &(scene.clone() + "\n[output]\n" + &key));
        let run = folder.run(&["run", "plain.toml", "--method", method]);
        let table = stdout(&run);
        let expected: Vec<_> =
            cells(&table)[1..].iter().flat_map(|row| row[1..].iter().map(|x| x.to_string())).collect();
        assert_eq!(expected.len(), 12, "{}", stderr(&run));
        for (name, text) in [("of-scene", sweep_of("named.toml", "")), ("of-sweep", sweep_of("plain.toml", &key))] {
            folder.write("sweep.toml", &text);
            let table = format!("{method}-{name}.csv");
            ends(folder.run(&["sweep", "sweep.toml", "--out", &table]), 0);
            for row in rows(&folder, &table).iter().skip(1) {
                assert_eq!(row[3..], expected[..], "{method}, {name}");
            }
        }
        all.push(expected);
    }
    assert!(all[0] != all[1] && all[0] != all[2] && all[1] != all[2]);
}

/// The example of `docs/sweep.md`, verbatim.
#[test]
fn the_documented_sweep_runs() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/sweep.md")).expect("page");
    let example = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let folder = Folder::new();
    folder.write("sweep.toml", example);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv", "--shard", "3/500"]), 0);
    let table = rows(&folder, "table.csv");
    assert_eq!((table.len(), table[1][0].as_str()), (10, "18"));
}

#[test]
fn summaries_agree_with_the_other_commands() {
    let folder = Folder::new();
    let text = "scene = \"tp-2\"\n[[vary]]\nparameter = \"pulsar.rho\"\nvalues = [0.6]\n[time]\nspan = 400\n[output]\ncolumns = []\n\
                summaries = [\"lambda\", \"pulses\", \"slow_precession\"]\n";
    folder.write("sweep.toml", text);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), 0);
    let found = numbers(&rows(&folder, "table.csv")[1][3..]);

    let run = stdout(&twofold(&["run", "tp-2", "--columns", "lambda"]));
    let angles: Vec<f64> = cells(&run)[1..].iter().map(|row| numbers(row)[1].acos()).collect();
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
    // L circles Z backwards; the rate to first order is within 5 % of the exact one for tp-II.
    assert_eq!(found[4], 3.0);
    assert!((found[5] + 0.035_464).abs() < 0.05 * 0.035_464, "{}", found[5]);
}

#[test]
fn threads_and_shards_do_not_change_a_byte() {
    let folder = Folder::new();
    folder.write("sweep.toml", SWEEP);
    let run = |args: &[&str]| {
        let output = folder.run(&[&["sweep", "sweep.toml"], args].concat());
        ends(output, 3);
    };
    run(&["--out", "one.csv", "--threads", "1"]);
    run(&["--out", "four.csv", "--threads", "4"]);
    let read = |name: &str| folder.bytes(name);
    assert_eq!(read("one.csv"), read("four.csv"));
    assert_eq!(read("one.csv.errors.csv"), read("four.csv.errors.csv"));
    let names: Vec<_> = (1..=7).map(|part| format!("part-{part}.csv")).collect();
    for (i, name) in names.iter().enumerate() {
        let output = folder.run(&["sweep", "sweep.toml", "--out", name, "--shard", &format!("{}/7", i + 1)]);
        assert!([Some(0), Some(3)].contains(&output.status.code()), "{}", stderr(&output));
    }
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    let merge =
        |parts: &[&str], out: &str| folder.run(&[&["sweep", "sweep.toml", "--out", out, "--merge"], parts].concat());
    ends(merge(&names, "merged.csv"), 3);
    assert_eq!(read("one.csv"), read("merged.csv"));
    assert_eq!(read("one.csv.errors.csv"), read("merged.csv.errors.csv"));
    // The table of a sweep with other outputs has as many scenes but another header.
    let other = folder.read("one.csv").replacen("alpha", "other", 1);
    folder.write("other.csv", other);
    // A sweep with another grid or seed has as many scenes and the same header.
    let one = folder.read("one.csv");
    let (head, rest) = one.split_once("\n1,").expect("two rows");
    let (_, rest) = rest.split_once(',').expect("a parameter");
    folder.write("moved.csv", format!("{head}\n1,0.125,{rest}"));
    for (parts, why) in [
        (&["other.csv"][..], "other.csv does not begin with the header of this sweep's table"),
        (&names[1..], "part-1.csv") as (&[&str], &str),
        (&names[..6], "is the last and ends before scene 685; the sweep has 800 scenes"),
        (&[names[0], names[0]], "has scene 0 where scene 114 is expected"),
        (&["sweep.toml"], "does not begin with the header"),
        (&["moved.csv"], "moved.csv is of another sweep: its scene 1 has other parameters"),
    ] {
        let refused = ends(merge(parts, "refused.csv"), 2);
        assert!(why == "part-1.csv" || stderr(&refused).contains(why), "{}", stderr(&refused));
        assert!(!folder.names().iter().any(|name| name.contains("refused")), "{:?}", folder.names());
    }
    // Errors with the header of another sweep are refused.
    let errors = names.iter().map(|name| format!("{name}.errors.csv")).find(|name| folder.at(name).exists());
    let errors = errors.expect("a part in which a scene fails");
    let ours = folder.read(&errors);
    folder.write(&errors, ours.replacen("initial.phase", "initial.beta", 1));
    is_refused(&merge(&names, "refused.csv"), &[&errors, "does not begin with the header of this sweep's errors"]);
    let (head, row) = ours.split_once('\n').expect("an error");
    let (number, row) = row.split_once(',').expect("a parameter");
    folder.write(&errors, format!("{head}\n{number},0.125,{}", row.split_once(',').expect("fields").1));
    is_refused(&merge(&names, "refused.csv"), &[&errors, "is of another sweep: its scene", "has other parameters"]);
    folder.write(&errors, ours);
    // Errors that cannot be read, here a folder, do not count as none.
    fs::create_dir(folder.at("part-1.csv.errors.csv")).expect("a folder");
    is_refused(&merge(&names, "refused.csv"), &["part-1.csv.errors.csv"]);
}

#[test]
fn bad_rows_are_reported_and_do_not_end_the_sweep() {
    let folder = Folder::new();
    folder.write("sweep.toml", SWEEP);
    let output = ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), 3);
    let message = stderr(&output);
    assert!(message.contains("note: 800 scenes in ") && message.contains("80 of 800 failed"), "{message}");
    assert!(
        message.contains("error: some scenes failed; table.csv.errors.csv lists them with the reasons\n"),
        "{message}"
    );
    let table = rows(&folder, "table.csv");
    assert_eq!(table.len(), 801);
    let errors = rows(&folder, "table.csv.errors.csv");
    assert_eq!(
        errors[0],
        ["scene", "star.inertia_ratio", "lorentz_violation.eigenvalues[0]", "initial.phase", "error"]
    );
    let failed: Vec<_> = table.iter().skip(1).filter(|row| row[4] == "failed").collect();
    assert_eq!((failed.len(), errors.len()), (80, 81));
    for (row, error) in failed.iter().zip(&errors[1..]) {
        assert_eq!(row[..4], error[..4]);
        assert!(row[5..].iter().all(String::is_empty) && row.len() == table[0].len());
        assert!(error[4].contains("`star.inertia_ratio` = 2.1: must be from 1e-3 to 2"), "{error:?}");
    }
    for row in table.iter().skip(1).filter(|row| row[4] == "ok") {
        assert!(row[5..].iter().all(|field| field.parse::<f64>().is_ok_and(f64::is_finite)), "{row:?}");
    }
    assert_eq!(folder.names(), ["sweep.toml", "table.csv", "table.csv.errors.csv"]);
    // A later sweep without failures removes the old errors next to its table.
    folder.write("sweep.toml", SWEEP.replace("to = 2.1", "to = 2.0"));
    let refused = ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), 2);
    assert!(stderr(&refused).contains("--out table.csv: exists; --force replaces it"), "{}", stderr(&refused));
    let errors = folder.bytes("table.csv.errors.csv");
    ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv", "--force"]), 0);
    assert_eq!(folder.names(), ["sweep.toml", "table.csv"]);
    // So does a merged one.
    folder.write("merged.csv.errors.csv", errors);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "merged.csv", "--force", "--merge", "table.csv"]), 0);
    assert_eq!(folder.names(), ["merged.csv", "sweep.toml", "table.csv"]);
}

/// A sweep of seconds, killed again and again at a mark of its journal or some rows later, ends with the uninterrupted table.
#[test]
fn a_killed_sweep_goes_on_to_the_same_bytes() {
    let folder = Folder::new();
    // Many columns make short chunks: a mark is never far, and a kill loses little.
    let text = SWEEP.replace("draws = 40", "draws = 10").replace("times = [3.0, 20.0]", "span = 300\nsamples = 201");
    folder.write("sweep.toml", &text);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "whole.csv"]), 3);
    let (rows, journal) = ("table.csv.partial", "table.csv.partial.journal");
    let (mut kills, mut continued) = (0, 0);
    let mut random = Random::with_seed(0x5eed);
    let last = loop {
        let threads = ["1", "2", "3"][kills % 3];
        let marked = folder.length(journal);
        let mut child = folder
            .command(&["sweep", "sweep.toml", "--out", "table.csv", "--threads", threads])
            .spawn()
            .expect("a process");
        // Each run reaches a new mark, and so gets further.
        let mut is_killed = comes_to(&mut child, || folder.length(journal) > marked);
        let more = folder.length(rows) + random.word() % 1_000_000;
        is_killed = is_killed && (kills % 2 == 0 || comes_to(&mut child, || folder.length(rows) > more));
        child.kill().expect("a signal");
        let output = child.wait_with_output().expect("status");
        continued += usize::from(stderr(&output).contains("scenes are already computed"));
        if !is_killed || output.status.code().is_some() {
            break output;
        }
        kills += 1;
    };
    assert_eq!(last.status.code(), Some(3), "{}", stderr(&last));
    assert!(kills > 1 && continued > 0, "{kills} kills, continued {continued} times");
    let read = |name: &str| folder.bytes(name);
    assert_eq!(read("whole.csv"), read("table.csv"), "after {kills} kills");
    assert_eq!(read("whole.csv.errors.csv"), read("table.csv.errors.csv"));
    assert!(!folder.names().iter().any(|name| name.contains("partial")), "{:?}", folder.names());
}

/// A complete sweep that was not yet renamed: half of a copy of the errors is its own file, a table with its name is not.
#[test]
fn a_file_that_appears_before_the_table_is_named_stays() {
    let folder = Folder::new();
    folder.write("sweep.toml", SWEEP);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "whole.csv"]), 3);
    let [whole, errors] = ["whole.csv", "whole.csv.errors.csv"].map(|name| folder.bytes(name));
    let text = SweepText::read(&folder.at("sweep.toml").to_string_lossy()).expect("a sweep");
    let complete = || {
        let files = SpoolFiles::of(&folder.at("table.csv"));
        let mut spool = Spool::open(files, &Identity::new(&text, &(0..800)), [b"", b""], 0..800).expect("a table");
        spool.append(800, [&whole, &errors], 80).expect("rows");
        spool.commit().expect("a mark");
        spool.completed().expect("a mark");
    };
    let run = |more: &[&str]| folder.run(&[&["sweep", "sweep.toml", "--out", "table.csv"], more].concat());
    complete();
    folder.write("table.csv", "theirs");
    assert!(stderr(&ends(run(&[]), 2)).contains("--out table.csv: exists; --force replaces it"));
    assert_eq!(folder.read("table.csv"), "theirs");
    ends(run(&["--force"]), 3);
    assert!(folder.bytes("table.csv") == whole && folder.bytes("table.csv.errors.csv") == errors);
    fs::remove_file(folder.at("table.csv")).expect("a table");
    complete();
    folder.write("table.csv.errors.csv", "theirs");
    assert!(stderr(&ends(run(&[]), 1)).contains("table.csv.errors.csv exists and does not belong to this table"));
    assert_eq!(folder.read("table.csv.errors.csv"), "theirs");
    folder.write("table.csv.errors.csv", &errors[..errors.len() / 2]);
    ends(run(&[]), 3);
    assert!(folder.bytes("table.csv") == whole && folder.bytes("table.csv.errors.csv") == errors);
}

/// A sweep that is killed when its table is already renamed but its journal still exists.
#[test]
fn a_sweep_killed_while_it_tidied_tells_again_whether_scenes_failed() {
    let one = |ratio: &str| {
        format!("scene = 'tp-2'\n[[vary]]\nparameter = 'star.inertia_ratio'\nvalues = [{ratio}]\n[time]\nend = 1.0\n")
    };
    for (sweep, scenes, failed) in [(SWEEP, 800, 80), (&one("5.0"), 1, 1), (&one("0.9"), 1, 0)] {
        let folder = Folder::with(&[("sweep.toml", sweep)]);
        let status = if failed == 0 { 0 } else { 3 };
        let run = || stderr(&ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), status));
        let why = "error: some scenes failed; table.csv.errors.csv lists them with the reasons\n";
        assert_eq!(run().ends_with(why), failed > 0);
        let (table, names) = (folder.bytes("table.csv"), folder.names());
        let errors = if failed == 0 { Vec::new() } else { folder.bytes("table.csv.errors.csv") };
        let text = SweepText::read(&folder.at("sweep.toml").to_string_lossy()).expect("a sweep");
        let (files, identity) = (SpoolFiles::of(&folder.at("table.csv")), Identity::new(&text, &(0..scenes)));
        let mut spool = Spool::open(files, &identity, [b"", b""], 0..scenes).expect("a table");
        spool.append(scenes, [&table, &errors], failed).expect("rows");
        spool.commit().expect("a mark");
        spool.completed().expect("a mark");
        drop(spool);
        fs::remove_file(folder.at("table.csv.partial")).expect("rows");
        assert_eq!(run(), if failed == 0 { "" } else { why });
        assert!(folder.bytes("table.csv") == table);
        assert_eq!(folder.names(), names);
    }
}

/// A billion scenes start at once, take little memory, and are interrupted without loss; the size of the table is predicted, and the count for the
/// second half is that of this half.
#[cfg(target_os = "linux")]
#[test]
fn a_huge_sweep_takes_little_memory_and_can_be_interrupted() {
    let folder = Folder::new();
    let text = SWEEP.replace("draws = 40", "draws = 50000000").replace("times = [3.0, 20.0]", "end = 1.0");
    folder.write("sweep.toml", &text);
    let rows = "table.csv.partial";
    let mut there = 0.0;
    for continued in [false, true] {
        let megabyte_more = folder.length(rows) + 1_000_000;
        let args = ["sweep", "sweep.toml", "--out", "table.csv", "--shard", "2/2"];
        let mut child = folder.command(&args).spawn().expect("a process");
        assert!(comes_to(&mut child, || folder.length(rows) > megabyte_more), "it ended by itself");
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).expect("/proc");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("VmHWM");
        let peak: u64 = peak.trim().trim_end_matches(" kB").parse().expect("a number");
        // The bound is eight chunks of a few megabytes per thread; these take far less.
        assert!(peak < 150_000, "{peak} kB");
        crate::common::send(&child, "TERM");
        let message = stderr(&ends(child.wait_with_output().expect("status"), 130));
        assert!(message.contains("; run the same command to continue"), "{message}");
        assert_eq!(message.contains("scenes are already computed"), continued, "{message}");
        assert!(!continued || message.contains(&format!("note: {there} of 500000000 scenes are already computed")));
        assert!(message.contains(" rows of 19 columns, about 180.5 GB") || continued, "{message}");
        // `COMPUTED scenes in SECONDS s, RATE scenes/s; FAILED of ALL failed`, then `ALL of 500000000 scenes are in`.
        let before = there;
        there = number_after(&message, "error: interrupted: ");
        let line = message.lines().find(|line| line.contains(" scenes in ")).expect("a line about the speed");
        let [computed, seconds, rate] = ["note: ", " scenes in ", " s, "].map(|phrase| number_after(line, phrase));
        assert_eq!((computed, number_after(line, " of ")), (there - before, there), "{message}");
        // Seconds are printed to a hundredth.
        assert!((rate * seconds / computed - 1.0).abs() < 1e-3 + 0.005 / seconds, "{message}");
        assert!(message.contains(&format!("{there} of 500000000 scenes are in table.csv.partial")), "{message}");
    }
    // A changed sweep does not continue, and leaves the existing files alone.
    folder.write("sweep.toml", text.replace("seed = 3", "seed = 4"));
    let before = folder.bytes(rows);
    let refused = ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv", "--shard", "2/2"]), 2);
    let message = stderr(&refused);
    assert!(message.contains("line 3 was `seed = 3` and is `seed = 4`; --restart starts over"), "{message}");
    assert!(before == folder.bytes(rows));
}

#[test]
fn bad_sweeps_are_refused_before_anything_is_written() {
    let files = refused_files("bad-sweeps");
    for (file, expected) in &files {
        let folder = Folder::new();
        let refused = folder.run(&["sweep", file, "--out", "table.csv"]);
        is_refused(&refused, expected);
        // The message begins with the path of the sweep, or of a scene beside it.
        let beside = Path::new(file).parent().expect("a folder").display().to_string();
        assert!(stderr(&refused).starts_with(&format!("error: {beside}/")), "{}", stderr(&refused));
        assert!(folder.names().is_empty(), "{file}");
    }
    assert!(files.len() >= 70, "only {} bad sweeps found", files.len());
}

/// Nor through a link.
#[cfg(unix)]
#[test]
fn the_scene_of_a_sweep_is_not_replaced_by_its_table() {
    let folder = Folder::with(&[
        ("sub/sweep.toml", &SWEEP.replace("\"tp-2\"", "\"star.toml\"")),
        ("sub/star.toml", &two_times()),
    ]);
    std::os::unix::fs::symlink("sub/star.toml", folder.at("link")).expect("a link");
    for out in ["sub/star.toml", "link"] {
        let refused = folder.run(&["sweep", "sub/sweep.toml", "--out", out, "--force"]);
        is_refused(&refused, &[&format!("--out {out} is also an input file; choose another name")]);
    }
    assert_eq!(folder.read("sub/star.toml"), two_times());
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_is_refused_with_the_name_of_its_feature() {
    let folder = Folder::new();
    folder.write("sweep.toml", SWEEP);
    let output = ends(folder.run(&["sweep", "sweep.toml", "--out", "a.parquet"]), 2);
    assert!(stderr(&output).contains("--features parquet"), "{}", stderr(&output));
    assert_eq!(folder.names(), ["sweep.toml"]);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_does_not_depend_on_threads_shards_or_interruptions() {
    let folder = Folder::new();
    folder.write("sweep.toml", SWEEP);
    let run = |args: &[&str]| {
        let output = folder.run(&[&["sweep", "sweep.toml"], args].concat());
        assert!([Some(0), Some(3)].contains(&output.status.code()), "{args:?}: {}", stderr(&output));
    };
    run(&["--out", "one.parquet", "--threads", "1"]);
    run(&["--out", "three.parquet", "--threads", "3"]);
    run(&["--out", "a.csv", "--shard", "1/2"]);
    run(&["--out", "b.csv", "--shard", "2/2"]);
    run(&["--out", "merged.parquet", "--merge", "a.csv", "b.csv"]);
    let read = |name: &str| folder.bytes(name);
    assert!(read("one.parquet").starts_with(b"PAR1"));
    assert!(read("one.parquet") == read("three.parquet") && read("one.parquet") == read("merged.parquet"));
    assert!(!folder.names().iter().any(|name| name.contains("partial")), "{:?}", folder.names());
}

/// A coarse motion with errors far above rounding: each error column is the change of an integral between the start and a later time, or
/// the deviation of the length of `e_z` from one.
#[test]
fn errors_are_the_changes_of_what_is_constant() {
    let folder = Folder::new();
    folder.write("star.toml",
        "[star]\nmass = 1.4\nradius = 12.0\noblateness = 0.05\nspin_frequency = 100.0\n[lorentz_violation]\n\
         eigenvalues = [0.05, 0.01, -0.06]\n[initial]\nalpha = 0.4\nbeta = 0.8\nalpha_rate = 650.0\nbeta_rate = 40.0\n[time]\n\
         span = 1.0\nsamples = 2\n",
    );
    let text = "scene = \"star.toml\"\n[[vary]]\nparameter = \"initial.beta\"\nvalues = [0.8, 0.9]\n[time]\n\
                times = [0.0, 0.03, 0.2]\n[output]\ncolumns = [\"integrals\", \"e_z\", \"errors\"]\ntolerance = 1e-2\nmethod = \"taylor\"\n";
    folder.write("sweep.toml", text);
    ends(folder.run(&["sweep", "sweep.toml", "--out", "table.csv"]), 0);
    let table = rows(&folder, "table.csv");
    assert_eq!(table.len(), 3);
    for row in &table[1..] {
        let at = |head: &str| -> f64 {
            let folder =
                table[0].iter().position(|found| found == head).unwrap_or_else(|| panic!("{head}: {:?}", table[0]));
            row[folder].parse().expect("a number")
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
