//! What `fisher`, `fit` and `forecast` share: the scene, what is measured of it, what is not known.

use std::ops::Deref;

use super::output_file::OutputFile;
use super::run::{failed, read_scene};
use super::{Failure, MeasurementArgs, TableArgs, note};
use crate::text_table::text_table;
use twofold::inference::{Fisher, InferenceError, Model, Signal, Unknown};
use twofold_scene::measurements::{self, MeasurementError};
use twofold_scene::scene_file::Columns;
use twofold_scene::significant::significant;

/// A measurement with the name of its scene, for messages.
pub(super) struct Measurement {
    pub(super) name: String,
    pub(super) of: measurements::Measurement,
}

impl Deref for Measurement {
    type Target = measurements::Measurement;

    fn deref(&self) -> &Self::Target {
        &self.of
    }
}

impl Measurement {
    pub(super) fn read(args: &MeasurementArgs) -> Result<Self, Failure> {
        let scene = read_scene(&args.scene, Columns::Unused)?;
        let of = measurements::Measurement::new(scene, &args.observe, args.parameters.as_deref());
        let of = of.map_err(|error| match error {
            MeasurementError::Refused(why) => Failure::BadInput(format!("{why} ({})", args.scene)),
            MeasurementError::Model(error) => failed(error),
        })?;
        Ok(Self { name: args.scene.clone(), of })
    }

    /// The signal of the scene, of which not too much is measured.
    pub(super) fn signal(&self) -> Result<Signal, Failure> {
        let signal = Signal::new(&self.parameters, self.end).map_err(|error| self.refused(error.into()))?;
        self.check_samples(&signal).map_err(|why| Failure::BadInput(format!("{}: {why}", self.name)))?;
        if signal.is_long() && self.sees_pulses() {
            note(
                "a span of more than 1e5 rad of rotation: the pulses nearest to the samples of the scene, by the averaged motion",
            );
        }
        Ok(signal)
    }

    pub(super) fn refused(&self, error: InferenceError) -> Failure {
        match error {
            InferenceError::Model(error) => failed(error),
            error @ InferenceError::Rounding { .. } => Failure::BadInput(format!("{}: {error}", self.name)),
            error => Failure::Failed(format!("{}: {error}", self.name)),
        }
    }
}

/// Says where the error bars of a fit are rough: where `chi^2` is off its parabola at one standard deviation.
pub(super) fn note_nonlinearity(nonlinearity: Result<f64, InferenceError>) {
    match nonlinearity {
        Ok(nonlinearity) if nonlinearity < 0.3 => {}
        Ok(nonlinearity) => note(&format!(
            "chi^2 is off its parabola by {nonlinearity:.1} at one standard deviation: the error bars are rough"
        )),
        Err(why) => note(&format!("the error bars are rough: a standard deviation away, {why}")),
    }
}

/// Writes a table as CSV to the file that the arguments name, if they do.
pub(super) fn write_csv(args: &TableArgs, rows: &[Vec<String>]) -> Result<(), Failure> {
    let Some(path) = &args.out else { return Ok(()) };
    let output = OutputFile::beside(path, args.force)?;
    let cannot =
        |error: &dyn std::fmt::Display| Failure::Failed(format!("{} cannot be written: {error}", path.display()));
    let mut table = csv::Writer::from_writer(output.file());
    for row in rows {
        table.write_record(row).map_err(|error| cannot(&error))?;
    }
    table.flush().map_err(|error| cannot(&error))?;
    drop(table);
    output.complete()
}

/// A table for reading: the first row is its header, the first column on the left and the others on the right.
pub(super) fn readable(rows: &[Vec<String>]) -> String {
    text_table(rows, |column| column > 0, false) + "\n"
}

/// Unknowns with their values, standard deviations and correlations: a table for reading, and one with all numbers.
///
/// `unit_of` has by what a value is multiplied for the output, and its unit there.
pub(super) fn uncertainties<M: Model>(
    fisher: &Fisher<M>,
    unit_of: impl Fn(M::Unknown) -> (f64, String),
) -> [Vec<Vec<String>>; 2] {
    let (unknowns, values, sigmas) = (&fisher.unknowns, fisher.values(), fisher.sigmas());
    let correlations = fisher.correlations();
    let correlation = |i: usize, j: usize| correlations[(i, j)];
    let mut short = vec![["", "value", "sigma", "sigma/|value|", "unit", "correlated most"].map(String::from).to_vec()];
    let mut all = vec![["parameter", "value", "sigma", "unit"].map(String::from).to_vec()];
    all[0].extend(unknowns.iter().map(|unknown| format!("correlation_{}", unknown.key())));
    for (i, unknown) in unknowns.iter().enumerate() {
        let (factor, unit) = unit_of(*unknown);
        let (value, sigma) = (values[i] * factor, sigmas[i] * factor);
        let others = (0..unknowns.len()).filter(|&j| j != i && correlation(i, j).is_finite());
        let most = others.max_by(|a, b| correlation(i, *a).abs().total_cmp(&correlation(i, *b).abs()));
        let most = most.map_or(String::new(), |j| format!("{:+.4} {}", correlation(i, j), unknowns[j].symbol()));
        short.push(if sigma.is_finite() {
            let relative = if value == 0.0 { String::new() } else { format!("{:.1e}", sigma / value.abs()) };
            vec![
                unknown.symbol().to_owned(),
                significant(value, 10),
                format!("{sigma:.2e}"),
                relative,
                unit.clone(),
                most,
            ]
        } else {
            let symbol = unknown.symbol().to_owned();
            vec![symbol, significant(value, 10), "not determined".into(), String::new(), unit.clone(), most]
        });
        let number = |x: f64| if x.is_finite() { format!("{x:?}") } else { String::new() };
        let mut row = vec![unknown.key().to_owned(), format!("{value:?}"), number(sigma), unit];
        row.extend((0..unknowns.len()).map(|j| number(correlation(i, j))));
        all.push(row);
    }
    [short, all]
}
