//! The table of the two solitary pulsars: change of `lambda` and the bounds from it.

use super::{GoldenLine, GoldenTable, Printed};
use twofold_scene::pulsar_table::published::printed_bounds;
use twofold_scene::pulsar_table::{CONSERVATIVE_ETA, ROUND_INERTIA_OVER_C};

/// The rows of the table that follow from its other rows, for each of the three readings.
pub(super) fn table() -> Result<GoldenTable, String> {
    let mut lines = Vec::new();
    for (pulsar, printed) in printed_bounds() {
        let own = pulsar.figure("bound_over_eta_own")?;
        let limit = pulsar.limit(&own)?;
        let by_change = limit.over_eta_by_change.ok_or("the paper's table has errors of the changes")?;
        let stated = pulsar.figure("bound_over_eta_stated")?.value * 1e16;
        let round = pulsar.bound_over_eta(ROUND_INERTIA_OVER_C)? * 1e16;
        let own = own.value * 1e16;
        let (over_eta, with_ten) = (Printed::Order(printed.bound), Printed::Order(printed.conservative));
        let short = |value| GoldenLine { digits: 4, ..GoldenLine::new("", Printed::No, value) };
        let change = pulsar.lambda_change()? * 1e3;
        for (label, line) in [
            ("Delta lambda (1e-3 deg)", GoldenLine::new("", Printed::Decimal(printed.lambda_change), change)),
            ("(a) bound / eta (1e-16), I^zz/C by Eq. (43)", GoldenLine::new("", over_eta, stated)),
            ("(a) bound / eta (1e-16), I^zz/C = 1e-5 s^2", GoldenLine::new("", over_eta, round)),
            (
                "(a) bound (1e-16), I^zz/C by Eq. (43), eta = 10",
                GoldenLine::new("", with_ten, stated * CONSERVATIVE_ETA),
            ),
            ("(b) bound / eta (1e-16), I^zz/C = 4/Omega^2", GoldenLine::new("", Printed::No, own)),
            (
                "(b) bound (1e-16), I^zz/C = 4/Omega^2, eta = 10",
                GoldenLine::new("", Printed::No, own * CONSERVATIVE_ETA),
            ),
            ("(c) as (b), with the error of Delta W, limit / eta (1e-16), 95 %", short(by_change * 1e16)),
            ("eta, 95 %, at the known angle lambda", short(limit.eta)),
            ("limit (1e-16), 95 %, all together", short(limit.all * 1e16)),
        ] {
            lines.push(GoldenLine { label: format!("{}: {label}", pulsar.name), ..line });
        }
    }
    Ok(GoldenTable {
        name: "pulsar_bounds",
        title: "Table of two pulsars: Delta lambda by Eq. (42), bounds on |2 s^ZZ - s^XX - s^YY| by Eq. (41) over 15 Julian \
                years with Delta cos lambda = -sin(lambda) Delta lambda, I^zz/C = 1.79e-5 s^2 by Eq. (43). Errors of Delta W are second-hand",
        lines,
    })
}
