//! Motions: numerical with dense output or in closed form, and the continuous Euler angles of any motion.
//!
//! # Example
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{Problem, RigidSpheroid};
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::propagation::{ContinuousAngles, Motion};
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (angles, rates) = (EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 }, EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 });
//! let problem = Problem::from_angles(RigidSpheroid::in_units_of_tc(1.1), s, &angles, &rates)?;
//! let motion = problem.taylor((0.0, 100.0), 1e-13)?;
//! assert!(motion.error_estimate(100.0) < 1e-11);
//! // Angles that count their turns; and n and L alone, at two times.
//! assert!(ContinuousAngles::new(&motion, 0.0, &angles)?.at(100.0)?.alpha > 100.0);
//! let at = problem.reduced().taylor_states(0.0, &[50.0, 100.0], 1e-13)?;
//! assert!((at.states[1].axis - motion.state(100.0)?.axis).amax() < 1e-11);
//! # Ok::<(), twofold::Error>(())
//! ```

mod closed;
mod continuous_angles;
mod input;
mod many;
mod motion;
mod phased;
pub mod splitting;
pub(crate) mod taylor;
mod third_angle;
mod turning;

pub use closed::{AveragedMotion, SymmetricMotion, TorusMotion, UniformMotion, largest_torque};
pub use continuous_angles::{ContinuousAngles, MOST_COUNTED};
pub(crate) use input::check_time;
pub use many::{SampledProblem, states_of_many};
pub use motion::Motion;
pub use phased::PhasedMotion;
pub(crate) use taylor::ROOM_FOR_STEPS;
pub use taylor::{STEP_LIMIT, Samples, SeriesProjection, TOLERANCE_RANGE, TaylorForecast, TaylorMotion};
pub use turning::{GivenRates, Turning};
