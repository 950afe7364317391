//! The strain of a pulsar as equally spaced series, in the two-column format of programs that read strain.

use std::fmt::Write;

use twofold::Error;
use twofold::dynamics::{AxisState, RotationState};
use twofold::epoch::Epoch;
use twofold::observables::gravitational_wave::Polarizations;

use super::PulsarScene;
use crate::wave::spheroid_wave;

/// The start, the sampling rate and the number of samples of a series.
#[derive(Debug, Clone, Copy)]
pub struct Series {
    /// Time of the first sample.
    pub start: Epoch,
    /// Samples per second.
    pub rate: f64,
    /// Number of samples.
    pub samples: usize,
}

impl PulsarScene {
    /// The wave of a state at the observer, at the scene's distance.
    pub fn wave(&self, state: &AxisState<f64>) -> Option<Polarizations<f64>> {
        Some(spheroid_wave(
            self.problem.spheroid(),
            self.problem.coefficients(),
            state,
            &self.observer,
            self.strain_unit?,
        ))
    }
}

/// Texts of `h_+` and `h_x`: a line for each sample, with seconds from the start and strain. `None` if the scene has no
/// distance.
///
/// # Errors
/// As for [`PulsarClock::near`](twofold::observables::pulsar::PulsarClock::near).
pub fn strain_series(pulsar: &PulsarScene, series: &Series) -> Result<Option<[String; 2]>, Error> {
    let header = |name: &str| format!("# {name} [1] against time [s] from MJD {} (TDB, barycentre)\n", series.start);
    let mut texts = ["h_plus", "h_cross"].map(header);
    let state = pulsar.clock.near(series.start.seconds_since(&pulsar.epoch));
    for k in 0..series.samples {
        let time = k as f64 / series.rate;
        let Some(wave) = pulsar.wave(&state(time)?.axis_state()) else { return Ok(None) };
        for (text, h) in texts.iter_mut().zip([wave.plus, wave.cross]) {
            writeln!(text, "{time:?} {h:?}").expect("writing to a string succeeds");
        }
    }
    Ok(Some(texts))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{scene, timed};
    use super::*;

    /// If one of two series begins a second later, both have the same lines from there on.
    #[test]
    fn a_series_begins_at_its_start() {
        let (pulsar, _) = timed(&scene("[0.0, 0.0, 0.0]"), &[0.0, 1e5]);
        let values = |start, samples| -> Vec<(f64, f64)> {
            let series = Series { start: pulsar.epoch.after([start, 0.0]).unwrap(), rate: 4.0, samples };
            let [plus, _] = strain_series(&pulsar, &series).unwrap().unwrap();
            let number = |text: Option<&str>| text.unwrap().parse().unwrap();
            let line = |line: &str| (number(line.split(' ').next()), number(line.split(' ').nth(1)));
            plus.lines().skip(1).map(line).collect()
        };
        let (early, late) = (values(0.0, 8), values(1.0, 4));
        assert_eq!(early.iter().map(|line| line.0).collect::<Vec<_>>(), [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75]);
        let largest = early.iter().fold(0.0, |largest: f64, line| largest.max(line.1.abs()));
        for (early, late) in early[4..].iter().zip(&late) {
            // Roundings of phases of some 30 rad.
            assert!((early.1 - late.1).abs() < 1e-13 * largest && early.0 == late.0 + 1.0, "{early:?} {late:?}");
        }
        assert_eq!(late.len(), 4);
    }
}
