//! Coefficients A_i compared with the printed closed forms, elliptic integrals, the defining integral and their sum rules.

use proptest::prelude::*;
use twofold::star::ellipsoid::UniformEllipsoid;

use super::{coefficients_by_ellip, relative};
use crate::prelude::*;

checks! {
    /// A_0, A_1, A_3 and the bracket of C agree with the closed forms as printed, for e from 0.1 to 0.999
    Oracle "star-printed-closed-forms" [74, 75]: printed_closed_forms;
    AtMost(8.0) "largest error x e^2 / 2.2e-16";
    because "the printed forms subtract numbers of order one and divide by e^2";
    /// A_i of spheroids and triaxial ellipsoids agree with Carlson's R_D of the crate ellip
    Oracle "star-elliptic-integrals" [73, 74]: against_elliptic_integrals;
    AtMost(16.0) "largest relative error / 2.2e-16, for spheroids x min(1, |e^2|)";
    because "R_D of the crate is good to 7e-16 and the products add four roundings; where two arguments are equal it uses a closed form that divides \
     by their distance e^2 to the third";
    /// A_0 and A_i of triaxial ellipsoids agree with the trapezoidal rule on the integrals that define them
    Oracle "star-defining-integral" [73]: against_defining_integral;
    AtMost(16.0) "largest relative error / 2.2e-16";
    because "the rule is exact to 1e-19 in y = ln u with step 0.4; some 80 terms of one sign, a few ulp each, are added";
    /// A_1 + A_2 + A_3 = 2 (Poisson's equation) and A_0 = sum A_i a_i^2 for ellipsoids and spheroids
    Property "star-sum-rules" [73, 74]: sum_rules;
    AtMost(16.0) "largest relative error / 2.2e-16";
    because "sums of three positive terms, each to a few ulp";
    /// an ellipsoid with a1 = a2 has the A_i, U^ij and inertias of the spheroid
    Oracle "star-triaxial-limit" [73, 74, 75]: triaxial_limit;
    AtMost(32.0) "largest relative error / 2.2e-16";
    because "two ways to the same coefficients, a few ulp each, times powers of the axes up to the fifth";
}

fn printed_closed_forms() -> Result<Measured, String> {
    worst_over(31, 400, &(0.1..0.999f64), |&e| {
        let a = potential_coefficients(&SpheroidShape::from_eccentricity(e)?);
        let (q, f) = (((1.0 - e) * (1.0 + e)).sqrt(), e.asin() / e);
        let a1 = q / (e * e) * (f - q);
        let a3 = 2.0 / (e * e) * (1.0 - q * f);
        let errors = [a.a0 - 2.0 * q * f, a.a1 - a1, a.a3 - a3, a.difference - (a1 - q * q * a3)];
        Ok(largest(errors.map(f64::abs)) * e * e / f64::EPSILON)
    })
}

/// Semi-axes with ratios up to ten.
fn semi_axes() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-0.5..0.5f64).prop_map(|logs| logs.map(|log| 10f64.powf(log)))
}

fn ellipsoid(axes: [f64; 3]) -> Result<UniformEllipsoid<f64>, String> {
    UniformEllipsoid::new(Vector3::from(axes), 1.0).map_err(String::from)
}

fn largest_relative<const N: usize>(values: [f64; N], references: [f64; N]) -> f64 {
    largest(values.into_iter().zip(references).map(|(v, r)| relative(v, r))) / f64::EPSILON
}

fn against_elliptic_integrals() -> Result<Measured, String> {
    worst_over(32, 400, &semi_axes(), |&[x, y, z]| {
        let triaxial =
            largest_relative(<[f64; 3]>::from(ellipsoid([x, y, z])?.coefficients()), coefficients_by_ellip([x, y, z])?);
        let shape = SpheroidShape::from_semi_axes(x, z)?;
        let (a, [a1, _, a3]) = (potential_coefficients(&shape), coefficients_by_ellip([x, x, z])?);
        let spheroid = largest_relative([a.a1, a.a3], [a1, a3]) * shape.eccentricity_squared().abs().min(1.0);
        Ok(largest([triaxial, spheroid]))
    })
}

/// `a1 a2 a3 int_0^inf g(u) du` by the trapezoidal rule in `y = ln u`: the integrand is analytic for `|Im y| < pi`.
fn trapezoid(axes: [f64; 3], g: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 0.4;
    let points = (-115..215).map(|i| (f64::from(i) * STEP).exp());
    axes.iter().product::<f64>() * STEP * points.map(|u| u * g(u)).sum::<f64>()
}

fn against_defining_integral() -> Result<Measured, String> {
    worst_over(33, 200, &semi_axes(), |&axes| {
        let star = ellipsoid(axes)?;
        let delta = |u: f64| axes.iter().map(|a| a * a + u).product::<f64>().sqrt();
        let a0 = trapezoid(axes, |u| 1.0 / delta(u));
        let a = axes.map(|axis| trapezoid(axes, |u| 1.0 / ((axis * axis + u) * delta(u))));
        let coefficients = <[f64; 3]>::from(star.coefficients());
        Ok(largest([largest_relative(coefficients, a), largest_relative([star.central_coefficient()], [a0])]))
    })
}

fn sum_rules() -> Result<Measured, String> {
    worst_over(34, 400, &semi_axes(), |&axes| {
        let star = ellipsoid(axes)?;
        let a = star.coefficients();
        let weighted = a.dot(&Vector3::from(axes.map(|axis| axis * axis)));
        let triaxial = largest_relative([a.sum(), weighted], [2.0, star.central_coefficient()]);
        let shape = SpheroidShape::from_semi_axes(axes[0], axes[2])?;
        let s = potential_coefficients(&shape);
        let spheroid = [2.0 * s.a1 + s.a3, 2.0 * s.a1 + shape.axis_ratio_squared() * s.a3];
        Ok(largest([triaxial, largest_relative(spheroid, [2.0, s.a0])]))
    })
}

fn triaxial_limit() -> Result<Measured, String> {
    worst_over(35, 400, &semi_axes(), |&[a1, _, a3]| {
        let (triaxial, spheroid) = (ellipsoid([a1, a1, a3])?, UniformSpheroid::from_semi_axes(a1, a3, 1.0)?);
        let (a, u, i) = (triaxial.coefficients(), triaxial.potential_energy_tensor(), triaxial.moments_of_inertia());
        let s = potential_coefficients(&spheroid.shape);
        let (us, is) = (spheroid.potential_energy_tensor(), spheroid.moment_of_inertia());
        Ok(largest_relative(
            [a.x, a.y, a.z, u.x, u.y, u.z, i.x, i.y, i.z, triaxial.central_coefficient()],
            [s.a1, s.a1, s.a3, us.xx, us.xx, us.zz, is.xx, is.xx, is.zz, s.a0 * a1 * a1],
        ))
    })
}
