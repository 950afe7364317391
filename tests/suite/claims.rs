//! Claims rest on checks that exist. A test in `tests/checks.rs`, which has the figures, compares `docs/claims.md` with the generated page.

use std::collections::BTreeSet;
use std::fs;

use twofold_verify::claims::{Verdict, claims};

#[test]
fn every_claim_has_a_name_of_its_own_and_evidence() {
    let checks: BTreeSet<_> = twofold_verify::checks::all().iter().map(|check| check.id).collect();
    let mut ids = BTreeSet::new();
    for claim in claims() {
        assert!(ids.insert(claim.id), "two claims are called {}", claim.id);
        assert!(!claim.checks.is_empty(), "{} rests on nothing", claim.id);
        for id in claim.checks {
            assert!(checks.contains(id), "{} names the check {id}, which does not exist", claim.id);
        }
    }
}

/// Every claim that is not simply confirmed is derived in `docs/discrepancies.md`, with one of the checks behind the verdict.
#[test]
fn discrepancies_hold_every_claim_that_is_not_confirmed() {
    let page = fs::read_to_string("docs/discrepancies.md").expect("the page is there");
    for claim in claims().filter(|claim| claim.verdict != Verdict::Confirmed) {
        let named = claim.checks.iter().any(|check| page.contains(&format!("`{check}`")));
        assert!(named, "{}: no check of it is named in docs/discrepancies.md", claim.id);
    }
}
