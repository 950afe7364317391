//! Coefficients A_0, A_1, A_3 and C against a multiprecision table, elliptic integrals and the defining integral.

use nalgebra::Vector3;
use num_dual::{Dual2_64, Dual64};
use proptest::prelude::*;
use twofold::star::ellipsoid::UniformEllipsoid;
use twofold::star::potential_coefficients::potential_coefficients;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;
use twofold::{Error, Real};

use super::{coefficients_by_ellip, relative};
use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::physical_domain::worst_over;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "star-coefficients-table",
            kind: Kind::Oracle,
            equations: &[74],
            statement: "A_0, A_1, A_3 agree with 34-digit values from e = 0 through 1e-12 to 0.999 and from a3/a1 = 1 to 10",
            figure: "largest error / ulp",
            bound: Bound::AtMost(4.0),
            reason: "about ten roundings without cancellation; 3.2 ulp were seen at 12,000 random shapes",
            measure: coefficients_against_table,
        },
        Check {
            id: "star-c-table",
            kind: Kind::Oracle,
            equations: &[75],
            statement: "C agrees with 34-digit values from e = 0 through 1e-12 to 0.999 and from a3/a1 = 1 to 10",
            figure: "largest error / ulp",
            bound: Bound::AtMost(4.0),
            reason: "about ten roundings without cancellation; 4.4 ulp were seen at 12,000 random shapes",
            measure: c_against_table,
        },
        Check {
            id: "star-derivatives-table",
            kind: Kind::Autodiff,
            equations: &[74, 75],
            statement: "first and second derivatives of A_0, A_1, A_3, C with respect to e^2, and first ones with respect to e, \
                        agree with 34-digit values, at e = 0 as elsewhere",
            figure: "largest error / (2.2e-16 size), size = sum of |derivatives| to that order / min(1, q^2)",
            bound: Bound::AtMost(8.0),
            reason: "thrice the roundings of the value; e^2 given to an ulp leaves q^2 = 1 - e^2 with 1 / q^2 of it",
            measure: derivatives_against_table,
        },
        Check {
            id: "star-printed-closed-forms",
            kind: Kind::Oracle,
            equations: &[74, 75],
            statement: "A_0, A_1, A_3 and the bracket of C agree with the closed forms as printed, for e from 0.1 to 0.999",
            figure: "largest error x e^2 / 2.2e-16",
            bound: Bound::AtMost(8.0),
            reason: "the printed forms subtract numbers of order one and divide by e^2",
            measure: printed_closed_forms,
        },
        Check {
            id: "star-elliptic-integrals",
            kind: Kind::Oracle,
            equations: &[73, 74],
            statement: "A_i of spheroids and triaxial ellipsoids agree with Carlson's R_D of the crate ellip",
            figure: "largest relative error / 2.2e-16, for spheroids x min(1, |e^2|)",
            bound: Bound::AtMost(16.0),
            reason: "R_D of the crate is good to 7e-16 and the products add four roundings; where two arguments are equal it \
                     uses a closed form that divides by their distance e^2 to the third",
            measure: against_elliptic_integrals,
        },
        Check {
            id: "star-defining-integral",
            kind: Kind::Oracle,
            equations: &[73],
            statement: "A_0 and A_i of triaxial ellipsoids agree with the trapezoidal rule on the integrals that define them",
            figure: "largest relative error / 2.2e-16",
            bound: Bound::AtMost(16.0),
            reason: "the rule is exact to 1e-19 in y = ln u with step 0.4; some 80 terms of one sign, a few ulp each, are added",
            measure: against_defining_integral,
        },
        Check {
            id: "star-sum-rules",
            kind: Kind::Property,
            equations: &[73, 74],
            statement: "A_1 + A_2 + A_3 = 2 (Poisson's equation) and A_0 = sum A_i a_i^2 for ellipsoids and spheroids",
            figure: "largest relative error / 2.2e-16",
            bound: Bound::AtMost(16.0),
            reason: "sums of three positive terms, each to a few ulp",
            measure: sum_rules,
        },
        Check {
            id: "star-triaxial-limit",
            kind: Kind::Oracle,
            equations: &[73, 74, 75],
            statement: "an ellipsoid with a1 = a2 has the A_i, U^ij and inertias of the spheroid",
            figure: "largest relative error / 2.2e-16",
            bound: Bound::AtMost(32.0),
            reason: "two ways to the same coefficients, a few ulp each, times powers of the axes up to the fifth",
            measure: triaxial_limit,
        },
    ]
}

/// A row of the table: the shape's parameter, and value and two derivatives in `e^2` of A_0, A_1, A_3, C as decimals.
struct Row {
    prolate: bool,
    parameter: f64,
    entries: [[String; 3]; 4],
}

impl Row {
    fn name(&self) -> String {
        format!("{} = {}", if self.prolate { "a3/a1" } else { "e" }, self.parameter)
    }

    fn eccentricity_squared(&self) -> f64 {
        let p = self.parameter;
        if self.prolate { (1.0 - p) * (1.0 + p) } else { p * p }
    }

    fn shape(&self) -> Result<SpheroidShape<f64>, Error> {
        match self.prolate {
            true => SpheroidShape::from_axis_ratio(self.parameter),
            false => SpheroidShape::from_eccentricity(self.parameter),
        }
    }

    fn number(&self, function: usize, order: usize) -> f64 {
        self.entries[function][order].parse().expect("a number of the table")
    }
}

fn table() -> Vec<Row> {
    let text = include_str!("../../../data/spheroid.csv");
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes())
        .records()
        .map(|record| {
            let record = record.expect("a row of the table");
            Row {
                prolate: &record[0] == "prolate",
                parameter: record[1].parse().expect("a parameter"),
                entries: [0, 1, 2, 3].map(|f| [0, 1, 2].map(|order| record[2 + 3 * f + order].to_owned())),
            }
        })
        .collect()
}

/// `value - decimal` to 33 digits of either, in ulp of the decimal's nearest double.
fn error_in_ulp(value: f64, decimal: &str) -> f64 {
    let nearest: f64 = decimal.parse().expect("a decimal");
    let ulp = if nearest == 0.0 { f64::MIN_POSITIVE } else { nearest.abs().next_up() - nearest.abs() };
    let error = match (digits(&format!("{value:.33e}")), digits(decimal)) {
        ((a, p), (b, r)) if a != 0 && b != 0 && (p - r).abs() <= 3 => {
            let low = p.min(r);
            let (a, b) = (a * 10i128.pow((p - low) as u32), b * 10i128.pow((r - low) as u32));
            (a - b) as f64 * 10f64.powi(low)
        }
        _ => value - nearest,
    };
    error.abs() / ulp
}

/// Mantissa and decimal exponent of a decimal number with at most 35 digits.
fn digits(decimal: &str) -> (i128, i32) {
    let (mantissa, exponent) = decimal.split_once('e').unwrap_or((decimal, "0"));
    let fraction = mantissa.split_once('.').map_or(0, |(_, f)| f.len());
    let exponent: i32 = exponent.parse().expect("an exponent");
    (mantissa.replace('.', "").parse().expect("digits"), exponent - fraction as i32)
}

fn text(e: Error) -> String {
    e.to_string()
}

fn coefficients_against_table() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for row in table() {
        let a = potential_coefficients(&row.shape().map_err(text)?);
        for (i, value) in [a.a0, a.a1, a.a3].into_iter().enumerate() {
            worst.see(error_in_ulp(value, &row.entries[i][0]), || format!("A_{} at {}", [0, 1, 3][i], row.name()));
        }
    }
    worst.finish()
}

fn c_against_table() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for row in table() {
        let spheroid = UniformSpheroid::new(1.0, 1.0, row.shape().map_err(text)?).map_err(text)?;
        worst.see(error_in_ulp(spheroid.c(), &row.entries[3][0]), || format!("C at {}", row.name()));
    }
    worst.finish()
}

fn four<S: Real>(shape: SpheroidShape<S>) -> Result<[S; 4], Error> {
    let a = potential_coefficients(&shape);
    Ok([a.a0, a.a1, a.a3, UniformSpheroid::new(S::one(), S::one(), shape)?.c()])
}

fn derivatives_against_table() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for row in table() {
        let e2 = row.eccentricity_squared();
        let by_e2 = four(SpheroidShape::from_eccentricity_squared(Dual2_64::new(e2, 1.0, 0.0)).map_err(text)?);
        for (i, f) in by_e2.map_err(text)?.into_iter().enumerate() {
            let size = row.number(i, 0).abs() + row.number(i, 1).abs();
            let unit = f64::EPSILON / (1.0 - e2).min(1.0);
            let first = (f.v1 - row.number(i, 1)).abs() / (unit * size);
            let second = (f.v2 - row.number(i, 2)).abs() / (unit * (size + row.number(i, 2).abs()));
            worst.see(first, || format!("d/d(e^2) of function {i} at {}", row.name()));
            worst.see(second, || format!("d2/d(e^2)2 of function {i} at {}", row.name()));
        }
        if !row.prolate {
            let e = row.parameter;
            let by_e = four(SpheroidShape::from_eccentricity(Dual64::new(e, 1.0)).map_err(text)?).map_err(text)?;
            for (i, f) in by_e.into_iter().enumerate() {
                let exact = 2.0 * e * row.number(i, 1);
                let size = row.number(i, 0).abs() * e + exact.abs();
                let error = (f.eps - exact).abs();
                let figure = if error == 0.0 { 0.0 } else { error * (1.0 - e2) / (f64::EPSILON * size) };
                worst.see(figure, || format!("d/de of function {i} at {}", row.name()));
            }
        }
    }
    worst.finish()
}

fn printed_closed_forms() -> Result<Measured, String> {
    worst_over(31, 400, &(0.1..0.999f64), |&e| {
        let a = potential_coefficients(&SpheroidShape::from_eccentricity(e).map_err(text)?);
        let (q, f) = (((1.0 - e) * (1.0 + e)).sqrt(), e.asin() / e);
        let a1 = q / (e * e) * (f - q);
        let a3 = 2.0 / (e * e) * (1.0 - q * f);
        let errors = [a.a0 - 2.0 * q * f, a.a1 - a1, a.a3 - a3, a.difference - (a1 - q * q * a3)];
        Ok(errors.into_iter().fold(0.0, |m: f64, d| m.max(d.abs())) * e * e / f64::EPSILON)
    })
}

/// Semi-axes with ratios up to ten.
fn semi_axes() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-0.5..0.5f64).prop_map(|logs| logs.map(|log| 10f64.powf(log)))
}

fn ellipsoid(axes: [f64; 3]) -> Result<UniformEllipsoid<f64>, String> {
    UniformEllipsoid::new(Vector3::from(axes), 1.0).map_err(text)
}

fn largest_relative<const N: usize>(values: [f64; N], references: [f64; N]) -> f64 {
    values.into_iter().zip(references).fold(0.0, |m: f64, (v, r)| m.max(relative(v, r))) / f64::EPSILON
}

fn against_elliptic_integrals() -> Result<Measured, String> {
    worst_over(32, 400, &semi_axes(), |&[x, y, z]| {
        let triaxial =
            largest_relative(<[f64; 3]>::from(ellipsoid([x, y, z])?.coefficients()), coefficients_by_ellip([x, y, z])?);
        let shape = SpheroidShape::from_semi_axes(x, z).map_err(text)?;
        let (a, [a1, _, a3]) = (potential_coefficients(&shape), coefficients_by_ellip([x, x, z])?);
        let spheroid = largest_relative([a.a1, a.a3], [a1, a3]) * shape.eccentricity_squared().abs().min(1.0);
        Ok(triaxial.max(spheroid))
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
        Ok(largest_relative(coefficients, a).max(largest_relative([star.central_coefficient()], [a0])))
    })
}

fn sum_rules() -> Result<Measured, String> {
    worst_over(34, 400, &semi_axes(), |&axes| {
        let star = ellipsoid(axes)?;
        let a = star.coefficients();
        let weighted = a.dot(&Vector3::from(axes.map(|axis| axis * axis)));
        let triaxial = largest_relative([a.sum(), weighted], [2.0, star.central_coefficient()]);
        let shape = SpheroidShape::from_semi_axes(axes[0], axes[2]).map_err(text)?;
        let s = potential_coefficients(&shape);
        let spheroid = [2.0 * s.a1 + s.a3, 2.0 * s.a1 + shape.axis_ratio_squared() * s.a3];
        Ok(triaxial.max(largest_relative(spheroid, [2.0, s.a0])))
    })
}

fn triaxial_limit() -> Result<Measured, String> {
    worst_over(35, 400, &semi_axes(), |&[a1, _, a3]| {
        let (triaxial, spheroid) =
            (ellipsoid([a1, a1, a3])?, UniformSpheroid::from_semi_axes(a1, a3, 1.0).map_err(text)?);
        let (a, u, i) = (triaxial.coefficients(), triaxial.potential_energy_tensor(), triaxial.moments_of_inertia());
        let s = potential_coefficients(spheroid.shape());
        let (us, is) = (spheroid.potential_energy_tensor(), spheroid.moment_of_inertia());
        Ok(largest_relative(
            [a.x, a.y, a.z, u.x, u.y, u.z, i.x, i.y, i.z, triaxial.central_coefficient()],
            [s.a1, s.a1, s.a3, us.xx, us.xx, us.zz, is.xx, is.xx, is.zz, s.a0 * a1 * a1],
        ))
    })
}
