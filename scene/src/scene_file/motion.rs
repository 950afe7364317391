//! The sections that define the motion and the units of the file: `[star]`, `[lorentz_violation]` and `[initial]`.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};
use twofold::Error;
use twofold::dynamics::{BodyState, RigidSpheroid, RotationState};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::{PrincipalCoefficients, coefficients_from_preferred_frame, principal_frame};
use twofold::solutions::perturbation::{Constants, Form, Perturbation, Precession};
use twofold::star::potential_coefficients::potential_coefficients;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;
use twofold::units::geometrised::{CENTIMETRE, ERG, GRAM, GRAM_PER_CUBIC_CENTIMETRE, KILOMETRE, SOLAR_MASS};
use twofold::units::si::GRAM_SQUARE_CENTIMETRE;

use super::document::{Entry, Section};
use super::fault::Fault;
use super::observation::Pulsar;
use super::rotation::{Rotation, WobbleAngles, rotation};
use crate::significant::significant;

/// Units of a scene file and of its output: those of the paper, or seconds and cgs units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// `t_c` in the unit of time.
    pub time: f64,
    /// The model's unit of angular momentum in that of the output: `I^xx / t_c` times a factor that is one to `2.2e-16 / oblateness`.
    pub momentum: f64,
    /// The model's unit of energy in that of the output: `C` times the same factor.
    pub energy: f64,
    /// Name of the unit of time.
    pub time_name: &'static str,
    /// Name of the unit of angular momentum.
    pub momentum_name: &'static str,
    /// Name of the unit of energy.
    pub energy_name: &'static str,
}

impl Units {
    /// `I^xx = C = 1`.
    pub const PAPER: Self =
        Self { time: 1.0, momentum: 1.0, energy: 1.0, time_name: "t_c", momentum_name: "I_xx/t_c", energy_name: "C" };

    /// The model's unit of the moment of inertia of a physical star in kg m^2.
    pub fn inertia_in_si(&self) -> f64 {
        self.momentum * self.time * GRAM_SQUARE_CENTIMETRE
    }

    /// Whether these are seconds and cgs units.
    pub fn are_physical(&self) -> bool {
        self.time_name == "s"
    }
}

pub(super) struct Star {
    /// The body in units in which `I^xx` and `C` are one, or nearly one.
    pub(super) spheroid: RigidSpheroid<f64>,
    /// `Omega^z` in 1/t_c.
    pub(super) spin: f64,
    /// Coefficient of the bulge in units of `1 / I^xx`.
    pub(super) bulge: f64,
    pub(super) units: Units,
}

/// The star, and a caution if it spins faster than gravity can hold it. The angles of the wobble and of the magnetic axis are needed for observed
/// rates.
pub(super) fn read_star(section: &Section<'_>, angles: &WobbleAngles) -> Result<(Star, Option<String>), Fault> {
    section
        .only("inertia_ratio spin mass radius density oblateness precession_period spin_frequency frequency bulge")?;
    section.not_both(&[("oblateness", "precession_period"), ("spin_frequency", "frequency")])?;
    let physical_keys = "mass radius density oblateness precession_period spin_frequency frequency bulge";
    for physical in physical_keys.split(' ') {
        section.not_both(&[("inertia_ratio", physical), ("spin", physical)])?;
    }
    section.not_both(&[("radius", "density")])?;
    if section.has("inertia_ratio") || section.has("spin") {
        Ok((in_units_of_tc(section)?, None))
    } else {
        physical(section, angles)
    }
}

fn in_units_of_tc(section: &Section<'_>) -> Result<Star, Fault> {
    let ratio = section
        .required("inertia_ratio", "I^zz / I^xx")?
        .number_in("from 1e-3 to 2; I^zz <= I^xx + I^yy for any distribution of mass", 1e-3..=2.0)?;
    let spin = section.required("spin", "Omega^z in 1/t_c")?.number()?;
    Ok(Star { spheroid: RigidSpheroid::in_units_of_tc(ratio), spin, bulge: 0.0, units: Units::PAPER })
}

fn physical(section: &Section<'_>, angles: &WobbleAngles) -> Result<(Star, Option<String>), Fault> {
    let mass = section
        .required("mass", "in solar masses; or `star.inertia_ratio` and `star.spin` for the paper's units")?
        .number_in("a mass from 1e-3 to 1e3 [solar masses]", 1e-3..=1e3)?;
    let Rotation { entry: spin_entry, frequency, oblateness } = rotation(section, angles)?;
    // Geometrised units (G = c = 1, base second) internally, cgs units externally.
    let mean_radius = match (section.optional("radius"), section.optional("density")) {
        (Some(radius), _) => radius.number_in("a radius from 1 to 1e7 [km]", 1.0..=1e7)? * KILOMETRE,
        (None, Some(density)) => {
            let density = density.number_in("a density from 1e-6 to 1e17 [g/cm^3]", 1e-6..=1e17)?;
            (mass * SOLAR_MASS * 0.75 / (PI * density * GRAM_PER_CUBIC_CENTIMETRE)).cbrt()
        }
        (None, None) => return Err(section.missing("`star.radius` [km] or `star.density` [g/cm^3]")),
    };
    if mean_radius <= 2.0 * mass * SOLAR_MASS {
        let horizon = 2.0 * mass * SOLAR_MASS / KILOMETRE;
        return Err(section.fault(format!(
            "[star] has a mean radius of {:.3} km: must be above 2 G M / c^2 = {horizon:.3} km",
            mean_radius / KILOMETRE
        )));
    }
    let refused = |error: Error| section.fault(format!("[star] is not a uniform oblate spheroid: {error}"));
    let shape = SpheroidShape::from_oblateness(oblateness).map_err(refused)?;
    let body = UniformSpheroid::from_mass(mass * SOLAR_MASS, mean_radius, shape).map_err(refused)?;
    let time = body.time_unit().map_err(refused)?;
    let inertia = body.moment_of_inertia();
    let break_up = break_up_frequency(&body);
    let caution = (frequency.abs() > break_up).then(|| {
        let why = format!(
            "above {} Hz (break-up) gravity does not hold the matter at the equator of this star; the model is a rigid body and \
             accepts any spin",
            significant(break_up, 5)
        );
        spin_entry.refuse_because(&why).message
    });
    let spheroid = rigid_spheroid(oblateness);
    let star = Star {
        spheroid,
        spin: TAU * frequency * time,
        bulge: section.optional("bulge").map_or(Ok(0.0), |entry| bulge(&entry))? / spheroid.inertia_xx,
        units: Units {
            time,
            momentum: inertia.xx / (GRAM * CENTIMETRE * CENTIMETRE) / time / spheroid.inertia_xx,
            energy: body.c() / ERG / spheroid.constant_c,
            time_name: "s",
            momentum_name: "g cm^2/s",
            energy_name: "erg",
        },
    };
    Ok((star, caution))
}

/// The spheroid of an oblateness, with `C = I^xx`, so that the unit of time is `t_c`.
///
/// `1 + epsilon` is rounded by up to 1.1e-16, which is 1e-8 of an oblateness of 1e-8, and as much of a precession period. So `I^zz - I^xx` is a whole
/// number of roundings, `k 2^-52`, and `I^xx = k 2^-52 / epsilon` is as near above one as such a number allows: both moments of inertia are doubles
/// (below 2, where these are multiples of `2^-52`), and `(I^zz - I^xx) / I^xx` is `epsilon` to two roundings of itself.
fn rigid_spheroid(oblateness: f64) -> RigidSpheroid<f64> {
    let difference = (oblateness / f64::EPSILON).ceil() * f64::EPSILON;
    let inertia_xx = difference / oblateness;
    RigidSpheroid { inertia_xx, inertia_zz: inertia_xx + difference, constant_c: inertia_xx }
}

/// The coefficient `b` of the bulge in units of one over `I^xx`. For a fluid it is `1 / (4 I^xx)`: `C_f` is half of the rotational energy.
fn bulge(entry: &Entry<'_>) -> Result<f64, Fault> {
    let allowed = "\"fluid\", or the size of the bulge relative to that of a fluid, from 0 to 10";
    let size = match entry.string() {
        Ok("fluid") => 1.0,
        Ok(_) => return Err(entry.refuse(allowed)),
        Err(_) => entry.number_in(allowed, 0.0..=10.0)?,
    };
    Ok(0.25 * size)
}

/// Rotation frequency (Hz) at which the centrifugal acceleration at the equator of a uniform spheroid, `Omega^2 a1`, equals
/// that of gravity, `2 pi rho A_1 a1` by Eq. (73): `Omega^2 = 2 pi rho A_1`, for a sphere `M / R^3`. Newtonian.
fn break_up_frequency(body: &UniformSpheroid<f64>) -> f64 {
    (TAU * body.density * potential_coefficients(&body.shape).a1).sqrt() / TAU
}

/// `s^IJ` in the inertial frame of the file, and its principal frame.
pub(super) struct Violation {
    pub(super) tensor: Matrix3<f64>,
    pub(super) coefficients: PrincipalCoefficients<f64>,
    /// Rows: principal axes X, Y, Z in the frame of the file.
    pub(super) principal_from_given: Matrix3<f64>,
}

const COEFFICIENT: &str = "a number from -1 to 1; the violation must be small";

pub(super) fn read_violation(section: &Section<'_>) -> Result<Violation, Fault> {
    section.only("eigenvalues tensor alpha_2 w")?;
    section.not_both(&[
        ("eigenvalues", "tensor"),
        ("eigenvalues", "alpha_2"),
        ("eigenvalues", "w"),
        ("tensor", "alpha_2"),
        ("tensor", "w"),
    ])?;
    if let Some(entry) = section.optional("eigenvalues") {
        eigenvalues(&entry)
    } else if let Some(entry) = section.optional("tensor") {
        tensor(&entry)
    } else if section.has("alpha_2") || section.has("w") {
        preferred_frame(section)
    } else {
        Err(section.missing(
            "`lorentz_violation.eigenvalues`, `lorentz_violation.tensor`, or `lorentz_violation.alpha_2` with \
             `lorentz_violation.w`",
        ))
    }
}

fn eigenvalues(entry: &Entry<'_>) -> Result<Violation, Fault> {
    let values = coefficients(entry, "a list of three numbers, [s^XX, s^YY, s^ZZ]")?;
    let coefficients = PrincipalCoefficients::new(values);
    Ok(Violation { tensor: coefficients.tensor(), coefficients, principal_from_given: Matrix3::identity() })
}

fn tensor(entry: &Entry<'_>) -> Result<Violation, Fault> {
    let allowed = "a symmetric matrix, three rows of three numbers";
    let rows = entry.list(allowed)?;
    if rows.len() != 3 {
        return Err(entry.refuse(allowed));
    }
    let mut tensor = Matrix3::zeros();
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in coefficients(row, "a row of three numbers")?.into_iter().enumerate() {
            tensor[(i, j)] = value;
        }
    }
    let frame = principal_frame(&tensor).map_err(|error| entry.refuse(&format!("{allowed} ({error})")))?;
    Ok(Violation { tensor, coefficients: frame.coefficients, principal_from_given: frame.principal_from_given })
}

/// The tensor of a preferred frame, Eq. (5) `[replace]`. The principal axis Z is along `w`; X and Y are arbitrary normals to it.
fn preferred_frame(section: &Section<'_>) -> Result<Violation, Fault> {
    let alpha_2_entry = section.required("alpha_2", "the PPN parameter")?;
    let alpha_2 = alpha_2_entry.number()?;
    let w_entry = section.required("w", "velocity relative to the preferred frame, three numbers in units of c")?;
    let allowed = "three numbers, in units of c, with 0 < |w| < 1";
    let w = w_entry.vector(allowed)?;
    let speed = w.norm();
    if !(speed > 0.0 && speed < 1.0) {
        return Err(w_entry.refuse(allowed));
    }
    let largest = alpha_2 * speed * speed;
    if largest.is_nan() || largest.abs() > 1.0 {
        return Err(alpha_2_entry.refuse("a number with |alpha_2| |w|^2 <= 1; the violation must be small"));
    }
    let z = w / speed;
    let x = z.cross(&Matrix3::identity().column(z.iamin())).normalize();
    let y = z.cross(&x);
    Ok(Violation {
        tensor: coefficients_from_preferred_frame(alpha_2, &w),
        coefficients: PrincipalCoefficients::new([0.0, 0.0, -largest]),
        principal_from_given: Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]),
    })
}

fn coefficients(entry: &Entry<'_>, allowed: &str) -> Result<[f64; 3], Fault> {
    let entries = entry.list(allowed)?;
    let [x, y, z] = entries.as_slice() else { return Err(entry.refuse(allowed)) };
    let read = |entry: &Entry<'_>| entry.number_in(COEFFICIENT, -1.0..=1.0);
    Ok([read(x)?, read(y)?, read(z)?])
}

const ANGLES: [&str; 4] = ["alpha", "beta", "alpha_rate", "beta_rate"];
const CONSTANTS: [&str; 5] = ["kind", "alpha_0", "beta_0", "amplitude", "phase"];

/// The initial conditions of a motion in the paper's units.
pub(super) struct Initial {
    /// State in the frame of the file.
    pub(super) state: BodyState<f64>,
    pub(super) angles: EulerAngles<f64>,
    /// The printed perturbation solution in the same frame, with time from the start, or the reason why there is none.
    pub(super) perturbation: Result<Perturbation<f64>, &'static str>,
}

pub(super) fn read_initial(
    section: &Section<'_>,
    star: &Star,
    violation: &Violation,
    beam: Option<&Pulsar>,
) -> Result<Initial, Fault> {
    section.only(
        "alpha beta gamma alpha_rate beta_rate kind alpha_0 beta_0 amplitude phase wobble momentum azimuth precession_phase",
    )?;
    if section.has("wobble") {
        let others = ANGLES.iter().chain(&CONSTANTS).chain(&["gamma"]);
        section.not_both(&others.map(|key| ("wobble", *key)).collect::<Vec<_>>())?;
        return from_wobble(section, star, beam);
    }
    for key in ["momentum", "azimuth", "precession_phase"] {
        if let Some(entry) = section.optional(key) {
            return Err(entry.refuse_because("can only be used with `initial.wobble`"));
        }
    }
    let Some(constant) = CONSTANTS.iter().find(|key| section.has(key)) else { return from_angles(section, star) };
    section.not_both(&ANGLES.map(|angle| (*constant, angle)))?;
    from_constants(section, star, violation)
}

fn from_angles(section: &Section<'_>, star: &Star) -> Result<Initial, Fault> {
    let angles = EulerAngles {
        alpha: section
            .required(
                "alpha",
                "precession angle [rad], or `initial.kind` for the paper's constants, or `initial.wobble`",
            )?
            .angle()?,
        beta: section
            .required("beta", "inclination of the symmetry axis to Z [rad]")?
            .angle_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?,
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

/// The direction perpendicular to a unit vector `l` at an azimuth about it, counted from the direction nearest to X (to Y if `l`
/// is within 0.14 rad of X).
pub(super) fn outwards(l: &Vector3<f64>, azimuth: f64) -> Vector3<f64> {
    let nearest = if l.x.abs() > 0.99 { Vector3::y() } else { Vector3::x() };
    let x = (nearest - l * l.dot(&nearest)).normalize();
    x * azimuth.cos() + l.cross(&x) * azimuth.sin()
}

/// The state from the wobble angle. With `l` along `L` (along `-L` for a negative spin), `x` the direction perpendicular to it nearest to X (to Y if
/// `l` is within 0.14 rad of X) and `phi` the azimuth, `n = l cos theta + (x cos phi + l x x sin phi) sin theta`. The projection of the magnetic axis (of `e_x`
/// without a pulsar) onto the plane normal to `n` is rotated backwards about `n` by the phase, starting from the projection of `l`.
fn from_wobble(section: &Section<'_>, star: &Star, beam: Option<&Pulsar>) -> Result<Initial, Fault> {
    let wobble = section.required("wobble", "angle of the symmetry axis to L [rad]")?;
    let theta = wobble.angle_where("an angle from 0 to below pi/2 [rad]", |x| (0.0..FRAC_PI_2).contains(&x))?;
    let allowed = "a direction, three numbers that are not all zero";
    let l = match section.optional("momentum") {
        None => Vector3::z(),
        Some(entry) => {
            let given = entry.vector(allowed)?;
            let largest = given.amax();
            if largest == 0.0 {
                return Err(entry.refuse(allowed));
            }
            (given / largest).normalize()
        }
    };
    // A star of negative spin rotates about -L.
    let l = if star.spin < 0.0 { -l } else { l };
    let angle = |key: &str| section.optional(key).map_or(Ok(0.0), |entry| entry.angle());
    let (azimuth, phase) = (angle("azimuth")?, angle("precession_phase")?);
    let outwards = outwards(&l, azimuth);
    let axis = l * theta.cos() + outwards * theta.sin();
    // The projection of l onto the plane normal to n, as a direction that also exists without a wobble.
    let of_momentum = l * theta.sin() - outwards * theta.cos();
    let delta = beam.map_or(0.0, |beam| beam.delta);
    let (sin, cos) = (phase + delta).sin_cos();
    let equatorial_axis = of_momentum * cos - axis.cross(&of_momentum) * sin;
    let momentum = l * (star.spheroid.inertia_zz * star.spin / theta.cos());
    let state = BodyState { axis, momentum, equatorial_axis };
    refuse_overflow(section, &state)?;
    let angles = angles_of(&state);
    Ok(Initial { state, angles, perturbation: Err("[initial] gives a wobble and no constants (`initial.kind`)") })
}

fn from_constants(section: &Section<'_>, star: &Star, violation: &Violation) -> Result<Initial, Fault> {
    let kind_entry = section.required("kind", "\"twofold\" or \"single\"")?;
    let kind = match kind_entry.word(&["twofold", "single"])? {
        "twofold" => Precession::Twofold,
        _ => Precession::Single,
    };
    if star.spin == 0.0 {
        return Err(
            kind_entry.refuse_because("the paper's constants need a spin that is not zero; Eq. (34) divides by it")
        );
    }
    let beta_entry = section.required("beta_0", "mean inclination [rad]")?;
    let beta_0 = beta_entry
        .angle_where("an angle above 0 and below pi [rad]; Eq. (34) divides by sin(beta_0)", |x| {
            x > 0.0 && x < PI && x.sin() > f64::EPSILON
        })?;
    if kind == Precession::Twofold && beta_0.cos().abs() < 1e-12 {
        return Err(beta_entry.refuse("other than pi/2 for kind \"twofold\"; its rate is omega / cos(beta_0)"));
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
            "[initial] gives an inclination beta = {} rad by Eq. (34): must be from 0 to pi; the perturbation solution \
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
    let angles = angles_of(&state);
    let perturbation = Err("its angles are those of the principal frame, which is not the frame of this file");
    Ok(Initial { state, angles, perturbation })
}

/// Euler angles of a state. At a pole only `alpha + gamma` or its difference is defined; both angles are set to zero.
fn angles_of(state: &BodyState<f64>) -> EulerAngles<f64> {
    state.angles().unwrap_or(EulerAngles { alpha: 0.0, beta: state.axis.z.acos(), gamma: 0.0 })
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
    Err(section.fault("[initial] gives an angular momentum beyond the range of doubles; use smaller rates"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_are_counted_from_the_direction_nearest_to_x_or_to_y() {
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
        for (l, first) in [(x, y), (-x, y), (y, x), (-y, x), (z, x)] {
            assert_eq!(outwards(&l, 0.0), first, "{l}");
            assert!((outwards(&l, FRAC_PI_2) - l.cross(&first)).norm() < 1e-15, "{l}");
        }
        // Some 6 degrees from X.
        let tilted = Vector3::new(0.995, 0.0, (1.0_f64 - 0.995 * 0.995).sqrt());
        assert_eq!(outwards(&tilted, 0.0), y);
    }

    /// For a sphere of 1.4 solar masses and 12 km, sqrt(G M / R^3) / (2 pi) with SI values. A flatter star of the same mean radius has
    /// its equator farther out, where gravity holds it less.
    #[test]
    fn the_break_up_frequency_is_that_of_an_orbit_at_the_equator() {
        let of = |oblateness: f64| {
            let shape = SpheroidShape::from_oblateness(oblateness).expect("a shape");
            break_up_frequency(&UniformSpheroid::from_mass(1.4 * SOLAR_MASS, 12.0 * KILOMETRE, shape).expect("a star"))
        };
        let expected = (6.674_3e-11 * 1.4 * 1.988_41e30 / 1.2e4_f64.powi(3)).sqrt() / TAU;
        assert!((of(1e-12) / expected - 1.0).abs() < 1e-4, "{} {expected}", of(1e-12));
        // To first order A_1 = 2/3 - 2 e^2 / 15 and e^2 = 2 eps: f = f_0 (1 - eps / 5), at fixed mass and mean radius.
        assert!(((1.0 - of(1e-4) / of(1e-12)) / 1e-4 - 0.2).abs() < 1e-3, "{}", (1.0 - of(1e-4) / of(1e-12)) / 1e-4);
    }
}
