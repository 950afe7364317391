//! The documentation has an example of everything that a user calls first. The examples are run by `cargo test --doc`.

use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The code of the examples in a source file, without blocks of formulas.
fn examples(text: &str) -> String {
    let (mut code, mut inside, mut is_example) = (String::new(), false, false);
    for line in text.lines() {
        let line = line.trim_start();
        let Some(line) = line.strip_prefix("//!").or(line.strip_prefix("///")) else { continue };
        if let Some(kind) = line.trim().strip_prefix("```") {
            (inside, is_example) = (!inside, !inside && ["", "rust", "should_panic"].contains(&kind));
        } else if inside && is_example {
            code += line;
            code.push('\n');
        }
    }
    code
}

/// Without the first lines of functions that go when their callers have moved.
fn without_old_entries(text: &str) -> String {
    let functions = text.split("pub fn ").enumerate().map(|(k, function)| match k {
        0 => function.to_owned(),
        _ if function.contains("// old entry") => format!("fn {function}"),
        _ => format!("pub fn {function}"),
    });
    functions.collect()
}

/// Names of the functions that are public in a module, and of the types with an associated function that makes one.
fn entry_points(text: &str) -> Vec<String> {
    let text = &without_old_entries(text.split("#[cfg(test)]").next().unwrap_or(""));
    let name = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found: Vec<String> =
        text.lines().filter_map(|line| line.strip_prefix("pub fn ")).map(|rest| format!("{}(", name(rest))).collect();
    let structs: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("pub struct ")).map(name).collect();
    let mut of = None;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("impl") {
            let rest = rest.split_once("> ").map_or(rest, |(_, rest)| rest);
            of = structs.iter().find(|of| name(rest.trim_start()) == **of && !rest.contains(" for ")).cloned();
        }
        let makes = line.strip_prefix("    pub fn ").filter(|rest| !rest.contains("self"));
        if let (Some(of), Some(rest)) = (&of, makes) {
            let function = name(rest);
            // Over several lines `self` may follow.
            let signature = text.split(line).nth(1).unwrap_or("").split(')').next().unwrap_or("");
            if !signature.contains("self,") && (function == "new" || function == "of" || function.starts_with("from_"))
            {
                found.push(format!("{of}::{function}("));
            }
        }
    }
    found
}

#[test]
fn every_entry_point_is_called_in_an_example() {
    let mut files = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    files.sort();
    let texts: Vec<_> = files.iter().map(|path| fs::read_to_string(path).expect("text")).collect();
    let examples: String = texts.iter().map(|text| examples(text)).collect();
    let is_called = |call: &str| {
        examples.match_indices(call).any(|(at, _)| {
            let before = examples[..at].chars().next_back();
            !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
        })
    };
    let mut all = 0;
    let mut missing = Vec::new();
    for (path, text) in files.iter().zip(&texts) {
        // What a module keeps to itself is public only inside the crate.
        if ["double_double.rs", "rounding.rs", "registers.rs", "arithmetic.rs", "fused.rs", "unfused.rs"]
            .iter()
            .any(|name| path.ends_with(name))
        {
            continue;
        }
        for call in entry_points(text) {
            all += 1;
            if !is_called(&call.replace("::<", "")) && !is_called(&call.replace('(', "::<")) {
                missing.push(format!(
                    "{}: {}",
                    path.strip_prefix(env!("CARGO_MANIFEST_DIR")).expect("inside").display(),
                    call
                ));
            }
        }
    }
    assert!(all > 150, "only {all} entry points are found");
    assert!(missing.is_empty(), "{} of {all} without an example:\n{}", missing.len(), missing.join("\n"));
}
