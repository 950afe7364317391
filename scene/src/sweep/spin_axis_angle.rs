//! Smallest, largest and mean angle between the spin axis and the direction to the observer over the span of a scene.

use std::f64::consts::{PI, TAU};
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::RigidSpheroid;
use twofold::observables::spin_axis::cos_lambda_rate;

use crate::samples::AxisStateAt;

/// Panels of the quadrature per turn, for the upper estimate of the rotation rate.
const PANELS_PER_TURN: f64 = 16.0;

/// Nodes of the Gauss-Legendre rule in a panel; its error in a sixteenth of a turn is about 1e-11 of the amplitude.
const NODES: NonZeroUsize = NonZeroUsize::new(4).unwrap();

/// Largest number of halvings of a panel next to the line of sight, where the angle bends sharply.
const MOST_HALVINGS: u32 = 10;

/// Follows the angle `lambda` of Eq. (37) along a motion, segment by segment.
pub(super) struct SpinAxisAngle {
    spheroid: RigidSpheroid<f64>,
    direction: Vector3<f64>,
    turning_rate: f64,
    /// Nodes on [-1, 1] in order, with their weights.
    nodes: Vec<(f64, f64)>,
    least: f64,
    largest: f64,
    integral: f64,
    length: f64,
}

impl SpinAxisAngle {
    /// Starts to follow the angle to the unit vector `direction`, along a motion that rotates at most at `turning_rate`.
    pub(super) fn new(spheroid: RigidSpheroid<f64>, direction: Vector3<f64>, turning_rate: f64) -> Self {
        let nodes = GaussLegendre::new(NODES).iter().copied().collect();
        let least = f64::INFINITY;
        Self { spheroid, direction, turning_rate, nodes, least, largest: 0.0, integral: 0.0, length: 0.0 }
    }

    /// Smallest, largest and mean angle (rad) so far. Extrema are found from the sign of the rate at 64 times per turn and
    /// then to 1e-14; two extrema between neighbouring times, a plateau, are missed, which shifts the result by less than
    /// 1e-4.
    pub(super) fn least_largest_mean(&self) -> [f64; 3] {
        [self.least, self.largest, self.integral / self.length]
    }

    /// Includes the motion from `from` to `to`.
    pub(super) fn add(&mut self, motion: &AxisStateAt<'_>, from: f64, to: f64) -> Result<(), Error> {
        let panels = ((to - from).abs() * self.turning_rate / TAU * PANELS_PER_TURN).ceil().max(1.0);
        let half = (to - from) / panels / 2.0;
        let mut last = self.take(motion, from)?;
        for panel in 0..panels as usize {
            last = self.add_panel(motion, last, from + (2 * panel + 1) as f64 * half, half, MOST_HALVINGS)?;
        }
        let end = self.take(motion, to)?;
        self.take_extremum(motion, &last, &end)?;
        self.length += to - from;
        Ok(())
    }

    /// Includes the panel `middle` +- `half`, which follows the point `last`; it is halved if the axis comes nearer to the line of sight, or to
    /// its opposite, than it turns within the panel. Returns the last point.
    fn add_panel(
        &mut self,
        motion: &AxisStateAt<'_>,
        mut last: Place,
        middle: f64,
        half: f64,
        halvings: u32,
    ) -> Result<Place, Error> {
        let nodes = self.nodes.clone();
        let places = nodes.iter().map(|(node, _)| self.take(motion, middle + node * half));
        let places = places.collect::<Result<Vec<_>, _>>()?;
        let nearest = places.iter().map(|place| place.angle.min(PI - place.angle)).fold(f64::INFINITY, f64::min);
        if halvings > 0 && nearest < 2.0 * half.abs() * self.turning_rate {
            let quarter = half / 2.0;
            last = self.add_panel(motion, last, middle - quarter, quarter, halvings - 1)?;
            return self.add_panel(motion, last, middle + quarter, quarter, halvings - 1);
        }
        for (next, (_, weight)) in places.into_iter().zip(nodes) {
            self.integral += weight * half * next.angle;
            self.take_extremum(motion, &last, &next)?;
            last = next;
        }
        Ok(last)
    }

    fn take(&mut self, motion: &AxisStateAt<'_>, time: f64) -> Result<Place, Error> {
        let state = motion(time)?;
        let across = self.direction.cross(&state.axis).norm();
        let angle = across.atan2(self.direction.dot(&state.axis));
        self.least = self.least.min(angle);
        self.largest = self.largest.max(angle);
        let rate = cos_lambda_rate(&self.spheroid, &self.direction, &state.axis, &state.momentum);
        Ok(Place { time, angle, rate })
    }

    /// Includes the extremum between two times at which the rate has different signs, by alternating false position and halving. The angle is flat
    /// there: once the rate is 1e-6 of the rates at both ends, at most a 64th of a turn apart, the angle is within 1e-14 of its extremum.
    fn take_extremum(&mut self, motion: &AxisStateAt<'_>, a: &Place, b: &Place) -> Result<(), Error> {
        let (mut a, mut b) = (*a, *b);
        let enough = 1e-6 * (a.rate.abs() + b.rate.abs());
        let mut halve = false;
        while a.rate * b.rate < 0.0 {
            let part = if halve { 0.5 } else { a.rate / (a.rate - b.rate) };
            let middle = self.take(motion, a.time + (b.time - a.time) * part)?;
            if middle.rate.abs() <= enough || middle.time == a.time || middle.time == b.time {
                break;
            }
            *(if (middle.rate < 0.0) == (a.rate < 0.0) { &mut a } else { &mut b }) = middle;
            halve = !halve;
        }
        Ok(())
    }
}

#[derive(Clone, Copy)]
struct Place {
    time: f64,
    angle: f64,
    rate: f64,
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use twofold::dynamics::AxisState;

    use super::*;

    /// The angle to the direction over spans (rad of rotation) for a star whose axis circles Z at a right angle with this rate, starting at X.
    fn at_rate(rate: f64, direction: Vector3<f64>, spans: &[[f64; 2]]) -> [f64; 3] {
        let momentum = Vector3::z() * rate;
        let motion = |t: f64| {
            let (sin, cos) = (rate * t).sin_cos();
            Ok(AxisState { axis: Vector3::new(cos, sin, 0.0), momentum })
        };
        let mut angle = SpinAxisAngle::new(RigidSpheroid::in_units_of_tc(1.1), direction, rate);
        for [from, to] in spans {
            angle.add(&motion, from / rate, to / rate).expect("a motion");
        }
        angle.least_largest_mean()
    }

    fn of_a_free_star(direction: Vector3<f64>, spans: &[[f64; 2]]) -> [f64; 3] {
        at_rate(2.0, direction, spans)
    }

    /// `cos lambda = cos a cos phi`: from `a` to `pi - a`, on average a right angle over whole turns, and over half a turn starting at
    /// X.
    #[test]
    fn an_axis_at_a_right_angle_to_l_is_so_to_any_direction_in_the_mean() {
        let a: f64 = 0.3;
        let direction = Vector3::new(a.cos(), 0.0, a.sin());
        let expected = [a, PI - a, PI / 2.0];
        let (turn, half) = (TAU, PI);
        for spans in [
            vec![[-16.0 * turn, 16.0 * turn]],
            vec![[-16.0 * turn, 0.0]],
            vec![[0.0, -16.0 * turn]],
            vec![[16.0 * turn, -16.0 * turn]],
            vec![[-2.5 * turn, 2.0 * turn]],
            vec![[0.37, 0.37 + 3.0 * turn]],
            vec![[5.0 * half, 6.0 * half]],
            vec![[0.0, 0.2], [0.2, 0.9], [0.9, half]],
            vec![[0.0, -0.2], [-0.2, -half]],
        ] {
            // The mean is accurate to the error of four nodes in a sixteenth of a turn for a bend within 0.3 rad. Extrema are accurate to
            // 1e-14, however slow the star.
            for rate in [2.0, 2e-6] {
                let found = at_rate(rate, direction, &spans).into_iter().zip(expected);
                for ((found, expected), bound) in found.zip([1e-13, 1e-13, 1e-8]) {
                    assert_relative_eq!(found, expected, max_relative = bound);
                }
            }
        }
    }

    /// Parts of a span add up to it, wherever they begin.
    #[test]
    fn the_mean_of_a_span_is_that_of_its_parts() {
        let direction = Vector3::new(0.8, 0.0, 0.6);
        for ends in [&[-4000.3, -1300.0, -1.0, 0.0][..], &[-1300.3, -1.0, 0.0, 1300.5]] {
            let parts: Vec<_> = ends.windows(2).map(|part| [part[0], part[1]]).collect();
            let whole = of_a_free_star(direction, &[[ends[0], ends[ends.len() - 1]]]);
            for (whole, parts) in whole.into_iter().zip(of_a_free_star(direction, &parts)) {
                assert_relative_eq!(whole, parts, max_relative = 1e-9);
            }
        }
        let [least, largest, mean] = of_a_free_star(Vector3::x(), &[[0.1, 0.5]]);
        assert_relative_eq!(least, 0.1, max_relative = 1e-14);
        assert_relative_eq!(largest, 0.5, max_relative = 1e-14);
        assert_relative_eq!(mean, 0.3, max_relative = 1e-12);
    }

    /// For a path through the direction the angle is `|phi|`, with a kink: its mean is half of the sum of both squares divided
    /// by the sum of both.
    #[test]
    fn an_axis_through_the_direction_has_the_mean_of_both_sides() {
        for (first, last) in [(-0.7, 2.2), (0.7, -2.2), (-0.001, 3.1)] {
            let [least, largest, mean] = of_a_free_star(Vector3::x(), &[[first, last]]);
            let expected: f64 = (first * first + last * last) / 2.0 / f64::abs(last - first);
            assert!(least < 1e-12, "{least:e}");
            assert_relative_eq!(largest, last.abs(), max_relative = 1e-14);
            assert_relative_eq!(mean, expected, max_relative = 1e-7);
        }
    }
}
