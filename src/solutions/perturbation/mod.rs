//! Perturbation solutions about free precession (twofold) and about a stationary spin (single). Eqs. (27)-(34), (57).
//!
//! Two families, never to be mistaken for one another:
//!
//! * [`Perturbation::printed`] — the paper's Eqs. (30) `[sol2]`, (31) `[consdef]`, (33) `[sol3]` as printed. They define the
//!   paper's examples and curves. The twofold one is not right to first order: Eq. (29) `[eleq1]` lacks the term
//!   `a^2 sin^2(beta_0) beta1`, see [`linearised`].
//! * [`Perturbation::corrected_twofold`] — the solution of the full first-order equations. Its error is of second order.

mod constants;
mod initial_values;
pub mod linearised;
mod solution;

pub use constants::{Constants, Kind};
pub use initial_values::{constants_from_initial_values, initial_values};
pub use solution::{Perturbation, ShiftedRates, shifted_rates};
