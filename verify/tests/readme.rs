//! The commands of the README, as they stand there.
#![cfg(unix)]

mod common;

use std::path::Path;
use std::process::Command;

use common::{folder, stderr};

/// What the README shows the commands with.
const PREFIX: &str = "cargo run --release -- ";

/// One after the other in an empty folder, every command succeeds: each finds the files that it names. Those that take longest, the whole
/// report and the timings, are only asked for their help; `tests/signals.rs` starts them.
#[test]
fn the_commands_of_the_readme_work() {
    let readme = include_str!("../../README.md");
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
