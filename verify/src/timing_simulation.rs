//! Simulated arrival times and widths of random pulsars over decades.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use twofold::inference::{MeasuredArrival, MeasuredWidth, TimingData, timing_fisher, timing_nonlinearity};
use twofold::observables::pulsar::timing_model::TimingModel;
use twofold::observables::pulsar::timing_model::TimingParameter::{self, *};
use twofold_scene::measurements::{add_timing_noise, beside};

use crate::prelude::*;
use crate::simulation::LINEAR;

/// A year (s).
pub(crate) const YEAR: f64 = 3.155_76e7;

/// Data of a random pulsar.
#[derive(Debug, Clone)]
pub struct TimingSimulation {
    /// The truth.
    pub truth: TimingModel,
    /// Start of the fit: the truth plus a draw of three times the standard deviations.
    pub start: TimingModel,
    /// Data with errors.
    pub data: TimingData,
    /// Number of stars rejected before this one.
    pub refused: usize,
}

/// The unknowns of the fit.
pub const UNKNOWNS: [TimingParameter; 9] =
    [Phase, F0, F1, F2, Wobble, PrecessionPhase, PrecessionRate, TorqueShare, Rho];

/// Largest number of stars drawn for one measurement.
const MOST_DRAWN: usize = 100;

/// Arrivals of a model, equally spaced over a span (s).
pub(crate) fn arrivals_of(
    model: &TimingModel,
    count: u32,
    span: f64,
    sigma: f64,
) -> Result<Vec<MeasuredArrival>, twofold::Error> {
    let arrival = |k: u32| {
        let number = model.phase([(f64::from(k) / f64::from(count) - 0.5) * span, 0.0])?.whole;
        Ok(MeasuredArrival { time: model.arrival(number)?, sigma, number: Some(number) })
    };
    (0..count).map(arrival).collect()
}

/// The widths of the pulses at these arrivals.
pub(crate) fn widths_of(
    model: &TimingModel,
    arrivals: &[MeasuredArrival],
    sigma: f64,
) -> Result<Vec<MeasuredWidth>, twofold::Error> {
    let width = |arrival: &MeasuredArrival| {
        let time = arrival.time[0];
        Ok(MeasuredWidth { time, duration: model.width(time)?, sigma })
    };
    arrivals.iter().map(width).collect()
}

impl TimingSimulation {
    /// Simulation `seed`: a wobbling star under a braking torque, 100 to 300 arrivals and widths over 10 to 20 years. Stars are drawn until the error
    /// bars of one are linear. The errors are drawn afterwards and decide nothing.
    ///
    /// # Errors
    /// None of a hundred stars.
    pub fn new(seed: u64) -> Result<Self, InferenceError> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for refused in 0..MOST_DRAWN {
            let (truth, mut data) = random_star(&mut random)?;
            let fisher = timing_fisher(&truth, &data, &UNKNOWNS)?;
            if fisher.clone().determined().is_err() || timing_nonlinearity(&fisher, &data)? > LINEAR {
                continue;
            }
            add_timing_noise(&mut data, &mut random);
            let start = beside(&fisher, 3.0, &mut random)?;
            return Ok(Self { truth, start, data, refused });
        }
        Err(twofold::Error::not_found("draw of a star whose error bars are linear").into())
    }
}

fn random_star(random: &mut ChaCha8Rng) -> Result<(TimingModel, TimingData), twofold::Error> {
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
    // The torque is seen to a hundredth: the delay is about kappa / w^2.
    let late = (f1 / frequency).abs() * (period / TAU).powi(2) * 0.1;
    let sigma = late.min(0.1 / frequency) * 10.0_f64.powf(within(-3.0, -2.0));
    let truth = TimingModel::new([frequency, 1e-17 * frequency], &parameters)?;
    let arrivals = arrivals_of(&truth, count, span, sigma)?;
    let widths = widths_of(&truth, &arrivals, 3e-4 / frequency)?;
    Ok((truth, TimingData { arrivals, widths, priors: Vec::new() }))
}
