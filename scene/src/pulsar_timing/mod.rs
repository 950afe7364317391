//! A scene's pulsar over decades: arrival times at given epochs, their residuals relative to a constant frequency, and the input files
//! of timing programs and of readers of strain. See `docs/pulsars.md`.

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

use crate::Refusal;
use crate::scene_file::Scene;

pub use causes::Causes;
pub use decimal::decimal;
pub use parameters::{par, tim};
pub use strain::{Series, strain_series};
pub use table::csv;

/// Rounding of an arrival time, 1e-16 d (s).
const ARRIVAL_ROUNDING: f64 = 1e-16 * DAY;

/// A scene with the data needed for its pulses, in seconds.
#[derive(Debug, Clone)]
pub struct PulsarScene {
    /// The scene's problem with `I^xx = 1`, `C` in 1/s^2 and `L` in 1/s; the state is that at the epoch, and the bulge is that of the
    /// scene.
    pub problem: Problem<f64>,
    /// Direction to the observer.
    pub observer: Observer<f64>,
    /// The beam.
    pub beam: Beam<f64>,
    /// The pulses.
    pub clock: PulsarClock,
    /// Modified Julian date of the state, TDB at the barycentre.
    pub epoch: Epoch,
    /// The strain that corresponds to `h = 1` in units of `I^xx / s^2`, if the scene has a distance.
    pub strain_unit: Option<f64>,
}

impl PulsarScene {
    /// The pulsar of a scene.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        let lacks =
            |what: &str| format!("the scene lacks {what}, without which it has no arrival times (docs/pulsars.md)");
        if !scene.units.are_physical() {
            return Err("the scene is in the paper's units; arrival times need a physical star (`star.mass`)".into());
        }
        let epoch = scene.epoch.ok_or_else(|| lacks("`time.epoch`"))?;
        let viewer = scene.observer.ok_or_else(|| lacks("the section [observer]"))?;
        let beam = scene.pulsar.ok_or_else(|| lacks("the section [pulsar]"))?.beam();
        let t_c = scene.units.time;
        let (spheroid, initial) = (scene.problem.spheroid(), scene.problem.initial());
        let spheroid = RigidSpheroid { constant_c: spheroid.constant_c / (t_c * t_c), ..*spheroid };
        let initial = BodyState { momentum: initial.momentum / t_c, ..*initial };
        if initial.momentum == Vector3::zeros() {
            return Err("the star does not rotate (its angular momentum is zero) and sends no pulses; use a `star.spin_frequency` \
                        other than zero, or an [initial] with rates"
                .into());
        }
        let observer = viewer.basis();
        let problem = Problem::new(spheroid, *scene.problem.coefficients(), initial)?;
        let problem = problem.with_bulge(scene.problem.bulge())?;
        let motion = PhasedMotion::new(&problem, scene.times.last() - scene.times.start())?;
        let clock = PulsarClock::new(motion, &beam, &observer)?;
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

    /// Estimated error (s) of the residual of a pulse at the time `t` (s, from the epoch) after `F0` is fitted: the truncation error of the motion
    /// (of the averaged one due to its order, of the series on the torus due to its length), the rounding of directions, and that of an arrival time
    /// to 1e-16 d.
    pub fn residual_error(&self, t: f64) -> f64 {
        let motion = self.clock.motion();
        let per_radian = self.clock.period() / TAU;
        // The rounding of rates is linear in time, except for the slow rates, whose contribution is 1e-15 of a residual.
        ARRIVAL_ROUNDING.max(self.clock.truncation(t) + motion.rounding(0.0) * per_radian)
    }

    /// Estimated error (s) of an arrival time at the time `t` (s, from the epoch), for the numbers given in the scene. In addition to the error of
    /// a residual it contains the part linear in time: the rounding of the rotation rate, which a fitted `F0` absorbs.
    ///
    /// The initial angular momentum is stored in doubles. From `spin_frequency` to `|L|` ten roundings of at most `2^-53` may add up: `2 pi`,
    /// two products with it, four for the rate about the axis and for the axis, a sum, the moment of inertia, and the unit of time.
    pub fn arrival_error(&self, t: f64) -> f64 {
        const ROUNDINGS: f64 = 10.0;
        let per_radian = self.clock.period() / TAU;
        let of_motion = self.clock.motion().error_estimate(t) * per_radian;
        self.residual_error(t).max(of_motion) + ROUNDINGS * f64::EPSILON / 2.0 * t.abs()
    }

    /// The pulses nearest to given epochs, and the fit of F0 and a number of derivatives to them. An epoch in a turn
    /// without a pulse has none.
    ///
    /// # Errors
    /// [`Refusal::Input`] if there is no pulse at any epoch (with the closest approach); [`Refusal::Model`] as for [`PulsarClock::pulse_near`] and
    /// [`SpinFit::new`].
    pub fn timed(&self, epochs: &[Epoch], derivatives: usize) -> Result<Timing, Refusal> {
        let mut pulses = Vec::with_capacity(epochs.len());
        let (mut seen, mut dark) = (HashSet::new(), 0);
        for at in epochs {
            match self.clock.pulse_near(at.seconds_since(&self.epoch))? {
                // Epochs less than a turn apart may share one pulse.
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
        // The middle may be later than the latest date that can be written.
        let epoch = Epoch::new(0, 0.0)?.after([middle.round() * DAY, 0.0])?;
        let points: Vec<_> =
            pulses.iter().map(|timed| (timed.pulse.number, timed.arrival.seconds_since(&epoch))).collect();
        let least = 2 + derivatives.min(2);
        if pulses.len() < least {
            let (found, unknowns) = (pulses.len(), ["F0", "F0 and F1", "F0, F1 and F2"][least - 2]);
            return Err(Refusal::Input(format!(
                "the number of different pulses at {} epochs is {found}: must be at least {least} for a fit of {unknowns}",
                epochs.len()
            )));
        }
        Ok(Timing { dark, fit: SpinFit::new(&points, derivatives)?, derivatives, epoch, pulses })
    }
}

/// A pulse and its arrival time.
#[derive(Debug, Clone, Copy)]
pub struct TimedPulse {
    /// Midpoint of the pulse, rounded to 1e-16 day.
    pub arrival: Epoch,
    /// The pulse.
    pub pulse: ClockPulse,
}

/// Arrival times and their residuals.
#[derive(Debug, Clone)]
pub struct Timing {
    /// The pulses, in the order of the requested epochs.
    pub pulses: Vec<TimedPulse>,
    /// Epochs without a pulse.
    pub dark: usize,
    /// Frequency (Hz), at [`epoch`](Self::epoch), and residuals (s).
    pub fit: SpinFit,
    /// Number of fitted derivatives of the frequency.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{Times, text_of};

    /// The isolated pulsar without braking, with eigenvalues of `s^IJ`.
    pub(super) fn scene(eigenvalues: &str) -> Scene {
        let text = text_of("isolated-pulsar").unwrap().replace("[0.0, 0.0, 0.0]", eigenvalues);
        let mut scene = Scene::from_toml("scene", &text).unwrap_or_else(|error| panic!("{error}"));
        scene.spin_down = None;
        scene
    }

    /// The pulses of a scene nearest to given times (s) since the epoch.
    pub(super) fn timed(scene: &Scene, times: &[f64]) -> (PulsarScene, Timing) {
        let pulsar = PulsarScene::new(scene).unwrap();
        let epochs: Vec<_> = times.iter().map(|time| pulsar.epoch.after([*time, 0.0]).unwrap()).collect();
        let timing = pulsar.timed(&epochs, 0).unwrap();
        (pulsar, timing)
    }

    #[test]
    fn more_than_two_derivatives_are_not_fitted() {
        let pulsar = PulsarScene::new(&scene("[0.0, 0.0, 0.0]")).unwrap();
        let epochs = [0.0, 1e6, 2e6, 3e6].map(|time| pulsar.epoch.after([time, 0.0]).unwrap());
        assert!(pulsar.timed(&epochs, 2).is_ok());
        let Err(Refusal::Model(why)) = pulsar.timed(&epochs, 3) else { panic!("three derivatives") };
        assert!(why.to_string().starts_with("number of derivatives = 3"), "{why}");
    }

    /// `C = I^xx / t_c^2`, and the strain in seconds follows from that in `t_c` with the square of it.
    #[test]
    fn a_scene_in_seconds_has_its_units() {
        let scene = scene("[0.0, 0.0, 0.0]");
        let (t_c, pulsar) = (scene.units.time, PulsarScene::new(&scene).unwrap());
        let body = pulsar.problem.spheroid();
        assert!((body.constant_c * t_c * t_c / body.inertia_xx - 1.0).abs() < 4.0 * f64::EPSILON);
        let strain = scene.strain_unit() * t_c * t_c;
        assert!((pulsar.strain_unit.unwrap() / strain - 1.0).abs() < 8.0 * f64::EPSILON);
    }

    /// For a span of zero length, however late, the rates are accurate only for its start.
    #[test]
    fn the_motion_is_good_for_the_span_of_the_scene() {
        for (start, grows) in [(1e9, true), (0.0, false)] {
            let mut scene = scene("[1e-5, 0.0, -3e-5]");
            scene.times = Times::Listed { start, times: vec![1e9] };
            let rounding = PulsarScene::new(&scene).unwrap().clock.motion().rounding(1e9);
            assert_eq!(rounding > 1e-9, grows, "{rounding:e}");
        }
    }

    /// A free star has no truncation error, only `1e-16 * 86400 s` and ten roundings of `2^-53` of the time, before and after. For a star that slows
    /// down the truncation error is a time; an angle error of directions shifts a pulse by the corresponding fraction of its turn.
    #[test]
    fn an_arrival_is_off_by_its_rounding_that_of_the_rate_and_what_the_motion_leaves_out() {
        let near =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 8.0 * f64::EPSILON, "{found:e}");
        let free = PulsarScene::new(&scene("[0.0, 0.0, 0.0]")).unwrap();
        for t in [1e4, -1e4] {
            near(free.residual_error(t), 8.64e-12);
            near(free.arrival_error(t), 8.64e-12 + 1.110_223_024_625_156_5e-11);
        }
        let scene = |frequency: &str, eigenvalues: &str| {
            let text = text_of("isolated-pulsar").unwrap().replace("[0.0, 0.0, 0.0]", eigenvalues);
            let mut scene = Scene::from_toml("scene", &text.replace("frequency = 2.5", frequency)).unwrap();
            (scene.times, scene.spin_down) = (Times::Listed { start: 0.0, times: vec![0.0] }, None);
            scene
        };
        // For a star that rotates once in four months 1e-16 rad correspond to more than the rounding of an arrival time.
        for frequency in ["frequency = 1e-7", "frequency = -1e-7"] {
            let late = PulsarScene::new(&scene(frequency, "[1e-20, 0.0, -3e-20]")).unwrap();
            let (motion, per_turn) = (late.clock.motion(), TAU / late.clock.period());
            assert!(motion.rounding(0.0) / per_turn > 8.64e-12);
            near(late.residual_error(1e9), motion.truncation(1e9) / per_turn + motion.rounding(0.0) / per_turn);
            near(late.arrival_error(1e9), motion.error_estimate(1e9) / per_turn + 1.110_223_024_625_156_5e-6);
        }
        let mut scene = scene("frequency = 2.5", "[1e-5, 0.0, -3e-5]");
        scene.spin_down = crate::scene_file::SpinDown {
            f1: -1e-13,
            index: crate::scene_file::IndexOrSecond::Index(3.0),
            torque_share: 0.5,
            damping_time: None,
        }
        .into();
        let braked = PulsarScene::new(&scene).unwrap();
        let per_turn = TAU / braked.clock.period();
        let left_out = braked.clock.truncation(1e8) + braked.clock.motion().rounding(0.0) / per_turn;
        near(braked.residual_error(1e8), left_out);
        near(braked.arrival_error(1e8), left_out + 1.110_223_024_625_156_5e-7);
        assert!(left_out > 1e-6, "{left_out:e}");
    }

    /// Two epochs in one turn give one pulse. The fit is about the whole day nearest to the mean of the days.
    #[test]
    fn epochs_have_their_pulses_about_the_day_in_their_middle() {
        let (_, timing) = timed(&scene("[0.0, 0.0, 0.0]"), &[0.0, 0.01, 2.0 * DAY, 5.0 * DAY]);
        assert_eq!((timing.pulses.len(), timing.dark), (3, 0));
        // The days 0, 0, 2 and 5 from 55000 on have the mean 1.75.
        assert_eq!((timing.epoch.day(), timing.epoch.fraction()), (55002, 0.0));
    }
}
