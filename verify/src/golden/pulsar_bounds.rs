//! The table of the two solitary pulsars: change of `lambda` and the bounds from it.

use twofold::Error;
use twofold::observables::bound::{SpinAxisDrift, lambda_change};
use twofold::star::estimates::inertia_over_c_estimate;
use twofold::units::geometrised::{GRAM_PER_CUBIC_CENTIMETRE, HERTZ};
use twofold::units::{DEGREE, JULIAN_YEAR};

use super::{GoldenLine, GoldenTable, Printed};

/// One column of the paper's table: angles in degrees, their changes in 1e-3 degrees over 15 years.
pub(crate) struct Column {
    name: &'static str,
    spin_period: f64,
    width: f64,
    width_change: f64,
    lambda: f64,
    chi: f64,
    /// Printed change of `lambda`.
    pub printed_change: &'static str,
    /// Printed bounds in 1e-16, with the factor eta left out and with eta = 10.
    pub printed_bound: &'static str,
    printed_conservative: &'static str,
}

/// The three columns as printed.
pub(crate) const COLUMNS: [Column; 3] = [
    Column {
        name: "PSR B1937+21, main pulse",
        spin_period: 1.6e-3,
        width: 8.3,
        width_change: -48.0,
        lambda: 100.0,
        chi: 75.0,
        printed_change: "-19",
        printed_bound: "100",
        printed_conservative: "1000",
    },
    Column {
        name: "PSR B1937+21, interpulse",
        spin_period: 1.6e-3,
        width: 10.0,
        width_change: 53.0,
        lambda: 100.0,
        chi: 105.0,
        printed_change: "-5.2",
        printed_bound: "10",
        printed_conservative: "100",
    },
    Column {
        name: "PSR J1744-1134",
        spin_period: 4.1e-3,
        width: 13.0,
        width_change: 20.0,
        lambda: 95.0,
        chi: 51.0,
        printed_change: "1.6",
        printed_bound: "1",
        printed_conservative: "10",
    },
];

impl Column {
    /// Change of `lambda` in 1e-3 degrees, Eq. (42).
    pub(crate) fn lambda_change(&self) -> Result<f64, Error> {
        lambda_change(self.lambda * DEGREE, self.chi * DEGREE, self.width * DEGREE, self.width_change)
    }

    /// Bound on `|2 s^ZZ - s^XX - s^YY|` in 1e-16, Eq. (41).
    pub(crate) fn bound(&self, polar_inertia_over_c: f64, eta: f64) -> Result<f64, Error> {
        let change = self.lambda_change()? * 1e-3 * DEGREE;
        SpinAxisDrift {
            polar_inertia_over_c,
            spin: HERTZ / self.spin_period,
            interval: 15.0 * JULIAN_YEAR,
            cos_lambda_change: -(self.lambda * DEGREE).sin() * change,
        }
        .combination_bound(eta)
        .map(|bound| bound * 1e16)
    }
}

/// The rows of the table that follow from its others.
pub(super) fn table() -> Result<GoldenTable, Error> {
    let estimate = inertia_over_c_estimate(1e15 * GRAM_PER_CUBIC_CENTIMETRE, 1e-3);
    let mut lines = Vec::new();
    for column in &COLUMNS {
        let mut line = |label: &str, printed, ours| {
            lines.push(GoldenLine::new(format!("{}: {label}", column.name), printed, ours))
        };
        line("Delta lambda (1e-3 deg)", Printed::Decimal(column.printed_change), column.lambda_change()?);
        let (bound, conservative) = (Printed::Order(column.printed_bound), Printed::Order(column.printed_conservative));
        line("bound / eta (1e-16)", bound, column.bound(estimate, 1.0)?);
        line("bound / eta (1e-16), I^zz/C = 1e-5 s^2", bound, column.bound(1e-5, 1.0)?);
        line("bound (1e-16), eta = 10", conservative, column.bound(estimate, 10.0)?);
    }
    Ok(GoldenTable {
        name: "pulsar_bounds",
        title: "Table of two pulsars: Delta lambda by Eq. (42), bounds on |2 s^ZZ - s^XX - s^YY| by Eq. (41) over 15 Julian \
                years with Delta cos lambda = -sin(lambda) Delta lambda, I^zz/C = 1.79e-5 s^2 by Eq. (43)",
        lines,
    })
}
