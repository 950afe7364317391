//! Errors in a file: the place in its text, and how it is shown.

use std::fmt;
use std::ops::Range;

/// An error at a place in the text that is being read; becomes a [`SceneError`] with [`SceneError::in_text`].
#[derive(Debug)]
pub(crate) struct Fault {
    /// Byte range in the text, if the error has a place.
    pub(crate) span: Option<Range<usize>>,
    /// Key, value and allowed values.
    pub(crate) message: String,
}

impl Fault {
    pub(crate) fn at(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { span: Some(span), message: message.into() }
    }
}

/// A scene, or a table of pulsars, that cannot be used: file, place, key, value and allowed values.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError {
    file: String,
    place: Option<Place>,
    message: String,
}

#[derive(Debug, Clone, PartialEq)]
struct Place {
    line: usize,
    column: usize,
    /// The line of the file, shortened, and the marked characters in it.
    excerpt: Option<(String, Range<usize>)>,
}

/// Longest line of a file that is shown under a message.
const LONGEST_EXCERPT: usize = 100;

impl SceneError {
    /// An error for the file as a whole.
    pub fn of_file(file: &str, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), place: None, message: message.into() }
    }

    pub(crate) fn in_text(file: &str, text: &str, fault: Fault) -> Self {
        let place = fault.span.map(|span| Place::of(text, span));
        Self { file: file.to_owned(), place, message: fault.message }
    }
}

impl Place {
    fn of(text: &str, span: Range<usize>) -> Self {
        let mut start = span.start.min(text.len());
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let column = text[line_start..start].chars().count();
        let line = text[line_start..].lines().next().unwrap_or("").replace('\t', " ");
        let line = line.replace(char::is_control, "\u{fffd}");
        let length = line.chars().count();
        let marked = text.get(start..span.end).map_or(1, |s| s.lines().next().unwrap_or("").chars().count()).max(1);
        let excerpt =
            (length <= LONGEST_EXCERPT).then(|| (line, column..(column + marked).min(length.max(column + 1))));
        Place { line: text[..line_start].matches('\n').count() + 1, column: column + 1, excerpt }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(place) = &self.place {
            write!(f, ":{}:{}", place.line, place.column)?;
        }
        write!(f, ": {}", self.message)?;
        if let Some(Place { line, excerpt: Some((text, marked)), .. }) = &self.place {
            let margin = line.to_string().len();
            write!(f, "\n{:margin$} |\n{line} | {text}\n{:margin$} | ", "", "")?;
            write!(f, "{:skip$}{}", "", "^".repeat(marked.len()), skip = marked.start)?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}

impl From<SceneError> for String {
    fn from(error: SceneError) -> Self {
        error.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error message for the bytes `span` of a text, with the reason `why`.
    fn message(text: &str, span: Range<usize>) -> String {
        SceneError::in_text("sheet.toml", text, Fault::at(span, "why")).to_string()
    }

    /// Below the line there are as many marks as there are characters, at least one, and none beyond the end of the line.
    #[test]
    fn what_is_refused_is_marked_in_its_line() {
        assert_eq!(message("a = 1\nbc = 23\n", 11..13), "sheet.toml:2:6: why\n  |\n2 | bc = 23\n  |      ^^");
        // A value of two lines is marked in its first.
        assert_eq!(message("a = [1,\n2]\n", 4..10), "sheet.toml:1:5: why\n  |\n1 | a = [1,\n  |     ^^^");
        // An empty range, as for a missing value at the end of the line, and one beyond the end of the text.
        assert_eq!(message("a =", 3..3), "sheet.toml:1:4: why\n  |\n1 | a =\n  |    ^");
        assert_eq!(message("a =", 7..9), "sheet.toml:1:4: why\n  |\n1 | a =\n  |    ^");
        assert_eq!(message("abc", 1..2), "sheet.toml:1:2: why\n  |\n1 | abc\n  |  ^");
        // Inside a character of two bytes: the mark is at its beginning.
        assert_eq!(message("\u{e9}\u{e9}x", 3..4), "sheet.toml:1:2: why\n  |\n1 | \u{e9}\u{e9}x\n  |  ^");
        assert_eq!(message("\u{e9}\u{e9}x", 0..1), "sheet.toml:1:1: why\n  |\n1 | \u{e9}\u{e9}x\n  | ^");
        // A tab is shown as one space, so that the marks stand below what they mean on any screen.
        assert_eq!(message("a\t= 23", 4..6), "sheet.toml:1:5: why\n  |\n1 | a = 23\n  |     ^^");
        // The mark would cover two characters, of which the line has one.
        assert_eq!(message("a\r\nb", 0..2), "sheet.toml:1:1: why\n  |\n1 | a\n  | ^");
    }

    #[test]
    fn lines_are_shown_up_to_a_hundred_characters() {
        for (length, shown) in [(100, true), (101, false)] {
            let text = "x".repeat(length);
            assert_eq!(message(&text, 0..1).contains(&text), shown, "{length}");
        }
    }
}
