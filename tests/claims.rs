//! Keeps `docs/claims.md` true: the generated page, with verdicts that rest on checks and golden tables that exist and hold.

use std::collections::BTreeSet;
use std::fs;

use twofold_verify::claims::{Verdict, claims, markdown};

#[test]
fn page_is_the_generated_one_and_every_check_of_it_passes() {
    let page = fs::read_to_string("docs/claims.md").expect("docs/claims.md is there");
    let generated = markdown().unwrap_or_else(|error| panic!("{error}"));
    assert!(page == generated, "stale: run `cargo run --release -- claims > docs/claims.md`");
}

#[test]
fn every_claim_has_a_name_of_its_own_and_evidence() {
    let checks: BTreeSet<_> = twofold_verify::checks::all().iter().map(|check| check.id).collect();
    let tables: BTreeSet<_> =
        twofold_verify::golden::tables().expect("the golden numbers can be computed").iter().map(|t| t.name).collect();
    let mut ids = BTreeSet::new();
    for claim in claims() {
        assert!(ids.insert(claim.id), "two claims are called {}", claim.id);
        assert!(!claim.checks.is_empty(), "{} rests on nothing", claim.id);
        for id in claim.checks {
            assert!(checks.contains(id), "{} names the check {id}, which does not exist", claim.id);
        }
        for name in claim.golden {
            assert!(tables.contains(name), "{} names the golden table {name}, which does not exist", claim.id);
        }
    }
}

/// What is not confirmed as it stands is derived in `docs/discrepancies.md`, by one of the checks that the verdict rests on.
#[test]
fn discrepancies_hold_every_claim_that_is_not_confirmed() {
    let page = fs::read_to_string("docs/discrepancies.md").expect("the page is there");
    for claim in claims().filter(|claim| claim.verdict != Verdict::Confirmed) {
        let named = claim.checks.iter().any(|check| page.contains(&format!("`{check}`")));
        assert!(named, "{}: no check of it is named in docs/discrepancies.md", claim.id);
    }
}
