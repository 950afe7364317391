//! Captions from `command/data/captions.md`.

use std::fmt::Display;

const TEXT: &str = include_str!("../../data/captions.md");

#[derive(Debug, Clone)]
pub(crate) struct Caption {
    pub(crate) shows: String,
    pub(crate) parameters: String,
    pub(crate) method: String,
    pub(crate) says: String,
}

impl Caption {
    pub(crate) fn paragraphs(&self) -> [&str; 4] {
        [&self.shows, &self.parameters, &self.method, &self.says]
    }

    /// The caption called `name`; words replace the names after a dollar sign.
    pub(super) fn of(name: &str, words: &[(&str, String)]) -> Self {
        let [shows, parameters, method, says] =
            ["shows", "parameters", "method", "says"].map(|part| sentences(name, part, words));
        Self { shows, parameters, method, says }
    }
}

/// A name in a caption with its replacement.
pub(super) fn written<T: Display>((name, value): (&'static str, T)) -> (&'static str, String) {
    (name, value.to_string())
}

/// A part of the text about a figure; words replace the names after a dollar sign.
pub(super) fn sentences(name: &str, part: &str, words: &[(&str, String)]) -> String {
    let mut sections = TEXT.split("\n# ").skip(1).filter_map(|section| section.split_once('\n'));
    let (_, section) = sections.find(|(found, _)| *found == name).unwrap_or_else(|| panic!("nothing about {name}"));
    let start = format!("{part}: ");
    let found = section.split("\n\n").find_map(|paragraph| paragraph.trim_start().strip_prefix(start.as_str()));
    let text = found.unwrap_or_else(|| panic!("no {part} of {name}")).trim_end().replace('\n', " ");
    words.iter().fold(text, |text, (name, words)| text.replace(&format!("${name}"), words))
}
