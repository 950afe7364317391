//! The figures with their captions.

use maud::{Markup, PreEscaped, html};

use super::cross_reference::{self, Index};
use super::equations::row;
use super::{Content, golden};
use crate::figures::{self, Figure};

/// Claims shown by a figure: its name and the names of the claims.
const SHOWN: &[(&str, &[&str])] = &[
    ("motion-tp-1", &["caption-values"]),
    ("motion-tp-2", &["caption-values", "twofold-large-tilt"]),
    ("motion-sp-1", &["caption-values", "single-one-period"]),
    ("motion-sp-2", &["caption-values", "single-right-angle"]),
    ("beam-alignment-spectra", &["slow-line", "no-slow-line-tp-1", "free-pulse-lines"]),
    ("pulse-series", &["formulas-fit-tp-1", "formulas-fail-tp-2", "period-40", "period-180"]),
    (
        "wave-spectra",
        &["peaks-near-free", "third-harmonic", "third-weaker", "higher-harmonics", "no-slow-wave", "all-harmonics"],
    ),
    ("bound-factor", &["estimate-order", "eta-ten"]),
    (
        "perturbation-regimes",
        &["twofold-leading-order", "single-leading-order", "single-one-period", "single-right-angle"],
    ),
    ("method-regimes", &["beyond-leading-order", "twofold-large-tilt", "single-leading-order"]),
    ("momentum-sphere", &["two-first-integrals", "opposite-forced-precession", "middle-axis"]),
];

pub(super) fn note(content: &Content, index: &mut Index) {
    for figure in &content.figures {
        let (id, label) = (cross_reference::figure(&figure.name), name(figure));
        for paragraph in figure.caption.paragraphs() {
            index.note_text(paragraph, &id, &label);
        }
        for claim in shown(figure) {
            index.note(cross_reference::claim(claim), &id, &label);
            index.note(id.clone(), &cross_reference::claim(claim), claim);
        }
    }
}

pub(super) fn section(content: &Content, index: &Index) -> Markup {
    html! {
        p { "Numbers of figures are the paper's, by order of appearance; what has none is ours. Data files and pictures: " code { "twofold figures" } "." }
        @for figure in &content.figures { (article(figure, content, index)) }
    }
}

fn article(figure: &Figure, content: &Content, index: &Index) -> Markup {
    let id = cross_reference::figure(&figure.name);
    let numbers = format!("figure_{}", figure.name.replace('-', "_"));
    let golden = content.golden.iter().filter(|table| table.name == numbers);
    let summary = figures::plain(&figure.summary);
    // For a screen reader the drawing is one named picture, not many letters; a page allows no prolog of a file.
    let svg = figure.svg.find("<svg").map_or("", |start| &figure.svg[start..]);
    html! {
        article.figure id=(id) {
            h3 { a href={ "#" (id) } { (name(figure)) } ": " (index.linked(&summary)) }
            figure {
                div.wide tabindex="0" { (PreEscaped(svg)) }
                figcaption {
                    @for paragraph in figure.caption.paragraphs() {
                        p { (index.linked_with(paragraph, |text| PreEscaped(figures::html(text)))) }
                    }
                }
            }
            dl {
                (row("Golden table", golden.map(|table| golden::link(table.name)).collect()))
                (row("Claims", index.named_by(&id, "claim-")))
            }
        }
    }
}

/// `Figure 8`, or the name of a figure that the paper does not have.
fn name(figure: &Figure) -> String {
    figure.paper_figure.map_or_else(|| figure.name.clone(), |number| format!("Figure {number}"))
}

fn shown(figure: &Figure) -> &'static [&'static str] {
    SHOWN.iter().find(|(name, _)| *name == figure.name).map_or(&[], |(_, claims)| claims)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_and_claims_that_belong_together_exist() {
        for (figure, shown) in SHOWN {
            assert!(figures::RECIPES.iter().any(|recipe| recipe.name == *figure), "no figure {figure}");
            for claim in *shown {
                assert!(twofold_verify::claims::claims().any(|known| known.id == *claim), "{figure}: no claim {claim}");
            }
        }
    }
}
