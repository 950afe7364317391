//! The paper's equations as LaTeX, from `command/data/equations.tex`.

/// The kind of an entry; the file describes the kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Printed,
    Corrected,
    Used,
    Note,
}

#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) number: u8,
    pub(super) form: Form,
    /// A line of Markdown, often empty.
    pub(super) remark: &'static str,
    pub(super) latex: String,
}

pub(super) fn entries() -> Result<Vec<Entry>, String> {
    let mut entries: Vec<Entry> = Vec::new();
    for line in include_str!("../../data/equations.tex").lines() {
        if let Some(header) = line.strip_prefix("% (") {
            entries.push(entry(header).ok_or_else(|| format!("equations.tex: `{line}` is not a header"))?);
        } else if let (false, Some(entry)) = (line.starts_with('%'), entries.last_mut()) {
            entry.latex += line;
            entry.latex.push('\n');
        }
    }
    Ok(entries)
}

/// As in `25) used: REMARK`.
fn entry(header: &'static str) -> Option<Entry> {
    let (number, rest) = header.split_once(") ")?;
    let (form, remark) = rest.split_once(": ").unwrap_or((rest, ""));
    let form = match form {
        "printed" => Form::Printed,
        "corrected" => Form::Corrected,
        "used" => Form::Used,
        "note" => Form::Note,
        _ => return None,
    };
    Some(Entry { number: number.parse().ok()?, form, remark, latex: String::new() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::html_report::latex;

    #[test]
    fn every_numbered_equation_is_printed_once_and_every_entry_is_latex() {
        let entries = entries().expect("the file can be read");
        let printed: Vec<u8> = entries.iter().filter(|e| e.form == Form::Printed).map(|e| e.number).collect();
        assert_eq!(printed, (1..=79).collect::<Vec<u8>>());
        assert!(entries.iter().map(|e| e.number).is_sorted());
        for entry in &entries {
            assert_eq!(entry.latex.trim().is_empty(), entry.form == Form::Note, "({}) {:?}", entry.number, entry.form);
            if let Err(error) = latex::displayed(&entry.latex) {
                panic!("({}) {:?}: {error}", entry.number, entry.form);
            }
            assert!(entry.form == Form::Printed || !entry.remark.is_empty(), "({}) says not what it is", entry.number);
        }
    }

    #[test]
    fn a_header_that_is_none_is_refused() {
        assert!(entry("25) printed").is_some() && entry("25) used: a: b").is_some_and(|e| e.remark == "a: b"));
        for wrong in ["25 printed", "25) drawn", "x) printed", "256) printed"] {
            assert!(entry(wrong).is_none(), "{wrong}");
        }
    }
}
