//! The test binaries of the rewritten tree, and how one is run with a mutant.

use std::io::Read;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::package::Package;

/// A test with what it reaches.
pub struct Test {
    pub binary: usize,
    pub name: String,
    /// How long it takes without a mutant (s).
    pub seconds: f64,
    /// Mutants that it reaches.
    pub reached: Vec<u64>,
}

/// A binary of tests with the folder it is run in.
pub struct Binary {
    pub path: PathBuf,
    pub folder: PathBuf,
}

/// All binaries.
pub struct Suite {
    pub binaries: Vec<Binary>,
}

/// How a run ended; of one that failed, its output.
pub enum Outcome {
    Passed,
    Failed(String),
    TimedOut,
}

/// No mutant may take more memory than this (KiB).
const MEMORY: u64 = 4_000_000;

impl Suite {
    /// Compiles the tests that reach the package; of the binaries, those with the names `only` (`lib`: the tests within the sources).
    pub fn build(tree: &Path, package: &Package, only: Option<&str>) -> Result<Self, String> {
        let mut command = Command::new("cargo");
        command.args(["test", "--no-run", "--profile", "mutants", "--message-format", "json"]);
        match only {
            None => {
                command.args(["--lib", "--tests"]);
            }
            Some(names) => names.split_whitespace().for_each(|name| {
                let which: &[&str] = if name == "lib" { &["--lib"] } else { &["--test", name] };
                command.args(which);
            }),
        }
        package.tested_by.iter().for_each(|name| {
            command.args(["-p", name]);
        });
        let output = command
            .env("RUSTFLAGS", "--cap-lints=allow")
            .current_dir(tree)
            .stderr(Stdio::inherit())
            .output()
            .map_err(|e| format!("cargo: {e}"))?;
        if !output.status.success() {
            return Err("the tests do not compile".into());
        }
        let mut binaries = Vec::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
            let is_test = message["profile"]["test"] == true || message["target"]["kind"][0] == "test";
            if let (Some(path), true) = (message["executable"].as_str(), is_test) {
                let manifest = Path::new(message["manifest_path"].as_str().unwrap_or(""));
                let folder = manifest.parent().unwrap_or(tree).to_path_buf();
                binaries.push(Binary { path: path.into(), folder });
            }
        }
        Ok(Self { binaries })
    }

    /// Names of the tests of a binary.
    pub fn names(&self, binary: usize) -> Result<Vec<String>, String> {
        let binary = &self.binaries[binary];
        let output = Command::new(&binary.path)
            .args(["--list", "--format", "terse"])
            .current_dir(&binary.folder)
            .output()
            .map_err(|e| format!("{}: {e}", binary.path.display()))?;
        let text = String::from_utf8_lossy(&output.stdout).to_string();
        Ok(text
            .lines()
            .filter_map(|line| line.strip_suffix(": test"))
            .map(|n| n.rsplit("] ").next().unwrap_or(n).to_string())
            .collect())
    }

    /// The command for tests of a binary, in a process group of its own: what it starts can be ended with it.
    pub fn command(&self, binary: usize, names: &[&str]) -> Command {
        let binary = &self.binaries[binary];
        let mut command = Command::new("sh");
        command
            .arg("-c")
            .arg(format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\""))
            .arg(&binary.path)
            .args(["--exact", "--test-threads", "1"])
            .args(names)
            .current_dir(&binary.folder)
            .env("FAIL_FAST", "1")
            .env("INSTA_UPDATE", "no")
            .env("RUST_BACKTRACE", "0")
            .env("PROPTEST_FAILURE_PERSISTENCE", "off")
            .stdin(Stdio::null())
            .process_group(0);
        command
    }

    /// Runs tests with a mutant.
    pub fn run(&self, binary: usize, names: &[&str], mutant: u64, limit: f64) -> Outcome {
        let mut child = self
            .command(binary, names)
            .env("MUTANT", mutant.to_string())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a process can be started");
        let readers = [
            child.stdout.take().map(|mut s| std::thread::spawn(move || text_of(&mut s))),
            child.stderr.take().map(|mut s| std::thread::spawn(move || text_of(&mut s))),
        ];
        let status = ended(child, limit);
        let output: String = readers.into_iter().flatten().map(|r| r.join().unwrap_or_default()).collect();
        match status {
            None => Outcome::TimedOut,
            Some(status) if status.success() => Outcome::Passed,
            Some(_) => Outcome::Failed(output),
        }
    }
}

/// How the leader of a process group ended; none if it had to be stopped. What it has started ends with it: a mutant that runs for ever would
/// keep a core busy, and the pipe of its output open.
pub fn ended(mut child: Child, limit: f64) -> Option<ExitStatus> {
    let started = Instant::now();
    loop {
        let status = child.try_wait().expect("the child is ours");
        if status.is_some() || started.elapsed().as_secs_f64() > limit {
            let group = format!("-{}", child.id());
            let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
            let _ = child.wait();
            return status;
        }
        std::thread::sleep(Duration::from_millis(3));
    }
}

fn text_of(stream: &mut impl Read) -> String {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).to_string()
}
