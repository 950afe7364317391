//! Which tests can fail: each is run with mutants that it reaches until one makes it fail.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde_json::{Value, json};

use super::suite::{Outcome, Suite, Test};
use super::{lines, listed, record};
use crate::package::Package;

/// What is known of a test, from the least to the most.
const VERDICTS: [&str; 4] = ["reaches no mutant", "never failed", "failed without a figure", "failed"];

/// Runs each test with mutants, first those that few tests reach, until it fails or `budget` seconds are spent.
///
/// A mutant can make a check fail before it measures anything: the model refuses the input, or panics. That is kept, but the search for a figure
/// beyond the bound goes on. Keeps the verdicts in `tests.jsonl` of the tree, prints the tests that did not fail, and goes on where it stopped.
pub fn run(tree: &Path, package: &Package, budget: f64) -> Result<(), String> {
    let mutants = lines(&tree.join("mutants.json"))?;
    let suite = Suite::build(tree, package, std::env::var("ONLY").ok().as_deref())?;
    let tests = record::coverage(tree, &suite)?;
    let equivalent = listed::equivalent(&mutants);
    let by_number: HashMap<u64, &Value> =
        mutants.iter().map(|mutant| (mutant["number"].as_u64().unwrap_or(0), mutant)).collect();
    let mut reached_by: HashMap<u64, usize> = HashMap::new();
    tests.iter().flat_map(|test| &test.reached).for_each(|number| *reached_by.entry(*number).or_default() += 1);

    let verdicts = tree.join("tests.jsonl");
    let done = lines(&verdicts).unwrap_or_default();
    let is_done = |test: &Test| {
        let of_test = |line: &&Value| line["test"] == test.name.as_str() && line["binary"] == suite.name(test.binary);
        done.iter().rfind(of_test).is_some_and(|line| {
            line["verdict"] == VERDICTS[3] || line["budget"].as_f64().is_some_and(|spent| spent >= budget)
        })
    };
    let open: Vec<&Test> = tests.iter().filter(|test| !is_done(test)).collect();
    eprintln!("{} tests, {} to do", tests.len(), open.len());

    let file = fs::OpenOptions::new().create(true).append(true).open(&verdicts);
    let file = Mutex::new(file.map_err(|e| format!("{}: {e}", verdicts.display()))?);
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    let Some(test) = open.get(k) else { return };
                    let order = in_order(test, &reached_by, &equivalent);
                    let found = search(&suite, test, &order, budget);
                    let by = found.by.and_then(|number| by_number.get(&number)).map(|mutant| {
                        format!(
                            "{}:{} {}",
                            mutant["file"].as_str().unwrap_or(""),
                            mutant["line"],
                            mutant["change"].as_str().unwrap_or("")
                        )
                    });
                    let line = json!({
                        "binary": suite.name(test.binary), "test": test.name, "verdict": VERDICTS[found.verdict],
                        "by": by, "tried": found.tried, "reached": order.len(), "budget": budget,
                    });
                    writeln!(file.lock().expect("no panic"), "{line}").expect("verdicts can be written");
                    if k % 50 == 49 {
                        eprintln!("{} of {}", k + 1, open.len());
                    }
                }
            });
        }
    });
    report(&lines(&verdicts)?);
    Ok(())
}

/// What a search found.
struct Found {
    /// A place in [`VERDICTS`].
    verdict: usize,
    /// The mutant that made the test fail.
    by: Option<u64>,
    /// How many were tried.
    tried: usize,
}

fn search(suite: &Suite, test: &Test, order: &[u64], budget: f64) -> Found {
    let mut found = Found { verdict: usize::from(!test.reached.is_empty()), by: None, tried: 0 };
    let started = Instant::now();
    for &number in order {
        if started.elapsed().as_secs_f64() > budget {
            break;
        }
        found.tried += 1;
        let verdict = match suite.run(test.binary, &[&test.name], number, 5.0 + 20.0 * test.seconds) {
            Outcome::Passed => continue,
            Outcome::Failed(output) if has_figure(&output) || suite.name(test.binary) != "checks" => 3,
            Outcome::Failed(_) | Outcome::TimedOut => 2,
        };
        if verdict > found.verdict {
            (found.verdict, found.by) = (verdict, Some(number));
        }
        if verdict == 3 {
            break;
        }
    }
    found
}

/// Whether a failed check tells of a figure and the bound required of it.
fn has_figure(output: &str) -> bool {
    output.contains(", required ")
}

/// Mutants that few tests reach first: they are of what this test is about. Among these in an order that is the same in each run.
fn in_order(test: &Test, reached_by: &HashMap<u64, usize>, equivalent: &HashSet<u64>) -> Vec<u64> {
    let hash = |number: u64| {
        let mut hasher = DefaultHasher::new();
        (number, &test.name).hash(&mut hasher);
        hasher.finish()
    };
    let mut order: Vec<u64> = test.reached.iter().copied().filter(|number| !equivalent.contains(number)).collect();
    order.sort_by_key(|number| (reached_by[number], hash(*number)));
    order
}

/// Prints how many tests have each verdict, and the names of those that did not fail.
fn report(verdicts: &[Value]) {
    let mut last: HashMap<(String, String), &Value> = HashMap::new();
    for line in verdicts {
        last.insert((line["binary"].to_string(), line["test"].to_string()), line);
    }
    let mut rows: Vec<&Value> = last.into_values().collect();
    rows.sort_by_key(|line| (line["binary"].to_string(), line["test"].to_string()));
    for verdict in VERDICTS {
        let those: Vec<&&Value> = rows.iter().filter(|line| line["verdict"] == verdict).collect();
        println!("{verdict}: {} tests", those.len());
        if verdict != VERDICTS[3] {
            let tell = |line: &&&Value| {
                println!("    {} {} ({} of {})", line["binary"], line["test"], line["tried"], line["reached"])
            };
            those.iter().for_each(tell);
        }
    }
}
