//! The report: one complete HTML page, which needs no network, no script and no other file.
//!
//! The page is built with maud, which escapes every text. `PreEscaped` marks what is inserted as markup: the MathML of
//! our equations, the pages of `docs/`, the figures' SVG and the style sheets.

mod checks;
mod claims;
mod cross_reference;
mod environment;
mod equation_source;
mod equations;
mod figures;
mod golden;
mod latex;
mod markdown;
mod summary;
mod typography;

pub use environment::{Environment, environment};

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::figures::Figure;
use cross_reference::Index;
use twofold_verify::golden::GoldenTable;
use twofold_verify::report;

pub struct Content {
    pub results: Vec<report::Result>,
    pub seconds: f64,
    pub golden: Vec<GoldenTable>,
    pub figures: Vec<Figure>,
    /// Time and system.
    pub environment: Environment,
}

const TITLE: &str = "Precession of spheroids under Lorentz violation: verification report";

/// Allows only what is in the page itself.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:; base-uri 'none'; form-action 'none'";

/// The page.
pub fn page(content: &Content) -> Result<String, String> {
    let mut index = index(content);
    claims::note(&mut index);
    figures::note(content, &mut index);
    let discrepancies = markdown::page(include_str!("../../../docs/discrepancies.md"), &mut index)?;
    let equations = equations::section(content, &mut index)?;
    let sections = [
        ("claims", "Claims", claims::section(content, &index)),
        ("discrepancies", "Discrepancies", discrepancies),
        ("equations", "Equations", equations),
        ("checks", "Checks", checks::section(content, &index)),
        ("golden", "Golden tables", golden::section(content, &index)),
        ("figures", "Figures", figures::section(content, &index)),
        ("environment", "Environment", environment_section(content)),
    ];
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (TITLE) }
                style { (PreEscaped(include_str!("../../data/math-font.css"))) }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                a.skip href="#main" { "Skip to the report" }
                nav.contents aria-label="Contents" {
                    h2 { "Contents" }
                    ol {
                        li { a href="#summary" { "Summary" } }
                        @for (id, name, _) in &sections { li { a href={ "#" (id) } { (name) } } }
                    }
                }
                main id="main" {
                    (summary::header(content))
                    @for (id, name, section) in &sections {
                        section id=(id) aria-labelledby={ (id) "-heading" } {
                            h2 id={ (id) "-heading" } { (name) }
                            (section)
                        }
                    }
                }
            }
        }
    };
    Ok(page.into_string())
}

/// All named targets.
fn index(content: &Content) -> Index {
    let mut index = Index::default();
    equations::numbers().for_each(|number| index.add(cross_reference::equation(number)));
    content.results.iter().for_each(|(check, _)| index.add(cross_reference::check(check.id)));
    let figures = content.figures.iter();
    figures.for_each(|figure| index.add_figure(cross_reference::figure(&figure.name), figure.paper_figure));
    content.golden.iter().for_each(|table| index.add(cross_reference::golden(table.name)));
    markdown::numbers(include_str!("../../../docs/discrepancies.md"))
        .for_each(|number| index.add(cross_reference::discrepancy(number)));
    index
}

fn environment_section(content: &Content) -> Markup {
    html! {
        dl.facts {
            @for (name, value) in &content.environment { (equations::row(name, vec![html! { (value) }])) }
            (equations::row("Checks", vec![html! { (content.results.len()) " in " (format!("{:.1}", content.seconds)) " s" }]))
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::collections::BTreeSet;
    use std::sync::LazyLock;

    use super::*;
    use crate::figures::fixtures::OF_THE_PAPER;
    use twofold_verify::check::{Check, Measured, Outcome};
    use twofold_verify::golden::Printed;

    /// A page with all checks, none of them run, two of which fail; and its content.
    pub(crate) static FAILURES: LazyLock<(String, Content)> = LazyLock::new(|| {
        let measured = |id| match id {
            "nordtvedt-form" => Ok(Measured::new(f64::NAN, "worst at <b>here</b> & there")),
            "forced-precession-direction" => Err("panicked: <script>alert(1)</script>".to_owned()),
            _ => Ok(Measured::new(0.0, "")),
        };
        let outcome = |check: &Check| {
            let measured = measured(check.id);
            Outcome { passed: measured.as_ref().is_ok_and(|m| !m.figure.is_nan()), measured, seconds: 1.25 }
        };
        let results: Vec<_> = twofold_verify::checks::all().into_iter().map(|check| (check, outcome(&check))).collect();
        let figures: Vec<Figure> = OF_THE_PAPER.iter().map(|fixture| (**fixture).clone()).collect();
        let golden = crate::figures::golden_tables(&figures).expect("numbers");
        let content = Content { results, seconds: 1.0, golden, figures, environment: environment() };
        (page(&content).expect("a page"), content)
    });

    fn values<'p>(page: &'p str, attribute: &str) -> Vec<&'p str> {
        let start = format!(" {attribute}=\"");
        let parts = page.split(start.as_str()).skip(1);
        parts.filter_map(|rest| rest.split('"').next()).collect()
    }

    #[test]
    fn failures_stand_on_top_escaped_and_links_lead_somewhere() {
        let (page, content) = &*FAILURES;
        let top = page.split("<section").next().expect("a beginning");
        for part in [
            format!("2 of {} checks FAIL", content.results.len()),
            "#check-nordtvedt-form".to_owned(),
            "#claim-opposite-forced-precession".to_owned(),
            "worst at &lt;b&gt;here&lt;/b&gt; &amp; there".to_owned(),
            "panicked: &lt;script&gt;alert(1)&lt;/script&gt;".to_owned(),
        ] {
            assert!(top.contains(&part), "no {part} at the top");
        }
        assert!(!page.contains("<script"));

        let all = values(page, "id");
        let ids: BTreeSet<_> = all.iter().copied().collect();
        assert_eq!(all.len(), ids.len(), "an id is there twice");
        for link in values(page, "href") {
            assert!(link.strip_prefix('#').is_some_and(|id| ids.contains(id)), "a link to {link}, which is not there");
        }
        assert!(values(page, "src").is_empty() && !page.contains("@import"), "something from elsewhere");
        for (check, _) in &content.results {
            assert!(ids.contains(format!("check-{}", check.id).as_str()), "{} is not on the page", check.id);
        }
        for number in 1..=79 {
            assert!(ids.contains(format!("eq-{number}").as_str()), "({number}) is not on the page");
        }
    }

    /// The element with this id, to the end of its article or row.
    fn part<'p>(page: &'p str, id: &str, end: &str) -> &'p str {
        let start = page.find(&format!(" id=\"{id}\"")).unwrap_or_else(|| panic!("no {id}"));
        page[start..].split(end).next().expect("a part")
    }

    /// Counts at the top, and links from each part to those that name it.
    #[test]
    fn the_page_counts_what_it_has_and_links_both_ways() {
        let (page, content) = &*FAILURES;
        for verdict in ["confirmed", "differs", "derived"] {
            let lines = content.golden.iter().flat_map(|table| &table.lines);
            let count = lines.filter(|line| line.verdict() == verdict).count();
            assert!(page.contains(&format!("<a href=\"#golden\">{count} {verdict}</a>")), "{count} {verdict}");
        }
        for table in &content.golden {
            let prints = table.lines.iter().any(|line| line.printed != Printed::No);
            assert_eq!(part(page, &cross_reference::golden(table.name), "</table>").contains(">Printed</th>"), prints);
        }
        let mut numbered = 0;
        for claim in twofold_verify::claims::claims() {
            let (id, article) =
                (cross_reference::claim(claim.id), part(page, &cross_reference::claim(claim.id), "</article>"));
            let fails = |check: &&&str| ["nordtvedt-form", "forced-precession-direction"].contains(check);
            let failures = claim.checks.iter().filter(fails).count();
            assert_eq!(article.matches("<b class=\"fail\">FAIL</b>").count(), failures, "{article}");
            assert!(failures == 0 || article.contains("void, a check that it rests on fails"), "{article}");
            let link = format!("<a href=\"#{id}\">{}</a>", claim.id);
            for check in claim.checks {
                assert!(part(page, &cross_reference::check(check), "</tr>").contains(&link), "{check} {link}");
            }
            for table in claim.golden {
                let table = cross_reference::golden(table);
                assert!(part(page, &table, "</article>").contains(&link), "{table} {link}");
            }
            // A claim placed in Eq. (25) is named at that equation.
            let number = claim.place.split_once("Eq. (").and_then(|(_, rest)| rest.split(')').next()?.parse().ok());
            if let Some(number) = number {
                numbered += 1;
                let equation = cross_reference::equation(number);
                assert!(article.contains(&format!("<a href=\"#{equation}\">({number})</a>")), "{article}");
                assert!(part(page, &equation, "</article>").contains(&link), "{equation} {link}");
            }
        }
        assert!(numbered > 10, "{numbered}");
        let claim = part(page, "claim-beyond-leading-order", "</article>");
        assert!(claim.contains("href=\"#figure-method-regimes\""), "{claim}");
        for (check, _) in &content.results {
            let link = format!("href=\"#{}\"", cross_reference::check(check.id));
            for number in check.equations {
                let article = part(page, &cross_reference::equation(*number), "</article>");
                assert!(article.contains(&link), "({number}) does not name {}", check.id);
            }
        }
        let mut named = 0;
        for id in values(page, "id").into_iter().filter(|id| id.starts_with("discrepancy-")) {
            // Up to the next heading, or to the end of the section.
            let text = part(page, id, "<h").split("</section>").next().expect("a part");
            for equation in values(text, "href").into_iter().filter(|link| link.starts_with("#eq-")) {
                named += 1;
                let article = part(page, &equation[1..], "</article>");
                assert!(article.contains(&format!("href=\"#{id}\"")), "{equation} does not name {id}");
            }
        }
        assert!(named > 20, "{named}");
        // Names of checks, of golden tables and of discrepancies are links in a text.
        let text = part(page, "discrepancies", "</section>");
        let in_text = |name: &str, id: String| text.contains(&format!("<a href=\"#{id}\"><code>{name}</code></a>"));
        let checks = content.results.iter().filter(|(check, _)| in_text(check.id, cross_reference::check(check.id)));
        let tables = content.golden.iter().filter(|table| in_text(table.name, cross_reference::golden(table.name)));
        assert!(checks.count() > 50 && tables.count() > 2);
        let (mut remarks, source) = (0, include_str!("../../data/equations.tex"));
        for line in source.lines().filter_map(|line| line.strip_prefix("% (")) {
            let (equation, rest) = line.split_once(')').expect("a number");
            let Some((_, rest)) = rest.split_once("(discrepancy ") else { continue };
            let (number, _) = rest.split_once(')').expect("a number");
            let article = part(page, &cross_reference::equation(equation.parse().expect("a number")), "</article>");
            let link = format!("(<a href=\"#discrepancy-{number}\">discrepancy {number}</a>)");
            assert!(article.contains(&link), "({equation}) {link}");
            remarks += 1;
        }
        assert!(remarks > 5, "{remarks}");
        // The golden table of a figure links to it.
        let drawn = content.figures.iter().filter(|figure| {
            let table = cross_reference::golden(&format!("figure_{}", figure.name.replace('-', "_")));
            page.contains(&format!(" id=\"{table}\""))
                && part(page, &table, "</article>")
                    .contains(&format!("href=\"#{}\"", cross_reference::figure(&figure.name)))
        });
        assert!(drawn.count() > 3);
        // Captions name equations too.
        let equation = part(page, "eq-57", "</article>");
        assert!(equation.contains("href=\"#figure-pulse-series\""), "{equation}");
    }

    /// The entries of the column with this name, row by row.
    fn column<'p>(article: &'p str, name: &str) -> Vec<&'p str> {
        let start = format!(" data-label=\"{name}\">");
        article.split(start.as_str()).skip(1).filter_map(|rest| rest.split("</td>").next()).collect()
    }

    #[test]
    fn the_columns_of_the_page_hold_what_their_heads_say() {
        let (page, content) = &*FAILURES;
        assert_eq!(column(page, "Time [s]"), vec!["1.250"; content.results.len()]);
        let mut apart = 0;
        for table in &content.golden {
            let article = part(page, &cross_reference::golden(table.name), "</article>");
            let typeset = |text: String| typography::typeset(&text).into_string();
            let [printed, ours]: [Vec<_>; 2] = [
                table.lines.iter().map(|line| typeset(line.printed_text())).collect(),
                table.lines.iter().map(|line| typeset(line.ours_text())).collect(),
            ];
            assert_eq!(column(article, "Ours"), ours, "{}", table.name);
            if table.lines.iter().any(|line| line.printed != Printed::No) {
                assert_eq!(column(article, "Printed"), printed, "{}", table.name);
                apart += usize::from(printed != ours);
            }
        }
        assert!(apart > 3, "{apart}");
        assert!(
            page.contains(&format!("{} in 1.0 s", content.results.len())),
            "the time that all checks took together"
        );
        // The golden table of a figure has its name, with underscores.
        let mut linked = 0;
        for figure in &content.figures {
            let article = part(page, &cross_reference::figure(&figure.name), "</article>");
            for table in
                content.golden.iter().filter(|table| table.name.replace('_', "-") == format!("figure-{}", figure.name))
            {
                assert!(
                    article.contains(&format!("href=\"#{}\"", cross_reference::golden(table.name))),
                    "{}",
                    table.name
                );
                linked += 1;
            }
        }
        assert!(linked > 3, "{linked}");
        // Each form of an equation appears with the word before its remark in the source.
        let source = include_str!("../../data/equations.tex");
        for (word, name) in [("used", "Used"), ("corrected", "Corrected"), ("note", "Note")] {
            let written =
                source.lines().filter(|line| line.starts_with("% (") && line.contains(&format!(") {word}: ")));
            let shown = page.matches(&format!("<div class=\"form {word}\"><p><b>{name}. </b>")).count();
            assert_eq!(shown, written.count(), "{word}");
            assert!(shown > 0, "{word}");
        }
    }

    /// One failing check of several is enough.
    #[test]
    fn a_verdict_is_void_if_any_of_its_checks_fails() {
        let claim =
            twofold_verify::claims::claims().find(|claim| claim.checks.len() > 1).expect("a claim of two checks");
        for failing in claim.checks.iter().map(Some).chain([None]) {
            let of_claim = twofold_verify::checks::all()
                .into_iter()
                .filter(|check| claim.checks.contains(&check.id))
                .map(|check| {
                    let measured = Ok(Measured::new(0.0, ""));
                    let passed = failing.is_none_or(|id| *id != check.id);
                    (check, Outcome { passed, measured, seconds: 0.0 })
                });
            let results = of_claim.collect();
            let content =
                Content { results, seconds: 0.0, golden: Vec::new(), figures: Vec::new(), environment: Vec::new() };
            assert_eq!(claims::is_void(claim, &content), failing.is_some(), "{failing:?}");
        }
    }

    #[test]
    fn the_page_tells_on_what_it_was_made() {
        let facts: Vec<_> = environment().into_iter().map(|(name, _)| name).filter(|name| *name != "Source").collect();
        assert_eq!(facts, ["Version", "Compiler", "Target", "Processors", "Date and time"]);
    }

    #[test]
    fn nothing_private_is_on_the_page() {
        let (page, _) = &*FAILURES;
        for variable in ["HOME", "USER", "HOSTNAME", "CARGO_MANIFEST_DIR", "PWD"] {
            if let Some(value) = std::env::var(variable).ok().filter(|value| value.len() > 5) {
                assert!(!page.contains(&value), "{variable} is on the page");
            }
        }
    }
}
