//! The swing of the position angle: its change along a pulse.

use nalgebra::{Vector2, Vector3};

use super::position_angle::position_angle;
use crate::numerics::angle::wrapped;
use crate::observables::Observer;

/// Deviation (rad) from a chord below which the line of sight is passed in one step: on which side, is lost to rounding.
const NEAREST: f64 = 1e-18;

/// The change (rad) of the position angle of an axis from the time `start` to the later time `end`; NaN where the axis is along the line of sight at
/// either. `direction` is the axis at a time, `second` a bound on its second derivative.
///
/// On the sky the projection of the axis deviates from a chord of its path by an eighth of `second` times the squared time. Along a chord that stays
/// farther from the line of sight the angle changes by less than half a turn.
pub(super) fn swing(
    direction: impl Fn(f64) -> Vector3<f64>,
    second: f64,
    observer: &Observer<f64>,
    (start, end): (f64, f64),
) -> f64 {
    let look = |t: f64| {
        let m = direction(t);
        let on_sky = Vector2::new(m.dot(&observer.theta_hat), m.dot(&observer.phi_hat));
        (on_sky, position_angle(&m, observer).unwrap_or(f64::NAN))
    };
    let (mut t, mut step, mut swing) = (start, end - start, 0.0);
    let mut here = look(t);
    while t < end && !f64::is_nan(swing) {
        let next = look(t + step);
        let deviation = second * step * step / 8.0;
        if distance_of_chord(&here.0, &next.0) <= deviation && deviation > NEAREST {
            step *= 0.5;
            continue;
        }
        swing += wrapped(next.1 - here.1);
        (t, here) = (t + step, next);
        step = (2.0 * step).min(end - t);
    }
    swing
}

/// Distance of the origin from the chord between two points.
fn distance_of_chord(from: &Vector2<f64>, to: &Vector2<f64>) -> f64 {
    let along = to - from;
    let nearest = (-from.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (from + along * nearest).norm()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{PI, TAU};

    use super::*;

    /// An axis at 0.5 rad from Z that rotates about Z at the rate one. From a line of sight inside of its circle it goes round once in a turn, also where it
    /// passes at 1e-6 rad; from one outside it comes back.
    #[test]
    fn turns_about_the_line_of_sight_count() {
        let direction = |t: f64| Vector3::new(0.5_f64.sin() * t.cos(), 0.5_f64.sin() * t.sin(), 0.5_f64.cos());
        for (theta_o, turns) in [(0.1, 1.0), (0.499, 1.0), (0.499_999, 1.0), (0.500_001, 0.0), (1.2, 0.0)] {
            let observer = Observer::at(theta_o, 0.0);
            for start in [-PI, 0.3] {
                let found = swing(direction, 1.0, &observer, (start, start + TAU));
                // A path of 1 rad seen from 1e-6 rad has the rounding 1e-10.
                assert!((found.abs() - turns * TAU).abs() < 1e-9, "{theta_o} from {start}: {found}");
            }
            // The sense is that of the rotation, and half of it on either side.
            let halves = [(-PI, 0.0), (0.0, PI)].map(|span| swing(direction, 1.0, &observer, span));
            assert!((halves[0] - halves[1]).abs() < 1e-9, "{theta_o}: {halves:?}");
        }
    }

    #[test]
    fn an_axis_along_the_line_of_sight_has_no_swing() {
        let direction = |t: f64| Vector3::new(t.sin(), 0.0, t.cos());
        assert!(swing(direction, 1.0, &Observer::at(0.0, 0.0), (0.0, 1.0)).is_nan());
    }
}
