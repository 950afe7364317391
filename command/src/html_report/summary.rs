//! The top of the page: the verdict, the failures, and the counts.

use maud::{Markup, html};

use super::environment::brief;
use super::equations::row;
use super::{Content, TITLE, checks, claims, equations};
use twofold_verify::claims::Verdict;
use twofold_verify::report::KINDS;

pub(super) fn header(content: &Content) -> Markup {
    html! {
        header id="summary" {
            h1 { (TITLE) }
            p {
                "The equations of R. Xu, Y. Gao and L. Shao, " cite { "Precession of spheroids under Lorentz violation and "
                "observational consequences for neutron stars" } ", as implemented by twofold, and what became of the checks of "
                "each. " (brief(&content.environment))
            }
            (verdict(content))
            (counts(content))
        }
    }
}

fn verdict(content: &Content) -> Markup {
    let failed = content.results.iter().filter(|(_, outcome)| !outcome.passed).count();
    let void: Vec<_> = twofold_verify::claims::claims().filter(|claim| claims::is_void(claim, content)).collect();
    html! {
        @if failed == 0 {
            p { b.verdict.pass { "All " (content.results.len()) " checks pass." } }
        } @else {
            div.failing {
                p { b.verdict.fail { (failed) " of " (content.results.len()) " checks FAIL." } }
                ul { (checks::failures(content)) }
                @if !void.is_empty() {
                    p { "Void with them: the verdicts on " (claims::links(&void)) "." }
                }
            }
        }
    }
}

fn counts(content: &Content) -> Markup {
    let checks = KINDS.into_iter().map(|(kind, _)| {
        let count = content.results.iter().filter(|(check, _)| check.kind == kind).count();
        html! { a href={ "#checks-" (kind.name()) } { (count) " " (kind.name()) } }
    });
    let verdicts = Verdict::ALL.into_iter().map(|verdict| {
        let count = twofold_verify::claims::claims().filter(|claim| claim.verdict == verdict).count();
        html! { a href="#claims" { (count) " " (verdict.name()) } }
    });
    let numbers = ["confirmed", "differs", "derived"].into_iter().map(|verdict| {
        let count =
            content.golden.iter().flat_map(|table| &table.lines).filter(|line| line.verdict() == verdict).count();
        html! { a href="#golden" { (count) " " (verdict) } }
    });
    html! {
        dl.facts {
            (row("Equations", vec![html! { a href="#equations" { (equations::numbers().count()) } }]))
            (row("Checks", checks.collect()))
            (row("Claims of the paper", verdicts.collect()))
            (row("Numbers", numbers.collect()))
        }
    }
}
