//! The star: potential coefficients, the constant C, equilibrium, estimates.

use crate::prelude::*;

pub(super) mod energy;
pub(super) mod equilibrium;
pub(super) mod estimates;
pub(super) mod multiprecision_table;
pub(super) mod potential_coefficients;
pub(super) mod shape;

/// Spheroid with `a1 = rho = 1`.
fn unit_spheroid(axis_ratio: f64) -> Result<UniformSpheroid<f64>, String> {
    let shape = SpheroidShape::from_axis_ratio(axis_ratio)?;
    UniformSpheroid::new(1.0, 1.0, shape).map_err(String::from)
}

/// `A_1`, `A_2`, `A_3` of Eq. (73) by the Carlson integrals of the crate `ellip`.
fn coefficients_by_ellip([a1, a2, a3]: [f64; 3]) -> Result<[f64; 3], String> {
    let (x, y, z) = (a1 * a1, a2 * a2, a3 * a3);
    let factor = 2.0 / 3.0 * a1 * a2 * a3;
    let rd = |x, y, z| ellip::elliprd(x, y, z).map(|r| factor * r).map_err(|e| format!("{e:?}"));
    Ok([rd(y, z, x)?, rd(z, x, y)?, rd(x, y, z)?])
}

fn relative(value: f64, reference: f64) -> f64 {
    ((value - reference) / reference).abs()
}
