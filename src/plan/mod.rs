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
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! use twofold::dynamics::regular_equations::BodyState as State;
//! use twofold::plan::{
//!     Cost, Counted, Method, Output, Plan, Promise, Request, StateFunction, gradient, gradient_in_parts,
//! };
//! use twofold::parameters::{Parameter, Parameters};
//! use twofold::propagation::{AxisMotion, Motion};
//! use twofold::scalar::Real;
//!
//! // n at a thousand times: the plan says by which method, and what it costs.
//! let request = Request::new(&[Output::SymmetryAxis], (0.0, 100.0), 1000, 1e-12);
//! let plan = Plan::new(&star, &s.tensor(), &state, &request)?;
//! let method = plan.method.expect("n takes a motion");
//! assert!(Cost::of(method, plan.state).setup <= Cost::with_derivatives(method, plan.state, 3).setup);
//! // Steps are chosen for an accuracy, which is a goal and no bound.
//! let promise = plan.prediction.expect("there is a method").promise;
//! assert!(matches!(promise, Promise::Goal(share) if share > 0.9));
//! let motion = Counted::new(plan.axis_motion(&star, &s.tensor(), &state)?);
//! motion.axis_state(42.0)?;
//! assert_eq!(motion.evaluations().axis_evaluations, 1.0);
//!
//! // The height of n and its derivatives by two of the parameters.
//! struct Height;
//! impl StateFunction for Height {
//!     fn len(&self) -> usize {
//!         1
//!     }
//!     fn values<S: Real>(&self, _: &RigidSpheroid<S>, _: &Matrix3<S>, state: &State<S>, values: &mut [S]) {
//!         values[0] = state.axis.z;
//!     }
//! }
//! let derivatives = vec![Parameter::S(2, 2), Parameter::Beta];
//! let plan = Plan::new(&star, &s.tensor(), &state, &Request { derivatives, method: Some(Method::Taylor), ..request })?;
//! let start = Parameters::new(star, s.tensor(), angles, rates);
//! let found = gradient(&plan, &start, &Height, &[0.0])?;
//! assert!((found.jacobians[0][(0, 1)] + angles.beta.sin()).abs() < 1e-14);
//! assert_eq!(found.values, gradient_in_parts(&plan, &start, &Height, &[[0.0, 0.0]])?.values);
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

pub use candidate::{Candidate, Prediction, Promise};
pub use cost::{Cost, MACHINE};
pub use decision::{Plan, Skipped};
pub use gradient::{Gradient, StateFunction, gradient, gradient_in_parts};
pub use method::Method;
pub use motion::{PlannedAxisMotion, PlannedMotion};
pub use output::{Evaluations, Need, Output, State};
pub use request::{Request, Samples};
pub use work::{Counted, Work};
