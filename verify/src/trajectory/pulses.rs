//! The pulses of a scene, one row each.

use std::io::Write;

use nalgebra::Vector3;
use twofold::Error;
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{Beam, Pulse, pulse_train};
use twofold::propagation::{Motion, TaylorMotion};

use super::TrajectoryError;
use super::stretches::{Stretch, Stretches};
use crate::scene_file::{Pulsar, Scene, Viewer};

/// What there is to say about a table of pulses.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PulseSummary {
    /// Pulses written, of each beam.
    pub pulses: Vec<usize>,
    /// Extrema of m.n so near to the edge of a beam that a pulse is there, or missing, by rounding.
    pub grazings: usize,
    /// Time of the first of those.
    pub first_grazing: Option<f64>,
}

/// Names of the columns with their units.
fn header(scene: &Scene) -> Vec<String> {
    let time = scene.units.time_name;
    let mut names = vec!["beam".to_owned(), "pulse".to_owned()];
    names.extend(["start", "end", "midpoint", "duration"].map(|name| format!("{name} [{time}]")));
    names.extend(["cut".to_owned(), format!("period [{time}]"), "W_56 [rad]".to_owned()]);
    names
}

/// Writes every pulse of the span of `scene` as CSV, in order of the time at which it is over. Memory is bounded whatever the
/// span; a pulse that lasts from one stretch of the motion to the next is one pulse.
///
/// # Errors
/// A motion or pulse train that cannot be computed, or `writer` failing.
pub fn write_pulses(
    scene: &Scene,
    (viewer, pulsar): (&Viewer, &Pulsar),
    writer: impl Write,
    mut progress: impl FnMut(f64),
) -> Result<PulseSummary, TrajectoryError> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(header(scene))?;
    let line_of_sight = viewer.basis().direction;
    let mut sources = vec![Source::new(1, pulsar.beam())];
    if pulsar.second_beam {
        sources.push(Source::new(2, pulsar.beam().opposite()));
    }
    let mut summary = PulseSummary::default();
    let mut stretches = Stretches::new(scene);
    let mut last_motion: Option<TaylorMotion<f64>> = None;
    while let Some(stretch) = stretches.next()? {
        let to = if stretch.is_last { stretch.to } else { off_every_edge(&stretch, &sources, &line_of_sight)? };
        let mut complete = Vec::new();
        for source in &mut sources {
            let train = pulse_train(&stretch.motion, &source.beam, &line_of_sight, (stretch.from, to))?;
            for time in &train.grazings {
                summary.grazings += 1;
                summary.first_grazing.get_or_insert(in_output(scene, *time));
            }
            complete.extend(source.take(train.pulses, (stretch.from, to), stretch.is_last));
        }
        let backwards = to < stretch.from;
        complete.sort_by(|a, b| {
            let over = |numbered: &Numbered| if backwards { -numbered.pulse.start } else { numbered.pulse.end };
            over(a).total_cmp(&over(b)).then(a.beam.cmp(&b.beam))
        });
        for numbered in &complete {
            let beam = &sources[numbered.beam - 1].beam;
            let width = numbered.pulse.is_whole().then(|| {
                let motions = [Some(&stretch.motion), last_motion.as_ref()];
                width_at(numbered.pulse.midpoint(), motions, beam, viewer.theta_o)
            });
            numbered.write(scene, width.flatten(), &mut table)?;
        }
        stretches.resume_at(&stretch, to)?;
        progress(stretches.part_done(to));
        last_motion = Some(stretch.motion);
    }
    table.flush()?;
    summary.pulses = sources.iter().map(|source| source.seen).collect();
    Ok(summary)
}

/// A time near the end of the stretch at which it is beyond doubt whether each beam is seen: cut there, no pulse is torn or
/// counted twice by rounding.
fn off_every_edge(stretch: &Stretch, sources: &[Source], line_of_sight: &Vector3<f64>) -> Result<f64, Error> {
    const CLEAR: f64 = 1e-6;
    const TRIES: usize = 1000;
    let mut time = stretch.to;
    for k in 1..=TRIES {
        let state = stretch.motion.state(time)?;
        if sources.iter().all(|source| source.beam.margin(&state, line_of_sight).abs() > CLEAR) {
            break;
        }
        // A stretch is 5e4 rad long: steps of some tenths of a radian.
        time = stretch.to + (stretch.from - stretch.to) * (k as f64 * 7e-6);
    }
    Ok(time)
}

/// One beam, and the pulse that is not over yet.
struct Source {
    number: usize,
    beam: Beam<f64>,
    seen: usize,
    open: Option<Pulse>,
    last_midpoint: Option<f64>,
}

/// A pulse with its place in the train of its beam.
struct Numbered {
    beam: usize,
    number: usize,
    pulse: Pulse,
    /// Time between the midpoints of this pulse and of the one before, if both are whole.
    period: Option<f64>,
}

impl Source {
    fn new(number: usize, beam: Beam<f64>) -> Self {
        Self { number, beam, seen: 0, open: None, last_midpoint: None }
    }

    /// Takes the pulses of a stretch in order of time and gives those that are over, in the order of the motion.
    fn take(&mut self, mut pulses: Vec<Pulse>, (from, to): (f64, f64), is_last: bool) -> Vec<Numbered> {
        let backwards = to < from;
        if backwards {
            pulses.reverse();
        }
        // A pulse cut where the last stretch ended goes on; the flags of the joined one are those of its outer ends.
        if let Some(open) = self.open.take() {
            match pulses.first_mut() {
                Some(next) if backwards && next.cut_at_end => (next.end, next.cut_at_end) = (open.end, open.cut_at_end),
                Some(next) if !backwards && next.cut_at_start => {
                    (next.start, next.cut_at_start) = (open.start, open.cut_at_start);
                }
                _ => pulses.insert(0, open),
            }
        }
        if !is_last {
            let lasts = |pulse: &Pulse| if backwards { pulse.cut_at_start } else { pulse.cut_at_end };
            self.open = pulses.pop_if(|pulse| lasts(pulse));
        }
        pulses.into_iter().map(|pulse| self.numbered(pulse)).collect()
    }

    fn numbered(&mut self, pulse: Pulse) -> Numbered {
        self.seen += 1;
        let midpoint = pulse.is_whole().then(|| pulse.midpoint());
        let period = midpoint.zip(self.last_midpoint).map(|(this, last)| (this - last).abs());
        self.last_midpoint = midpoint;
        Numbered { beam: self.number, number: self.seen, pulse, period }
    }
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
            number(in_output(scene, pulse.start)),
            number(in_output(scene, pulse.end)),
            number(in_output(scene, pulse.midpoint())),
            number(pulse.duration() * unit),
            cut.to_owned(),
            optional(self.period.map(|period| period * unit)),
            optional(width),
        ])
    }
}

/// A time since the start, in t_c, as the output has it.
fn in_output(scene: &Scene, time: f64) -> f64 {
    scene.times.start() + time * scene.units.time
}

/// The width of Eq. (56) with the colatitude of the beam at a time that one of the motions holds; none where the formula has
/// no pulse.
fn width_at(time: f64, motions: [Option<&TaylorMotion<f64>>; 2], beam: &Beam<f64>, theta_o: f64) -> Option<f64> {
    let state = motions.into_iter().flatten().find_map(|motion| motion.state(time).ok())?;
    let m = beam.direction(&state);
    match pulse_width(beam.half_opening, m.x.hypot(m.y).atan2(m.z), theta_o) {
        PulseWidth::Pulsed(width) => Some(width),
        PulseWidth::AlwaysOn | PulseWidth::NeverOn => None,
    }
}
