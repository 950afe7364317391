//! What a distant observer measures of a motion.

pub mod gravitational_wave;
pub mod pulsar;
