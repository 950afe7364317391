//! The score by file, what was not caught, and the record that is kept in the repository.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::listed;

/// Columns of the record.
const HEADER: &str = "file,content,date,mutants,caught,equivalent,lives,open,unreached";

/// The numbers of every file that was run whole.
pub const RECORD: &str = "tools/mutation/record.csv";

/// Those of the record that are not caught: outcome, then where it stands and what it is.
pub const NOT_CAUGHT: &str = "tools/mutation/not_caught.tsv";

/// Hashes of the sources of the mutants, without their own tests, which hold none, in the twelve digits of the record.
pub fn contents(tree: &Path, mutants: &[Value]) -> Result<HashMap<String, String>, String> {
    let files: BTreeSet<&str> = mutants.iter().filter_map(|mutant| mutant["file"].as_str()).collect();
    let hash = |file: &str| {
        let text = fs::read_to_string(tree.join("original").join(file)).map_err(|e| format!("{file}: {e}"))?;
        Ok((file.to_string(), hash_without_tests(&text)))
    };
    files.into_iter().map(hash).collect()
}

/// FNV-1a of the lines before the module of tests that are not comments.
pub fn hash_without_tests(text: &str) -> String {
    // A line `mod tests;` is not the end: code follows it.
    let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let lines = code.trim_end().lines().filter(|line| !line.trim_start().starts_with("//"));
    let hash = lines
        .flat_map(|line| line.bytes().chain([b'\n']))
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    format!("{:012x}", hash >> 16)
}

/// Where a mutant stands and what it is, as in the list of those that are not caught.
pub fn place(mutant: &Value) -> String {
    let of = |key| text(mutant, key).split_whitespace().collect::<Vec<_>>().join(" ");
    let [file, function, change, code] = ["file", "function", "change", "code"].map(of);
    format!("{file}\t{}\t{function}\t{change}\t{code}", mutant["line"])
}

/// What becomes of mutants; the numbers of a file are in this order.
const KINDS: [&str; 6] = ["caught", "equivalent", "lives", "open", "unreached", "not run"];

type Counts = [usize; 6];

/// Prints the score, writes `missed.txt`, and puts the files that were run whole into `tools/mutation/record.csv` of the folder above.
pub fn write(tree: &Path, mutants: &[Value]) -> Result<(), String> {
    let (equivalent, edited) = (listed::equivalent(mutants), listed::edited(mutants));
    let mut last: HashMap<u64, Value> = HashMap::new();
    for result in super::lines(&tree.join("results.jsonl"))? {
        last.insert(result["number"].as_u64().unwrap_or(0), result);
    }
    let mut by_file: BTreeMap<String, Counts> = BTreeMap::new();
    let mut missed = String::new();
    for mutant in mutants {
        let number = mutant["number"].as_u64().unwrap_or(0);
        let kind = match last.get(&number) {
            _ if equivalent.contains(&number) => "equivalent",
            _ if edited.contains(&number) => "caught",
            None => "not run",
            Some(result) => match (text(result, "outcome").as_str(), result["complete"] == false) {
                ("caught", _) => "caught",
                ("unreached", _) => "unreached",
                (_, true) => "open",
                (_, false) => "lives",
            },
        };
        let place_of_kind = KINDS.iter().position(|known| *known == kind).expect("a kind");
        by_file.entry(text(mutant, "file")).or_default()[place_of_kind] += 1;
        if KINDS[2..5].contains(&kind) {
            missed += &format!("{kind}\t{}\n", place(mutant));
        }
    }
    let total = by_file.values().fold(Counts::default(), |sum, counts| std::array::from_fn(|k| sum[k] + counts[k]));
    let row = |name: &str, [a, b, c, d, e, f]: [String; 6]| {
        println!("{name:<56} {a:>7} {b:>10} {c:>7} {d:>7} {e:>10} {f:>8}");
    };
    row("file", KINDS.map(str::to_string));
    by_file.iter().for_each(|(file, counts)| row(file, counts.map(|n| n.to_string())));
    row("all", total.map(|n| n.to_string()));
    fs::write(tree.join("missed.txt"), &missed).map_err(|e| e.to_string())?;
    if total[5] == 0 {
        // With the record, which is read against it. Those of other files stay, but of files that are gone.
        let is_of_another = |line: &&str| {
            let file = line.split('\t').nth(1);
            file.is_some_and(|file| !by_file.contains_key(file) && Path::new(file).exists())
        };
        let old = fs::read_to_string(NOT_CAUGHT).map_err(|e| format!("{NOT_CAUGHT}: {e}"))?;
        let others: String = old.lines().filter(is_of_another).map(|line| format!("{line}\n")).collect();
        fs::write(NOT_CAUGHT, others + &missed).map_err(|e| format!("{NOT_CAUGHT}: {e}"))?;
    }
    println!("those not caught: {}", tree.join("missed.txt").display());
    keep(tree, mutants, &by_file)
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or("").to_string()
}

/// Replaces the rows of the files that were run whole; a row tells by a hash whether it is of today's source.
fn keep(tree: &Path, mutants: &[Value], by_file: &BTreeMap<String, Counts>) -> Result<(), String> {
    let mut rows: BTreeMap<String, String> = fs::read_to_string(RECORD)
        .unwrap_or_default()
        .lines()
        .skip(1)
        .filter_map(|line| Some((line.split(',').next()?.to_string(), line.to_string())))
        // Sources that are gone are of no account.
        .filter(|(file, _)| Path::new(file).exists())
        .collect();
    let output = Command::new("date").arg("-I").output().map_err(|e| format!("date: {e}"))?;
    let date = String::from_utf8_lossy(&output.stdout).trim().to_string();
    let contents = contents(tree, mutants)?;
    for (file, counts) in by_file.iter().filter(|(_, counts)| counts[5] == 0) {
        let content = contents.get(file).ok_or_else(|| format!("no source {file}"))?;
        let (all, counts): (usize, _) = (counts.iter().sum(), counts[..5].iter().map(|n| format!(",{n}")));
        rows.insert(file.clone(), format!("{file},{content},{date},{all}{}", counts.collect::<String>()));
    }
    let lines: Vec<String> = std::iter::once(HEADER.to_string()).chain(rows.into_values()).collect();
    fs::write(RECORD, lines.join("\n") + "\n").map_err(|e| format!("{RECORD}: {e}"))
}
