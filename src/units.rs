//! Physical constants, and the geometrised units of the paper (G = c = 1) with the second as base.
//!
//! A unit is a constant: `x * unit` converts `x` from that unit to the base, `x / unit` converts back.
//!
//! ```
//! use twofold::units::geometrised::{GRAM_PER_CUBIC_CENTIMETRE, KILOMETRE, SOLAR_MASS};
//!
//! let density = 1e15 * GRAM_PER_CUBIC_CENTIMETRE; // 1/s^2
//! assert!((density / 6.6743e7 - 1.0).abs() < 1e-12);
//! let compactness = (1.4 * SOLAR_MASS) / (10.0 * KILOMETRE); // dimensionless
//! assert!((compactness - 0.2067).abs() < 1e-4);
//! assert_eq!(twofold::units::time_unit(4.0)?, 2.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::error::Error;
use crate::numerics::scalar::Real;

/// Degree in rad.
pub const DEGREE: f64 = core::f64::consts::PI / 180.0;

/// Day in s.
pub const DAY: f64 = 86_400.0;

/// Julian year in s: 365.25 days (IAU).
pub const JULIAN_YEAR: f64 = 365.25 * DAY;

/// SI: metre, kilogram, second.
pub mod si {
    /// Newtonian constant of gravitation G [m^3 kg^-1 s^-2], CODATA 2018 and 2022; relative uncertainty 2.2e-5.
    pub const GRAVITATIONAL_CONSTANT: f64 = 6.674_30e-11;
    /// Speed of light c [m/s], exact.
    pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;
    /// Nominal solar mass parameter G M_sun [m^3 s^-2], IAU 2015 Resolution B3, exact by convention.
    pub const SOLAR_MASS_PARAMETER: f64 = 1.327_124_4e20;
    /// Solar mass in kg, `G M_sun / G`: its uncertainty is that of G.
    pub const SOLAR_MASS: f64 = SOLAR_MASS_PARAMETER / GRAVITATIONAL_CONSTANT;
    /// Astronomical unit in m, IAU 2012 Resolution B2, exact.
    pub const ASTRONOMICAL_UNIT: f64 = 149_597_870_700.0;
    /// Parsec in m, `648000 / pi` astronomical units, IAU 2015 Resolution B2, exact.
    pub const PARSEC: f64 = 648_000.0 / core::f64::consts::PI * ASTRONOMICAL_UNIT;
    /// Kiloparsec in m.
    pub const KILOPARSEC: f64 = 1e3 * PARSEC;
    /// Moment of inertia of one gram square centimetre [kg m^2].
    pub const GRAM_SQUARE_CENTIMETRE: f64 = 1e-7;
    /// Density of one gram per cubic centimetre [kg m^-3].
    pub const GRAM_PER_CUBIC_CENTIMETRE: f64 = 1e3;
}

/// CGS: centimetre, gram, second.
pub mod cgs {
    /// Newtonian constant of gravitation G [cm^3 g^-1 s^-2].
    pub const GRAVITATIONAL_CONSTANT: f64 = super::si::GRAVITATIONAL_CONSTANT * 1e3;
    /// Speed of light c [cm/s].
    pub const SPEED_OF_LIGHT: f64 = super::si::SPEED_OF_LIGHT * 1e2;
    /// Solar mass in g.
    pub const SOLAR_MASS: f64 = super::si::SOLAR_MASS * 1e3;
}

/// Units of mass, length, time, frequency and density as powers of the second, with G = c = 1.
pub mod geometrised {
    use super::si::{GRAVITATIONAL_CONSTANT as G, SOLAR_MASS_PARAMETER, SPEED_OF_LIGHT as C};

    /// Second: the base.
    pub const SECOND: f64 = 1.0;
    /// Metre in s, `1 m / c`.
    pub const METRE: f64 = 1.0 / C;
    /// Kilometre in s.
    pub const KILOMETRE: f64 = 1e3 / C;
    /// Centimetre in s.
    pub const CENTIMETRE: f64 = 1e-2 / C;
    /// Kilogram in s, `G (1 kg) / c^3`.
    pub const KILOGRAM: f64 = G / (C * C * C);
    /// Gram in s.
    pub const GRAM: f64 = 1e-3 * KILOGRAM;
    /// Solar mass in s, `G M_sun / c^3`: 4.9255 microseconds.
    pub const SOLAR_MASS: f64 = SOLAR_MASS_PARAMETER / (C * C * C);
    /// Gram per cubic centimetre [s^-2], `G (1 g cm^-3)`.
    pub const GRAM_PER_CUBIC_CENTIMETRE: f64 = G * 1e3;
    /// Joule in s, `G (1 J) / c^5`.
    pub const JOULE: f64 = KILOGRAM / (C * C);
    /// Erg in s.
    pub const ERG: f64 = 1e-7 * JOULE;
    /// One cycle per second as an angular frequency [rad/s].
    pub const HERTZ: f64 = 2.0 * core::f64::consts::PI;
}

/// The unit of time `t_c = sqrt(I^xx / C)` of the paper's solutions, Eq. (35) `[unitt]`, from `I^xx / C` (a time squared).
///
/// In it `C = I^xx = 1`: angular frequencies are in `1 / t_c`, energies in `C`, angular momenta in `I^xx / t_c`.
///
/// # Errors
/// [`Error::Domain`] unless `I^xx / C` is positive and finite: a sphere (`C = 0`) has no such unit, a prolate star
/// (`C < 0`) would need the opposite sign in Eq. (35).
pub fn time_unit<S: Real>(inertia_over_c: S) -> Result<S, Error> {
    let value = inertia_over_c.re();
    Error::ensure(value > 0.0 && value.is_finite(), "I^xx / C", value, "positive and finite, as for an oblate star")?;
    Ok(inertia_over_c.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `I^xx / C` = 9 s^2 gives 3 s. A sphere, for which C is zero, a prolate star, and a value that is infinite or not a number have no unit.
    #[test]
    fn only_an_oblate_star_has_a_unit_of_time() {
        assert_eq!(time_unit(9.0), Ok(3.0));
        for without in [f64::INFINITY, 0.0, -1.0, f64::NAN] {
            assert!(time_unit(without).is_err(), "{without}");
        }
    }

    /// SI 2019; IAU 2012 B2, 2015 B2 and B3; CODATA 2018 and 2022, which have the same value of G.
    #[test]
    fn constants_are_those_of_their_definitions() {
        assert_eq!(si::SPEED_OF_LIGHT, 299_792_458.0);
        assert_eq!(si::GRAVITATIONAL_CONSTANT, 6.674_30e-11);
        assert_eq!(si::SOLAR_MASS_PARAMETER, 1.327_124_4e20);
        assert_eq!(si::ASTRONOMICAL_UNIT, 149_597_870_700.0);
        assert_eq!((DAY, JULIAN_YEAR), (24.0 * 60.0 * 60.0, 31_557_600.0));
        assert_eq!((360.0 * DEGREE, geometrised::HERTZ), (core::f64::consts::TAU, core::f64::consts::TAU));
        assert_eq!(
            (geometrised::SECOND, si::GRAM_PER_CUBIC_CENTIMETRE, si::GRAM_SQUARE_CENTIMETRE),
            (1.0, 1000.0, 1e-7)
        );
    }

    /// The numbers are the doubles nearest to the definitions in decimal arithmetic of 50 digits. The error of a product of two or three roundings
    /// is at most two units in the last place.
    #[test]
    fn units_that_follow_are_right_to_the_last_place() {
        for (unit, digits) in [
            (DEGREE, 1.745_329_251_994_329_5e-2),
            (si::PARSEC, 3.085_677_581_491_367e16),
            (si::KILOPARSEC, 3.085_677_581_491_367e19),
            (si::SOLAR_MASS, 1.988_409_870_698_050_7e30),
            (cgs::GRAVITATIONAL_CONSTANT, 6.674_3e-8),
            (cgs::SPEED_OF_LIGHT, 2.997_924_58e10),
            (cgs::SOLAR_MASS, 1.988_409_870_698_050_7e33),
            (geometrised::METRE, 3.335_640_951_981_520_4e-9),
            (geometrised::KILOMETRE, 3.335_640_951_981_520_5e-6),
            (geometrised::CENTIMETRE, 3.335_640_951_981_52e-11),
            (geometrised::KILOGRAM, 2.477_100_430_965_033e-36),
            (geometrised::GRAM, 2.477_100_430_965_033e-39),
            (geometrised::SOLAR_MASS, 4.925_490_947_641_267e-6),
            (geometrised::GRAM_PER_CUBIC_CENTIMETRE, 6.674_3e-8),
            (geometrised::JOULE, 2.756_145_933_363_686e-53),
            (geometrised::ERG, 2.756_145_933_363_686_4e-60),
        ] {
            assert!((unit - digits).abs() <= f64::EPSILON * digits, "{unit:e}, by definition {digits:e}");
        }
    }
}
