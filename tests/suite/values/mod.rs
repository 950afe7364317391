//! Numbers of choices, estimates and branches at a few generic places, as snapshots for review in `golden/values/`.
//!
//! What is right is shown elsewhere, by derivatives, references and bounds. Here it is held: a factor in an error estimate, a cost, the text of a
//! plan, the sign of a rarely used branch.

mod motions;
mod observables;
mod plans;
mod scene;
mod table;
mod tori;
