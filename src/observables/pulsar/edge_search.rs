//! Every time at which the line of sight crosses the edge of the beam, by bounds on the derivatives of `m.n`.

use nalgebra::Vector3;

use super::hermite::{Jet, Quintic};
use super::rate_bounds::RateBounds;
use super::root::{Look, root};
use super::{Beam, train::GRAZING};
use crate::error::Error;
use crate::propagation::{Motion, SeriesProjection};

/// Rotation (rad) in a piece to begin with, and in one so short that an extremum near the edge is worth finding exactly.
const PIECE: f64 = 2.4;
const SHORT: f64 = 0.05;

/// What the search reports, in order of time.
pub(super) enum Event {
    /// The margin `m.n - cos rho` changes its sign; whether upwards.
    Crossing { time: f64, entering: bool },
    /// An extremum of the margin within [`GRAZING`] of zero.
    Grazing { time: f64 },
}

/// The margin `m.n - cos rho` along a motion.
pub(super) trait Margin {
    /// With its first three time derivatives at the time `t`.
    fn at(&self, t: f64) -> Result<[f64; 4], Error>;

    /// The latest time in `(after, t]` at which it takes less work than elsewhere, or `t`.
    fn cheapest_time(&self, after: f64, t: f64) -> f64;
}

/// From the series of a motion, which are cheapest where they start.
pub(super) struct BySeries<'a> {
    projection: &'a SeriesProjection<'a>,
    /// `cos rho`.
    edge: f64,
}

impl<'a> BySeries<'a> {
    /// `projection` is that of the axis of the beam on the line of sight.
    pub(super) fn new(projection: &'a SeriesProjection<'a>, beam: &Beam<f64>) -> Self {
        Self { projection, edge: beam.half_opening.cos() }
    }
}

impl Margin for BySeries<'_> {
    fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let [product, rate, second, third] = self.projection.at(t)?;
        Ok([product - self.edge, rate, second, third])
    }

    fn cheapest_time(&self, after: f64, t: f64) -> f64 {
        self.projection.step_start(after, t).unwrap_or(t)
    }
}

/// From the states of any motion.
pub(super) struct ByStates<'a, M> {
    pub(super) motion: &'a M,
    pub(super) beam: &'a Beam<f64>,
    pub(super) line_of_sight: &'a Vector3<f64>,
}

impl<M: Motion<f64>> Margin for ByStates<'_, M> {
    fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let (state, motion) = (self.motion.state(t)?, self.motion);
        Ok(self.beam.margin_rates(motion.spheroid(), motion.violation(), &state, self.line_of_sight))
    }

    fn cheapest_time(&self, _: f64, t: f64) -> f64 {
        t
    }
}

/// The search along a motion, by what bounds the derivatives of the margin.
pub(super) struct EdgeSearch<P> {
    pub(super) margin: P,
    pub(super) bounds: RateBounds,
}

impl<P: Margin> EdgeSearch<P> {
    /// The margin and its first three time derivatives.
    pub(super) fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let margin = self.margin.at(t)?;
        // A number that is not finite spoils the sum, which does not overflow otherwise.
        let all = margin.iter().sum::<f64>();
        Error::unless(all.is_finite(), "m.n or a time derivative of it", all, "a finite number")?;
        Ok(margin)
    }

    pub(super) fn jet(&self, time: f64) -> Result<Jet, Error> {
        Ok(Jet { time, margin: self.at(time)? })
    }

    /// Reports every event between a time that has been looked at and a later one, whose margin it gives.
    pub(super) fn events(&self, from: Jet, to: f64, report: &mut impl FnMut(Event)) -> Result<Jet, Error> {
        let piece = PIECE / self.bounds.first;
        let mut from = from;
        while from.time < to {
            let far = from.time + piece;
            let end = if far < to { self.margin.cheapest_time(from.time, far) } else { to };
            let end = self.jet(end)?;
            self.search(&from, &end, report)?;
            from = end;
        }
        Ok(from)
    }

    /// Divides a piece until the polynomial through its ends and the bounds of what that leaves out prove that the margin
    /// has no root there, or one.
    pub(super) fn search(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let polynomial = Quintic::between(from, to, &self.bounds);
        if polynomial.is_clear() {
            return Ok(());
        }
        let length = to.time - from.time;
        let is_across = from.is_inside() != to.is_inside();
        if polynomial.is_monotonic() || self.is_steep(from, to) {
            return if is_across { self.crossing(from, to, &polynomial, report) } else { Ok(()) };
        }
        let mut middle = from.time + length / 2.0;
        if let Some(convex) = polynomial.convexity().or_else(|| self.is_curved(from, to)) {
            // An extremum this near to the edge is to be reported, on whatever side of it the ends are.
            let off_the_edge = from.margin[0].abs().min(to.margin[0].abs()) > 2.0 * GRAZING;
            if is_across && (off_the_edge || from.is_rising() == to.is_rising()) {
                return self.crossing(from, to, &polynomial, report);
            }
            let opens_away = from.is_inside() != convex;
            if !is_across && (from.is_rising() == to.is_rising() || opens_away && off_the_edge) {
                return Ok(());
            }
            if length * self.bounds.first < SHORT {
                return self.around_extremum(from, to, report);
            }
            let share = from.margin[1] / (from.margin[1] - to.margin[1]);
            middle = from.time + share.clamp(0.1, 0.9) * length;
        }
        let RateBounds { third, .. } = self.bounds;
        let size = |jet: &Jet| {
            let [value, rate, second, _] = jet.margin.map(f64::abs);
            value + length * (rate + length * (second / 2.0 + length * third / 6.0))
        };
        let reach = size(from).max(size(to));
        Error::unless(
            reach > GRAZING && from.time < middle && middle < to.time,
            "|m.n - cos rho| over a stretch of time",
            reach,
            "above 1e-13: the line of sight stays on the edge of the beam, and rounding decides what it sees",
        )?;
        let middle = self.jet(middle)?;
        self.search(from, &middle, report)?;
        self.search(&middle, to, report)
    }

    /// Whether the rate keeps its sign between two times because it cannot change so fast.
    fn is_steep(&self, from: &Jet, to: &Jet) -> bool {
        let RateBounds { first, second, .. } = self.bounds;
        let (a, b) = (from.margin[1], to.margin[1]);
        a * b > 0.0 && (a + b).abs() > second * (to.time - from.time) + 16.0 * f64::EPSILON * first
    }

    /// The sign of the second derivative, if it keeps it because it cannot change so fast; whether it is positive.
    fn is_curved(&self, from: &Jet, to: &Jet) -> Option<bool> {
        let RateBounds { second, third, .. } = self.bounds;
        let (a, b) = (from.margin[2], to.margin[2]);
        let is_certain = a * b > 0.0 && (a + b).abs() > third * (to.time - from.time) + 16.0 * f64::EPSILON * second;
        is_certain.then_some(a > 0.0)
    }

    /// The one root of a piece whose ends differ in sign.
    fn crossing(
        &self,
        from: &Jet,
        to: &Jet,
        polynomial: &Quintic,
        report: &mut impl FnMut(Event),
    ) -> Result<(), Error> {
        let entering = to.is_inside();
        let length = to.time - from.time;
        let guess = from.time + polynomial.root() * length;
        let time = root((from.time, to.time), guess, entering, |t| Ok(self.look_for_edge(t, length, &self.at(t)?)))?;
        report(Event::Crossing { time, entering });
        Ok(())
    }

    /// The step to the root of the cubic about `t`, by reversion of its series. It is exact if that root is one of the cubic and the
    /// next term of the margin, by its bound, moves it by less than `t` or the margin are rounded.
    #[inline]
    fn look_for_edge(&self, t: f64, width: f64, margin: &[f64; 4]) -> Look {
        let [value, rate, second, third] = *margin;
        let inverse = 1.0 / rate;
        let (u, a2, a3) = (-value * inverse, second * inverse / 2.0, third * inverse / 6.0);
        let step = u * (1.0 + u * (-a2 + u * (2.0 * a2 * a2 - a3)));
        let square = step * step;
        let left = step * (1.0 + step * (a2 + step * a3)) - u;
        let error = left.abs() + (self.bounds.fourth / 24.0 * inverse).abs() * square * square;
        let allowed = f64::EPSILON * (0.5 * t.abs().max(width)).max(0.25 * inverse.abs());
        Look { value, step, is_exact: error <= allowed }
    }

    /// Newton's step to a root of the rate.
    pub(super) fn look_for_extremum(&self, t: f64) -> Result<Look, Error> {
        let [_, rate, second, _] = self.at(t)?;
        Ok(Look { value: rate, step: -rate / second, is_exact: false })
    }

    /// On a piece with an extremum: the roots on both sides of it.
    fn around_extremum(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let share = from.margin[1] / (from.margin[1] - to.margin[1]);
        let guess = from.time + share * (to.time - from.time);
        let time = root((from.time, to.time), guess, to.is_rising(), |t| self.look_for_extremum(t))?;
        let extremum = self.jet(time)?;
        self.monotonic_side(from, &extremum, report)?;
        if extremum.margin[0].abs() <= GRAZING {
            report(Event::Grazing { time });
        }
        self.monotonic_side(&extremum, to, report)
    }

    fn monotonic_side(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        if from.is_inside() == to.is_inside() {
            return Ok(());
        }
        self.crossing(from, to, &Quintic::between(from, to, &self.bounds), report)
    }
}
