//! Motions: numerical with dense output or in closed form, and the continuous Euler angles of any.
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
//! use twofold::propagation::{
//!     AveragedMotion, AxisMotion, AxisScene, AxisState, ContinuousAngles, ErrorEstimates, Motion, SymmetricMotion,
//!     axis_states_at, axis_states_of_many, largest_torque, propagate, propagate_axis, states_at, taylor_forecast,
//! };
//! use twofold::solutions::mean::MeanOrder;
//!
//! let (tensor, span) = (s.tensor(), (0.0, 100.0));
//! assert!(taylor_forecast(&star, &tensor, &state, true, 100.0, 1e-13)?.steps > 1.0);
//! let motion = propagate(&star, &tensor, &state, span, 1e-13)?;
//! let end = motion.state(100.0)?;
//! assert!(motion.error_estimate(100.0) < 1e-11);
//!
//! // Without e_x; at some times alone; many at once.
//! let axis = AxisState::from(&state);
//! assert!((propagate_axis(&star, &tensor, &axis, span, 1e-13)?.axis_state(100.0)?.axis - end.axis).amax() < 1e-11);
//! let at = states_at(&star, &tensor, &state, 0.0, &[50.0, 100.0], 1e-13, ErrorEstimates::NotWanted)?;
//! assert!((at.states[1].axis - end.axis).amax() < 1e-11);
//! let at = axis_states_at(&star, &tensor, &axis, 0.0, &[50.0, 100.0], 1e-13, ErrorEstimates::Wanted)?;
//! assert_eq!(at.error_estimates.len(), 2);
//! let scene = AxisScene { spheroid: star, violation: tensor, initial: axis, start: 0.0, times: &[100.0], accuracy: 1e-12 };
//! let many = axis_states_of_many(&[scene; 4]);
//! assert!((many[3].as_ref().map_err(Clone::clone)?.states[0].axis - end.axis).amax() < 1e-9);
//!
//! // Angles that count their turns.
//! let turned = ContinuousAngles::new(&motion, 0.0, &angles)?.at(100.0)?;
//! assert!(turned.alpha > 100.0);
//!
//! // Closed forms: the mean motion of a weak violation, and the exact motion about an axis of symmetry.
//! let weak = s.scaled(1e-6).tensor();
//! assert!(largest_torque(&star, &weak) < 1e-6);
//! let mean = AveragedMotion::new(&star, &weak, &state, (0.0, 1e6), MeanOrder::Second)?;
//! assert!((mean.state(1e6)?.axis.norm() - 1.0).abs() < 1e-11);
//! let symmetric = PrincipalCoefficients::new([0.01, 0.01, -0.02]).tensor();
//! let exact = SymmetricMotion::new(&star, &symmetric, &state, span)?;
//! let same = propagate(&star, &symmetric, &state, span, 1e-13)?;
//! assert!((exact.state(100.0)?.axis - same.state(100.0)?.axis).amax() < 1e-10);
//! # Ok::<(), twofold::Error>(())
//! ```

mod arithmetic;
mod closed;
mod continuous_angles;
#[cfg_attr(not(target_arch = "x86_64"), path = "unfused.rs")]
mod fused;
mod input;
mod many;
mod motion;
#[cfg(target_arch = "x86_64")]
pub(crate) mod registers;
pub mod splitting;
mod taylor;
mod third_angle;
mod turning;

pub use closed::{AveragedMotion, SymmetricMotion, UniformMotion, largest_torque};
pub use continuous_angles::{ContinuousAngles, MOST_COUNTED};
pub(crate) use input::{check_input, check_time};
pub use many::{AxisScene, axis_states_of_many};
pub use motion::{AxisMotion, AxisState, Motion};
pub(crate) use taylor::projected_by_stretches;
pub use taylor::{
    ACCURACY_RANGE, ErrorEstimates, STEP_LIMIT, Samples, SeriesProjection, TaylorAxisMotion, TaylorForecast,
    TaylorMotion, axis_states_at, propagate, propagate_axis, states_at, taylor_forecast,
};
pub use turning::{GivenRates, Turning};
