//! The motion of a scene as a table of comma-separated values.

use std::fmt;
use std::io::Write;

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::euler_angles::EulerAngles;
use twofold::propagation::{ACCURACY_RANGE, ContinuousAngles, Motion, propagate};

use crate::scene_file::{ColumnGroup, Scene};

/// Rotation per stretch of motion that is kept in memory at a time, in rad.
const ROTATION_PER_STRETCH: f64 = 5e4;

/// What there is to say about a table that was written.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Summary {
    /// Rows written.
    pub rows: usize,
    /// Rows whose Euler angles or rates are empty because the symmetry axis is on a pole.
    pub rows_on_pole: usize,
    /// Time of the first of those rows.
    pub first_on_pole: Option<f64>,
}

/// Why a table could not be finished.
#[derive(Debug)]
pub enum TrajectoryError {
    /// The motion could not be computed.
    Motion(Error),
    /// The rows could not be written.
    Write(csv::Error),
}

impl TrajectoryError {
    /// Whether the reader of a pipe has gone away.
    pub fn is_closed_pipe(&self) -> bool {
        match self {
            TrajectoryError::Write(error) => match error.kind() {
                csv::ErrorKind::Io(error) => error.kind() == std::io::ErrorKind::BrokenPipe,
                _ => false,
            },
            TrajectoryError::Motion(_) => false,
        }
    }
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TrajectoryError::Motion(error) => write!(f, "the motion could not be computed: {error}"),
            TrajectoryError::Write(error) => write!(f, "the table could not be written: {error}"),
        }
    }
}

impl std::error::Error for TrajectoryError {}

impl From<Error> for TrajectoryError {
    fn from(error: Error) -> Self {
        TrajectoryError::Motion(error)
    }
}

impl From<csv::Error> for TrajectoryError {
    fn from(error: csv::Error) -> Self {
        TrajectoryError::Write(error)
    }
}

impl From<std::io::Error> for TrajectoryError {
    fn from(error: std::io::Error) -> Self {
        TrajectoryError::Write(error.into())
    }
}

/// Names of the columns with their units, `t [t_c]` first.
pub fn header(scene: &Scene) -> Vec<String> {
    let units = &scene.units;
    let (time, momentum, energy) = (units.time_name, units.momentum_name, units.energy_name);
    let axes = |name: &str, unit: &str| ["X", "Y", "Z"].map(|axis| format!("{name}_{axis} [{unit}]")).to_vec();
    let mut names = vec![format!("t [{time}]")];
    for group in &scene.columns {
        names.extend(match group {
            ColumnGroup::Angles => ["alpha", "beta", "gamma"].map(|name| format!("{name} [rad]")).to_vec(),
            ColumnGroup::Rates => {
                ["alpha_rate", "beta_rate", "gamma_rate"].map(|name| format!("{name} [rad/{time}]")).to_vec()
            }
            ColumnGroup::EquatorialAxis => axes("e_x", "1"),
            ColumnGroup::SymmetryAxis => axes("e_z", "1"),
            ColumnGroup::Momentum => axes("L", momentum),
            ColumnGroup::Integrals => {
                vec![format!("E [{energy}]"), format!("Omega_z [rad/{time}]"), format!("K [({momentum})^2]")]
            }
        });
    }
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
    let mut summary = Summary::default();
    let since_start = |time: f64| (time - scene.times.start()) / scene.units.time;
    let total = since_start(scene.times.last());
    let stretches = (total.abs() * scene.turning_rate() / ROTATION_PER_STRETCH).ceil().max(1.0) as usize;
    let boundary = |k: usize| total * (k as f64 / stretches as f64);

    let mut rows = scene.times.iter().peekable();
    let (mut state, mut start_angles) = (scene.initial, scene.initial_angles);
    for stretch in 0..stretches {
        let (from, to) = (boundary(stretch), boundary(stretch + 1));
        let accuracy = share_of_accuracy(scene, total, to - from);
        let motion = propagate(&scene.spheroid, &scene.violation, &state, (from, to), accuracy)?;
        let mut angles = ContinuousAngles::new(&motion, from, &start_angles)?;
        let within = |time: &f64| stretch + 1 == stretches || since_start(*time).abs() <= to.abs();
        while let Some(time) = rows.next_if(within) {
            let t = since_start(time).clamp(from.min(to), from.max(to));
            let row = Row { time, state: motion.state(t)?, angles: || angles.at(t).ok() };
            let on_pole = row.write(scene, &mut table)?;
            progress(if total == 0.0 { 1.0 } else { t / total });
            summary.rows += 1;
            if on_pole {
                summary.rows_on_pole += 1;
                summary.first_on_pole.get_or_insert(time);
            }
        }
        state = motion.state(to)?;
        start_angles = angles.at(to).unwrap_or(start_angles);
        progress((stretch + 1) as f64 / stretches as f64);
    }
    table.flush()?;
    Ok(summary)
}

/// The part of the scene's accuracy that a stretch may use up, so that the truncation per unit of time is that of one
/// motion over the whole span: an error of time `t` grows with the rotation from `t` on.
fn share_of_accuracy(scene: &Scene, total: f64, stretch: f64) -> f64 {
    let growth = |duration: f64| duration.abs() * (1.0 + scene.turning_rate() * duration.abs() / 2.0);
    if total == 0.0 {
        return scene.accuracy;
    }
    (scene.accuracy * growth(stretch) / growth(total)).max(ACCURACY_RANGE.0)
}

/// One row of the table.
struct Row<A> {
    time: f64,
    state: BodyState<f64>,
    /// The Euler angles, unless the axis is on a pole; computed where they are wanted.
    angles: A,
}

impl<A: FnMut() -> Option<EulerAngles<f64>>> Row<A> {
    /// Writes the row; says whether fields are empty because the axis is on a pole.
    fn write(mut self, scene: &Scene, table: &mut csv::Writer<impl Write>) -> Result<bool, csv::Error> {
        let units = &scene.units;
        let mut on_pole = false;
        table.write_field(format!("{:?}", self.time))?;
        for group in &scene.columns {
            let values: Option<[f64; 3]> = match group {
                ColumnGroup::Angles => (self.angles)().map(|a| [a.alpha, a.beta, a.gamma]),
                ColumnGroup::Rates => {
                    let rates = self.state.rates(&scene.spheroid).ok();
                    rates.map(|r| [r.alpha, r.beta, r.gamma].map(|rate| rate / units.time))
                }
                ColumnGroup::EquatorialAxis => Some(self.state.equatorial_axis.into()),
                ColumnGroup::SymmetryAxis => Some(self.state.axis.into()),
                ColumnGroup::Momentum => Some((self.state.momentum * units.momentum).into()),
                ColumnGroup::Integrals => {
                    let i = first_integrals(&scene.spheroid, &scene.violation, &self.state);
                    Some([i.energy * units.energy, i.spin / units.time, i.clebsch * units.momentum * units.momentum])
                }
            };
            on_pole |= values.is_none();
            for i in 0..3 {
                table.write_field(values.map_or(String::new(), |values| format!("{:?}", values[i])))?;
            }
        }
        table.write_record(None::<&[u8]>)?;
        Ok(on_pole)
    }
}
