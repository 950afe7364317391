//! What the record knows already: mutants of sources that have not changed since need not be run again.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::score::{NOT_CAUGHT, RECORD, contents, hash_without_tests, place};

/// Files of the tree, not yet rewritten, that have not changed since the record and of which nothing is left.
pub fn settled(tree: &Path) -> Result<HashSet<String>, String> {
    let record = fs::read_to_string(RECORD).map_err(|e| format!("{RECORD}: {e}"))?;
    let is_settled = |line: &&str| {
        // As in the header of the record: the last three are left.
        let fields: Vec<&str> = line.split(',').collect();
        let [file, content, .., lives, open, unreached] = fields[..] else { return false };
        let text = fs::read_to_string(tree.join(file)).unwrap_or_default();
        [lives, open, unreached] == ["0"; 3] && hash_without_tests(&text) == content
    };
    Ok(record.lines().skip(1).filter(is_settled).filter_map(|line| Some(line.split_once(',')?.0.to_string())).collect())
}

/// Begins the results of a tree with those of the record, for sources of the same content: what was caught is; what was not is to be run. That
/// tests have gone, a line of the list of equivalent mutants, or that there is a new operator or fault, is not seen: then ANEW is to be set.
pub fn begin(tree: &Path, mutants: &[Value]) -> Result<(), String> {
    let results = tree.join("results.jsonl");
    if results.exists() {
        return Ok(());
    }
    let record = fs::read_to_string(RECORD).map_err(|e| format!("{RECORD}: {e}"))?;
    let list = fs::read_to_string(NOT_CAUGHT).map_err(|e| format!("{NOT_CAUGHT}: {e}"))?;
    let left: HashSet<&str> = list.lines().filter_map(|line| Some(line.split_once('\t')?.1)).collect();
    // What is left of a file must all be in the list, or the file is run anew.
    let is_listed = |file: &str, counts: [&str; 3]| {
        let sum: usize = counts.iter().filter_map(|count| count.parse::<usize>().ok()).sum();
        let lines = list.lines().filter(|line| line.split('\t').nth(1) == Some(file)).count();
        sum == lines
    };
    let known = |line| {
        let fields: Vec<&str> = str::split(line, ',').collect();
        let [file, content, .., lives, open, unreached] = fields[..] else { return None };
        is_listed(file, [lives, open, unreached]).then_some((file, content))
    };
    let recorded: HashMap<&str, &str> = record.lines().skip(1).filter_map(known).collect();
    let contents = contents(tree, mutants)?;
    let mut text = String::new();
    for mutant in mutants {
        let file = mutant["file"].as_str().unwrap_or("");
        if contents.get(file).is_none_or(|content| recorded.get(file) != Some(&content.as_str())) {
            continue;
        }
        let outcome = if left.contains(place(mutant).as_str()) { "survived" } else { "caught" };
        let line = json!({
            "number": mutant["number"], "outcome": outcome, "budget": 0.0, "complete": outcome == "caught",
            "file": mutant["file"], "function": mutant["function"],
        });
        text += &format!("{line}\n");
    }
    fs::write(&results, text).map_err(|e| format!("{}: {e}", results.display()))
}
