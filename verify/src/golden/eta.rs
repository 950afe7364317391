//! The factor eta of Eq. (41): at the values given in the paper, and along the inclination.

use twofold::units::DEGREE;

use super::{GoldenLine, GoldenTable, Printed};
use crate::eta::{EtaStatistics, PAPER_ASYMMETRY, eta_curve};
use crate::prelude::*;

/// Eta for three shapes of the tensor, with quantiles for the paper's.
pub(super) fn table() -> Result<GoldenTable, Error> {
    let mut lines = Vec::new();
    let mut line = |label: String, printed, value| {
        lines.push(GoldenLine { digits: 4, ..GoldenLine::new(label, printed, value) });
    };
    let right_angle = root_mean_square_along_motion(PAPER_ASYMMETRY, FRAC_PI_2);
    line("r = -1/11, beta_0 = pi/2: eta".to_owned(), Printed::Order("10"), right_angle);
    for point in eta_curve(PAPER_ASYMMETRY, &[0.2, 0.7, 1.1, 1.4, 1.5])? {
        let at = format!("r = -1/11, beta_0 = {}", point.beta_0);
        line(format!("{at}: 1/cos beta_0"), Printed::No, point.printed);
        line(format!("{at}: eta"), Printed::No, point.along_motion);
        let EtaStatistics { root_mean_square, median, quantile_84, quantile_975 } = point.at_inclination;
        for (part, value) in
            [("", root_mean_square), (", median", median), (", 84 %", quantile_84), (", 97.5 %", quantile_975)]
        {
            line(format!("{at}: at this inclination{part}"), Printed::No, value);
        }
        if let Some(statistics) = point.at_constant {
            line(format!("{at} of Eq. (34)"), Printed::No, statistics.root_mean_square);
            line(format!("{at} of Eq. (34), median"), Printed::No, statistics.median);
        }
    }
    for (ratio, name) in [(0.0, "0"), (-1.0 / 3.0, "-1/3")] {
        for beta in [0.2, 0.7, 1.1, 1.4, 1.5] {
            line(format!("r = {name}, beta_0 = {beta}: eta"), Printed::No, root_mean_square_along_motion(ratio, beta));
        }
    }
    for (ratio, name) in [(0.0, "0"), (PAPER_ASYMMETRY, "-1/11"), (-1.0 / 3.0, "-1/3")] {
        let unknown = EtaDistribution::new(ratio, SpinAxis::Unknown)?;
        line(format!("r = {name}, axis unknown: median"), Printed::No, unknown.quantile(0.5)?);
        line(format!("r = {name}, axis unknown: 95 %"), Printed::No, unknown.quantile(0.95)?);
        for lambda in [95.0, 100.0] {
            let seen = unknown.clone().seen_at(lambda * DEGREE)?;
            line(format!("r = {name}, axes unknown, lambda = {lambda} deg: 95 %"), Printed::No, seen.quantile(0.95)?);
        }
    }
    Ok(GoldenTable {
        name: "eta",
        title: "Factor eta of Eq. (41) for tensors of the asymmetry ratio r = (s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY): eta is for the \
                root mean square of d cos lambda / dt over directions to the observer, azimuths of the spin axis and time",
        lines,
    })
}
