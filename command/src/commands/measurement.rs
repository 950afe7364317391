//! What `fisher`, `fit` and `forecast` share: the scene, what is measured of it, what is not known.

use super::output_file::OutputFile;
use super::run::{failed, read_scene};
use super::{Failure, MeasurementArgs, TableArgs, note};
use crate::text_table::text_table;
use twofold::inference::{Event, Fisher, InferenceError, Model, Noise, Signal, Unknown, check_span};
use twofold::parameters::{Parameter, Parameters};
use twofold_scene::measurements::{missing_section, parameters_of, parse_noise};
use twofold_scene::scene_file::{Columns, Scene, nearest};
use twofold_scene::significant::significant;

pub(super) struct Measurement {
    pub(super) name: String,
    pub(super) scene: Scene,
    pub(super) parameters: Parameters<f64>,
    pub(super) noise: Vec<Noise>,
    pub(super) unknowns: Vec<Parameter>,
    /// End of the span in t_c since the start.
    pub(super) end: f64,
}

impl Measurement {
    pub(super) fn read(args: &MeasurementArgs) -> Result<Self, Failure> {
        let scene = read_scene(&args.scene, Columns::Unused)?;
        let refuse = |why: String| Failure::BadInput(format!("{why} ({})", args.scene));
        let noise = parse_noise(&args.observe, scene.units.time).map_err(|why| refuse(format!("--observe: {why}")))?;
        for (observable, _) in &noise {
            if let Some(section) = missing_section(&scene, *observable) {
                return Err(refuse(format!(
                    "--observe {}: the scene lacks the section [{section}] (docs/scenes.md describes it)",
                    observable.key()
                )));
            }
        }
        let sees_pulses = noise.iter().any(|(observable, _)| observable.is_of_pulses());
        let unknowns = match args.parameters.as_deref() {
            None if sees_pulses => Parameter::OF_PULSES.to_vec(),
            None => Parameter::OF_STRAIN.to_vec(),
            Some("all") => Parameter::FITTED.to_vec(),
            Some(list) => named(list, &Parameter::FITTED).map_err(|why| refuse(format!("--parameters: {why}")))?,
        };
        let end = (scene.times.last() - scene.times.start()) / scene.units.time;
        if end <= 0.0 {
            return Err(refuse(format!("[time] has a span of {end:?} t_c: allowed here is one forwards, above zero")));
        }
        let parameters = parameters_of(&scene).map_err(failed)?;
        if sees_pulses {
            check_span(&parameters, end).map_err(|why| refuse(why.to_string()))?;
        }
        Ok(Self { name: args.scene.clone(), scene, parameters, noise, unknowns, end })
    }

    /// Whether pulses are observed.
    pub(super) fn sees_pulses(&self) -> bool {
        self.noise.iter().any(|(observable, _)| observable.is_of_pulses())
    }

    /// The pulses of a signal that are data: all of them, or of a long span those near the samples of the scene.
    pub(super) fn events(&self, signal: &Signal) -> Result<Vec<Event>, Failure> {
        let refused = |error: twofold::Error| self.refused(error.into());
        if !self.sees_pulses() {
            return Ok(Vec::new());
        }
        if !signal.is_long() {
            return signal.events().map_err(refused);
        }
        note(
            "a span of more than 1e5 rad of rotation: the pulses nearest to the samples of the scene, by the averaged motion",
        );
        signal.events_after(&self.sample_times()?).map_err(refused)
    }

    pub(super) fn samples(&self) -> Result<Vec<f64>, Failure> {
        if self.noise.iter().all(|(observable, _)| observable.is_of_pulses()) {
            return Ok(Vec::new());
        }
        self.sample_times()
    }

    fn sample_times(&self) -> Result<Vec<f64>, Failure> {
        const MOST: usize = 100_000;
        let count = self.scene.times.count();
        if count > MOST {
            return Err(Failure::BadInput(format!(
                "{}: `time.samples` = {count}: allowed here are at most {MOST}",
                self.name
            )));
        }
        let (start, unit) = (self.scene.times.start(), self.scene.units.time);
        Ok(self.scene.times.iter().map(|time| ((time - start) / unit).min(self.end)).collect())
    }

    /// What a number of an unknown is multiplied by for the output, and its unit there.
    pub(super) fn unit(&self, unknown: Parameter) -> (f64, String) {
        let units = &self.scene.units;
        match unknown {
            Parameter::Spin | Parameter::AlphaRate | Parameter::BetaRate => {
                (1.0 / units.time, format!("rad/{}", units.time_name))
            }
            Parameter::Alpha
            | Parameter::Beta
            | Parameter::Gamma
            | Parameter::Chi
            | Parameter::Delta
            | Parameter::Rho
            | Parameter::ThetaO
            | Parameter::PhiO => (1.0, "rad".to_owned()),
            _ => (1.0, "1".to_owned()),
        }
    }

    pub(super) fn refused(&self, error: InferenceError) -> Failure {
        match error {
            InferenceError::Model(error) => failed(error),
            error @ InferenceError::Rounding { .. } => Failure::BadInput(format!("{}: {error}", self.name)),
            error => Failure::Failed(format!("{}: {error}", self.name)),
        }
    }
}

/// The unknowns of a list of names.
pub(super) fn named<U: Unknown>(list: &str, all: &[U]) -> Result<Vec<U>, String> {
    let mut found = Vec::new();
    for name in list.split(',').map(str::trim) {
        let unknown = all.iter().copied().find(|unknown| unknown.key() == name).ok_or_else(|| {
            let names: Vec<_> = all.iter().map(|unknown| unknown.key()).collect();
            let hint = nearest(name, &names).map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
            format!("`{name}` is no parameter{hint}: allowed are {}, or all", names.join(", "))
        })?;
        if found.contains(&unknown) {
            return Err(format!("`{name}` is named twice: allowed is once"));
        }
        found.push(unknown);
    }
    Ok(found)
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
