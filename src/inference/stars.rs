//! For tests: stars whose pulses and waves are observed.

use crate::dynamics::RigidSpheroid;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::parameters::Parameters;

/// A star with a pulse in each turn and strong violation.
pub(super) fn precessing() -> Parameters<f64> {
    star([0.02, 0.01, -0.04], 0.7, 1.0)
}

/// A star that turns a third as fast.
pub(super) fn slow() -> Parameters<f64> {
    star([0.002, 0.001, -0.004], 0.7, 0.3)
}

/// A star with weak violation and a small wobble, for spans of many turns.
pub(super) fn weak() -> Parameters<f64> {
    star([2e-8, 1e-8, -4e-8], 0.05, 1.3)
}

/// Oblate by a tenth, with its symmetry axis tilted by `beta` and its rates proportional to `rate`.
fn star(s: [f64; 3], beta: f64, rate: f64) -> Parameters<f64> {
    let star = RigidSpheroid::in_units_of_tc(1.1);
    let angles = EulerAngles { alpha: 0.3, beta, gamma: 0.1 };
    let rates = EulerRates { alpha: rate, beta: 0.1 * rate, gamma: 0.2 * rate };
    Parameters {
        chi: 0.8,
        theta_o: 1.0,
        ..Parameters::new(star, PrincipalCoefficients::new(s).tensor(), angles, rates).with_fixed_spin()
    }
}
