//! Radio pulses of a precessing star in the cone model. Eqs. (44), (45), (47), (49)-(56).

pub mod arrival;
mod azimuth_follower;
pub mod beam;
pub mod clock;
pub mod constant_period;
pub mod direction;
mod edge_search;
pub mod event_time;
mod margin;
pub mod period;
pub mod position_angle;
pub mod rate_bounds;
mod root;
pub mod spin_fit;
mod swing;
pub mod timing_model;
pub mod train;
mod turn_count;
pub mod width;

pub use arrival::{Arrival, arrivals};
pub use beam::Beam;
pub use clock::{ClockPulse, PulsarClock};
pub use constant_period::ConstantPeriod;
pub use spin_fit::SpinFit;
pub use train::{Pulse, PulseTrain, Stamped, pulse_train};
