//! A scene's pulsar over decades: arrival times at given epochs, what they are late by against a constant frequency, and the files that
//! timing programs and readers of strain take. See `docs/pulsars.md`.

mod decimal;
mod parameters;
mod strain;
mod table;

use std::collections::HashSet;

use nalgebra::Matrix3;
use twofold::Error;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::epoch::{DAY, Epoch};
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::strain_unit;
use twofold::observables::pulsar::{ClockPulse, PulsarClock, SpinFit};
use twofold::solutions::mean::MeanOrder;

use crate::scene_file::Scene;

pub use parameters::{par, tim};
pub use strain::{Series, strain_series};
pub use table::csv;

/// A scene with all that its pulses need, in seconds.
#[derive(Debug, Clone)]
pub struct PulsarScene {
    /// `I^xx = 1`, `C` in 1/s^2.
    pub spheroid: RigidSpheroid<f64>,
    /// `s^IJ` in the frame of the scene.
    pub violation: Matrix3<f64>,
    /// State at the epoch, `L` in 1/s.
    pub initial: BodyState<f64>,
    /// Who looks on.
    pub observer: Observer<f64>,
    /// The pulses.
    pub clock: PulsarClock,
    /// Modified Julian date of the state, TDB at the barycentre.
    pub epoch: Epoch,
    /// The strain of `h = 1` in units of `I^xx / s^2`, if the scene has a distance.
    pub strain_unit: Option<f64>,
}

impl PulsarScene {
    /// Of a scene.
    ///
    /// # Errors
    /// A sentence about what the scene lacks, or why the mean motion does not hold for it.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        let lacks =
            |what: &str| format!("the scene lacks {what}, without which it has no arrival times (docs/pulsars.md)");
        if !scene.units.are_physical() {
            return Err("the scene is in the paper's units: arrival times need a physical star (`star.mass`)".into());
        }
        let epoch = scene.epoch.ok_or_else(|| lacks("`time.epoch`"))?;
        let viewer = scene.observer.ok_or_else(|| lacks("the section [observer]"))?;
        let beam = scene.pulsar.ok_or_else(|| lacks("the section [pulsar]"))?.beam();
        let t_c = scene.units.time;
        let spheroid = RigidSpheroid { constant_c: scene.spheroid.constant_c / (t_c * t_c), ..scene.spheroid };
        let initial = BodyState { momentum: scene.initial.momentum / t_c, ..scene.initial };
        let observer = viewer.basis();
        let clock = PulsarClock::new(&spheroid, &scene.violation, &initial, &beam, &observer, MeanOrder::Second)
            .map_err(|why| format!("the scene has no mean motion: {why}"))?;
        let inertia = scene.units.momentum * t_c * 1e-7;
        Ok(Self {
            spheroid,
            violation: scene.violation,
            initial,
            observer,
            clock,
            epoch,
            strain_unit: viewer.distance.map(|distance| strain_unit(inertia, 1.0, distance)),
        })
    }

    /// The pulses nearest to given epochs, and their fit. Epochs of dark turns have none.
    ///
    /// # Errors
    /// As for [`PulsarClock::pulse_near`] and [`SpinFit::new`].
    pub fn timed(&mut self, epochs: &[Epoch], with_rate: bool) -> Result<Timing, Error> {
        let mut pulses = Vec::with_capacity(epochs.len());
        let (mut seen, mut dark) = (HashSet::new(), 0);
        for at in epochs {
            match self.clock.pulse_near(at.seconds_since(&self.epoch))? {
                // Epochs nearer than a turn have one pulse between them.
                Some(pulse) if seen.insert(pulse.number) => {
                    pulses.push(TimedPulse { arrival: self.epoch.after(pulse.midpoint)?, pulse });
                }
                Some(_) => {}
                None => dark += 1,
            }
        }
        let shines = pulses.len() as f64;
        Error::unless(
            shines > 0.0,
            "number of epochs at which the beam passes the line of sight",
            shines,
            "above zero",
        )?;
        let middle = epochs.iter().map(|at| at.day() as f64).sum::<f64>() / epochs.len() as f64;
        // It may be later than a date that is written.
        let epoch = Epoch::new(0, 0.0)?.after([middle.round() * DAY, 0.0])?;
        let points: Vec<_> =
            pulses.iter().map(|timed| (timed.pulse.number, timed.arrival.seconds_since(&epoch))).collect();
        Ok(Timing { dark, fit: SpinFit::new(&points, with_rate)?, with_rate, epoch, pulses })
    }
}

/// A pulse and when it arrives.
#[derive(Debug, Clone, Copy)]
pub struct TimedPulse {
    /// Midpoint of the pulse, rounded to 1e-16 day.
    pub arrival: Epoch,
    /// The pulse.
    pub pulse: ClockPulse,
}

/// Arrival times and what they are late by.
#[derive(Debug, Clone)]
pub struct Timing {
    /// The pulses, in the order of the epochs asked.
    pub pulses: Vec<TimedPulse>,
    /// Epochs without a pulse.
    pub dark: usize,
    /// Frequency (Hz), at [`epoch`](Self::epoch), and residuals (s).
    pub fit: SpinFit,
    /// Whether `F1` is fitted.
    pub with_rate: bool,
    /// `PEPOCH`: a whole day in the middle.
    pub epoch: Epoch,
}

impl Timing {
    /// Root mean square of the residuals (s).
    pub fn root_mean_square(&self) -> f64 {
        let residuals = &self.fit.residuals;
        (residuals.iter().map(|residual| residual * residual).sum::<f64>() / residuals.len() as f64).sqrt()
    }
}
