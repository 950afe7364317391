//! Stars that slow down: the braking torque, what a wobble makes of it, and the motion under it.
//!
//! A torque along `L` only stretches time. With `dL/dt = (torque of C) - lambda L`, any `lambda(t, state)`, put `d tau = a dt` and `L = a L'`:
//!
//! ```text
//! dn/dtau = L' x n / I^xx,    dL'/dtau = -2 (C / a^2) n x (s n),    da/dtau = -lambda
//! ```
//!
//! So in the time `tau` the star moves as one that does not slow down, with `C / a^2` in place of `C`: exactly so where `s = 0`, and where `C` is that of a bulge that follows the rotation,
//! `C ~ a^2`. [`StretchedTime`] is the map between both times; [`PulsarClock::braked`](crate::observables::pulsar::PulsarClock::braked) sees pulses through it.
//! `docs/spin-down.md` derives it.

mod precession;
mod stretched_time;
mod torque;

pub use precession::Precession;
pub use stretched_time::{Braking, StretchedTime};
pub(crate) use stretched_time::{late_by_torque, secular_lateness, slowing};
pub use torque::TorqueHarmonics;
