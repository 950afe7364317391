//! The equations: each typeset, with its implementation and the findings about it.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::cross_reference::{self, Index};
use super::equation_source::{Entry, Form, entries};
use super::typography::typeset;
use super::{Content, latex, markdown};
use twofold_verify::equation_table::EQUATIONS;

pub(super) fn numbers() -> impl Iterator<Item = u8> {
    EQUATIONS.iter().map(|equation| equation.number)
}

pub(super) fn section(content: &Content, index: &mut Index) -> Result<Markup, String> {
    let mut sources: BTreeMap<u8, Vec<Entry>> = BTreeMap::new();
    for entry in entries()? {
        sources.entry(entry.number).or_default().push(entry);
    }
    let mut articles = Vec::new();
    for equation in EQUATIONS {
        let evidence = evidence(equation, content, index);
        articles.push(article(equation.number, equation.label, equation.subject, &sources, evidence, index)?);
    }
    Ok(html! {
        p {
            "Numbers count the paper's numbered equations in order; names in brackets are its LaTeX labels. The paper's "
            i { "s" } " with a bar is written " i { "s" } ". Each equation stands as printed; below it, marked, the form that "
            "holds where the printed one does not, and the form computed with where that is another."
        }
        nav.numbers aria-label="Equations by number" {
            @for number in numbers() { a href={ "#" (cross_reference::equation(number)) } { "(" (number) ")" } " " }
        }
        @for article in articles { (article) }
    })
}

fn article(
    number: u8,
    label: &str,
    subject: &str,
    sources: &BTreeMap<u8, Vec<Entry>>,
    evidence: Markup,
    index: &mut Index,
) -> Result<Markup, String> {
    let entries = sources.get(&number).ok_or_else(|| format!("equations.tex has no equation ({number})"))?;
    let mut forms = Vec::new();
    for entry in entries {
        forms.push(form(entry, index)?);
    }
    let id = cross_reference::equation(number);
    Ok(html! {
        article.equation id=(id) {
            h3 {
                a href={ "#" (id) } { "(" (number) ")" } " " (typeset(subject))
                @if !label.is_empty() { " " code.label { "[" (label) "]" } }
            }
            @for form in forms { (form) }
            (evidence)
        }
    })
}

fn form(entry: &Entry, index: &mut Index) -> Result<Markup, String> {
    let (class, name) = match entry.form {
        Form::Printed => ("printed", ""),
        Form::Corrected => ("corrected", "Corrected"),
        Form::Used => ("used", "Used"),
        Form::Note => ("note", "Note"),
    };
    let remark = markdown::line(entry.remark, index)?;
    let displayed = match entry.form {
        Form::Note => html! {},
        _ => latex::displayed(&entry.latex)?,
    };
    Ok(html! {
        div class={ "form " (class) } {
            @if !entry.remark.is_empty() {
                p { @if !name.is_empty() { b { (name) ". " } } (remark) }
            }
            @if entry.form != Form::Note { div.display.wide tabindex="0" { (displayed) } }
        }
    })
}

fn evidence(equation: &twofold_verify::equation_table::Equation, content: &Content, index: &Index) -> Markup {
    let id = cross_reference::equation(equation.number);
    let about: Vec<_> =
        content.results.iter().filter(|(check, _)| check.equations.contains(&equation.number)).collect();
    let code = |name: &&str| html! { code { (name) } };
    let check = |(check, outcome): &&twofold_verify::report::Result| {
        html! {
            a.fail[!outcome.passed] href={ "#" (cross_reference::check(check.id)) } { code { (check.id) } }
            @if !outcome.passed { " " b.fail { "FAIL" } }
        }
    };
    let golden = |name: &&str| html! { a href={ "#" (cross_reference::golden(name)) } { code { (name) } } };
    html! {
        dl {
            (row("Implemented by", equation.items.iter().map(code).collect()))
            (row("Checks", about.iter().map(check).collect()))
            (row("Golden tables", equation.golden.iter().map(golden).collect()))
            (row("Figures", index.named_by(&id, "figure-")))
            (row("Claims", index.named_by(&id, "claim-")))
            (row("Discrepancies", index.named_by(&id, "discrepancy-")))
        }
    }
}

/// A line of a list of facts; empty if there are none.
pub(super) fn row(term: &str, values: Vec<Markup>) -> Markup {
    html! {
        @if !values.is_empty() {
            div {
                dt { (term) }
                dd { @for (place, value) in values.iter().enumerate() { @if place > 0 { ", " } (value) } }
            }
        }
    }
}
