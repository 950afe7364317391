//! A star and a tensor without special values: no two numbers are equal, and none is one.

use nalgebra::Matrix3;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates, body_from_inertial};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::parameters::Parameters;

pub const STAR: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.7, constant_c: 0.8 };
/// A prolate body with a constant of the other sign.
pub const PROLATE: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.7, inertia_zz: 1.3, constant_c: -0.8 };
pub const ANGLES: EulerAngles<f64> = EulerAngles { alpha: 0.3, beta: 1.1, gamma: -0.5 };
pub const RATES: EulerRates<f64> = EulerRates { alpha: 0.9, beta: 0.2, gamma: 0.6 };

/// A tensor with unordered eigenvalues in a rotated frame.
pub fn tensor(values: [f64; 3]) -> Matrix3<f64> {
    let turn = body_from_inertial(&EulerAngles { alpha: 0.4, beta: 1.2, gamma: -0.7 });
    let tensor = turn.transpose() * PrincipalCoefficients::new(values).tensor() * turn;
    (tensor + tensor.transpose()) * 0.5
}

pub fn general() -> Matrix3<f64> {
    tensor([0.021, -0.004, 0.009])
}

pub fn state() -> BodyState<f64> {
    BodyState::from_angles(&STAR, &ANGLES, &RATES)
}

pub fn problem(s: Matrix3<f64>) -> Problem<f64> {
    Problem::new(STAR, s, state()).expect("a problem")
}

pub fn start() -> Parameters<f64> {
    Parameters::new(STAR, general(), ANGLES, RATES)
}
