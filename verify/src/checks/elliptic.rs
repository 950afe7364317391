//! Elliptic integrals and functions: compared with 60-digit tables, with the crate `ellip`, and through identities of their
//! derivatives.

use num_dual::{Dual3_64, third_derivative};
use proptest::prelude::*;
use twofold::numerics::elliptic::carlson::{rc, rd, rf, rf_of_roots, rj, rj_of_roots};
use twofold::numerics::elliptic::jacobi::{JacobiFunctions, jacobi};

use crate::prelude::*;
use crate::reference::records;

checks! {
    /// R_F, R_C, R_D, R_J, conjugate pairs and complete ones included, agree with 60-digit values
    Oracle "carlson-table" []:
        || worst_of(carlson_table(), |row| Ok(relative(carlson(&row.function, &row.arguments), row.expected[0])));
    AtMost(4.0) "largest relative error / 2.2e-16";
    because "each duplication rounds a few times and divides inherited errors by four: the sum stays near two roundings";
    /// the first three derivatives of Carlson's integrals by dual numbers agree with those of 60-digit values
    Oracle "carlson-derivatives" []: carlson_derivatives;
    AtMost(16.0) "largest error / (k! value / argument^k, 2.2e-16)";
    because "as for the values, times the number of terms of a product's third derivative, eight";
    /// R_F, R_C, R_D, R_J agree with the crate ellip at random arguments over twelve decades
    Oracle "carlson-ellip" []: carlson_against_ellip;
    AtMost(8.0) "largest relative difference / 2.2e-16";
    because "four units in the last place for each of the two";
    /// K, sn, cn, dn agree with 60-digit values for m from -9999 to 1 - 1e-30, over several periods
    Oracle "jacobi-table" []: jacobi_values;
    AtMost(12.0) "largest error / (value + |u| slope, 2.2e-16)";
    because "up to eight steps of the ladder with three roundings of half a unit each";
    /// first and second derivatives of sn, cn, dn by m1 agree with those of 60-digit values
    Oracle "jacobi-parameter-derivatives" []: jacobi_parameter_derivatives;
    AtMost(32.0) "largest error / (k! (value + |u| slope) / m1^k, 2.2e-16)";
    because "the error of the values, times the number of terms of a product's second derivative, four";
    /// by duals sn' = cn dn, cn' = -sn dn, dn' = -m sn cn, and so the second and third derivatives of sn
    Autodiff "jacobi-argument-derivatives" []: jacobi_argument_derivatives;
    AtMost(32.0) "largest error / ((1 + |m|)^(order/2), 2.2e-16)";
    because "the error of the values, three factors in each term, and its derivatives";
    /// sn^2 + cn^2 = 1, dn^2 + m sn^2 = 1, dn^2 = m1 + m cn^2 at random arguments and parameters
    Property "jacobi-identities" []: jacobi_identities;
    AtMost(24.0) "largest residual / (sum of magnitudes, 2.2e-16)";
    because "twice the relative error of the values, which are squared";
}

#[derive(Debug)]
struct CarlsonRow {
    function: String,
    variable: String,
    arguments: Vec<f64>,
    /// Value and, except in the rows without a variable, three derivatives.
    expected: Vec<f64>,
}

/// The relative error in units of 2.2e-16.
fn relative(value: f64, expected: f64) -> f64 {
    (value / expected - 1.0).abs() / f64::EPSILON
}

fn carlson_table() -> impl Iterator<Item = CarlsonRow> {
    records(include_str!("../../data/carlson.csv")).map(|record| {
        let numbers = |columns: std::ops::Range<usize>| {
            let cells = columns.map(|i| &record[i]).filter(|cell| !cell.is_empty());
            cells.map(|cell| cell.parse().expect("a number")).collect()
        };
        CarlsonRow {
            function: record[0].to_string(),
            variable: record[1].to_string(),
            arguments: numbers(2..6),
            expected: numbers(6..10),
        }
    })
}

/// The function of a row; a conjugate pair is given by its real and imaginary parts.
fn carlson<S: Real>(function: &str, a: &[S]) -> S {
    // The root of a constant zero has no derivative.
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

fn carlson_derivatives() -> Result<Measured, String> {
    worst_of(carlson_table().filter(|row| !row.variable.is_empty()), |row| {
        let index = match row.variable.as_str() {
            "x" => 0,
            "y" | "re" => 1,
            "z" | "im" => 2,
            "p" => 3,
            other => return Err(format!("no variable {other}")),
        };
        let along = |v: Dual3_64| {
            let mut arguments: Vec<Dual3_64> = row.arguments.iter().map(|&x| Dual3_64::from_re(x)).collect();
            arguments[index] = v;
            carlson(&row.function, &arguments)
        };
        let (_, first, second, third) = third_derivative(along, row.arguments[index]);
        // Derivatives along the real or imaginary part have the scale of the modulus.
        let size = if row.function.ends_with("pair") && (index == 1 || index == 2) {
            row.arguments[1].hypot(row.arguments[2])
        } else {
            row.arguments[index].abs()
        };
        let mut scale = row.expected[0].abs();
        Ok(largest([first, second, third].into_iter().zip(&row.expected[1..]).zip([1.0, 2.0, 3.0]).map(
            |((derivative, expected), order)| {
                scale *= order / size;
                (derivative - expected).abs() / (scale * f64::EPSILON)
            },
        )))
    })
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
        Ok(largest(pairs.map(|(ours, theirs)| relative(ours, theirs))))
    })
}

/// Rows of `u, m1, K` and of `f, df/dm1, d2f/dm1^2` for sn, cn, dn.
fn jacobi_table() -> impl Iterator<Item = ([f64; 3], [[f64; 3]; 3])> {
    records(include_str!("../../data/jacobi.csv")).map(|record| {
        let triple = |from: usize| [0, 1, 2].map(|i| record[from + i].parse::<f64>().expect("a number"));
        (triple(0), [triple(3), triple(6), triple(9)])
    })
}

/// Values and three derivatives of sn, cn, dn along a change of their argument or parameter.
fn derivatives(functions: impl Fn(Dual3_64) -> JacobiFunctions<Dual3_64>, at: f64) -> [(f64, f64, f64, f64); 3] {
    [0, 1, 2].map(|i| third_derivative(|x| values(functions(x))[i], at))
}

fn values<S>(f: JacobiFunctions<S>) -> [S; 3] {
    [f.sn, f.cn, f.dn]
}

/// Derivatives by `u` from the values.
fn slopes([sn, cn, dn]: [f64; 3], m1: f64) -> [f64; 3] {
    [cn * dn, -sn * dn, (m1 - 1.0) * sn * cn]
}

fn jacobi_values() -> Result<Measured, String> {
    worst_of(jacobi_table(), |&([u, m1, quarter], expected)| {
        let expected = expected.map(|f| f[0]);
        let (ours, slopes) = (values(jacobi(u, m1)), slopes(expected, m1));
        let error = |i: usize| {
            let scale = expected[i].abs() + (u * slopes[i]).abs();
            (ours[i] - expected[i]).abs() / (scale * f64::EPSILON)
        };
        Ok(largest([relative(complete_integral(m1), quarter), error(0), error(1), error(2)]))
    })
}

fn jacobi_parameter_derivatives() -> Result<Measured, String> {
    worst_of(jacobi_table(), |&([u, m1, _], expected)| {
        let slopes = slopes(expected.map(|f| f[0]), m1);
        let ours = derivatives(|m1| jacobi(Dual3_64::from_re(u), m1), m1);
        Ok(largest([0, 1, 2].into_iter().flat_map(|i| {
            let (_, first, second, _) = ours[i];
            let size = expected[i][0].abs() + (u * slopes[i]).abs();
            let error = |derivative: f64, order: usize| {
                let scale = order as f64 * size / m1.powi(order as i32);
                (derivative - expected[i][order]).abs() / (scale * f64::EPSILON)
            };
            [error(first, 1), error(second, 2)]
        })))
    })
}

fn jacobi_points() -> impl Strategy<Value = (f64, f64)> {
    // Arguments in quarter periods; parameters from m = -99 to 1 - 1e-14.
    (-4.0..4.0f64, prop_oneof![(-14.0..0.0f64).prop_map(|log| 10f64.powf(log)), 0.0..1.0f64, 1.0..100.0f64])
        .prop_map(|(quarters, m1)| (quarters * complete_integral(m1), m1))
}

fn jacobi_argument_derivatives() -> Result<Measured, String> {
    worst_over(21, 500, &jacobi_points(), |&(u, m1)| {
        let m = 1.0 - m1;
        let [(sn, sn1, sn2, sn3), (cn, cn1, ..), (dn, dn1, ..)] = derivatives(|u| jacobi(u, Dual3_64::from_re(m1)), u);
        let [s, c, d] = slopes([sn, cn, dn], m1);
        // Each term is compared with its size without the cancellation at a zero.
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
