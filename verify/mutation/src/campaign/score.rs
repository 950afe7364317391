//! The score by file, what was not caught, and the record that is kept in the repository.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Mutants with a proof that they change nothing: file, function, change, code, proof; separated by tabs.
const EQUIVALENT: &str = include_str!("../../equivalent.tsv");

/// Columns of the record.
const HEADER: &str = "file,content,date,mutants,caught,equivalent,lives,open,unreached";

/// Whether a mutant is listed as equivalent.
pub fn is_equivalent(mutant: &Value) -> bool {
    EQUIVALENT.lines().any(|line| is_of(line, mutant))
}

fn is_of(line: &str, mutant: &Value) -> bool {
    let fields: Vec<&str> = line.split('\t').collect();
    fields.len() == 5
        && ["file", "function", "change", "code"].iter().zip(&fields).all(|(key, field)| mutant[*key] == **field)
}

/// Numbers of one file.
#[derive(Default)]
struct Counts {
    mutants: usize,
    caught: usize,
    equivalent: usize,
    lives: usize,
    open: usize,
    unreached: usize,
    not_run: usize,
}

/// Prints the score, writes `missed.txt`, and puts the files that were run whole into `verify/mutation/record.csv` of the folder above.
pub fn write(tree: &Path, mutants: &[Value]) -> Result<(), String> {
    let unused: Vec<&str> = EQUIVALENT
        .lines()
        .filter(|line| {
            let is_here = mutants.iter().any(|m| m["file"] == line.split('\t').next().unwrap_or(""));
            is_here && !mutants.iter().any(|m| is_of(line, m))
        })
        .collect();
    if !unused.is_empty() {
        eprintln!("listed as equivalent, but no mutant:\n{}", unused.join("\n"));
    }
    let mut last: HashMap<u64, Value> = HashMap::new();
    for result in super::lines(&tree.join("results.jsonl"))? {
        last.insert(result["number"].as_u64().unwrap_or(0), result);
    }
    let mut by_file: BTreeMap<String, Counts> = BTreeMap::new();
    let mut missed = String::new();
    for mutant in mutants {
        let counts = by_file.entry(text(mutant, "file")).or_default();
        counts.mutants += 1;
        if is_equivalent(mutant) {
            counts.equivalent += 1;
            continue;
        }
        let Some(result) = last.get(&mutant["number"].as_u64().unwrap_or(0)) else {
            counts.not_run += 1;
            continue;
        };
        let (count, word) = match (text(result, "outcome").as_str(), result["complete"] == false) {
            ("caught", _) => (&mut counts.caught, ""),
            ("unreached", _) => (&mut counts.unreached, "unreached"),
            (_, true) => (&mut counts.open, "open"),
            (_, false) => (&mut counts.lives, "lives"),
        };
        *count += 1;
        if !word.is_empty() {
            let of = |key| text(mutant, key).split_whitespace().collect::<Vec<_>>().join(" ");
            let [file, function, change, code] = ["file", "function", "change", "code"].map(of);
            missed += &format!("{word}\t{file}\t{}\t{function}\t{change}\t{code}\n", mutant["line"]);
        }
    }
    println!(
        "{:<56} {:>7} {:>10} {:>7} {:>7} {:>10} {:>8}",
        "file", "caught", "equivalent", "lives", "open", "unreached", "not run"
    );
    let mut total = Counts::default();
    for (file, counts) in &by_file {
        print(file, counts);
        total.caught += counts.caught;
        total.equivalent += counts.equivalent;
        total.lives += counts.lives;
        total.open += counts.open;
        total.unreached += counts.unreached;
        total.not_run += counts.not_run;
    }
    print("all", &total);
    fs::write(tree.join("missed.txt"), missed).map_err(|e| e.to_string())?;
    println!("those not caught: {}", tree.join("missed.txt").display());
    keep(tree, &by_file)
}

fn print(name: &str, c: &Counts) {
    println!(
        "{name:<56} {:>7} {:>10} {:>7} {:>7} {:>10} {:>8}",
        c.caught, c.equivalent, c.lives, c.open, c.unreached, c.not_run
    );
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or("").to_string()
}

/// Replaces the rows of the files that were run whole; a row tells by the hash of its file (as git has it) whether it is of today's.
fn keep(tree: &Path, by_file: &BTreeMap<String, Counts>) -> Result<(), String> {
    let record = Path::new("verify/mutation/record.csv");
    let mut rows: BTreeMap<String, String> = fs::read_to_string(record)
        .unwrap_or_default()
        .lines()
        .skip(1)
        .filter_map(|line| Some((line.split(',').next()?.to_string(), line.to_string())))
        .collect();
    let output = Command::new("date").arg("-I").output().map_err(|e| format!("date: {e}"))?;
    let date = String::from_utf8_lossy(&output.stdout).trim().to_string();
    let contents = fs::read_to_string(tree.join("contents.txt")).map_err(|e| format!("contents.txt: {e}"))?;
    for (file, c) in by_file.iter().filter(|(_, c)| c.not_run == 0) {
        let content = contents
            .lines()
            .find_map(|line| line.strip_suffix(file.as_str()).map(|hash| hash.trim()[..12].to_string()))
            .ok_or_else(|| format!("contents.txt has no {file}"))?;
        let counts = [c.mutants, c.caught, c.equivalent, c.lives, c.open, c.unreached].map(|n| n.to_string()).join(",");
        rows.insert(file.clone(), format!("{file},{content},{date},{counts}"));
    }
    let lines: Vec<String> = std::iter::once(HEADER.to_string()).chain(rows.into_values()).collect();
    fs::write(record, lines.join("\n") + "\n").map_err(|e| format!("{}: {e}", record.display()))
}
