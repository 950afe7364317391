//! Keeps `docs/equations.md` true: it is the generated table, names only what exists, and misses no public function.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use twofold_verify::equation_table::{AUXILIARY, EQUATIONS, markdown};

#[test]
fn page_is_the_generated_table() {
    let page = fs::read_to_string("docs/equations.md").expect("docs/equations.md is there");
    assert!(page == markdown(), "stale: run `cargo run --release -- equations > docs/equations.md`");
}

#[test]
fn every_equation_in_scope_has_a_row_with_an_item_and_a_check() {
    let numbers: Vec<u8> = EQUATIONS.iter().map(|equation| equation.number).collect();
    assert!(numbers.is_sorted(), "rows are in the paper's order");
    for number in (5..=43).chain([46]).chain(59..=79) {
        assert!(numbers.contains(&number), "Eq. ({number}) has no row");
    }
    let checks = twofold_verify::checks::all();
    for equation in EQUATIONS {
        assert!(!equation.items.is_empty(), "Eq. ({}) has no item", equation.number);
        let checked = checks.iter().any(|check| check.equations.contains(&equation.number));
        assert!(checked, "Eq. ({}) has no check", equation.number);
    }
}

#[test]
fn every_check_is_about_an_equation_with_a_row_and_has_an_id_of_its_own() {
    let mut ids = BTreeSet::new();
    for check in twofold_verify::checks::all() {
        assert!(ids.insert(check.id), "two checks are called {}", check.id);
        for number in check.equations {
            assert!(
                EQUATIONS.iter().any(|e| e.number == *number),
                "{} names Eq. ({number}), which has no row",
                check.id
            );
        }
    }
}

#[test]
fn golden_tables_named_exist() {
    let tables: BTreeSet<_> =
        twofold_verify::golden::tables().expect("the golden numbers can be computed").iter().map(|t| t.name).collect();
    let named: BTreeSet<_> = EQUATIONS.iter().flat_map(|e| e.golden).copied().collect();
    assert_eq!(named, tables, "golden tables named by the equations, and those that exist");
}

/// Checks named in the discrepancies exist: the page is prose, its evidence is not.
#[test]
fn discrepancies_name_existing_checks() {
    let page = fs::read_to_string("docs/discrepancies.md").expect("docs/discrepancies.md is there");
    let known: BTreeSet<_> = twofold_verify::checks::all().iter().map(|check| check.id).collect();
    let mut named = 0;
    for paragraph in page.split("\n\n").filter(|p| p.starts_with("**Shown by**")) {
        for id in paragraph.split('`').skip(1).step_by(2).filter(|name| name.contains('-')) {
            assert!(known.contains(id), "docs/discrepancies.md names the check {id}, which does not exist");
            named += 1;
        }
    }
    assert!(named > 10, "only {named} checks found: the page has lost its evidence");
}

#[test]
fn items_and_public_functions_are_the_same_set() {
    let defined = public_items(Path::new("src"));
    let listed: BTreeSet<String> = EQUATIONS
        .iter()
        .flat_map(|e| e.items)
        .chain(AUXILIARY.iter().flat_map(|(_, items)| *items))
        .map(|item| item.to_string())
        .collect();
    let types: BTreeSet<String> =
        defined.iter().filter_map(|item| item.split_once("::<type>").map(|(t, _)| t.to_string())).collect();
    let functions: BTreeSet<String> = defined.into_iter().filter(|item| !item.ends_with("<type>")).collect();
    let undefined: Vec<_> = listed.iter().filter(|item| !functions.contains(*item) && !types.contains(*item)).collect();
    assert!(undefined.is_empty(), "listed but not defined: {undefined:#?}");
    let uncovered: Vec<_> = functions
        .iter()
        .filter(|function| {
            let owner = function.rsplit_once("::").map_or("", |(owner, _)| owner);
            !(listed.contains(*function) || types.contains(owner) && type_is_listed(&listed, owner))
        })
        .collect();
    assert!(uncovered.is_empty(), "public but in no row: {uncovered:#?}");
}

/// A method is covered if its type, or any method of it, stands in a row.
fn type_is_listed(listed: &BTreeSet<String>, owner: &str) -> bool {
    listed.contains(owner) || listed.iter().any(|item| item.starts_with(&format!("{owner}::")))
}

/// Paths of the public functions and methods below `folder`, and of public types with `::<type>` behind. A module that its
/// parent keeps private (`mod x;`) leaves no trace in a path: its items are re-exported.
fn public_items(folder: &Path) -> BTreeSet<String> {
    let mut items = BTreeSet::new();
    collect(folder, &folder.join("lib.rs"), &[], &mut items);
    items
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
    // A public module whose types the parent re-exports: both paths are right, the shorter one is listed.
    for line in text.lines().filter(|line| line.starts_with("pub use ")) {
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
