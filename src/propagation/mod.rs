//! Numerical motion with dense output, and the continuous Euler angles of any motion.

mod compensated;
mod continuous_angles;
mod error_growth;
mod input;
mod motion;
mod series;
pub mod splitting;
mod step_size;
mod taylor;

pub use continuous_angles::ContinuousAngles;
pub use motion::{AxisMotion, AxisState, Motion};
pub use taylor::{ACCURACY_RANGE, STEP_LIMIT, TaylorAxisMotion, TaylorMotion, propagate, propagate_axis};
