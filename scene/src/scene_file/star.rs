//! The section `[star]`, and the units that it sets for the whole file.

use std::f64::consts::{PI, TAU};

use twofold::Error;
use twofold::dynamics::RigidSpheroid;
use twofold::star::potential_coefficients::potential_coefficients;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;
use twofold::units::geometrised::{CENTIMETRE, ERG, GRAM, GRAM_PER_CUBIC_CENTIMETRE, KILOMETRE, SOLAR_MASS};
use twofold::units::si::GRAM_SQUARE_CENTIMETRE;

use super::error::Fault;
use super::section::Section;

/// Units of a scene file and of its output: those of the paper, or seconds and cgs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// `t_c` in the unit of time.
    pub time: f64,
    /// `I^xx / t_c` in the unit of angular momentum.
    pub momentum: f64,
    /// `C` in the unit of energy.
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

    /// `I^xx` of a physical star in kg m^2.
    pub fn inertia_in_si(&self) -> f64 {
        self.momentum * self.time * GRAM_SQUARE_CENTIMETRE
    }

    /// Whether these are seconds and cgs.
    pub fn are_physical(&self) -> bool {
        self.time_name == "s"
    }
}

pub(super) struct Star {
    /// In units of `I^xx` and `C`.
    pub(super) spheroid: RigidSpheroid<f64>,
    /// `Omega^z` in 1/t_c.
    pub(super) spin: f64,
    pub(super) units: Units,
}

/// The star, and a sentence if it spins faster than gravity can hold it.
pub(super) fn read(section: &Section<'_>) -> Result<(Star, Option<String>), Fault> {
    section.only(&["inertia_ratio", "spin", "mass", "radius", "density", "oblateness", "spin_frequency"])?;
    for physical in ["mass", "radius", "density", "oblateness", "spin_frequency"] {
        section.not_both("inertia_ratio", physical)?;
        section.not_both("spin", physical)?;
    }
    section.not_both("radius", "density")?;
    if section.has("inertia_ratio") || section.has("spin") {
        Ok((in_units_of_tc(section)?, None))
    } else {
        physical(section)
    }
}

fn in_units_of_tc(section: &Section<'_>) -> Result<Star, Fault> {
    let ratio = section
        .required("inertia_ratio", "I^zz / I^xx")?
        .number_where("from 1e-3 to 2: I^zz <= I^xx + I^yy for any distribution of mass", |x| {
            (1e-3..=2.0).contains(&x)
        })?;
    let spin = section.required("spin", "Omega^z in 1/t_c")?.number()?;
    Ok(Star { spheroid: RigidSpheroid::in_units_of_tc(ratio), spin, units: Units::PAPER })
}

fn physical(section: &Section<'_>) -> Result<(Star, Option<String>), Fault> {
    let mass = section
        .required("mass", "in solar masses; or `star.inertia_ratio` and `star.spin` for the paper's units")?
        .number_where("a mass from 1e-3 to 1e3 [solar masses]", |x| (1e-3..=1e3).contains(&x))?;
    let oblateness = section
        .required("oblateness", "(I^zz - I^xx) / I^xx")?
        .number_where("from 1e-15 to 0.99: an oblate star, for which C is above zero", |x| {
            (1e-15..=0.99).contains(&x)
        })?;
    let spin_entry = section.required("spin_frequency", "Omega^z / (2 pi) [Hz]")?;
    let frequency = spin_entry.number_where("from -1e5 to 1e5 [Hz]", |x| x.abs() <= 1e5)?;
    // Geometrised units (G = c = 1, base second) inside, cgs outside.
    let mean_radius = match (section.optional("radius"), section.optional("density")) {
        (Some(radius), _) => {
            radius.number_where("a radius from 1 to 1e7 [km]", |x| (1.0..=1e7).contains(&x))? * KILOMETRE
        }
        (None, Some(density)) => {
            let density =
                density.number_where("a density from 1e-6 to 1e17 [g/cm^3]", |x| (1e-6..=1e17).contains(&x))?;
            (mass * SOLAR_MASS * 0.75 / (PI * density * GRAM_PER_CUBIC_CENTIMETRE)).cbrt()
        }
        (None, None) => return Err(section.missing("`star.radius` [km] or `star.density` [g/cm^3]")),
    };
    if mean_radius <= 2.0 * mass * SOLAR_MASS {
        let horizon = 2.0 * mass * SOLAR_MASS / KILOMETRE;
        return Err(section.fault(format!(
            "[star] has a mean radius of {:.3} km: allowed is above 2 G M / c^2 = {horizon:.3} km",
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
            "above {break_up:.4} Hz gravity does not hold the matter at the equator of this star (break-up); the model, a rigid body, \
             takes any spin"
        );
        spin_entry.refuse_because(&why).message
    });
    let star = Star {
        spheroid: RigidSpheroid::in_units_of_tc(1.0 + oblateness),
        spin: TAU * frequency * time,
        units: Units {
            time,
            momentum: inertia.xx / (GRAM * CENTIMETRE * CENTIMETRE) / time,
            energy: body.c() / ERG,
            time_name: "s",
            momentum_name: "g cm^2/s",
            energy_name: "erg",
        },
    };
    Ok((star, caution))
}

/// Rotation frequency (Hz) at which the centrifugal acceleration at the equator of a uniform spheroid, `Omega^2 a1`, is that of
/// gravity, by Eq. (73) `2 pi rho A_1 a1`: `Omega^2 = 2 pi rho A_1`, for a sphere `M / R^3`. Newtonian.
fn break_up_frequency(body: &UniformSpheroid<f64>) -> f64 {
    (TAU * body.density * potential_coefficients(&body.shape).a1).sqrt() / TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For a sphere of 1.4 solar masses and 12 km, sqrt(G M / R^3) / (2 pi) with SI values; a flatter star of the same mean radius has
    /// its equator farther out, and is held less.
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
