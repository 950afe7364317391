//! The command `twofold`: arguments, progress, figures, report.

pub mod commands;
mod compare;
pub mod figures;
#[cfg(any(test, feature = "fuzzing"))]
pub mod fuzzing;
mod html_report;
mod text_table;

/// The example of the README, run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
