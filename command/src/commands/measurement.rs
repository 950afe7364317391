//! Common parts of `fisher`, `fit` and `forecast`: the scene, the measurements, the unknowns.

use std::ops::Deref;

use super::output_file::OutputFile;
use super::run::read_scene;
use super::{Failure, MeasurementArgs, TableArgs, note};
use crate::text_table::text_table;
use twofold::Error;
use twofold::inference::{Fisher, InferenceError, Model, Signal, Unknown};
use twofold_scene::measurements;
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
        let of = of.map_err(|why| Failure::BadInput(format!("{why} ({})", args.scene)))?;
        Ok(Self { name: args.scene.clone(), of })
    }

    /// The signal of the scene, if the number of data is not too large.
    pub(super) fn signal(&self) -> Result<Signal, Failure> {
        let signal = Signal::new(&self.parameters, self.end).map_err(|error| self.refused(error.into()))?;
        self.check_samples(&signal).map_err(|why| Failure::BadInput(format!("{}: {why}", self.name)))?;
        if signal.is_long() && self.sees_pulses() {
            note(
                "the span is more than 1e5 rad of rotation: the data are the pulses nearest to the samples of the scene",
            );
        }
        Ok(signal)
    }

    pub(super) fn refused(&self, error: InferenceError) -> Failure {
        match error {
            InferenceError::Model(error @ (Error::Unsupported { .. } | Error::NotConverged { .. })) => error.into(),
            error @ (InferenceError::Rounding { .. } | InferenceError::TooFew { .. } | InferenceError::Model(_)) => {
                Failure::BadInput(format!("{}: {error}", self.name))
            }
            error => Failure::Failed(format!("{}: {error}", self.name)),
        }
    }
}

/// Notes that the error bars of a fit are rough if `chi^2` is not parabolic at one standard deviation.
pub(super) fn note_nonlinearity(nonlinearity: Result<f64, InferenceError>) {
    if let Some(text) = roughness(nonlinearity) {
        note(&text);
    }
}

fn roughness(nonlinearity: Result<f64, InferenceError>) -> Option<String> {
    match nonlinearity {
        Ok(nonlinearity) if nonlinearity < 0.3 => None,
        Ok(nonlinearity) => Some(format!(
            "chi^2 deviates from its parabola by {nonlinearity:.1} at one standard deviation: the error bars are rough"
        )),
        Err(why) => Some(format!("the error bars are rough: one standard deviation away, {why}")),
    }
}

/// Writes a table as CSV to the file named in the arguments, if there is one.
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

/// A table for reading: the first row is its header; the first column is aligned left, the others right.
pub(super) fn readable(rows: &[Vec<String>]) -> String {
    text_table(rows, |column| column > 0, false) + "\n"
}

/// Unknowns with their values, standard deviations and correlations: a table for reading, and one with all numbers.
///
/// `unit_of` gives the factor and the unit in which an unknown is written.
pub(super) fn uncertainties<M: Model>(
    fisher: &Fisher<M>,
    unit_of: impl Fn(M::Unknown) -> (f64, String),
) -> [Vec<Vec<String>>; 2] {
    let (unknowns, values, sigmas) = (&fisher.unknowns, fisher.values(), fisher.sigmas());
    let correlations = fisher.correlations();
    // To two digits of sigma, as far as a double has them.
    let digits = |value: f64, sigma: f64| {
        let [first, of_sigma] = [value.abs(), sigma].map(|x| x.log10().floor());
        (first - of_sigma + 2.0).clamp(10.0, 17.0) as usize
    };
    let mut short = vec![["", "value", "sigma", "sigma/|value|", "unit", "correlated most"].map(String::from).to_vec()];
    let mut all = vec![["parameter", "value", "sigma", "unit"].map(String::from).to_vec()];
    all[0].extend(unknowns.iter().map(|unknown| format!("correlation_{}", unknown.key())));
    for (i, unknown) in unknowns.iter().enumerate() {
        let (factor, unit) = unit_of(*unknown);
        let (value, sigma) = (values[i] * factor, sigmas[i] * factor);
        let others = (0..unknowns.len()).filter(|&j| j != i && correlations[(i, j)].is_finite());
        let most = others.max_by(|a, b| correlations[(i, *a)].abs().total_cmp(&correlations[(i, *b)].abs()));
        let most = most.map_or(String::new(), |j| format!("{:+.4} {}", correlations[(i, j)], unknowns[j].symbol()));
        short.push(if sigma.is_finite() {
            let relative = if value == 0.0 { String::new() } else { format!("{:.1e}", sigma / value.abs()) };
            vec![
                unknown.symbol().to_owned(),
                significant(value, digits(value, sigma)),
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
        row.extend((0..unknowns.len()).map(|j| number(correlations[(i, j)])));
        all.push(row);
    }
    [short, all]
}

#[cfg(test)]
mod tests {
    use super::*;
    use twofold::nalgebra::dmatrix;
    use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter};

    /// An invented covariance: sigmas of 1e-2, 0.5, 2 and none; the second and third parameter are correlated most.
    #[test]
    fn uncertainties_are_those_of_the_covariance() {
        use TimingParameter::{Chi, F1, F2, Rho, Wobble};
        let unknowns = [Wobble, Chi, Rho, F1];
        let parameters = TimingModel::new([2.0, 0.0], &[(Wobble, 0.25), (Chi, 1.5), (Rho, 0.125), (F1, -2.5e-13)])
            .expect("a model of a star");
        let none = f64::NAN;
        let covariance = dmatrix![
            1e-4, 1e-3, -2e-3, none;
            1e-3, 0.25, -0.9, none;
            -2e-3, -0.9, 4.0, none;
            none, none, none, none
        ];
        let fisher = Fisher {
            parameters,
            unknowns: unknowns.to_vec(),
            singular_values: Vec::new(),
            rounding: 0.0,
            degenerate: Vec::new(),
            weak: Vec::new(),
            covariance,
        };
        let [short, all] = uncertainties(&fisher, |unknown| match unknown {
            Chi => (100.0, "percent".to_owned()),
            _ => (1.0, unknown.unit().to_owned()),
        });
        let expected = [
            ["wobble", "0.2500000000", "1.00e-2", "4.0e-2", "rad", "+0.2000 chi"],
            ["chi", "150.0000000", "5.00e1", "3.3e-1", "percent", "-0.9000 rho"],
            ["rho", "0.1250000000", "2.00e0", "1.6e1", "rad", "-0.9000 chi"],
            ["f1", "-2.500000000e-13", "not determined", "", "Hz/s", ""],
        ];
        assert_eq!(short[1..], expected.map(|row| row.map(String::from).to_vec()));
        let expected = [
            ["parameter", "value", "sigma", "unit", "wobble", "chi", "rho", "f1"],
            ["wobble", "0.25", "0.01", "rad", "1.0", "0.2", "-0.1", ""],
            ["chi", "150.0", "50.0", "percent", "0.2", "1.0", "-0.9", ""],
            ["rho", "0.125", "2.0", "rad", "-0.1", "-0.9", "1.0", ""],
            ["f1", "-2.5e-13", "", "Hz/s", "", "", "", ""],
        ];
        let without_prefix = |cell: &String| cell.trim_start_matches("correlation_").to_owned();
        let found: Vec<Vec<_>> = all.iter().map(|row| row.iter().map(without_prefix).collect()).collect();
        assert_eq!(found, expected.map(|row| row.map(String::from).to_vec()));
        // A parameter with the value zero has no relative error.
        let fisher = Fisher { unknowns: vec![F2], covariance: dmatrix![4e-30], ..fisher };
        // Two digits of each sigma, at least ten and at most seventeen in all.
        for (sigma, digits) in [(3e-9, "0.2500000000"), (3e-11, "0.250000000000"), (3e-20, "0.25000000000000000")] {
            let fisher = Fisher { unknowns: vec![Wobble], covariance: dmatrix![sigma * sigma], ..fisher.clone() };
            assert_eq!(uncertainties(&fisher, |_| (1.0, String::new()))[0][1][1], digits, "{sigma:e}");
        }
        // A value of exactly one, and a sigma of 3e-11.
        let one = Fisher { unknowns: vec![Wobble], covariance: dmatrix![0.75e-11 * 0.75e-11], ..fisher.clone() };
        assert_eq!(uncertainties(&one, |_| (4.0, String::new()))[0][1][1], "1.000000000000");
        assert_eq!(uncertainties(&fisher, |_| (1.0, String::new()))[0][1][2..4], ["2.00e-15", ""]);
        // Names are aligned left, numbers right.
        let page = readable(&short);
        let lines: Vec<_> = page.lines().collect();
        assert!(lines[2].starts_with(" wobble ") && page.ends_with('\n'), "{page}");
        let end = |line: usize, number: &str| lines[line].find(number).map(|start| start + number.len());
        assert_eq!(end(2, "0.2500000000"), end(3, "150.0000000"), "{page}");
    }

    #[test]
    fn error_bars_are_called_rough_from_a_third_on() {
        assert_eq!(roughness(Ok(0.29)), None);
        let text = "chi^2 deviates from its parabola by 0.3 at one standard deviation: the error bars are rough";
        assert_eq!(roughness(Ok(0.3)), Some(text.into()));
        let text = roughness(Err(InferenceError::TooFew { data: 1, least: 2 })).expect("a note");
        assert!(text.starts_with("the error bars are rough: one standard deviation away, "), "{text}");
    }
}
