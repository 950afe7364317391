//! Each test without a mutant: how long it takes and what it reaches.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde_json::{Value, json};

use super::suite::{self, Suite, Test};

/// Time for one test, without a mutant (s).
const LONGEST: f64 = 90.0;

/// Tests that pass without a mutant; kept in `coverage.json`, to which new ones are added: those whose name has one of the words in TESTS, if it is set.
pub fn coverage(tree: &Path, suite: &Suite) -> Result<Vec<Test>, String> {
    let file = tree.join("coverage.json");
    let written = fs::read_to_string(&file).unwrap_or_default();
    let known: Vec<Test> =
        written.lines().filter_map(|line| read(line, suite).transpose()).collect::<Result<_, _>>()?;
    let mut all = Vec::new();
    let words = std::env::var("TESTS").unwrap_or_default();
    let wanted = |name: &str| words.is_empty() || words.split_whitespace().any(|word| name.contains(word));
    for binary in 0..suite.binaries.len() {
        let is_new = |name: &String| known.iter().all(|test| test.binary != binary || test.name != *name);
        let names = suite.names(binary)?.into_iter().filter(|name| wanted(name)).filter(is_new);
        all.extend(names.map(|name| (binary, name)));
    }
    let (next, tests) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for worker in 0..2 {
            let (next, tests, all) = (&next, &tests, &all);
            scope.spawn(move || {
                let reached = tree.join(format!("reached-{worker}.txt"));
                while let Some((binary, name)) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let _ = fs::remove_file(&reached);
                    let quiet = |command: &mut Command| {
                        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
                        suite::ended(child.expect("a process can be started"), LONGEST)
                    };
                    // Once for the time, once more slowly for what is reached; of a test that is stopped then, what it reached so far.
                    let started = Instant::now();
                    let passed = quiet(&mut suite.command(*binary, &[name])).is_some_and(|status| status.success());
                    let seconds = started.elapsed().as_secs_f64();
                    if passed {
                        quiet(suite.command(*binary, &[name]).env("REACHED", &reached));
                    }
                    let text = fs::read_to_string(&reached).unwrap_or_default();
                    let mut numbers: Vec<u64> = text.lines().filter_map(|l| l.parse().ok()).collect();
                    numbers.sort_unstable();
                    numbers.dedup();
                    if passed {
                        let test = Test { binary: *binary, name: name.clone(), seconds, reached: numbers };
                        tests.lock().expect("no panic").push(test);
                    } else {
                        eprintln!("fails or takes too much without a mutant, left out: {name}");
                    }
                }
                let _ = fs::remove_file(&reached);
            });
        }
    });
    let tests: Vec<Test> = known.into_iter().chain(tests.into_inner().expect("no panic")).collect();
    let others = written.lines().filter(|line| matches!(read(line, suite), Ok(None))).map(str::to_string);
    let text: Vec<String> = tests
        .iter()
        .map(|t| {
            let path = suite.binaries[t.binary].path.to_string_lossy();
            json!({"binary": path, "name": t.name, "seconds": t.seconds, "reached": t.reached}).to_string()
        })
        .chain(others)
        .collect();
    fs::write(&file, text.join("\n") + "\n").map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(tests)
}

/// None for a binary that is not built any more.
fn read(line: &str, suite: &Suite) -> Result<Option<Test>, String> {
    let value: Value = serde_json::from_str(line).map_err(|e| format!("coverage.json: {e}"))?;
    let path = Path::new(value["binary"].as_str().unwrap_or(""));
    let Some(binary) = suite.binaries.iter().position(|b| b.path == path) else { return Ok(None) };
    Ok(Some(Test {
        binary,
        name: value["name"].as_str().unwrap_or("").to_string(),
        seconds: value["seconds"].as_f64().unwrap_or(1.0),
        reached: value["reached"].as_array().map(|a| a.iter().filter_map(Value::as_u64).collect()).unwrap_or_default(),
    }))
}
