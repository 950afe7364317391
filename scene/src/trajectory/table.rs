//! Rows of a table: the values of every group of columns at each time.

use std::cell::RefCell;
use std::io::{self, Write};

use twofold::plan::Work;

use super::TrajectoryError;
use crate::columns;
use crate::samples::{AxisStateAt, ErrorEstimates, Sample, for_each_sample};
use crate::scene_file::Scene;

/// Counts of a written table.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Summary {
    /// Number of rows written.
    pub rows: usize,
    /// Rows with empty fields, because an axis is at a pole.
    pub rows_on_pole: usize,
    /// Time of the first of those rows.
    pub first_on_pole: Option<f64>,
    /// Estimated error at the end of the span, in the components of `n`, `e_x` and of `L` in units of its size; `None` without a motion.
    pub error: Option<f64>,
    /// The work done.
    pub work: Work,
}

/// Names of the columns with their units, `t [t_c]` first.
pub fn header(scene: &Scene) -> Vec<String> {
    let mut names = vec![format!("t [{}]", scene.units.time_name)];
    names.extend(scene.columns.iter().flat_map(|group| columns::header(*group, &scene.units)));
    names
}

/// Computes the motion of `scene` by the [plan](Scene::plan) for its columns and writes it as CSV: the [`header`], then a
/// row per time. Numbers are written with as few digits as identify the double. Memory is bounded whatever the span.
/// `progress` receives the fraction of the span that is done, from 0 to 1; its error ends the work.
pub fn write_csv(
    scene: &Scene,
    writer: impl Write,
    progress: impl FnMut(f64) -> io::Result<()>,
) -> Result<Summary, TrajectoryError> {
    let plan = scene.plan(&scene.columns)?;
    let progress = RefCell::new(progress);
    let show = |t: f64| (progress.borrow_mut())(scene.part_done(t));
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(header(scene))?;
    let widths: Vec<_> = scene.columns.iter().map(|group| columns::header(*group, &scene.units).len()).collect();
    let mut summary = Summary::default();
    let row = |time: f64, sample: &Sample| {
        let mut on_pole = false;
        table.write_field(format!("{time:?}"))?;
        for (group, &width) in scene.columns.iter().zip(&widths) {
            let values = columns::values(*group, scene, sample);
            on_pole |= values.is_none();
            let fields = values.map(|values| values.iter().map(|value| format!("{value:?}")).collect());
            fields
                .unwrap_or_else(|| vec![String::new(); width])
                .iter()
                .try_for_each(|field| table.write_field(field))?;
        }
        table.write_record(None::<&[u8]>)?;
        summary.rows += 1;
        if on_pole {
            summary.rows_on_pole += 1;
            summary.first_on_pole.get_or_insert(time);
        }
        Ok::<(), TrajectoryError>(show(sample.since_start)?)
    };
    let after_segment = |_: &AxisStateAt<'_>, _, to| Ok(show(to)?);
    let sampled = for_each_sample(scene, &plan, ErrorEstimates::AtEnd, row, after_segment)?;
    table.flush()?;
    Ok(Summary { error: sampled.error, work: sampled.work, ..summary })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use twofold::numerics::angle::wrapped;

    use super::*;

    /// The numbers of a table of a scene at its times.
    fn table(text: &str) -> Vec<Vec<f64>> {
        let scene = Scene::from_toml("scene", text).unwrap_or_else(|error| panic!("{error}"));
        let mut csv = Vec::new();
        write_csv(&scene, &mut csv, |_| Ok(())).unwrap();
        let text = String::from_utf8(csv).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect()
    }

    /// In free precession about Z the rate of `alpha` is `(1 + eps) Omega^z / cos beta`. 1.3e5 rad are 26 segments.
    #[test]
    fn angles_keep_their_turns_over_several_segments() {
        let (beta, spin) = (0.7_f64, 1.0);
        let rate = 1.1 * spin / beta.cos();
        let times = [0.2e5, 0.5e5, 0.9e5].map(|rotation| rotation / rate * 1.4);
        let rows = table(&format!(
            "[star]\ninertia_ratio = 1.1\nspin = {spin:?}\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\n\
             alpha = 0.3\nbeta = {beta:?}\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n[time]\ntimes = {times:?}\n[output]\n\
             columns = [\"angles\"]\ntolerance = 1e-6\nmethod = \"taylor\"\n"
        ));
        for (row, t) in rows.iter().zip(times) {
            let expected = 0.3 + rate * t;
            // The tolerance, and below any fraction of a turn.
            assert!((row[1] - expected).abs() < 1e-5, "t = {t}: {} and {expected}", row[1]);
        }
        assert_eq!(rows.len(), 3);
    }

    /// After 1e11 turns, in steps that doubles represent exactly: `e_z` circles Z in equal angles. A single double for the time in another unit is
    /// accurate to 1e-16 of 6e11 rad.
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
            let off = wrapped(three[2] - 2.0 * three[1] + three[0]);
            assert!(off.abs() < 1e-7, "{off:e}");
        }
        assert_eq!(azimuths.len(), 40);
    }

    /// A motion in 24 segments without a row before its end: it reports where each ends.
    #[test]
    fn progress_is_shown_without_rows() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.tolerance = 1e-2;
        scene.choose_method("taylor").unwrap();
        scene.choose_columns(&["e_z"]).unwrap();
        scene.times = crate::scene_file::Times::Listed { start: 0.0, times: vec![1.2e5 / scene.turning_rate()] };
        let mut shown = Vec::new();
        write_csv(&scene, Vec::new(), |part| {
            shown.push(part);
            Ok(())
        })
        .unwrap();
        let ends = (1..=24).map(|k| f64::from(k) / 24.0);
        assert_eq!(shown, ends.chain([1.0]).collect::<Vec<_>>());
    }
}
