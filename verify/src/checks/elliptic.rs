//! Elliptic integrals and functions: against 60-digit tables, against the crate `ellip`, by identities of their derivatives.

use num_dual::{Dual3_64, third_derivative};
use proptest::prelude::*;
use twofold::numerics::elliptic::carlson::{rc, rd, rf, rf_of_roots, rj, rj_of_roots};
use twofold::numerics::elliptic::jacobi::{JacobiFunctions, complete_integral, jacobi};
use twofold::numerics::scalar::Real;

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::physical_domain::worst_over;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "carlson-table",
            kind: Kind::Oracle,
            equations: &[],
            statement: "R_F, R_C, R_D, R_J, conjugate pairs and complete ones included, agree with 60-digit values",
            figure: "largest relative error / 2.2e-16",
            bound: Bound::AtMost(4.0),
            reason: "each duplication rounds a few times and divides inherited errors by four: the sum stays near two roundings",
            measure: carlson_values,
        },
        Check {
            id: "carlson-derivatives",
            kind: Kind::Oracle,
            equations: &[],
            statement: "the first three derivatives of Carlson's integrals by dual numbers agree with those of 60-digit values",
            figure: "largest error / (k! value / argument^k, 2.2e-16)",
            bound: Bound::AtMost(16.0),
            reason: "as for the values, times the number of terms of a product's third derivative, eight",
            measure: carlson_derivatives,
        },
        Check {
            id: "carlson-ellip",
            kind: Kind::Oracle,
            equations: &[],
            statement: "R_F, R_C, R_D, R_J agree with the crate ellip at random arguments over twelve decades",
            figure: "largest relative difference / 2.2e-16",
            bound: Bound::AtMost(8.0),
            reason: "four units in the last place for each of the two",
            measure: carlson_against_ellip,
        },
        Check {
            id: "jacobi-table",
            kind: Kind::Oracle,
            equations: &[],
            statement: "K, sn, cn, dn agree with 60-digit values for m from -9999 to 1 - 1e-30, over several periods",
            figure: "largest error / (value + |u| slope, 2.2e-16)",
            bound: Bound::AtMost(12.0),
            reason: "up to eight steps of the ladder with three roundings of half a unit each",
            measure: jacobi_values,
        },
        Check {
            id: "jacobi-parameter-derivatives",
            kind: Kind::Oracle,
            equations: &[],
            statement: "first and second derivatives of sn, cn, dn by m1 agree with those of 60-digit values",
            figure: "largest error / (k! (value + |u| slope) / m1^k, 2.2e-16)",
            bound: Bound::AtMost(32.0),
            reason: "the error of the values, times the number of terms of a product's second derivative, four",
            measure: jacobi_parameter_derivatives,
        },
        Check {
            id: "jacobi-argument-derivatives",
            kind: Kind::Autodiff,
            equations: &[],
            statement: "by duals sn' = cn dn, cn' = -sn dn, dn' = -m sn cn, and so the second and third derivatives of sn",
            figure: "largest error / ((1 + |m|)^(order/2), 2.2e-16)",
            bound: Bound::AtMost(32.0),
            reason: "the error of the values, three factors in each term, and its derivatives",
            measure: jacobi_argument_derivatives,
        },
        Check {
            id: "jacobi-identities",
            kind: Kind::Property,
            equations: &[],
            statement: "sn^2 + cn^2 = 1, dn^2 + m sn^2 = 1, dn^2 = m1 + m cn^2 at random arguments and parameters",
            figure: "largest residual / (sum of magnitudes, 2.2e-16)",
            bound: Bound::AtMost(24.0),
            reason: "twice the relative error of the values, which are squared",
            measure: jacobi_identities,
        },
    ]
}

struct CarlsonRow {
    function: String,
    variable: String,
    arguments: Vec<f64>,
    /// Value and, except in the rows without a variable, three derivatives.
    expected: Vec<f64>,
}

fn carlson_table() -> Vec<CarlsonRow> {
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(include_str!("../../data/carlson.csv").as_bytes())
        .records()
        .map(|record| {
            let record = record.expect("well-formed CSV");
            let numbers = |from: usize, to: usize| {
                (from..to).filter(|&i| !record[i].is_empty()).map(|i| record[i].parse().expect("a number")).collect()
            };
            CarlsonRow {
                function: record[0].to_string(),
                variable: record[1].to_string(),
                arguments: numbers(2, 6),
                expected: numbers(6, 10),
            }
        })
        .collect()
}

/// The function of a row; a conjugate pair enters by its real and imaginary parts.
fn carlson<S: Real>(function: &str, a: &[S]) -> S {
    // The root of a zero that is a constant is a constant.
    let root = |x: S| if x.re() == 0.0 { S::zero() } else { x.sqrt() };
    match function {
        "rf" => rf(a[0], a[1], a[2]),
        "rc" => rc(a[0], a[1]),
        "rd" => rd(a[0], a[1], a[2]),
        "rj" => rj(a[0], a[1], a[2], a[3]),
        "rf_pair" => {
            let (sum, product) = roots_of_pair(a[1], a[2]);
            rf_of_roots(root(a[0]), sum, product)
        }
        "rj_pair" => {
            let (sum, product) = roots_of_pair(a[1], a[2]);
            rj_of_roots(root(a[0]), sum, product, a[3])
        }
        other => panic!("no function {other}"),
    }
}

/// Sum and product of the roots of a conjugate pair.
fn roots_of_pair<S: Real>(re: S, im: S) -> (S, S) {
    let modulus = (re * re + im * im).sqrt();
    let twice = if re.re() < 0.0 { im * im / (modulus - re) } else { modulus + re };
    ((twice * 2.0).sqrt(), modulus)
}

fn carlson_values() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for row in carlson_table() {
        let error = carlson(&row.function, &row.arguments) / row.expected[0] - 1.0;
        worst.see(error.abs() / f64::EPSILON, || format!("{} {:?}", row.function, row.arguments));
    }
    worst.finish()
}

fn carlson_derivatives() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for row in carlson_table().into_iter().filter(|row| !row.variable.is_empty()) {
        let index = match row.variable.as_str() {
            "x" => 0,
            "y" | "re" => 1,
            "z" => 2,
            "im" => 2,
            "p" => 3,
            other => return Err(format!("no variable {other}")),
        };
        let (_, first, second, third) = third_derivative(
            |v: Dual3_64| {
                let mut arguments: Vec<Dual3_64> = row.arguments.iter().map(|&x| Dual3_64::from_re(x)).collect();
                arguments[index] = v;
                carlson(&row.function, &arguments)
            },
            row.arguments[index],
        );
        // Derivatives along the real or imaginary part have the scale of the modulus.
        let size = if row.function.ends_with("pair") && (index == 1 || index == 2) {
            row.arguments[1].hypot(row.arguments[2])
        } else {
            row.arguments[index].abs()
        };
        let mut scale = row.expected[0].abs();
        for (order, derivative) in [first, second, third].into_iter().enumerate() {
            scale *= (order + 1) as f64 / size;
            let error = (derivative - row.expected[order + 1]).abs() / (scale * f64::EPSILON);
            let place =
                || format!("order {} of {} by {} at {:?}", order + 1, row.function, row.variable, row.arguments);
            worst.see(error, place);
        }
    }
    worst.finish()
}

fn carlson_against_ellip() -> Result<Measured, String> {
    let argument = (-6.0..6.0f64).prop_map(|log| 10f64.powf(log));
    worst_over(20, 1000, &prop::array::uniform4(argument), |&[x, y, z, p]| {
        let fault = |error: ellip::StrErr| error.to_string();
        let pairs = [
            (rf(x, y, z), ellip::elliprf(x, y, z).map_err(fault)?),
            (rc(x, y), ellip::elliprc(x, y).map_err(fault)?),
            (rd(x, y, z), ellip::elliprd(x, y, z).map_err(fault)?),
            (rj(x, y, z, p), ellip::elliprj(x, y, z, p).map_err(fault)?),
        ];
        Ok(largest(pairs.iter().map(|(ours, theirs)| (ours / theirs - 1.0).abs() / f64::EPSILON)))
    })
}

/// Rows of `u, m1, K` and of `f, df/dm1, d2f/dm1^2` for sn, cn, dn.
fn jacobi_table() -> Vec<([f64; 3], [[f64; 3]; 3])> {
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(include_str!("../../data/jacobi.csv").as_bytes())
        .records()
        .map(|record| {
            let record = record.expect("well-formed CSV");
            let triple = |from: usize| [0, 1, 2].map(|i| record[from + i].parse::<f64>().expect("a number"));
            (triple(0), [triple(3), triple(6), triple(9)])
        })
        .collect()
}

fn values<S>(f: JacobiFunctions<S>) -> [S; 3] {
    [f.sn, f.cn, f.dn]
}

/// Derivatives by `u` from the values.
fn slopes([sn, cn, dn]: [f64; 3], m1: f64) -> [f64; 3] {
    [cn * dn, -sn * dn, (m1 - 1.0) * sn * cn]
}

fn jacobi_values() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for ([u, m1, quarter], expected) in jacobi_table() {
        worst.see((complete_integral(m1) / quarter - 1.0).abs() / f64::EPSILON, || format!("K, m1 = {m1:e}"));
        let expected = expected.map(|f| f[0]);
        let slopes = slopes(expected, m1);
        for (i, ours) in values(jacobi(u, m1)).into_iter().enumerate() {
            let scale = expected[i].abs() + (u * slopes[i]).abs();
            worst.see((ours - expected[i]).abs() / (scale * f64::EPSILON), || {
                format!("{} at u = {u}, m1 = {m1:e}", ["sn", "cn", "dn"][i])
            });
        }
    }
    worst.finish()
}

fn jacobi_parameter_derivatives() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for ([u, m1, _], expected) in jacobi_table() {
        let by = |pick: fn(JacobiFunctions<Dual3_64>) -> Dual3_64| {
            third_derivative(|m1: Dual3_64| pick(jacobi(Dual3_64::from_re(u), m1)), m1)
        };
        let slopes = slopes(expected.map(|f| f[0]), m1);
        for (i, (_, first, second, _)) in [by(|f| f.sn), by(|f| f.cn), by(|f| f.dn)].into_iter().enumerate() {
            for (order, derivative) in [(1_usize, first), (2, second)] {
                let scale = order as f64 * (expected[i][0].abs() + (u * slopes[i]).abs()) / m1.powi(order as i32);
                worst.see((derivative - expected[i][order]).abs() / (scale * f64::EPSILON), || {
                    format!(
                        "order {order} of {} at u = {u}, m1 = {m1:e}: {derivative:e} {:e}",
                        ["sn", "cn", "dn"][i],
                        expected[i][order]
                    )
                });
            }
        }
    }
    worst.finish()
}

fn jacobi_points() -> impl Strategy<Value = (f64, f64)> {
    // Arguments in quarter periods; parameters from m = -99 to 1 - 1e-14.
    (-4.0..4.0f64, prop_oneof![(-14.0..0.0f64).prop_map(|log| 10f64.powf(log)), 0.0..1.0f64, 1.0..100.0f64])
        .prop_map(|(quarters, m1)| (quarters * complete_integral(m1), m1))
}

fn jacobi_argument_derivatives() -> Result<Measured, String> {
    worst_over(21, 500, &jacobi_points(), |&(u, m1)| {
        let m = 1.0 - m1;
        let by = |pick: fn(JacobiFunctions<Dual3_64>) -> Dual3_64| {
            third_derivative(|u: Dual3_64| pick(jacobi(u, Dual3_64::from_re(m1))), u)
        };
        let (sn, sn1, sn2, sn3) = by(|f| f.sn);
        let (cn, cn1, ..) = by(|f| f.cn);
        let (dn, dn1, ..) = by(|f| f.dn);
        let [s, c, d] = slopes([sn, cn, dn], m1);
        // The size of each term, as it is without the cancellation at a zero.
        let size = 1.0 + m.abs();
        let residuals = [
            (sn1 - s) / size.sqrt(),
            (cn1 - c) / size.sqrt(),
            (dn1 - d) / size,
            (sn2 + (1.0 + m) * sn - 2.0 * m * sn.powi(3)) / size,
            (sn3 + (1.0 + m) * s - 6.0 * m * sn * sn * s) / size.powf(1.5),
        ];
        Ok(largest(residuals.map(f64::abs)) / f64::EPSILON)
    })
}

fn jacobi_identities() -> Result<Measured, String> {
    worst_over(22, 2000, &jacobi_points(), |&(u, m1)| {
        let m = 1.0 - m1;
        let [s, c, d] = values(jacobi(u, m1)).map(|f| f * f);
        let residuals = [
            (s + c - 1.0) / 2.0,
            (d + m * s - 1.0) / (d + m.abs() * s + 1.0),
            (d - m1 - m * c) / (d + m1 + m.abs() * c),
        ];
        Ok(largest(residuals.map(f64::abs)) / f64::EPSILON)
    })
}
