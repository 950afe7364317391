//! Numerical motion with dense output, and the continuous Euler angles of any motion.

mod arithmetic;
mod continuous_angles;
#[cfg_attr(not(target_arch = "x86_64"), path = "unfused.rs")]
mod fused;
mod input;
mod motion;
mod taylor;

pub use continuous_angles::ContinuousAngles;
pub use motion::{AxisMotion, AxisState, Motion};
pub use taylor::{
    ACCURACY_RANGE, STEP_LIMIT, Samples, TaylorAxisMotion, TaylorMotion, axis_states_at, propagate, propagate_axis, states_at,
};
