//! Numerical motion with dense output, and the continuous Euler angles of any motion.

mod continuous_angles;
mod motion;
mod series;
mod taylor;

pub use continuous_angles::ContinuousAngles;
pub use motion::Motion;
pub use taylor::{ACCURACY_RANGE, STEP_LIMIT, TaylorMotion, propagate};
