//! The motions of the paper's four examples, with their perturbation solutions.

use std::sync::OnceLock;

use nalgebra::{Matrix4, Vector4};
use num_dual::Dual64;
use twofold::dynamics::RigidSpheroid;
use twofold::dynamics::euler_angle_equations::AxisAngles;
use twofold::euler_angles::EulerAngles;
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::propagate;
use twofold::scalar::Real;
use twofold::solutions::perturbation::{Constants, Kind, Perturbation};

use super::scale::Scale;
use super::subject::{ACCURACY, Shown, Start, Subject};
use crate::paper_examples::{COEFFICIENTS, PaperExample, SPIN, paper_examples, spheroid};
use crate::scene_file::{Pulsar, Viewer};

/// The observer of the paper's figures.
pub(super) const OBSERVER: Viewer = Viewer { theta_o: 0.8, phi_o: 0.0, distance: None };

/// The beam of the paper's figures.
const PULSAR: Pulsar = Pulsar { chi: 0.5, delta: 0.0, rho: 0.6, second_beam: false };

/// Length of the series of which spectra are taken (t_c): pairs of lines of tp-II are 0.0024 apart.
const SPECTRUM_DURATION: f64 = 17_150.0;

/// The paper's four examples, in its order.
///
/// # Errors
/// None for the four examples.
pub fn examples() -> Result<[Subject; 4], String> {
    let [a, b, c, d] = paper_examples().map(|example| subject(&example).map_err(|error| error.to_string()));
    Ok([a?, b?, c?, d?])
}

fn subject(example: &PaperExample) -> Result<Subject, twofold::Error> {
    let (spheroid, first, state) = (spheroid(), example.initial_values()?, example.initial_state()?);
    let angles = EulerAngles { alpha: first.alpha, beta: first.beta, gamma: 0.0 };
    let start = Start { spheroid, violation: COEFFICIENTS.tensor(), state, angles };
    let printed = Perturbation::printed(example.kind, &spheroid, &COEFFICIENTS, SPIN, &example.constants)?;
    let corrected = match example.kind {
        Kind::Twofold => corrected_solution(&first, &example.constants)?,
        Kind::Single => None,
    };
    // Single precession goes round once in 90 to 250 t_c, twofold precession in 4.
    let angles = match example.name {
        "sp-I" => 200.0,
        "sp-II" => 500.0,
        _ => 30.0,
    };
    let shown = Shown { angles, equatorial_axis: angles.min(40.0), beam: 200.0, waves: 100.0, pulses: 400.0 };
    let motion = propagate(&start.spheroid, &start.violation, &start.state, (0.0, 500.0), ACCURACY)?;
    Ok(Subject {
        name: example.name.to_owned(),
        start,
        scale: Scale::PAPER,
        printed: Ok(printed),
        corrected,
        observer: Some(OBSERVER),
        pulsar: Some(PULSAR),
        shown,
        motion,
        spectrum_duration: SPECTRUM_DURATION,
        long: OnceLock::new(),
    })
}

/// The corrected solution that has the initial values `first`, by Newton's method from the constants of the printed one;
/// none where that does not lead to it.
fn corrected_solution(
    first: &AxisAngles<f64>,
    printed: &Constants<f64>,
) -> Result<Option<Perturbation<f64>>, twofold::Error> {
    let wanted = Vector4::new(first.alpha, first.beta, first.alpha_rate, first.beta_rate);
    // The phase of no amplitude would have no derivative.
    let mut x = Vector4::new(printed.alpha_0, printed.beta_0, printed.amplitude.max(1e-4), printed.phase);
    for _ in 0..30 {
        let mut jacobian = Matrix4::zeros();
        let mut residual = Vector4::zeros();
        for i in 0..4 {
            let number = |j: usize| Dual64::new(x[j], if i == j { 1.0 } else { 0.0 });
            let q = corrected(number(0), number(1), number(2), number(3))?.at(Dual64::new(0.0, 0.0));
            let q = [q.alpha, q.beta, q.alpha_rate, q.beta_rate];
            jacobian.set_column(i, &Vector4::from(q.map(|number| number.eps)));
            residual = Vector4::from(q.map(|number| number.re)) - wanted;
        }
        let Some(inverse) = jacobian.try_inverse() else { return Ok(None) };
        let step = inverse * residual;
        x -= step * (0.2 / step.norm()).min(1.0);
        if step.norm() < 1e-12 {
            return corrected(x[0], x[1], x[2], x[3]).map(Some);
        }
    }
    Ok(None)
}

fn corrected<S: Real>(alpha_0: S, beta_0: S, amplitude: S, phase: S) -> Result<Perturbation<S>, twofold::Error> {
    let constant = S::from_f64;
    let paper = spheroid();
    let spheroid = RigidSpheroid {
        inertia_xx: constant(paper.inertia_xx),
        inertia_zz: constant(paper.inertia_zz),
        constant_c: constant(paper.constant_c),
    };
    let s = PrincipalCoefficients::new([COEFFICIENTS.xx, COEFFICIENTS.yy, COEFFICIENTS.zz].map(constant));
    let constants = Constants { alpha_0, beta_0, amplitude, phase };
    Perturbation::corrected_twofold(&spheroid, &s, constant(SPIN), &constants)
}
