//! What a distant observer measures of a motion. Eqs. (37)-(42), (44)-(56), (59), (69)-(71).

pub mod bound;
pub mod eta;
pub mod eta_distribution;
pub mod fundamental_frequencies;
pub mod gravitational_wave;
pub mod observer;
pub mod pulsar;
pub mod spectrum;
pub mod spin_axis;
pub mod wave_harmonics;

pub use observer::Observer;
