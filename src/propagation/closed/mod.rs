//! Motions in closed form: no integration, and the same cost for any time.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::propagation::{AveragedMotion, Motion, SymmetricMotion, largest_torque};
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(1e-8, 1e-8, -2e-8));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?;
//! assert!(largest_torque(problem.spheroid(), &s) < 1e-7);
//! let mean = AveragedMotion::new(&problem, (0.0, 1e3))?;
//! let exact = SymmetricMotion::new(&problem, (0.0, 1e3))?;
//! assert!((mean.state(1e3)?.axis - exact.state(1e3)?.axis).amax() < 1e-10);
//! # Ok::<(), twofold::Error>(())
//! ```

mod averaged;
mod symmetric;
mod torus;
mod uniform;

pub use averaged::AveragedMotion;
pub use symmetric::SymmetricMotion;
pub use torus::TorusMotion;
pub use uniform::{UniformMotion, largest_torque};
