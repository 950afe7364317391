//! The table of the two solitary pulsars: change of `lambda` and the bounds from it.

use twofold::Error;
use twofold::star::estimates::inertia_over_c_estimate;
use twofold::units::geometrised::GRAM_PER_CUBIC_CENTIMETRE;

use super::{GoldenLine, GoldenTable, Printed};
use crate::pulsar_table::{self, Pulsar, ROUND_INERTIA_OVER_C};

/// What the paper prints of one pulse beside what was observed of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PrintedBounds {
    /// Change of `lambda` (1e-3 deg).
    pub(crate) lambda_change: &'static str,
    /// Bound in 1e-16 with the factor eta left out.
    pub(crate) bound: &'static str,
    /// Bound in 1e-16 with eta = 10.
    pub(crate) conservative: &'static str,
}

/// The last rows of the table, a column per pulse.
const PRINTED: [(&str, PrintedBounds); 3] = [
    ("PSR B1937+21, main pulse", PrintedBounds { lambda_change: "-19", bound: "100", conservative: "1000" }),
    ("PSR B1937+21, interpulse", PrintedBounds { lambda_change: "-5.2", bound: "10", conservative: "100" }),
    ("PSR J1744-1134", PrintedBounds { lambda_change: "1.6", bound: "1", conservative: "10" }),
];

/// The pulses of the paper with what is printed of them.
pub(crate) fn columns() -> Vec<(Pulsar, PrintedBounds)> {
    let pulsars = pulsar_table::paper();
    let printed = |pulsar: &Pulsar| {
        let (_, printed) = PRINTED.iter().find(|(name, _)| *name == pulsar.name)?;
        Some((pulsar.clone(), *printed))
    };
    pulsars.iter().map(|pulsar| printed(pulsar).expect("the paper prints a column for each")).collect()
}

/// The rows of the table that follow from its others.
pub(super) fn table() -> Result<GoldenTable, Error> {
    let estimate = inertia_over_c_estimate(1e15 * GRAM_PER_CUBIC_CENTIMETRE, 1e-3);
    let mut lines = Vec::new();
    for (pulsar, printed) in columns() {
        let mut line = |label: &str, printed, ours| {
            lines.push(GoldenLine::new(format!("{}: {label}", pulsar.name), printed, ours))
        };
        let bound = |inertia_over_c: f64| pulsar.bound_over_eta(inertia_over_c).map(|bound| bound * 1e16);
        line("Delta lambda (1e-3 deg)", Printed::Decimal(printed.lambda_change), pulsar.lambda_change()? * 1e3);
        line("bound / eta (1e-16)", Printed::Order(printed.bound), bound(estimate)?);
        line("bound / eta (1e-16), I^zz/C = 1e-5 s^2", Printed::Order(printed.bound), bound(ROUND_INERTIA_OVER_C)?);
        line("bound (1e-16), eta = 10", Printed::Order(printed.conservative), bound(estimate)? * 10.0);
    }
    Ok(GoldenTable {
        name: "pulsar_bounds",
        title: "Table of two pulsars: Delta lambda by Eq. (42), bounds on |2 s^ZZ - s^XX - s^YY| by Eq. (41) over 15 Julian \
                years with Delta cos lambda = -sin(lambda) Delta lambda, I^zz/C = 1.79e-5 s^2 by Eq. (43)",
        lines,
    })
}
