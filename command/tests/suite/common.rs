//! The command as a user meets it, for the tests of its parts.
#![allow(dead_code, reason = "no test uses everything")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::thread::sleep;
use std::time::Duration;

use tempfile::{TempDir, tempdir};

/// Runs the command to its end.
pub fn twofold(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_twofold")).args(args).output().expect("the command starts")
}

/// Runs the command, which succeeds.
pub fn succeeds(args: &[&str]) -> Output {
    let output = twofold(args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", stderr(&output));
    output
}

/// Runs the command, which refuses its input: status 2 and nothing on standard output.
pub fn refuses(args: &[&str]) -> Output {
    let output = twofold(args);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{args:?}: something on standard output");
    output
}

/// A command that ended with this status.
#[track_caller]
pub fn ends(output: Output, status: i32) -> Output {
    assert_eq!(output.status.code(), Some(status), "{}", stderr(&output));
    output
}

/// A text with all of these in it.
#[track_caller]
pub fn has_all(text: &str, fragments: &[impl AsRef<str>]) {
    for fragment in fragments.iter().map(AsRef::as_ref) {
        assert!(text.contains(fragment), "expected `{fragment}` in\n{text}");
    }
}

/// A command that refused its input: status 2, nothing on standard output, one message with all of these in it.
#[track_caller]
pub fn is_refused(output: &Output, fragments: &[impl AsRef<str>]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(output.stdout.is_empty(), "something on standard output beside {message}");
    assert!(message.starts_with("error: ") && message.matches("error: ").count() == 1, "{message}");
    assert!(!message.contains("panicked"), "{message}");
    has_all(&message, fragments);
}

/// A file with a text in a folder that is removed at the end, and its path.
pub fn file(name: &str, text: impl AsRef<[u8]>) -> (TempDir, String) {
    let folder = folder();
    let path = folder.path().join(name);
    fs::write(&path, text).expect("a file");
    let path = path.to_str().expect("a path in UTF-8").to_owned();
    (folder, path)
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error as text, without the lines that come after some time, as on a busy machine.
pub fn stderr(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let is_progress = |line: &str| line.starts_with("note: ") && line.contains(" % done");
    text.split_inclusive('\n').filter(|line| !is_progress(line)).collect()
}

/// Looks again and again until the sign is there; false if the process ends before.
pub fn comes_to(child: &mut Child, mut sign: impl FnMut() -> bool) -> bool {
    while !sign() {
        if child.try_wait().expect("its state").is_some() {
            return sign();
        }
        // Leaves the processor to others between two looks.
        sleep(Duration::from_millis(1));
    }
    true
}

/// Sends the signal of a name, as `TERM`.
#[cfg(unix)]
pub fn send(child: &Child, signal: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -s {signal} {}", child.id())]).status().expect("kill");
    assert!(sent.success(), "{signal}");
}

/// A folder that is removed at the end.
pub fn folder() -> TempDir {
    tempdir().expect("a temporary folder")
}

/// The names of what is in a folder, in order.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
