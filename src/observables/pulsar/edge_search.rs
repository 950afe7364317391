//! Every time at which the line of sight crosses the edge of the beam, by bounds on the derivatives of `m.n`.

use nalgebra::Vector3;

use super::rate_bounds::{RateBounds, rate_bounds};
use super::root::root;
use super::{Beam, train::GRAZING};
use crate::error::Error;
use crate::propagation::Motion;

/// What the search reports, in order of time.
pub(super) enum Event {
    /// The margin `m.n - cos rho` changes its sign; whether upwards.
    Crossing { time: f64, entering: bool },
    /// An extremum of the margin within [`GRAZING`] of zero.
    Grazing { time: f64 },
}

/// The margin along a motion, with what bounds its derivatives.
pub(super) struct EdgeSearch<'a, M> {
    pub(super) motion: &'a M,
    pub(super) beam: &'a Beam<f64>,
    pub(super) line_of_sight: &'a Vector3<f64>,
    pub(super) bounds: RateBounds,
}

impl<'a, M: Motion<f64>> EdgeSearch<'a, M> {
    /// A search that may ask for the motion at the times around `t`.
    pub(super) fn new(
        motion: &'a M,
        beam: &'a Beam<f64>,
        line_of_sight: &'a Vector3<f64>,
        t: f64,
    ) -> Result<Self, Error> {
        let bounds = rate_bounds(motion.spheroid(), motion.violation(), &motion.state(t)?);
        Ok(Self { motion, beam, line_of_sight, bounds })
    }

    /// The margin and its first two time derivatives.
    pub(super) fn at(&self, t: f64) -> Result<[f64; 3], Error> {
        let state = self.motion.state(t)?;
        let rates = self.beam.margin_rates(self.motion.spheroid(), self.motion.violation(), &state, self.line_of_sight);
        for value in rates {
            Error::unless(value.is_finite(), "m.n or a time derivative of it", value, "a finite number")?;
        }
        Ok(rates)
    }

    /// Reports every event between two times, `from < to`.
    pub(super) fn events(&self, from: f64, to: f64, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        // A radian each at most: a few pieces per turn, most of them decided at once.
        let pieces = ((to - from) * self.bounds.first).ceil().max(1.0);
        let boundary = |k: f64| if k == pieces { to } else { from + (to - from) * (k / pieces) };
        let mut k = 0.0;
        while k < pieces {
            self.search(boundary(k), boundary(k + 1.0), report)?;
            k += 1.0;
        }
        Ok(())
    }

    /// Halves a piece until the Taylor polynomial about its middle, with the bound on the third derivative as remainder,
    /// proves that the margin has no root there, or that it is monotonic, or that its rate is.
    fn search(&self, from: f64, to: f64, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let middle = from + (to - from) / 2.0;
        let radius = (middle - from).max(to - middle);
        let [value, rate, second] = self.at(middle)?;
        let rounding = 8.0 * f64::EPSILON;
        let RateBounds { first: w, second: b2, third } = self.bounds;
        let reach = radius * (rate.abs() + radius * (second.abs() / 2.0 + radius * third / 6.0));
        let jet = Jet { time: middle, margin: [value, rate, second], third };
        if value.abs() > reach + rounding {
            Ok(())
        } else if rate.abs() > radius * (second.abs() + radius * third / 2.0) + rounding * w {
            self.crossing(&jet, from, to, report)
        } else if second.abs() > radius * third + rounding * b2 {
            self.around_extremum(&jet, from, to, report)
        } else {
            Error::unless(
                value.abs() + reach > GRAZING && from < middle && middle < to,
                "|m.n - cos rho| over a stretch of time",
                value.abs() + reach,
                "above 1e-13: the line of sight stays on the edge of the beam, and rounding decides what it sees",
            )?;
            self.search(from, middle, report)?;
            self.search(middle, to, report)
        }
    }

    /// On a piece with a monotonic margin: the root, if its ends differ in sign.
    fn crossing(&self, jet: &Jet, from: f64, to: f64, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let inside = |t: f64| jet.is_inside(t).map_or_else(|| Ok::<_, Error>(self.at(t)?[0] > 0.0), Ok);
        let entering = inside(to)?;
        if inside(from)? != entering {
            let time = root((from, to), jet.root_in(from, to), entering, |t| {
                self.at(t).map(|[value, rate, _]| (value, rate))
            })?;
            report(Event::Crossing { time, entering });
        }
        Ok(())
    }

    /// On a piece with a monotonic rate: the roots on both sides of the extremum, if there is one.
    fn around_extremum(&self, jet: &Jet, from: f64, to: f64, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let rising = |t: f64| jet.is_rising(t).map_or_else(|| Ok::<_, Error>(self.at(t)?[1] > 0.0), Ok);
        let to_minimum = rising(to)?;
        if rising(from)? == to_minimum {
            return self.crossing(jet, from, to, report);
        }
        let guess = jet.time - jet.margin[1] / jet.margin[2];
        let extremum = root((from, to), guess, to_minimum, |t| self.at(t).map(|[_, rate, second]| (rate, second)))?;
        let margin = self.at(extremum)?;
        let at_extremum = Jet { time: extremum, margin, third: jet.third };
        self.crossing(&at_extremum, from, extremum, report)?;
        if margin[0].abs() <= GRAZING {
            report(Event::Grazing { time: extremum });
        }
        self.crossing(&at_extremum, extremum, to, report)
    }
}

/// The margin and its first two derivatives at one time, with a bound of the third anywhere: what they prove of other times
/// need not be computed there.
struct Jet {
    time: f64,
    margin: [f64; 3],
    third: f64,
}

impl Jet {
    /// Whether the margin is positive at `t`, if that is certain.
    fn is_inside(&self, t: f64) -> Option<bool> {
        let (d, [value, rate, second]) = (t - self.time, self.margin);
        let estimate = value + d * (rate + d * second / 2.0);
        let rounding = 8.0 * f64::EPSILON * (1.0 + (d * rate).abs() + d * d * second.abs());
        (estimate.abs() > (d * d * d).abs() * self.third / 6.0 + rounding).then_some(estimate > 0.0)
    }

    /// Whether its rate is positive at `t`, if that is certain.
    fn is_rising(&self, t: f64) -> Option<bool> {
        let (d, [_, rate, second]) = (t - self.time, self.margin);
        let estimate = rate + d * second;
        let rounding = 8.0 * f64::EPSILON * (rate.abs() + (d * second).abs() + self.third.cbrt());
        (estimate.abs() > d * d * self.third / 2.0 + rounding).then_some(estimate > 0.0)
    }

    /// Where the parabola through the margin crosses zero between two times, or else their middle.
    fn root_in(&self, from: f64, to: f64) -> f64 {
        let [value, rate, second] = self.margin;
        let discriminant = (rate * rate - 2.0 * value * second).max(0.0).sqrt();
        // Both roots without cancellation.
        let sum = -(rate + discriminant.copysign(rate));
        let roots = [2.0 * value / sum, sum / second];
        let within = |d: &f64| from < self.time + d && self.time + d < to;
        roots.into_iter().find(within).map_or(from + (to - from) / 2.0, |d| self.time + d)
    }
}
