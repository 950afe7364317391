//! Motions: numerical with dense output or in closed form, and the continuous Euler angles of any.

mod closed;
mod compensated;
mod continuous_angles;
mod error_growth;
mod input;
mod motion;
mod series;
mod step_size;
mod taylor;

pub use closed::{SymmetricMotion, UniformMotion, largest_torque};
pub use continuous_angles::ContinuousAngles;
pub use motion::{AxisMotion, AxisState, Motion};
pub use taylor::{
    ACCURACY_RANGE, STEP_LIMIT, TaylorAxisMotion, TaylorForecast, TaylorMotion, propagate, propagate_axis,
    taylor_forecast,
};
