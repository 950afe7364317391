//! A motion with the data that figures need.

use std::sync::OnceLock;

use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::euler_angles::EulerAngles;
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::spectrum::QuasiPeriodicMotion;
use twofold::plan::{Method, PlannedMotion};
use twofold::propagation::{ContinuousAngles, Motion};
use twofold::solutions::perturbation::{Form, Perturbation, constants_from_initial_values};

use super::scale::Scale;
use twofold_scene::scene_file::{Pulsar, Scene, Viewer};

/// Truncation error of the motions, far below what a picture shows; the data of the figures are written with all digits.
pub(super) const TOLERANCE: f64 = 1e-14;

/// Parts of a motion in the figures, in `t_c` from the start; none is longer than the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shown {
    /// Angles and the path of `e_z`.
    pub angles: f64,
    /// The path of `e_x`, which is wound more tightly.
    pub equatorial_axis: f64,
    /// `m.n`.
    pub beam: f64,
    pub waves: f64,
    pub pulses: f64,
}

/// A motion with everything that its figures need.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name in headings, `tp-I`; markup.
    pub name: String,
    /// The star, `s^IJ` and the state at the start, in the paper's units: `I^xx = C = 1`, time in `t_c`.
    pub problem: Problem<f64>,
    /// Euler angles of that state.
    pub initial_angles: EulerAngles<f64>,
    /// Units of the figures.
    pub scale: Scale,
    /// The perturbation solution whose constants give the motion, as printed, or the reason why there is none.
    pub printed: Result<Perturbation<f64>, &'static str>,
    /// The corrected solution with the same initial values.
    pub corrected: Option<Perturbation<f64>>,
    pub observer: Option<Viewer>,
    pub pulsar: Option<Pulsar>,
    pub shown: Shown,
    pub motion: PlannedMotion,
    /// Rate of rotation, rad/t_c.
    pub(super) rotation_rate: f64,
    pub(super) quasi_periodic: OnceLock<Result<QuasiPeriodicMotion, String>>,
}

/// Largest rotation in figures of any motion (rad): about a hundred turns, beyond which curves merge.
const MOST_ROTATION: f64 = 600.0;

impl Subject {
    /// The motion of `duration` (t_c, either sign) without observer and beam, shown for as long as curves can be distinguished.
    pub fn new(
        name: &str,
        problem: Problem<f64>,
        initial_angles: EulerAngles<f64>,
        duration: f64,
    ) -> Result<Self, String> {
        let spheroid = problem.spheroid();
        let torque = spheroid.constant_c.abs() * problem.coefficients().norm();
        // A star at rest turns at the rate of its swing, and without a torque not at all.
        let swing = (2.0 * torque / spheroid.inertia_xx).sqrt();
        let rate = (problem.initial().momentum.norm() / spheroid.inertia_xx).max(swing);
        let rate = if rate > 0.0 { rate } else { 1.0 / duration.abs() };
        let at_most = |rotation: f64| duration.abs().min(rotation / rate).copysign(duration);
        let all = at_most(MOST_ROTATION);
        let shown = Shown {
            angles: at_most(0.4 * MOST_ROTATION),
            equatorial_axis: at_most(0.1 * MOST_ROTATION),
            beam: at_most(0.5 * MOST_ROTATION),
            waves: at_most(0.25 * MOST_ROTATION),
            pulses: all,
        };
        let method = if problem.bulge() == 0.0 { Method::Taylor } else { Method::Averaged };
        let motion = problem.motion_by(method, (0.0, all), TOLERANCE).map_err(|error| format!("{name}: {error}"))?;
        Ok(Self {
            name: name.to_owned(),
            problem,
            initial_angles,
            scale: Scale::PAPER,
            printed: Err("no constants are given"),
            corrected: None,
            observer: None,
            pulsar: None,
            shown,
            motion,
            rotation_rate: rate,
            quasi_periodic: OnceLock::new(),
        })
    }

    /// The motion of a scene.
    pub fn of_scene(name: &str, scene: &Scene) -> Result<Self, String> {
        let motion = Self::new(name, scene.problem, scene.initial_angles, scene.duration())?;
        let (scale, printed) = (Scale::of_scene(scene), scene.perturbation);
        // A scene has a perturbation solution if its tensor is diagonal.
        let s = scene.problem.coefficients().diagonal();
        let s = PrincipalCoefficients::new([s.x, s.y, s.z]);
        let corrected = printed
            .as_ref()
            .ok()
            .and_then(|printed| corrected_solution(printed, scene.problem.spheroid(), &s, motion.spin()));
        Ok(Self { scale, printed, corrected, observer: scene.observer, pulsar: scene.pulsar, ..motion })
    }

    /// How the motion is found, in a word.
    pub(super) fn kind(&self) -> &'static str {
        if self.problem.bulge() == 0.0 { "numerical" } else { "averaged" }
    }

    /// `Omega^z`.
    pub(super) fn spin(&self) -> f64 {
        let BodyState { axis, momentum, .. } = self.problem.initial();
        momentum.dot(axis) / self.problem.spheroid().inertia_zz
    }

    /// The motion as a function of its angles, computed once.
    pub(super) fn quasi_periodic(&self) -> Result<&QuasiPeriodicMotion, String> {
        let found = self
            .quasi_periodic
            .get_or_init(|| QuasiPeriodicMotion::new(&self.problem).map_err(|why| format!("{}: {why}", self.name)));
        found.as_ref().map_err(Clone::clone)
    }

    /// The observer.
    pub(super) fn viewer(&self) -> Result<Viewer, String> {
        self.observer.ok_or_else(|| format!("{}: no observer is given", self.name))
    }

    pub(super) fn lacks_distance(&self) -> bool {
        self.scale.units.are_physical() && self.observer.is_some_and(|viewer| viewer.distance.is_none())
    }

    /// The observer and the beam.
    pub(super) fn line_of_sight(&self) -> Result<(Viewer, Pulsar), String> {
        Ok((self.viewer()?, self.pulsar.ok_or_else(|| format!("{}: no beam is given", self.name))?))
    }

    /// `alpha'` and `|gamma'|` of free precession, Eq. (48), in the unit of the figure, if the motion is twofold precession given by its constants.
    pub(super) fn free_rates(&self) -> Vec<f64> {
        let twofold = self.printed.ok().filter(|solution| solution.zeroth_rate != 0.0);
        let gamma = self.problem.spheroid().oblateness() * self.spin();
        let drawn = |omega: f64| self.scale.frequency(omega.abs());
        twofold.map_or(Vec::new(), |solution| vec![drawn(solution.zeroth_rate), drawn(gamma)])
    }

    pub(super) fn state(&self, t: f64) -> Result<BodyState<f64>, String> {
        self.motion.state(t).map_err(|error| format!("{}: {error}", self.name))
    }

    /// Continuous Euler angles at ordered times; times at a pole, where the angles are undefined, are left out.
    pub(super) fn angles(&self, times: &[f64]) -> Result<Vec<(f64, EulerAngles<f64>)>, String> {
        let mut angles = ContinuousAngles::new(&self.motion, 0.0, &self.initial_angles)
            .map_err(|error| format!("{}: {error}", self.name))?;
        Ok(times.iter().filter_map(|&t| Some((t, angles.at(t).ok()?))).collect())
    }
}

/// The corrected solution with the initial values of the printed one; `None` if none is found.
pub(super) fn corrected_solution(
    printed: &Perturbation<f64>,
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    spin: f64,
) -> Option<Perturbation<f64>> {
    let (kind, start) = (printed.kind, printed.at(0.0));
    let constants = constants_from_initial_values(Form::Corrected, kind, spheroid, s, spin, &start).ok()?;
    Perturbation::new(Form::Corrected, kind, spheroid, s, spin, &constants).ok()
}

/// `count + 1` times from zero to `end`.
pub(super) fn times(end: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| if i == count { end } else { end * i as f64 / count as f64 }).collect()
}

/// Numbers with equally spaced logarithms, from one power of ten to another.
pub(super) fn powers_of_ten((low, high, count): (f64, f64, usize)) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| 10f64.powf(low + (high - low) * i as f64 / (count - 1) as f64))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::figures::fixtures::{CONSTANTS, star};

    fn subject(c: f64, eigenvalue: f64, momentum: f64, duration: f64) -> Subject {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.3 * 1.1, constant_c: c };
        let s = Matrix3::from_diagonal(&(Vector3::new(1.0, 2.0, -3.0) * eigenvalue));
        let (axis, equatorial_axis) = (Vector3::z(), Vector3::x());
        let state = BodyState { axis, equatorial_axis, momentum: Vector3::new(0.28, 0.0, 0.96) * momentum };
        let angles = EulerAngles { alpha: 0.0, beta: 0.0, gamma: 0.0 };
        Subject::new("a star", Problem::new(spheroid, s, state).unwrap(), angles, duration).unwrap()
    }

    /// Fractions of 600 rad at the rate of rotation, or of a swing; a shorter motion is shown completely.
    #[test]
    fn a_figure_shows_so_much_rotation() {
        let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        // |L| / I^xx, above sqrt(2 C |s| / I^xx), which is 0.13.
        for (subject, rate) in [
            (subject(0.8, 0.004, 1.7, 1e3), 1.7 / 1.3),
            (subject(0.8, 0.004, 1.7, -1e3), -1.7 / 1.3),
            (subject(0.8, 0.4, 0.01, 1e3), f64::sqrt(2.0 * 0.8 * 0.4 * f64::sqrt(14.0) / 1.3)),
            (subject(-0.8, 0.4, 0.01, 1e3), f64::sqrt(2.0 * 0.8 * 0.4 * f64::sqrt(14.0) / 1.3)),
        ] {
            let Shown { angles, equatorial_axis, beam, waves, pulses } = subject.shown;
            let rotation = [(angles, 240.0), (equatorial_axis, 60.0), (beam, 300.0), (waves, 150.0), (pulses, 600.0)];
            for (shown, rotation) in rotation {
                near(shown * rate, rotation);
            }
            near(subject.rotation_rate, rate.abs());
            assert!(subject.state(0.999 * pulses).is_ok());
        }
        for duration in [0.1, -0.1] {
            let Shown { angles, equatorial_axis, beam, waves, pulses } = subject(0.8, 0.004, 1.7, duration).shown;
            assert_eq!([angles, equatorial_axis, beam, waves, pulses], [duration; 5]);
        }
        // A star at rest without a torque.
        let at_rest = subject(0.8, 0.0, 0.0, -50.0);
        assert_eq!([at_rest.rotation_rate, at_rest.shown.angles], [0.02, -50.0]);
    }

    /// A wave of a physical star needs a distance, a wave in the paper's units does not.
    #[test]
    fn a_physical_star_without_a_distance_lacks_it() {
        let lacks =
            |toml: &str| Subject::of_scene("star", &Scene::from_toml("star", toml).unwrap()).unwrap().lacks_distance();
        let physical = "star = { mass = 1.4, radius = 12.0, oblateness = 1e-3, spin_frequency = 57.0 }\n\
            lorentz_violation = { eigenvalues = [0.0, 0.0, 0.0] }\n\
            initial = { alpha = 0.4, beta = 0.3, gamma = 1.3, alpha_rate = 375.0, beta_rate = 0.0 }\n\
            time = { span = 2.0, samples = 3 }\n";
        assert!(lacks(&format!("{physical}observer = {{ theta_o = 1.1, phi_o = 0.6 }}\n")));
        assert!(!lacks(&format!("{physical}observer = {{ theta_o = 1.1, phi_o = 0.6, distance = 2.5 }}\n")));
        assert!(!lacks(physical));
        assert!(!Subject::of_scene("tp-1", &Scene::named("tp-1").unwrap()).unwrap().lacks_distance());
    }

    #[test]
    fn powers_of_ten_are_at_even_distances() {
        let found: Vec<_> = powers_of_ten((-2.0, 1.0, 7)).collect();
        let ten = f64::sqrt(10.0);
        let expected = [1e-2, 1e-2 * ten, 0.1, 0.1 * ten, 1.0, ten, 10.0];
        assert_eq!(found.len(), expected.len());
        // The rounding of the logarithm is about 2^-52, and the power multiplies it by ln 10.
        assert!(
            found.iter().zip(expected).all(|(found, expected)| (found / expected - 1.0).abs() < 2e-15),
            "{found:?}"
        );
    }

    #[test]
    fn the_corrected_solution_is_that_of_the_eigenvalues_of_the_scene() {
        let scene = star("a", 1.0, [0.03, 0.01, -0.04], CONSTANTS);
        let s = PrincipalCoefficients { xx: 0.03, yy: 0.01, zz: -0.04 };
        let expected = corrected_solution(&scene.printed.unwrap(), scene.problem.spheroid(), &s, 1.0).unwrap();
        let found = scene.corrected.unwrap();
        for (found, expected) in [(found.rate, expected.rate), (found.c_tilde, expected.c_tilde)] {
            assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
        }
    }
}
