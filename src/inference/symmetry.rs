//! Changes of a star, its beam and its observer that have no observable effect, or that two unknowns share: names for degenerate
//! directions.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use crate::dynamics::RotationState;
use crate::numerics::scalar::Real;
use crate::parameters::{Parameter, Parameters};

/// A change of the unknowns that leaves all data of some kind unchanged, in words.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetry<U> {
    /// Description of the undetermined quantity.
    pub words: &'static str,
    /// The change of each unknown, in its unit; unknowns that are not listed do not change.
    pub change: Vec<(U, f64)>,
}

/// The symmetries of a star with these parameters, the simplest first.
pub(super) fn symmetries(parameters: &Parameters<f64>) -> Vec<Symmetry<Parameter>> {
    use Parameter::*;
    let with_s = |other: (Parameter, f64)| {
        let components = [SAxial, SAsymmetry, S(0, 1), S(0, 2), S(1, 2)];
        components.into_iter().map(|part| (part, part.value(parameters))).chain([other]).collect::<Vec<_>>()
    };
    let Parameters { s_scale, strain_scale, .. } = *parameters;
    let (constant_c, oblateness) = (parameters.spheroid.constant_c, parameters.spheroid.oblateness());
    let named = [
        ("the trace of s^IJ: a multiple of the unit tensor exerts no torque", vec![(STrace, 1.0)]),
        (
            "C against the size of s^IJ: only C s^IJ / I^xx moves the star",
            vec![(ConstantC, constant_c), (SScale, -s_scale)],
        ),
        ("C against s^IJ: only C s^IJ / I^xx moves the star", with_s((ConstantC, -constant_c))),
        ("the size of s^IJ against its components, which it only scales", with_s((SScale, -s_scale))),
        ("gamma against delta: only gamma + delta, the place of the beam, is seen", vec![(Gamma, 1.0), (Delta, -1.0)]),
        ("gamma: a spheroid looks the same at any gamma, and no beam is seen", vec![(Gamma, 1.0)]),
        ("chi: pulses and their widths show it, and these data do not", vec![(Chi, 1.0)]),
        ("delta: pulses show it, and these data do not", vec![(Delta, 1.0)]),
        ("rho: the widths of pulses show it, and these data do not", vec![(Rho, 1.0)]),
        (
            "eps against Omega^z and the strain scale: the axis moves by I^zz Omega^z, and h is in proportion to eps I^xx / r",
            vec![
                (Oblateness, -oblateness),
                (Spin, parameters.spin() * oblateness / (1.0 + oblateness)),
                (Strain, strain_scale),
            ],
        ),
        (
            "eps against Omega^z: only I^zz Omega^z is seen",
            vec![(Oblateness, 1.0 + oblateness), (Spin, -parameters.spin())],
        ),
        ("C: the torque changes none of these data", vec![(ConstantC, 1.0)]),
        ("the size of s^IJ: the torque changes none of these data", vec![(SScale, 1.0)]),
        ("the strain scale: the data have no strain, or the star emits none", vec![(Strain, 1.0)]),
    ];
    let (sin, cos) = parameters.phi_o.sin_cos();
    // Polarizations refer to Z: the strain shows a rotation about the last axis.
    let turns = [
        (Vector3::z(), "a rotation of all (star, s^IJ and observer) about Z: no direction in space is marked"),
        (
            Vector3::new(-sin, cos, 0.0),
            "a rotation of all (star, s^IJ and observer) about the normal of Z and the line of sight: no direction in space is marked",
        ),
        (
            Vector3::new(cos, sin, 0.0),
            "a rotation of all (star, s^IJ and observer) about the projection of the line of sight on X-Y: no direction in space is marked",
        ),
    ];
    let rotations = turns.into_iter().filter_map(|(axis, words)| Some((words, rotation(parameters, axis)?)));
    named.into_iter().chain(rotations).map(|(words, change)| Symmetry { words, change }).collect()
}

/// The change of all unknowns under a rotation of the inertial frame, unless a pole is met.
fn rotation(parameters: &Parameters<f64>, axis: Vector3<f64>) -> Option<Vec<(Parameter, f64)>> {
    let small = Dual64::new(0.0, 1.0);
    let turn = Matrix3::identity() + axis.cross_matrix().map(|value| small * value);
    // Omega^z does not change.
    let lifted = parameters.with_fixed_spin().lifted::<Dual64>();
    let state = lifted.state().rotated(&turn);
    let rates = state.rates(&lifted.spheroid).ok()?;
    let n = turn * lifted.observer().direction;
    let across = (n.x * n.x + n.y * n.y).sqrt();
    if across.re < 1e-6 {
        return None;
    }
    let turned = Parameters {
        coefficients: turn * lifted.coefficients * turn.transpose(),
        angles: state.angles().ok()?,
        alpha_rate: rates.alpha,
        beta_rate: rates.beta,
        theta_o: Real::atan2(across, n.z),
        phi_o: Real::atan2(n.y, n.x),
        ..lifted
    };
    let changed = Parameter::FITTED.into_iter().map(|parameter| (parameter, parameter.value(&turned).eps));
    Some(changed.filter(|(_, change)| *change != 0.0).collect())
}
