//! Mutants that are not run: with a proof that they change nothing, or caught when the source was edited.

use std::collections::HashSet;

use serde_json::Value;

/// File, function, change, code, which of the mutants with these four (from 1, in the order of the source; `all`), proof; separated by tabs. A star is for
/// any file, function or code.
const EQUIVALENT: &str = include_str!("../../equivalent.tsv");

/// The same, with the test that fails: constants that other constants or types are made of, whose variants cannot be chosen when a program runs.
const EDITED: &str = include_str!("../../edited.tsv");

/// Numbers of the mutants that change nothing.
pub fn equivalent(mutants: &[Value]) -> HashSet<u64> {
    numbers(EQUIVALENT, mutants)
}

/// Numbers of those caught in an edited source.
pub fn edited(mutants: &[Value]) -> HashSet<u64> {
    numbers(EDITED, mutants)
}

/// Tells of lines that fit no mutant.
fn numbers(list: &str, mutants: &[Value]) -> HashSet<u64> {
    let mut found = HashSet::new();
    for line in list.lines() {
        let fields: Vec<&str> = line.split('\t').collect();
        let [file, function, change, code, which, _] = fields[..] else {
            eprintln!("listed, not in six fields: {line}");
            continue;
        };
        let keys = [("file", file), ("function", function), ("change", change), ("code", code)];
        let fits = |mutant: &&Value| keys.iter().all(|(key, wanted)| *wanted == "*" || mutant[*key] == **wanted);
        let all: Vec<u64> = mutants.iter().filter(fits).filter_map(|mutant| mutant["number"].as_u64()).collect();
        let some = match which.parse::<usize>() {
            Ok(place) => all.get(place.wrapping_sub(1)..place).unwrap_or(&[]),
            Err(_) => &all[..],
        };
        if some.is_empty() && mutants.iter().any(|mutant| mutant["file"] == file) {
            eprintln!("listed, but no mutant: {line}");
        }
        found.extend(some);
    }
    found
}
