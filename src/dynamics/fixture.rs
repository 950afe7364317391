//! A star and its motion, for tests.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{AxisState, Problem, RigidSpheroid};
use crate::euler_angles::{EulerAngles, EulerRates};

/// A prolate star.
pub(crate) const STAR: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 };
pub(crate) const ANGLES: EulerAngles<f64> = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
pub(crate) const RATES: EulerRates<f64> = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
pub(crate) const AXIS_STATE: AxisState<f64> =
    AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: Vector3::new(0.3, -0.7, 1.1) };

/// `s^IJ` with these principal values, diagonal.
pub(crate) fn tensor(s: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(s))
}

/// The star with these principal values of `s^IJ`.
pub(crate) fn problem(s: [f64; 3]) -> Problem<f64> {
    Problem::from_angles(STAR, tensor(s), &ANGLES, &RATES).unwrap()
}

/// The same problem for `n` and `L` alone, from [`AXIS_STATE`].
pub(crate) fn axis_problem(s: [f64; 3]) -> Problem<f64, AxisState<f64>> {
    Problem::new(STAR, tensor(s), AXIS_STATE).unwrap()
}
