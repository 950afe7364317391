//! Invariant tori of the motion: states with given first integrals, and the exact frequencies.
//!
//! `(n, L)` has the commuting integrals `H` and `K` ([`clebsch_integral`](crate::dynamics::first_integrals::clebsch_integral)), so it moves on
//! tori of two dimensions; the turn about `n`, moved by `L.n`, makes the third.

mod flow;
mod frequencies;
mod polynomial;
mod states;

pub use frequencies::{TorusFrequencies, torus_frequencies};
pub use states::{TorusStates, separatrix_motion, states_with_integrals};
