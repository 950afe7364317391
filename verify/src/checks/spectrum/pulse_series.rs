//! Periods in the series of pulse periods and widths.

use super::signals::{Example, beam, examples, line_of_sight, motion_of};
use crate::prelude::*;
use crate::pulse_series::PulseSeries;

checks! {
    /// the series of pulse periods and widths of tp-I and tp-II have a period of about 40 t_c, that of gamma
    Oracle "period-series-40" [51, 57]: period_of_gamma;
    AtMost(5.0) "largest |2 pi / w - 40|, w between 0.1 and 0.2 / t_c the frequency whose first four multiples fit best [t_c]; infinite unless w is \
     the rate of gamma";
    because "'about 40' read as 35 to 45";
    /// those of tp-II have a period of about 180 t_c too, that of the slow precession
    Oracle "period-series-180" [51, 57]: period_of_slow_precession;
    AtMost(10.0) "largest |2 pi / w - 180|, w between 0.025 and 0.045 / t_c the frequency that fits best beside six multiples of gamma's [t_c]; \
     infinite unless w is the slow frequency and its amplitude half of the largest";
    because "'about 180' read as 170 to 190";
}

/// Period of gamma in the series of both examples: the one whose first four multiples fit best.
fn period_of_gamma() -> Result<Measured, String> {
    worst_of(examples()?, |example| {
        let rate = example.rate("gamma'")?;
        largest_of(series(example)?.map(|(_, values)| {
            let w = highest(0.1..0.2, |w| explained(&values, &multiples(w, 4)))?;
            Ok(if (w - rate.abs()).abs() < GRID { (TAU / w - 40.0).abs() } else { f64::INFINITY })
        }))
    })
}

/// Period of the slow precession in the series of tp-II.
fn period_of_slow_precession() -> Result<Measured, String> {
    let example = &examples()?[1];
    let slow = example.rate("l'")?;
    let gamma = multiples(example.rate("gamma'")?, 6);
    let (mut differences, mut details) = (Vec::new(), Vec::new());
    for (name, values) in series(example)? {
        let of_gamma = explained(&values, &gamma);
        // Variance explained by a frequency besides the multiples of gamma's: zero if it is one of them, as the columns are then dependent.
        let added = |w: f64| {
            let beside = gamma.iter().all(|g| (w - g.abs()).abs() > 4.0 * GRID);
            if beside { explained(&values, &[&gamma[..], &[w]].concat()) - of_gamma } else { 0.0 }
        };
        let w = highest(0.025..0.045, added)?;
        let strongest = added(highest(0.01..0.7, added)?);
        let share = (added(w) / strongest).sqrt();
        let seen = (w - slow.abs()).abs() < GRID && share > 0.5;
        differences.push(if seen { (TAU / w - 180.0).abs() } else { f64::INFINITY });
        let part = added(w) / (1.0 - of_gamma);
        details.push(format!(
            "{name}: {:.1} t_c, {share:.2} of the largest amplitude, {part:.2} of the variance that gamma leaves",
            TAU / w
        ));
    }
    Ok(Measured::new(largest(differences), details.join("; ")))
}

fn multiples(w: f64, count: u8) -> Vec<f64> {
    (1..=count).map(|k| w * f64::from(k)).collect()
}

/// The frequency of a grid at which a function is largest.
fn highest(range: std::ops::Range<f64>, function: impl Fn(f64) -> f64) -> Result<f64, String> {
    let count = ((range.end - range.start) / GRID) as usize;
    let points = (0..=count).map(|i| range.start + GRID * i as f64).map(|w| (w, function(w)));
    points.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(w, _)| w).ok_or_else(|| "no frequency".into())
}

/// The series of an example, without intervals over turns that have no pulse.
fn series(example: &Example) -> Result<[(&'static str, Vec<Stamped>); 2], String> {
    let motion = motion_of(example.scene, SERIES)?;
    let PulseSeries { periods, lengths, .. } =
        crate::pulse_series::pulse_series(&motion, &beam(), &line_of_sight(), (0.0, SERIES))?;
    Ok([("periods", periods), ("widths", lengths)])
}

/// Distance of two frequencies of a scan [1/t_c]: a quarter of the resolution of the series.
const GRID: f64 = 0.0005;

/// Length of the series [t_c].
const SERIES: f64 = 3000.0;

/// Share of the variance of a series explained by a least-squares fit of a constant and waves of the given frequencies.
///
/// A Fourier sum would be wrong: in tp-II many turns have no pulse, always at the same phases of its motion, so that the times are not
/// equally spaced and the waves not orthogonal on them. NaN if the waves are dependent.
fn explained(values: &[Stamped], frequencies: &[f64]) -> f64 {
    let waves = DMatrix::from_fn(values.len(), 1 + 2 * frequencies.len(), |row, column| {
        let phase = column.checked_sub(1).map_or(0.0, |i| frequencies[i / 2] * values[row].time);
        if column % 2 == 0 && column > 0 { phase.sin() } else { phase.cos() }
    });
    let values = DVector::from_iterator(values.len(), values.iter().map(|point| point.value));
    let transposed = waves.transpose();
    let Some(cholesky) = (&transposed * &waves).cholesky() else { return f64::NAN };
    let left = (&waves * cholesky.solve(&(transposed * &values)) - &values).norm_squared();
    1.0 - left / values.add_scalar(-values.mean()).norm_squared()
}
