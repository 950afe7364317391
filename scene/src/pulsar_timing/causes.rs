//! What the residuals of a pulsar are made of: geometry, torque, Lorentz violation.

use nalgebra::Matrix3;
use twofold::Error;
use twofold::dynamics::Problem;
use twofold::observables::pulsar::{PulsarClock, SpinFit};
use twofold::propagation::PhasedMotion;

use super::{PulsarScene, Timing};

/// The causes of the residuals (s), each fitted as the arrival times are. They add up to the residuals but for what of the secular spin-down no fit takes, and for the rounding of arrival times,
/// of which they have none.
#[derive(Debug, Clone)]
pub struct Causes {
    /// Free precession turns the beam: when it points at the observer.
    pub geometry: Vec<f64>,
    /// The torque varies over a precession. Zero where it does not go with the magnetic axis.
    pub torque: Vec<f64>,
    /// By how much Lorentz violation makes the pulses late directly, the torque left as it is. It changes the rate of the precession too, and with it when the torque is large: that is
    /// in [`torque`](Self::torque), and may be the larger part.
    pub violation: Vec<f64>,
    /// Rate of the frequency at each pulse (Hz/s), geometry apart.
    pub spin_down_rate: Vec<f64>,
}

impl PulsarScene {
    /// The causes of the residuals of arrival times.
    ///
    /// # Errors
    /// As for [`PulsarClock::pulse_near`]; a sentence where the star without Lorentz violation has no pulse in the same turns.
    pub fn causes(&self, timing: &Timing) -> Result<Causes, String> {
        let time = self.clock.stretched_time();
        let free = Problem::new(*self.problem.spheroid(), Matrix3::zeros(), *self.problem.initial())?;
        let free = PulsarClock::on(PhasedMotion::new(&free, 0.0)?, &self.beam, &self.observer)?;
        let free = free.damped(time.precession().damping)?;
        let (period, braking) = (self.clock.period(), time.braking());
        let mut points = [const { Vec::new() }; 3];
        let mut spin_down_rate = Vec::with_capacity(timing.pulses.len());
        for timed in &timing.pulses {
            let number = timed.pulse.number;
            let stretched = time.stretched_at(timed.pulse.midpoint)?;
            let without = free.pulse_near(stretched)?.filter(|pulse| pulse.number == number);
            let without = without.ok_or_else(|| {
                format!(
                    "--causes: at the time of pulse {number} the star without Lorentz violation is in another turn, or dark: allowed is a \
                     violation that makes the pulses late by less than a turn"
                )
            })?;
            // Late against even turns, which the fit takes away.
            let violation = (stretched[0] - without.midpoint[0]) + (stretched[1] - without.midpoint[1]);
            let even = number as f64 * period;
            let rest = (number as f64).mul_add(period, -even);
            points[0].push((number, without.midpoint));
            points[1].push((number, [even, rest + time.late(stretched[0])]));
            points[2].push((number, [even, rest + violation]));
            let rate = -braking.rate / period * time.slowing(stretched[0]) * time.braking_over_mean(stretched[0]);
            spin_down_rate.push(rate);
        }
        let residuals = |points: &[(i64, [f64; 2])]| -> Result<Vec<f64>, Error> {
            Ok(SpinFit::new(points, timing.derivatives)?.residuals)
        };
        let [geometry, torque, violation] = &points;
        let (geometry, torque, violation) = (residuals(geometry)?, residuals(torque)?, residuals(violation)?);
        Ok(Causes { geometry, torque, violation, spin_down_rate })
    }
}
