//! Angles up to whole turns.
//!
//! ```
//! use core::f64::consts::TAU;
//! use twofold::numerics::angle::wrapped;
//!
//! assert!((wrapped(3.0 * TAU + 0.3) - 0.3).abs() < 1e-14);
//! ```

use core::f64::consts::TAU;

/// The whole turns (rad) nearest to an angle.
pub(crate) fn whole_turns(angle: f64) -> f64 {
    (angle / TAU).round() * TAU
}

/// The angle less its nearest whole turns: from -pi to pi.
pub fn wrapped(angle: f64) -> f64 {
    angle - whole_turns(angle)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    #[test]
    fn an_angle_is_half_a_turn_from_zero_at_most() {
        for (angle, expected) in [(0.3, 0.3), (PI, -PI), (-PI, PI), (4.0, 4.0 - TAU), (-20.0, -20.0 + 3.0 * TAU)] {
            assert_eq!(wrapped(angle), expected);
        }
    }
}
