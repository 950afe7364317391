//! The pulses of a scene, one row each.

use std::io::{self, Write};

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::observables::pulsar::Beam;
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::plan::{Counted, Output, PlannedMotion, Work};
use twofold::propagation::Motion;

use super::TrajectoryError;
use super::pulse_source::{Numbered, Source};
use crate::samples::{Segment, Segments};
use crate::scene_file::Scene;

/// Counts of a table of pulses.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PulseSummary {
    /// Number of pulses written, for each beam.
    pub pulses: Vec<usize>,
    /// Extrema of m.n so close to the edge of a beam that rounding decides whether there is a pulse.
    pub grazings: usize,
    /// Time of the first such extremum.
    pub first_grazing: Option<f64>,
    /// Beams with whole pulses whose turns cannot be counted, the number of these pulses, and the reason.
    pub without_turn: Vec<(usize, usize, Error)>,
    /// The work done.
    pub work: Work,
}

fn header(scene: &Scene) -> Vec<String> {
    let time = scene.units.time_name;
    let mut names = vec!["beam".to_owned(), "pulse".to_owned()];
    names.extend(["start", "end", "midpoint", "duration"].map(|name| format!("{name} [{time}]")));
    names.extend(["cut".to_owned(), format!("period [{time}]"), "turn".to_owned()]);
    names.extend([format!("closest_approach [{time}]"), "W_56 [rad]".to_owned()]);
    names
}

/// Writes every pulse of the span of `scene` as CSV, in order of the time at which it ends. Memory is bounded whatever the
/// span; a pulse that extends from one segment of the motion to the next is one pulse. `progress` receives the fraction of the span that is done, from 0
/// to 1; its error ends the work.
pub fn write_pulses(
    scene: &Scene,
    writer: impl Write,
    progress: impl FnMut(f64) -> io::Result<()>,
) -> Result<PulseSummary, TrajectoryError> {
    let plan = scene.plan(&[Output::Pulses])?;
    write_by_segments(scene, Segments::new(scene, &plan)?, writer, progress)
}

pub(super) fn write_by_segments(
    scene: &Scene,
    mut segments: Segments<'_, BodyState<f64>>,
    writer: impl Write,
    mut progress: impl FnMut(f64) -> io::Result<()>,
) -> Result<PulseSummary, TrajectoryError> {
    let (Some(viewer), Some(pulsar)) = (scene.observer, scene.pulsar) else {
        return Err(TrajectoryError::Incomplete(
            scene.has_what_is_needed_for(Output::Pulses).err().unwrap_or_default(),
        ));
    };
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(header(scene))?;
    let line_of_sight = viewer.basis().direction;
    let mut sources = vec![Source::new(1, pulsar.beam(), line_of_sight)];
    if pulsar.second_beam {
        sources.push(Source::new(2, pulsar.beam().opposite(), line_of_sight));
    }
    let mut summary = PulseSummary::default();
    let mut last_motion: Option<Counted<PlannedMotion>> = None;
    while let Some(segment) = segments.next()? {
        let to = if segment.is_last { segment.to } else { cut(scene, &segment, &sources)? };
        let mut complete = Vec::new();
        for source in &mut sources {
            let (pulses, grazings) = source.take(&segment, to)?;
            complete.extend(pulses);
            for time in grazings {
                summary.grazings += 1;
                summary.first_grazing.get_or_insert(scene.output_time(time));
            }
        }
        let backwards = to < segment.from;
        complete.sort_by(|a, b| {
            let over = |numbered: &Numbered| if backwards { -numbered.pulse.start } else { numbered.pulse.end };
            over(a).total_cmp(&over(b)).then(a.beam.cmp(&b.beam))
        });
        for numbered in &complete {
            let beam = &sources[numbered.beam - 1].beam;
            let width = numbered.pulse.is_whole().then(|| {
                let motions = [Some(&segment.motion), last_motion.as_ref()];
                width_at(numbered.pulse.midpoint(), motions, beam, viewer.theta_o)
            });
            numbered.write(scene, width.flatten(), &mut table)?;
        }
        segments.resume_at(&segment, to)?;
        progress(scene.part_done(to))?;
        if let Some(last) = last_motion.replace(segment.motion) {
            summary.work += last.evaluations();
        }
    }
    table.flush()?;
    summary.work += segments.work;
    summary.work += last_motion.map(|last| last.evaluations()).unwrap_or_default();
    summary.pulses = sources.iter().map(|source| source.seen).collect();
    summary.without_turn = sources
        .into_iter()
        .filter(|source| source.without_turn > 0)
        .filter_map(|source| source.uncounted.map(|why| (source.number, source.without_turn, why)))
        .collect();
    Ok(summary)
}

/// A time near the end of the segment at which every source is clear: with a cut there, rounding cannot split a pulse or
/// count a pulse or a turn twice. If the count of turns is nowhere clear, as for a beam along the axis of rotation, it
/// is left to rounding.
fn cut(scene: &Scene, segment: &Segment<BodyState<f64>>, sources: &[Source]) -> Result<f64, Error> {
    const TRIES: usize = 1000;
    const ROTATION_PER_TRY: f64 = 0.35;
    let half = (segment.from - segment.to) / 2.0;
    let step = (ROTATION_PER_TRY / scene.turning_rate()).copysign(half);
    let mut off_edges = None;
    for k in 0..TRIES {
        let back = step * k as f64;
        let time = segment.to + if back.abs() < half.abs() { back } else { half };
        let clear = sources.iter().map(|source| source.is_clear_at(segment, time)).collect::<Result<Vec<_>, _>>()?;
        if clear.iter().all(|(off_edge, _)| *off_edge) {
            off_edges.get_or_insert(time);
            if clear.iter().all(|(_, off_half_turn)| *off_half_turn) {
                return Ok(time);
            }
        }
    }
    Ok(off_edges.unwrap_or(segment.to))
}

impl Numbered {
    fn write(&self, scene: &Scene, width: Option<f64>, table: &mut csv::Writer<impl Write>) -> Result<(), csv::Error> {
        let (pulse, unit) = (&self.pulse, scene.units.time);
        let cut = match (pulse.cut_at_start, pulse.cut_at_end) {
            (false, false) => "",
            (true, false) => "start",
            (false, true) => "end",
            (true, true) => "both",
        };
        let optional = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
        let number = |value: f64| format!("{value:?}");
        table.write_record([
            self.beam.to_string(),
            self.number.to_string(),
            number(scene.output_time(pulse.start)),
            number(scene.output_time(pulse.end)),
            number(scene.output_time(pulse.midpoint())),
            number(pulse.duration() * unit),
            cut.to_owned(),
            optional(self.period.map(|period| period * unit)),
            self.arrival.map_or(String::new(), |(turn, _)| turn.to_string()),
            optional(self.arrival.map(|(_, time)| scene.output_time(time))),
            optional(width),
        ])
    }
}

/// The width of Eq. (56) at a time that one of the motions contains; `None` if the formula gives no pulse.
fn width_at(time: f64, motions: [Option<&Counted<PlannedMotion>>; 2], beam: &Beam<f64>, theta_o: f64) -> Option<f64> {
    let state = motions.into_iter().flatten().find_map(|motion| motion.state(time).ok())?;
    let m = beam.direction(&state);
    match pulse_width(beam.half_opening, m.x.hypot(m.y).atan2(m.z), theta_o) {
        PulseWidth::Pulsed(width) => Some(width),
        PulseWidth::AlwaysOn | PulseWidth::NeverOn => None,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use twofold::dynamics::BodyState;

    use super::super::pulse_source::tests::{self, THETA_O, scene, segment};
    use super::*;
    use crate::scene_file::{Pulsar, Viewer};

    /// The cut is a third of a radian before an end at which the magnetic axis is on the edge of the beam, or opposite to the observer; in a
    /// shorter segment it is at the middle.
    #[test]
    fn a_segment_is_cut_where_every_beam_is_clear() {
        for sense in [1.0, -1.0] {
            let scene = scene(sense);
            let step = 0.35 / scene.turning_rate();
            let (source, mut segment) = segment(0.6, 0.5, sense);
            let edge = tests::edge(0.6, 0.5);
            let sources = [source];
            for (to, expected) in
                [(2.25, 2.25), (2.5, 2.5 - step), (2.0 + edge, 2.0 + edge - step), (3.0 - edge, 3.0 - edge - step)]
            {
                segment.to = sense * to;
                let found = cut(&scene, &segment, &sources).unwrap();
                assert!((found - sense * expected).abs() < 1e-14, "{to} {found}");
            }
            (segment.from, segment.to) = (sense * 2.49, sense * 2.5);
            assert!((cut(&scene, &segment, &sources).unwrap() - sense * 2.495).abs() < 1e-14);
            // A beam along the axis of rotation is never away from half a turn: the other one is off its edge.
            let [first] = sources;
            let sources = [first, tests::segment(0.0, 0.5, sense).0];
            (segment.from, segment.to) = (0.0, sense * (2.0 + edge));
            let found = cut(&scene, &segment, &sources).unwrap();
            assert!((found - sense * (2.0 + edge - step)).abs() < 1e-14, "{found}");
        }
    }

    /// The beam just reaches the observer once per turn: at three quarters of each.
    #[test]
    fn pulses_of_no_length_are_counted_as_grazing() {
        let mut scene = scene(1.0);
        let start = BodyState { equatorial_axis: Vector3::y(), ..*scene.problem.initial() };
        scene.problem = scene.problem.starting_from(start).unwrap();
        scene.observer = Some(Viewer { theta_o: THETA_O, phi_o: 0.0, distance: None });
        scene.pulsar = Some(Pulsar { chi: THETA_O - 0.25, delta: 0.0, rho: 0.25, second_beam: false });
        let summary = write_pulses(&scene, Vec::new(), |_| Ok(())).unwrap();
        assert_eq!((summary.grazings, summary.without_turn.len()), (3, 0));
        assert!((summary.first_grazing.unwrap() - 0.75).abs() < 1e-7, "{:?}", summary.first_grazing);
    }

    /// Four segments evaluate the motion about as often as one, and report where each of them ends.
    #[test]
    fn work_and_progress_are_those_of_all_segments() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.choose_method("taylor").unwrap();
        let plan = scene.plan(&[Output::Pulses]).unwrap();
        let of = |segments: f64| {
            let mut shown = Vec::new();
            let segments = Segments::with_rotation(&scene, &plan, 1.001 * scene.rotation() / segments).unwrap();
            let summary = write_by_segments(&scene, segments, Vec::new(), |part| {
                shown.push(part);
                Ok(())
            })
            .unwrap();
            let evaluations = summary.work.axis_evaluations + summary.work.orientation_evaluations;
            ([summary.work.steps, summary.work.right_hand_sides, evaluations], shown)
        };
        let (one, shown) = of(1.0);
        assert_eq!(shown, [1.0]);
        let (four, shown) = of(4.0);
        assert!(one[0] > 10.0 && one[1] > 10.0 * one[0], "steps of a series of many terms: {one:?}");
        for (one, four) in one.into_iter().zip(four) {
            assert!((0.9 * one..1.2 * one).contains(&four), "{one} {four}");
        }
        // Each is cut at most some radians before its end.
        let ends = [0.25, 0.5, 0.75, 1.0].map(|end| end - 3.0 / scene.rotation()..=end);
        assert!(shown.len() == 4 && ends.iter().zip(&shown).all(|(range, part)| range.contains(part)), "{shown:?}");
    }
}
