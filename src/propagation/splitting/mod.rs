//! Motion of `(n, L)` by splitting its Hamiltonian into an exact rotation of `n` about `L` and an exact kick of `L` at constant `n`.
//!
//! # Example
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{AxisState, Problem, RigidSpheroid};
//! use twofold::propagation::{Motion, splitting::SRKN_14A};
//!
//! let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.1, 0.2, 1.3) };
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?;
//! let best = problem.splitting((0.0, 50.0), 1e-10)?;
//! assert_eq!(best.scheme().name, problem.splitting_forecast((0.0, 50.0), 1e-10)?.scheme.name);
//! // A scheme and a step of one's own choice.
//! let own = problem.splitting_by(&SRKN_14A, (0.0, 50.0), 0.1)?;
//! assert!((best.axis_state(50.0)?.axis - own.axis_state(50.0)?.axis).amax() < 1e-8);
//! # Ok::<(), twofold::Error>(())
//! ```

mod choice;
#[cfg(target_arch = "x86_64")]
pub(crate) mod derivatives;
mod double_steps;
mod error;
mod flows;
#[cfg(target_arch = "x86_64")]
pub(super) mod lanes;
mod motion;
mod scheme;
mod schemes;
mod stepper;
mod stepping;
#[cfg(target_arch = "x86_64")]
mod tangents;

pub use choice::SplittingForecast;
pub(crate) use choice::{Goal, TANGENTS_AT_ONCE, require_tangent_maps};
pub(crate) use motion::{MOST_STATES, SplittingErrorAtEnd};
pub use motion::{SPLITTING_STEP_LIMIT, SplittingMotion};
pub use scheme::{Ends, Scheme};
pub use schemes::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, KAHAN_LI_8, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SCHEMES,
    SRKN_6B, SRKN_14A, STRANG,
};
pub use stepping::Splitting;
