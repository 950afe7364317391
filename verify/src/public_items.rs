//! The public functions of a crate, read from its sources: what tables of equations and of errors must cover.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Paths of the public functions and methods below `folder`, and of public types with `::<type>` behind. A module that its
/// parent keeps private (`mod x;`) leaves no trace in a path: its items are re-exported.
pub fn public_items(folder: &Path) -> BTreeSet<String> {
    let mut items = BTreeSet::new();
    collect(folder, &folder.join("lib.rs"), &[], &mut items);
    // Methods of a type that another module defines: by the path of the type.
    let types: Vec<String> = items.iter().filter_map(|item| Some(item.strip_suffix("::<type>")?.to_string())).collect();
    let by_type = items.into_iter().map(|item| {
        let Some((owner, method)) = item.rsplit_once("::").filter(|(owner, _)| !types.iter().any(|t| t == owner))
        else {
            return item;
        };
        let name = owner.rsplit("::").next().unwrap_or(owner);
        let defined =
            types.iter().find(|t| name.starts_with(char::is_uppercase) && t.rsplit("::").next() == Some(name));
        defined.map_or(item.clone(), |defined| format!("{defined}::{method}"))
    });
    by_type.collect()
}

fn collect(folder: &Path, file: &Path, path: &[String], items: &mut BTreeSet<String>) {
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let full = |name: &str| path.iter().map(String::as_str).chain([name]).collect::<Vec<_>>().join("::");
    let mut owner: Option<String> = None;
    for line in text.lines() {
        let trimmed = line.trim_start();
        if let Some(header) = line.strip_prefix("impl") {
            owner = (!header.contains(" for ")).then(|| implemented_type(header));
        } else if line == "}" {
            owner = None;
        }
        for keyword in ["pub fn ", "pub const fn "] {
            if let Some(rest) = trimmed.strip_prefix(keyword) {
                let name = identifier(rest);
                match &owner {
                    Some(owner) => items.insert(full(&format!("{owner}::{name}"))),
                    None => items.insert(full(name)),
                };
            }
        }
        for keyword in ["pub struct ", "pub enum ", "pub trait "] {
            if let Some(rest) = line.strip_prefix(keyword) {
                items.insert(full(&format!("{}::<type>", identifier(rest))));
            }
        }
        for (keyword, public) in [("pub mod ", true), ("mod ", false)] {
            if let Some(name) = line.strip_prefix(keyword).and_then(|rest| rest.strip_suffix(';')) {
                let mut inner = path.to_vec();
                if public {
                    inner.push(name.to_string());
                }
                let (flat, nested) = (folder.join(format!("{name}.rs")), folder.join(name).join("mod.rs"));
                if nested.exists() {
                    collect(&folder.join(name), &nested, &inner, items);
                } else {
                    collect(folder, &flat, &inner, items);
                }
            }
        }
    }
    // A public module whose types the parent re-exports: both paths are right, the shorter one is listed. The front page of the crate lists
    // nothing anew.
    for line in text.lines().filter(|line| !path.is_empty() && line.starts_with("pub use ")) {
        reexport(line, path, items);
    }
}

fn reexport(line: &str, path: &[String], items: &mut BTreeSet<String>) {
    let Some((module, names)) = line.trim_start_matches("pub use ").trim_end_matches(';').rsplit_once("::") else {
        return;
    };
    let prefix = path.iter().map(String::as_str).chain([module]).collect::<Vec<_>>().join("::");
    for name in names.trim_matches(['{', '}']).split(',').map(str::trim) {
        let long = format!("{prefix}::{name}::");
        let short = format!("{}::", path.iter().map(String::as_str).chain([name]).collect::<Vec<_>>().join("::"));
        let moved: Vec<String> = items.iter().filter(|item| item.starts_with(&long)).cloned().collect();
        for item in moved {
            items.remove(&item);
            items.insert(item.replacen(&long, &short, 1));
        }
    }
}

fn implemented_type(header: &str) -> String {
    // Skip the parameters of the impl itself, `<S: Real>`, then take the type's name.
    let rest = match header.strip_prefix('<') {
        Some(rest) => {
            let mut depth = 1;
            let end = rest
                .char_indices()
                .find(|(_, c)| {
                    depth += match c {
                        '<' => 1,
                        '>' => -1,
                        _ => 0,
                    };
                    depth == 0
                })
                .map_or(0, |(i, _)| i + 1);
            &rest[end..]
        }
        None => header,
    };
    identifier(rest.trim_start()).to_string()
}

fn identifier(text: &str) -> &str {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    &text[..end]
}
