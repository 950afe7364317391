//! The test binaries of the rewritten tree, or the tests of its module for Python, and how one is run with a mutant.

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
    /// Arguments before the names of tests.
    run: &'static [&'static str],
    /// Arguments by which it lists them.
    list: &'static [&'static str],
}

/// All binaries.
pub struct Suite {
    pub binaries: Vec<Binary>,
    /// Tests of one process together take about this long without a mutant (s). Most of it is the start, for Python.
    pub batch: f64,
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
        if package.tested_by.is_empty() {
            return Self::of_python(tree, package);
        }
        let mut command = Command::new("cargo");
        command.args(["test", "--no-run", "--profile", "mutants", "--message-format", "json"]);
        command.args(["--features", &package.features.join(",")]);
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
        let mut binaries = Vec::new();
        for message in built(&mut command, tree)? {
            let is_test = message["profile"]["test"] == true || message["target"]["kind"][0] == "test";
            if let (Some(path), true) = (message["executable"].as_str(), is_test) {
                let manifest = Path::new(message["manifest_path"].as_str().unwrap_or(""));
                let folder = manifest.parent().unwrap_or(tree).to_path_buf();
                let run = &["--exact", "--test-threads", "1"];
                binaries.push(Binary { path: path.into(), folder, run, list: &["--list", "--format", "terse"] });
            }
        }
        Ok(Self { binaries, batch: 0.4 })
    }

    /// Compiles the module for Python into the package beside it, for pytest by the Python of `scripts/python`. Left out are tests of the Python around the module, and
    /// slow ones of what arguments do at its border.
    fn of_python(tree: &Path, package: &Package) -> Result<Self, String> {
        let mut command = Command::new("cargo");
        command.args(["build", "--lib", "-p", package.name, "--profile", "mutants", "--message-format", "json"]);
        // Symbols of Python are found when it loads the module.
        let messages = built(command.env("PYO3_BUILD_EXTENSION_MODULE", "1"), tree)?;
        let is_module = |message: &&Value| message["target"]["name"] == "_twofold";
        let module = messages.iter().find(is_module).and_then(|message| message["filenames"][0].as_str());
        let module = module.ok_or("no module was built")?;
        std::fs::copy(module, tree.join("python/twofold/_twofold.abi3.so")).map_err(|e| format!("{module}: {e}"))?;
        let path = std::path::absolute("target/python/bin/python").map_err(|e| e.to_string())?;
        let run = &["-m", "pytest", "-q", "-x", "--tb=no", "-p", "no:cacheprovider"];
        let list = &[
            "-m",
            "pytest",
            "-q",
            "--collect-only",
            "tests/test_core.py",
            "tests/test_sweep.py",
            "tests/test_worked_pulsar.py",
        ];
        Ok(Self { binaries: vec![Binary { path, folder: tree.join("python"), run, list }], batch: 20.0 })
    }

    /// The name of a binary, without the hash of its build.
    pub fn name(&self, binary: usize) -> String {
        let name = self.binaries[binary].path.file_name().unwrap_or_default().to_string_lossy();
        name.rsplit_once('-').map_or(&*name, |(name, _)| name).to_string()
    }

    /// Names of the tests of a binary.
    pub fn names(&self, binary: usize) -> Result<Vec<String>, String> {
        let binary = &self.binaries[binary];
        let output = Command::new(&binary.path)
            .args(binary.list)
            .current_dir(&binary.folder)
            .output()
            .map_err(|e| format!("{}: {e}", binary.path.display()))?;
        let text = String::from_utf8_lossy(&output.stdout).to_string();
        Ok(text
            .lines()
            .filter_map(|line| line.strip_suffix(": test").or_else(|| line.contains("::").then_some(line)))
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
            .args(binary.run)
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

/// What cargo says of a build.
fn built(command: &mut Command, tree: &Path) -> Result<Vec<Value>, String> {
    let output = command
        .env("RUSTFLAGS", "--cap-lints=allow")
        .current_dir(tree)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("cargo: {e}"))?;
    if !output.status.success() {
        return Err("the tests do not compile".into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
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
