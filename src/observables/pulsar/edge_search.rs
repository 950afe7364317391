//! Finds every time at which the line of sight crosses the edge of the beam, using bounds on the derivatives of `m.n`.

use core::cell::Cell;

use super::margin::Margin;
use super::rate_bounds::RateBounds;
use super::root::{Look, root};
use crate::error::Error;
use crate::numerics::hermite::{Jet, Quintic};

/// An extremum of `m.n` this close to `cos rho` is a grazing. Whether the line of sight crosses the edge there cannot be
/// decided in doubles, because `m.n` along a numerical motion has an error of about this size.
pub const GRAZING: f64 = 1e-13;

/// Rotation (rad) in an initial piece, and in one so short that an extremum near the edge is worth finding exactly.
const PIECE: f64 = 2.4;
const SHORT: f64 = 0.05;

/// What the search reports, in order of time.
pub(super) enum Event {
    /// The margin `m.n - cos rho` changes its sign; `entering` is true if upwards.
    Crossing { time: f64, entering: bool },
    /// An extremum of the margin within [`GRAZING`] of zero.
    Grazing { time: f64 },
}

/// The search along a motion, with bounds on the derivatives of the margin.
pub(super) struct EdgeSearch<P> {
    pub(super) margin: P,
    pub(super) bounds: RateBounds,
    /// Number of subdivisions left for the current piece.
    divisions: Cell<u32>,
}

/// Maximum number of subdivisions of one piece, plus one per radian: about ten are usual, a hundred near a grazing.
const MOST_DIVISIONS: u32 = 10_000;

impl<P: Margin> EdgeSearch<P> {
    pub(super) fn new(margin: P, bounds: RateBounds) -> Self {
        Self { margin, bounds, divisions: Cell::new(0) }
    }

    /// Searches a new piece.
    pub(super) fn piece(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let rotation = self.bounds.first * (to.time - from.time);
        self.divisions.set(MOST_DIVISIONS.saturating_add(rotation as u32));
        if P::BY_STATED_LAW {
            self.check_stated_law(from, to)?;
        }
        self.search(from, to, report)
    }

    /// Refuses values and derivatives that cannot belong to one function within the bounds.
    ///
    /// With `H` of [`Quintic`], `f - H` is `(t - a)^3 (t - b)^3` times a divided difference, which for the third derivative at `a` is a
    /// sixth derivative over 720: there `|f''' - H'''| <= M h^3 / 120`. An error `e` of the margin adds up to `120 e / h^3`, and an
    /// error of one of its derivatives as much again if they rotate as fast. The value 0.3 accepts errors of a few thousandths.
    fn check_stated_law(&self, from: &Jet, to: &Jet) -> Result<(), Error> {
        let h = to.time - from.time;
        let ([f, df, ddf, dddf], [g, dg, ddg, _]) = (from.values, to.values);
        let of_polynomial = 60.0 * (g - f) - h * (36.0 * df + 24.0 * dg) + h * h * (3.0 * ddg - 9.0 * ddf);
        let mismatch = (h * h * h * dddf - of_polynomial).abs();
        let allowed = self.bounds.sixth * h.powi(6) / 120.0 + 0.3;
        // The estimate may require a second motion, so it is made only where it decides.
        Error::ensure(
            mismatch <= allowed || mismatch <= allowed + 300.0 * self.margin.estimated_error(to.time),
            "third derivative of m.n times h^3, over a stretch of length h, by the stated law less that by the states",
            mismatch,
            "at most what the bounds of the angular velocity leave open; the states do not turn as the motion's `turning` says",
        )
    }

    /// The margin and its first three time derivatives.
    pub(super) fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let margin = self.margin.at(t)?;
        // A value that is not finite makes the sum not finite; otherwise the sum does not overflow.
        let all = margin.iter().sum::<f64>();
        Error::ensure(all.is_finite(), "m.n or a time derivative of it", all, "a finite number")?;
        Ok(margin)
    }

    pub(super) fn jet(&self, time: f64) -> Result<Jet, Error> {
        Ok(Jet { time, values: self.at(time)? })
    }

    /// Reports every event between a time that has been evaluated and a later one, and returns the margin there.
    pub(super) fn events(&self, from: Jet, to: f64, report: &mut impl FnMut(Event)) -> Result<Jet, Error> {
        let piece = PIECE / self.bounds.first;
        let mut from = from;
        while from.time < to {
            let far = from.time + piece;
            let end = if far < to { self.margin.cheapest_time(from.time, far) } else { to };
            let end = self.jet(end)?;
            self.piece(&from, &end, report)?;
            from = end;
        }
        Ok(from)
    }

    fn quintic(&self, from: &Jet, to: &Jet) -> Quintic {
        Quintic::between(from, to, [self.bounds.first, self.bounds.second, self.bounds.sixth])
    }

    /// Subdivides a piece until the polynomial through its ends and the bounds on its remainder prove that the margin has at
    /// most one root there.
    fn search(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let polynomial = self.quintic(from, to);
        if polynomial.is_clear(2.0 * GRAZING) {
            return Ok(());
        }
        let length = to.time - from.time;
        let is_across = from.is_positive() != to.is_positive();
        if polynomial.is_monotonic() || self.is_steep(from, to) {
            return if is_across { self.crossing(from, to, &polynomial, report) } else { Ok(()) };
        }
        let mut middle = from.time + length / 2.0;
        if let Some(convex) = polynomial.convexity().or_else(|| self.is_curved(from, to)) {
            // An extremum this close to the edge is to be reported, whichever side the ends are on.
            let off_the_edge = from.values[0].abs().min(to.values[0].abs()) > 2.0 * GRAZING;
            if is_across && (off_the_edge || from.is_rising() == to.is_rising()) {
                return self.crossing(from, to, &polynomial, report);
            }
            let opens_away = from.is_positive() != convex;
            if !is_across && (from.is_rising() == to.is_rising() || opens_away && off_the_edge) {
                return Ok(());
            }
            let guess = from.time + length * from.values[1] / (from.values[1] - to.values[1]);
            if length * self.bounds.first < SHORT {
                return self.around_extremum(from, to, guess, report);
            }
            middle = guess.clamp(from.time + 0.1 * length, from.time + 0.9 * length);
        }
        let RateBounds { third, .. } = self.bounds;
        let size = |jet: &Jet| {
            let [value, rate, second, _] = jet.values.map(f64::abs);
            value + length * (rate + length * (second / 2.0 + length * third / 6.0))
        };
        let reach = size(from).max(size(to));
        Error::ensure(
            reach > GRAZING && from.time < middle && middle < to.time,
            "|m.n - cos rho| over a stretch of time",
            reach,
            "above 1e-13; the line of sight stays on the edge of the beam, and rounding decides what it sees",
        )?;
        Error::ensure(
            self.divisions.get() > 0,
            "length of time after 10,000 divisions of a piece of the search for edges",
            length,
            "long enough to tell edges apart; m.n does not follow the equations of motion closely enough",
        )?;
        self.divisions.set(self.divisions.get() - 1);
        let middle = self.jet(middle)?;
        self.search(from, &middle, report)?;
        self.search(&middle, to, report)
    }

    /// Whether the rate keeps its sign between two times, because it cannot change fast enough.
    fn is_steep(&self, from: &Jet, to: &Jet) -> bool {
        let RateBounds { first, second, .. } = self.bounds;
        let (a, b) = (from.values[1], to.values[1]);
        a * b > 0.0 && (a + b).abs() > second * (to.time - from.time) + 16.0 * f64::EPSILON * first
    }

    /// Whether the second derivative is positive, if it keeps its sign because it cannot change fast enough; otherwise
    /// `None`.
    fn is_curved(&self, from: &Jet, to: &Jet) -> Option<bool> {
        let RateBounds { second, third, .. } = self.bounds;
        let (a, b) = (from.values[2], to.values[2]);
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
        let entering = to.is_positive();
        let length = to.time - from.time;
        let guess = from.time + polynomial.root() * length;
        let time = root((from.time, to.time), guess, entering, |t| Ok(self.look_for_edge(t, length, &self.at(t)?)))?;
        report(Event::Crossing { time, entering });
        Ok(())
    }

    /// The step to the root of the cubic about `t`, by reversion of its series. It is exact if it is a root of the cubic and the
    /// next term of the margin, by its bound, moves it by less than the rounding of `t` or of the margin.
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

    /// The roots on both sides of an extremum near `guess`, in a piece that contains it.
    fn around_extremum(&self, from: &Jet, to: &Jet, guess: f64, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        let time = root((from.time, to.time), guess, to.is_rising(), |t| self.look_for_extremum(t))?;
        let extremum = self.jet(time)?;
        self.monotonic_side(from, &extremum, report)?;
        if extremum.values[0].abs() <= GRAZING {
            report(Event::Grazing { time });
        }
        self.monotonic_side(&extremum, to, report)
    }

    fn monotonic_side(&self, from: &Jet, to: &Jet, report: &mut impl FnMut(Event)) -> Result<(), Error> {
        if from.is_positive() == to.is_positive() {
            return Ok(());
        }
        self.crossing(from, to, &self.quintic(from, to), report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observables::pulsar::margin::tests::search_of;

    /// Times of crossings (with `true` if upwards), and of grazings.
    fn found<P: Margin>(search: &EdgeSearch<P>, from: f64, to: f64) -> (Vec<(f64, bool)>, Vec<f64>) {
        let (mut crossings, mut grazings) = (Vec::new(), Vec::new());
        let start = search.jet(from).unwrap();
        search
            .events(start, to, &mut |event| match event {
                Event::Crossing { time, entering } => crossings.push((time, entering)),
                Event::Grazing { time } => grazings.push(time),
            })
            .unwrap();
        (crossings, grazings)
    }

    fn jet(time: f64, values: [f64; 4]) -> Jet {
        Jet { time, values }
    }

    /// A margin of which only the error is used.
    struct Known(f64);

    impl Margin for Known {
        fn at(&self, _: f64) -> Result<[f64; 4], Error> {
            panic!("nobody looks")
        }

        fn cheapest_time(&self, _: f64, t: f64) -> f64 {
            t
        }

        fn estimated_error(&self, t: f64) -> f64 {
            self.0 * t
        }
    }

    /// A third derivative that is inconsistent with values of zero: by 0.3, which the sixth derivative leaves open, and by 300
    /// errors of the later value.
    #[test]
    fn a_law_that_the_values_do_not_follow_is_refused() {
        let bounds = RateBounds { first: 1.0, second: 1.0, third: 1.0, fourth: 1.0, sixth: 2.4 };
        for (error, from, to, allowed) in
            [(0.0, 5.0, 6.0, 0.32), (0.01, 1.0, 2.0, 6.32), (0.0, 1.0, 3.0, 1.58), (0.01, -1.5, 0.5, 3.08)]
        {
            let search = EdgeSearch::new(Known(error), bounds);
            let cubed = f64::powi(to - from, 3);
            for sign in [1.0, -1.0] {
                let check = |mismatch: f64| {
                    let start = jet(from, [0.0, 0.0, 0.0, sign * mismatch / cubed]);
                    search.check_stated_law(&start, &jet(to, [0.0; 4]))
                };
                assert!(check(allowed - 1e-9).is_ok() && check(allowed + 1e-9).is_err(), "{error} {from} {to}");
            }
        }
    }

    #[test]
    fn bounds_tell_where_a_slope_and_a_curvature_keep_their_signs() {
        let bounds = RateBounds { first: 1.0, second: 1.0, third: 1.0, fourth: 1.0, sixth: 1.0 };
        let with = |bounds| EdgeSearch::new(search_of(vec![[1.0, 1.0, 0.0]], 0.5).margin, bounds);
        let ends = |a: f64, b: f64, length: f64| (jet(3.0, [0.0, a, a, 0.0]), jet(3.0 + length, [0.0, b, b, 0.0]));
        for (a, b, length, is_certain) in [
            (0.3, 0.4, 0.5, true),
            (-0.3, -0.4, 0.5, true),
            (0.3, 0.4, 0.75, false),
            (0.3, -0.4, 0.05, false),
            (0.3, 1.4, 1.6, true),
        ] {
            let (from, to) = ends(a, b, length);
            assert_eq!(with(bounds).is_steep(&from, &to), is_certain);
            assert_eq!(with(bounds).is_curved(&from, &to), is_certain.then_some(a > 0.0));
        }
        // Sixteen roundings of the largest possible rate.
        for (largest, is_certain) in [(5.5e14, true), (5.7e14, false)] {
            let (from, to) = ends(1.0, 1.0, 1.0);
            let rounded = RateBounds { first: largest, second: 0.0, third: 0.0, ..bounds };
            assert_eq!(with(rounded).is_steep(&from, &to), is_certain);
            let rounded = RateBounds { second: largest, third: 0.0, ..bounds };
            assert_eq!(with(rounded).is_curved(&from, &to).is_some(), is_certain);
        }
    }

    /// Narrow pulses and narrow gaps of a single wave, with the number of evaluations.
    #[test]
    fn extrema_near_the_edge_are_found_with_few_looks() {
        let mut looks = 0;
        for exponent in 1..=12 {
            let below = 10f64.powi(-exponent);
            for sign in [1.0, -1.0] {
                for offset in [0.0, 0.37, 0.9, -0.6] {
                    // From the middle of a span of 3.1 to either side.
                    let search = search_of(vec![[sign, 1.0, offset]], sign * (1.0 - below));
                    let (crossings, grazings) = found(&search, -offset - 3.1, -offset + 3.0);
                    assert!(grazings.is_empty() && crossings.len() == 2, "{exponent} {sign} {offset}: {crossings:?}");
                    let half = 2.0 * (below / 2.0).sqrt().asin();
                    for ((time, entering), (exact, is_entering)) in
                        crossings.iter().zip([(-half, sign > 0.0), (half, sign < 0.0)])
                    {
                        assert_eq!(*entering, is_entering);
                        let error = (time + offset - exact).abs();
                        assert!(error < 4e-16 / half + 4e-16, "{exponent}: {error:e}");
                    }
                    looks += search.margin.1.get();
                }
            }
        }
        assert!(looks <= 1440, "{looks} looks");
    }

    /// For slow and fast stars: `near` and `short` are measured in radians.
    #[test]
    fn grazings_are_told_on_either_side_of_the_edge() {
        for w in [1.0, 1e-7, 3e-3, 40.0, 1e6] {
            for (below, crossings, grazings) in
                [(5e-14, 2, 1), (0.0, 0, 1), (-5e-14, 0, 1), (3e-13, 2, 0), (-3e-13, 0, 0), (-1e-3, 0, 0)]
            {
                for (sign, offset) in [(1.0, 0.1), (1.0, -0.8), (-1.0, 0.1), (-1.0, -0.8)] {
                    let search = search_of(vec![[sign, w, 0.0]], sign * (1.0 - below));
                    let events = found(&search, (-1.0 + offset) / w, (1.0 + offset) / w);
                    // Exactly at the edge rounding decides.
                    assert!(events.0.len() == crossings || below.abs() < 1e-15, "{w} {below:e}: {events:?}");
                    assert_eq!(events.1.len(), grazings, "{w} {below:e}: {events:?}");
                    assert!(events.1.iter().all(|time| (time * w).abs() < 1e-9));
                }
            }
        }
    }

    /// Pieces that begin or end within a ten-millionth of a radian of an extremum, which is 5e-14 inside.
    #[test]
    fn a_piece_that_begins_near_a_grazing_reports_it_only_if_it_holds_it() {
        let events = |from: f64, to: f64, second: f64| {
            let search = search_of(vec![[1.0, 1.0, 0.0]], 1.0 - 5e-14);
            let search = EdgeSearch::new(search.margin, RateBounds { second, ..search.bounds });
            let (mut crossings, mut grazings) = (Vec::new(), Vec::new());
            let report = &mut |event| match event {
                Event::Crossing { time, entering } => crossings.push((time, entering)),
                Event::Grazing { time } => grazings.push(time),
            };
            search.piece(&search.jet(from).unwrap(), &search.jet(to).unwrap(), report).unwrap();
            (crossings, grazings)
        };
        let edge = 1e-13_f64.sqrt();
        // The inner end is before the top, or after it; the other end is outside.
        for (from, to, second, holds_top) in [(-1e-7, 0.3, 1.0, true), (1e-13, 0.04, 1.0, false)] {
            for sign in [1.0, -1.0] {
                let (a, b) = if sign > 0.0 { (from, to) } else { (-to, -from) };
                let (crossings, grazings) = events(a, b, second);
                assert_eq!(grazings.len(), usize::from(holds_top), "{from} {sign}");
                assert!(grazings.iter().all(|time| time.abs() < 1e-9), "{grazings:?}");
                // To the rounding of the margin.
                let is_edge =
                    |(time, entering): (f64, bool)| entering != (sign > 0.0) && (time * sign - edge).abs() < 3e-9;
                assert!(crossings.len() == 1 && is_edge(crossings[0]), "{crossings:?}");
            }
        }
        // All on one side of the top, with bounds too wide to decide.
        assert_eq!(events(1e-13, 2e-7, 2.0), (vec![], vec![]));
    }

    #[test]
    fn a_piece_may_end_at_an_extremum() {
        let search = search_of(vec![[1.0, 1.0, 0.0]], 1.0 + 1e-10);
        assert_eq!(search.jet(0.0).unwrap().values[1], 0.0);
        assert_eq!(found(&search, -1.0, 0.0), (vec![], vec![]));
    }
}
