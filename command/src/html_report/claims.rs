//! The paper's statements with verdicts.

use maud::{Markup, html};

use super::cross_reference::{self, Index};
use super::equations::row;
use super::typography::typeset;
use super::{Content, golden};
use twofold_verify::claims::{Claim, Verdict, capital, claims};
use twofold_verify::report;

pub(super) fn note(index: &mut Index) {
    for claim in claims() {
        let id = cross_reference::claim(claim.id);
        index.add(id.clone());
        for text in [claim.place, claim.statement, claim.finding] {
            index.note_text(text, &id, claim.id);
        }
        for check in claim.checks {
            index.note(cross_reference::check(check), &id, claim.id);
        }
        for table in claim.golden {
            index.note(cross_reference::golden(table), &id, claim.id);
        }
    }
}

pub(super) fn section(content: &Content, index: &Index) -> Markup {
    let count = |verdict| claims().filter(|claim| claim.verdict == verdict).count();
    html! {
        p { "Each statement of the paper that can be true or false, in our words, with a verdict and the checks that it rests on." }
        ul {
            @for verdict in Verdict::ALL {
                li { (capital(verdict.name())) ": " (count(verdict)) }
            }
        }
        @for claim in claims() { (article(claim, content, index)) }
    }
}

pub(super) fn links(claims: &[&Claim]) -> Markup {
    html! {
        @for (place, claim) in claims.iter().enumerate() {
            @if place > 0 { ", " }
            a href={ "#" (cross_reference::claim(claim.id)) } { (claim.id) }
        }
    }
}

/// Whether a verdict is void: a check behind it fails.
pub(super) fn is_void(claim: &Claim, content: &Content) -> bool {
    !claim.checks.iter().all(|id| content.results.iter().any(|(check, outcome)| check.id == *id && outcome.passed))
}

fn article(claim: &Claim, content: &Content, index: &Index) -> Markup {
    let id = cross_reference::claim(claim.id);
    let class = match claim.verdict {
        Verdict::Confirmed => "pass",
        Verdict::Corrected | Verdict::Superseded => "amend",
        Verdict::NotReproduced => "fail",
    };
    let evidence = claim.checks.iter().map(|id| {
        let outcome = content.results.iter().find(|(check, _)| check.id == *id);
        html! {
            a href={ "#" (cross_reference::check(id)) } { code { (id) } }
            @if let Some((check, outcome)) = outcome {
                " " (typeset(&report::measured(outcome))) " (" (typeset(&check.bound.to_string())) ")"
                @if !outcome.passed { " " b.fail { "FAIL" } }
            }
        }
    });
    html! {
        article.claim id=(id) {
            h3 {
                a href={ "#" (id) } { (claim.id) } ": "
                @if is_void(claim, content) {
                    b.fail { "void, a check that it rests on fails" }
                } @else {
                    b class=(class) { (claim.verdict.name()) }
                }
            }
            p { i { (index.linked(claim.place)) ". " } (index.linked(claim.statement)) }
            @if !claim.finding.is_empty() { p { (index.linked(claim.finding)) } }
            dl {
                (row("Checks", evidence.collect()))
                (row("Golden tables", claim.golden.iter().map(|name| golden::link(name)).collect()))
                (row("Figures", index.named_by(&id, "figure-")))
                (row("Discrepancies", index.named_by(&id, "discrepancy-")))
            }
        }
    }
}
