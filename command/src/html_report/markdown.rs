//! Pages of `docs/` as parts of the report.

use maud::{Markup, PreEscaped, html};
use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, TextMergeStream};

use super::cross_reference::{self, Index};
use super::latex;
use super::typography::typeset;

/// A page without its first heading. Numbered headings (`## 3. Title`) are discrepancies with ids; the targets that they name are noted in `index`.
pub(super) fn page(markdown: &str, index: &mut Index) -> Result<Markup, String> {
    let parser = Parser::new_ext(markdown, Options::ENABLE_TABLES | Options::ENABLE_MATH);
    let mut events = TextMergeStream::new(parser);
    let mut output = Vec::new();
    // Id and name of the section; whether the text is verbatim.
    let (mut section, mut verbatim) = (None::<(String, String)>, false);
    while let Some(event) = events.next() {
        let kept = match event {
            Event::Start(Tag::Heading { level: HeadingLevel::H1, .. }) => {
                heading(&mut events);
                continue;
            }
            Event::Start(Tag::Heading { .. }) => {
                let (title, number) = heading(&mut events);
                let id = number.as_deref().map(cross_reference::discrepancy);
                section = id.clone().zip(number.map(|number| format!("discrepancy {number}")));
                raw(html! { h3 id=[id] { (typeset(&title)) } })
            }
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                verbatim = true;
                Event::Start(Tag::Link { link_type, dest_url: destination(&dest_url).into(), title, id })
            }
            Event::Start(Tag::CodeBlock(_)) => {
                verbatim = true;
                event
            }
            Event::End(TagEnd::Link | TagEnd::CodeBlock) => {
                verbatim = false;
                event
            }
            Event::Start(Tag::Table(_)) => {
                output.push(raw(PreEscaped(r#"<div class="wide" tabindex="0">"#.to_owned())));
                event
            }
            Event::End(TagEnd::Table) => {
                output.push(event);
                raw(PreEscaped("</div>".to_owned()))
            }
            Event::Text(text) if !verbatim => {
                if let Some((id, label)) = &section {
                    index.note_text(&text, id, label);
                }
                raw(index.linked(&text))
            }
            Event::Code(name) => {
                let target = index.code(&name).filter(|_| !verbatim);
                if let (Some(target), Some((id, label))) = (&target, &section) {
                    index.note(target.clone(), id, label);
                }
                raw(match target {
                    Some(id) => html! { a href={ "#" (id) } { code { (*name) } } },
                    None => html! { code { (*name) } },
                })
            }
            Event::InlineMath(text) => raw(latex::inline(&text)?),
            Event::DisplayMath(text) => raw(latex::displayed(&text)?),
            // The pages contain no HTML of their own; any HTML is shown as text.
            Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
            other => other,
        };
        output.push(kept);
    }
    let mut html = String::new();
    pulldown_cmark::html::push_html(&mut html, output.into_iter());
    Ok(PreEscaped(html))
}

/// The numbers of a page's headings.
pub(super) fn numbers(markdown: &str) -> impl Iterator<Item = &str> {
    markdown.lines().filter_map(|line| line.strip_prefix("## ")).filter_map(heading_number)
}

/// One line of Markdown, without the enclosing paragraph.
pub(super) fn line(markdown: &str, index: &mut Index) -> Result<Markup, String> {
    let Markup { 0: html } = page(markdown, index)?;
    Ok(PreEscaped(html.trim().trim_start_matches("<p>").trim_end_matches("</p>").to_owned()))
}

/// The text of a heading up to its end, and its number.
fn heading<'a>(events: &mut impl Iterator<Item = Event<'a>>) -> (String, Option<String>) {
    let mut title = String::new();
    for event in events.by_ref() {
        match event {
            Event::End(TagEnd::Heading(_)) => break,
            Event::Text(text) | Event::Code(text) => title += &text,
            _ => {}
        }
    }
    let number = heading_number(&title).map(str::to_owned);
    (title, number)
}

/// `3` of `3. Title`.
fn heading_number(title: &str) -> Option<&str> {
    let (number, _) = title.split_once(". ")?;
    number.bytes().all(|byte| byte.is_ascii_digit()).then_some(number)
}

/// A link to another page of `docs/` becomes one to the corresponding part of the report.
fn destination(url: &str) -> String {
    match url.strip_suffix(".md") {
        Some(page) if !url.contains("://") => format!("#{page}"),
        _ => url.to_owned(),
    }
}

fn raw(markup: Markup) -> Event<'static> {
    Event::InlineHtml(CowStr::from(markup.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_gets_ids_links_and_maths_and_keeps_no_html() {
        let mut index = Index::default();
        for id in [cross_reference::check("order"), cross_reference::equation(25), cross_reference::discrepancy("2")] {
            index.add(id);
        }
        let text = "# Title\n\n## 2. Of beta\n\nBy (25), `order` and `a < b`: $\\beta$ <script>x</script> \
                    [there (25)](claims.md), [far](https://example.org/a.md), (25)\n\n    beta_0 (25)\n\n| a |\n|---|\n| b |\n";
        let html = page(text, &mut index).expect("Markdown").0;
        for part in [
            "<h3 id=\"discrepancy-2\">2. Of β</h3>",
            "<a href=\"#eq-25\">(25)</a>",
            "<a href=\"#check-order\"><code>order</code></a>",
            "<code>a &lt; b</code>",
            "<math><mi>β</mi></math>",
            "&lt;script&gt;",
            "<a href=\"#claims\">there (25)</a>",
            "<a href=\"https://example.org/a.md\">far</a>, <a href=\"#eq-25\">(25)</a>",
            "<code>beta_0 (25)\n</code>",
            "<div class=\"wide\" tabindex=\"0\"><table>",
            "</table>\n</div>",
        ] {
            assert!(html.contains(part), "no {part} in\n{html}");
        }
        assert!(!html.contains("Title"));
        assert_eq!(index.named_by("check-order", "discrepancy-")[0].0, "<a href=\"#discrepancy-2\">discrepancy 2</a>");
        assert_eq!(numbers(text).collect::<Vec<_>>(), ["2"]);
        assert_eq!(line("of $\\beta$", &mut index).expect("Markdown").0, "of <math><mi>β</mi></math>");
    }
}
