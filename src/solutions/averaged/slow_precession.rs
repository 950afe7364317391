//! The slow precession of the angular momentum, to first order in the coefficients for Lorentz violation.
//!
//! Averaged over the fast rotation of `n` about `L`, with `l = L/|L|`, `G = |L|`, `c = n.l`, the direction of `L` moves like
//! the angular velocity of a free asymmetric top in the body,
//!
//! ```text
//! dl/dt = kappa (s l) x l,     kappa = 2 C P2(c) / G,     P2(c) = (3 c^2 - 1) / 2
//! ```
//!
//! with `h = l.(s l)` constant. With the eigenvalues `s1 >= s2 >= s3` it circles the axis of `s3` if `h < s2` and the axis of `s1`
//! if `h > s2`; the two cases are divided by a separatrix through the axis of `s2`.

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::elliptic::jacobi::ArithmeticGeometricMean;
use crate::numerics::scalar::{Real, length};

/// The principal axis that the angular momentum circles, and the rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowPrecession<S> {
    /// Index of the principal axis: 0 for X, 1 for Y, 2 for Z.
    pub axis: usize,
    /// Mean rate of the azimuth of `L` about the positive end of that axis (rad per unit of time).
    pub rate: S,
}

/// Mean rate of the precession of `L` about a principal axis, to first order in s. In terms of elliptic integrals it is the
/// angular velocity `pi kappa p / (2 K(k))` with, for `h < s2`,
///
/// ```text
/// p^2 = (s2 - s3)(s1 - h),     k'^2 = 1 - k^2 = (s1 - s3)(s2 - h) / p^2,
/// rate = -kappa sign(l_3) AGM(p, p k'),
/// ```
///
/// AGM the arithmetic-geometric mean; for `h > s2` the same with `s1` and `s3` exchanged and the opposite sign (Landau and
/// Lifshitz, Mechanics, section 37; this is the analogue of their `Omega`).
///
/// `momentum` and `axis` (`n`) are those of the averaged motion. With the osculating values at any time the result is correct to
/// the same order, with a relative error of the order of `C |s| I^xx / G^2` (for tp-II 5%). For the averaged equation the result
/// is exact in the symmetric limits: `kappa (s1 - s3) cos` of the inclination if two eigenvalues are equal, zero if all three are.
///
/// # Errors
/// [`Error::Domain`] for `L = 0`, and on the separatrix, `h = s2` (to rounding) with three different eigenvalues.
pub fn slow_precession<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    momentum: &Vector3<S>,
    axis: &Vector3<S>,
) -> Result<SlowPrecession<S>, Error> {
    let size = length(momentum);
    Error::ensure(size.re() > 0.0, "angular momentum |L|", size.re(), "above zero")?;
    let l = momentum / size;
    let c = axis.dot(&l);
    let kappa = spheroid.constant_c * (c * c * 3.0 - S::one()) / size;

    let values = [s.xx, s.yy, s.zz];
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].re().total_cmp(&values[i].re()));
    let [s1, s2, s3] = order.map(|i| values[i]);
    let [l1, l2, l3] = order.map(|i| l[i]);
    // Only differences of `h` from an eigenvalue are formed, as sums of terms of one sign where possible.
    let below_middle = (s2 - s3) * l3 * l3 - (s1 - s2) * l1 * l1;
    let around_third = below_middle.re() > 0.0 || (below_middle.re() == 0.0 && s1.re() == s2.re());
    let (p_squared, q_squared, end, sense) = if around_third {
        ((s2 - s3) * ((s1 - s2) * l2 * l2 + (s1 - s3) * l3 * l3), (s1 - s3) * below_middle, (order[2], l3), -1.0)
    } else {
        ((s1 - s2) * ((s1 - s3) * l1 * l1 + (s2 - s3) * l2 * l2), -((s1 - s3) * below_middle), (order[0], l1), 1.0)
    };
    let sense = if end.1.re() < 0.0 { -sense } else { sense };
    if p_squared.re() <= 0.0 && q_squared.re() <= 0.0 {
        return Ok(SlowPrecession { axis: end.0, rate: S::zero() });
    }
    let ratio = (q_squared / p_squared).re();
    Error::ensure(
        ratio > f64::EPSILON * f64::EPSILON,
        "k'^2, distance from the separatrix",
        ratio,
        "above 5e-32; on the separatrix L approaches the middle axis and has no mean rate",
    )?;
    let mean = ArithmeticGeometricMean::new(p_squared.sqrt(), q_squared.sqrt()).limit();
    Ok(SlowPrecession { axis: end.0, rate: kappa * mean * sense })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separatrix_and_rest_are_refused() {
        let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
        let of =
            |momentum: Vector3<f64>| slow_precession(&RigidSpheroid::in_units_of_tc(1.1), &s, &momentum, &Vector3::z());
        assert!(of(Vector3::zeros()).is_err() && of(Vector3::y()).is_err());
        assert!(of(Vector3::new(0.0, 1.0, 1e-3)).is_ok_and(|found| found.axis == 2));
        assert!(of(Vector3::new(1e-3, 1.0, 0.0)).is_ok_and(|found| found.axis == 0));
    }

    /// With two equal eigenvalues only the axis of the third is distinguished: `L` circles that axis, and stays at rest if it is
    /// normal to it.
    #[test]
    fn about_an_axis_of_symmetry_it_goes_round_that_axis() {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let n = Vector3::new(0.6, 0.0, 0.8);
        for (values, momentum, axis) in [
            ([0.02, -0.01, -0.01], Vector3::new(0.0, 0.6, 0.8), 0),
            ([-0.01, 0.02, -0.01], Vector3::new(-0.6, 0.0, 0.8), 1),
            ([0.01, 0.01, -0.02], Vector3::new(0.6, 0.8, 0.0), 2),
        ] {
            let found = slow_precession(&spheroid, &PrincipalCoefficients::new(values), &momentum, &n).unwrap();
            assert_eq!(found, SlowPrecession { axis, rate: 0.0 });
        }
    }

    /// The distance from the separatrix is relative: the rate is proportional to the tensor, however weak that is.
    #[test]
    fn a_weak_tensor_is_no_separatrix() {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let (momentum, n) = (Vector3::new(0.0, 1.0, 1e-3), Vector3::new(0.6, 0.0, 0.8));
        let rate = |factor: f64| {
            let s = PrincipalCoefficients::new([0.02 * factor, 0.01 * factor, -0.04 * factor]);
            slow_precession(&spheroid, &s, &momentum, &n).unwrap().rate
        };
        for factor in [1e-3, 1e-15, 1e12] {
            assert!((rate(factor) / (rate(1.0) * factor) - 1.0).abs() < 1e-12, "{factor}");
        }
    }
}
