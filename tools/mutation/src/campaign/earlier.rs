//! What the record knows already: mutants of sources that have not changed since need not be run again.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::score::{NOT_CAUGHT, RECORD, contents, hash_without_tests, place};

/// A row of the record: a file, the hash of its source, and how many of its mutants are left.
struct Row {
    file: String,
    content: String,
    left: usize,
}

fn record() -> Result<Vec<Row>, String> {
    let text = fs::read_to_string(RECORD).map_err(|e| format!("{RECORD}: {e}"))?;
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        // As in the header.
        let [file, content, .., lives, open, unreached] = fields[..] else { return Err(format!("{RECORD}: {line}")) };
        let counts = [lives, open, unreached].map(str::parse::<usize>);
        let left = counts.into_iter().sum::<Result<usize, _>>().map_err(|e| format!("{RECORD}: {line}: {e}"))?;
        Ok(Row { file: file.to_string(), content: content.to_string(), left })
    };
    text.lines().skip(1).map(row).collect()
}

/// Files of the tree, not yet rewritten, that have not changed since the record and of which nothing is left.
pub fn settled(tree: &Path) -> Result<HashSet<String>, String> {
    let is_settled = |row: &Row| {
        let text = fs::read_to_string(tree.join(&row.file)).unwrap_or_default();
        row.left == 0 && hash_without_tests(&text) == row.content
    };
    Ok(record()?.into_iter().filter(is_settled).map(|row| row.file).collect())
}

/// Begins the results of a tree with those of the record, for sources of the same content: what was caught is; what was not is to be run. That
/// tests have gone, a line of the list of equivalent mutants, or that there is a new operator or fault, is not seen: then ANEW is to be set.
pub fn begin(tree: &Path, mutants: &[Value]) -> Result<(), String> {
    let results = tree.join("results.jsonl");
    if results.exists() {
        return Ok(());
    }
    let list = fs::read_to_string(NOT_CAUGHT).map_err(|e| format!("{NOT_CAUGHT}: {e}"))?;
    let left: HashSet<&str> = list.lines().filter_map(|line| Some(line.split_once('\t')?.1)).collect();
    // What is left of a file must all be in the list, or the file is run anew.
    let listed = |file: &str| list.lines().filter(|line| line.split('\t').nth(1) == Some(file)).count();
    let known = record()?.into_iter().filter(|row| row.left == listed(&row.file));
    let recorded: HashMap<String, String> = known.map(|row| (row.file, row.content)).collect();
    let contents = contents(tree, mutants)?;
    let mut text = String::new();
    for mutant in mutants {
        let file = mutant["file"].as_str().unwrap_or("");
        if contents.get(file).is_none_or(|content| recorded.get(file) != Some(content)) {
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
