//! Motion about the middle principal axis, and near the separatrix through it.

use nalgebra::Vector3;

use super::hamiltonian::{AveragingOrder, MeanPotential};
use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;

/// Maximum number of corrections of `G`.
const MOST_CORRECTIONS: usize = 20;

/// Growth rate of the distance of `L` from the middle principal axis, for an energy `E` and a spin `Omega^z`.
///
/// ```text
/// mu = sqrt((k1 - k2)(k2 - k3)),    k = (2 / G) (v_h s + v_m s^2) with the slopes v_h, v_m of the mean potential at h = s2, m = s2^2
/// ```
///
/// for traceless `s1 > s2 > s3`; `G` follows from the mean energy. To first order the rate is
/// `(2 C |P2| / G) sqrt((s1 - s2)(s2 - s3))`.
///
/// # Errors
/// [`Error::Domain`] if the mean energy does not determine `G`, or if `L` does not leave the axis: at and near `P2 = 0`, and for two equal
/// eigenvalues.
pub fn middle_axis_growth(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    energy: f64,
    spin: f64,
    order: AveragingOrder,
) -> Result<f64, Error> {
    let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = *spheroid;
    let values = Vector3::new(s.xx, s.yy, s.zz);
    let mean = values.mean();
    let mut s = values.map(|value| value - mean);
    s.as_mut_slice().sort_by(f64::total_cmp);
    let along = inertia_zz * spin;
    let hamiltonian = energy - constant_c * mean - along * spin / 2.0 + along * along / (2.0 * inertia_xx);
    let potential = MeanPotential { order, constant_c, inertia: inertia_xx, bulge: 0.0, square: s.norm_squared() };
    let (h, m) = (s.y, s.y * s.y);
    let mut size = (2.0 * inertia_xx * (hamiltonian - constant_c * h)).sqrt();
    let mut change = f64::NAN;
    for _ in 0..MOST_CORRECTIONS {
        let c = along / size;
        let slopes = potential.at(size, c, h, m);
        let off = size * size / (2.0 * inertia_xx) + slopes.value - hamiltonian;
        change = off / (size / inertia_xx + slopes.about_momentum(size, c));
        size -= change;
    }
    Error::ensure(
        size > 0.0 && change.abs() <= 1e-12 * size,
        "mean |L| of this energy on the middle axis",
        size,
        "above zero and determined by the mean energy",
    )?;
    let k = potential.at(size, along / size, h, m).tensor(&s, size);
    let square = (k.z - k.y) * (k.y - k.x);
    Error::ensure(square > 0.0, "(k1 - k2)(k2 - k3)", square, "above zero; otherwise L stays near the middle axis")?;
    Ok(square.sqrt())
}

/// Time in which `L` circles its axis once, near the separatrix: `(4 / mu) ln(4 / k')`.
///
/// `growth` is `mu`, from [`middle_axis_growth`]; `complement` is `k'^2 = (s1 - s3) |h - s2| / ((s1 - s2)(s2 - s3))`, the distance of `h = l.(s l)`
/// from the separatrix. The next term is smaller by a factor `k'^2`.
///
/// # Errors
/// [`Error::Domain`] unless the growth is above zero and `k'^2` within (0, 1].
pub fn period_near_separatrix(growth: f64, complement: f64) -> Result<f64, Error> {
    Error::ensure(growth > 0.0 && growth.is_finite(), "growth rate", growth, "above zero and finite")?;
    Error::ensure(complement > 0.0 && complement <= 1.0, "k'^2", complement, "above zero and at most 1")?;
    Ok(4.0 / growth * (4.0 / complement.sqrt()).ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_needs_growth_and_a_distance_from_the_separatrix() {
        let exact = 4.0 / 0.7 * (4.0 / 0.3_f64.sqrt()).ln();
        assert!((period_near_separatrix(0.7, 0.3).unwrap() - exact).abs() < 1e-14);
        assert!(period_near_separatrix(0.7, 1.0).is_ok());
        for (growth, complement) in [
            (0.0, 0.3),
            (-0.7, 0.3),
            (f64::INFINITY, 0.3),
            (f64::NAN, 0.3),
            (0.7, 0.0),
            (0.7, -0.3),
            (0.7, 1.0 + f64::EPSILON),
            (0.7, f64::NAN),
        ] {
            assert!(period_near_separatrix(growth, complement).is_err(), "{growth} {complement}");
        }
    }
}
