//! A torus in double-double numbers: for times so long that the phases need more than 16 digits, and for tori near the separatrix.

use nalgebra::{Matrix3, Vector3};

use super::closed_orbits::ClosedOrbits;
use super::flow::{Axes, Integrals};
use super::flow_series::{DOUBLE, DOUBLE_DOUBLE};
use super::phase::{Phase, phases};
use super::solution::rate_of_orbits;
use super::torus_of_motion::Torus;
use crate::dynamics::Problem;
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::{Real, length};

/// Rounding error of the flow at the end of half a closed orbit.
const END_OF_HALF_PERIOD: f64 = 1e-29;

/// A torus to 32 digits, for the body, the tensor and the state exactly as given.
pub(super) struct DoubleDoubleTorus {
    integrals: Integrals<DoubleDouble>,
    orbits: ClosedOrbits<DoubleDouble>,
    initial: Axes<DoubleDouble>,
    values: Vector3<DoubleDouble>,
    from_given: Matrix3<DoubleDouble>,
    pub(super) phases: [Phase; 3],
    /// Error of a state per unit of time, due to the rates.
    pub(super) drift: f64,
}

impl DoubleDoubleTorus {
    /// Refines a torus found in doubles.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if Newton's method does not converge from there.
    pub(super) fn near(torus: &Torus, problem: &Problem<f64>) -> Result<Self, Error> {
        let wide = |value: f64| DoubleDouble::from(value);
        let spheroid = torus.spheroid.map(wide);
        let (from_given, tensor) = diagonal_frame(&problem.coefficients().map(wide), torus.from_given.map(wide));
        let values = tensor.diagonal().map(|value| value - tensor.m22);
        let integrals = Integrals::new(&spheroid, &Matrix3::from_diagonal(&values), wide(torus.spread), DOUBLE_DOUBLE);
        let given = problem.initial();
        let mut initial = [given.axis, given.momentum, given.equatorial_axis].map(|v| from_given * v.map(wide));
        // n is a unit vector, whatever the rounding of its length.
        initial[0] /= length(&initial[0]);
        let orbits =
            ClosedOrbits::near(&integrals, torus.unit, &initial, torus.orbits.times().map(|times| times.map(wide)));
        let orbits = orbits.ok_or(Error::not_found("periods of the torus in 32 digits"))?;
        let phases = phases(spheroid.rate_about_axis(&initial[0], &initial[1]), &orbits);
        // The torque of the remaining off-diagonal elements, which is not zero if two eigenvalues are nearly equal.
        let beside = [(0, 1), (1, 2), (2, 0)].map(|place| tensor[place].re().abs()).iter().sum::<f64>();
        let torque = 2.0 * torus.spheroid.constant_c.abs() * beside / torus.unit;
        let drift = rate_of_orbits(&phases) * END_OF_HALF_PERIOD + torque;
        Ok(Self { integrals, orbits, initial, values, from_given, phases, drift })
    }

    /// Rounded to doubles, as a replacement for the torus from which it was refined.
    pub(super) fn rounded(&self, torus: &Torus) -> Torus {
        let values = self.values.map(Real::re);
        Torus {
            initial: self.initial.map(|v| v.map(Real::re)),
            orbits: self.orbits.rounded(),
            integrals: Integrals::new(&torus.spheroid, &Matrix3::from_diagonal(&values), torus.spread, DOUBLE),
            from_given: self.from_given.map(Real::re),
            ..*torus
        }
    }

    /// States along a quarter of a turn of the second angle, in `quarter` equal steps, rounded.
    pub(super) fn starts(&self, quarter: usize) -> Vec<Axes<f64>> {
        let starts = self.orbits.starts(&self.integrals, quarter);
        starts.into_iter().map(|axes| axes.map(|v| v.map(Real::re))).collect()
    }
}

/// A rotation near a given one that diagonalises a tensor, and the rotated tensor.
fn diagonal_frame(
    tensor: &Matrix3<DoubleDouble>,
    mut frame: Matrix3<DoubleDouble>,
) -> (Matrix3<DoubleDouble>, Matrix3<DoubleDouble>) {
    let one = DoubleDouble::from(1.0);
    let mut passes = 0;
    loop {
        let rows = [0, 1].map(|i| frame.row(i).transpose());
        let x = rows[0] * (one / Real::sqrt(rows[0].dot(&rows[0])));
        let y = rows[1] - x * x.dot(&rows[1]);
        let y = y * (one / Real::sqrt(y.dot(&y)));
        frame = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
        let turned = frame * tensor * frame.transpose();
        // Each pass squares the remaining off-diagonal elements, over the differences of eigenvalues: from 1e-16 to 1e-64.
        if passes == 2 {
            return (frame, turned);
        }
        passes += 1;
        let size = turned.map(Real::re).amax();
        let turn = |i: usize, j: usize| {
            let gap = turned[(j, j)] - turned[(i, i)];
            if gap.re().abs() < 1e-9 * size { DoubleDouble::default() } else { turned[(i, j)] / gap }
        };
        let (a, b, c) = (turn(0, 1), turn(1, 2), turn(0, 2));
        frame = Matrix3::new(one, -a, -c, a, one, -b, c, b, one) * frame;
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    #[test]
    fn a_frame_near_the_principal_one_becomes_it() {
        let turn = Rotation3::from_euler_angles(0.3, -0.8, 1.7).into_inner();
        let given = turn.transpose() * Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, -0.4)) * turn;
        let tensor = ((given + given.transpose()) / 2.0).map(DoubleDouble::from);
        let (frame, turned) = diagonal_frame(&tensor, turn.map(DoubleDouble::from));
        for place in [(0, 1), (1, 2), (2, 0)] {
            assert!(turned[place].re().abs() < 1e-31, "{turned:?}");
        }
        let unit = (frame * frame.transpose() - Matrix3::identity()).map(Real::re);
        assert!(unit.amax() < 1e-31, "{unit:?}");
        assert!((frame.map(Real::re) - turn).amax() < 1e-15);
    }

    /// Two eigenvalues 1e-13 apart, in a tilted frame: the axes of their plane stay as they were found in doubles, and the rounding of the tensor,
    /// some 1e-17, is beside its diagonal. Eigenvalues that differ leave 1e-33 there.
    #[test]
    fn what_is_left_beside_the_diagonal_is_in_the_stated_error() {
        let turn = Rotation3::from_euler_angles(0.3, -0.8, 1.7).into_inner();
        let drift = |second: f64| {
            let given = turn.transpose() * Matrix3::from_diagonal(&Vector3::new(0.3, second, -0.6)) * turn;
            let problem = crate::dynamics::fixture::problem([0.2, 0.1, -0.3]);
            let problem = Problem::new(*problem.spheroid(), (given + given.transpose()) / 2.0, *problem.initial());
            let problem = problem.unwrap();
            DoubleDoubleTorus::near(&Torus::of(&problem).unwrap(), &problem).unwrap().drift
        };
        assert!((1e-18..1e-15).contains(&drift(0.3 + 1e-13)), "{:e}", drift(0.3 + 1e-13));
        assert!(drift(0.1) < 1e-29, "{:e}", drift(0.1));
    }

    /// Two equal eigenvalues: any axes of their plane are valid, and nothing is divided by zero.
    #[test]
    fn equal_eigenvalues_keep_their_axes() {
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.2, 0.2, -0.4)).map(DoubleDouble::from);
        let (frame, turned) = diagonal_frame(&tensor, Matrix3::identity());
        assert_eq!((frame, turned), (Matrix3::identity(), tensor));
    }
}
