//! The command as a user sees it, for the tests of its parts.
#![allow(dead_code, reason = "no test uses everything")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::{TempDir, tempdir};
use twofold_scene::scene_file::built_in;

/// The program.
pub const TWOFOLD: &str = env!("CARGO_BIN_EXE_twofold");

/// Runs the command to its end.
pub fn twofold(args: &[&str]) -> Output {
    Command::new(TWOFOLD).args(args).output().expect("the command starts")
}

/// Runs the command and requires success.
#[track_caller]
pub fn succeeds(args: &[&str]) -> Output {
    ends(twofold(args), 0)
}

/// Requires this exit status.
#[track_caller]
pub fn ends(output: Output, status: i32) -> Output {
    assert_eq!(output.status.code(), Some(status), "{}", stderr(&output));
    output
}

/// Requires all fragments in a text.
#[track_caller]
pub fn has_all(text: &str, fragments: &[impl AsRef<str>]) {
    for fragment in fragments.iter().map(AsRef::as_ref) {
        assert!(text.contains(fragment), "expected `{fragment}` in\n{text}");
    }
}

/// Requires a refusal: status 2, nothing on standard output, one message with all fragments.
#[track_caller]
pub fn is_refused(output: &Output, fragments: &[impl AsRef<str>]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(output.stdout.is_empty(), "something on standard output beside {message}");
    assert!(message.starts_with("error: ") && message.matches("error: ").count() == 1, "{message}");
    assert!(!message.contains("panicked"), "{message}");
    has_all(&message, fragments);
}

/// The number that follows a phrase in a text.
#[track_caller]
pub fn number_after(text: &str, phrase: &str) -> f64 {
    let rest = text.split(phrase).nth(1).unwrap_or_else(|| panic!("`{phrase}` in {text}"));
    let number = rest.split_whitespace().next().expect("a word");
    number.trim_end_matches([',', ';']).parse().unwrap_or_else(|why| panic!("{number}: {why}"))
}

/// A temporary folder for commands.
pub struct Folder(TempDir);

impl Folder {
    /// An empty folder.
    pub fn new() -> Self {
        Self(tempdir().expect("a temporary folder"))
    }

    /// A folder with some files.
    pub fn with(files: &[(&str, &str)]) -> Self {
        let place = Self::new();
        files.iter().for_each(|(name, text)| place.write(name, text));
        place
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// The path of a file.
    pub fn at(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    /// Writes a file and creates the folders for it.
    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let path = self.at(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// The bytes of a file.
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The text of a file.
    pub fn read(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).expect("a text")
    }

    /// The length of a file, zero if it is not there.
    pub fn length(&self, name: &str) -> u64 {
        fs::metadata(self.at(name)).map_or(0, |found| found.len())
    }

    /// The names in the folder, in order.
    pub fn names(&self) -> Vec<String> {
        names_in(self.path())
    }

    /// Names and bytes of all files, and names of all folders.
    pub fn contents(&self) -> Vec<(String, Vec<u8>)> {
        let (mut found, mut folders) = (Vec::new(), vec![self.path().to_owned()]);
        while let Some(folder) = folders.pop() {
            for path in names_in(&folder).iter().map(|name| folder.join(name)) {
                let name = path.strip_prefix(self.path()).expect("in it").display().to_string();
                // A file may be gone already.
                let (is_folder, bytes) = (path.is_dir(), fs::read(&path));
                if is_folder || bytes.is_ok() {
                    found.push((name, bytes.unwrap_or_default()));
                }
                folders.extend(is_folder.then_some(path));
            }
        }
        found
    }

    /// The command, started in the folder.
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(TWOFOLD);
        command.args(args).current_dir(self.path()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs the command in the folder to its end.
    pub fn run(&self, args: &[&str]) -> Output {
        self.command(args).output().expect("the command starts")
    }

    /// Runs it and requires success.
    #[track_caller]
    pub fn succeeds(&self, args: &[&str]) -> Output {
        ends(self.run(args), 0)
    }
}

/// A built-in scene with replaced texts.
#[track_caller]
pub fn altered(name: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(built_in(name).expect("a scene").toml.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "no `{from}` in {name}");
        text.replace(from, to)
    })
}

/// A built-in scene in which lines with the given beginnings are replaced.
pub fn with_lines(name: &str, lines: &[(&str, &str)]) -> String {
    let text = built_in(name).expect("a scene").toml;
    let other = |line| lines.iter().find(|(start, _)| str::starts_with(line, start)).map_or(line, |(_, other)| *other);
    text.lines().map(|line| other(line).to_owned() + "\n").collect()
}

/// The columns of a table, as texts.
pub fn cells(table: &str) -> Vec<Vec<&str>> {
    table.lines().map(|line| line.split(',').collect()).collect()
}

/// The numbers of a table after its header; empty fields are NaN.
pub fn numbers(table: &str) -> Vec<Vec<f64>> {
    let number = |text: &str| if text.is_empty() { f64::NAN } else { text.parse().expect("a number") };
    table.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error as text, without the lines that appear after some time, as on a busy machine.
pub fn stderr(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let is_progress = |line: &str| line.starts_with("note: ") && line.contains(" % done");
    text.split_inclusive('\n').filter(|line| !is_progress(line)).collect()
}

/// Waits until the sign appears; false if the process ends before.
pub fn comes_to(child: &mut Child, mut sign: impl FnMut() -> bool) -> bool {
    while !sign() {
        if child.try_wait().expect("its state").is_some() {
            return sign();
        }
        // Yields the processor between two checks.
        sleep(Duration::from_millis(1));
    }
    true
}

/// Sends a signal by its name, such as `TERM`.
#[cfg(unix)]
pub fn send(child: &Child, signal: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -s {signal} {}", child.id())]).status().expect("kill");
    assert!(sent.success(), "{signal}");
}

/// The names in a folder, in order.
pub fn names_in(folder: &Path) -> Vec<String> {
    // A running command may remove a folder.
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
