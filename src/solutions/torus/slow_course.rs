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
        let guess = TAU / Top::new(tensor.into(), &direction(axes)).rates().slow.abs();
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
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::solutions::averaged::{AveragedSolution, AveragingOrder};
    use crate::solutions::torus::lattice::Torus;

    const BODY: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };

    fn course(values: &Vector3<f64>, initial: &BodyState<f64>) -> Result<SlowCourse, Error> {
        let integrals = Integrals::new(&BODY, values, values.max() - values.min());
        SlowCourse::along(&integrals, &BODY, values, initial)
    }

    /// Rotation so slow that the averaged `L` moves at less than one radian per unit of time along `K`.
    fn start(momentum: [f64; 3]) -> BodyState<f64> {
        let axis = Vector3::new(0.48, 0.36, 0.8);
        BodyState { axis, momentum: Vector3::from(momentum), equatorial_axis: Vector3::new(0.6, -0.8, 0.0) }
    }

    const VALUES: Vector3<f64> = Vector3::new(2.1e-3, -1.3e-3, -0.8e-3);
    const SCENES: [([f64; 3], usize, f64); 4] = [
        ([1.1, 0.3, 0.2], 0, 1.0),
        ([-1.05, 0.25, -0.4], 0, -1.0),
        ([0.2, 1.12, 0.3], 1, -1.0),
        ([0.3, -1.1, 0.35], 1, 1.0),
    ];

    #[test]
    fn the_guess_is_the_slow_period_of_the_mean_motion() {
        for (momentum, ..) in SCENES {
            let initial = start(momentum);
            let found = course(&VALUES, &initial).unwrap();
            // The mean Hamiltonian is C P2 (l.s l) (l as a unit vector), K / (I D) is L^2 (l.s l) / (I D): rates in the same ratio.
            let (size, c) = (initial.momentum.norm(), initial.momentum.dot(&initial.axis) / initial.momentum.norm());
            let p2 = (3.0 * c * c - 1.0) / 2.0;
            let s = PrincipalCoefficients::new([VALUES.x, VALUES.y, VALUES.z]);
            let mean = AveragedSolution::new(&BODY, &s, &initial, AveragingOrder::First).unwrap().rates().slow.abs();
            let spread = VALUES.max() - VALUES.min();
            let ratio = size * size / (BODY.inertia_xx * spread * BODY.constant_c * p2).abs();
            assert!(
                (found.guess * mean * ratio / TAU - 1.0).abs() < 2e-2,
                "{found:?} {}",
                found.guess * mean * ratio / TAU
            );
            assert!((found.period / found.guess - 1.0).abs() < 1e-2, "{found:?}");
        }
    }

    /// Against the lattice of the torus, exact: `2 pi` over the second rate along `K`.
    #[test]
    fn the_period_and_the_axis_are_those_of_the_torus() {
        for (momentum, axis, sense) in SCENES {
            let initial = start(momentum);
            let found = course(&VALUES, &initial).unwrap();
            let integrals = Integrals::new(&BODY, &VALUES, VALUES.max() - VALUES.min());
            let torus = Torus { integrals, start: found.fastest, size: initial.momentum.norm() };
            let fast = torus.period([TAU * BODY.inertia_xx / torus.size, 0.0]).unwrap();
            let slow = torus.slow_period(fast.times, found.period).unwrap();
            let exact = slow.times[1] - slow.times[0] * fast.times[1] / fast.times[0];
            assert!((found.period / exact - 1.0).abs() < 2e-3, "{} {exact}", found.period);
            assert_eq!((found.axis, found.sense), (axis, sense), "{momentum:?}");
        }
    }

    #[test]
    fn the_fastest_place_is_one() {
        for (momentum, ..) in SCENES {
            let initial = start(momentum);
            let found = course(&VALUES, &initial).unwrap();
            let integrals = Integrals::new(&BODY, &VALUES, VALUES.max() - VALUES.min());
            let speed = |axes: &Axes<f64>| {
                let l = axes[1].normalize();
                VALUES.component_mul(&l).cross(&l).norm()
            };
            let start = [initial.axis, initial.momentum, initial.equatorial_axis];
            let largest = (0..97)
                .map(|i| speed(&integrals.moved([0.0, found.guess * f64::from(i) / 97.0], &start)))
                .fold(0.0, f64::max);
            assert!(speed(&found.fastest) > 0.99 * largest, "{momentum:?}: {} {largest}", speed(&found.fastest));
            assert!(speed(&start) < 0.98 * largest, "{momentum:?}: the start tells nothing");
        }
    }

    #[test]
    fn a_course_without_an_end_is_refused() {
        // The averaged direction on the middle axis stays there.
        let axis = Vector3::z();
        let still = BodyState { axis, momentum: axis * 1.2, equatorial_axis: Vector3::x() };
        let refused = course(&VALUES, &still).unwrap_err();
        assert!(matches!(refused, Error::NotConverged { iterations: 240, .. }), "{refused:?}");
    }
}
