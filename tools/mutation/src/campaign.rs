//! Which tests reach which mutant, and which mutants they catch.

pub mod earlier;
pub mod failing;
mod listed;
mod record;
mod score;
mod suite;

use std::collections::HashMap;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde_json::{Value, json};

use crate::package::Package;
use suite::{Outcome, Suite, Test};

/// Runs the campaign, with `budget` seconds of tests for each mutant in the tree.
///
/// Reads `mutants.json`, keeps `coverage.json` and appends to `results.jsonl`, all in the tree; goes on where it stopped. What is listed as
/// equivalent is not run, nor what the record has as caught in a source that has not changed, but if ANEW is set.
pub fn run(tree: &Path, package: &Package, budget: f64) -> Result<(), String> {
    let mutants = lines(&tree.join("mutants.json"))?;
    // Only some tests: what they do not catch is as open as before.
    let only = std::env::var("ONLY").ok();
    let some = only.is_some() || std::env::var_os("TESTS").is_some();
    let suite = Suite::build(tree, package, only.as_deref())?;
    let tests = record::coverage(tree, &suite)?;
    let mut reaching: HashMap<u64, Vec<usize>> = HashMap::new();
    for (index, test) in tests.iter().enumerate() {
        for number in &test.reached {
            reaching.entry(*number).or_default().push(index);
        }
    }
    if std::env::var_os("ANEW").is_none() {
        earlier::begin(tree, &mutants)?;
    }
    let (equivalent, edited) = (listed::equivalent(&mutants), listed::edited(&mutants));
    let results = tree.join("results.jsonl");
    let done: HashMap<u64, f64> = lines(&results)
        .unwrap_or_default()
        .iter()
        .map(|r| (r["number"].as_u64().unwrap_or(0), settled(r, some)))
        .collect();
    let open: Vec<&Value> = mutants
        .iter()
        .filter(|m| {
            let number = m["number"].as_u64().unwrap_or(0);
            let listed = equivalent.contains(&number) || edited.contains(&number);
            !listed && done.get(&number).is_none_or(|spent| *spent < budget)
        })
        .collect();
    eprintln!("{} mutants, {} to do, {} tests", mutants.len(), open.len(), tests.len());
    let file = Mutex::new(
        fs::OpenOptions::new()
            .create(true)
            .append(true)
            .open(&results)
            .map_err(|e| format!("{}: {e}", results.display()))?,
    );
    // How often a test caught a mutant of a function: those are tried first.
    let kills = Mutex::new(earlier_kills(&results, &tests));
    let (next, missed, started) = (AtomicUsize::new(0), AtomicUsize::new(0), Instant::now());
    let workers = std::env::var("WORKERS").ok().and_then(|v| v.parse().ok()).unwrap_or(2_usize);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    let Some(mutant) = open.get(k) else { return };
                    let number = mutant["number"].as_u64().unwrap_or(0);
                    let places = places(mutant);
                    let order = ordered(reaching.get(&number), &tests, &places, &kills);
                    let begun = Instant::now();
                    let (outcome, by, complete) = judge(&suite, &tests, &order, number, budget);
                    if let Some(index) = by {
                        let mut kills = kills.lock().expect("no panic");
                        for place in places {
                            *kills.entry((place, index)).or_default() += 1;
                        }
                    } else if outcome != "caught" {
                        missed.fetch_add(1, Ordering::Relaxed);
                    }
                    if some && outcome != "caught" {
                        continue;
                    }
                    let line = json!({
                        "number": number, "outcome": outcome, "by": by.map(|k| tests[k].name.clone()),
                        "seconds": begun.elapsed().as_secs_f64(), "budget": budget, "complete": complete,
                        "tests": order.len(), "file": mutant["file"], "line": mutant["line"],
                        "function": mutant["function"], "change": mutant["change"], "code": mutant["code"],
                    });
                    writeln!(file.lock().expect("no panic"), "{line}").expect("results can be written");
                    if k % 100 == 99 {
                        let left = started.elapsed().as_secs_f64() / (k + 1) as f64 * (open.len() - k - 1) as f64;
                        eprintln!(
                            "{} of {}, {} not caught, {:.0} s to go",
                            k + 1,
                            open.len(),
                            missed.load(Ordering::Relaxed),
                            left
                        );
                    }
                }
            });
        }
    });
    score::write(tree, &mutants)
}

/// Places of a mutant that tests are remembered for: its function and its file.
fn places(mutant: &Value) -> [String; 2] {
    [format!("{}::{}", mutant["file"], mutant["function"]), mutant["file"].to_string()]
}

/// What earlier runs of the campaign caught.
fn earlier_kills(results: &Path, tests: &[Test]) -> HashMap<(String, usize), u32> {
    let mut kills = HashMap::new();
    for result in lines(results).unwrap_or_default() {
        if let Some(test) = result["by"].as_str().and_then(|name| tests.iter().position(|test| test.name == name)) {
            for place in places(&result) {
                *kills.entry((place, test)).or_default() += 1;
            }
        }
    }
    kills
}

/// Seconds of tests after which a result need not be sought again; with some tests alone, all that they may catch is sought.
fn settled(result: &Value, some_tests: bool) -> f64 {
    let open = result["outcome"] == "survived" && result["complete"] == false;
    if some_tests && result["outcome"] != "caught" {
        0.0
    } else if open {
        result["budget"].as_f64().unwrap_or(0.0)
    } else {
        f64::INFINITY
    }
}

/// Tests that reach the mutant: those that caught others near it, and the quick ones, first.
fn ordered(
    reaching: Option<&Vec<usize>>,
    tests: &[Test],
    places: &[String],
    kills: &Mutex<HashMap<(String, usize), u32>>,
) -> Vec<usize> {
    let kills = kills.lock().expect("no panic");
    let mut order = reaching.cloned().unwrap_or_default();
    let score = |k: usize| {
        let near = kills.get(&(places[0].clone(), k)).copied().unwrap_or(0) as f64;
        let far = kills.get(&(places[1].clone(), k)).copied().unwrap_or(0) as f64;
        // One that has caught nothing yet may be the one: a quick one of these goes before a slow one that caught a few.
        (near + 0.2 * far + 0.1) / (tests[k].seconds + 0.03)
    };
    order.sort_by(|a, b| score(*b).total_cmp(&score(*a)));
    order
}

/// Outcome, the test that caught it, and whether every test that reaches it was run.
fn judge(
    suite: &Suite,
    tests: &[Test],
    order: &[usize],
    number: u64,
    budget: f64,
) -> (&'static str, Option<usize>, bool) {
    if order.is_empty() {
        return ("unreached", None, true);
    }
    let (mut spent, mut at) = (0.0, 0);
    while at < order.len() {
        if spent + tests[order[at]].seconds > budget {
            return ("survived", None, false);
        }
        // One binary per process; the first two tests alone, since one of them most often catches it.
        let binary = tests[order[at]].binary;
        let mut batch = vec![order[at]];
        let mut time = tests[order[at]].seconds;
        at += 1;
        while at >= 2
            && at < order.len()
            && tests[order[at]].binary == binary
            && time + tests[order[at]].seconds < suite.batch
        {
            time += tests[order[at]].seconds;
            batch.push(order[at]);
            at += 1;
        }
        spent += time + 0.02;
        let names: Vec<&str> = batch.iter().map(|k| tests[*k].name.as_str()).collect();
        match suite.run(binary, &names, number, 5.0 + 20.0 * time) {
            Outcome::Passed => {}
            Outcome::Failed(output) => return ("caught", Some(blame(&batch, &names, &output)), true),
            Outcome::TimedOut => return ("caught", Some(batch[0]), true),
        }
    }
    ("survived", None, true)
}

/// The test of a batch that failed, as its output tells.
fn blame(batch: &[usize], names: &[&str], output: &str) -> usize {
    let failed = |name: &str| {
        output.lines().any(|line| {
            line.starts_with(&format!("{name}:"))
                || (line.contains("FAILED") && line.split_whitespace().any(|w| w == name))
        })
    };
    batch[names.iter().position(|name| failed(name)).unwrap_or(0)]
}

fn lines(path: &Path) -> Result<Vec<Value>, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    // A last line that was cut off is no result.
    Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
}
