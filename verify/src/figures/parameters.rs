//! The parameters of a figure in words.

use super::number::{beside, number};
use super::scale::Scale;
use super::subject::{Start, Subject};

/// Star, violation and initial values of motions, after what is given first.
pub(super) fn parameters(first: &str, subjects: &[&Subject]) -> String {
    let stars: Vec<_> = subjects.iter().map(|subject| star(&subject.start, &subject.scale)).collect();
    let mut text = first.to_owned();
    let one_star = stars.iter().all(|star| *star == stars[0]);
    if one_star {
        text += &stars[0];
    }
    for (subject, star) in subjects.iter().zip(&stars) {
        let name = if subjects.len() > 1 { format!(" {}:", subject.name) } else { String::new() };
        let star = if one_star { "" } else { star };
        text += &format!("{name}{star} {}", initial_values(&subject.start, &subject.scale));
    }
    format!("{} Angles in rad, time in {}.", text.trim_start(), subjects[0].scale.time_unit())
}

/// Observer and, where the figure is about it, beam of the first of some motions, which share them.
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

fn star(start: &Start, scale: &Scale) -> String {
    let (spheroid, s, units) = (&start.spheroid, &start.violation, &scale.units);
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
            number(units.momentum * units.time),
            number(units.time),
            number(scale.frequency(start.spin()))
        )
    } else {
        format!("*ε* = {oblateness}, *Ω*^{{*z*}} = {}", number(start.spin()))
    };
    format!("{body}; *s*^{{*XX*}}, *s*^{{*YY*}}, *s*^{{*ZZ*}} = {xx}, {yy}, {zz}{others}.")
}

fn initial_values(start: &Start, scale: &Scale) -> String {
    let angles = start.angles;
    let [alpha, beta, gamma] = [angles.alpha, angles.beta, angles.gamma].map(|angle| beside(angle, 1.0));
    let fastest = start.state.momentum.norm() / start.spheroid.inertia_xx;
    let rate = |rate: f64| beside(rate / scale.units.time, fastest / scale.units.time);
    let rates = start.state.rates(&start.spheroid).ok().map_or(String::new(), |rates| {
        format!(", d*α*/d*t* = {}, d*β*/d*t* = {}", rate(rates.alpha), rate(rates.beta))
    });
    format!("At *t* = 0: *α* = {alpha}, *β* = {beta}, *γ* = {gamma}{rates}.")
}
