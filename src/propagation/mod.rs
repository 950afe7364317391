//! Numerical motion with dense output, and the continuous Euler angles of any motion.

mod motion;

pub use motion::Motion;
