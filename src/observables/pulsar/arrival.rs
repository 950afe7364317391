//! Times of arrival of a pulse train and the numbers of its pulses. Eqs. (44), (47).

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::edge_search::{BySeries, ByStates, EdgeSearch, Margin};
use super::rate_bounds::rate_bounds;
use super::root::root;
use super::turns::Turns;
use super::{Beam, PulseTrain};
use crate::error::Error;
use crate::propagation::Motion;

/// One whole pulse with its number and times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// Turn of the star that the pulse belongs to, zero for the first pulse of the train.
    pub number: i64,
    /// Middle between the edges.
    pub midpoint: f64,
    /// Time at which the magnetic axis is nearest to the line of sight, `m.n` largest.
    pub closest_approach: f64,
}

/// The whole pulses of a train, with the motion, beam and line of sight (a unit vector in the frame of the motion) that it
/// was made from; pulses cut by the span are left out.
///
/// The number counts the turns of the magnetic axis about the angular momentum, relative to the line of sight, so that it stays
/// right where a beam misses some turns. (About L rather than Z: the azimuth about Z counts turns only while the path of `m`
/// goes round Z. In single precession it need not, and in twofold precession it may leave Z out of a turn now and then; L it
/// goes round always. Where both are gone round, the counts are the same.) Numbers grow, whichever way the star spins about Z.
///
/// Two pulses of one turn, as a beam nearly grazed gives, have the same number. A pulse that lasts over more than one turn has
/// that of its closest approach, and none is given to the others. A pulse whose phase at the closest approach is more than half
/// a turn from that of the line of sight, possible only where the star precesses as fast as it turns, is numbered with the
/// nearer turn.
///
/// The closest approach is a root of the rate of `m.n`, in error by that of the rate over its slope: about 1e-16 over the
/// rotation rate where the maximum is sharp. With several maxima in a pulse it is the highest.
///
/// # Errors
/// [`Error::Domain`] for a train outside the span of the motion, a line of sight or a magnetic axis that lies along L, and a
/// motion that is not finite or has no angular momentum, and for turns that cannot be counted, as for [`pulse_train`](super::pulse_train).
pub fn arrivals<M: Motion<f64>>(
    motion: &M,
    beam: &Beam<f64>,
    line_of_sight: &Vector3<f64>,
    train: &PulseTrain,
) -> Result<Vec<Arrival>, Error> {
    let Some(first) = train.pulses.iter().find(|pulse| pulse.is_whole()) else { return Ok(Vec::new()) };
    let bounds = rate_bounds(motion.spheroid(), motion.violation(), &motion.state(first.start)?);
    bounds.check_countable(first.start, train.pulses.last().map_or(first.end, |last| last.end))?;
    let mut turns = Turns::new(motion, beam, line_of_sight, bounds.first, first.start)?;
    let mut turn_at = |t| turns.at(t).map(|phase| (phase / TAU).round() as i64);
    match motion.projection(&beam.axis, line_of_sight) {
        Some(projection) => EdgeSearch::new(BySeries::new(&projection, beam), bounds).arrivals(train, &mut turn_at),
        None => EdgeSearch::new(ByStates { motion, beam, line_of_sight }, bounds).arrivals(train, &mut turn_at),
    }
}

impl<P: Margin> EdgeSearch<P> {
    fn arrivals(
        &self,
        train: &PulseTrain,
        turn_at: &mut impl FnMut(f64) -> Result<i64, Error>,
    ) -> Result<Vec<Arrival>, Error> {
        let mut found: Vec<Arrival> = Vec::new();
        let mut first_number = 0;
        for pulse in train.pulses.iter().filter(|pulse| pulse.is_whole()) {
            let closest_approach = self.highest(pulse.start, pulse.end)?;
            let number = turn_at(closest_approach)?;
            if found.is_empty() {
                first_number = number;
            }
            found.push(Arrival { number: number - first_number, midpoint: pulse.midpoint(), closest_approach });
        }
        Ok(found)
    }

    /// Time of the largest `m.n` between two times at which it is lower and rises or falls inwards.
    fn highest(&self, from: f64, to: f64) -> Result<f64, Error> {
        let mut best = (f64::NEG_INFINITY, from);
        self.maxima(from, to, &mut |time, value| {
            if value > best.0 {
                best = (value, time);
            }
        })?;
        Ok(best.1)
    }

    /// Reports every maximum: the stretch is halved until bounds prove that the rate has no root there, or one at most. About a
    /// flat top, where the rate is of rounding over a stretch, one time is reported.
    fn maxima(&self, from: f64, to: f64, report: &mut impl FnMut(f64, f64)) -> Result<(), Error> {
        let middle = from + (to - from) / 2.0;
        let radius = (middle - from).max(to - middle);
        let [_, rate, second, _] = self.at(middle)?;
        let (w, third) = (self.bounds.first, self.bounds.third);
        if rate.abs() > radius * (second.abs() + radius * third / 2.0) {
            return Ok(());
        }
        let flat = radius * w < 1e-6 || middle <= from || middle >= to;
        if second.abs() <= radius * third && !flat {
            self.maxima(from, middle, report)?;
            return self.maxima(middle, to, report);
        }
        if self.at(from)?[1] > 0.0 && self.at(to)?[1] <= 0.0 {
            let middle = from + (to - from) / 2.0;
            let time = root((from, to), middle, false, |t| self.look_for_extremum(t))?;
            report(time, self.at(time)?[0]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::{BodyState, RigidSpheroid};
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::observables::Observer;
    use crate::observables::pulsar::pulse_train;
    use crate::propagation::propagate;

    /// A freely precessing star with L along Z.
    #[test]
    fn along_the_angular_momentum_turns_are_not_counted() {
        let (spheroid, beta) = (RigidSpheroid::in_units_of_tc(1.2), 0.6_f64);
        let rates = EulerRates { alpha: 1.2 / beta.cos(), beta: 0.0, gamma: -0.2 };
        let start = BodyState::from_angles(&spheroid, &EulerAngles { alpha: 0.0, beta, gamma: 0.0 }, &rates);
        let motion = propagate(&spheroid, &Matrix3::zeros(), &start, (0.0, 100.0), 1e-12).unwrap();
        let beam = Beam::new(0.4, 0.0, 0.5);
        let seen = |observer: Observer<f64>| {
            let n = observer.direction;
            let train = pulse_train(&motion, &beam, &n, (0.0, 100.0)).unwrap();
            assert!(train.pulses.iter().any(|pulse| pulse.is_whole()));
            arrivals(&motion, &beam, &n, &train)
        };
        assert!(seen(Observer::at(0.7, 0.0)).is_ok());
        assert!(matches!(seen(Observer::at(0.0, 0.0)), Err(Error::Domain { .. })));
        let none = PulseTrain { pulses: Vec::new(), grazings: Vec::new() };
        assert_eq!(arrivals(&motion, &beam, &Observer::at(0.0, 0.0).direction, &none), Ok(Vec::new()));
    }
}
