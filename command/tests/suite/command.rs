//! The command `twofold` as a user meets it: status, messages, files.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{file, folder, has_all, is_refused, names_in, refuses, stderr, succeeds, twofold};
use twofold_verify::refused_files::refused_files;

/// Refused, and no file is left.
fn assert_refused(scene: &Path, fragments: &[impl AsRef<str>]) {
    let folder = folder();
    let out = folder.path().join("motion.csv");
    let scene = scene.to_str().expect("path in UTF-8");
    for extra in [&["--out", out.to_str().expect("path in UTF-8")][..], &[]] {
        is_refused(&twofold(&[&["run", scene], extra].concat()), fragments);
        assert!(names_in(folder.path()).is_empty(), "{scene}: left {:?}", names_in(folder.path()));
    }
}

#[test]
fn columns_of_a_scene_need_sections_only_where_they_are_written() {
    let text = include_str!("../../../tests/data/bad-scenes/product-without-pulsar.toml");
    let (_folder, scene) = file("scene.toml", text);
    assert_eq!(twofold(&["run", &scene]).status.code(), Some(2));
    let angles = succeeds(&["run", &scene, "--columns", "angles"]);
    assert!(angles.stdout.starts_with(b"t [t_c],alpha"));
    let still = refuses(&["run", &scene, "--columns", "m.n"]);
    assert!(stderr(&still).contains("`m.n`: the scene lacks"), "{}", stderr(&still));
}

#[test]
fn bad_scenes_are_refused_before_anything_is_written() {
    let files = refused_files("bad-scenes");
    files.iter().for_each(|(file, expected)| assert_refused(Path::new(file), expected));
    assert!(files.len() >= 95, "only {} bad scenes found", files.len());
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

#[test]
fn an_output_file_appears_complete_and_is_not_overwritten() {
    let folder = folder();
    let out = folder.path().join("motion.csv");
    let out = out.to_str().expect("path in UTF-8");
    let printed = succeeds(&["run", "tp-1"]);
    assert!(stderr(&printed).starts_with("note: estimated error of n, e_x and L / |L| at the end of the span: "));
    assert!(printed.stdout.starts_with(b"t [t_c],alpha [rad],beta [rad],gamma [rad],alpha_rate [rad/t_c],"));
    assert_eq!(printed.stdout.iter().filter(|&&byte| byte == b'\n').count(), 4002);

    let written = succeeds(&["run", "tp-1", "--out", out]);
    assert!(written.stdout.is_empty());
    assert_eq!(fs::read(out).expect("table"), printed.stdout);
    assert_eq!(names_in(folder.path()), ["motion.csv"]);

    let again = refuses(&["run", "tp-2", "--out", out]);
    assert!(stderr(&again).contains("exists; --force replaces it"), "{}", stderr(&again));
    assert_eq!(fs::read(out).expect("table"), printed.stdout);

    succeeds(&["run", "tp-2", "--out", out, "--force"]);
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
        let output = refuses(&["run", "tp-1", "--force", "--out", out.to_str().expect("path in UTF-8")]);
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    assert!(names_in(folder.path()).is_empty());
    let dash = refuses(&["run", "tp-1", "--out", "-"]);
    assert!(stderr(&dash).contains("is not standard output here"), "{}", stderr(&dash));
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_is_refused_before_the_computation() {
    let folder = folder();
    let link = folder.path().join("link.csv");
    std::os::unix::fs::symlink("nothing", &link).expect("link");
    let output = refuses(&["run", "tp-1", "--out", link.to_str().expect("path in UTF-8")]);
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
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n\
                [initial]\nalpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[time]\ntimes = [0.0, 1.0]\n\
                [output]\ncolumns = [\"angles\", \"e_z\"]\n";
    let (_folder, scene) = file("pole.toml", text);
    let output = succeeds(&["run", &scene]);
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
        let output = refuses(&["report", "--out", out]);
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    }
    assert_eq!(fs::read_to_string(&page).expect("file"), "mine");
    assert_eq!(names_in(Path::new(out)), ["index.html"]);
}

#[test]
fn scenes_are_listed_and_each_listed_name_runs() {
    let output = succeeds(&["scenes"]);
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
    let printed = twofold(&["scenes", "--print", "tp-2"]);
    assert_eq!((printed.status.code(), stderr(&printed).as_str()), (Some(0), ""));
    let (_folder, scene) = file("my-star.toml", &printed.stdout);
    let run = |scene: &str| twofold(&["run", scene, "--columns", "h"]).stdout;
    let table = run(&scene);
    assert!(table.starts_with(b"t [t_c],h_plus [1]") && table == run("tp-2"));
    let unknown = twofold(&["scenes", "--print", "tp-22"]);
    assert_eq!((unknown.status.code(), unknown.stdout.is_empty()), (Some(2), true));
    assert!(stderr(&unknown).contains("Did you mean `tp-2`?"), "{}", stderr(&unknown));
}

/// Columns of the command line are checked as those of the file: a span too long for them is refused with file and line.
#[test]
fn a_span_too_long_for_the_columns_asked_for_is_refused_at_its_place() {
    let text = include_str!("../../../scene/scenes/tp-1.toml").replace("span = 400", "span = 1e15");
    let (_folder, scene) = file("long.toml", &text);
    let line = 1 + text.lines().position(|line| line == "[time]").expect("the section");
    for columns in [&[][..], &["--columns", "e_z"]] {
        let output = refuses(&[&["run", &scene], columns].concat());
        let place = format!("long.toml:{line}:1: [time] asks for a rotation by ");
        assert!(stderr(&output).contains(&place), "{columns:?}: {}", stderr(&output));
    }
}

/// A table of 10 MB or more is foretold, and nearly so large.
#[test]
fn the_size_of_a_large_table_is_foretold() {
    let text = include_str!("../../../scene/scenes/tp-1.toml").replace("samples = 4001", "samples = 30001");
    let (_folder, scene) = file("scene.toml", &text);
    let output = succeeds(&["run", &scene]);
    let size = stderr(&output);
    let size = size.split("rows of ").nth(1).and_then(|rest| rest.split("about ").nth(1)).expect("a size");
    let size: f64 = size.split(" MB").next().and_then(|size| size.parse().ok()).expect("megabytes");
    let found = output.stdout.len() as f64 / 1e6;
    assert!(found >= 9.0 && (size / found - 1.0).abs() < 0.15, "{size} {found}");
    assert!(!stderr(&twofold(&["run", "tp-1"])).contains("rows of"));
}

#[test]
fn verify_prints_tables_or_json_and_refuses_an_unknown_filter() {
    let id = twofold_verify::checks::all()[0].id;
    let table = succeeds(&["verify", "--filter", id]);
    assert!(table.stderr.is_empty(), "no progress where there is no terminal: {}", stderr(&table));
    let text = String::from_utf8(table.stdout).expect("text");
    assert!(text.contains("verdict") && text.contains("all pass"), "{text}");

    let json = twofold(&["verify", "--json", "--filter", id]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert!(json.as_array().expect("array").iter().any(|check| check["id"] == id && check["passed"] == true));

    let unknown = refuses(&["verify", "--filter", "no-such-check"]);
    assert!(stderr(&unknown).contains("no check has an id that contains `no-such-check`"));
    assert!(unknown.stdout.is_empty());
}

#[test]
fn columns_of_the_command_line_replace_those_of_the_scene() {
    let output = succeeds(&["run", "tp-1", "--columns", "m.n,h"]);
    assert!(
        output.stdout.starts_with(b"t [t_c],m.n [1],m.n_rate [1/t_c],h_plus [1],h_cross [1]\n0.0,0.87328491422829")
    );
    for (columns, fragments) in [
        ("lamda", &["free: --columns: `lamda` is no group of columns", "Did you mean `lambda`?"][..]),
        ("h,h", &["`h` comes twice"]),
        ("", &["`` is no group of columns"]),
        ("perturbation", &["the scene lacks a perturbation solution", "`initial.kind`"]),
    ] {
        let output = refuses(&["run", "free", "--columns", columns]);
        has_all(&stderr(&output), fragments);
    }
}

#[test]
fn the_position_angle_is_empty_along_the_line_of_sight() {
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\n\
                alpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\n\
                chi = 0.0\nrho = 0.6\n[time]\ntimes = [0.0]\n";
    let (_folder, scene) = file("scene.toml", text);
    let output = succeeds(&["run", &scene, "--columns", "position_angle"]);
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
