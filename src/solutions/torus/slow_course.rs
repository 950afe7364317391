//! The slow circle of the averaged `L`: how long it takes along the flow of `K`, and round which axis it goes.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::flow::{Axes, Integrals};
use super::lattice::PARTS_OF_TURN;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::solutions::averaged::{Top, mean_direction};

/// A slow turn may take so many times what the averaged motion says, near the separatrix.
const LONGEST_TURN: usize = 5;

/// The averaged `L` along the flow of `K`, once round its axis.
#[derive(Debug)]
pub(super) struct SlowCourse {
    /// Time along `K` of a turn, from what is seen and from the top that the averaged `L` is.
    pub(super) period: f64,
    pub(super) guess: f64,
    /// Where it moves fastest.
    pub(super) fastest: Axes<f64>,
    /// The axis that it goes round, and in which sense about its positive end.
    pub(super) axis: usize,
    pub(super) sense: f64,
}

impl SlowCourse {
    pub(super) fn along(
        integrals: &Integrals<f64>,
        spheroid: &RigidSpheroid<f64>,
        values: &Vector3<f64>,
        initial: &BodyState<f64>,
    ) -> Result<Self, Error> {
        let spread = values.max() - values.min();
        let direction = |[axis, momentum, equatorial_axis]: Axes<f64>| {
            mean_direction(spheroid, values, &BodyState { axis, momentum, equatorial_axis })
        };
        // Averaged, the flow of K turns l as a top with the tensor 2 s L.
        let tensor = values * (2.0 * initial.momentum.norm() / (spheroid.inertia_xx * spread));
        let rate = |l: &Vector3<f64>| tensor.component_mul(l).cross(l);
        let mut axes = [initial.axis, initial.momentum, initial.equatorial_axis];
        let guess = TAU / Top::new(tensor.into(), &direction(axes)).rates.slow.abs();
        let part = guess / PARTS_OF_TURN as f64;
        let still = Error::NotConverged {
            what: "way of L round its axis: L is on an axis, or this is the separatrix",
            iterations: LONGEST_TURN * PARTS_OF_TURN,
            residual: guess,
        };
        if !guess.is_finite() {
            return Err(still);
        }
        // Near the separatrix L lingers by the middle axis, where nothing tells how far it has come.
        let mut best = (0.0, axes);
        for _ in 0..PARTS_OF_TURN {
            let speed = rate(&direction(axes)).norm();
            if speed > best.0 {
                best = (speed, axes);
            }
            axes = integrals.moved([0.0, part], &axes);
        }
        let fastest = best.1;
        let first = direction(fastest);
        let tangent = rate(&first);
        axes = fastest;
        let (mut least, mut before, mut turned) = (first.abs(), 0.0, false);
        for step in 1..=LONGEST_TURN * PARTS_OF_TURN {
            axes = integrals.moved([0.0, part], &axes);
            let l = direction(axes);
            let ahead = (l - first).dot(&tangent);
            least = least.zip_map(&l.abs(), f64::min);
            // Behind the start after half a turn, in front of it again after a whole one.
            turned |= ahead < 0.0;
            if turned && ahead >= 0.0 {
                let period = part * (step as f64 - ahead / (ahead - before));
                let (high, low) = (values.imax(), values.imin());
                let axis = if least[high] > least[low] { high } else { low };
                let sense = if axis == high { l[axis].signum() } else { -l[axis].signum() };
                return Ok(Self { period, guess, fastest, axis, sense });
            }
            before = ahead;
        }
        Err(still)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solutions::torus::plane::tests::BODY;

    /// The averaged direction on the middle axis stays there.
    #[test]
    fn a_course_without_an_end_is_refused() {
        let values = Vector3::new(2.1e-3, -1.3e-3, -0.8e-3);
        let integrals = Integrals::new(&BODY, &values, values.max() - values.min());
        let still = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 1.2, equatorial_axis: Vector3::x() };
        let refused = SlowCourse::along(&integrals, &BODY, &values, &still).unwrap_err();
        assert!(matches!(refused, Error::NotConverged { iterations: 240, .. }), "{refused:?}");
    }
}
