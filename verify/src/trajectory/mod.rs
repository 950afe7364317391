//! The motion of a scene as tables of comma-separated values.

mod error;
mod pulse_source;
mod pulses;
#[cfg(test)]
mod pulses_across_stretches;
mod spectrum;
mod stretches;

use std::io::Write;

pub use error::TrajectoryError;
pub use pulses::{PulseSummary, write_pulses};
pub use spectrum::{LinesSummary, LinesWanted, Sampling};
pub(crate) use stretches::{ROTATION_PER_STRETCH, Stretches, since_start};
use twofold::propagation::{ContinuousAngles, Motion};

use crate::columns::Moment;
use crate::scene_file::Scene;

/// What there is to say about a table that was written.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Summary {
    /// Rows written.
    pub rows: usize,
    /// Rows with empty fields, because an axis is on a pole.
    pub rows_on_pole: usize,
    /// Time of the first of those rows.
    pub first_on_pole: Option<f64>,
}

/// Names of the columns with their units, `t [t_c]` first.
pub fn header(scene: &Scene) -> Vec<String> {
    let mut names = vec![format!("t [{}]", scene.units.time_name)];
    names.extend(scene.columns.iter().flat_map(|group| (group.header)(&scene.units)));
    names
}

/// Computes the motion of `scene` and writes it as CSV: the [`header`], then a row per time. Numbers are written with as
/// few digits as identify the double. Memory is bounded whatever the span. `progress` is told again and again which part of
/// the span is done, from 0 to 1.
///
/// # Errors
/// A motion that cannot be computed, or `writer` failing.
pub fn write_csv(scene: &Scene, writer: impl Write, mut progress: impl FnMut(f64)) -> Result<Summary, TrajectoryError> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(header(scene))?;
    let widths: Vec<_> = scene.columns.iter().map(|group| (group.header)(&scene.units).len()).collect();
    let counts_turns = scene.columns.iter().any(|group| group.counts_turns);
    let mut summary = Summary::default();
    let mut rows = scene.times.iter().peekable();
    let mut stretches = Stretches::new(scene);
    let mut start_angles = scene.initial_angles;
    while let Some(stretch) = stretches.next()? {
        let (from, to) = (stretch.from, stretch.to);
        let mut angles = ContinuousAngles::new(&stretch.motion, from, &start_angles)?;
        let within = |time: &f64| stretch.is_last || since_start(scene, *time).abs() <= to.abs();
        while let Some(time) = rows.next_if(within) {
            let t = since_start(scene, time).clamp(from.min(to), from.max(to));
            let mut angles = || angles.at(t).ok();
            let mut moment = Moment { since_start: t, state: stretch.motion.state(t)?, angles: &mut angles };
            let mut on_pole = false;
            table.write_field(format!("{time:?}"))?;
            for (group, &width) in scene.columns.iter().zip(&widths) {
                match (group.values)(scene, &mut moment) {
                    Some(values) => {
                        for value in values {
                            table.write_field(format!("{value:?}"))?;
                        }
                    }
                    None => {
                        on_pole = true;
                        for _ in 0..width {
                            table.write_field("")?;
                        }
                    }
                }
            }
            table.write_record(None::<&[u8]>)?;
            progress(stretches.part_done(t));
            summary.rows += 1;
            if on_pole {
                summary.rows_on_pole += 1;
                summary.first_on_pole.get_or_insert(time);
            }
        }
        if counts_turns {
            start_angles = angles.at(to).unwrap_or(start_angles);
        }
        progress(stretches.part_done(to));
    }
    table.flush()?;
    Ok(summary)
}
