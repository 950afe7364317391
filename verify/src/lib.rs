//! Verification of the model `twofold`: checks, golden numbers, scene files and the command `twofold`.

pub mod bench;
pub mod check;
pub mod checks;
pub mod claims;
pub mod columns;
pub mod command;
pub mod compare;
pub mod conditioned;
pub mod derivation;
pub mod double_double;
pub mod dual;
pub mod equation_table;
pub mod error_scenes;
mod estimated_error;
pub mod eta;
pub mod figures;
pub mod fit;
pub mod fuzzing;
pub mod given_states;
pub mod golden;
pub mod html_report;
pub mod identity;
pub mod independent_taylor;
pub mod inference;
pub mod mean_scenes;
mod operators;
pub mod paper_examples;
pub mod physical_domain;
pub mod prime_field;
pub mod public_items;
pub mod pulsar_table;
pub mod pulsar_timing;
pub(crate) mod pulse_series;
pub mod random;
pub mod reference;
pub mod report;
pub mod scene_file;
pub mod second_integrator;
pub mod significant;
pub mod stability;
pub mod sweep;
pub mod symbolic;
pub mod trajectory;

/// The example of the README, run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
