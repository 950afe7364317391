//! Whether the pulse series are functions of gamma, as the approximate period and width are. Eqs. (51), (52), (56).

use nalgebra::{DMatrix, DVector};
use twofold::observables::pulsar::Stamped;
use twofold::propagation::{ContinuousAngles, Motion};

use super::approximations::smallest;
use super::cases::{Signal, paper_signal};
use crate::check::{Bound, Check, Kind, Measured, largest};
use crate::pulse_series::pulse_series;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "pulse-series-not-of-gamma-tp-2",
            kind: Kind::Regime,
            equations: &[51, 52, 56],
            statement: "they fail for any choice of their constants: a function of gamma, as they are, leaves most of the series of tp-II, which have the \
                 slow period of the angular momentum as well, but little of those of tp-I",
            figure: "what the harmonics of gamma up to the sixth leave: least of tp-II / most of tp-I",
            bound: Bound::AtLeast(3.0),
            reason: "four fifths of the modulation of tp-II is most, a quarter of that of tp-I little",
            measure: functions_of_gamma,
        },
    ]
}

fn functions_of_gamma() -> Result<Measured, String> {
    let (tp_1, tp_2) = (left_by_functions_of_gamma("tp-1")?, left_by_functions_of_gamma("tp-2")?);
    let detail = format!("left of the periods and widths of tp-I {tp_1:.3?}, of tp-II {tp_2:.3?}");
    Ok(Measured::new(smallest(tp_2) / largest(tp_1), detail))
}

/// What the best sum of harmonics of gamma up to the sixth leaves of the period and the width series, root mean square in
/// units of that of the series from its mean.
fn left_by_functions_of_gamma(example: &str) -> Result<[f64; 2], String> {
    let message = |e: twofold::Error| e.to_string();
    let Signal { motion, beam, observer } = paper_signal(example).map_err(message)?;
    let series = pulse_series(&motion, &beam, &observer, (0.0, 400.0)).map_err(message)?;
    let start = motion.state(0.0).and_then(|state| state.angles()).map_err(message)?;
    let mut angles = ContinuousAngles::new(&motion, 0.0, &start).map_err(message)?;
    let mut left = |series: Vec<Stamped>| -> Result<f64, String> {
        let mut functions = DMatrix::zeros(series.len(), 13);
        for (row, point) in series.iter().enumerate() {
            let gamma = angles.at(point.time).map_err(message)?.gamma;
            for (k, value) in functions.row_mut(row).iter_mut().enumerate() {
                let (sin, cos) = (k.div_ceil(2) as f64 * gamma).sin_cos();
                *value = if k % 2 == 0 { cos } else { sin };
            }
        }
        let values = DVector::from_iterator(series.len(), series.iter().map(|point| point.value));
        let amplitudes = functions.clone().svd(true, true).solve(&values, 1e-12)?;
        let modulation = values.add_scalar(-values.mean());
        Ok((functions * amplitudes - values).norm() / modulation.norm())
    };
    Ok([left(series.periods)?, left(series.lengths)?])
}
