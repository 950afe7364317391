//! What is seen of a star: its motion, pulses and strain.

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
    /// Turn that it belongs to, counted from some one.
    pub turn: i64,
    /// Time from which the others are counted: zero, but for a pulse of a span so long that one double holds no time well enough.
    pub epoch: f64,
    /// Time at which the line of sight enters the beam.
    pub start: f64,
    /// Time at which it leaves.
    pub end: f64,
    /// Time of the closest approach.
    pub closest: f64,
}

impl Event {
    /// The middle between the edges, since the epoch.
    pub fn midpoint(&self) -> f64 {
        self.start + (self.end - self.start) / 2.0
    }

    /// What is observed of it, given the pulse before: none for a period without a pulse in the turn before.
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

/// The motion of a star over a span that begins at its start, and what is seen of it.
pub struct Signal {
    /// The star, its beam and its observer.
    pub parameters: Parameters<f64>,
    /// Last time.
    pub end: f64,
    pub(super) is_long: bool,
    motion: PlannedMotion,
    beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
}

/// Truncation error of motions and of their derivatives. Enough for times to 1e-12 of a turn.
pub(super) const TOLERANCE: f64 = 1e-13;

/// Rate of a rotation with all of the angular momentum across the symmetry axis, `|L| / I^xx`.
pub(super) fn turning_rate(parameters: &Parameters<f64>) -> f64 {
    parameters.state().momentum.norm() / parameters.spheroid.inertia_xx
}

/// A polarization of a star in a state with these vectors.
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
    /// Whether the span is one of more than 1e5 rad of rotation. Its pulses are those near given times.
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

    /// Every whole pulse that is the only one of its turn.
    ///
    /// # Errors
    /// A beam or line of sight that has no pulses to be counted, and a long span.
    pub fn events(&self) -> Result<Vec<Event>, Error> {
        Error::ensure(!self.is_long, "span for every pulse", self.end, "one of at most 1e5 rad of rotation")?;
        let found = self.events_in((0.0, self.end))?;
        let once = |turn: i64| found.iter().filter(|event| event.turn == turn).count() == 1;
        Ok(if found.windows(2).all(|pair| pair[0].turn < pair[1].turn) {
            found
        } else {
            found.iter().filter(|event| once(event.turn)).copied().collect()
        })
    }

    /// The first whole pulse after each of some times, within two turns; `turn` is the place of the time. For spans with more pulses
    /// than can be looked for. Of a [long](Self::is_long) span the pulse of the turn nearest to each, with the number of the turn.
    ///
    /// # Errors
    /// As for [`events`](Self::events); of a long span those of [`check_span`](super::check_span).
    pub fn events_after(&self, times: &[f64]) -> Result<Vec<Event>, Error> {
        if self.is_long {
            return long_span::pulses_near(&self.parameters, self.end, times);
        }
        let mut found: Vec<Event> = Vec::new();
        let window = 2.2 * self.turn();
        for (place, &time) in times.iter().enumerate() {
            let Some(&event) = self.events_in((time, (time + window).min(self.end)))?.first() else { continue };
            // One pulse is one datum, however many epochs it is the next of.
            let again = |last: &Event| (event.closest - last.closest).abs() < 0.25 * self.turn();
            if !found.last().is_some_and(again) {
                found.push(Event { turn: place as i64, ..event });
            }
        }
        Ok(found)
    }

    /// The pulses of turns with given numbers in a [long](Self::is_long) span, each looked for from a time near it; turns without a pulse are
    /// left out.
    ///
    /// # Errors
    /// A beam or line of sight that has no pulses to be counted, and those of [`check_span`](super::check_span).
    pub fn events_of_turns(&self, turns: &[(i64, f64)]) -> Result<Vec<Event>, Error> {
        long_span::pulses_numbered(&self.parameters, self.end, turns)
    }

    /// About the time of a turn: that of a rotation at the rate `|L| / I^xx`.
    pub fn turn(&self) -> f64 {
        std::f64::consts::TAU / turning_rate(&self.parameters)
    }

    /// The most that rounding and the truncation of the motion make of a datum: ten times the estimated error of directions at the end, as
    /// a part of a radian of rotation or of the strain.
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

    /// A polarization at a time.
    ///
    /// # Errors
    /// A time outside the span.
    pub(crate) fn strain(&self, observable: Observable, t: f64) -> Result<f64, Error> {
        let state = self.motion.axis_state(t)?;
        Ok(strain(&self.parameters, [&state.axis, &state.momentum], observable))
    }
}
