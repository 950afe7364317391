//! Properties of the model, and tables that must stay up to date.

mod allocations;
mod arrival_times;
mod boundaries;
mod claims;
mod equations;
mod error_estimate;
mod exact_arithmetic;
mod first_crate;
mod higher_derivatives;
mod orientation_properties;
mod other_dynamics;
mod pulsars;
mod scenes;
mod stability;
mod values;
mod verification;
mod versions;
