//! Estimates for neutron stars in the text, and the expansions of the appendix.

use twofold::star::deformation::CENTRIFUGAL_COEFFICIENT;
use twofold::units::geometrised::GRAM_PER_CUBIC_CENTIMETRE;

use super::{GoldenLine, GoldenTable, Printed};
use crate::prelude::*;

/// Eqs. (20), (43), (58) for the values given in the paper.
pub(super) fn estimates() -> Result<GoldenTable, Error> {
    let density = 1e15 * GRAM_PER_CUBIC_CENTIMETRE;
    let deformation = |period: f64| centrifugal_oblateness_scaled(1.0 / period, 10.0, 1.4);
    let t_c = |oblateness: f64| time_unit_estimate(density, oblateness);
    Ok(GoldenTable {
        name: "star_estimates",
        title: "Estimates for neutron stars: Eq. (20) at 10 km and 1.4 solar masses, Eqs. (43) and (58) at 1e15 g/cm^3",
        lines: vec![
            GoldenLine::new("eps_f at 100 Hz, Eq. (20)", Printed::Decimal("2.1e-3"), CENTRIFUGAL_COEFFICIENT),
            GoldenLine::new("eps_f at 1.6 ms (PSR B1937+21), Eq. (20)", Printed::Order("1e-3"), deformation(1.6e-3)),
            GoldenLine::new("eps_f at 4.1 ms (PSR J1744-1134), Eq. (20)", Printed::Order("1e-3"), deformation(4.1e-3)),
            GoldenLine::new(
                "I^zz/C at eps_f = 1e-3 (s^2), Eq. (43)",
                Printed::Order("1e-5"),
                inertia_over_c_estimate(density, 1e-3),
            ),
            GoldenLine::new("t_c at eps_r = 1e-8 (s), Eq. (58)", Printed::Order("1"), t_c(1e-8)?),
            GoldenLine::new("t_c at eps_r = 0.1 (s), Eq. (58)", Printed::Order("1e-3"), t_c(0.1)?),
        ],
    })
}

/// Coefficients of `e^2` in Eqs. (74) and (75), by duals at the sphere.
pub(super) fn expansions() -> Result<GoldenTable, Error> {
    let shape = SpheroidShape::from_eccentricity_squared(Dual64::new(0.0, 1.0))?;
    let a = potential_coefficients(&shape);
    let unit = Dual64::from_re(1.0);
    let c = UniformSpheroid::new(unit, unit, shape)?.c();
    let line = |label: &str, printed, ours| GoldenLine::new(label, Printed::Decimal(printed), ours);
    Ok(GoldenTable {
        name: "appendix_expansions",
        title: "Expansions of the appendix in e^2, Eqs. (74), (75); fractions of the paper written as decimals",
        lines: vec![
            line("A_0 / (2 a1^2) at e = 0", "1", a.a0.re / 2.0),
            line("its coefficient of e^2, -1/3", "-0.33333333", a.a0.eps / 2.0),
            line("A_1 / (2/3) at e = 0", "1", a.a1.re * 1.5),
            line("its coefficient of e^2, -1/5", "-0.2", a.a1.eps * 1.5),
            line("A_3 / (2/3) at e = 0", "1", a.a3.re * 1.5),
            line("its coefficient of e^2, 2/5", "0.4", a.a3.eps * 1.5),
            line("C / (16 pi^2 rho^2 a1^4 a3 / 225), coefficient of e^2", "1", c.eps * 225.0 / (16.0 * PI * PI)),
        ],
    })
}
