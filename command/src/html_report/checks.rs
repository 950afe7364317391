//! The checks, grouped by kind, with their measured values.

use maud::{Markup, html};

use super::Content;
use super::cross_reference::{self, Index};
use super::typography::typeset;
use twofold_verify::check::{Check, Outcome};
use twofold_verify::claims::capital;
use twofold_verify::report::{self, KINDS};

pub(super) fn section(content: &Content, index: &Index) -> Markup {
    html! {
        p {
            "A check compares an equation with something independent of it. It measures one number, which must meet one bound. "
            "Times are seconds on one core while others ran beside it."
        }
        @for (kind, about) in KINDS {
            @let of_kind = content.results.iter().filter(|(check, _)| check.kind == kind).collect::<Vec<_>>();
            @if !of_kind.is_empty() {
                h3 id={ "checks-" (kind.name()) } { (capital(kind.name())) " (" (of_kind.len()) "): " (about) }
                (table(&of_kind, index))
            }
        }
    }
}

fn table(results: &[&report::Result], index: &Index) -> Markup {
    let columns = ["Check", "What holds", "Measured", "Bound", "Verdict", "Time [s]"];
    html! {
        // On a phone each row is a block; without the roles a screen reader would not recognise the table.
        table.checks role="table" {
            thead role="rowgroup" { tr role="row" { @for column in columns { th scope="col" role="columnheader" { (column) } } } }
            tbody role="rowgroup" {
                @for (check, outcome) in results {
                    tr.failing[!outcome.passed] role="row" id=(cross_reference::check(check.id)) {
                        th scope="row" role="rowheader" { (name(check, index)) }
                        td role="cell" { (what(check, outcome, index)) }
                        td.number role="cell" data-label=(columns[2]) { (typeset(&report::measured(outcome))) }
                        td.number role="cell" data-label=(columns[3]) { (typeset(&check.bound.to_string())) }
                        td role="cell" data-label=(columns[4]) {
                            b.pass[outcome.passed].fail[!outcome.passed] { (report::verdict(outcome)) }
                        }
                        td.number role="cell" data-label=(columns[5]) { (format!("{:.3}", outcome.seconds)) }
                    }
                }
            }
        }
    }
}

fn name(check: &Check, index: &Index) -> Markup {
    let id = cross_reference::check(check.id);
    let about = index.named_by(&id, "claim-").into_iter().chain(index.named_by(&id, "discrepancy-"));
    html! {
        a href={ "#" (id) } { code { (check.id) } }
        div.small {
            @for (place, number) in check.equations.iter().enumerate() {
                @if place > 0 { " " }
                a href={ "#" (cross_reference::equation(*number)) } { "(" (number) ")" }
            }
            @for source in about { "; " (source) }
        }
    }
}

fn what(check: &Check, outcome: &Outcome, index: &Index) -> Markup {
    let found = match &outcome.measured {
        Ok(measured) => &measured.detail,
        Err(message) => message,
    };
    html! {
        (index.linked(check.statement))
        div.small { "Figure: " (typeset(check.figure)) "." }
        details open[!outcome.passed] {
            summary { "Why this bound" @if !found.is_empty() { ", and what was seen" } }
            p { (index.linked(&capital(check.reason))) "." }
            @if !found.is_empty() { p.found { (found) } }
        }
    }
}

/// The failures, for the top of the page.
pub(super) fn failures(content: &Content) -> Markup {
    html! {
        @for (check, outcome) in content.results.iter().filter(|(_, outcome)| !outcome.passed) {
            li {
                a href={ "#" (cross_reference::check(check.id)) } { code { (check.id) } } ": " (typeset(check.statement)) "."
                @match &outcome.measured {
                    Ok(measured) => {
                        div {
                            "Figure: " (typeset(check.figure)) ": " b { (typeset(&report::measured(outcome))) } ", required "
                            (typeset(&check.bound.to_string())) "."
                        }
                        @if !measured.detail.is_empty() { div.found { (measured.detail) } }
                    }
                    Err(message) => div.found { (message) },
                }
            }
        }
    }
}
