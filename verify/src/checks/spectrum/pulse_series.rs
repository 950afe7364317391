//! Periods in the series of pulse periods and widths.

use std::f64::consts::TAU;

use twofold::observables::pulsar::Stamped;
use twofold::observables::spectrum::Window;

use super::signals::{Example, beam, examples, line_of_sight};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::pulse_series::PulseSeries;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "period-series-40",
            kind: Kind::Oracle,
            equations: &[51, 57],
            statement: "the series of pulse periods and widths of tp-I and tp-II have a period of about 40 t_c, that of gamma",
            figure: "largest |2 pi / w - 40|, w between 0.1 and 0.2 / t_c the frequency whose multiples have most power [t_c]; infinite unless w is the rate of gamma",
            bound: Bound::AtMost(5.0),
            reason: "'about 40' read as 35 to 45",
            measure: period_of_gamma,
        },
        Check {
            id: "period-series-180",
            kind: Kind::Oracle,
            equations: &[51, 57],
            statement: "those of tp-II have a period of about 180 t_c too, that of the slow precession",
            figure: "largest |2 pi / w - 180| of the highest peak between 0.025 and 0.045 / t_c [t_c]; infinite unless w is the slow frequency and the peak a fifth of the highest",
            bound: Bound::AtMost(10.0),
            reason: "'about 180' read as 170 to 190",
            measure: period_of_slow_precession,
        },
    ]
}

fn message(e: twofold::Error) -> String {
    e.to_string()
}

/// Period of gamma in the series of both examples: that whose first four multiples together have most power.
fn period_of_gamma() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for example in examples()? {
        for (name, values) in series(example)? {
            let spectrum = StampedSpectrum::of(&values)?;
            let power = |w: f64| (1..=4).map(|k| spectrum.amplitude(w * f64::from(k)).powi(2)).sum::<f64>();
            let w = highest(0.1..0.2, power)?;
            let rate = example.frequencies.gamma.ok_or("gamma has no mean rate")?.value;
            let figure = if (w - rate.abs()).abs() < GRID { (TAU / w - 40.0).abs() } else { f64::INFINITY };
            worst.see(figure, || {
                let multiples = [1.0, 2.0, 3.0, 4.0].map(|k| format!("{:.3}", spectrum.amplitude(k * w))).join(", ");
                format!("{} {name}: {:.1} t_c, amplitudes of the multiples {multiples} t_c", example.name, TAU / w)
            });
        }
    }
    worst.finish()
}

/// Period of the slow precession in the series of tp-II.
fn period_of_slow_precession() -> Result<Measured, String> {
    let example = &examples()?[1];
    let slow = example.frequencies.slow.ok_or("no slow precession")?.value;
    let (mut differences, mut details) = (Vec::new(), Vec::new());
    for (name, values) in series(example)? {
        let spectrum = StampedSpectrum::of(&values)?;
        let w = highest(0.025..0.045, |w| spectrum.amplitude(w))?;
        let strongest = spectrum.amplitude(highest(0.01..0.7, |w| spectrum.amplitude(w))?);
        let share = spectrum.amplitude(w) / strongest;
        let seen = (w - slow.abs()).abs() < GRID && share > 0.2;
        differences.push(if seen { (TAU / w - 180.0).abs() } else { f64::INFINITY });
        details.push(format!("{name}: {:.1} t_c, {share:.2} of the highest peak", TAU / w));
    }
    Ok(Measured::new(largest(differences), details.join("; ")))
}

/// The frequency of a grid at which a function is largest.
fn highest(range: std::ops::Range<f64>, function: impl Fn(f64) -> f64) -> Result<f64, String> {
    let count = ((range.end - range.start) / GRID) as usize;
    let points = (0..=count).map(|i| range.start + GRID * i as f64).map(|w| (w, function(w)));
    points.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(w, _)| w).ok_or_else(|| "no frequency".into())
}

/// The series of an example, without intervals over turns that have no pulse.
fn series(example: &Example) -> Result<[(&'static str, Vec<Stamped>); 2], String> {
    let PulseSeries { periods, lengths, .. } =
        crate::pulse_series::pulse_series(&example.motion, &beam(), &line_of_sight(), (0.0, SERIES)).map_err(message)?;
    Ok([("periods", periods), ("widths", lengths)])
}

/// Distance of two frequencies of a scan [1/t_c]: a quarter of the resolution of the series.
const GRID: f64 = 0.0005;

/// Length of the series [t_c].
const SERIES: f64 = 3000.0;

/// Amplitudes of a stamped series, tapered: in tp-II some turns have no pulse and some pulses merge, so that its series is not in equal
/// steps of anything and has no fast transform.
struct StampedSpectrum {
    /// Time and weighted value.
    points: Vec<(f64, f64)>,
}

impl StampedSpectrum {
    fn of(values: &[Stamped]) -> Result<Self, String> {
        let count = 4096;
        let taper = Window::Kaiser { shape: 8.0 }.weights(count).map_err(message)?;
        let weight = |point: &Stamped| taper[((point.time / SERIES * count as f64) as usize).min(count - 1)];
        let total: f64 = values.iter().map(weight).sum();
        let mean = values.iter().map(|point| weight(point) * point.value).sum::<f64>() / total;
        let points = values.iter().map(|point| (point.time, weight(point) * (point.value - mean) * 2.0 / total));
        Ok(Self { points: points.collect() })
    }

    fn amplitude(&self, w: f64) -> f64 {
        let (sin, cos) = self.points.iter().fold((0.0, 0.0), |(sin, cos), (time, value)| {
            let (s, c) = (w * time).sin_cos();
            (sin + value * s, cos + value * c)
        });
        sin.hypot(cos)
    }
}
