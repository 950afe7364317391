//! Rewrites a tree until it compiles: every variant that the compiler refuses is dropped.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use crate::campaign::earlier;
use crate::edit::{Edit, Origin, Site, apply};
use crate::package::{Package, is_among};
use crate::sites::{self, Constants, Fault};

/// One source file with what was found in it.
#[derive(Default)]
struct Source {
    path: PathBuf,
    text: String,
    sites: Vec<Site>,
    origins: Vec<Origin>,
    dropped_sites: HashSet<usize>,
    faults: Vec<Fault>,
}

/// The module that chooses the variant, put into the rewritten crate.
const SWITCH: &str = include_str!("switch.txt");

/// Rewrites the sources of one package of the tree. Files whose path begins with none of the `prefixes` get no variants, nor those that the record has
/// as settled, but if ANEW is set.
///
/// Writes `mutants.json` into the tree and returns the number of variants that compile.
pub fn instrument(tree: &Path, package: &Package, prefixes: &str) -> Result<usize, String> {
    let mut files = Vec::new();
    walk(&tree.join(package.sources), &mut files)?;
    files.sort();
    let tests = modules_of_tests(&files)?;
    let settled = if std::env::var_os("ANEW").is_none() { earlier::settled(tree)? } else { HashSet::new() };
    files.retain(|file| !tests.contains(file));
    let mut definitions: HashMap<String, Vec<Option<String>>> = HashMap::new();
    let mut sources = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let below = path.strip_prefix(tree).expect("in the tree").to_string_lossy().to_string();
        let is_rewritten = is_among(&below, prefixes) && !settled.contains(&below);
        for name in sites::constants(&text).map_err(|e| format!("{below}: {e}"))? {
            let module = is_rewritten.then(|| package.module_of(&below));
            definitions.entry(name).or_default().push(module);
        }
        if is_rewritten {
            sources.push(Source { path, text, faults: faults_of(&below)?, ..Source::default() });
        }
    }
    if sources.is_empty() {
        return Err(format!(
            "{prefixes}: nothing has changed since the record or is left of it; ANEW=1 runs it all the same"
        ));
    }
    // Those with one definition in the whole package, which is rewritten: they are called by their names alone.
    let with_path = |(name, modules): (String, Vec<Option<String>>)| {
        let [Some(module)] = &modules[..] else { return None };
        let path = format!("{module}::{}", sites::function_of(&name));
        Some((name, path))
    };
    let constants: Constants = definitions.into_iter().filter_map(with_path).collect();
    let mut dropped: HashSet<u32> = HashSet::new();
    prepare(tree, package)?;
    for round in 1..=40 {
        let mut next = 1;
        for source in &mut sources {
            let found = sites::find(&source.text, next, &constants, &dropped, &source.dropped_sites, &source.faults)
                .map_err(|e| format!("{}: {e}", source.path.display()))?;
            next += found.sites.iter().map(|s| s.variants.len() as u32).sum::<u32>();
            write(source, found.sites, &found.edits)?;
        }
        fs::write(tree.join(package.sources).join("mutation.rs"), SWITCH.replace("COUNT", &(next + 1).to_string()))
            .map_err(|e| e.to_string())?;
        let (refused, unplaced) = refusals(tree, package, &mut sources, &mut dropped)?;
        eprintln!("round {round}: {} variants, {} dropped, {refused} places refused now", next - 1, dropped.len());
        if refused == 0 {
            if !unplaced.is_empty() {
                return Err(format!("errors outside of any site:\n{}", unplaced.join("\n")));
            }
            return list(tree, &sources, &dropped);
        }
    }
    Err("does not compile after 40 rounds".into())
}

/// Faults by hand: file, function, what stands there, what stands there instead, in words; separated by tabs.
const FAULTS: &str = include_str!("../domain.tsv");

fn faults_of(file: &str) -> Result<Vec<Fault>, String> {
    FAULTS
        .lines()
        .filter(|line| line.split('\t').next() == Some(file))
        .map(|line| match line.split('\t').collect::<Vec<_>>().as_slice() {
            [_, function, from, to, what] => Ok(Fault {
                function: function.to_string(),
                from: from.replace("\\n", "\n"),
                to: to.replace("\\n", "\n"),
                what: what.to_string(),
            }),
            _ => Err(format!("domain.tsv: not five fields: {line}")),
        })
        .collect()
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), String> {
    for entry in fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))? {
        let path = entry.map_err(|e| e.to_string())?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// Files of modules that are compiled for tests alone: `#[cfg(test)] mod name;`.
fn modules_of_tests(files: &[PathBuf]) -> Result<HashSet<PathBuf>, String> {
    let mut found = HashSet::new();
    for file in files {
        let text = fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
        let folder = if file.ends_with("mod.rs") || file.ends_with("lib.rs") {
            file.parent().expect("in a folder").to_path_buf()
        } else {
            file.with_extension("")
        };
        found.extend(sites::modules_of_tests(&text)?.iter().map(|name| folder.join(format!("{name}.rs"))));
    }
    Ok(found)
}

/// Lints off, and the switch made a module of the crate.
fn prepare(tree: &Path, package: &Package) -> Result<(), String> {
    // The workspace's manifest is the model's as well.
    let manifest = tree.join("Cargo.toml");
    let text = fs::read_to_string(&manifest).map_err(|e| e.to_string())?;
    let text = text
        .replace("missing_docs = \"deny\"", "missing_docs = \"allow\"")
        .replace("all = { level = \"warn\", priority = -1 }", "all = { level = \"allow\", priority = -1 }");
    fs::write(&manifest, text).map_err(|e| e.to_string())?;
    let root = tree.join(package.sources).join("lib.rs");
    let text = fs::read_to_string(&root).map_err(|e| e.to_string())?;
    if !text.contains("mod mutation;") {
        let at = text.find("\npub mod ").or_else(|| text.find("\nmod ")).ok_or("lib.rs has no module")?;
        let (head, tail) = text.split_at(at);
        fs::write(&root, format!("{head}\n#[allow(missing_docs)] pub mod mutation;{tail}"))
            .map_err(|e| e.to_string())?;
    }
    Ok(())
}

fn write(source: &mut Source, sites: Vec<Site>, edits: &[Edit]) -> Result<(), String> {
    let (text, origins) = apply(&source.text, edits, sites.len());
    if !is_root(&source.path) {
        fs::write(&source.path, &text).map_err(|e| e.to_string())?;
    }
    (source.sites, source.origins) = (sites, origins);
    Ok(())
}

/// The root of a package holds the switch, and is not rewritten.
fn is_root(path: &Path) -> bool {
    path.ends_with("src/lib.rs")
}

/// Compiles, and drops what the errors point at, or else what stands within it. Returns how many, and the errors that lie in no site.
fn refusals(
    tree: &Path,
    package: &Package,
    sources: &mut [Source],
    dropped: &mut HashSet<u32>,
) -> Result<(usize, Vec<String>), String> {
    let output = Command::new("cargo")
        .args(["check", "-q", "-p", package.name, "--lib", "--message-format", "json"])
        .args(["--features", &package.features.join(",")])
        .env("RUSTFLAGS", "--cap-lints=allow")
        .current_dir(tree)
        .output()
        .map_err(|e| format!("cargo: {e}"))?;
    if output.status.success() {
        return Ok((0, Vec::new()));
    }
    let mut unplaced = Vec::new();
    let mut new_variants = HashSet::new();
    let mut new_sites: HashSet<(usize, usize)> = HashSet::new();
    let mut inside: HashSet<(usize, usize)> = HashSet::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
        let message = &message["message"];
        if message["level"] != "error" {
            continue;
        }
        let spans = message["spans"].as_array().cloned().unwrap_or_default();
        let mut placed = spans.is_empty();
        // What the error is about; if that lies in no site, what it refers to.
        for span in
            spans.iter().filter(|s| s["is_primary"] == true).chain(spans.iter().filter(|s| s["is_primary"] == false))
        {
            if placed && span["is_primary"] == false {
                break;
            }
            let file = tree.join(span["file_name"].as_str().unwrap_or(""));
            let (start, end) =
                (span["byte_start"].as_u64().unwrap_or(0) as usize, span["byte_end"].as_u64().unwrap_or(0) as usize);
            let Some(which) = sources.iter().position(|s| s.path == file) else { continue };
            let source = &sources[which];
            let within = source.origins.iter().filter(|o| o.range.0 <= start && end <= o.range.1);
            let Some(smallest) = within.min_by_key(|o| o.range.1 - o.range.0) else {
                let parts = source.origins.iter().filter(|o| start <= o.range.0 && o.range.1 <= end);
                inside.extend(parts.map(|o| (which, o.site)));
                continue;
            };
            placed = true;
            match smallest.variant {
                Some(k) => drop(new_variants.insert(source.sites[smallest.site].first + k as u32)),
                None => drop(new_sites.insert((which, smallest.site))),
            }
        }
        if !placed {
            unplaced.push(message["rendered"].as_str().unwrap_or("").to_string());
        }
    }
    // Whole sites only where no variant alone is to blame: an arm that does not compile makes errors around it.
    let mut refused = 0;
    for number in &new_variants {
        refused += usize::from(dropped.insert(*number));
    }
    for (which, site) in new_sites {
        let source = &mut sources[which];
        let Site { first, variants, .. } = &source.sites[site];
        if !(*first..*first + variants.len() as u32).any(|number| new_variants.contains(&number)) {
            refused += usize::from(source.dropped_sites.insert(site));
        }
    }
    // A constant that was borrowed for ever is a value no more, and the error stands about it.
    if refused == 0 {
        for (which, site) in inside {
            refused += usize::from(sources[which].dropped_sites.insert(site));
        }
    }
    if refused == 0 {
        let all = String::from_utf8_lossy(&output.stderr).to_string();
        return Err(format!("does not compile, and no site is to blame:\n{}\n{all}", unplaced.join("\n")));
    }
    Ok((refused, unplaced))
}

/// Writes `mutants.json`: every variant that compiles, and how many do not.
fn list(tree: &Path, sources: &[Source], dropped: &HashSet<u32>) -> Result<usize, String> {
    let mut all = Vec::new();
    for source in sources {
        let file = source.path.strip_prefix(tree).expect("in the tree").to_string_lossy().to_string();
        if is_root(&source.path) {
            continue;
        }
        for (index, site) in source.sites.iter().enumerate() {
            for (k, label) in site.variants.iter().enumerate() {
                let number = site.first + k as u32;
                if !dropped.contains(&number) && !source.dropped_sites.contains(&index) {
                    let text: String =
                        source.text[site.range.0..site.range.1].split_whitespace().collect::<Vec<_>>().join(" ");
                    all.push(json!({
                        "number": number, "file": file, "line": site.line, "function": site.function,
                        "change": label, "code": text.chars().take(160).collect::<String>(),
                    }));
                }
            }
        }
    }
    let lines: Vec<String> = all.iter().map(Value::to_string).collect();
    fs::write(tree.join("mutants.json"), lines.join("\n") + "\n").map_err(|e| e.to_string())?;
    Ok(all.len())
}
