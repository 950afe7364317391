//! The strain of a pulsar as series in equal steps, in the two columns that readers of strain take.

use std::fmt::Write;

use twofold::Error;
use twofold::dynamics::AxisState;
use twofold::epoch::Epoch;
use twofold::observables::gravitational_wave::Polarizations;

use super::PulsarScene;
use crate::wave::spheroid_wave;

/// When a series begins, its steps and how many.
#[derive(Debug, Clone, Copy)]
pub struct Series {
    /// Time of the first sample.
    pub start: Epoch,
    /// Samples in a second.
    pub rate: f64,
    /// Number of samples.
    pub samples: usize,
}

impl PulsarScene {
    /// The wave at the observer, at the scene's distance, of a state.
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

/// Texts of `h_+` and `h_x`: a line for each sample, seconds from the start and strain. Nothing if the scene has no distance.
///
/// # Errors
/// As for [`PulsarClock::near`](twofold::observables::pulsar::PulsarClock::near).
pub fn strain_series(pulsar: &PulsarScene, series: &Series) -> Result<Option<[String; 2]>, Error> {
    let header = |name: &str| format!("# {name} [1] against time [s] from MJD {} (TDB, barycentre)\n", series.start);
    let mut texts = ["h_plus", "h_cross"].map(header);
    let state = pulsar.clock.near(series.start.seconds_since(&pulsar.epoch));
    for k in 0..series.samples {
        let time = k as f64 / series.rate;
        let Some(wave) = pulsar.wave(&AxisState::from(&state(time)?)) else { return Ok(None) };
        for (text, h) in texts.iter_mut().zip([wave.plus, wave.cross]) {
            writeln!(text, "{time:?} {h:?}").expect("writing to a string succeeds");
        }
    }
    Ok(Some(texts))
}
