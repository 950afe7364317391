//! The paper's numbers beside ours.

use maud::{Markup, html};

use super::Content;
use super::cross_reference::{self, Index};
use super::equations::row;
use super::typography::typeset;
use twofold_verify::equation_table::EQUATIONS;
use twofold_verify::golden::{GoldenTable, Printed};

pub(super) fn section(content: &Content, index: &Index) -> Markup {
    html! {
        p {
            "A number is confirmed if ours rounds to the printed one, an order of magnitude (~) if ours is within half a decade "
            "of it; derived if the paper prints none."
        }
        @for golden in &content.golden { (table(golden, index)) }
    }
}

pub(super) fn link(name: &str) -> Markup {
    html! { a href={ "#" (cross_reference::golden(name)) } { code { (name) } } }
}

fn table(golden: &GoldenTable, index: &Index) -> Markup {
    let id = cross_reference::golden(golden.name);
    let nothing_printed = golden.lines.iter().all(|line| line.printed == Printed::No);
    let equations = EQUATIONS.iter().filter(|equation| equation.golden.contains(&golden.name));
    let equation = |number: u8| html! { a href={ "#" (cross_reference::equation(number)) } { "(" (number) ")" } };
    html! {
        article.golden id=(id) {
            h3 { a href={ "#" (id) } { code { (golden.name) } } }
            table role="table" {
                caption { (index.linked(golden.title)) }
                thead role="rowgroup" {
                    tr role="row" {
                        th scope="col" role="columnheader" { "Number" }
                        @if !nothing_printed { th scope="col" role="columnheader" { "Printed" } }
                        th scope="col" role="columnheader" { "Ours" }
                        @if !nothing_printed { th scope="col" role="columnheader" { "Verdict" } }
                    }
                }
                tbody role="rowgroup" {
                    @for line in &golden.lines {
                        tr role="row" {
                            th scope="row" role="rowheader" { (index.linked(&line.label)) }
                            @if !nothing_printed { td.number role="cell" data-label="Printed" { (typeset(&line.printed_text())) } }
                            td.number role="cell" data-label="Ours" { (typeset(&line.ours_text())) }
                            @if !nothing_printed {
                                @let verdict = line.verdict();
                                td role="cell" data-label="Verdict" {
                                    span.pass[verdict == "confirmed"].fail[verdict == "differs"] { (verdict) }
                                }
                            }
                        }
                    }
                }
            }
            dl {
                (row("Figure", index.figure_of(golden.name).into_iter().collect()))
                (row("Equations", equations.map(|e| equation(e.number)).collect()))
                (row("Claims", index.named_by(&id, "claim-")))
                (row("Discrepancies", index.named_by(&id, "discrepancy-")))
            }
        }
    }
}
