//! The light markup of labels and captions: `*t*` italic, `**m**` bold, `_{c}` and `^{-1}` below and above the line; what follows a backslash is itself.
//!
//! Labels in pictures become `<tspan>`s, captions Markdown or HTML; a name in a table loses its markup.

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Run {
    pub(super) text: String,
    pub(super) italic: bool,
    pub(super) bold: bool,
    pub(super) level: Level,
    /// A character that stands after a backslash.
    pub(super) is_literal: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    Line,
    Below,
    Above,
}

pub(super) fn runs(text: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut run = Run { text: String::new(), italic: false, bold: false, level: Level::Line, is_literal: false };
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if let Some(literal) = rest.strip_prefix('\\').and_then(|rest| rest.chars().next()) {
            let before = std::mem::take(&mut run.text);
            let parts = [(before, false), (literal.to_string(), true)].into_iter().filter(|(text, _)| !text.is_empty());
            runs.extend(parts.map(|(text, is_literal)| Run { text, is_literal, ..run.clone() }));
            rest = &rest[1 + literal.len_utf8()..];
            continue;
        }
        let mut next = run.clone();
        let taken = if rest.starts_with("**") {
            next.bold = !run.bold;
            2
        } else if rest.starts_with('*') {
            next.italic = !run.italic;
            1
        } else if rest.starts_with("_{") {
            next.level = Level::Below;
            2
        } else if rest.starts_with("^{") {
            next.level = Level::Above;
            2
        } else if run.level != Level::Line && first == '}' {
            next.level = Level::Line;
            1
        } else {
            run.text.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        rest = &rest[taken..];
        next.text.clear();
        let finished = std::mem::replace(&mut run, next);
        if !finished.text.is_empty() {
            runs.push(finished);
        }
    }
    if !run.text.is_empty() {
        runs.push(run);
    }
    runs
}

/// The text without its markup, for names in tables: `s^{XX}` becomes `s^XX`.
pub fn plain(text: &str) -> String {
    let sign = |level| match level {
        Level::Line => "",
        Level::Below => "_",
        Level::Above => "^",
    };
    runs(text).iter().map(|run| format!("{}{}", sign(run.level), run.text)).collect()
}

pub fn html(text: &str) -> String {
    let wrapped = |inner: String, tag: &str, wanted: bool| {
        if wanted { format!("<{tag}>{inner}</{tag}>") } else { inner }
    };
    let mut html = String::new();
    for run in runs(text) {
        let inner = wrapped(wrapped(escaped(&run.text), "i", run.italic), "b", run.bold);
        let inner = wrapped(inner, "sub", run.level == Level::Below);
        html += &wrapped(inner, "sup", run.level == Level::Above);
    }
    html
}

/// The text as Markdown, which has the same marks for italic and bold.
pub fn markdown(text: &str) -> String {
    let mut markdown = String::new();
    for run in runs(text) {
        let mark = ["", "*", "**", "***"][usize::from(run.italic) + 2 * usize::from(run.bold)];
        let inner = if run.is_literal { format!("\\{}", run.text) } else { run.text };
        markdown += &match run.level {
            Level::Line => format!("{mark}{inner}{mark}"),
            Level::Below => format!("<sub>{mark}{inner}{mark}</sub>"),
            Level::Above => format!("<sup>{mark}{inner}{mark}</sup>"),
        };
    }
    markdown
}

/// A text that is not markup, with a backslash before what would be some here or in Markdown.
pub fn literal(text: &str) -> String {
    let is_mark = |c: &char| "\\`*_^{}<>[]&".contains(*c);
    text.chars().flat_map(|c| Some('\\').filter(|_| is_mark(&c)).into_iter().chain([c])).collect()
}

/// The text with the special characters of XML and HTML replaced.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Whether nothing is open at the end of a text: a caption must close its italics, bold letters and indices.
#[cfg(test)]
pub(super) fn is_balanced(text: &str) -> bool {
    // A visible last letter shows the style that the text ends in.
    let ended = format!("{text}.");
    let last_is_plain = runs(&ended).last().is_some_and(|run| !run.italic && !run.bold && run.level == Level::Line);
    last_is_plain && runs(text).iter().all(|run| !run.text.contains(['*', '_', '^']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_plain_text_html_and_markdown() {
        let text = "*a*^{(1)} < *t*_{c}^{-1}, **m**·**n**";
        assert_eq!(plain(text), "a^(1) < t_c^-1, m·n");
        assert_eq!(html(text), "<i>a</i><sup>(1)</sup> &lt; <i>t</i><sub>c</sub><sup>-1</sup>, <b>m</b>·<b>n</b>");
        assert_eq!(markdown(text), "*a*<sup>(1)</sup> < *t*<sub>c</sub><sup>-1</sup>, **m**·**n**");
        assert_eq!(plain("a } b { c"), "a } b { c");
    }

    #[test]
    fn what_is_no_markup_stays_as_it_is() {
        let name = r"my*star*_{x}^{<b>}\&`[";
        let text = format!("*a* {} **b**", literal(name));
        assert_eq!(plain(&text), format!("a {name} b"));
        assert_eq!(html(&text), format!("<i>a</i> {} <b>b</b>", escaped(name)));
        assert_eq!(markdown(&text), r"*a* my\*star\*\_\{x\}\^\{\<b\>\}\\\&\`\[ **b**");
        assert_eq!([literal("tp-1"), plain("a\\")], ["tp-1", "a\\"]);
    }

    #[test]
    fn open_marks_are_seen() {
        assert!(is_balanced("*a*_{*b*}, **c**"));
        for open in ["line *M**N* is", "*a", "**a", "a_{b"] {
            assert!(!is_balanced(open), "{open}");
        }
    }
}
