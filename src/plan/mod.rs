//! Plans: from the outputs asked, what is computed, by which method, and what is left out.
//!
//! ```text
//! outputs -> needs (state, evaluations)  -> candidates (each method: may it? error? work?) -> the cheapest one that meets
//! the accuracy -> a motion
//! ```
//!
//! A [`Plan`] is a decision, made before any work, that can be read ([`Plan::skipped`], [`Plan::considered`]); its
//! [`motion`](Plan::motion) does what it says. A new method is a variant of [`Method`], a candidate (`candidate.rs`), its
//! costs (`cost.rs`) and an arm of the motions (`motion.rs`).

mod candidate;
mod cost;
mod decision;
mod gradient;
mod method;
mod motion;
mod output;
mod parameter;
mod request;
mod work;

pub use candidate::{Candidate, Prediction};
pub use cost::{Cost, MACHINE};
pub use decision::{Plan, Skipped};
pub use gradient::{Gradient, StateFunction, gradient, gradient_in_parts};
pub use method::Method;
pub use motion::{PlannedAxisMotion, PlannedMotion};
pub use output::{Evaluations, Need, Output, State};
pub use parameter::{Parameter, Start};
pub use request::{Request, Samples};
pub use work::{Counted, Work};
