//! The pulse train of a motion: all time intervals in which the line of sight is inside the beam. Eq. (44).
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::observables::Observer;
//! use twofold::observables::pulsar::{Beam, arrivals, pulse_train};
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?;
//! let (beam, sight) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0).direction);
//! let motion = problem.taylor((0.0, 50.0), 1e-13)?;
//! let train = pulse_train(&motion, &beam, &sight, (0.0, 50.0))?;
//! assert!(train.durations().count() > 5);
//! let numbered = arrivals(&motion, &beam, &sight, &train)?;
//! assert!(numbered.windows(2).all(|pair| pair[0].number < pair[1].number));
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::Vector3;

use super::Beam;
pub use super::edge_search::GRAZING;
use super::edge_search::{EdgeSearch, Event};
use super::margin::{BySeries, ByStates, Margin};
use super::rate_bounds::RateBounds;
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::propagation::Motion;

/// A time interval with `m.n > cos rho`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Time at which the line of sight enters the beam, or the start of the span.
    pub start: f64,
    /// Time at which it leaves, or the end of the span.
    pub end: f64,
    /// Whether the line of sight was already inside at the start of the span.
    pub cut_at_start: bool,
    /// Whether the line of sight is still inside at the end of the span.
    pub cut_at_end: bool,
}

impl Pulse {
    /// Midpoint between the edges.
    pub fn midpoint(&self) -> f64 {
        self.start + (self.end - self.start) / 2.0
    }

    /// Duration.
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }

    /// Whether both edges are within the span of the train.
    pub fn is_whole(&self) -> bool {
        !self.cut_at_start && !self.cut_at_end
    }
}

/// A value of a series with its time stamp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stamped {
    /// Time stamp.
    pub time: f64,
    /// Value.
    pub value: f64,
}

/// The pulses of one beam in a span of time, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseTrain {
    /// The pulses. The list is empty for a line of sight that is never inside; it has one pulse, cut at both ends, for one
    /// that always is.
    pub pulses: Vec<Pulse>,
    /// Times of extrema of `m.n` within [`GRAZING`] of `cos rho`. Whether there is a pulse, or a gap between two, at such a
    /// time is decided by rounding.
    pub grazings: Vec<f64>,
}

impl PulseTrain {
    /// The paper's period series: the time between the midpoints of consecutive whole pulses, stamped at the mean of the two.
    pub fn periods(&self) -> impl Iterator<Item = Stamped> {
        let whole = |pair: &&[Pulse]| pair.iter().all(Pulse::is_whole);
        self.pulses.windows(2).filter(whole).map(|pair| {
            let (first, second) = (pair[0].midpoint(), pair[1].midpoint());
            Stamped { time: first + (second - first) / 2.0, value: second - first }
        })
    }

    /// The paper's width series: the duration of each whole pulse, stamped at its midpoint.
    pub fn durations(&self) -> impl Iterator<Item = Stamped> {
        let whole = self.pulses.iter().filter(|pulse| pulse.is_whole());
        whole.map(|pulse| Stamped { time: pulse.midpoint(), value: pulse.duration() })
    }
}

/// Every pulse of a beam in a span of a motion, Eq. (44) `[ineq]`. No pulse is missed and none is spurious, except where an extremum
/// of `m.n` is within [`GRAZING`], 1e-13, of `cos rho`. There rounding decides; the time is listed in
/// [`grazings`](PulseTrain::grazings).
///
/// `line_of_sight` is the unit vector `n` towards the observer in the frame of the motion; `span` is within the span of the
/// motion, its ends in either order. For the second beam of the star use [`Beam::opposite`].
///
/// The span is subdivided until `m.n` and its derivatives at the ends of a piece, with a bound on the sixth derivative, prove that the piece contains
/// no edge, or one edge, or one extremum. An edge is then a root between two times of different sign. Derivatives and bounds are those of
/// [`Motion::turning`]: from the equations of motion, with bounds from energy and spin, or as stated by a motion under another law. This holds for
/// the exact motion; a numerical one adds its error, see [`error_estimate`](crate::propagation::Motion::error_estimate). The accuracy of the edges is
/// limited by `m.n`: its error divided by its rate, about 1e-16 over the rotation rate plus the rounding of `t`. It is worse for a short pulse, whose
/// `m.n` varies slowly at the edges (a pulse of the length `w` radian multiplies the error by about `2 / w`).
///
/// # Errors
/// [`Error::Domain`] for a span outside that of the motion, vectors that are not of unit length (to 1e-9), a semi-open angle outside (0, pi), a
/// motion that is not finite or rotates faster than it states, a line of sight that stays on the edge of the beam to [`GRAZING`] for a while, a span
/// of more than [`MOST_COUNTED`](crate::propagation::MOST_COUNTED) radian by the bound on `|Omega|`, and times at which doubles do not resolve 0.2
/// rad.
pub fn pulse_train<M: Motion<f64, State = BodyState<f64>>>(
    motion: &M,
    beam: &Beam<f64>,
    line_of_sight: &Vector3<f64>,
    span: (f64, f64),
) -> Result<PulseTrain, Error> {
    check_beam(beam, line_of_sight)?;
    let (from, to) = if span.0 <= span.1 { span } else { (span.1, span.0) };
    let turning = motion.turning();
    let bounds = RateBounds::of_motion(motion, &turning, from)?;
    match motion.projection(&beam.axis, line_of_sight) {
        Some(projection) => EdgeSearch::new(BySeries::new(&projection, beam), bounds).train(from, to),
        None => EdgeSearch::new(ByStates { motion, turning, beam, line_of_sight }, bounds).train(from, to),
    }
}

impl<P: Margin> EdgeSearch<P> {
    /// The pulses between two times in ascending order.
    pub(super) fn train(&self, from: f64, to: f64) -> Result<PulseTrain, Error> {
        self.bounds.check_countable(from, to)?;
        let start = self.jet(from)?;
        // A motion that does not extend so far is refused before the work begins.
        self.at(to)?;
        let (mut pulses, mut grazings) = (Vec::new(), Vec::new());
        // Start of the pulse that has not ended yet, and whether it was cut there.
        let mut open = start.is_positive().then_some((start.time, true));
        self.events(start, to, &mut |event| match event {
            Event::Grazing { time } => grazings.push(time),
            Event::Crossing { time, entering: true } => open = Some((time, false)),
            Event::Crossing { time, entering: false } => {
                if let Some((start, cut_at_start)) = open.take() {
                    pulses.push(Pulse { start, end: time, cut_at_start, cut_at_end: false });
                }
            }
        })?;
        if let Some((start, cut_at_start)) = open {
            pulses.push(Pulse { start, end: to, cut_at_start, cut_at_end: true });
        }
        Ok(PulseTrain { pulses, grazings })
    }
}

pub(super) fn check_beam(beam: &Beam<f64>, line_of_sight: &Vector3<f64>) -> Result<(), Error> {
    for (length, name) in [(beam.axis.norm(), "length of the magnetic axis m"), (line_of_sight.norm(), "length of n")] {
        Error::ensure((length - 1.0).abs() < 1e-9, name, length, "1 to within 1e-9")?;
    }
    let opening = beam.half_opening;
    Error::ensure(
        0.0 < opening && opening < core::f64::consts::PI,
        "semi-open angle rho",
        opening,
        "above 0 and below pi rad",
    )
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::{Problem, RigidSpheroid};
    use crate::propagation::TaylorMotion;

    /// A star that spins about Z at one radian per unit of time.
    fn upright() -> TaylorMotion<f64> {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let start = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 1.1, equatorial_axis: Vector3::x() };
        Problem::new(spheroid, Matrix3::zeros(), start).unwrap().taylor((0.0, 30.0), 1e-14).unwrap()
    }

    #[test]
    fn what_is_out_of_domain_is_refused() {
        let (motion, beam, n) = (upright(), Beam::new(0.5, 0.0, 0.3), Vector3::x());
        let refused = |beam: &Beam<f64>, n: &Vector3<f64>, span| pulse_train(&motion, beam, n, span).is_err();
        assert!(!refused(&beam, &n, (0.0, 30.0)) && !refused(&beam, &n, (3.0, 3.0)));
        assert!(refused(&beam, &(n * 1.1), (0.0, 30.0)));
        assert!(refused(&Beam { axis: beam.axis * 0.9, ..beam }, &n, (0.0, 30.0)));
        for opening in [0.0, -0.1, 3.2, f64::NAN] {
            assert!(refused(&Beam { half_opening: opening, ..beam }, &n, (0.0, 30.0)));
        }
        for span in [(0.0, 31.0), (-1.0, 30.0), (f64::NAN, 1.0), (0.0, f64::NAN)] {
            assert!(refused(&beam, &n, span));
        }
    }

    #[test]
    fn line_of_sight_on_the_edge_of_a_beam_at_rest_is_refused() {
        let (motion, n) = (upright(), Vector3::new(0.6, 0.0, 0.8));
        let on_the_pole = |opening| pulse_train(&motion, &Beam::new(0.0, 0.0, opening), &n, (0.0, 30.0));
        let edge = 0.8_f64.acos();
        assert!(on_the_pole(edge).is_err());
        assert!(on_the_pole(edge - 1e-9).unwrap().pulses.is_empty());
        let always = on_the_pole(edge + 1e-9).unwrap();
        assert!(always.pulses.len() == 1 && always.pulses[0].cut_at_start && always.pulses[0].cut_at_end);
        assert!(always.periods().count() == 0 && always.durations().count() == 0);
    }

    #[test]
    fn the_ends_of_a_span_are_in_either_order() -> Result<(), Error> {
        let (motion, beam, n) = (upright(), Beam::new(0.5, 0.0, 1.2), Vector3::x());
        let train = pulse_train(&motion, &beam, &n, (4.0, 25.0))?;
        assert!(train.pulses.len() == 4 && train.pulses.iter().any(Pulse::is_whole), "{train:?}");
        assert_eq!(pulse_train(&motion, &beam, &n, (25.0, 4.0))?, train);
        // From a motion backwards in time.
        let backwards = Problem::new(RigidSpheroid::in_units_of_tc(1.1), Matrix3::zeros(), motion.state(25.0)?)?;
        let found = pulse_train(&backwards.taylor((25.0, 4.0), 1e-14)?, &beam, &n, (4.0, 25.0))?;
        assert_eq!(found.pulses.len(), train.pulses.len());
        for (a, b) in found.pulses.iter().zip(&train.pulses) {
            assert!((a.start - b.start).abs() < 1e-11 && (a.end - b.end).abs() < 1e-11, "{a:?} {b:?}");
        }
        Ok(())
    }

    #[test]
    fn vectors_are_of_unit_length_to_a_billionth() {
        let (beam, n) = (Beam::new(0.5, 0.3, 0.3), Vector3::new(0.6, 0.0, 0.8));
        for (off, refused) in [(0.9e-9, false), (1.1e-9, true)] {
            for length in [1.0 + off, 1.0 - off] {
                assert_eq!(check_beam(&beam, &(n * length)).is_err(), refused, "{length}");
                assert_eq!(check_beam(&Beam { axis: beam.axis * length, ..beam }, &n).is_err(), refused, "{length}");
            }
        }
    }
}
