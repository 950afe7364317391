//! Reasons why something cannot be computed for a scene.

use std::fmt;

use twofold::Error;

/// Reasons why something cannot be computed for a scene as requested.
#[derive(Debug, Clone, PartialEq)]
pub enum Refusal {
    /// The request or the scene does not allow the computation; a sentence.
    Input(String),
    /// The model cannot compute it.
    Model(Error),
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::Model(error)
    }
}

impl From<Refusal> for String {
    fn from(refusal: Refusal) -> Self {
        refusal.to_string()
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(why) => f.write_str(why),
            Self::Model(error) => error.fmt(f),
        }
    }
}
