//! Links between the parts of the page: the targets, the texts that name them, and the reverse list.

use std::collections::{BTreeMap, BTreeSet};

use maud::{Markup, html};

use super::typography::typeset;

pub(super) fn equation(number: u8) -> String {
    format!("eq-{number}")
}

pub(super) fn check(id: &str) -> String {
    format!("check-{id}")
}

pub(super) fn golden(name: &str) -> String {
    format!("golden-{name}")
}

pub(super) fn figure(name: &str) -> String {
    format!("figure-{name}")
}

pub(super) fn claim(id: &str) -> String {
    format!("claim-{id}")
}

pub(super) fn discrepancy(number: &str) -> String {
    format!("discrepancy-{number}")
}

/// The targets on the page, and the claims, discrepancies and figures that name them.
#[derive(Debug, Default)]
pub(super) struct Index {
    known: BTreeSet<String>,
    /// Ids of the figures by the numbers in the paper.
    figures: BTreeMap<u8, String>,
    /// Id of a target -> ids of the parts that name it, with their labels.
    named_by: BTreeMap<String, Vec<(String, String)>>,
}

impl Index {
    pub(super) fn add(&mut self, id: String) {
        self.known.insert(id);
    }

    pub(super) fn add_figure(&mut self, id: String, paper_number: Option<u8>) {
        if let Some(number) = paper_number {
            self.figures.entry(number).or_insert_with(|| id.clone());
        }
        self.add(id);
    }

    /// Notes that the part with the id `source`, called `label`, names `target`.
    pub(super) fn note(&mut self, target: String, source: &str, label: &str) {
        let (sources, new) = (self.named_by.entry(target).or_default(), (source.to_owned(), label.to_owned()));
        if !sources.contains(&new) {
            sources.push(new);
        }
    }

    pub(super) fn note_text(&mut self, text: &str, source: &str, label: &str) {
        for target in self.pieces(text).into_iter().filter_map(|(_, target)| target) {
            self.note(target, source, label);
        }
    }

    /// Links to the parts that name `target` and whose ids begin with `prefix`.
    pub(super) fn named_by(&self, target: &str, prefix: &str) -> Vec<Markup> {
        let sources = self.named_by.get(target).into_iter().flatten();
        sources
            .filter(|(id, _)| id.starts_with(prefix))
            .map(|(id, label)| html! { a href={ "#" (id) } { (label) } })
            .collect()
    }

    /// A link to the figure of the golden table `figure_NAME`.
    pub(super) fn figure_of(&self, golden: &str) -> Option<Markup> {
        let name = golden.strip_prefix("figure_")?.replace('_', "-");
        let id = figure(&name);
        self.known.contains(&id).then(|| html! { a href={ "#" (id) } { (name) } })
    }

    /// Plain text with typeset formulas, in which `(25)`, `discrepancy 1` and `Figure 8` are links within the page.
    pub(super) fn linked(&self, text: &str) -> Markup {
        self.linked_with(text, typeset)
    }

    /// The same with another function that typesets the text between the links.
    pub(super) fn linked_with(&self, text: &str, set: impl Fn(&str) -> Markup) -> Markup {
        html! {
            @for (place, (piece, target)) in self.pieces(text).into_iter().enumerate() {
                @match (target, piece.strip_prefix('-').filter(|_| place > 0)) {
                    (Some(id), _) => a href={ "#" (id) } { (piece) },
                    // A range of equations.
                    (None, Some(rest)) => { "–" (set(rest)) }
                    (None, None) => (set(piece)),
                }
            }
        }
    }

    /// The target of a name in code: a check or a golden table.
    pub(super) fn code(&self, name: &str) -> Option<String> {
        [check(name), golden(name)].into_iter().find(|id| self.known.contains(id))
    }

    /// The text cut before and after each name, with the ids of the names.
    fn pieces<'t>(&self, text: &'t str) -> Vec<(&'t str, Option<String>)> {
        let (mut pieces, mut start, mut at) = (Vec::new(), 0, 0);
        while let Some(letter) = text[at..].chars().next() {
            let fresh = text[..at].chars().next_back().is_none_or(|c| !c.is_alphanumeric() && !"^_{".contains(c));
            match self.name_at(&text[at..]).filter(|_| fresh) {
                Some((length, id)) => {
                    pieces.push((&text[start..at], None));
                    pieces.push((&text[at..at + length], Some(id)));
                    at += length;
                    start = at;
                }
                None => at += letter.len_utf8(),
            }
        }
        pieces.push((&text[start..], None));
        pieces
    }

    /// Length and id of the name at the beginning of `text`.
    fn name_at(&self, text: &str) -> Option<(usize, String)> {
        let number = |rest: &str| {
            let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
            rest[..digits].parse::<u8>().ok().map(|number| (digits, number))
        };
        let (length, id) = if let Some(rest) = text.strip_prefix('(') {
            let (digits, number) = number(rest).filter(|(digits, _)| rest[*digits..].starts_with(')'))?;
            (digits + 2, equation(number))
        } else {
            let prefixes = ["discrepancy ", "Figure ", "figure ", "Fig. "];
            let prefix = prefixes.into_iter().find(|prefix| text.starts_with(prefix))?;
            let (digits, number) = number(&text[prefix.len()..])?;
            let id = if prefix == prefixes[0] {
                discrepancy(&number.to_string())
            } else {
                self.figures.get(&number)?.clone()
            };
            (prefix.len() + digits, id)
        };
        self.known.contains(&id).then_some((length, id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_text_become_links_and_nothing_else_does() {
        let mut index = Index::default();
        for id in [equation(1), equation(25), discrepancy("7"), check("order")] {
            index.add(id);
        }
        index.add_figure(figure("line-of-sight"), Some(8));
        assert_eq!(
            index.linked("Eqs. (25)-(26), a^(1) < b(1), (1); discrepancy 7, Figure 8, Fig. 9, (300), é(").0,
            "Eqs. <a href=\"#eq-25\">(25)</a>–(26), a<sup>(1)</sup> &lt; b(1), <a href=\"#eq-1\">(1)</a>; \
             <a href=\"#discrepancy-7\">discrepancy 7</a>, <a href=\"#figure-line-of-sight\">Figure 8</a>, Fig. 9, (300), é("
        );
        assert_eq!(index.code("order").as_deref(), Some("check-order"));
        assert_eq!(index.code("disorder"), None);

        index.note_text("(25)", "claim-x", "x");
        assert_eq!(index.named_by("eq-25", "claim-")[0].0, "<a href=\"#claim-x\">x</a>");
        assert!(index.named_by("eq-25", "figure-").is_empty());
    }
}
