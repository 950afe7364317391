//! Rows of a table: the values of every group of columns at each time.

use std::io::Write;

use twofold::euler_angles::EulerAngles;
use twofold::plan::{Output, Plan, PlannedAxisMotion, PlannedMotion, State, Work};

use super::TrajectoryError;
use super::stretches::{Angles, ErrorAtEnd, PlannedState, Stretches, since_start, since_start_within};
use crate::columns::{Carried, Moment};
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
    /// Error at the end of the span; none without a motion.
    pub error: Option<ErrorAtEnd>,
    /// What it took.
    pub work: Work,
}

/// Names of the columns with their units, `t [t_c]` first.
pub fn header(scene: &Scene) -> Vec<String> {
    let mut names = vec![format!("t [{}]", scene.units.time_name)];
    names.extend(scene.columns.iter().flat_map(|group| (group.header)(&scene.units)));
    names
}

/// Computes the motion of `scene` by the [plan](Scene::plan_of_columns) for its columns and writes it as CSV: the [`header`],
/// then a row per time. Numbers are written with as few digits as identify the double. Memory is bounded whatever the span.
/// `progress` is told again and again which part of the span is done, from 0 to 1.
///
/// # Errors
/// A motion that cannot be computed, or `writer` failing.
pub fn write_csv(scene: &Scene, writer: impl Write, progress: impl FnMut(f64)) -> Result<Summary, TrajectoryError> {
    let plan = scene.plan_of_columns()?;
    let mut table = Table::new(scene, writer, progress)?;
    match plan.state {
        State::Nothing => {
            for time in scene.times.iter() {
                table.row(time, since_start(scene, time), Carried::Nothing, &mut |_| None)?;
            }
        }
        State::Axis | State::AxisAndMomentum => table.rows::<PlannedAxisMotion>(&plan)?,
        State::Orientation => table.rows::<PlannedMotion>(&plan)?,
    }
    table.writer.flush()?;
    Ok(table.summary)
}

struct Table<'s, W: Write, P> {
    scene: &'s Scene,
    writer: csv::Writer<W>,
    widths: Vec<usize>,
    summary: Summary,
    progress: P,
}

impl<'s, W: Write, P: FnMut(f64)> Table<'s, W, P> {
    fn new(scene: &'s Scene, writer: W, progress: P) -> Result<Self, TrajectoryError> {
        let mut writer = csv::Writer::from_writer(writer);
        writer.write_record(header(scene))?;
        let widths = scene.columns.iter().map(|group| (group.header)(&scene.units).len()).collect();
        Ok(Self { scene, writer, widths, summary: Summary::default(), progress })
    }

    /// Every row, from the stretches of a plan.
    fn rows<M: PlannedState>(&mut self, plan: &Plan) -> Result<(), TrajectoryError> {
        let scene = self.scene;
        let counts_turns = plan.outputs.contains(&Output::EulerAngles);
        let mut rows = scene.times.iter().peekable();
        let mut stretches = Stretches::<M>::new(scene, plan)?;
        let mut start_angles = scene.initial_angles;
        while let Some(stretch) = stretches.next()? {
            let (from, to) = (stretch.from, stretch.to);
            let mut angles: Angles<'_> =
                if counts_turns { M::angles(&stretch.motion, from, &start_angles)? } else { Box::new(|_| None) };
            let within = |time: &f64| stretch.is_last || since_start(scene, *time).abs() <= to.abs();
            while let Some(time) = rows.next_if(within) {
                let parts = since_start_within(scene, time, from, to);
                let t = parts[0];
                self.row(time, t, M::carried(&stretch.motion, parts)?, &mut angles)?;
                (self.progress)(stretches.part_done(t));
            }
            if counts_turns && !stretch.is_last {
                start_angles = angles(to).unwrap_or(start_angles);
            }
            drop(angles);
            self.summary.work += stretch.motion.evaluations();
            (self.progress)(stretches.part_done(to));
            if stretch.is_last {
                self.summary.error = Some(stretches.error_at_end(&stretch, plan));
            }
        }
        self.summary.work += stretches.work;
        Ok(())
    }

    /// One row.
    fn row(
        &mut self,
        time: f64,
        since_start: f64,
        state: Carried,
        angles: &mut dyn FnMut(f64) -> Option<EulerAngles<f64>>,
    ) -> Result<(), TrajectoryError> {
        let mut angles = || angles(since_start);
        let mut moment = Moment { since_start, state, angles: &mut angles };
        let mut on_pole = false;
        self.writer.write_field(format!("{time:?}"))?;
        for (group, &width) in self.scene.columns.iter().zip(&self.widths) {
            match (group.values)(self.scene, &mut moment) {
                Some(values) => {
                    for value in values {
                        self.writer.write_field(format!("{value:?}"))?;
                    }
                }
                None => {
                    on_pole = true;
                    for _ in 0..width {
                        self.writer.write_field("")?;
                    }
                }
            }
        }
        self.writer.write_record(None::<&[u8]>)?;
        self.summary.rows += 1;
        if on_pole {
            self.summary.rows_on_pole += 1;
            self.summary.first_on_pole.get_or_insert(time);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;

    /// The numbers of a table of a scene at its times.
    fn table(text: &str) -> Vec<Vec<f64>> {
        let scene = Scene::from_toml("scene", text).unwrap_or_else(|error| panic!("{error}"));
        let mut csv = Vec::new();
        write_csv(&scene, &mut csv, |_| ()).unwrap();
        let text = String::from_utf8(csv).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect()
    }

    /// In free precession about Z the rate of `alpha` is `(1 + eps) Omega^z / cos beta`. 1.3e5 rad are three stretches.
    #[test]
    fn angles_keep_their_turns_over_several_stretches() {
        let (beta, spin) = (0.7_f64, 1.0);
        let rate = 1.1 * spin / beta.cos();
        let times = [0.2e5, 0.5e5, 0.9e5].map(|rotation| rotation / rate * 1.4);
        let rows = table(&format!(
            "[star]\ninertia_ratio = 1.1\nspin = {spin:?}\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\n\
             alpha = 0.3\nbeta = {beta:?}\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n[time]\ntimes = {times:?}\n[output]\n\
             columns = [\"angles\"]\naccuracy = 1e-6\nmethod = \"taylor\"\n"
        ));
        for (row, t) in rows.iter().zip(times) {
            let expected = 0.3 + rate * t;
            // The accuracy, and below any part of a turn.
            assert!((row[1] - expected).abs() < 1e-5, "t = {t}: {} and {expected}", row[1]);
        }
        assert_eq!(rows.len(), 3);
    }

    /// After 1e11 turns, in steps that doubles hold exactly: `e_z` goes round Z by equal angles. One double for the time in another unit is good to
    /// 1e-16 of 6e11 rad.
    #[test]
    fn late_directions_advance_by_equal_angles() {
        let (beta, spin) = (0.5_f64, TAU * 100.0);
        let rate = 1.001 * spin / beta.cos();
        let times: Vec<f64> = (0..40).map(|k| 1e9 + f64::from(k) / 1024.0).collect();
        let rows = table(&format!(
            "[star]\nmass = 1.4\nradius = 12.0\noblateness = 1e-3\nspin_frequency = 100.0\n[lorentz_violation]\n\
             eigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.3\nbeta = {beta:?}\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n\
             [time]\nstart = 0.0\ntimes = {times:?}\n[output]\ncolumns = [\"e_z\"]\n"
        ));
        let azimuths: Vec<f64> = rows.iter().map(|row| row[2].atan2(row[1])).collect();
        for three in azimuths.windows(3) {
            let second = three[2] - 2.0 * three[1] + three[0];
            let off = (second + PI).rem_euclid(TAU) - PI;
            assert!(off.abs() < 1e-7, "{off:e}");
        }
        assert_eq!(azimuths.len(), 40);
    }
}
