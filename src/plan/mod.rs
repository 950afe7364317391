//! Plans: for the requested outputs, what is computed, by which method, and what is skipped.
//!
//! ```text
//! outputs -> needs (state, evaluations) -> candidates (each method: is it applicable? its error? its work?)
//! -> the cheapest one that meets the tolerance -> a motion
//! ```
//!
//! A [`Plan`] is a decision, made before any work, that can be inspected ([`Plan::skipped`], [`Plan::considered`]); its
//! [`motion`](Plan::motion) carries it out. A new method requires a variant of [`Method`], a candidate (`candidate.rs`), its
//! costs (`cost.rs`) and an arm of the motions (`motion.rs`).
//!
//! # Example
//!
//! ```
//! use nalgebra::Matrix3;
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::parameters::{Parameter, Parameters};
//! use twofold::plan::{Output, Request, gradient};
//!
//! let (angles, rates) = (EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 }, EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 });
//! let (spheroid, coefficients) = (RigidSpheroid::in_units_of_tc(1.1), Matrix3::new(0.02, 0., 0., 0., 0.01, 0., 0., 0., -0.03));
//! let start = Parameters::new(spheroid, coefficients, angles, rates);
//! // n at a thousand times, with derivatives by two of the parameters: the plan says by which method, and what it costs.
//! let request = Request::new(&[Output::SymmetryAxis], (0.0, 100.0), 1000, 1e-12);
//! let plan = start.problem()?.plan(&Request { derivatives: vec![Parameter::S(2, 2), Parameter::Beta], ..request })?;
//! assert!(plan.method.is_some() && plan.prediction.is_some());
//! // The third row is that of n^Z = cos(beta), the second column that of beta.
//! let found = gradient(&plan, &start, &[0.0])?;
//! assert!((found.jacobians[0][(2, 1)] + angles.beta.sin()).abs() < 1e-14);
//! # Ok::<(), twofold::Error>(())
//! ```

mod candidate;
mod cost;
mod decision;
mod gradient;
mod method;
mod motion;
mod output;
mod request;
mod work;

pub use candidate::{Candidate, Memory, Prediction, Promise};
pub use cost::{Cost, MACHINE};
pub use decision::{Plan, Skipped};
pub(crate) use gradient::gradient_in_parts;
pub use gradient::{Gradient, gradient};
pub use method::Method;
pub use motion::{ErrorAtEnd, PlannedMotion};
pub use output::{Evaluations, Need, Output, State};
pub use request::Request;
pub use work::{Counted, Work};
