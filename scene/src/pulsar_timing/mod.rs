//! A scene's pulsar over decades: arrival times at given epochs, what they are late by against a constant frequency, and the files that
//! timing programs and readers of strain take. See `docs/pulsars.md`.

mod causes;
mod decimal;
mod no_pulse;
mod parameters;
mod strain;
mod table;

use std::collections::HashSet;
use std::f64::consts::TAU;

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::epoch::{DAY, Epoch};
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::strain_unit;
use twofold::observables::pulsar::{Beam, ClockPulse, PulsarClock, SpinFit};
use twofold::propagation::PhasedMotion;

use crate::scene_file::Scene;

pub use causes::Causes;
pub use decimal::decimal;
pub use no_pulse::TimingError;
pub use parameters::{par, tim};
pub use strain::{Series, strain_series};
pub use table::csv;

/// Rounding of an arrival time, 1e-16 d (s).
const ARRIVAL_ROUNDING: f64 = 1e-16 * DAY;

/// A scene with all that its pulses need, in seconds.
#[derive(Debug, Clone)]
pub struct PulsarScene {
    /// The scene's problem with `I^xx = 1`, `C` in 1/s^2 and `L` in 1/s; the state is that at the epoch, and the bulge as in the scene.
    pub problem: Problem<f64>,
    /// Direction to the observer.
    pub observer: Observer<f64>,
    /// The beam.
    pub beam: Beam<f64>,
    /// The pulses.
    pub clock: PulsarClock,
    /// Modified Julian date of the state, TDB at the barycentre.
    pub epoch: Epoch,
    /// The strain of `h = 1` in units of `I^xx / s^2`, if the scene has a distance.
    pub strain_unit: Option<f64>,
}

impl PulsarScene {
    /// Of a scene.
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
        let (spheroid, initial) = (scene.problem.spheroid(), scene.problem.initial());
        let spheroid = RigidSpheroid { constant_c: spheroid.constant_c / (t_c * t_c), ..*spheroid };
        let initial = BodyState { momentum: initial.momentum / t_c, ..*initial };
        if initial.momentum == Vector3::zeros() {
            return Err("the star does not rotate (its angular momentum is zero) and sends no pulses: allowed is a `star.spin_frequency` \
                        other than zero, or an [initial] with rates"
                .into());
        }
        let observer = viewer.basis();
        let problem = Problem::new(spheroid, *scene.problem.coefficients(), initial)?;
        let problem = problem.with_bulge(scene.problem.bulge())?;
        let motion = PhasedMotion::new(&problem, scene.times.last() - scene.times.start())?;
        let clock = PulsarClock::on(motion, &beam, &observer)?;
        let clock = match &scene.spin_down {
            Some(spin_down) => {
                let braking = spin_down.braking(1.0 / clock.period())?;
                let in_section = |error| format!("[spin_down]: {error}");
                let braked = clock.braked(&braking).map_err(in_section)?;
                match spin_down.damping_time {
                    Some(time) => braked.damped(1.0 / time).map_err(in_section)?,
                    None => braked,
                }
            }
            None => clock,
        };
        Ok(Self {
            problem,
            observer,
            beam,
            clock,
            epoch,
            strain_unit: viewer.distance.map(|distance| strain_unit(scene.units.inertia_in_si(), 1.0, distance)),
        })
    }

    /// Estimated error (s) of the residuals of a pulse at the time `t` (s, from the epoch) after `F0` is fitted: what the motion leaves out (the averaged one
    /// by its order, the series on the torus by its length), the rounding of directions, and that of an arrival time to 1e-16 d.
    pub fn residual_error(&self, t: f64) -> f64 {
        let motion = self.clock.motion();
        let per_radian = self.clock.period().abs() / TAU;
        // The rounding of rates is linear in time, but for the slow ones, whose share is 1e-15 of a residual.
        ARRIVAL_ROUNDING.max(self.clock.truncation(t).abs() + motion.rounding(0.0) * per_radian)
    }

    /// Estimated error (s) of an arrival time at the time `t` (s, from the epoch) for the numbers that the scene states. Beside that of a residual
    /// it has what is linear in time: the rounding of the rotation rate, which a fitted `F0` takes up.
    ///
    /// The initial angular momentum is held in doubles. From `spin_frequency` to `|L|` ten roundings of at most `2^-53` may add up: `2 pi`, two
    /// products of it, four of the rate about the axis and of the axis, a sum, the moment of inertia, the unit of time.
    pub fn arrival_error(&self, t: f64) -> f64 {
        const ROUNDINGS: f64 = 10.0;
        let per_radian = self.clock.period().abs() / TAU;
        let of_motion = self.clock.motion().error_estimate(t) * per_radian;
        self.residual_error(t).max(of_motion) + ROUNDINGS * f64::EPSILON / 2.0 * t.abs()
    }

    /// The pulses nearest to given epochs, and their fit of F0 and so many derivatives. Epochs of dark turns have none.
    ///
    /// # Errors
    /// No pulse at any epoch, with the closest approach; and as for [`PulsarClock::pulse_near`] and [`SpinFit::new`].
    pub fn timed(&self, epochs: &[Epoch], derivatives: usize) -> Result<Timing, TimingError> {
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
        if pulses.is_empty() {
            return Err(no_pulse::no_pulse(self, epochs));
        }
        let middle = epochs.iter().map(|at| at.day() as f64).sum::<f64>() / epochs.len() as f64;
        // It may be later than a date that is written.
        let epoch = Epoch::new(0, 0.0)?.after([middle.round() * DAY, 0.0])?;
        let points: Vec<_> =
            pulses.iter().map(|timed| (timed.pulse.number, timed.arrival.seconds_since(&epoch))).collect();
        Ok(Timing { dark, fit: SpinFit::new(&points, derivatives)?, derivatives, epoch, pulses })
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
    /// How many derivatives of the frequency are fitted.
    pub derivatives: usize,
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
