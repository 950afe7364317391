//! Coefficients A_0, A_1, A_3 and C with their derivatives, compared with a table of 34-digit values.

use crate::prelude::*;
use crate::reference::records;

checks! {
    /// A_0, A_1, A_3 agree with 34-digit values from e = 0 through 1e-12 to 0.999 and from a3/a1 = 1 to 10
    Oracle "star-coefficients-table" [74]: || against_table(&[0, 1, 2]);
    AtMost(4.0) "largest error / ulp";
    because "about ten roundings without cancellation; 3.6 ulp were seen at 100,000 random shapes";
    /// C agrees with 34-digit values from e = 0 through 1e-12 to 0.999 and from a3/a1 = 1 to 10
    Oracle "star-c-table" [75]: || against_table(&[3]);
    AtMost(4.0) "largest error / ulp";
    because "about ten roundings without cancellation; 3.3 ulp were seen at 100,000 random shapes";
    /// first and second derivatives of A_0, A_1, A_3, C with respect to e^2, and first ones with respect to e, agree with 34-digit values, at e = 0
    /// as elsewhere
    Autodiff "star-derivatives-table" [74, 75]: derivatives_against_table;
    AtMost(8.0) "largest error / (2.2e-16 size), size = sum of |derivatives| to that order / min(1, q^2)";
    because "thrice the roundings of the value; e^2 given to an ulp leaves q^2 = 1 - e^2 with 1 / q^2 of it";
}

/// A row of the table: the shape's parameter, and value and two derivatives in `e^2` of A_0, A_1, A_3, C as decimals.
#[derive(Debug)]
struct Row {
    prolate: bool,
    parameter: f64,
    entries: [[String; 3]; 4],
}

impl Row {
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

fn table() -> impl Iterator<Item = Row> {
    records(include_str!("../../../data/spheroid.csv")).map(|record| Row {
        prolate: &record[0] == "prolate",
        parameter: record[1].parse().expect("a parameter"),
        entries: [0, 1, 2, 3].map(|f| [0, 1, 2].map(|order| record[2 + 3 * f + order].to_owned())),
    })
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

/// The largest error of the given ones of the four functions.
fn against_table(functions: &[usize]) -> Result<Measured, String> {
    worst_of(table(), |row| {
        let values = four(row.shape()?)?;
        Ok(largest(functions.iter().map(|&i| error_in_ulp(values[i], &row.entries[i][0]))))
    })
}

fn four<S: Real>(shape: SpheroidShape<S>) -> Result<[S; 4], Error> {
    let a = potential_coefficients(&shape);
    Ok([a.a0, a.a1, a.a3, UniformSpheroid::new(S::one(), S::one(), shape)?.c()])
}

fn derivatives_against_table() -> Result<Measured, String> {
    worst_of(table(), |row| {
        let e2 = row.eccentricity_squared();
        let by_e2 = four(SpheroidShape::from_eccentricity_squared(Dual2_64::new(e2, 1.0, 0.0))?)?;
        let unit = f64::EPSILON / (1.0 - e2).min(1.0);
        let mut figures = Vec::new();
        for (i, f) in by_e2.into_iter().enumerate() {
            let size = row.number(i, 0).abs() + row.number(i, 1).abs();
            figures.push((f.v1 - row.number(i, 1)).abs() / (unit * size));
            figures.push((f.v2 - row.number(i, 2)).abs() / (unit * (size + row.number(i, 2).abs())));
        }
        if !row.prolate {
            let e = row.parameter;
            for (i, f) in four(SpheroidShape::from_eccentricity(Dual64::new(e, 1.0))?)?.into_iter().enumerate() {
                let exact = 2.0 * e * row.number(i, 1);
                let size = row.number(i, 0).abs() * e + exact.abs();
                let error = (f.eps - exact).abs();
                figures.push(if error == 0.0 { 0.0 } else { error * (1.0 - e2) / (f64::EPSILON * size) });
            }
        }
        Ok(largest(figures))
    })
}
