//! Stars that slow down: the braking torque, its modulation by a wobble, and the motion under it.
//!
//! A torque along `L` only stretches time. For `dL/dt = (torque of C) - lambda L`, with any `lambda(t, state)`, let `d tau = a dt` and
//! `L = a L'`:
//!
//! ```text
//! dn/dtau = L' x n / I^xx,    dL'/dtau = -2 (C / a^2) n x (s n),    da/dtau = -lambda
//! ```
//!
//! So in the time `tau` the star moves like one that does not slow down, with `C / a^2` in place of `C`. This is exact for `s = 0`, and if `C` is
//! that of a bulge that follows the rotation, `C ~ a^2`. [`StretchedTime`] is the map between both times;
//! [`PulsarClock::braked`](crate::observables::pulsar::PulsarClock::braked) applies it to pulses. `docs/spin-down.md` derives it.

mod precession;
mod stretched_time;
mod torque;

pub use precession::Precession;
pub use stretched_time::{Braking, StretchedTime};
pub(crate) use stretched_time::{secular_delay, slowing, torque_delay};
pub use torque::TorqueHarmonics;
