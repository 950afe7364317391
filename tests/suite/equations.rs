//! `docs/equations.md` is the generated table, and every equation has a row, functions and a check.

use std::collections::BTreeSet;
use std::fs;

use twofold_verify::equation_table::{EQUATIONS, markdown};

#[test]
fn page_is_the_generated_table() {
    let page = fs::read_to_string("docs/equations.md").expect("docs/equations.md is there");
    assert!(page == markdown(), "stale: run `cargo run --release -- equations > docs/equations.md`");
}

#[test]
fn every_equation_in_scope_has_a_row_with_an_item_and_a_check() {
    let numbers: Vec<u8> = EQUATIONS.iter().map(|equation| equation.number).collect();
    assert!(numbers.is_sorted(), "rows are in the paper's order");
    for number in (1..=43).chain([46]).chain(59..=79) {
        assert!(numbers.contains(&number), "Eq. ({number}) has no row");
    }
    let checks = twofold_verify::checks::all();
    for equation in EQUATIONS {
        // The action is not a function.
        assert!(!equation.items.is_empty() || equation.label == "action", "Eq. ({}) has no item", equation.number);
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

/// Checks named in the discrepancies exist.
#[test]
fn discrepancies_name_existing_checks() {
    let page = fs::read_to_string("docs/discrepancies.md").expect("docs/discrepancies.md is there");
    let known: BTreeSet<_> = twofold_verify::checks::all().iter().map(|check| check.id).collect();
    let mut named = 0;
    for paragraph in page.split("\n\n").filter(|p| p.starts_with("**Checks**")) {
        for id in paragraph.split('`').skip(1).step_by(2).filter(|name| name.contains('-')) {
            assert!(known.contains(id), "docs/discrepancies.md names the check {id}, which does not exist");
            named += 1;
        }
    }
    assert!(named > 10, "only {named} checks found: the page has lost its evidence");
}
