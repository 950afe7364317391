//! A scene that is measured, and its unknown parameters.

use std::collections::HashSet;

use twofold::Error;
use twofold::inference::{Datum, Event, Noise, Observable, Place, Signal, Unknown, check_span, data_of, is_long};
use twofold::parameters::{Parameter, Parameters};

use super::data_file::MOST_ROWS;
use super::{DataFile, missing_section, parameters_of, parse_noise};
use crate::Refusal;
use crate::scene_file::{Scene, nearest};

/// A scene, the kinds of data with their errors, and the unknown parameters.
#[derive(Debug)]
pub struct Measurement {
    /// The scene.
    pub scene: Scene,
    /// The parameters of the scene.
    pub parameters: Parameters<f64>,
    /// The kinds of data, with standard deviations.
    pub noise: Vec<Noise>,
    /// The unknown parameters.
    pub unknowns: Vec<Parameter>,
    /// End of the span in t_c since the start.
    pub end: f64,
}

/// Numbers of entries of the tables that are not among the data.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Data of the first turn: their pulse may be cut off in another model.
    pub first_turn: usize,
    /// Pulses that share a turn with another one.
    pub shared_turns: usize,
}

impl Measurement {
    /// The measurement of a scene. The data are those named by `observe`, in the format of [`parse_noise`]. The unknowns are the `parameters` in a
    /// list of names, or all of them; by default those that such data can determine.
    ///
    /// # Errors
    /// [`Refusal::Input`] for unknown names, sections that the scene lacks, or a backward span; [`Refusal::Model`] for a scene without parameters.
    pub fn new(scene: Scene, observe: &str, parameters: Option<&str>) -> Result<Self, Refusal> {
        let refused = Refusal::Input;
        let noise = parse_noise(observe, &Observable::ALL, scene.units.time)
            .map_err(|why| refused(format!("--observe: {why}")))?;
        for (observable, _) in &noise {
            if let Some(section) = missing_section(&scene, *observable) {
                return Err(refused(format!(
                    "--observe {}: the scene lacks the section [{section}] (docs/scenes.md describes it)",
                    observable.key()
                )));
            }
        }
        let sees_pulses = noise.iter().any(|(observable, _)| observable.is_of_pulses());
        let unknowns = match parameters {
            None if sees_pulses => Parameter::OF_PULSES.to_vec(),
            None => Parameter::OF_STRAIN.to_vec(),
            Some(list) => named(list, &Parameter::FITTED).map_err(|why| refused(format!("--parameters: {why}")))?,
        };
        let end = (scene.times.last() - scene.times.start()) / scene.units.time;
        if end <= 0.0 {
            return Err(refused(format!("[time] has a span of {end:?} t_c: must be above zero here")));
        }
        let parameters = parameters_of(&scene)?;
        if sees_pulses {
            check_span(&parameters, end).map_err(|why| refused(why.to_string()))?;
            let of_every_turn = noise.iter().find(|(observable, _)| observable.is_of_every_turn());
            if let Some((observable, _)) = of_every_turn.filter(|_| is_long(&parameters, end)) {
                let (span, unit) = (scene.times.last() - scene.times.start(), scene.units.time_name);
                return Err(refused(format!(
                    "--observe {}: the span of [time], {span:?} {unit}, is more than 1e5 rad of rotation; for such a span use arrivals, widths and strains",
                    observable.key()
                )));
            }
        }
        Ok(Self { scene, parameters, noise, unknowns, end })
    }

    /// Whether pulses are observed.
    pub fn sees_pulses(&self) -> bool {
        self.noise.iter().any(|(observable, _)| observable.is_of_pulses())
    }

    /// The pulses of a signal that are data: all of them, or for a long span those near the samples of the scene.
    ///
    /// # Errors
    /// As for [`Signal::events`].
    pub fn events(&self, signal: &Signal) -> Result<Vec<Event>, Error> {
        if !self.sees_pulses() {
            Ok(Vec::new())
        } else if signal.is_long() {
            signal.events_after(&self.sample_times())
        } else {
            signal.events()
        }
    }

    /// The times of strain data, in t_c since the start.
    pub fn samples(&self) -> Vec<f64> {
        let only_pulses = self.noise.iter().all(|(observable, _)| observable.is_of_pulses());
        if only_pulses { Vec::new() } else { self.sample_times() }
    }

    fn sample_times(&self) -> Vec<f64> {
        let (start, unit) = (self.scene.times.start(), self.scene.units.time);
        self.scene.times.iter().map(|time| ((time - start) / unit).min(self.end)).collect()
    }

    /// Refuses a scene with too many samples for their derivatives to be stored, if they are used for a `signal`.
    ///
    /// # Errors
    /// There are too many samples.
    pub fn check_samples(&self, signal: &Signal) -> Result<(), String> {
        let used = signal.is_long() || self.noise.iter().any(|(observable, _)| !observable.is_of_pulses());
        let count = self.scene.times.count();
        if used && count > MOST_ROWS {
            return Err(format!("`time.samples` = {count}: must be at most {MOST_ROWS} here"));
        }
        Ok(())
    }

    /// Factor by which the value of an unknown is multiplied for the output, and its unit there.
    pub fn unit(&self, unknown: Parameter) -> (f64, String) {
        let (units, body) = (&self.scene.units, self.scene.problem.spheroid());
        match unknown {
            Parameter::InertiaXx | Parameter::InertiaZz => (1.0 / body.inertia_xx, "1".to_owned()),
            Parameter::ConstantC => (1.0 / body.constant_c, "1".to_owned()),
            Parameter::Strain => (body.inertia_xx, "1".to_owned()),
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

    /// The data of the scene itself, without errors. A pulse in the first turn is left out, because it may be cut off in a
    /// neighbouring model.
    ///
    /// # Errors
    /// As for [`data_of`].
    pub fn simulated(&self, signal: &Signal) -> Result<Vec<Datum>, Error> {
        let mut events = self.events(signal)?;
        events.retain(|event| event.epoch + event.start > signal.turn());
        data_of(signal, &events, &self.samples(), &self.noise)
    }

    /// The data in tables that lie within the span of the scene, and what was left out.
    ///
    /// # Errors
    /// A table that contains neither pulses nor strains, data that occur twice or not at all, and data outside the span.
    pub fn data_in(&self, tables: &[DataFile], signal: &Signal) -> Result<(Vec<Datum>, LeftOut), String> {
        let mut data: Vec<Datum> = Vec::new();
        let mut left_out = LeftOut::default();
        let mut seen = HashSet::new();
        let names = || tables.iter().map(|table| table.name.as_str()).collect::<Vec<_>>().join(", ");
        for table in tables {
            let (file, of_pulses) = (&table.name, table.is_of_pulses()?);
            if of_pulses && signal.is_long() {
                return Err(format!(
                    "{file}: arrival times in one double each are too coarse for a span of more than 1e5 rad of rotation; use --simulate or strains"
                ));
            }
            let more = if of_pulses {
                let (more, shared) = table.pulses(&self.scene, &self.noise)?;
                left_out.shared_turns += shared;
                more
            } else {
                table.strain(&self.scene, &self.noise)?
            };
            // A strain is both of its polarizations.
            let together =
                if of_pulses { 1 } else { self.noise.iter().filter(|(kind, _)| !kind.is_of_pulses()).count().max(1) };
            let rows = more.chunks(together);
            let mut again = rows.filter(|row| !seen.insert(row.iter().map(identity).collect::<Vec<_>>()));
            if let Some([again, ..]) = again.next() {
                return Err(format!(
                    "{file}: {} = {:?} occurs twice, or also in an earlier file; each datum can be given only once",
                    again.observable.key(),
                    again.value
                ));
            }
            data.extend(more);
        }
        for (observable, _) in &self.noise {
            if data.iter().all(|datum| datum.observable != *observable) {
                return Err(format!(
                    "--observe {}: there is no such datum in {}; use tables of `twofold pulses` or of `twofold run --columns h`",
                    observable.key(),
                    names()
                ));
            }
        }
        for datum in &data {
            let (Place::Time(time) | Place::Turn { near: time, .. }) = datum.place;
            if !(0.0..=self.end).contains(&time) {
                return Err(format!(
                    "{}: a datum at t = {time:?} t_c after the start: must be within the span of the scene, from 0 to {:?} t_c",
                    names(),
                    self.end
                ));
            }
        }
        let before = data.len();
        data.retain(|datum| !matches!(datum.place, Place::Turn { near, .. } if near < signal.turn()));
        left_out.first_turn = before - data.len();
        Ok((data, left_out))
    }
}

/// The identity of a datum: its kind, its number or time, and its value, to the last digit.
fn identity(datum: &Datum) -> (&'static str, i64, [u64; 2]) {
    let (number, time) = match datum.place {
        Place::Turn { number, near } => (number, near),
        Place::Time(time) => (0, time),
    };
    (datum.observable.key(), number, [time, datum.value].map(f64::to_bits))
}

/// The unknowns in a list of names, or all of them for the word `all`.
///
/// # Errors
/// An unknown name, or one that occurs twice.
pub fn named<U: Unknown>(list: &str, all: &[U]) -> Result<Vec<U>, String> {
    if list.trim() == "all" {
        return Ok(all.to_vec());
    }
    let mut found = Vec::new();
    for name in list.split(',').map(str::trim) {
        if name == "all" {
            return Err("`all` cannot be used with other names; give either `all` or names of parameters".to_owned());
        }
        let unknown = all.iter().copied().find(|unknown| unknown.key() == name).ok_or_else(|| {
            let names: Vec<_> = all.iter().map(|unknown| unknown.key()).collect();
            let hint = nearest(name, &names).map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
            format!("`{name}` is not a parameter{hint}; expected one of {}, or all", names.join(", "))
        })?;
        if found.contains(&unknown) {
            return Err(format!("`{name}` is given twice"));
        }
        found.push(unknown);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::Times;

    fn measured(observe: &str, last: f64, samples: usize) -> (Measurement, Signal) {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.times = Times::Even { start: 0.0, end: last, samples };
        let measurement = Measurement::new(scene, observe, None).unwrap_or_else(|error| panic!("{error}"));
        let signal = Signal::new(&measurement.parameters, measurement.end).unwrap();
        (measurement, signal)
    }

    /// In units of those of the star, whose `I^xx` and `C` are one to 1e-8 only.
    #[test]
    fn moments_of_inertia_and_c_are_relative_to_those_of_the_star() {
        let measurement = Measurement::new(Scene::named("millisecond-pulsar").unwrap(), "strain:1e-28", None).unwrap();
        let parameters = &measurement.parameters;
        for unknown in [Parameter::InertiaXx, Parameter::InertiaZz, Parameter::ConstantC] {
            let (factor, unit) = measurement.unit(unknown);
            let of_xx = unknown.value(parameters) / parameters.spheroid.inertia_xx;
            assert!((factor * unknown.value(parameters) / of_xx - 1.0).abs() < 1e-15 && unit == "1", "{factor}");
        }
        assert!(parameters.spheroid.inertia_xx > 1.0 + 1e-12);
    }

    #[test]
    fn many_samples_are_refused_where_strains_are_taken_at_them() {
        for (observe, samples, is_taken) in [
            ("arrivals:1", 100_001, true),
            ("strain:1", 100_001, false),
            ("arrivals:1,strain:1", 100_001, false),
            ("strain:1", 100_000, true),
        ] {
            // A span of half a t_c is allowed.
            let (measurement, signal) = measured(observe, 0.5, samples);
            assert_eq!(measurement.check_samples(&signal).is_ok(), is_taken, "{observe} {samples}");
        }
    }

    fn strains(rows: &str) -> DataFile {
        DataFile::of_bytes("strains", format!("t [t_c],h_plus [1],h_cross [1]\n{rows}").into_bytes()).unwrap()
    }

    /// The same number of the same kind at the same time is one datum; the pulse of the first turn is left out.
    #[test]
    fn data_are_taken_once_and_none_of_those_asked_for_may_lack() {
        let pulses = |rows: &str| {
            let header = "beam,turn,midpoint [t_c],duration [t_c],closest_approach [t_c],period [t_c]";
            DataFile::of_bytes("pulses", format!("{header}\n{rows}").into_bytes()).unwrap()
        };
        let (measurement, signal) = measured("strain:1,arrivals:1", 400.0, 10);
        let both = [pulses("1,0,0.5,1,1,\n1,9,50,1,50,\n1,10,56,1,56,\n"), strains("3,1,2\n4,1,2\n")];
        let (data, left_out) = measurement.data_in(&both, &signal).unwrap();
        assert_eq!((data.len(), left_out), (6, LeftOut { first_turn: 1, shared_turns: 0 }));
        let why = measurement.data_in(&both[1..], &signal).unwrap_err();
        assert!(why.contains("--observe arrivals: there is no such datum in strains"), "{why}");
        let twice = [pulses("1,9,50,1,50,\n1,10,56,1,56,\n"), pulses("1,10,56,1,56,\n")];
        let why = measured("arrivals:1", 400.0, 10).0.data_in(&twice, &signal).unwrap_err();
        assert!(why.starts_with("pulses: arrivals = 56.0 occurs twice"), "{why}");

        let (measurement, signal) = measured("strain:1", 400.0, 10);
        for (rows, is_taken) in [("3,1,2\n", false), ("3,1.5,2\n", true), ("5,1,2\n", true)] {
            let data = measurement.data_in(&[strains("3,1,2\n4,1,2\n"), strains(rows)], &signal);
            assert_eq!(
                data.map(|(data, left_out)| (data.len(), left_out)).ok(),
                is_taken.then_some((6, LeftOut::default())),
                "{rows}"
            );
        }
        let again = strains("3,1,2\n4,1,2\n4,1,2\n");
        // Of both polarizations, and of one.
        for observe in ["strain:1", "h_plus:1"] {
            let why = measured(observe, 400.0, 10).0.data_in(std::slice::from_ref(&again), &signal).unwrap_err();
            assert!(why.contains("h_plus = 1.0 occurs twice"), "{why}");
        }
    }

    #[test]
    fn data_of_two_kinds_numbers_or_times_are_two() {
        let (observable, place) = (twofold::inference::Observable::StrainPlus, Place::Time(3.0));
        let datum = Datum { observable, place, epoch: 0.0, value: 1.0, sigma: 1.0 };
        let same = |a: &Datum, b: &Datum| identity(a) == identity(b);
        assert!(same(&datum, &datum));
        let cross = Datum { observable: twofold::inference::Observable::StrainCross, ..datum };
        for other in [cross, Datum { value: 2.0, ..datum }, Datum { place: Place::Time(4.0), ..datum }] {
            assert!(!same(&datum, &other), "{other:?}");
        }
    }
}
