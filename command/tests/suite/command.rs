//! The command `twofold` as a user meets it: status, messages, files.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{comes_to, folder, names_in, stderr, twofold};
use twofold_scene::scene_file::BUILT_IN;

/// Status 2, nothing on standard output, one message that contains the fragments, no file.
fn assert_refused(scene: &Path, fragments: &[&str]) {
    let folder = folder();
    let out = folder.path().join("motion.csv");
    let scene = scene.to_str().expect("path in UTF-8");
    for extra in [&["--out", out.to_str().expect("path in UTF-8")][..], &[]] {
        let output = twofold(&[&["run", scene], extra].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{scene}: {message}");
        assert!(output.stdout.is_empty(), "{scene}: something on standard output");
        assert!(message.starts_with("error: "), "{message}");
        assert_eq!(message.matches("error: ").count(), 1, "{scene}: {message}");
        assert!(!message.contains("panicked"), "{message}");
        for fragment in fragments {
            assert!(message.contains(fragment), "{scene}: expected `{fragment}` in\n{message}");
        }
        assert!(names_in(folder.path()).is_empty(), "{scene}: left {:?}", names_in(folder.path()));
    }
}

/// The note at the end of `run` is not below the largest difference of the last row from that of a motion a million times as accurate, and
/// not ten times above it.
#[test]
fn the_estimated_error_that_run_prints_is_that_of_its_last_row() {
    let folder = folder();
    let built_in = BUILT_IN.iter().find(|scene| scene.name == "tp-2").expect("tp-2").toml;
    let last_row = |accuracy: &str, method: &str| {
        let text = built_in.replace("accuracy = 1e-13", "");
        let path = folder.path().join("scene.toml");
        fs::write(&path, format!("{text}\n[output]\ncolumns = [\"e_x\", \"e_z\"]\naccuracy = {accuracy}\n"))
            .expect("scene");
        let output = twofold(&["run", path.to_str().expect("path in UTF-8"), "--method", method]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
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

#[test]
fn columns_of_a_scene_need_sections_only_where_they_are_written() {
    let folder = folder();
    let text = include_str!("../../../tests/data/bad-scenes/product-without-pulsar.toml");
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, text).expect("scene");
    let scene = scene.to_str().expect("path in UTF-8");
    assert_eq!(twofold(&["run", scene]).status.code(), Some(2));
    let angles = twofold(&["run", scene, "--columns", "angles"]);
    assert_eq!(angles.status.code(), Some(0), "{}", stderr(&angles));
    assert!(angles.stdout.starts_with(b"t [t_c],alpha"));
    let still = twofold(&["run", scene, "--columns", "m.n"]);
    assert_eq!(still.status.code(), Some(2));
    assert!(stderr(&still).contains("`m.n`: the scene lacks"), "{}", stderr(&still));
}

#[test]
fn bad_scenes_are_refused_before_anything_is_written() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/bad-scenes");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("folder of bad scenes") {
        let path = entry.expect("entry").path();
        let text = fs::read_to_string(&path).expect("text");
        let expected = text.lines().next().and_then(|line| line.strip_prefix("# expect: ")).expect("`# expect:`");
        assert_refused(&path, &expected.split(" | ").collect::<Vec<_>>());
        count += 1;
    }
    assert!(count >= 95, "only {count} bad scenes found");
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = folder();
    assert_refused(folder.path(), &["is a directory"]);
    assert_refused(Path::new("tp-11"), &["neither a built-in scene nor a readable file", "did you mean `tp-1`?"]);
    assert_refused(Path::new("TP-1"), &["did you mean `tp-1`?"]);
    assert_refused(&folder.path().join("none.toml"), &["the built-in scenes are `tp-1`, `tp-2`"]);
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("file");
        path
    };
    assert_refused(&file("latin-1.toml", b"about = \"\xe9toile\"\n"), &["is not UTF-8 text (byte 10)"]);
    assert_refused(&file("empty.toml", b""), &["missing section [star]"]);
    assert_refused(&file("zeros.toml", &[0; 100]), &["not TOML"]);
    assert_refused(&file("escape.toml", b"\"\\u001b[31mred\" = 1\n"), &["unknown key `\u{fffd}[31mred`"]);
    assert_refused(&file("raw-escape.toml", b"a = \"\x1b[31m\"\n"), &["1 | a = \"\u{fffd}[31m\""]);
    assert_refused(&file("deep.toml", format!("a = {}", "[".repeat(100_000)).as_bytes()), &["not TOML"]);
}

#[cfg(target_os = "linux")]
#[test]
fn an_endless_file_is_not_read_to_the_end() {
    assert_refused(Path::new("/dev/zero"), &["is longer than 64 MiB"]);
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

#[test]
fn an_output_file_appears_complete_and_is_not_overwritten() {
    let folder = folder();
    let out = folder.path().join("motion.csv");
    let out = out.to_str().expect("path in UTF-8");
    let printed = twofold(&["run", "tp-1"]);
    assert_eq!(printed.status.code(), Some(0));
    assert!(stderr(&printed).starts_with("note: estimated error of n, e_x and L / |L| at the end of the span: "));
    assert!(printed.stdout.starts_with(b"t [t_c],alpha [rad],beta [rad],gamma [rad],alpha_rate [rad/t_c],"));
    assert_eq!(printed.stdout.iter().filter(|&&byte| byte == b'\n').count(), 4002);

    let written = twofold(&["run", "tp-1", "--out", out]);
    assert_eq!(written.status.code(), Some(0), "{}", stderr(&written));
    assert!(written.stdout.is_empty());
    assert_eq!(fs::read(out).expect("table"), printed.stdout);
    assert_eq!(names_in(folder.path()), ["motion.csv"]);

    let again = twofold(&["run", "tp-2", "--out", out]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("exists; --force replaces it"), "{}", stderr(&again));
    assert_eq!(fs::read(out).expect("table"), printed.stdout);

    let forced = twofold(&["run", "tp-2", "--out", out, "--force"]);
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    assert_ne!(fs::read(out).expect("table"), printed.stdout);
    assert_eq!(names_in(folder.path()), ["motion.csv"]);
}

#[test]
fn an_output_that_cannot_be_a_file_is_refused() {
    let folder = folder();
    let missing = folder.path().join("none/motion.csv");
    for (out, reason) in [
        (folder.path(), "is not a regular file"),
        (missing.as_path(), "no file can be made in"),
        (Path::new("/"), "is not a regular file"),
    ] {
        let output = twofold(&["run", "tp-1", "--force", "--out", out.to_str().expect("path in UTF-8")]);
        assert_eq!(output.status.code(), Some(2), "{}", out.display());
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    assert!(names_in(folder.path()).is_empty());
    let dash = twofold(&["run", "tp-1", "--out", "-"]);
    assert_eq!(dash.status.code(), Some(2));
    assert!(stderr(&dash).contains("is not standard output here"), "{}", stderr(&dash));
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_is_refused_before_the_computation() {
    let folder = folder();
    let link = folder.path().join("link.csv");
    std::os::unix::fs::symlink("nothing", &link).expect("link");
    let output = twofold(&["run", "tp-1", "--out", link.to_str().expect("path in UTF-8")]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is a link to nothing"), "{}", stderr(&output));
    assert_eq!(names_in(folder.path()), ["link.csv"]);
}

#[test]
fn a_reader_that_goes_away_ends_the_command_quietly() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_twofold"))
        .args(["run", "tp-1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stdout.take());
    let mut message = String::new();
    child.stderr.take().expect("standard error").read_to_string(&mut message).expect("text");
    assert_eq!(message, "");
    assert_eq!(child.wait().expect("status").code(), Some(0));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = || fs::File::options().write(true).open("/dev/full").expect("/dev/full");
    for args in [&["run", "tp-1"][..], &["scenes"]] {
        let output = Command::new(env!("CARGO_BIN_EXE_twofold")).args(args).stdout(full()).output().expect("starts");
        assert_eq!(output.status.code(), Some(1), "{args:?}");
        assert!(stderr(&output).contains("cannot be written") || stderr(&output).contains("could not be written"));
    }
}

#[test]
fn a_pole_leaves_fields_empty_and_says_so() {
    let folder = folder();
    let scene = folder.path().join("pole.toml");
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n\
                [initial]\nalpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[time]\ntimes = [0.0, 1.0]\n\
                [output]\ncolumns = [\"angles\", \"e_z\"]\n";
    fs::write(&scene, text).expect("scene");
    let output = twofold(&["run", scene.to_str().expect("path in UTF-8")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let table = String::from_utf8(output.stdout.clone()).expect("text");
    assert_eq!(table.lines().nth(1), Some("0.0,,,,0.0,0.0,1.0"), "{table}");
    assert!(stderr(&output).contains("on a pole in 2 of 2 rows, first at t = 0.0 t_c"), "{}", stderr(&output));
}

#[test]
fn a_report_that_cannot_be_written_is_refused_before_the_checks_are_run() {
    let folder = folder();
    let out = folder.path().join("report");
    let out = out.to_str().expect("path in UTF-8");
    fs::create_dir(out).expect("folder");
    let page = Path::new(out).join("index.html");
    fs::write(&page, "mine").expect("file");
    for (out, reason) in
        [(out, "index.html exists there; --force replaces"), (page.to_str().expect("UTF-8"), "is not a folder")]
    {
        let output = twofold(&["report", "--out", out]);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    }
    assert_eq!(fs::read_to_string(&page).expect("file"), "mine");
    assert_eq!(names_in(Path::new(out)), ["index.html"]);
}

#[test]
fn scenes_are_listed_and_each_listed_name_runs() {
    let output = twofold(&["scenes"]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).expect("text");
    let (scenes, sweeps) = text.split_once("\nSweeps").expect("both kinds");
    let names = |list: &str| -> Vec<String> {
        list.lines().filter_map(|line| Some(line.strip_prefix("  ")?.split("  ").next()?.to_owned())).collect()
    };
    assert_eq!((names(scenes).len(), names(sweeps)), (14, vec!["grid".to_owned()]), "{text}");
    for name in names(scenes) {
        assert_eq!(twofold(&["run", &name]).status.code(), Some(0), "{name}");
    }
}

/// The file of a built-in scene, printed, is that scene; a name that is none is refused.
#[test]
fn a_printed_scene_is_a_template() {
    let folder = folder();
    let scene = folder.path().join("my-star.toml");
    let printed = twofold(&["scenes", "--print", "tp-2"]);
    assert_eq!((printed.status.code(), stderr(&printed).as_str()), (Some(0), ""));
    fs::write(&scene, &printed.stdout).expect("file");
    let run = |scene: &str| twofold(&["run", scene, "--columns", "h"]).stdout;
    let table = run(scene.to_str().expect("UTF-8"));
    assert!(table.starts_with(b"t [t_c],h_plus [1]") && table == run("tp-2"));
    let unknown = twofold(&["scenes", "--print", "tp-22"]);
    assert_eq!((unknown.status.code(), unknown.stdout.is_empty()), (Some(2), true));
    assert!(stderr(&unknown).contains("Did you mean `tp-2`?"), "{}", stderr(&unknown));
}

/// Columns of the command line are checked as those of the file: a span too long for them is refused with file and line.
#[test]
fn a_span_too_long_for_the_columns_asked_for_is_refused_at_its_place() {
    let folder = folder();
    let scene = folder.path().join("long.toml");
    let text = include_str!("../../../scene/scenes/tp-1.toml").replace("span = 400", "span = 1e15");
    fs::write(&scene, &text).expect("scene");
    let line = 1 + text.lines().position(|line| line == "[time]").expect("the section");
    for columns in [&[][..], &["--columns", "e_z"]] {
        let output = twofold(&[&["run", scene.to_str().expect("UTF-8")], columns].concat());
        assert_eq!(output.status.code(), Some(2), "{columns:?}: {}", stderr(&output));
        let place = format!("long.toml:{line}:1: [time] asks for a rotation by ");
        assert!(stderr(&output).contains(&place), "{columns:?}: {}", stderr(&output));
    }
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
        let output = twofold(&[&args[..1], &[scene.to_str().expect("UTF-8")], &args[1..]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
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

/// A table of 10 MB or more is foretold, and nearly so large.
#[test]
fn the_size_of_a_large_table_is_foretold() {
    let folder = folder();
    let scene = folder.path().join("scene.toml");
    let text = include_str!("../../../scene/scenes/tp-1.toml").replace("samples = 4001", "samples = 30001");
    fs::write(&scene, &text).expect("scene");
    let output = twofold(&["run", scene.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let size = stderr(&output);
    let size = size.split("rows of ").nth(1).and_then(|rest| rest.split("about ").nth(1)).expect("a size");
    let size: f64 = size.split(" MB").next().and_then(|size| size.parse().ok()).expect("megabytes");
    let found = output.stdout.len() as f64 / 1e6;
    assert!(found >= 9.0 && (size / found - 1.0).abs() < 0.15, "{size} {found}");
    assert!(!stderr(&twofold(&["run", "tp-1"])).contains("rows of"));
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

#[test]
fn verify_prints_tables_or_json_and_refuses_an_unknown_filter() {
    let id = twofold_verify::checks::all()[0].id;
    let table = twofold(&["verify", "--filter", id]);
    assert_eq!(table.status.code(), Some(0), "{}", stderr(&table));
    assert!(table.stderr.is_empty(), "no progress where there is no terminal: {}", stderr(&table));
    let text = String::from_utf8(table.stdout).expect("text");
    assert!(text.contains("verdict") && text.contains("all pass"), "{text}");

    let json = twofold(&["verify", "--json", "--filter", id]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert!(json.as_array().expect("array").iter().any(|check| check["id"] == id && check["passed"] == true));

    let unknown = twofold(&["verify", "--filter", "no-such-check"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(stderr(&unknown).contains("no check has an id that contains `no-such-check`"));
    assert!(unknown.stdout.is_empty());
}

#[test]
fn columns_of_the_command_line_replace_those_of_the_scene() {
    let output = twofold(&["run", "tp-1", "--columns", "m.n,h"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        output.stdout.starts_with(b"t [t_c],m.n [1],m.n_rate [1/t_c],h_plus [1],h_cross [1]\n0.0,0.87328491422829")
    );
    for (columns, fragments) in [
        ("lamda", &["free: --columns: `lamda` is no group of columns", "Did you mean `lambda`?"][..]),
        ("h,h", &["`h` comes twice"]),
        ("", &["`` is no group of columns"]),
        ("perturbation", &["the scene lacks a perturbation solution", "`initial.kind`"]),
    ] {
        let output = twofold(&["run", "free", "--columns", columns]);
        assert_eq!(output.status.code(), Some(2), "{columns}");
        assert!(output.stdout.is_empty());
        for fragment in fragments {
            assert!(stderr(&output).contains(fragment), "expected `{fragment}` in {}", stderr(&output));
        }
    }
}

#[test]
fn pulses_are_written_like_a_motion() {
    let output = twofold(&["pulses", "tp-1"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
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
        let output = of_built_in(section);
        assert_eq!(output.status.code(), Some(2));
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
    let folder = folder();
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
    let scene = folder.path().join("along.toml");
    let rate = 1.1 / 0.7_f64.cos();
    let text = format!(
        "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.0\n\
         beta = 0.7\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\nchi = 0.5\n\
         rho = 0.6\n[time]\nspan = 300.0\nsamples = 3\n"
    );
    fs::write(&scene, text).expect("scene");
    let output = twofold(&["pulses", scene.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
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
    let folder = folder();
    let scene = folder.path().join("steady.toml");
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.5\nrho = 0.6\n[time]\nspan = 3000.0\nsamples = 2\n";
    fs::write(&scene, text).expect("scene");
    let output = twofold(&["pulses", scene.to_str().expect("UTF-8")]);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(table.lines().nth(1), Some("1,1,0.0,3000.0,1500.0,3000.0,both,,,,"), "{table}");
    assert_eq!(table.lines().count(), 2);
}

#[test]
fn the_position_angle_is_empty_along_the_line_of_sight() {
    let folder = folder();
    let scene = folder.path().join("scene.toml");
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.0\nrho = 0.6\n[time]\ntimes = [0.0]\n";
    fs::write(&scene, text).expect("scene");
    let output = twofold(&["run", scene.to_str().expect("UTF-8"), "--columns", "position_angle"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "t [t_c],psi [rad],psi_rate [rad/t_c]\n0.0,,\n");
    assert!(stderr(&output).contains("psi where that is along the line of sight"), "{}", stderr(&output));
}

#[test]
fn misuse_has_status_2_and_help_has_status_0() {
    for args in [&["run"][..], &["walk"], &["run", "tp-1", "--force"], &["verify", "--filter"]] {
        assert_eq!(twofold(args).status.code(), Some(2), "{args:?}");
    }
    for args in [&["--help"][..], &["run", "--help"], &["--version"]] {
        assert_eq!(twofold(args).status.code(), Some(0), "{args:?}");
    }
}

/// What the README shows the commands with.
#[cfg(unix)]
const PREFIX: &str = "cargo run --release -- ";

/// One after the other in an empty folder, every command succeeds: each finds the files that it names. Those that take longest, the whole
/// report and the timings, are only asked for their help; `tests/signals.rs` starts them.
#[cfg(unix)]
#[test]
fn the_commands_of_the_readme_work() {
    let readme = include_str!("../../../README.md");
    let (folder, program) = (folder(), Path::new(env!("CARGO_BIN_EXE_twofold")));
    let blocks = readme.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let commands: Vec<_> = blocks.flat_map(str::lines).filter_map(|line| line.strip_prefix(PREFIX)).collect();
    assert!(commands.len() >= 15, "{commands:?}");
    for command in commands {
        let arguments = command.split(" #").next().unwrap_or(command).trim();
        let is_long = ["report", "bench"].iter().any(|long| arguments.starts_with(long));
        let help = if is_long { " --help" } else { "" };
        let script = format!("\"$0\" {arguments}{help}");
        let output =
            Command::new("sh").args(["-c", &script]).arg(program).current_dir(folder.path()).output().expect("a shell");
        assert_eq!(output.status.code(), Some(0), "{arguments}: {}", stderr(&output));
    }
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
    let folder = folder();
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, GRAZING).expect("scene");
    let scene = scene.to_str().expect("path in UTF-8");
    let told = stderr(&twofold(&["pulses", scene]));
    let first = 7.0 + 0.1 / (40.0 * std::f64::consts::PI);
    assert!((number_after(&told, "first at t = ") - first).abs() < 1e-8, "{told}");
    let plan = twofold(&["run", scene, "--columns", "e_z", "--method", "taylor", "--explain"]);
    let plan = String::from_utf8_lossy(&plan.stdout).into_owned();
    let line = plan.lines().find(|line| line.starts_with("stretch ")).expect("a stretch");
    let [_, from, "to", to, "s"] = line.split_whitespace().collect::<Vec<_>>()[..] else { panic!("{line}") };
    assert!(
        [(from, 7.0), (to, 7.2)].iter().all(|(text, t)| (text.parse::<f64>().expect("a time") - t).abs() < 1e-12),
        "{line}"
    );
}

/// The method named as next is the cheapest of the others that meet the accuracy, and the ratio is that of their costs.
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
        let times = format!("[time]\nspan = {span}\nsamples = 2\n[output]\naccuracy = 1e-6\nmethod = \"taylor\"\n");
        fs::write(&scene, format!("{before}{times}")).expect("scene");
        let told = stderr(&twofold(&["run", scene.to_str().expect("path in UTF-8"), "--columns", "e_z"]));
        assert!(told.contains(&format!("{words} of n")), "{told}");
    }
}
