//! Motions: numerical with dense output or in closed form, and the continuous Euler angles of any.

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
