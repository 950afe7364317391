//! Verification of the model `twofold`: checks, derivations, references and golden numbers.

pub mod check;
pub mod checks;
pub mod claims;
pub mod derivation;
pub mod double_double;
pub mod dual;
pub mod equation_table;
pub mod error_scenes;
pub mod eta;
pub mod given_states;
pub mod golden;
pub mod identity;
pub mod independent_taylor;
pub mod magnitudes;
pub mod mean_scenes;
pub mod measured_order;
mod operators;
pub mod paper_examples;
pub mod physical_domain;
pub mod prime_field;
pub mod pulse_series;
pub mod random;
pub mod reference;
pub mod report;
pub mod second_integrator;
pub mod stability;
pub mod symbolic;
