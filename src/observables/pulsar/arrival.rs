//! Arrival times of the pulses of a train, and their turn numbers. Eqs. (44), (47).

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::azimuth_follower::AzimuthFollower;
use super::edge_search::EdgeSearch;
use super::margin::{BySeries, ByStates, Margin};
use super::rate_bounds::RateBounds;
use super::root::root;
use super::{Beam, PulseTrain};
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::propagation::Motion;

/// One whole pulse with its number and times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// Turn of the star that the pulse belongs to, zero for the first pulse of the train.
    pub number: i64,
    /// Midpoint between the edges.
    pub midpoint: f64,
    /// Time at which the magnetic axis is nearest to the line of sight, `m.n` largest.
    pub closest_approach: f64,
}

/// The whole pulses of a train, with their numbers and times. Motion, beam and line of sight (a unit vector in the frame
/// of the motion) must be those from which the train was computed. Pulses cut off by the span are left out.
///
/// The number of a pulse counts the turns of the magnetic axis about the angular momentum, relative to the line of sight, so
/// that it stays correct where a beam misses some turns. (The turns are about L rather than Z because the azimuth about Z
/// counts turns only while the path of `m` encircles Z. In single precession it need not, and in twofold precession it may
/// occasionally miss Z in a turn; it always encircles L. Where the path encircles both, the counts are the same.) Numbers
/// increase with time, whatever the sense of rotation about Z.
///
/// For a motion under [another law](crate::propagation::Turning::Given) the turns about the `L` of its states are counted. `L` must rotate with
/// the body, as the angular momentum of a body rotates with `Omega`.
///
/// Two pulses of one turn, as from a beam that is nearly grazed, have the same number. A pulse that lasts longer than one turn
/// has the number of its closest approach, and no pulse is assigned to the other turns. A pulse whose phase at the closest
/// approach is more than half a turn from that of the line of sight, possible only where the star precesses as fast as it
/// rotates, is numbered with the nearer turn.
///
/// The closest approach is a root of the rate of `m.n`. Its error is the error of the rate divided by the slope of the rate:
/// about 1e-16 over the rotation rate where the maximum is sharp. If a pulse has several maxima, the highest one is used.
///
/// # Errors
/// [`Error::Domain`] for a train outside the span of the motion, a line of sight or a magnetic axis that lies along L, a motion that is
/// not finite or has no angular momentum, and turns that cannot be counted, as for [`pulse_train`](super::pulse_train).
pub fn arrivals<M: Motion<f64, State = BodyState<f64>>>(
    motion: &M,
    beam: &Beam<f64>,
    line_of_sight: &Vector3<f64>,
    train: &PulseTrain,
) -> Result<Vec<Arrival>, Error> {
    let Some(first) = train.pulses.iter().find(|pulse| pulse.is_whole()) else { return Ok(Vec::new()) };
    let turning = motion.turning();
    let bounds = RateBounds::of_motion(motion, &turning, first.start)?;
    bounds.check_countable(first.start, train.pulses.last().map_or(first.end, |last| last.end))?;
    let mut azimuth = AzimuthFollower::new(motion, beam, line_of_sight, bounds.first, first.start)?;
    let mut turn_at = |t| azimuth.at(t).map(|phase| (phase / TAU).round() as i64);
    match motion.projection(&beam.axis, line_of_sight) {
        Some(projection) => EdgeSearch::new(BySeries::new(&projection, beam), bounds).arrivals(train, &mut turn_at),
        None => {
            EdgeSearch::new(ByStates { motion, turning, beam, line_of_sight }, bounds).arrivals(train, &mut turn_at)
        }
    }
}

impl<P: Margin> EdgeSearch<P> {
    fn arrivals(
        &self,
        train: &PulseTrain,
        turn_at: &mut impl FnMut(f64) -> Result<i64, Error>,
    ) -> Result<Vec<Arrival>, Error> {
        let mut found: Vec<Arrival> = Vec::new();
        let mut first = None;
        for pulse in train.pulses.iter().filter(|pulse| pulse.is_whole()) {
            let closest_approach = self.highest(pulse.start, pulse.end)?;
            let turn = turn_at(closest_approach)?;
            let number = turn - *first.get_or_insert(turn);
            found.push(Arrival { number, midpoint: pulse.midpoint(), closest_approach });
        }
        Ok(found)
    }

    /// Time of the largest `m.n` between two times at which it is lower and increases inwards.
    fn highest(&self, from: f64, to: f64) -> Result<f64, Error> {
        let mut best = (f64::NEG_INFINITY, from);
        self.maxima(from, to, &mut |time, value| {
            if value > best.0 {
                best = (value, time);
            }
        })?;
        Ok(best.1)
    }

    /// Reports every maximum. The interval is halved until bounds prove that the rate has at most one root there. At a flat
    /// top, where the rate is rounding over an interval, one time is reported.
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
    use crate::dynamics::{BodyState, Problem, RigidSpheroid};
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::observables::Observer;
    use crate::observables::pulsar::margin::tests::{search, search_of, waves};
    use crate::observables::pulsar::{Pulse, pulse_train};

    fn bounded(first: f64, third: f64) -> RateBounds {
        RateBounds { first, second: f64::NAN, third, fourth: f64::NAN, sixth: f64::NAN }
    }

    /// Times of all maxima, and the number of evaluations.
    fn maxima(bounds: RateBounds, (from, to): (f64, f64), margin: impl Fn(f64) -> [f64; 4]) -> (Vec<f64>, usize) {
        let (search, mut found) = (search(bounds, margin), Vec::new());
        search.maxima(from, to, &mut |time, _| found.push(time)).unwrap();
        (found, search.margin.1.get())
    }

    #[test]
    fn numbers_are_counted_from_the_first_whole_pulse() {
        let half = 0.5_f64.acos();
        let pulse = |k: i64, cut: bool| {
            let middle = TAU * k as f64;
            Pulse { start: middle - half, end: middle + 1.1 * half, cut_at_start: cut, cut_at_end: false }
        };
        let train = PulseTrain {
            pulses: vec![pulse(3, true), pulse(4, false), pulse(5, false), pulse(7, false)],
            grazings: vec![],
        };
        let of_a_wave = search_of(vec![[1.0, 1.0, 0.0]], 0.0);
        let found = of_a_wave.arrivals(&train, &mut |t| Ok(20 + (t / TAU).round() as i64)).unwrap();
        assert_eq!(found.iter().map(|arrival| arrival.number).collect::<Vec<_>>(), [0, 1, 3]);
        for (arrival, k) in found.iter().zip([4.0, 5.0, 7.0]) {
            assert!((arrival.closest_approach - TAU * k).abs() < 1e-13, "{arrival:?}");
            assert!((arrival.midpoint - TAU * k - 0.05 * half).abs() < 1e-13, "{arrival:?}");
        }
    }

    /// Waves of any length and height: every maximum is found once, and nothing else.
    #[test]
    fn every_maximum_is_found_once() {
        let (mut all, mut all_looks) = (0, 0);
        for w in [0.1, 1.0, 10.0, 77.0] {
            for a in [0.02, 0.3, 1.0] {
                for j in 0..30 {
                    let (first, last) = (f64::from(j % 3), f64::from(j / 3));
                    let span = ((0.1 + 0.31 * last - TAU * first) / w, (TAU * (first + 1.0) - 1.7 + 0.23 * last) / w);
                    let (found, looks) = maxima(bounded(w, a * w * w * w), span, waves(vec![[a, w, 0.0]], 0.0));
                    let expected: Vec<_> =
                        (-3..9).map(|k| f64::from(k) * TAU / w).filter(|t| span.0 < *t && *t <= span.1).collect();
                    assert_eq!(found.len(), expected.len(), "{w} {a} {span:?}: {found:?}");
                    for (time, exact) in found.iter().zip(&expected) {
                        assert!((time - exact).abs() * w < 1e-13, "{w} {a} {span:?}: {time} {exact}");
                    }
                    (all, all_looks) = (all + found.len(), all_looks + looks);
                }
            }
        }
        // Four evaluations for a root, and two or three for each interval.
        assert!(all > 500 && all_looks < 24 * all, "{all_looks} looks for {all} maxima");
    }

    /// `1 - u^4`, flat at its top.
    fn flat(top: f64, w: f64) -> impl Fn(f64) -> [f64; 4] {
        move |t: f64| {
            let u = (t - top) * w;
            [1.0 - u.powi(4), -4.0 * w * u.powi(3), -12.0 * (w * u).powi(2), -24.0 * w.powi(3) * u]
        }
    }

    #[test]
    fn a_flat_top_is_one_maximum() {
        let (found, looks) = maxima(bounded(1.0, 24.0 * 1.3), (2.0, 3.1), flat(2.7, 1.0));
        assert!(found.len() == 1 && (found[0] - 2.7).abs() < 1e-9, "{found:?}");
        // Only the interval of four thousandths of a radian about it is subdivided to the end.
        assert!(looks < 2500, "{looks}");
    }

    /// These times are so late that consecutive doubles are a seventh of a radian apart, and the midpoint of two of them is one of them.
    #[test]
    fn late_maxima_are_found_to_the_spacing_of_times() {
        let start = 2_f64.powi(52);
        let w = 0.15_f64;
        for top in [0.3, 1.4, 2.2, 3.6, 5.0] {
            let (found, _) =
                maxima(bounded(w, 24.0 * 1.2 * w.powi(3)), (start, start + 8.0), move |t| flat(top, w)(t - start));
            assert!(found.len() == 1 && (found[0] - start - top).abs() <= 1.0, "{top}: {found:?}");
        }
        // The midpoint of this interval is rounded to two thirds of it.
        let (found, _) = maxima(bounded(w, w.powi(3)), (start, start + 3.0), move |t| {
            waves(vec![[1.0, w, 0.0]], 0.0)(t - start - 0.1)
        });
        assert!(found.len() == 1 && (found[0] - start).abs() <= 1.0, "{found:?}");
    }

    /// The rate `a^2 u - u^3` has two maxima, a ten-thousandth of a radian on either side, for a star that rotates fast.
    #[test]
    fn maxima_that_are_close_together_are_told_apart() {
        let (w, a) = (1000.0, 1e-4);
        let (found, _) = maxima(bounded(w, 6.0 * w.powi(3) * 0.0223), (0.25 - 1.31e-5, 0.25 + 2.23e-5), move |t| {
            let u = (t - 0.25) * w;
            let square = u * u;
            [
                square * (a * a - square / 2.0) / 2.0,
                w * u * (a * a - square),
                w * w * (a * a - 3.0 * square),
                -6.0 * w * w * w * u,
            ]
        });
        assert_eq!(found.len(), 2, "{found:?}");
        for (time, exact) in found.iter().zip([-a, a]) {
            assert!(((time - 0.25) * w - exact).abs() < 1e-9, "{found:?}");
        }
    }

    /// A freely precessing star with L along Z.
    #[test]
    fn along_the_angular_momentum_turns_are_not_counted() {
        let (spheroid, beta) = (RigidSpheroid::in_units_of_tc(1.2), 0.6_f64);
        let rates = EulerRates { alpha: 1.2 / beta.cos(), beta: 0.0, gamma: -0.2 };
        let start = BodyState::from_angles(&spheroid, &EulerAngles { alpha: 0.0, beta, gamma: 0.0 }, &rates);
        let motion = Problem::new(spheroid, Matrix3::zeros(), start).unwrap().taylor((0.0, 100.0), 1e-12).unwrap();
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
