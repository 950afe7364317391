//! Numbers from choices, estimates and branches at a few generic places, as snapshots for review in `golden/values/`.
//!
//! Other tests show that the results are right, by derivatives, references and bounds. These tests keep them fixed: a factor in an error
//! estimate, a cost, the text of a plan, the sign of a rarely used branch.

mod motions;
mod observables;
mod plans;
mod scene;
mod table;
mod tori;
