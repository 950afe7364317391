//! Spectral lines of a column of a scene's table.

use std::f64::consts::TAU;
use std::io::Write;

use twofold::dynamics::BodyState;
use twofold::observables::spectrum::{FundamentalFrequency, QuasiPeriodicMotion};
use twofold::plan::Output;

use super::TrajectoryError;
use crate::columns::Column;
use crate::samples::{Sample, SampledState};
use crate::scene_file::Scene;

/// Selection and format of the lines.
#[derive(Debug, Clone, Copy)]
pub struct LinesWanted {
    /// Smallest amplitude as a fraction of the largest one.
    pub least: f64,
    /// Largest number of lines that are written.
    pub most: usize,
    /// Whether frequencies are in turns per unit of time (Hz if that is the second) rather than in rad.
    pub in_turns: bool,
}

/// Information about a list of lines in addition to the lines.
#[derive(Debug, Clone)]
pub struct LinesSummary {
    /// Constant term, in the unit of the column.
    pub constant: f64,
    /// Number of lines written.
    pub written: usize,
    /// Number of lines found.
    pub found: usize,
    /// Amplitude that rounding of a constant causes, in the unit of the column, if it is larger than the smallest one requested.
    pub rounding: Option<f64>,
    /// Largest difference between the column and the sum of all lines found, at sixteen states, in the unit of the column.
    pub left: f64,
    /// The unit of frequencies.
    pub unit: String,
    /// The fundamental frequencies that are not zero, in that unit.
    pub fundamental: Vec<FundamentalFrequency>,
    /// The axis of the angles with these rates, in the scene's frame.
    pub pole: [f64; 3],
}

/// Writes the lines of a column as CSV, strongest first, with their phases at the start of the scene.
pub fn write_lines(
    scene: &Scene,
    column: &Column,
    wanted: &LinesWanted,
    writer: impl Write,
) -> Result<LinesSummary, TrajectoryError> {
    let not_found = |why: TrajectoryError| match why {
        TrajectoryError::Motion(error) => TrajectoryError::Lines(column.name.clone(), error),
        other => other,
    };
    let motion = QuasiPeriodicMotion::new(&scene.problem).map_err(|why| not_found(why.into()))?;
    let mut list = motion.lines(wanted.least, |state| value_and_size(scene, column, state)).map_err(not_found)?;
    let found = list.lines.len();
    let strongest = list.lines.first().map_or(0.0, |line| line.amplitude);
    list.lines.truncate(wanted.most);
    let time = scene.units.time_name;
    let (unit, scale) = match (wanted.in_turns, time) {
        (false, _) => (format!("rad/{time}"), scene.units.time),
        (true, "s") => ("Hz".to_owned(), TAU * scene.units.time),
        (true, _) => (format!("turns/{time}"), TAU * scene.units.time),
    };
    let mut table = csv::Writer::from_writer(writer);
    table.write_record([
        format!("frequency [{unit}]"),
        format!("amplitude [{}]", column.unit),
        "phase [rad]".to_owned(),
        format!("uncertainty [{unit}]"),
        "combination".to_owned(),
    ])?;
    for line in &list.lines {
        let numbers = [line.frequency / scale, line.amplitude, line.phase, line.uncertainty / scale];
        let numbers = numbers.map(|x| format!("{x:?}"));
        table.write_record(numbers.into_iter().chain([line.combination.to_string()]))?;
    }
    table.flush()?;
    let frequencies = motion.frequencies();
    let named = |of: &&FundamentalFrequency| frequencies.all.iter().all(|other| other.symbol != of.symbol);
    let moving = frequencies.all.iter().filter(|of| of.rate != 0.0).chain(frequencies.basis.iter().filter(named));
    Ok(LinesSummary {
        constant: list.constant,
        written: list.lines.len(),
        found,
        rounding: (list.least > wanted.least * strongest).then_some(list.least),
        left: list.left,
        unit,
        fundamental: moving.map(|of| FundamentalFrequency { rate: of.rate / scale, ..*of }).collect(),
        pole: frequencies.pole.into(),
    })
}

/// The value of a column in a state of the motion, and the size of the quantity of which the value is a component.
fn value_and_size(scene: &Scene, column: &Column, state: &BodyState<f64>) -> Result<[f64; 2], TrajectoryError> {
    let mut sample = Sample::new(0.0, SampledState::Orientation(*state));
    if column.group == Output::EulerAngles {
        sample.angles = state.angles().ok();
    }
    let (value, size) =
        column.value_and_size(scene, &sample).ok_or_else(|| TrajectoryError::Undefined(column.name.clone()))?;
    // At a pole, or near it within rounding.
    if value.is_finite() { Ok([value, size]) } else { Err(TrajectoryError::Undefined(column.name.clone())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symbols of the fundamental frequencies of a scene, with those that name the lines.
    fn symbols(scene: &Scene) -> Vec<&'static str> {
        let column = Column::oscillating("e_z_X", scene).unwrap();
        let wanted = LinesWanted { least: 1e-6, most: 1, in_turns: false };
        let summary = write_lines(scene, &column, &wanted, Vec::new()).unwrap();
        summary.fundamental.iter().map(|frequency| frequency.symbol).collect()
    }

    /// For a free star `L` stays fixed. For a star that starts at rest no axis is circled and there is no mean rotation about the symmetry axis:
    /// only the angles of the torus move.
    #[test]
    fn frequencies_are_told_that_are_not_zero() {
        assert_eq!(symbols(&Scene::named("free").unwrap()), ["alpha'", "gamma'", "nu'", "psi'"]);
        assert_eq!(symbols(&Scene::named("tp-1").unwrap()), ["alpha'", "gamma'", "l'", "nu'", "psi'"]);
        let at_rest = "star.inertia_ratio = 1.1\nstar.spin = 0.0\nlorentz_violation.eigenvalues = [0.02, 0.01, -0.04]\n\
                       initial.alpha = 0.3\ninitial.beta = 0.7\ninitial.alpha_rate = 0.0\ninitial.beta_rate = 0.0\n\
                       time.span = 1.0\ntime.samples = 2\n";
        let found = symbols(&Scene::from_toml("at-rest", at_rest).unwrap());
        assert_eq!(found, ["theta_1'", "theta_2'", "theta_3'"]);
    }
}
