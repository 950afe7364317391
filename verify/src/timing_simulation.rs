//! Simulated arrival times and widths of random pulsars over decades.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use twofold::inference::{Arrival, TimingData, Width, timing_fisher};
use twofold::timing_model::{TimingModel, TimingParameter};
use twofold_scene::measurements::{add_timing_noise, beside};

use crate::prelude::*;

/// A year (s).
pub(crate) const YEAR: f64 = 3.155_76e7;

/// Data of a random pulsar.
#[derive(Debug, Clone)]
pub struct TimingSimulation {
    /// The truth.
    pub truth: TimingModel,
    /// Where the fit begins: beside the truth by a draw of three times the standard deviations.
    pub start: TimingModel,
    /// Data with errors.
    pub data: TimingData,
    /// What is fitted.
    pub unknowns: Vec<TimingParameter>,
}

/// Arrivals of a model, equally apart over a span (s).
pub(crate) fn arrivals_of(
    model: &TimingModel,
    count: u32,
    span: f64,
    sigma: f64,
) -> Result<Vec<Arrival>, twofold::Error> {
    let arrival = |k: u32| {
        let number = model.phase([(f64::from(k) / f64::from(count) - 0.5) * span, 0.0])?.turns;
        Ok(Arrival { time: model.arrival(number)?, sigma, number: Some(number) })
    };
    (0..count).map(arrival).collect()
}

/// The widths of pulses that arrive then.
pub(crate) fn widths_of(model: &TimingModel, arrivals: &[Arrival], sigma: f64) -> Result<Vec<Width>, twofold::Error> {
    let width = |arrival: &Arrival| {
        let time = arrival.time[0];
        Ok(Width { time, duration: model.width(time)?, sigma })
    };
    arrivals.iter().map(width).collect()
}

impl TimingSimulation {
    /// The simulation with a number: a wobbling star that is braked by a torque, 100 to 300 arrivals and widths over 10 to 20 years.
    ///
    /// # Errors
    /// Data that do not determine the star.
    pub fn new(seed: u64) -> Result<Self, InferenceError> {
        use TimingParameter::*;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut within = |from: f64, to: f64| random.random_range(from..to);
        let frequency = 10.0_f64.powf(within(0.0, 2.8));
        let f1 = -frequency * 10.0_f64.powf(within(-15.0, -13.0));
        let period = within(200.0, 900.0) * 86_400.0;
        let parameters = [
            (Phase, within(-0.4, 0.4)),
            (F1, f1),
            (F2, within(2.0, 4.0) * f1 * f1 / frequency),
            (Wobble, within(0.05, 0.15)),
            (Chi, within(0.9, 1.3)),
            (PrecessionPhase, within(-3.0, 3.0)),
            (PrecessionRate, TAU / period),
            (TorqueShare, within(0.3, 0.7)),
            (Inclination, within(0.9, 1.3)),
            (Rho, within(0.7, 0.8)),
        ];
        let (span, count) = (within(10.0, 20.0) * YEAR, within(100.0, 300.0) as u32);
        // So that the torque is seen to a hundredth: the lateness is some kappa / w^2.
        let late = (f1 / frequency).abs() * (period / TAU).powi(2) * 0.1;
        let sigma = late.min(0.1 / frequency) * 10.0_f64.powf(within(-3.0, -2.0));
        let truth = TimingModel::new([frequency, 1e-17 * frequency], &parameters)?;
        let arrivals = arrivals_of(&truth, count, span, sigma)?;
        let widths = widths_of(&truth, &arrivals, 3e-4 / frequency)?;
        let mut data = TimingData { arrivals, widths, priors: Vec::new() };
        let unknowns = vec![Phase, F0, F1, F2, Wobble, PrecessionPhase, PrecessionRate, TorqueShare, Rho];
        let fisher = timing_fisher(&truth, &data, &unknowns)?.determined()?;
        add_timing_noise(&mut data, &mut random);
        let start = beside(&fisher, 3.0, &mut random)?;
        Ok(Self { truth, start, data, unknowns })
    }
}
