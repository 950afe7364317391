//! The parameters of a figure in words.

use super::number::{beside, number};
use super::subject::Subject;

/// Star, violation and initial values of motions, after the text `first`.
pub(super) fn parameters(first: &str, subjects: &[&Subject]) -> String {
    let stars: Vec<_> = subjects.iter().map(|subject| star(subject)).collect();
    let mut text = first.to_owned();
    let one_star = stars.iter().all(|star| *star == stars[0]);
    if one_star {
        text += &stars[0];
    }
    for (subject, star) in subjects.iter().zip(&stars) {
        let name = if subjects.len() > 1 { format!(" {}:", subject.name) } else { String::new() };
        let star = if one_star { "" } else { star };
        text += &format!("{name}{star} {}", initial_values(subject));
    }
    format!("{} Angles in rad, time in {}.", text.trim_start(), subjects[0].scale.time_unit())
}

/// Observer and, if the figure needs it, beam of the first of some motions, which share them.
pub(super) fn line_of_sight(subjects: &[&Subject], with_beam: bool) -> String {
    let mut text = String::new();
    if let Some(viewer) = subjects.first().and_then(|subject| subject.observer) {
        text += &format!("*θ*_{{o}} = {}, *φ*_{{o}} = {}", number(viewer.theta_o), number(viewer.phi_o));
    }
    if let Some(pulsar) = subjects.first().and_then(|subject| subject.pulsar).filter(|_| with_beam) {
        let [chi, delta, rho] = [pulsar.chi, pulsar.delta, pulsar.rho].map(number);
        text += &format!(", *χ* = {chi}, *δ* = {delta}, *ρ* = {rho}");
    }
    text + ". "
}

fn star(subject: &Subject) -> String {
    let Subject { problem, scale, .. } = subject;
    let (spheroid, s, units) = (problem.spheroid(), problem.coefficients(), &scale.units);
    let size = s.norm();
    let off_diagonal = [(0, 1), (0, 2), (1, 2)].map(|place| beside(s[place], size));
    let others = match off_diagonal.iter().any(|component| component != "0") {
        true => {
            let [xy, xz, yz] = off_diagonal;
            format!("; *s*^{{*XY*}}, *s*^{{*XZ*}}, *s*^{{*YZ*}} = {xy}, {xz}, {yz}")
        }
        false => String::new(),
    };
    let [xx, yy, zz] = [0, 1, 2].map(|i| beside(s[(i, i)], size));
    let oblateness = number(spheroid.oblateness());
    let body = if units.are_physical() {
        format!(
            "*ε* = {oblateness}, *I*^{{*xx*}} = {} g cm^{{2}}, *t*_{{c}} = {} s, *Ω*^{{*z*}}/(2π) = {} Hz",
            number(units.momentum * units.time * spheroid.inertia_xx),
            number(units.time),
            number(scale.frequency(subject.spin()))
        )
    } else {
        format!("*ε* = {oblateness}, *Ω*^{{*z*}} = {}", number(subject.spin()))
    };
    format!("{body}; *s*^{{*XX*}}, *s*^{{*YY*}}, *s*^{{*ZZ*}} = {xx}, {yy}, {zz}{others}.")
}

fn initial_values(subject: &Subject) -> String {
    let Subject { problem, initial_angles: angles, scale, .. } = subject;
    let (spheroid, state) = (problem.spheroid(), problem.initial());
    let [alpha, beta, gamma] = [angles.alpha, angles.beta, angles.gamma].map(|angle| beside(angle, 1.0));
    let fastest = state.momentum.norm() / spheroid.inertia_xx;
    let rate = |rate: f64| beside(rate / scale.units.time, fastest / scale.units.time);
    let rates = state.rates(spheroid).ok().map_or(String::new(), |rates| {
        format!(", d*α*/d*t* = {}, d*β*/d*t* = {}", rate(rates.alpha), rate(rates.beta))
    });
    format!("At *t* = 0: *α* = {alpha}, *β* = {beta}, *γ* = {gamma}{rates}.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3};
    use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
    use twofold::euler_angles::EulerAngles;
    use twofold_scene::scene_file::Scene;

    const STAR: &str = "[star]\nmass = 1.4\nradius = 12.0\noblateness = 1e-9\nspin_frequency = 30.0\n\
        [lorentz_violation]\ntensor = [[0.01, 0.002, -0.003], [0.002, -0.04, 0.005], [-0.003, 0.005, 0.06]]\n\
        [initial]\nalpha = 0.3\nbeta = 0.8\ngamma = 1.7\nalpha_rate = 210.0\nbeta_rate = -13.0\n\
        [observer]\ntheta_o = 0.9\nphi_o = 2.4\n[pulsar]\nchi = 0.5\ndelta = 0.25\nrho = 0.4\n[time]\nspan = 0.5\nsamples = 3\n";

    /// `I = (2/5) M R^2` for a sphere with the nominal solar mass and G of CODATA 2022.
    #[test]
    fn a_caption_has_the_numbers_of_the_scene() {
        let scene = Scene::from_toml("star", STAR).unwrap();
        let subject = Subject::of_scene("star", &scene).unwrap();
        let text = parameters("", &[&subject]) + &line_of_sight(&[&subject], true);
        let plain: String = text.chars().filter(|c| !"*{}^_".contains(*c)).collect();
        let inertia = 0.4 * 1.4 * (1.327_124_4e20 / 6.674_30e-11) * 1.2e4_f64.powi(2) * 1e7;
        for phrase in [
            &format!("Ixx = {} g cm2", number(inertia).chars().filter(|c| !"*{}^_".contains(*c)).collect::<String>()),
            "Ωz/(2π) = 30 Hz",
            "sXX, sYY, sZZ = 0.01, −0.04, 0.06; sXY, sXZ, sYZ = 0.002, −0.003, 0.005.",
            "α = 0.3, β = 0.8, γ = 1.7, dα/dt = 210, dβ/dt = −13.",
            "time in s.",
            "θo = 0.9, φo = 2.4, χ = 0.5, δ = 0.25, ρ = 0.4.",
        ] {
            assert!(plain.contains(phrase), "no `{phrase}` in {plain}");
        }
        // A rate below 1e-12 of the rotation is rounding.
        for (inclining, is_zero) in [("1e-9", false), ("1e-10", true)] {
            let toml = STAR.replace("beta_rate = -13.0", &format!("beta_rate = {inclining}"));
            let scene = Scene::from_toml("star", &toml).unwrap();
            let text = parameters("", &[&Subject::of_scene("star", &scene).unwrap()]);
            let plain: String = text.chars().filter(|c| !"*{}^_".contains(*c)).collect();
            assert_eq!(plain.contains("dβ/dt = 0."), is_zero, "{plain}");
        }
        // Half a second is shown completely: it is less than a hundred turns.
        assert!((subject.shown.pulses * scene.units.time - 0.5).abs() < 1e-12);
    }

    /// Common parameters of motions are stated once.
    #[test]
    fn motions_of_one_star_share_its_numbers() {
        let subject = |name: &str, toml: &str| Subject::of_scene(name, &Scene::from_toml(name, toml).unwrap()).unwrap();
        let first = subject("first", STAR);
        let tilted = subject("tilted", &STAR.replace("beta = 0.8", "beta = 0.9"));
        let flat = subject("flat", &STAR.replace("oblateness = 1e-9", "oblateness = 2e-9"));
        let told = |subjects: &[&Subject]| {
            let text = parameters("", subjects);
            (
                text.matches("*ε* =").count(),
                subjects.iter().map(|subject| text.contains(&format!("{}:", subject.name))).collect::<Vec<_>>(),
            )
        };
        assert_eq!(told(&[&first]), (1, vec![false]));
        assert_eq!(told(&[&first, &tilted]), (1, vec![true, true]));
        assert_eq!(told(&[&first, &flat]), (2, vec![true, true]));
    }

    /// With `L` near Z, out of the plane of Z and the axis by `d`, `beta'` is `d / I^xx`; `|L| / I^xx` is one.
    #[test]
    fn what_is_a_rounding_beside_the_rotation_is_zero() {
        let told = |beta_rate: f64, alpha: f64| {
            let spheroid = RigidSpheroid { inertia_xx: 2.0, inertia_zz: 2.2, constant_c: 1.0 };
            let (axis, equatorial_axis) = (Vector3::new(0.8, 0.0, 0.6), Vector3::y());
            let state = BodyState { axis, momentum: Vector3::new(0.0, 2.0 * beta_rate, 2.0), equatorial_axis };
            let problem = Problem::new(spheroid, Matrix3::zeros(), state).unwrap();
            let angles = EulerAngles { alpha, beta: 0.0, gamma: 0.0 };
            initial_values(&Subject::new("a", problem, angles, 1.0).unwrap())
        };
        let of = |alpha: &str, rate: &str| {
            format!("At *t* = 0: *α* = {alpha}, *β* = 0, *γ* = 0, d*α*/d*t* = 1, d*β*/d*t* = {rate}.")
        };
        assert_eq!(told(1.5e-12, 1.5e-12), of("1.5 × 10^{−12}", "1.5 × 10^{−12}"));
        assert_eq!(told(0.9e-12, 0.9e-12), of("0", "0"));
    }
}
