//! The angles whose mean rates are taken, from states and averages.

use nalgebra::{Matrix3, Vector3};

use super::samples::{Averaged, Samples, continuous};

/// A circle of `L` smaller than this, in units of what `L` moves, may be a remainder of its oscillations.
const LEAST_CIRCLE: f64 = 2e-5;

/// Azimuths of `L`.
pub(super) fn momentum_angles(samples: &Samples, frame: &Matrix3<f64>) -> Vec<f64> {
    continuous(samples.states.iter().map(|state| azimuth(&(frame * state.momentum))))
}

/// Azimuths of the averaged `L`.
pub(super) fn slow_angles(averages: &[Averaged], frame: &Matrix3<f64>) -> Vec<f64> {
    continuous(averages.iter().map(|averaged| azimuth(&(frame * averaged.momentum))))
}

/// Angles of the fast part of `n` about the averaged `L`, from the side of the axis (`circles`) or of a fixed direction.
pub(super) fn nutation_angles(averages: &[Averaged], frame: &Matrix3<f64>, circles: bool) -> Vec<f64> {
    let zero = frame.row(if circles { 2 } else { 0 }).transpose();
    continuous(averages.iter().map(|averaged| {
        let across = averaged.momentum.cross(&zero);
        let along = across.cross(&averaged.momentum) / averaged.momentum.norm();
        averaged.fast_axis.dot(&across).atan2(averaged.fast_axis.dot(&along))
    }))
}

/// Angles of `e_x` about `n` from the direction in which the fast part of `n` moves: regular wherever `n` and `L` are.
pub(super) fn body_angles(averages: &[Averaged]) -> Vec<f64> {
    continuous(averages.iter().map(|averaged| {
        let (axis, equatorial) = (&averaged.state.axis, &averaged.state.equatorial_axis);
        let zero = averaged.momentum.cross(&averaged.fast_axis);
        axis.dot(&zero.cross(equatorial)).atan2(zero.dot(equatorial))
    }))
}

fn azimuth(v: &Vector3<f64>) -> f64 {
    v.y.atan2(v.x)
}

/// Whether the averaged `L` stays off the axis.
pub(super) fn momentum_circles(samples: &Samples, averages: &[Averaged], frame: &Matrix3<f64>) -> bool {
    let radius = |momentum: &Vector3<f64>| {
        let v = frame * momentum;
        v.x.hypot(v.y)
    };
    let widest = samples.states.iter().fold(0.0_f64, |most, state| most.max(radius(&state.momentum)));
    let narrowest = averages.iter().fold(f64::INFINITY, |least, averaged| least.min(radius(&averaged.momentum)));
    narrowest > LEAST_CIRCLE * widest + 1e-12 * averages[0].momentum.norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::BodyState;

    fn state(momentum: Vector3<f64>) -> BodyState<f64> {
        BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() }
    }

    fn averaged(momentum: Vector3<f64>, fast_axis: Vector3<f64>) -> Averaged {
        Averaged { state: state(momentum), fast_axis, momentum }
    }

    /// Y, Z and X as the axes of the frame.
    fn cyclic() -> Matrix3<f64> {
        Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
    }

    /// At a distance from X, the third axis, and a height along it.
    fn beside(distance: f64, height: f64) -> Vector3<f64> {
        Vector3::new(height, 0.6 * distance, -0.8 * distance)
    }

    #[test]
    fn a_circle_is_wider_than_a_remainder_of_oscillations_and_than_rounding() {
        let circles = |widest: f64, narrowest: f64, height: f64| {
            let samples = Samples::made([0.1, 1.0, 0.5].map(|part| state(beside(part * widest, 1.0))).to_vec());
            let momenta = [beside(5.0 * narrowest, height), beside(narrowest, 2.0 * height), beside(1.0, height)];
            momentum_circles(&samples, &momenta.map(|momentum| averaged(momentum, Vector3::x())), &cyclic())
        };
        // A fifty-thousandth of what L moves.
        for widest in [0.4, 30.0] {
            assert!(circles(widest, 2.02e-5 * widest, 1.0) && !circles(widest, 1.98e-5 * widest, 1.0), "{widest}");
        }
        // 1e-12 of L.
        for height in [7.0, 3e3] {
            assert!(circles(0.0, 1.01e-12 * height, height) && !circles(0.0, 0.99e-12 * height, height), "{height}");
        }
    }
}
