//! The motions of the paper's four examples, with their perturbation solutions.

use std::sync::OnceLock;

use twofold::euler_angles::EulerAngles;
use twofold::plan::Method;
use twofold::solutions::perturbation::{Form, Perturbation};

use super::scale::Scale;
use super::subject::{Shown, Subject, TOLERANCE, corrected_solution};
use twofold_scene::scene_file::{Pulsar, Viewer};
use twofold_verify::paper_examples::{COEFFICIENTS, PaperExample, SPIN, paper_examples, spheroid};

pub(super) const OBSERVER: Viewer = Viewer { theta_o: 0.8, phi_o: 0.0, distance: None };

pub(super) const PULSAR: Pulsar = Pulsar { chi: 0.5, delta: 0.0, rho: 0.6, second_beam: false };

/// The paper's four examples, in its order.
pub fn examples() -> Result<[Subject; 4], String> {
    let [a, b, c, d] = paper_examples().map(|example| subject(&example));
    Ok([a?, b?, c?, d?])
}

fn subject(example: &PaperExample) -> Result<Subject, twofold::Error> {
    let (spheroid, first, problem) = (spheroid(), example.initial_values()?, example.problem()?);
    let initial_angles = EulerAngles { alpha: first.alpha, beta: first.beta, gamma: 0.0 };
    let printed = Perturbation::new(Form::Printed, example.kind, &spheroid, &COEFFICIENTS, SPIN, &example.constants)?;
    // Single precession has a period of 90 to 250 t_c, twofold precession of 4.
    let angles = match example.name {
        "sp-I" => 200.0,
        "sp-II" => 500.0,
        _ => 30.0,
    };
    let shown = Shown { angles, equatorial_axis: angles.min(40.0), beam: 200.0, waves: 100.0, pulses: 400.0 };
    Ok(Subject {
        name: example.name.to_owned(),
        motion: problem.motion_by(Method::Taylor, (0.0, 500.0), TOLERANCE)?,
        problem,
        initial_angles,
        scale: Scale::PAPER,
        corrected: corrected_solution(&printed, &spheroid, &COEFFICIENTS, SPIN),
        printed: Ok(printed),
        observer: Some(OBSERVER),
        pulsar: Some(PULSAR),
        shown,
        rotation_rate: problem.initial().momentum.norm() / spheroid.inertia_xx,
        quasi_periodic: OnceLock::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angles in captions are those of the state, with `gamma` zero.
    #[test]
    fn examples_start_at_their_angles() {
        for example in examples().unwrap() {
            let state = example.problem.initial().angles().unwrap();
            let told = example.initial_angles;
            assert_eq!(told.gamma, 0.0);
            for (told, found) in [(told.alpha, state.alpha), (told.beta, state.beta), (0.0, state.gamma)] {
                assert!((told - found).abs() < 1e-15, "{}: {told} {found}", example.name);
            }
        }
    }

    /// With `L` nearly along Z the axis goes round Z as fast as in free precession.
    #[test]
    fn the_rate_of_rotation_is_that_of_the_axis_about_the_momentum() {
        let [example, ..] = examples().unwrap();
        let rate = example.problem.initial().rates(example.problem.spheroid()).unwrap().alpha;
        assert!((example.rotation_rate / rate - 1.0).abs() < 0.05, "{} {rate}", example.rotation_rate);
    }
}
