//! The observable signal of a star: its motion, pulses and strain.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::{Observable, long_span};
use crate::dynamics::AxisState;
use crate::error::Error;
use crate::numerics::scalar::Scalar;
use crate::observables::gravitational_wave::wave_of_state;
use crate::observables::pulsar::{Beam, arrivals, pulse_train};
use crate::parameters::Parameters;
use crate::plan::{Output, PlannedMotion, Request};
use crate::propagation::Motion;

/// A whole pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Number of its turn, counted from an arbitrary origin.
    pub turn: i64,
    /// Time from which the other times of the pulse are counted: zero, except for a pulse in a span so long that a single
    /// double is not precise enough for its times.
    pub epoch: f64,
    /// Time at which the line of sight enters the beam.
    pub start: f64,
    /// Time at which it leaves the beam.
    pub end: f64,
    /// Time of the closest approach.
    pub closest: f64,
}

impl Event {
    /// The midpoint between the edges, since the epoch.
    pub fn midpoint(&self) -> f64 {
        self.start + (self.end - self.start) / 2.0
    }

    /// The observed value of this pulse, given the pulse before; `None` for a period if the previous turn has no pulse.
    pub(crate) fn value(&self, before: Option<&Event>, observable: Observable) -> Option<f64> {
        match observable {
            Observable::Arrivals => Some(self.midpoint()),
            Observable::ClosestApproaches => Some(self.closest),
            Observable::Widths => Some(self.end - self.start),
            Observable::Periods => {
                let before = before.filter(|before| before.turn + 1 == self.turn)?;
                Some(self.midpoint() - before.midpoint())
            }
            Observable::StrainPlus | Observable::StrainCross => None,
        }
    }
}

/// The motion of a star over a span that begins at its start, and its observable signal.
pub struct Signal {
    /// The star, its beam and its observer.
    pub parameters: Parameters<f64>,
    /// End of the span.
    pub end: f64,
    pub(super) is_long: bool,
    motion: PlannedMotion,
    beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
}

/// Truncation error of motions and of their derivatives. It suffices for times accurate to 1e-12 of a turn.
pub(super) const TOLERANCE: f64 = 1e-13;

/// Rotation rate with all of the angular momentum perpendicular to the symmetry axis, `|L| / I^xx`.
pub(super) fn turning_rate(parameters: &Parameters<f64>) -> f64 {
    parameters.state().momentum.norm() / parameters.spheroid.inertia_xx
}

/// Time within which the pulse of an epoch ends, 2.2 turns: the span of a [forecast](super::forecast()) of pulses is longer. It is infinite for a star
/// at rest.
pub fn time_for_a_pulse(parameters: &Parameters<f64>) -> f64 {
    2.2 * (std::f64::consts::TAU / turning_rate(parameters))
}

/// One polarization of the strain for a star in a state with these vectors.
pub(super) fn strain<S: Scalar>(
    parameters: &Parameters<S>,
    [axis, momentum]: [&Vector3<S>; 2],
    observable: Observable,
) -> S {
    let state = AxisState { axis: *axis, momentum: *momentum };
    let h = wave_of_state(&parameters.spheroid, &parameters.coefficients, &state, &parameters.observer());
    let h = if observable == Observable::StrainPlus { h.plus } else { h.cross };
    h * parameters.strain_scale * parameters.strain_unit
}

impl Signal {
    /// Whether the span covers more than 1e5 rad of rotation. The pulses are then those near given times.
    pub fn is_long(&self) -> bool {
        self.is_long
    }

    /// The signal from time zero to `end`.
    ///
    /// # Errors
    /// A motion that cannot be computed.
    pub fn new(parameters: &Parameters<f64>, end: f64) -> Result<Self, Error> {
        let is_long = long_span::is_long(parameters, end);
        let output = if is_long { Output::PulseProfile } else { Output::Pulses };
        let plan = long_span::plan(parameters, Request::new(&[output], (0.0, end), 2, TOLERANCE))?;
        Ok(Self {
            parameters: *parameters,
            end,
            motion: plan.motion(&parameters.problem()?)?,
            is_long,
            beam: parameters.beam(),
            line_of_sight: parameters.observer().direction,
        })
    }

    /// Every whole pulse that is the only one in its turn.
    ///
    /// # Errors
    /// A beam or line of sight whose pulses cannot be counted, and a long span.
    pub fn events(&self) -> Result<Vec<Event>, Error> {
        Error::ensure(
            !self.is_long,
            "span for every pulse",
            self.end,
            "so short that the star turns by at most 1e5 rad",
        )?;
        let mut found = self.events_in((0.0, self.end))?;
        let mut of_turn = BTreeMap::new();
        found.iter().for_each(|event| *of_turn.entry(event.turn).or_insert(0) += 1);
        found.retain(|event| of_turn[&event.turn] == 1);
        Ok(found)
    }

    /// For each time, the first whole pulse within the next two turns; `turn` is the index of the time in the list. This is for
    /// spans with too many pulses to find all of them. For a [long](Self::is_long) span it is the pulse of the turn nearest to each
    /// time, with the number of the turn.
    ///
    /// # Errors
    /// As for [`events`](Self::events); for a long span as for [`check_span`](super::check_span).
    pub fn events_after(&self, times: &[f64]) -> Result<Vec<Event>, Error> {
        if self.is_long {
            return long_span::pulses_near(&self.parameters, self.end, times);
        }
        let mut found: Vec<Event> = Vec::new();
        let window = time_for_a_pulse(&self.parameters);
        for (place, &time) in times.iter().enumerate() {
            let Some(&event) = self.events_in((time, (time + window).min(self.end)))?.first() else { continue };
            // One pulse is one datum, even if it is the next pulse of several epochs.
            let again = |last: &Event| (event.closest - last.closest).abs() < 0.25 * self.turn();
            if !found.last().is_some_and(again) {
                found.push(Event { turn: place as i64, ..event });
            }
        }
        Ok(found)
    }

    /// The pulses of turns with given numbers in a [long](Self::is_long) span, each searched for from an approximate time; turns without a
    /// pulse are left out.
    ///
    /// # Errors
    /// A beam or line of sight whose pulses cannot be counted, and the errors of [`check_span`](super::check_span).
    pub fn events_of_turns(&self, turns: &[(i64, f64)]) -> Result<Vec<Event>, Error> {
        long_span::pulses_numbered(&self.parameters, self.end, turns)
    }

    /// Approximate duration of a turn: one rotation at the rate `|L| / I^xx`.
    pub fn turn(&self) -> f64 {
        std::f64::consts::TAU / turning_rate(&self.parameters)
    }

    /// Upper limit on the effect of rounding and of the truncation of the motion on a datum: ten times the estimated error of directions
    /// at the end, as a fraction of a radian of rotation or of the strain.
    pub(super) fn rounding(&self, observable: Observable) -> f64 {
        let directions = 10.0 * self.motion.error_estimate(self.end);
        if observable.is_of_pulses() {
            return directions * self.turn() / std::f64::consts::TAU;
        }
        let samples = (0..=100).map(|k| self.strain(observable, self.end * f64::from(k) / 100.0));
        directions * samples.filter_map(Result::ok).fold(0.0, |most: f64, h| most.max(h.abs()))
    }

    fn events_in(&self, span: (f64, f64)) -> Result<Vec<Event>, Error> {
        let train = pulse_train(&self.motion, &self.beam, &self.line_of_sight, span)?;
        let numbered = arrivals(&self.motion, &self.beam, &self.line_of_sight, &train)?;
        let whole = train.pulses.iter().filter(|pulse| pulse.is_whole()).zip(&numbered);
        Ok(whole
            .map(|(pulse, arrival)| Event {
                turn: arrival.number,
                epoch: 0.0,
                start: pulse.start,
                end: pulse.end,
                closest: arrival.closest_approach,
            })
            .collect())
    }

    /// One polarization of the strain at a time.
    ///
    /// # Errors
    /// A time outside the span.
    pub(crate) fn strain(&self, observable: Observable, t: f64) -> Result<f64, Error> {
        let state = self.motion.axis_state(t)?;
        Ok(strain(&self.parameters, [&state.axis, &state.momentum], observable))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::inference::stars;
    use crate::parameters::ThirdRate;

    #[test]
    fn the_rate_of_turns_is_the_momentum_over_the_inertia() {
        let star = stars::slow();
        let heavy =
            Parameters { spheroid: RigidSpheroid { inertia_xx: 2.0, inertia_zz: 2.2, ..star.spheroid }, ..star };
        // A star twice as heavy with the same angular velocity turns as fast.
        assert!((turning_rate(&heavy) / turning_rate(&star) - 1.0).abs() < 1e-15);
        assert!((turning_rate(&star) - star.state().momentum.norm()).abs() < 1e-15);
    }

    #[test]
    fn strains_are_the_two_polarizations_in_their_unit() {
        let star = Parameters { strain_scale: 3.0, strain_unit: 0.125, ..stars::precessing() };
        let signal = Signal::new(&star, 10.0).expect("a motion");
        for t in [0.0, 2.5, 9.0] {
            let state = signal.motion.axis_state(t).expect("a state");
            let h = wave_of_state(&star.spheroid, &star.coefficients, &state, &star.observer());
            let found = |kind| signal.strain(kind, t).expect("a strain") / (3.0 * 0.125);
            assert!(
                (found(Observable::StrainPlus) - h.plus).abs() < 1e-14
                    && (found(Observable::StrainCross) - h.cross).abs() < 1e-14
            );
            assert!(h.plus.abs() > 1e-3 && (h.plus - h.cross).abs() > 1e-3);
        }
        assert!(signal.strain(Observable::StrainPlus, 11.0).is_err());
    }

    /// The symmetry axis of this star moves far from `L`, so that its beam is out of sight for several turns at a time.
    fn with_gaps() -> Parameters<f64> {
        Parameters { rho: 0.25, theta_o: 1.3, ..stars::precessing() }
    }

    #[test]
    fn pulses_after_epochs_are_the_next_ones_within_two_turns() {
        let star = with_gaps();
        let signal = Signal::new(&star, 200.0).expect("a motion");
        let (events, turn) = (signal.events().expect("pulses"), signal.turn());
        let longest = events.windows(2).map(|pair| (pair[1].start - pair[0].start) / turn).fold(0.0, f64::max);
        assert!(longest > 3.4, "{longest} turns");
        let times: Vec<f64> = (0..400).map(|k| f64::from(k) * 0.45).collect();
        let found = signal.events_after(&times).expect("pulses");
        let mut expected: Vec<Event> = Vec::new();
        for (place, time) in times.iter().enumerate() {
            let next = events.iter().find(|event| event.start > *time && event.end < time + 2.2 * turn);
            if let Some(event) = next.filter(|event| expected.last().is_none_or(|last| last.closest != event.closest)) {
                expected.push(Event { turn: place as i64, ..*event });
            }
        }
        assert_eq!(found.len(), expected.len());
        for (event, wanted) in found.iter().zip(&expected) {
            assert_eq!(event.turn, wanted.turn);
            let differences = [event.start - wanted.start, event.end - wanted.end, event.closest - wanted.closest];
            assert!(differences.into_iter().all(|difference| difference.abs() < 1e-9), "{event:?} {wanted:?}");
        }
        // If the times are not in ascending order, a pulse may be repeated.
        let again = signal.events_after(&[events[3].start - 0.1, events[0].start - 0.1]).expect("pulses");
        assert_eq!(again.len(), 2);
    }

    #[test]
    fn long_spans_have_no_list_of_every_pulse() {
        let signal = Signal::new(&stars::weak(), 3e6).expect("a motion");
        assert!(signal.is_long() && signal.events().is_err());
        assert!(!Signal::new(&stars::weak(), 100.0).expect("a motion").is_long());
    }

    /// Ten times the estimated error of directions: in radians over the rotation rate, or as a fraction of the largest
    /// strain.
    #[test]
    fn rounding_is_a_part_of_a_turn_or_of_the_strain() {
        let star = Parameters { strain_scale: 30.0, ..stars::slow() };
        let signal = Signal::new(&star, 100.0).expect("a motion");
        let directions = 10.0 * signal.motion.error_estimate(100.0);
        let of_times = signal.rounding(Observable::Widths);
        assert!((of_times * turning_rate(&star) / directions - 1.0).abs() < 1e-12);
        let strains =
            (0..=10_000).map(|k| signal.strain(Observable::StrainCross, f64::from(k) * 0.01).expect("a strain").abs());
        let of_strain = signal.rounding(Observable::StrainCross) / directions;
        let largest = strains.fold(0.0, f64::max);
        assert!((0.95..=1.0 + 1e-12).contains(&(of_strain / largest)), "{of_strain} {largest}");
    }

    /// A prolate star whose beam passes the line of sight twice in some turns: the turn number does not distinguish these pulses, and they are
    /// left out.
    #[test]
    fn turns_of_two_pulses_are_left_out() {
        let base = stars::precessing();
        let prolate = Parameters {
            spheroid: RigidSpheroid::in_units_of_tc(0.2),
            third_rate: ThirdRate::Spin(5.0),
            chi: 0.5,
            rho: 0.3,
            ..base
        };
        let signal = Signal::new(&prolate, 40.0).expect("a motion");
        let all = signal.events_in((0.0, 40.0)).expect("pulses");
        // Turns are five units of time apart, the two pulses of one turn about one unit.
        let alone = |event: &&Event| {
            all.iter().filter(|other| (other.closest - event.closest).abs() < 0.5 * signal.turn()).count() == 1
        };
        let expected: Vec<Event> = all.iter().filter(alone).copied().collect();
        assert_eq!(expected.iter().map(|event| event.turn).collect::<Vec<_>>(), [0, 1, 5, 6, 7], "{all:?}");
        assert_eq!(all.len(), 11, "three turns of two pulses");
        assert_eq!(signal.events().expect("pulses"), expected);
    }

    #[test]
    fn pulses_are_found_from_the_start_on() {
        let first = |phi_o: f64| {
            let signal = Signal::new(&Parameters { phi_o, ..stars::precessing() }, 20.0).expect("a motion");
            signal.events().expect("pulses")[0].start
        };
        assert!(first(0.6) < 0.2 && first(1.2) < 0.8 && first(1.8) < 1.3);
    }

    /// If the strain grows all the time, its largest value is at the end; if it falls, at the start.
    #[test]
    fn the_largest_strain_is_sought_from_the_start_to_the_end() {
        for star in [stars::precessing(), Parameters { phi_o: 1.9, ..stars::precessing() }] {
            let signal = Signal::new(&star, 0.05).expect("a motion");
            for kind in [Observable::StrainPlus, Observable::StrainCross] {
                let size = |t: f64| signal.strain(kind, t).expect("a strain").abs();
                let largest = signal.rounding(kind) / (10.0 * signal.motion.error_estimate(0.05));
                assert!((largest / size(0.0).max(size(0.05)) - 1.0).abs() < 1e-12, "{kind:?}");
            }
        }
        let grows = |phi_o: f64, kind: Observable| {
            let signal = Signal::new(&Parameters { phi_o, ..stars::precessing() }, 0.05).expect("a motion");
            let size = |t: f64| signal.strain(kind, t).expect("a strain").abs();
            size(0.05) > size(0.0)
        };
        let ways =
            [0.0, 1.9].map(|phi_o| [Observable::StrainPlus, Observable::StrainCross].map(|kind| grows(phi_o, kind)));
        assert!(ways.as_flattened().contains(&true) && ways.as_flattened().contains(&false), "{ways:?}");
    }
}
