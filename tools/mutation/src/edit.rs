//! Edits of a text that nest: what is put before and after a range, and what replaces one.

/// One place of a source file where the code can be made wrong, with the variants of it.
pub struct Site {
    /// What is wrong in each variant, for people.
    pub variants: Vec<String>,
    /// Number of the first variant; the others follow.
    pub first: u32,
    /// Line of the original file, from 1.
    pub line: usize,
    /// The function it stands in.
    pub function: String,
    /// Range of the original text.
    pub range: (usize, usize),
}

/// What is written at a place of the original text.
pub struct Edit {
    /// Range of the original text that it takes the place of; empty for what is only put in.
    pub range: (usize, usize),
    /// The text; `\u{1}N\u{2}` and `\u{3}N\u{4}` enclose the code that belongs to variant N alone.
    pub text: String,
    pub site: usize,
    /// How deep the site lies in others.
    pub depth: usize,
    /// Whether it closes a range, so that inner ones come first.
    pub closes: bool,
}

/// A range of the written text with the site it came from, and the variant if it belongs to one alone.
pub struct Origin {
    /// Start and end in bytes of the written text.
    pub range: (usize, usize),
    pub site: usize,
    /// Variant, counted within the site.
    pub variant: Option<usize>,
}

/// The text with all edits, and where each site came to lie.
pub fn apply(text: &str, edits: &[Edit], sites: usize) -> (String, Vec<Origin>) {
    let mut order: Vec<&Edit> = edits.iter().collect();
    // At one place: what closes (inner first), then what opens (outer first), then what replaces.
    order.sort_by_key(|e| {
        let kind = if e.closes { 0 } else { 1 + usize::from(e.range.0 != e.range.1) };
        let depth = if e.closes { -(e.depth as i64) } else { e.depth as i64 };
        (e.range.0, kind, depth)
    });
    let (mut out, mut origins, mut at) = (String::with_capacity(2 * text.len()), Vec::new(), 0);
    let mut opened = vec![usize::MAX; sites];
    for edit in order {
        assert!(edit.range.0 >= at, "edits overlap at {}: {}", edit.range.0, edit.text);
        out.push_str(&text[at..edit.range.0]);
        at = edit.range.1;
        opened[edit.site] = opened[edit.site].min(out.len());
        let mut starts = Vec::new();
        let mut rest = edit.text.as_str();
        while let Some(mark) = rest.find(['\u{1}', '\u{2}']) {
            out.push_str(&rest[..mark]);
            if rest.as_bytes()[mark] == 1 {
                let digits: String = rest[mark + 1..].chars().take_while(char::is_ascii_digit).collect();
                starts.push((digits.parse::<usize>().expect("a variant"), out.len()));
                // One character ends the number.
                rest = &rest[mark + 2 + digits.len()..];
            } else {
                let (variant, start) = starts.pop().expect("opened before");
                origins.push(Origin { range: (start, out.len()), site: edit.site, variant: Some(variant) });
                rest = &rest[mark + 1..];
            }
        }
        out.push_str(rest);
        if edit.closes || edit.range.0 != edit.range.1 {
            origins.push(Origin { range: (opened[edit.site], out.len()), site: edit.site, variant: None });
        }
    }
    out.push_str(&text[at..]);
    (out, origins)
}
