//! Interrupts, hang-ups and requests to terminate, each obeyed or ignored separately, as in a terminal, under `nohup` and in the
//! background of a script. The tests also pass if any of them is ignored by this process, and therefore by those it starts.

use std::fs;
use std::process::{Child, Command, Stdio};

use crate::common::{Folder, TWOFOLD, comes_to, ends, send, stderr};

const LONG: &str = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n\
                    [initial]\nalpha = 0.0\nbeta = 0.7\nalpha_rate = 1.5\nbeta_rate = 0.0\n[time]\nspan = 4e7\nsamples = 2\n";

const HUGE: &str = "scene = \"tp-2\"\nseed = 1\ndraws = 1000000000\n[time]\nend = 1.0\n[[vary]]\nparameter = \"pulsar.rho\"\n\
                    random = { distribution = \"uniform\", from = 0.4, to = 0.7 }\n";

/// Long commands that write files, and their messages when interrupted.
const COMMANDS: [(&[&str], &str); 5] = [
    (&["run", "long.toml", "--out", "out"], "error: interrupted: no file was left incomplete\n"),
    (&["figures", "--out", "out"], "error: interrupted: no file was left incomplete\n"),
    (&["report", "--out", "out"], "error: interrupted: no file was left incomplete\n"),
    (&["bench", "--quick", "--out", "out"], "error: interrupted: no file was left incomplete\n"),
    (&["sweep", "huge.toml", "--out", "out"], "scenes are in out.partial; run the same command to continue\n"),
];

/// Signals by name and number.
const SIGNALS: [(&str, u32); 3] = [("HUP", 1), ("INT", 2), ("TERM", 15)];

/// Starts the command in a shell that ignores some signals.
fn start(folder: &Folder, args: &[&str], ignoring: &str) -> Child {
    let trap = if ignoring.is_empty() { String::new() } else { format!("trap '' {ignoring}; ") };
    let mut command = Command::new("sh");
    command.args(["-c", &format!("{trap}exec \"$0\" \"$@\""), TWOFOLD]).args(args);
    command.current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("a shell")
}

/// Whether signal number `signal` is in a mask of a process.
fn has_signal(process: &str, mask: &str, signal: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{process}/status")).expect("/proc");
    let found = status.lines().find_map(|line| line.strip_prefix(mask)).expect("the mask");
    u64::from_str_radix(found.trim(), 16).expect("mask") >> (signal - 1) & 1 == 1
}

/// The files that the command has written.
fn written(folder: &Folder) -> Vec<String> {
    folder.names().into_iter().filter(|name| !name.ends_with(".toml")).collect()
}

/// Starts a command while some signals are ignored, waits for its first file, sends one signal and, if that is ignored, a request to
/// terminate.
fn ends_by(args: &[&str], message: &str, signal: &str, ignoring: &str) {
    let what = format!("{args:?}, {signal}, ignoring `{ignoring}`");
    let folder = Folder::with(&[("long.toml", LONG), ("huge.toml", HUGE)]);
    let mut child = start(&folder, args, ignoring);
    assert!(comes_to(&mut child, || !written(&folder).is_empty()), "{what}: it ended by itself");
    let process = child.id().to_string();
    let is_ignored = |name: &str, number: u32| {
        name != "TERM" && (ignoring.split(' ').any(|ignored| ignored == name) || has_signal("self", "SigIgn:", number))
    };
    // Handlers are installed before the first file appears.
    for (name, number) in SIGNALS {
        assert_eq!(has_signal(&process, "SigIgn:", number), is_ignored(name, number), "{what}: {name}");
        assert_eq!(has_signal(&process, "SigCgt:", number), !is_ignored(name, number), "{what}: {name}");
    }
    send(&child, signal);
    let number = SIGNALS.iter().find(|(name, _)| *name == signal).expect("a signal").1;
    if is_ignored(signal, number) {
        send(&child, "TERM");
    }
    let output = ends(child.wait_with_output().expect("its end"), 130);
    assert!(stderr(&output).ends_with(message), "{what}: {}", stderr(&output));
    let left = written(&folder);
    if args[0] == "sweep" {
        assert_eq!(left, ["out.partial", "out.partial.errors", "out.partial.journal"], "{what}");
    } else {
        assert!(left.is_empty(), "{what}: {left:?}");
    }
}

#[test]
fn each_signal_ends_a_command_that_leaves_nothing_incomplete() {
    for (args, message) in COMMANDS {
        for (signal, _) in SIGNALS {
            ends_by(args, message, signal, "");
        }
    }
}

/// The page is `index.html`: other pages in the folder do not matter. The command is interrupted after its start.
#[test]
fn a_report_may_stand_beside_other_pages() {
    let folder = Folder::with(&[("out/notes.html", "mine")]);
    let mut child = folder.command(&["report", "--out", "out"]).spawn().expect("starts");
    let names = || fs::read_dir(folder.at("out")).expect("folder").count();
    assert!(comes_to(&mut child, || names() > 1), "it was refused");
    send(&child, "TERM");
    ends(child.wait_with_output().expect("its end"), 130);
    assert_eq!((names(), folder.read("out/notes.html").as_str()), (1, "mine"));
}

#[test]
fn a_signal_that_is_ignored_stays_so_and_leaves_the_others_alone() {
    for (args, message) in COMMANDS {
        for (signal, ignoring) in
            [("TERM", "HUP"), ("TERM", "INT"), ("TERM", "HUP INT TERM"), ("HUP", "HUP"), ("INT", "INT"), ("INT", "HUP")]
        {
            ends_by(args, message, signal, ignoring);
        }
    }
}

/// A table on standard output leaves no file to remove; the status says that it is incomplete.
#[test]
fn a_run_to_standard_output_is_interrupted_too() {
    let folder = Folder::with(&[("long.toml", &LONG.replace("samples = 2", "samples = 2000000"))]);
    let mut run = folder.command(&["run", "long.toml", "--columns", "e_z"]);
    run.stdout(fs::File::create(folder.at("motion.csv")).expect("file"));
    let mut child = run.spawn().expect("the command starts");
    assert!(comes_to(&mut child, || folder.length("motion.csv") > 0), "it ended by itself");
    send(&child, "TERM");
    let output = ends(child.wait_with_output().expect("its end"), 130);
    assert!(stderr(&output).ends_with("error: interrupted\n"), "{}", stderr(&output));
}
