//! The pulse width at constant colatitude of the magnetic axis. Eqs. (53), (55), (56).
//!
//! ```
//! use twofold::observables::pulsar::width::{PulseWidth, cosine_of_half_width, edge_azimuths, pulse_width};
//!
//! let (rho, theta, theta_o) = (0.6_f64, 0.9, 0.8);
//! let PulseWidth::Pulsed(width) = pulse_width(rho, theta, theta_o) else { panic!("the beam is seen") };
//! assert!(((width / 2.0).cos() - cosine_of_half_width(rho, theta, theta_o)).abs() < 1e-14);
//! let (rise, set) = edge_azimuths(0.0, width);
//! assert!((set - rise - width).abs() < 1e-15);
//! assert_eq!(pulse_width(0.1_f64, 0.3, 1.0), PulseWidth::NeverOn);
//! ```

use crate::numerics::scalar::{Real, Scalar};

/// The pulse of a magnetic axis that rotates about Z at constant colatitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PulseWidth<S> {
    /// One pulse per turn, with the width `W` in azimuth (rad), between 0 and 2 pi.
    Pulsed(S),
    /// The line of sight stays inside the cone through the whole turn.
    AlwaysOn,
    /// The line of sight stays outside the cone, or only touches it.
    NeverOn,
}

impl PulseWidth<f64> {
    /// The width as an angle (rad): zero without a pulse, two pi inside the cone.
    pub fn angle(self) -> f64 {
        match self {
            PulseWidth::Pulsed(width) => width,
            PulseWidth::AlwaysOn => core::f64::consts::TAU,
            PulseWidth::NeverOn => 0.0,
        }
    }
}

/// Width `W` of the pulse, Eq. (56) `[pulsewid]`, of a cone of semi-open angle `half_opening` about an axis at colatitude
/// `theta`, seen from the colatitude `theta_o`; both in [0, pi], `half_opening` in (0, pi) (rad).
///
/// Computed as
///
/// ```text
/// tan^2(W/4) = sin((rho + D)/2) sin((rho - D)/2) / [sin((S + rho)/2) sin((S - rho)/2)],   D = Theta - theta_o, S = Theta + theta_o
/// ```
///
/// This is the printed cosine without its cancellation. What remains is the rounding of `D`, near the grazing pulse, and of `S` and
/// `S + rho`, near `W = 2 pi`. For `Theta` and `theta_o` within a factor of two of each other `D` is exact, and `W` keeps its digits
/// down to the grazing pulse. There is a pulse where `|D| < rho < min(S, 2 pi - S)`.
pub fn pulse_width<S: Real>(half_opening: S, theta: S, theta_o: S) -> PulseWidth<S> {
    let (difference, sum) = (theta - theta_o, theta + theta_o);
    let half_sine = |angle: S| (angle / 2.0).sin_cos().0;
    let inside = half_sine(half_opening + difference) * half_sine(half_opening - difference);
    let outside = half_sine(sum + half_opening) * half_sine(sum - half_opening);
    if inside.re() <= 0.0 {
        PulseWidth::NeverOn
    } else if outside.re() <= 0.0 {
        PulseWidth::AlwaysOn
    } else {
        PulseWidth::Pulsed(inside.sqrt().atan2(outside.sqrt()) * 4.0)
    }
}

/// `cos(W/2) = (cos rho - cos Theta cos theta_o) / (sin Theta sin theta_o)` as printed, Eq. (56) `[pulsewid]`.
///
/// Above 1 there is no pulse, below -1 the line of sight stays inside; near both, and near `sin Theta = 0`, the angle loses
/// digits that [`pulse_width`] keeps.
pub fn cosine_of_half_width<S: Scalar>(half_opening: S, theta: S, theta_o: S) -> S {
    let ((_, c_rho), (s, c), (s_o, c_o)) = (half_opening.sin_cos(), theta.sin_cos(), theta_o.sin_cos());
    (c_rho - c * c_o) / (s * s_o)
}

/// Azimuths `Phi_1 = phi_o - W/2` and `Phi_2 = phi_o + W/2` of the magnetic axis at the edges of the pulse, Eq. (55), whose
/// difference is the width, Eq. (53).
pub fn edge_azimuths<S: Scalar>(phi_o: S, width: S) -> (S, S) {
    (phi_o - width / 2.0, phi_o + width / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 1 rad to 1.5 rad the distance is exactly 0.5 rad, the radius of the beam, which touches the line of sight without a pulse. A slightly larger radius
    /// gives a narrow pulse.
    #[test]
    fn a_beam_that_only_touches_the_line_of_sight_has_no_pulse() {
        for (theta, theta_o) in [(1.0, 1.5), (1.5, 1.0)] {
            assert_eq!(pulse_width(0.5, theta, theta_o), PulseWidth::NeverOn);
            let PulseWidth::Pulsed(width) = pulse_width(0.5 + 1e-10, theta, theta_o) else {
                panic!("the beam is seen")
            };
            assert!((1e-6..1e-4).contains(&width), "{width:e}");
        }
    }
}
