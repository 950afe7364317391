//! Whether the width series is a function of gamma, as is the width at constant rates. Eq. (56).

use super::cases::{Case, mean_rates, paper_signal};
use crate::prelude::*;
use crate::pulse_series::pulse_series;

/// Length of the series, t_c.
const SPAN: f64 = 400.0;

checks! {
    /// the width (56) fails for tp-II with any constants: a function of the mean phase of gamma, as it is at constant rates, leaves most of the
    /// width series, which also has the slow period of the angular momentum, but little of that of tp-I
    Regime "width-series-not-of-gamma-tp-2" [56]: functions_of_gamma;
    AtMost(1.0) "what the harmonics of the mean phase up to the sixth leave of the widths: the larger of 0.75 / tp-II and tp-I / 0.25";
    because "most is three quarters of the modulation of tp-II, little a quarter of that of tp-I";
}

fn functions_of_gamma() -> Result<Measured, String> {
    let [[period_1, width_1], [period_2, width_2]] =
        [left_by_functions_of_gamma("tp-1")?, left_by_functions_of_gamma("tp-2")?];
    let detail = format!(
        "left of the widths of tp-I {width_1:.3}, of tp-II {width_2:.3}; of the periods {period_1:.3} and {period_2:.3}"
    );
    let figure = if width_2.is_finite() { largest([0.75 / width_2, width_1 / 0.25]) } else { f64::INFINITY };
    Ok(Measured::new(figure, detail))
}

/// The remainder of the period and the width series after the best sum of harmonics of the mean phase of gamma up to the sixth:
/// root mean square in units of that of the series from its mean.
fn left_by_functions_of_gamma(example: &str) -> Result<[f64; 2], String> {
    let Case { motion, beam, observer, .. } = paper_signal(example, SPAN)?;
    let series = pulse_series(&motion, &beam, &observer, (0.0, SPAN))?;
    let rate = mean_rates(&motion)?.gamma;
    let left = |series: &[Stamped]| -> Result<f64, String> {
        let functions = DMatrix::from_fn(series.len(), 13, |row, k| {
            let (sin, cos) = (k.div_ceil(2) as f64 * rate * series[row].time).sin_cos();
            if k % 2 == 0 { cos } else { sin }
        });
        let values = DVector::from_iterator(series.len(), series.iter().map(|point| point.value));
        let amplitudes = functions.clone().svd(true, true).solve(&values, 1e-12)?;
        let modulation = values.add_scalar(-values.mean());
        Ok((functions * amplitudes - values).norm() / modulation.norm())
    };
    Ok([left(&series.periods)?, left(&series.lengths)?])
}
