//! Verification of the model `twofold`: checks, golden numbers, scene files and the command `twofold`.

pub mod check;
pub mod checks;
pub mod fit;
pub mod golden;
pub mod paper_examples;
pub mod physical_domain;
pub mod reference;
