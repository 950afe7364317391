//! The section `[initial]`.

use std::f64::consts::PI;

use twofold::dynamics::BodyState;
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession};

use super::error::Fault;
use super::section::Section;
use super::star::Star;
use super::violation::Violation;

const ANGLES: [&str; 5] = ["alpha", "beta", "gamma", "alpha_rate", "beta_rate"];
const CONSTANTS: [&str; 6] = ["kind", "alpha_0", "beta_0", "amplitude", "phase", "gamma"];

/// The start of a motion in the paper's units.
pub(super) struct Initial {
    /// State in the frame of the file.
    pub(super) state: BodyState<f64>,
    /// Its Euler angles.
    pub(super) angles: EulerAngles<f64>,
    /// The printed perturbation solution in the same frame, time from the start, or why there is none.
    pub(super) perturbation: Result<Perturbation<f64>, &'static str>,
}

pub(super) fn read(section: &Section<'_>, star: &Star, violation: &Violation) -> Result<Initial, Fault> {
    section.only(&[
        "alpha",
        "beta",
        "gamma",
        "alpha_rate",
        "beta_rate",
        "kind",
        "alpha_0",
        "beta_0",
        "amplitude",
        "phase",
    ])?;
    let constants_given = CONSTANTS.iter().find(|&&key| key != "gamma" && section.has(key));
    let Some(constants_given) = constants_given else { return from_angles(section, star) };
    for angle in ANGLES {
        if angle != "gamma" {
            section.not_both(constants_given, angle)?;
        }
    }
    from_constants(section, star, violation)
}

fn from_angles(section: &Section<'_>, star: &Star) -> Result<Initial, Fault> {
    let angles = EulerAngles {
        alpha: section
            .required("alpha", "precession angle [rad], or `initial.kind` for the paper's constants")?
            .angle()?,
        beta: section
            .required("beta", "inclination of the symmetry axis to Z [rad]")?
            .number_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?,
        gamma: gamma(section)?,
    };
    let per_tc = star.units.time;
    let alpha_rate = section.required("alpha_rate", "rate of alpha")?.number()? * per_tc;
    let beta_rate = section.required("beta_rate", "rate of beta")?.number()? * per_tc;
    let rates = rates(star, &angles, alpha_rate, beta_rate);
    let state = BodyState::from_angles(&star.spheroid, &angles, &rates);
    refuse_overflow(section, &state)?;
    Ok(Initial { state, angles, perturbation: Err("[initial] gives angles and no constants (`initial.kind`)") })
}

fn from_constants(section: &Section<'_>, star: &Star, violation: &Violation) -> Result<Initial, Fault> {
    let kind_entry = section.required("kind", "\"twofold\" or \"single\"")?;
    let kind = match kind_entry.word(&["twofold", "single"])? {
        "twofold" => Precession::Twofold,
        _ => Precession::Single,
    };
    if star.spin == 0.0 {
        return Err(
            kind_entry.refuse("the paper's constants only with a spin that is not zero: Eq. (34) divides by it")
        );
    }
    let beta_entry = section.required("beta_0", "mean inclination [rad]")?;
    let beta_0 = beta_entry
        .number_where("an angle above 0 and below pi [rad]: Eq. (34) divides by sin(beta_0)", |x| {
            x > 0.0 && x < PI && x.sin() > f64::EPSILON
        })?;
    if kind == Precession::Twofold && beta_0.cos().abs() < 1e-12 {
        return Err(beta_entry.refuse("not pi/2 for kind \"twofold\": its rate is omega / cos(beta_0)"));
    }
    let constants = Constants {
        alpha_0: section.required("alpha_0", "mean precession angle at the start [rad]")?.angle()?,
        beta_0,
        amplitude: section.required("amplitude", "A, a rate")?.number()? * star.units.time,
        phase: section.required("phase", "phi [rad]")?.angle()?,
    };
    let printed =
        Perturbation::new(Form::Printed, kind, &star.spheroid, &violation.coefficients, star.spin, &constants)
            .map_err(|error| section.fault(format!("[initial] has no solution: {error}")))?;
    let start = printed.at(0.0);
    if !(0.0..=PI).contains(&start.beta) {
        return Err(section.fault(format!(
            "[initial] gives an inclination beta = {} rad by Eq. (34): allowed is from 0 to pi; the perturbation solution \
             does not describe such a motion",
            start.beta
        )));
    }
    let principal = EulerAngles { alpha: start.alpha, beta: start.beta, gamma: gamma(section)? };
    let rates = rates(star, &principal, start.alpha_rate, start.beta_rate);
    let state = BodyState::from_angles(&star.spheroid, &principal, &rates);
    refuse_overflow(section, &state)?;
    if violation.principal_from_given.is_identity(0.0) {
        return Ok(Initial { state, angles: principal, perturbation: Ok(printed) });
    }
    let state = state.rotated(&violation.principal_from_given.transpose());
    let angles = state.angles().unwrap_or(EulerAngles { alpha: 0.0, beta: state.axis.z.acos(), gamma: 0.0 });
    let perturbation = Err("its angles are those of the principal frame, which is not the frame of this file");
    Ok(Initial { state, angles, perturbation })
}

/// Rates with `gamma' = Omega^z - alpha' cos(beta)`, Eq. (24) `[firstint]`.
fn rates(star: &Star, angles: &EulerAngles<f64>, alpha: f64, beta: f64) -> EulerRates<f64> {
    EulerRates { alpha, beta, gamma: star.spin - alpha * angles.beta.cos() }
}

fn gamma(section: &Section<'_>) -> Result<f64, Fault> {
    section.optional("gamma").map_or(Ok(0.0), |entry| entry.angle())
}

fn refuse_overflow(section: &Section<'_>, state: &BodyState<f64>) -> Result<(), Fault> {
    if state.momentum.norm_squared().is_finite() {
        return Ok(());
    }
    Err(section.fault("[initial] gives an angular momentum beyond double precision: allowed are smaller rates"))
}
