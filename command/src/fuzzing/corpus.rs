//! Replays inputs found by fuzzing, each once, in the fuzzed functions: those that extend coverage and those that once failed.

use std::env;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use super::TARGETS;

/// Set in the process that runs the inputs of one target.
const TARGET: &str = "TWOFOLD_FUZZ_TARGET";

/// A line of a corpus is a JSON string, one character for each byte.
fn inputs(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tools/fuzz/corpus");
    let lines = |name: String, is_needed: bool| match fs::read_to_string(folder.join(&name)) {
        Ok(text) => text.lines().map(str::to_owned).collect(),
        Err(error) if is_needed => panic!("{name}: {error}"),
        Err(_) => Vec::new(),
    };
    let mut all: Vec<String> = lines(format!("{target}.jsonl"), true);
    all.extend(lines(format!("{target}.fixed.jsonl"), false));
    all.sort_unstable();
    all.dedup();
    let bytes = |line: &String| {
        let text: String = serde_json::from_str(line).expect("a JSON string");
        text.chars().map(|byte| u8::try_from(byte).expect("a byte")).collect()
    };
    all.iter().map(bytes).collect()
}

#[test]
fn every_input_is_used_or_refused() {
    if let Ok(target) = env::var(TARGET) {
        return try_all(&target);
    }
    let program = env::current_exe().expect("a path");
    // One process per target: the command line prints, and changes its folder.
    let start = |(target, _): &(&'static str, _)| {
        let mut command = Command::new(&program);
        command.args(["--exact", "fuzzing::corpus::every_input_is_used_or_refused", "--nocapture"]).env(TARGET, target);
        (*target, command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a process"))
    };
    for (target, child) in TARGETS.iter().map(start).collect::<Vec<_>>() {
        let output = child.wait_with_output().expect("its end");
        let message = String::from_utf8_lossy(&output.stderr);
        let end: Vec<_> = message.lines().rev().take(20).collect();
        assert!(output.status.success(), "{target}: {}", end.into_iter().rev().collect::<Vec<_>>().join("\n"));
        // A name that matches no test does not fail the process.
        assert!(String::from_utf8_lossy(&output.stdout).contains("1 passed"), "{target}: the test was not run");
    }
}

fn try_all(target: &str) {
    let (_, function) = TARGETS.iter().find(|(name, _)| *name == target).expect("a target");
    for input in inputs(target) {
        let shown = input.escape_ascii().to_string();
        // Printed first, for panics that hang.
        eprintln!("{shown}");
        function(&input);
    }
}
