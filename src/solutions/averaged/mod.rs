//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.
//!
//! # Example
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::solutions::averaged::slow_precession::slow_precession;
//! use twofold::solutions::averaged::{
//!     AveragedSolution, AveragingOrder, Top, generator, generator_slopes, mean_angular_velocity, mean_potential, middle_axis_growth,
//!     period_near_separatrix,
//! };
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! let weak = s.scaled(1e-3);
//! let values = Vector3::new(weak.xx, weak.yy, weak.zz);
//! let motion = AveragedSolution::new(&Problem::new(star, weak.tensor(), state)?, AveragingOrder::Second)?;
//! assert!((motion.state(0.0).axis - state.axis).amax() < 1e-12);
//! assert!((motion.state(1e3).axis.norm() - 1.0).abs() < 1e-3);
//!
//! // L goes round a principal axis, slowly.
//! let slow = slow_precession(&star, &weak, &state.momentum, &state.axis)?;
//! assert!((slow.rate / motion.rates().slow).abs() > 0.9);
//! let size = state.momentum.norm();
//! let direction = state.momentum / size;
//! let c = state.axis.dot(&direction);
//! let (_, turning, _) = mean_angular_velocity(&star, &values, size, c, &direction, AveragingOrder::First);
//! let potential = mean_potential(&star, &values, size, c, &direction, AveragingOrder::First);
//! assert!(turning.norm() < 1e-3 && potential.abs() < 1e-3);
//! assert!(Top::new([3e-5, 2e-5, 1e-5], &direction).complement() > 0.0);
//!
//! // The small difference between the mean and the motion.
//! assert!(generator(&star, &values, &state.axis, &state.momentum).abs() < 1e-3);
//! assert!(generator_slopes(&star, &values, &state.axis, &state.momentum).iter().all(|slope| slope.norm() < 1e-3));
//!
//! // About the middle axis motion is unstable.
//! let growth = middle_axis_growth(&star, &weak, size * size / 2.0, 1.0, AveragingOrder::First)?;
//! assert!(growth > 0.0 && period_near_separatrix(growth, 1e-6)? > 1.0 / growth);
//! # Ok::<(), twofold::Error>(())
//! ```

mod averages;
mod error;
mod generator;
mod hamiltonian;
mod middle_axis;
mod motion;
mod phases;
pub mod slow_precession;
mod top;

pub(crate) use averages::mean_of_cn2;
pub use generator::{generator, generator_slopes};
pub use hamiltonian::{AveragingOrder, mean_angular_velocity, mean_potential};
pub use middle_axis::{middle_axis_growth, period_near_separatrix};
pub use motion::AveragedSolution;
pub use phases::{OfRotations, Turns};
pub use top::{Top, TopPhases, TopShape};
