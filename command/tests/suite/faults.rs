//! Behaviour of the command when the machine fails: a full disk, a reader that has gone, a folder that cannot be written, a kill at any
//! moment, an empty environment, names that are not text. Every outcome is defined: all or nothing under the final names.

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::process::{Command, Output, Stdio};

use crate::common::{Folder, TWOFOLD, altered, comes_to, ends, stderr};

/// Commands that write files, without their `--out`, and a size limit (bytes) at which they fail on the way.
const WRITERS: [(&[&str], u32); 9] = [
    (&["run", "s.toml"], 2),
    (&["pulses", "s.toml"], 1),
    (&["spectrum", "s.toml", "--of", "m.n", "--least", "1e-12", "--most", "1000"], 1),
    (&["fisher", "s.toml", "--observe", "arrivals:1e-4,widths:1e-4", "--parameters", "chi,rho"], 0),
    (&["timing", "p.toml", "--epochs", "9"], 1),
    (&["figures", "beam-cone"], 1),
    (&["sweep", "g.toml"], 2),
    (&["sweep", "g.toml"], 8),
    (&["forecast", "s.toml", "--observe", "strain:1e-4", "--parameters", "spin,eps", "--of=spin", "--epochs=5"], 0),
];

/// A folder with a short scene, a pulsar and a sweep.
fn scenes() -> Folder {
    let sweep = "scene = \"s.toml\"\n[[vary]]\nparameter = \"pulsar.rho\"\ngrid = { from = 0.4, to = 0.7, points = 40 }\n[time]\n\
                 times = [1.0, 2.0]\n";
    let short = altered("tp-1", &[("span = 400", "span = 40"), ("samples = 4001", "samples = 101")]);
    Folder::with(&[("s.toml", &short), ("p.toml", &altered("b1937+21", &[])), ("g.toml", sweep)])
}

/// The files that the commands wrote next to the scenes.
fn written(folder: &Folder) -> Vec<String> {
    folder.names().into_iter().filter(|name| !name.ends_with(".toml")).collect()
}

/// Runs the command in a shell, after `before`.
fn shell(folder: &Folder, before: &str, args: &[&str]) -> Output {
    let script = format!("{before}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, TWOFOLD]).args(args).current_dir(folder.path());
    command.stdout(Stdio::null()).stderr(Stdio::piped()).output().expect("a shell")
}

fn out<'a>(args: &[&'a str]) -> Vec<&'a str> {
    [args, &["--out", "out"]].concat()
}

/// A file at its size limit acts as a full disk: status 1, the file is named, and only the files remain from which a sweep
/// continues to the same bytes.
#[test]
fn a_full_disk_leaves_nothing_under_the_final_name() {
    for (args, blocks) in WRITERS {
        let folder = scenes();
        let failed = shell(&folder, &format!("ulimit -f {blocks}"), &out(args));
        let message = stderr(&failed);
        assert_eq!(failed.status.code(), Some(1), "{args:?}: {message}");
        assert!(message.contains("written: "), "{args:?}: {message}");
        assert!(message.contains("error: ") && !message.contains("panicked"), "{args:?}: {message}");
        if args[0] != "sweep" {
            assert!(written(&folder).is_empty(), "{args:?} left {:?}", written(&folder));
            continue;
        }
        assert!(!folder.at("out").exists());
        folder.succeeds(&out(args));
        assert_eq!(written(&folder), ["out"]);
        folder.succeeds(&["sweep", "g.toml", "--out", "other"]);
        assert!(folder.bytes("out") == folder.bytes("other"));
    }
}

/// Commands that print a result, and those that report what they have done.
const PRINTERS: [(&[&str], bool); 15] = [
    (&["run", "s.toml"], true),
    (&["run", "s.toml", "--explain"], true),
    (&["pulses", "s.toml"], true),
    (&["spectrum", "s.toml", "--of", "m.n"], true),
    (&["fisher", "s.toml", "--observe", "arrivals:1e-4", "--parameters", "chi"], true),
    (&["bounds"], true),
    (&["bounds", "--json"], true),
    (&["equations"], true),
    (&["scenes"], true),
    (&["scenes", "--print", "grid"], true),
    (&["figures", "--list"], true),
    (&["verify", "--filter", "steady-precession", "--json"], true),
    (&["--help"], true),
    (&["--version"], true),
    (&["verify", "--filter", "steady-precession"], false),
];

/// A full standard output is an error for every command that prints; a closed reader is not.
#[test]
fn standard_output_may_be_full_or_gone() {
    let folder = scenes();
    for (args, _) in PRINTERS {
        let full = fs::File::options().write(true).open("/dev/full").expect("/dev/full");
        let output = folder.command(args).stdout(full).output().expect("starts");
        assert_eq!(output.status.code(), Some(1), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("written: No space left"), "{args:?}: {}", stderr(&output));
        let mut child = folder.command(args).spawn().expect("starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("its end");
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", stderr(&output));
        // After the reader has gone, a note on the estimated error may follow.
        let is_clean = |line: &str| !line.starts_with("error") && !line.contains("panicked");
        assert!(stderr(&output).lines().all(is_clean), "{}", stderr(&output));
    }
    assert!(written(&folder).is_empty(), "{:?}", written(&folder));
}

/// A result printed to a closed standard output is lost: an error. The null device, a table in a file, and a command whose result is
/// its status lose nothing.
#[test]
fn a_closed_standard_output_is_an_error_where_a_result_is_lost() {
    let folder = scenes();
    for (args, is_result) in PRINTERS {
        let closed = shell(&folder, "exec >&-", args);
        assert_eq!(closed.status.code(), Some(i32::from(is_result)), "{args:?}: {}", stderr(&closed));
        let is_said = stderr(&closed).contains("error: standard output cannot be written: it is closed");
        assert_eq!(is_said, is_result, "{args:?}: {}", stderr(&closed));
        let thrown_away = shell(&folder, "exec > /dev/null", args);
        assert_eq!(thrown_away.status.code(), Some(0), "{args:?}: {}", stderr(&thrown_away));
        // A file that is also open for reading is not the null device.
        let kept = shell(&folder, "exec 1<> kept", args);
        assert_eq!(kept.status.code(), Some(0), "{args:?}: {}", stderr(&kept));
    }
    ends(shell(&folder, "exec >&-", &out(&["run", "s.toml"])), 0);
    assert_eq!(written(&folder), ["kept", "out"]);
}

/// A file in place of a folder, a system folder that accepts no file, and a folder without write permission.
#[test]
fn a_folder_that_takes_no_file_is_refused_at_once() {
    let folder = scenes();
    folder.write("file", "mine");
    let closed = folder.at("closed");
    fs::create_dir(&closed).expect("folder");
    let mode = |mode| {
        let permissions = std::os::unix::fs::PermissionsExt::from_mode(mode);
        fs::set_permissions(&closed, permissions).expect("permissions");
    };
    mode(0o555);
    // Root may write there nevertheless.
    let is_closed = fs::write(closed.join("probe"), "").is_err();
    for (args, _) in WRITERS {
        for out in ["file/out", "/proc/out", "closed/out"].into_iter().take(if is_closed { 3 } else { 2 }) {
            let output = folder.run(&[args, &["--out", out]].concat());
            assert_eq!(output.status.code(), Some(2), "{args:?} {out}: {}", stderr(&output));
            assert!(stderr(&output).contains(out), "{args:?} {out}: {}", stderr(&output));
        }
    }
    mode(0o755);
    assert_eq!(folder.read("file"), "mine");
}

/// After a kill at its start, at its first file, at the first bytes in it or when the final name appears, a command leaves complete files, files
/// marked as incomplete (`.part`, `.partial`), or nothing; run again it gives the same bytes.
#[test]
fn a_kill_at_any_moment_leaves_no_file_without_its_mark() {
    let complete = |folder: &Folder| {
        let found =
            folder.contents().into_iter().filter(|(name, _)| name.starts_with("out") && !name.contains(".part"));
        found.collect::<Vec<_>>()
    };
    let bytes = |folder: &Folder| folder.contents().iter().map(|(_, bytes)| bytes.len()).sum::<usize>();
    for args in [
        &["run", "s.toml"][..],
        &["figures", "beam-cone"],
        &["timing", "p.toml", "--epochs", "400"],
        &["sweep", "g.toml"],
    ] {
        let whole = scenes();
        whole.succeeds(&out(args));
        let expected = complete(&whole);
        let folder = scenes();
        let before = bytes(&folder);
        let signs: [&dyn Fn() -> bool; 4] =
            [&|| true, &|| !written(&folder).is_empty(), &|| bytes(&folder) > before, &|| folder.at("out").exists()];
        for sign in signs {
            let mut child = folder.command(&out(args)).spawn().expect("starts");
            comes_to(&mut child, sign);
            child.kill().expect("a signal");
            child.wait().expect("its end");
            for name in written(&folder) {
                let is_marked = name.ends_with(".part") || name.starts_with("out.partial");
                assert!(is_marked || name == "out", "{args:?} left {name}");
            }
            assert!(complete(&folder).iter().all(|file| expected.contains(file)), "{args:?}");
        }
        folder.succeeds(&[&out(args)[..], &["--force"]].concat());
        assert!(complete(&folder) == expected, "{args:?}");
    }
}

/// The command needs nothing from the environment: no HOME, no PATH, no locale.
#[test]
fn an_empty_environment_will_do() {
    let folder = scenes();
    for args in [&["run", "s.toml"][..], &["sweep", "g.toml", "--out", "table.csv"], &["figures", "beam-cone"]] {
        let bare = folder.command(args).env_clear().output().expect("starts");
        assert_eq!(bare.status.code(), Some(0), "{args:?}: {}", stderr(&bare));
        if args[0] == "run" {
            assert!(bare.stdout == folder.run(args).stdout);
        }
    }
}

/// An output may have a name that is not text; names of inputs must be UTF-8.
#[test]
fn names_that_are_no_text_are_written_to_and_not_read_from() {
    let folder = scenes();
    let name = OsStr::from_bytes(b"\xff\xfe.csv");
    let path = folder.path().join(name);
    for args in [&["run", "s.toml", "--out"][..], &["sweep", "g.toml", "--out"]] {
        let written = folder.command(args).arg(name).output().expect("starts");
        assert_eq!(written.status.code(), Some(0), "{args:?}: {}", stderr(&written));
        assert!(fs::metadata(&path).is_ok_and(|found| found.len() > 1000));
        fs::remove_file(&path).expect("file");
    }
    fs::copy(folder.at("s.toml"), &path).expect("file");
    for args in [&["run"][..], &["sweep", "--out", "out"], &["bounds"], &["fit", "s.toml", "--observe", "widths:1"]] {
        let refused = folder.command(args).arg(name).output().expect("starts");
        assert_eq!(refused.status.code(), Some(2), "{args:?}: {}", stderr(&refused));
        assert!(stderr(&refused).contains("invalid UTF-8"), "{args:?}: {}", stderr(&refused));
    }
}

/// Tables that are much too wide, too long or endless are refused with the allowed size.
#[test]
fn tables_beyond_the_bounds_are_refused() {
    let folder = scenes();
    let header = "t [t_c],h_plus [1],h_cross [1]\n";
    folder.write("wide.csv", "x,".repeat(200_000) + "x\n");
    folder.write("long.csv", header.to_owned() + &"1,2,3\n".repeat(100_001));
    folder.write("bytes.csv", [header.as_bytes(), b"1,\xff,3\n"].concat());
    for (name, why) in [
        ("wide.csv", "or `t` of strains; found x, x, "),
        ("wide.csv", "and 199971 more"),
        ("long.csv", "long.csv:100002: too many rows; a file can have at most 100000"),
        ("bytes.csv", "bytes.csv: is not UTF-8 text (byte 34, line "),
        ("/dev/zero", "/dev/zero: is larger than 64 MiB, the largest file that is read"),
    ] {
        let fit = ["fit", "s.toml", name, "--observe", "strain:1e-3", "--parameters", "eps"];
        let output = ends(folder.run(&fit), 2);
        assert!(stderr(&output).contains(why) && stderr(&output).len() < 1000, "{name}: {}", stderr(&output));
    }
}
