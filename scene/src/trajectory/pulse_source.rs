//! The pulses of one beam, combined from those of the segments of a motion, with their turn numbers.

use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::observables::pulsar::{Arrival, Beam, Pulse, PulseTrain, arrivals, pulse_train};
use twofold::propagation::Motion;

use crate::samples::Segment;

/// One beam with its line of sight, and the pulse that has not ended yet.
pub(super) struct Source {
    pub(super) number: usize,
    pub(super) beam: Beam<f64>,
    line_of_sight: Vector3<f64>,
    pub(super) seen: usize,
    open: Option<Unfinished>,
    last_midpoint: Option<f64>,
    /// Turns counted up to the end of the last segment.
    turns: i64,
    first_turn: Option<i64>,
    /// The reason why turns are no longer counted, if that is the case.
    pub(super) uncounted: Option<Error>,
    /// Number of whole pulses without a turn for that reason.
    pub(super) without_turn: usize,
}

/// A pulse with its position in the train of its beam.
pub(super) struct Numbered {
    pub(super) beam: usize,
    pub(super) number: usize,
    pub(super) pulse: Pulse,
    /// Time between the midpoints of this pulse and of the previous one, if both are whole.
    pub(super) period: Option<f64>,
    /// For a whole pulse: turn of the star, zero for the first whole pulse, and time of the closest approach.
    pub(super) arrival: Option<(i64, f64)>,
}

struct Unfinished {
    pulse: Pulse,
    approach: Option<Approach>,
}

/// The closest approach of the magnetic axis to the line of sight.
#[derive(Clone, Copy)]
struct Approach {
    turn: i64,
    time: f64,
    margin: f64,
}

impl Source {
    pub(super) fn new(number: usize, beam: Beam<f64>, line_of_sight: Vector3<f64>) -> Self {
        Self {
            number,
            beam,
            line_of_sight,
            seen: 0,
            open: None,
            last_midpoint: None,
            turns: 0,
            first_turn: None,
            uncounted: None,
            without_turn: 0,
        }
    }

    /// Whether the magnetic axis is off the edge of the beam, and whether, for the count of turns, it is not opposite to the
    /// line of sight.
    pub(super) fn is_clear_at(&self, segment: &Segment<BodyState<f64>>, time: f64) -> Result<(bool, bool), Error> {
        const CLEAR: f64 = 1e-6;
        let state = segment.motion.state(time)?;
        let (l, n, m) = (state.momentum.normalize(), &self.line_of_sight, self.beam.direction(&state));
        let (x, y) = (n.dot(&m) - l.dot(n) * l.dot(&m), l.dot(&n.cross(&m)));
        Ok((self.beam.margin(&state, n).abs() > CLEAR, x > CLEAR || y.abs() > CLEAR))
    }

    /// The pulses that have ended by the time `to` of an interval, in the order of the motion, and the times of grazing.
    pub(super) fn take(
        &mut self,
        segment: &Segment<BodyState<f64>>,
        to: f64,
    ) -> Result<(Vec<Numbered>, Vec<f64>), Error> {
        let backwards = to < segment.from;
        let mut train = pulse_train(&segment.motion, &self.beam, &self.line_of_sight, (segment.from, to))?;
        if backwards {
            train.pulses.reverse();
        }
        let begins_cut = |pulse: &Pulse| if backwards { pulse.cut_at_end } else { pulse.cut_at_start };
        let lasts = |pulse: &Pulse| if backwards { pulse.cut_at_start } else { pulse.cut_at_end };
        let open = self.open.take();
        // Only a pulse that may become whole has a closest approach.
        let goes_on = open.as_ref().is_some_and(|open| !begins_cut(&open.pulse));
        let wanted = |(i, pulse): (usize, &Pulse)| {
            (!begins_cut(pulse) || i == 0 && goes_on) && !(segment.is_last && lasts(pulse))
        };
        let wanted: Vec<bool> = train.pulses.iter().enumerate().map(wanted).collect();
        let approaches = self.approaches(segment, to, &train.pulses, &wanted)?;
        let pairs = train.pulses.into_iter().zip(approaches);
        let mut found: Vec<_> = pairs.map(|(pulse, approach)| Unfinished { pulse, approach }).collect();
        if let Some(open) = open {
            match found.first_mut().filter(|next| begins_cut(&next.pulse)) {
                Some(next) => next.continue_from(open, backwards),
                None => found.insert(0, open),
            }
        }
        if !segment.is_last {
            self.open = found.pop_if(|last| lasts(&last.pulse));
        }
        Ok((found.into_iter().map(|pulse| self.numbered(&pulse)).collect(), train.grazings))
    }

    /// The closest approach in each of the requested pulses, with turns counted on from the previous segment.
    fn approaches(
        &mut self,
        segment: &Segment<BodyState<f64>>,
        to: f64,
        pulses: &[Pulse],
        wanted: &[bool],
    ) -> Result<Vec<Option<Approach>>, Error> {
        if self.uncounted.is_some() {
            return Ok(vec![None; pulses.len()]);
        }
        let whole = |start, end| Pulse { start, end, cut_at_start: false, cut_at_end: false };
        // Pulses of zero length at both ends link the count to those of the neighbouring segments.
        let mut parts = vec![whole(segment.from, segment.from)];
        parts.extend(pulses.iter().zip(wanted).filter(|(_, wanted)| **wanted).map(|(p, _)| whole(p.start, p.end)));
        parts.push(whole(to, to));
        let backwards = to < segment.from;
        if backwards {
            parts.reverse();
        }
        let train = PulseTrain { pulses: parts, grazings: Vec::new() };
        let mut found = match arrivals(&segment.motion, &self.beam, &self.line_of_sight, &train) {
            Ok(found) => found,
            Err(why) => {
                self.uncounted = Some(why);
                return Ok(vec![None; pulses.len()]);
            }
        };
        if backwards {
            found.reverse();
        }
        let before = self.turns - found[0].number;
        self.turns = before + found[found.len() - 1].number;
        let mut found = found.into_iter().skip(1);
        let approach = |Arrival { number, closest_approach: time, .. }| {
            let margin = self.beam.margin(&segment.motion.state(time)?, &self.line_of_sight);
            Ok(Approach { turn: before + number, time, margin })
        };
        let mut next = |wanted: &bool| wanted.then(|| found.next()).flatten().map(approach).transpose();
        wanted.iter().map(&mut next).collect()
    }

    fn numbered(&mut self, Unfinished { pulse, approach }: &Unfinished) -> Numbered {
        self.seen += 1;
        let midpoint = pulse.is_whole().then(|| pulse.midpoint());
        let period = midpoint.zip(self.last_midpoint).map(|(this, last)| (this - last).abs());
        self.last_midpoint = midpoint;
        let arrival = approach
            .filter(|_| pulse.is_whole() && self.uncounted.is_none())
            .map(|approach| (approach.turn - *self.first_turn.get_or_insert(approach.turn), approach.time));
        self.without_turn += usize::from(pulse.is_whole() && arrival.is_none());
        Numbered { beam: self.number, number: self.seen, pulse: *pulse, period, arrival }
    }
}

impl Unfinished {
    /// Joins the part of the pulse in the previous segments. The flags are those of the outer ends.
    fn continue_from(&mut self, open: Unfinished, backwards: bool) {
        if backwards {
            (self.pulse.end, self.pulse.cut_at_end) = (open.pulse.end, open.pulse.cut_at_end);
        } else {
            (self.pulse.start, self.pulse.cut_at_start) = (open.pulse.start, open.pulse.cut_at_start);
        }
        let higher = |one: &Approach, other: &Approach| one.margin.total_cmp(&other.margin);
        self.approach = self.approach.into_iter().chain(open.approach).max_by(higher);
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::{PI, TAU};

    use twofold::dynamics::{Problem, RigidSpheroid};
    use twofold::plan::Output;

    use super::*;
    use crate::samples::Segments;
    use crate::scene_file::{Scene, Times};

    pub(in super::super) const THETA_O: f64 = 0.8;

    /// A free star without wobble that rotates once about Z per unit of time, by 3.25 turns, with its magnetic axis towards the observer at
    /// zero.
    pub(in super::super) fn scene(sense: f64) -> Scene {
        let mut scene = Scene::named("free").unwrap();
        let axis = Vector3::z();
        let start = BodyState { axis, momentum: axis * (1.1 * TAU), equatorial_axis: Vector3::x() };
        scene.problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), nalgebra::Matrix3::zeros(), start).unwrap();
        scene.times = Times::Listed { start: 0.0, times: vec![sense * 3.25] };
        scene
    }

    /// The motion of that star, and one of its beams, at `chi`.
    pub(in super::super) fn segment(chi: f64, rho: f64, sense: f64) -> (Source, Segment<BodyState<f64>>) {
        let scene = scene(sense);
        let plan = scene.plan(&[Output::Pulses]).unwrap();
        let segment = Segments::new(&scene, &plan).unwrap().next().unwrap().expect("a segment");
        let line_of_sight = Vector3::new(THETA_O.sin(), 0.0, THETA_O.cos());
        (Source::new(1, Beam::new(chi, 0.0, rho), line_of_sight), segment)
    }

    /// Time from the closest approach to the edge of the beam: `m.n = cos chi cos theta_o + sin chi sin theta_o cos phi` is `cos rho` there.
    pub(in super::super) fn edge(chi: f64, rho: f64) -> f64 {
        ((rho.cos() - chi.cos() * THETA_O.cos()) / (chi.sin() * THETA_O.sin())).acos() / TAU
    }

    /// The magnetic axis is opposite to the observer half a turn later.
    #[test]
    fn the_axis_is_clear_off_the_edges_and_off_half_a_turn() {
        let (chi, rho) = (0.6, 0.5);
        let edge = edge(chi, rho);
        for sense in [1.0, -1.0] {
            let (source, segment) = segment(chi, rho, sense);
            let clear = |turns: f64| source.is_clear_at(&segment, sense * turns).unwrap();
            for turn in [0.0, 1.0] {
                for edge in [turn + edge, turn + 1.0 - edge] {
                    assert_eq!(clear(edge), (false, true));
                    // A turn has the margin 2 pi sin chi sin theta_o sin phi: some 1e-6 are beyond 1e-6.
                    assert_eq!([clear(edge + 3e-6), clear(edge - 3e-6)], [(true, true); 2]);
                }
                assert_eq!([clear(turn), clear(turn + 0.25), clear(turn + 0.75)], [(true, true); 3]);
                assert_eq!(clear(turn + 0.5), (true, false));
                assert_eq!([clear(turn + 0.5 + 1e-6), clear(turn + 0.5 - 1e-6)], [(true, true); 2]);
            }
        }
    }

    /// A pulse that lasted to the end of the previous segment has ended if none continues; turns are counted without a
    /// break.
    #[test]
    fn a_pulse_that_does_not_go_on_comes_first() {
        for sense in [1.0, -1.0] {
            let (mut source, segment) = segment(PI - THETA_O, 0.1, sense);
            let (start, end) = if sense > 0.0 { (-0.25, -0.125) } else { (0.125, 0.25) };
            let pulse = Pulse { start, end, cut_at_start: false, cut_at_end: false };
            source.open = Some(Unfinished { pulse, approach: None });
            let (found, grazings) = source.take(&segment, segment.to).unwrap();
            assert_eq!((found.len(), grazings.len()), (1, 0));
            assert_eq!((found[0].pulse, found[0].number, found[0].arrival), (pulse, 1, None));
            assert_eq!(source.turns, 3 * sense as i64);
        }
    }
}
