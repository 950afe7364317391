//! Why a scene, or another file of the command's, was refused, with the place in it.

use std::fmt;
use std::ops::Range;

/// A fault at a place of the text that is being read; becomes a [`SceneError`] with [`SceneError::in_text`].
#[derive(Debug)]
pub(crate) struct Fault {
    /// Bytes of the text, where the fault has a place.
    pub(crate) span: Option<Range<usize>>,
    /// Key, value and what is allowed.
    pub(crate) message: String,
}

impl Fault {
    pub(crate) fn at(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { span: Some(span), message: message.into() }
    }
}

/// A scene, or a table of pulsars, that cannot be used: file, place, key, value and what is allowed.
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
    /// The line as it stands in the file, shortened, and the marked characters in it.
    excerpt: Option<(String, Range<usize>)>,
}

/// Longest line of a file that is shown under a message.
const LONGEST_EXCERPT: usize = 100;

impl SceneError {
    /// A refusal of the file as a whole.
    pub fn of_file(file: &str, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), place: None, message: message.into() }
    }

    /// A refusal at a place of `text`.
    pub(crate) fn in_text(file: &str, text: &str, fault: Fault) -> Self {
        let place = fault.span.map(|span| Place::of(text, span));
        Self { file: file.to_owned(), place, message: fault.message }
    }

    /// Line and column, from one, where the fault has a place.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        self.place.as_ref().map(|place| (place.line, place.column))
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

impl From<SceneError> for String {
    fn from(error: SceneError) -> Self {
        error.to_string()
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
