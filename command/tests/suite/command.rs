//! The command `twofold` as a user sees it: status, messages, files.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Folder, TWOFOLD, altered, ends, is_refused, number_after, stderr, stdout, succeeds, twofold};
use twofold_verify::refused_files::refused_files;

/// The scene is refused, and no file remains.
fn assert_refused(scene: &Path, fragments: &[impl AsRef<str>]) {
    let folder = Folder::new();
    let scene = scene.to_str().expect("path in UTF-8");
    for extra in [&["--out", "motion.csv"][..], &[]] {
        is_refused(&folder.run(&[&["run", scene], extra].concat()), fragments);
        assert!(folder.names().is_empty(), "{scene}: left {:?}", folder.names());
    }
}

#[test]
fn bad_scenes_are_refused_before_anything_is_written() {
    let files = refused_files("bad-scenes");
    files.iter().for_each(|(file, expected)| assert_refused(Path::new(file), expected));
    assert!(files.len() >= 95, "only {} bad scenes found", files.len());
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = Folder::new();
    assert_refused(folder.path(), &["is a directory"]);
    assert_refused(Path::new("tp-11"), &["neither a built-in scene nor a readable file", "did you mean `tp-1`?"]);
    assert_refused(Path::new("TP-1"), &["did you mean `tp-1`?"]);
    assert_refused(&folder.at("none.toml"), &["the built-in scenes are `tp-1`, `tp-2`"]);
    let file = |name: &str, bytes: &[u8]| {
        folder.write(name, bytes);
        folder.at(name)
    };
    assert_refused(&file("latin-1.toml", b"about = \"\xe9toile\"\n"), &["is not UTF-8 text (byte 10, line 1)"]);
    assert_refused(&file("empty.toml", b""), &["missing section [star]"]);
    assert_refused(&file("zeros.toml", &[0; 100]), &["not TOML"]);
    assert_refused(&file("escape.toml", b"\"\\u001b[31mred\" = 1\n"), &["unknown key `\u{fffd}[31mred`"]);
    assert_refused(&file("raw-escape.toml", b"a = \"\x1b[31m\"\n"), &["1 | a = \"\u{fffd}[31m\""]);
    assert_refused(&file("deep.toml", format!("a = {}", "[".repeat(100_000)).as_bytes()), &["not TOML"]);
}

#[cfg(target_os = "linux")]
#[test]
fn an_endless_file_is_not_read_to_the_end() {
    assert_refused(Path::new("/dev/zero"), &["is larger than 64 MiB"]);
}

#[test]
fn an_output_file_appears_complete_and_is_not_overwritten() {
    let folder = Folder::new();
    let printed = succeeds(&["run", "tp-1"]);
    assert!(stderr(&printed).starts_with("note: estimated error of n, e_x and L / |L| at the end of the span: "));
    assert!(printed.stdout.starts_with(b"t [t_c],alpha [rad],beta [rad],gamma [rad],alpha_rate [rad/t_c],"));
    assert_eq!(stdout(&printed).lines().count(), 4002);

    let out = ["--out", "motion.csv"];
    assert!(folder.succeeds(&[&["run", "tp-1"], &out[..]].concat()).stdout.is_empty());
    assert_eq!((folder.bytes("motion.csv"), folder.names()), (printed.stdout.clone(), vec!["motion.csv".to_owned()]));

    is_refused(&folder.run(&[&["run", "tp-2"], &out[..]].concat()), &["exists; --force replaces it"]);
    assert_eq!(folder.bytes("motion.csv"), printed.stdout);

    folder.succeeds(&[&["run", "tp-2", "--force"], &out[..]].concat());
    assert_ne!(folder.bytes("motion.csv"), printed.stdout);
    assert_eq!(folder.names(), ["motion.csv"]);
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_is_refused_before_the_computation() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("nothing", folder.at("link.csv")).expect("link");
    is_refused(&folder.run(&["run", "tp-1", "--out", "link.csv"]), &["is a broken link"]);
    assert_eq!(folder.names(), ["link.csv"]);
}

#[test]
fn a_reader_that_goes_away_ends_the_command_quietly() {
    let folder = Folder::new();
    let mut child = folder.command(&["run", "tp-1"]).spawn().expect("the command starts");
    drop(child.stdout.take());
    assert_eq!(stderr(&ends(child.wait_with_output().expect("its end"), 0)), "");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = || fs::File::options().write(true).open("/dev/full").expect("/dev/full");
    for args in [&["run", "tp-1"][..], &["scenes"]] {
        let output = Command::new(TWOFOLD).args(args).stdout(full()).output().expect("starts");
        assert_eq!(output.status.code(), Some(1), "{args:?}");
        assert!(stderr(&output).contains("cannot be written") || stderr(&output).contains("could not be written"));
    }
}

#[test]
fn a_pole_leaves_fields_empty_and_says_so() {
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n\
                [initial]\nalpha = 0.0\nbeta = 0.0\nalpha_rate = 0.0\nbeta_rate = 0.0\n[time]\ntimes = [0.0, 1.0]\n\
                [output]\ncolumns = [\"angles\", \"e_z\"]\n";
    let output = Folder::with(&[("pole.toml", text)]).succeeds(&["run", "pole.toml"]);
    let table = stdout(&output);
    assert_eq!(table.lines().nth(1), Some("0.0,,,,0.0,0.0,1.0"), "{table}");
    assert!(stderr(&output).contains("on a pole in 2 of 2 rows, first at t = 0.0 t_c"), "{}", stderr(&output));
}

#[test]
fn scenes_are_listed_and_each_listed_name_runs() {
    let text = stdout(&succeeds(&["scenes"]));
    let (scenes, sweeps) = text.split_once("\nSweeps").expect("both kinds");
    let names = |list: &str| -> Vec<String> {
        list.lines().filter_map(|line| Some(line.strip_prefix("  ")?.split("  ").next()?.to_owned())).collect()
    };
    assert_eq!((names(scenes).len(), names(sweeps)), (17, vec!["grid".to_owned()]), "{text}");
    for name in names(scenes) {
        assert_eq!(twofold(&["run", &name]).status.code(), Some(0), "{name}");
    }
}

/// The printed file of a built-in scene is that scene.
#[test]
fn a_printed_scene_is_a_template() {
    let printed = twofold(&["scenes", "--print", "tp-2"]);
    assert_eq!((printed.status.code(), stderr(&printed).as_str()), (Some(0), ""));
    let folder = Folder::with(&[("my-star.toml", &stdout(&printed))]);
    let run = |scene: &str| folder.run(&["run", scene, "--columns", "h"]).stdout;
    let table = run("my-star.toml");
    assert!(table.starts_with(b"t [t_c],h_plus [1]") && table == run("tp-2"));
}

/// A table of 10 MB or more is announced with about its size.
#[test]
fn the_size_of_a_large_table_is_foretold() {
    let folder = Folder::with(&[("scene.toml", &altered("tp-1", &[("samples = 4001", "samples = 30001")]))]);
    let output = folder.succeeds(&["run", "scene.toml"]);
    let told = stderr(&output);
    assert!(told.contains("note: the table will have 30001 rows of ") && told.contains(" MB"), "{told}");
    let size = number_after(&told, " columns, about ");
    let found = output.stdout.len() as f64 / 1e6;
    assert!(found >= 9.0 && (size / found - 1.0).abs() < 0.15, "{size} {found}");
    assert!(!stderr(&twofold(&["run", "tp-1"])).contains("rows of"));
}

#[test]
fn verify_prints_tables_or_json() {
    let id = twofold_verify::checks::all()[0].id;
    let table = succeeds(&["verify", "--filter", id]);
    assert!(table.stderr.is_empty(), "no progress where there is no terminal: {}", stderr(&table));
    let text = stdout(&table);
    assert!(text.contains("verdict") && text.contains("all pass"), "{text}");

    let json = twofold(&["verify", "--json", "--filter", id]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert!(json.as_array().expect("array").iter().any(|check| check["id"] == id && check["passed"] == true));
}

/// The form of the commands in the README.
#[cfg(unix)]
const PREFIX: &str = "cargo run --release -- ";

/// Every command succeeds, one after the other in an empty folder: each finds the files that it names. For the slowest ones, the full
/// report, all figures and the timings, only the help is requested; `signals.rs` starts them.
#[cfg(unix)]
#[test]
fn the_commands_of_the_readme_work() {
    let readme = include_str!("../../../README.md");
    let folder = Folder::new();
    let blocks = readme.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let commands: Vec<_> = blocks.flat_map(str::lines).filter_map(|line| line.strip_prefix(PREFIX)).collect();
    assert!(commands.len() >= 15, "{commands:?}");
    for command in commands {
        let arguments = command.split(" #").next().unwrap_or(command).trim();
        let is_long = ["report", "figures", "bench"].iter().any(|long| arguments.starts_with(long));
        let help = if is_long { " --help" } else { "" };
        let script = format!("\"$0\" {arguments}{help}");
        let output =
            Command::new("sh").args(["-c", &script]).arg(TWOFOLD).current_dir(folder.path()).output().expect("a shell");
        assert_eq!(output.status.code(), Some(0), "{arguments}: {}", stderr(&output));
    }
}

/// The file that a link points to is replaced, not the link.
#[cfg(unix)]
#[test]
fn a_link_is_followed() {
    let folder = Folder::with(&[("there.csv", "old")]);
    std::os::unix::fs::symlink("there.csv", folder.at("link.csv")).expect("a link");
    folder.succeeds(&["run", "tp-1", "--columns", "e_z", "--out", "link.csv", "--force"]);
    assert!(folder.at("link.csv").is_symlink());
    assert!(folder.read("there.csv").starts_with("t [t_c],e_z_X"));
}

/// The help has the units and the defaults that other tests find in the numbers.
#[test]
fn help_states_units_and_defaults() {
    for (command, text) in [
        ("fisher", "standard deviation of its independent errors in the scene's unit"),
        ("timing", "from the first epoch on; 64 turns if not given"),
    ] {
        let help = stdout(&succeeds(&[command, "--help"]));
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(text), "{words}");
    }
}
