//! TOML files of any kind: read with their size bounded, parsed, every refusal with file and place.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use toml::Spanned;
use toml::de::DeTable;

use super::LARGEST_FILE;
use super::error::{Fault, SceneError};
use super::section::{Section, listed, nearest};

/// What a file is for, in the words of the messages.
pub(crate) struct FileKind {
    /// With its article: `a scene`.
    pub(crate) name: &'static str,
    /// Those that come with the command and can be named; may be none.
    pub(crate) built_in: Option<BuiltInNames>,
}

/// Names that stand for files inside the program.
#[derive(Clone, Copy)]
pub(crate) struct BuiltInNames {
    /// The names.
    pub(crate) names: fn() -> Vec<&'static str>,
    /// The command that lists them.
    pub(crate) listed_by: &'static str,
}

impl FileKind {
    /// The text of a file, with the size bounded while reading, so that a device or pipe cannot fill the memory.
    pub(crate) fn read(&self, path: &str) -> Result<String, SceneError> {
        let refuse = |message: String| SceneError::of_file(path, message);
        let name = self.name;
        if Path::new(path).is_dir() {
            let or = self.built_in.map(|b| format!(" or a built-in name, see `{}`", b.listed_by)).unwrap_or_default();
            return Err(refuse(format!("is a directory: {name} is a TOML file{or}")));
        }
        let file = File::open(path).map_err(|error| {
            let Some(BuiltInNames { names, .. }) = self.built_in else {
                return refuse(format!("is not a readable file ({error})"));
            };
            let (names, noun) = (names(), name.trim_start_matches("a "));
            let guess = match nearest(path, &names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the built-in {noun}s are {}", listed(&names)),
            };
            refuse(format!("neither a built-in {noun} nor a readable file ({error}); {guess}"))
        })?;
        let mut bytes = Vec::new();
        file.take(LARGEST_FILE + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| refuse(format!("cannot be read: {error}")))?;
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(refuse(format!("is longer than {} MiB, the most that is read", LARGEST_FILE >> 20)));
        }
        String::from_utf8(bytes).map_err(|error| {
            let byte = error.utf8_error().valid_up_to() + 1;
            refuse(format!("is not UTF-8 text (byte {byte}): {name} is a TOML file"))
        })
    }

    /// What `read` makes of the document that is the text of `file`.
    pub(crate) fn parse<T>(
        &self,
        file: &str,
        text: &str,
        read: impl FnOnce(&Section<'_>) -> Result<T, Fault>,
    ) -> Result<T, SceneError> {
        let table = self.table(file, text)?;
        read(&Section::document(text, &table, self.name)).map_err(|fault| SceneError::in_text(file, text, fault))
    }

    /// The document that is the text of `file`.
    pub(crate) fn table<'t>(&self, file: &str, text: &'t str) -> Result<DeTable<'t>, SceneError> {
        DeTable::parse(text).map(Spanned::into_inner).map_err(|syntax| {
            let message = syntax.message().trim().replace('\n', ", ");
            let fault = Fault { span: syntax.span(), message: format!("not TOML: {message}") };
            SceneError::in_text(file, text, fault)
        })
    }
}
