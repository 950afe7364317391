//! Numbers for neutron stars: centrifugal oblateness, I^zz / C, the unit of time, and the range of validity of the
//! estimates.

use twofold::star::deformation::{CENTRIFUGAL_COEFFICIENT, PRINTED_CENTRIFUGAL_COEFFICIENT};
use twofold::units::geometrised::{GRAM_PER_CUBIC_CENTIMETRE, HERTZ, KILOMETRE, SOLAR_MASS};
use twofold::units::{cgs, geometrised, time_unit};

use super::relative;
use crate::prelude::*;

checks! {
    /// the centrifugal oblateness is 2.1e-3 at 100 Hz, 10 km, 1.4 solar masses, as printed, and 0.08 at 1.6 ms
    Oracle "star-centrifugal-numbers" [20]: centrifugal_numbers;
    AtMost(1.0) "largest deviation / half a unit of the printed last digit";
    because "rounding to the printed digits";
    /// both forms of Eq. (20) agree, through geometrised units
    Property "star-centrifugal-forms" [20]: centrifugal_forms;
    AtMost(16.0) "largest relative error / 2.2e-16";
    because "about a dozen products on either side";
    /// at 1e15 g/cm^3, I^zz / C is 1.79e-5 s^2 for oblateness 1e-3, and t_c is 1.34 s for 1e-8 and 0.42 ms for 0.1
    Oracle "star-estimate-numbers" [43, 58]: estimate_numbers;
    AtMost(1.0) "largest deviation / half a unit of the last digit given here";
    because "rounding to these digits";
    /// the printed orders of magnitude, 1e-5 s^2, 1 s and 1e-3 s, are those of the estimates
    Oracle "star-estimate-magnitudes" [43, 58]: estimate_magnitudes;
    AtMost(0.5) "largest |log10(ours / printed)|";
    because "the nearest power of ten";
    /// I^zz / C of the uniform spheroid is its estimate times 1 + (5/7) eps + O(eps^2), and t_c^2 that over 1 + eps
    Regime "star-estimate-regime" [35, 43, 58, 79]: estimate_regime;
    Within(1.95, 2.05) "measured order of the remainder, between eps = 0.02 and 0.01, farthest from 2";
    because "the next term changes the order by about eps";
    /// the oblateness of a Maclaurin spheroid is 5/4 of |Omega|^2 R^3 / M at small rates
    Regime "star-centrifugal-regime" [20, 77, 79]: centrifugal_regime;
    Within(0.95, 1.05) "measured order of the relative deviation between eps = 0.02 and 0.01";
    because "the next term changes the order by about eps";
    /// G M_sun / c^3 is 4.925491 microseconds, G M_sun / c^2 1.476625 km, M_sun 1.98841e33 g, and the units agree with each other
    Oracle "star-units" [35]: units;
    AtMost(1.0) "largest deviation / half a unit of the last digit given here";
    because "published values (IAU 2015 B3 and CODATA 2018), rounded";
}

/// The largest deviation in units of half a last digit: `(value, stated, last digit)`.
fn against_digits(numbers: &[(f64, f64, f64)]) -> Result<Measured, String> {
    worst_of(numbers, |(value, stated, last_digit)| Ok((value - stated).abs() / (0.5 * last_digit)))
}

fn centrifugal_numbers() -> Result<Measured, String> {
    against_digits(&[
        (CENTRIFUGAL_COEFFICIENT, PRINTED_CENTRIFUGAL_COEFFICIENT, 1e-4),
        (centrifugal_oblateness_scaled(100.0, 10.0, 1.4), 2.1e-3, 1e-4),
        (centrifugal_oblateness_scaled(1.0 / 1.6e-3, 10.0, 1.4), 0.08, 0.01),
        (centrifugal_oblateness_scaled(70.0, 10.0, 1.4), 1e-3, 1e-3),
    ])
}

fn centrifugal_forms() -> Result<Measured, String> {
    worst_over(61, 200, &(1.0..1000.0f64, 8.0..15.0f64, 1.0..2.5f64), |&(frequency, radius, mass)| {
        let exact = centrifugal_oblateness(frequency * HERTZ, radius * KILOMETRE, mass * SOLAR_MASS);
        Ok(relative(centrifugal_oblateness_scaled(frequency, radius, mass), exact) / f64::EPSILON)
    })
}

const DENSITY: f64 = 1e15 * GRAM_PER_CUBIC_CENTIMETRE;

fn estimates() -> Result<[f64; 3], String> {
    let seconds = |oblateness| time_unit_estimate(DENSITY, oblateness).map_err(String::from);
    Ok([inertia_over_c_estimate(DENSITY, 1e-3), seconds(1e-8)?, seconds(0.1)?])
}

fn estimate_numbers() -> Result<Measured, String> {
    let [ratio, rigid, example] = estimates()?;
    against_digits(&[(ratio, 1.79e-5, 1e-7), (rigid, 1.34, 0.01), (example, 4.2e-4, 1e-5)])
}

fn estimate_magnitudes() -> Result<Measured, String> {
    let pairs = estimates()?.into_iter().zip([1e-5, 1.0, 1e-3]);
    worst_of(pairs, |(ours, printed)| Ok((ours / printed).log10().abs()))
}

fn spheroid(oblateness: f64) -> Result<UniformSpheroid<f64>, String> {
    let shape = SpheroidShape::from_oblateness(oblateness)?;
    UniformSpheroid::new(1.0, 1.0, shape).map_err(String::from)
}

fn estimate_regime() -> Result<Measured, String> {
    let left = |eps: f64| {
        let star = spheroid(eps)?;
        let estimate = inertia_over_c_estimate(1.0, eps);
        let ratio = star.polar_inertia_over_c()? / estimate;
        let t_c = star.time_unit()?;
        let estimated_t_c = time_unit_estimate(1.0, eps)?;
        let first = 1.0 + 5.0 / 7.0 * eps;
        // The quotient of the two first-order factors differs from 1 + (5/7 - 1) eps only at second order, which is allowed here.
        Ok::<_, String>([ratio - first, (t_c / estimated_t_c).powi(2) - (1.0 - 2.0 / 7.0 * eps)])
    };
    let (coarse, fine) = (left(0.02)?, left(0.01)?);
    let orders = [0, 1].map(|i| (coarse[i] / fine[i]).log2());
    let farthest = if (orders[0] - 2.0).abs() > (orders[1] - 2.0).abs() { orders[0] } else { orders[1] };
    Ok(Measured::new(farthest, format!("orders of I^zz / C and t_c^2: {orders:?}")))
}

fn centrifugal_regime() -> Result<Measured, String> {
    let deviation = |eps: f64| {
        let star = MaclaurinSpheroid::new(spheroid(eps)?)?;
        let (rate, body) = (star.rotation_rate_squared.sqrt(), star.spheroid);
        Ok::<_, String>(eps / (1.25 * centrifugal_oblateness(rate, body.mean_radius(), body.mass())) - 1.0)
    };
    let (coarse, fine) = (deviation(0.02)?, deviation(0.01)?);
    Ok(Measured::new((coarse / fine).log2(), format!("relative deviations {coarse:e}, {fine:e}")))
}

fn units() -> Result<Measured, String> {
    let exact = 1e-15;
    against_digits(&[
        (geometrised::SOLAR_MASS, 4.925_491e-6, 1e-12),
        (geometrised::SOLAR_MASS / geometrised::KILOMETRE, 1.476_625, 1e-6),
        (cgs::SOLAR_MASS, 1.988_41e33, 1e28),
        (geometrised::SOLAR_MASS / (si::SOLAR_MASS * geometrised::KILOGRAM), 1.0, exact),
        (geometrised::KILOMETRE / (1e5 * geometrised::CENTIMETRE), 1.0, exact),
        // A density as mass over volume, in powers of the second.
        (geometrised::GRAM / geometrised::CENTIMETRE.powi(3) / GRAM_PER_CUBIC_CENTIMETRE, 1.0, 4.0 * exact),
        (geometrised::ERG / (geometrised::GRAM * (1.0 / cgs::SPEED_OF_LIGHT).powi(2)), 1.0, 4.0 * exact),
        (time_unit(4.0)?, 2.0, exact),
        (twofold::units::DEGREE * 180.0, PI, exact),
        (twofold::units::JULIAN_YEAR / 86_400.0, 365.25, exact),
    ])
}
