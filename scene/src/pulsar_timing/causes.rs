//! Contributions to the residuals of a pulsar: geometry, torque, Lorentz violation.

use nalgebra::Matrix3;
use twofold::Error;
use twofold::dynamics::Problem;
use twofold::observables::pulsar::PulsarClock;
use twofold::propagation::PhasedMotion;
use twofold::spin_down::{Braking, StretchedTime};

use super::{PulsarScene, Timing};

/// The contributions to the residuals (s): the delay by each cause, less the part that the fit to the arrival times absorbs. They add up
/// to the residuals, except for the part of the secular spin-down that no fit removes (in it that of a pulse of the duration `d`, `kappa d^2 / 8`),
/// and for the rounding of arrival times, which they do not contain.
///
/// A pulse of number `N` has left the star at the stretched time `tau = N P + geometry + violation`, where the secular law of braking alone would
/// have its clock at `tau_s(t) = tau + torque`; each is the middle between its values at the edges. So the turns `N` are those of `tau_s(t)`, which
/// the fit removes, less the three delays over `P`.
#[derive(Debug, Clone)]
pub struct Causes {
    /// Free precession changes the times at which the beam points at the observer.
    pub geometry: Vec<f64>,
    /// The torque varies over a precession. Zero if it does not depend on the magnetic axis.
    pub torque: Vec<f64>,
    /// The delay that Lorentz violation causes directly, with unchanged torque. Violation also changes the precession rate and so the phase of the
    /// torque modulation: that effect is in [`torque`](Self::torque), and may be larger.
    pub violation: Vec<f64>,
    /// Rate of the frequency at each pulse (Hz/s), without geometry.
    pub spin_down_rate: Vec<f64>,
}

impl PulsarScene {
    /// The contributions to the residuals of arrival times.
    ///
    /// # Errors
    /// As for [`PulsarClock::pulse_near`]; a sentence if the star without Lorentz violation has no pulse in the same turns.
    pub fn causes(&self, timing: &Timing) -> Result<Causes, String> {
        let time = self.clock.stretched_time();
        let free = Problem::new(*self.problem.spheroid(), Matrix3::zeros(), *self.problem.initial())?;
        let free = PulsarClock::new(PhasedMotion::new(&free, 0.0)?, &self.beam, &self.observer)?;
        let free = free.damped(time.precession().damping)?;
        let (period, braking) = (self.clock.period(), time.braking());
        let secular = StretchedTime::new(&Braking { torque_share: 0.0, ..*braking }, time.precession())?;
        let mut delays = [const { Vec::new() }; 3];
        let mut spin_down_rate = Vec::with_capacity(timing.pulses.len());
        for timed in &timing.pulses {
            let number = timed.pulse.number;
            let stretched = time.stretched_at(timed.pulse.midpoint)?;
            let without = free.pulse_near(stretched)?.filter(|pulse| pulse.number == number);
            let without = without.ok_or_else(|| {
                format!(
                    "--causes: at the time of pulse {number} the star without Lorentz violation is in another turn, or has no pulse; use a \
                     violation that delays the pulses by less than a turn"
                )
            })?;
            let later = |time: [f64; 2], than: [f64; 2]| (time[0] - than[0]) + (time[1] - than[1]);
            // At both edges: the middle of a pulse is not that of its stretched time.
            let [high, low] = timed.pulse.midpoint;
            let edges = [-0.5, 0.5_f64].map(|half| [high, half.mul_add(timed.pulse.duration, low)]);
            let of_edge = |edge: [f64; 2]| -> Result<_, Error> {
                let stretched = time.stretched_at(edge)?;
                Ok([later(secular.stretched_at(edge)?, stretched), later(stretched, without.midpoint)])
            };
            let [first, last] = [of_edge(edges[0])?, of_edge(edges[1])?];
            let even = number as f64 * period;
            let rest = (number as f64).mul_add(period, -even);
            delays[0].push(later(without.midpoint, [even, rest]));
            delays[1].push((first[0] + last[0]) / 2.0);
            delays[2].push((first[1] + last[1]) / 2.0);
            let rate =
                (0.0 - braking.rate) / period * time.slowing(stretched[0]) * time.braking_over_mean(stretched[0]);
            spin_down_rate.push(rate);
        }
        let times: Vec<_> = timing.pulses.iter().map(|timed| timed.arrival.seconds_since(&timing.epoch)[0]).collect();
        let [geometry, torque, violation] = delays.map(|delays| {
            let turns = delays.iter().map(|delay| delay / period).collect();
            timing.fit.residuals_of_turns(&times, turns, timing.derivatives)
        });
        Ok(Causes { geometry, torque, violation, spin_down_rate })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{scene, timed};
    use crate::scene_file::{IndexOrSecond, Scene, SpinDown, text_of};

    fn spin_down(f1: f64, torque_share: f64) -> Option<SpinDown> {
        Some(SpinDown { f1, index: IndexOrSecond::Index(3.0), torque_share, damping_time: None })
    }

    /// Accurate to the rounding of the arrival times, 1e-16 d, and of residuals that are 1e-16 of the largest distance from
    /// the chord.
    #[test]
    fn without_braking_the_causes_add_up_to_the_residuals() {
        let times: Vec<_> = (0..12).map(|k| 0.9e8 / 11.0 * f64::from(k)).collect();
        let (pulsar, timing) = timed(&scene("[2e-9, 0.0, -3e-9]"), &times);
        let causes = pulsar.causes(&timing).unwrap();
        for (i, residual) in timing.fit.residuals.iter().enumerate() {
            let sum = causes.geometry[i] + causes.torque[i] + causes.violation[i];
            assert!((sum - residual).abs() < 2e-11, "{sum:e} and {residual:e}");
        }
        let largest = |late: &[f64]| late.iter().fold(0.0, |largest: f64, late| largest.max(late.abs()));
        assert!(largest(&causes.geometry) > 1e-6 && largest(&causes.violation) > 1e-6, "{causes:?}");
    }

    /// A star of 12 days whose pulses last for a day, in which `kappa d^2 / 8` is 0.1 s, and varies as the star wobbles. The rounding of times is 1e-8 s.
    #[test]
    fn nothing_is_late_by_a_cause_that_is_not_there() {
        let text = text_of("isolated-pulsar").unwrap().replace("frequency = 2.5", "frequency = 1e-6");
        let text = text.replace("period = 400.0", "period = 60.0").replace("\"1.0 deg\"", "\"20 deg\"");
        let mut scene = Scene::from_toml("scene", &text).unwrap();
        let times: Vec<_> = (0..30).map(|k| 0.9e8 / 29.0 * f64::from(k)).collect();
        let largest = |late: &[f64]| late.iter().fold(0.0, |largest: f64, late| largest.max(late.abs()));
        for share in [0.0, 1.0] {
            scene.spin_down = spin_down(-1e-16, share);
            let (pulsar, timing) = timed(&scene, &times);
            let durations = timing.pulses.iter().map(|timed| timed.pulse.duration);
            assert!(durations.fold(0.0, f64::max) > 5e4);
            let causes = pulsar.causes(&timing).unwrap();
            assert!(largest(&causes.violation) < 1e-7, "{:?}", causes.violation);
            assert_eq!(share == 0.0, largest(&causes.torque) == 0.0, "{:?}", causes.torque);
        }
    }

    /// With the index 3 and a constant torque the rate is `f1 (f / f0)^3 = f1 (1 - 2 t f1 / f0)^(-3/2)`. A torque in vacuum is also proportional to
    /// the squared sine of the angle of the magnetic axis to `L`: the resulting change of the frequency is a fraction `f1 / f0` over the precession
    /// rate, 2e-9.
    #[test]
    fn the_frequency_falls_by_the_law_of_braking_and_the_torque() {
        let mut scene = scene("[0.0, 0.0, 0.0]");
        for (f1, share, bound) in [(-1e-10, 0.0, 1e-12), (-1e-15, 1.0, 1e-9)] {
            scene.spin_down = spin_down(f1, share);
            let (pulsar, timing) = timed(&scene, &[0.0, 0.7e7, 1.6e7, 3e8]);
            let f0 = 1.0 / pulsar.clock.period();
            let torque = timing.pulses.iter().map(|timed| {
                let state = &timed.pulse.state;
                let sine = pulsar.beam.direction(state).cross(&state.momentum.normalize()).norm();
                let law = f1 * (1.0 - 2.0 * timed.pulse.midpoint[0] * f1 / f0).powf(-1.5);
                if share == 0.0 { law } else { law * sine * sine }
            });
            let ratios: Vec<_> = torque
                .zip(pulsar.causes(&timing).unwrap().spin_down_rate)
                .map(|(torque, rate)| rate / torque)
                .collect();
            // The mean of the squared sine over a precession is one number for all; a constant torque does not need it.
            let mean = if share == 0.0 { 1.0 } else { ratios[0] };
            assert!(ratios.iter().all(|ratio| (ratio / mean - 1.0).abs() < bound), "{ratios:?}");
            assert!((1.0..1.5).contains(&mean), "{mean}");
        }
    }
}
