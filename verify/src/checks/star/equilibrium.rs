//! Maclaurin spheroids: rotation rate, T_rot = 2 C and the tensor virial relation from independent parts.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use super::{coefficients_by_ellip, relative, unit_spheroid};
use crate::prelude::*;

checks! {
    /// the rate at which the surface of a spheroid is an equipotential, by elliptic integrals, is that of Eq. (77), and with it T_rot = 2 C
    Oracle "star-maclaurin-energy" [76, 77, 78]: energy;
    AtMost(32.0) "largest relative error x e^2 / 2.2e-16";
    because "the reference subtracts two coefficients of order one, good to a few ulp, whose difference is 4 e^2 / 15";
    /// K^ij + delta^ij P - U^ij = 0 with K^ij and P integrated over a fluid whose pressure comes from Eq. (76) with the potential by elliptic
    /// integrals, vanishing on the surface
    Oracle "star-tensor-virial" [14, 15, 16, 17, 18, 76]: tensor_virial;
    AtMost(128.0) "largest residual or surface pressure, relative to U^zz and to the central pressure / 2.2e-16";
    because "the pressure is a difference of potentials that is q^2 of them, so 1 / q^2 <= 16 of their few ulp are lost";
    /// the closed forms satisfy K^ij + delta^ij P - U^ij = 0 and T_rot = (K^xx + K^yy) / 2 = 2 C
    Property "star-virial-closed-forms" [14, 18, 78]: closed_forms;
    AtMost(32.0) "largest residual relative to U^xx, or relative error of T_rot, / 2.2e-16";
    because "products of about ten factors on either side";
}

fn maclaurin(q: f64) -> Result<MaclaurinSpheroid<f64>, String> {
    MaclaurinSpheroid::new(unit_spheroid(q)?).map_err(String::from)
}

/// `|Omega|^2` from equal `-Phi + |Omega|^2 varpi^2 / 2` at equator and pole, for `a1 = rho = 1`.
fn rate_squared_by_ellip(q: f64) -> Result<f64, String> {
    let [a1, _, a3] = coefficients_by_ellip([1.0, 1.0, q])?;
    Ok(2.0 * PI * (a1 - q * q * a3))
}

fn energy() -> Result<Measured, String> {
    worst_over(51, 400, &(0.05..0.999f64), |&q| {
        let star = maclaurin(q)?;
        let rate = rate_squared_by_ellip(q)?;
        let energy = 0.5 * (8.0 * PI / 15.0 * q) * rate;
        let errors = [relative(star.rotation_rate_squared, rate), relative(2.0 * star.spheroid.c(), energy)];
        Ok(largest(errors) * (1.0 - q * q) / f64::EPSILON)
    })
}

fn tensor_virial() -> Result<Measured, String> {
    let rule = GaussLegendre::new(NonZeroUsize::new(6).ok_or("no nodes")?);
    worst_over(52, 100, &(0.25..0.99f64), |&q| {
        let u = unit_spheroid(q)?.potential_energy_tensor();
        let [a1, _, a3] = coefficients_by_ellip([1.0, 1.0, q])?;
        let rate = rate_squared_by_ellip(q)?;
        // Eq. (76) for rho = 1, the constant such that p = 0 at the pole.
        let effective = |varpi: f64, z: f64| -PI * (a1 * varpi * varpi + a3 * z * z) + 0.5 * rate * varpi * varpi;
        let pressure = |varpi: f64, z: f64| effective(varpi, z) - effective(0.0, q);
        // Coordinates t (homothetic) and mu fill the spheroid; the volume element is 2 pi q t^2 dt dmu.
        let integral = |f: &dyn Fn(f64, f64) -> f64| {
            rule.integrate(0.0, 1.0, |t| {
                rule.integrate(-1.0, 1.0, |mu| 2.0 * PI * q * t * t * f(t * (1.0 - mu * mu).sqrt(), q * t * mu))
            })
        };
        let p = integral(&pressure);
        let kxx = integral(&|varpi, _| rate * varpi * varpi / 2.0);
        let surface = largest(
            (0..=20)
                .map(|i| f64::from(i) / 20.0)
                .map(|mu| pressure((1.0 - mu * mu).sqrt(), q * mu).abs() / pressure(0.0, 0.0)),
        );
        let residuals = [(kxx + p - u.xx) / u.zz, (p - u.zz) / u.zz, surface];
        Ok(largest(residuals.map(f64::abs)) / f64::EPSILON)
    })
}

fn closed_forms() -> Result<Measured, String> {
    worst_over(53, 400, &(0.05..1.0f64), |&q| {
        let star = maclaurin(q)?;
        let (k, p, u) = (star.kinetic_tensor, star.pressure_integral, star.spheroid.potential_energy_tensor());
        let energy = star.rotational_energy;
        let errors = [
            (k.xx + p - u.xx) / u.xx,
            (k.zz + p - u.zz) / u.zz,
            relative(energy, star.kinetic_tensor.xx),
            relative(energy, 2.0 * star.spheroid.c()),
            star.pressure(1.0, 0.0) / star.central_pressure,
            relative(star.pressure(0.0, 0.0), star.central_pressure),
        ];
        Ok(largest(errors.map(f64::abs)) / f64::EPSILON)
    })
}
