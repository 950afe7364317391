//! The parameters of a figure in words.

use super::axes::signed;
use super::subject::{Start, Subject};

/// Star, violation and initial values of motions, after what is given first.
pub(super) fn parameters(first: &str, subjects: &[&Subject]) -> String {
    let stars: Vec<_> = subjects.iter().map(|subject| star(&subject.start)).collect();
    let mut text = first.to_owned();
    let one_star = stars.iter().all(|star| *star == stars[0]);
    if one_star {
        text += &stars[0];
    }
    for (subject, star) in subjects.iter().zip(&stars) {
        let name = if subjects.len() > 1 { format!(" {}:", subject.name) } else { String::new() };
        let star = if one_star { "" } else { star };
        text += &format!("{name}{star} {}", initial_values(&subject.start));
    }
    format!("{} Angles in rad, time in *t*_{{c}}.", text.trim_start())
}

/// Observer and, where the figure is about it, beam of the first of some motions, which share them.
pub(super) fn line_of_sight(subjects: &[&Subject], with_beam: bool) -> String {
    let mut text = String::new();
    if let Some(viewer) = subjects.first().and_then(|subject| subject.observer) {
        text += &format!("*θ*_{{o}} = {}, *φ*_{{o}} = {}", viewer.theta_o, viewer.phi_o);
    }
    if let Some(pulsar) = subjects.first().and_then(|subject| subject.pulsar).filter(|_| with_beam) {
        text += &format!(", *χ* = {}, *δ* = {}, *ρ* = {}", pulsar.chi, pulsar.delta, pulsar.rho);
    }
    text + ". "
}

fn star(start: &Start) -> String {
    let (spheroid, s) = (&start.spheroid, &start.violation);
    let off_diagonal = [(0, 1), (0, 2), (1, 2)].map(|place| s[place]);
    let others = match off_diagonal.iter().any(|&component| component != 0.0) {
        true => {
            let [xy, xz, yz] = off_diagonal.map(number);
            format!("; *s*^{{*XY*}}, *s*^{{*XZ*}}, *s*^{{*YZ*}} = {xy}, {xz}, {yz}")
        }
        false => String::new(),
    };
    format!(
        "*I*^{{*zz*}}/*I*^{{*xx*}} = {}, *Ω*^{{*z*}} = {}; *s*^{{*XX*}}, *s*^{{*YY*}}, *s*^{{*ZZ*}} = {}, {}, {}{others}.",
        number(spheroid.inertia_zz / spheroid.inertia_xx),
        number(start.spin()),
        number(s[(0, 0)]),
        number(s[(1, 1)]),
        number(s[(2, 2)]),
    )
}

fn initial_values(start: &Start) -> String {
    let angles = start.angles;
    let [alpha, beta, gamma] = [angles.alpha, angles.beta, angles.gamma].map(number);
    let rates = start.state.rates(&start.spheroid).ok().map_or(String::new(), |rates| {
        format!(", d*α*/d*t* = {}, d*β*/d*t* = {}", number(rates.alpha), number(rates.beta))
    });
    format!("At *t* = 0: *α* = {alpha}, *β* = {beta}, *γ* = {gamma}{rates}.")
}

/// Six significant digits without trailing zeros; a number below 1e-12 is the rounding of a zero.
fn number(x: f64) -> String {
    if x.abs() < 1e-12 {
        return "0".into();
    }
    let decimals = (5.0 - x.abs().log10().floor()).max(0.0) as usize;
    let digits = format!("{x:.decimals$}");
    signed(if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits })
}
