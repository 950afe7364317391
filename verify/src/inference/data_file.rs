//! Measured series as `twofold pulses` and `twofold run` write them.

use std::fs::File;

use super::{Datum, Noise, Observable, Place};
use crate::scene_file::Scene;

/// A table with the columns that are wanted of it.
struct Columns {
    reader: csv::Reader<File>,
    places: Vec<usize>,
}

impl Columns {
    fn open(path: &str, wanted: &[String]) -> Result<Self, String> {
        let mut reader = csv::Reader::from_path(path).map_err(|error| format!("{path}: {error}"))?;
        let header = reader.headers().map_err(|error| format!("{path}: {error}"))?.clone();
        let place = |name: &String| {
            header.iter().position(|column| column == name).ok_or_else(|| {
                let found = header.iter().collect::<Vec<_>>().join(", ");
                format!("{path}: no column `{name}`: its columns are {found}")
            })
        };
        let places = wanted.iter().map(place).collect::<Result<_, _>>()?;
        Ok(Self { reader, places })
    }

    /// Every row with its line, its fields in the order wanted.
    fn rows(self, path: &str) -> impl Iterator<Item = Result<(u64, Vec<String>), String>> {
        let Self { reader, places } = self;
        reader.into_records().map(move |record| {
            let record = record.map_err(|error| format!("{path}: {error}"))?;
            let line = record.position().map_or(0, csv::Position::line);
            Ok((line, places.iter().map(|place| record.get(*place).unwrap_or("").to_owned()).collect()))
        })
    }
}

fn number(path: &str, line: u64, name: &str, text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("{path}:{line}: `{name}` is `{text}`: allowed is a finite number")),
    }
}

/// Whether a file is a table of pulses, by its header.
///
/// # Errors
/// A file that cannot be read.
pub fn is_of_pulses(path: &str) -> Result<bool, String> {
    let mut reader = csv::Reader::from_path(path).map_err(|error| format!("{path}: {error}"))?;
    Ok(reader.headers().map_err(|error| format!("{path}: {error}"))?.iter().any(|column| column == "turn"))
}

/// The data of the whole pulses of the first beam in a table of `twofold pulses`, in units of `t_c` from the start of the scene.
///
/// Pulses without a turn, and two of one turn, are left out.
///
/// # Errors
/// A file that cannot be read, a column that is missing and a field that is no number; file, line, column and field are named.
pub fn read_pulses(path: &str, scene: &Scene, noise: &[Noise]) -> Result<Vec<Datum>, String> {
    let unit = scene.units.time_name;
    let wanted = [
        "beam".to_owned(),
        "turn".to_owned(),
        format!("midpoint [{unit}]"),
        format!("duration [{unit}]"),
        format!("closest_approach [{unit}]"),
        format!("period [{unit}]"),
    ];
    let mut rows = Vec::new();
    for row in Columns::open(path, &wanted)?.rows(path) {
        let (line, fields) = row?;
        if fields[0] != "1" || fields[1].is_empty() {
            continue;
        }
        let turn: i64 = fields[1]
            .parse()
            .map_err(|_| format!("{path}:{line}: `turn` is `{}`: allowed is a whole number, or nothing", fields[1]))?;
        rows.push((line, turn, fields));
    }
    let single = |turn: i64| rows.iter().filter(|(_, other, _)| *other == turn).count() == 1;
    let (start, time) = (scene.times.start(), scene.units.time);
    let mut data = Vec::new();
    for (line, turn, fields) in rows.iter().filter(|(_, turn, _)| single(*turn)) {
        let field = |column: usize| number(path, *line, &wanted[column], &fields[column]);
        let near = (field(2)? - start) / time;
        for &(observable, sigma) in noise {
            let value = match observable {
                Observable::Arrivals => near,
                Observable::Widths => field(3)? / time,
                Observable::ClosestApproaches => (field(4)? - start) / time,
                // A period across turns without a pulse is none.
                Observable::Periods if !fields[5].is_empty() && single(turn - 1) => field(5)? / time,
                _ => continue,
            };
            data.push(Datum { observable, place: Place::Turn { number: *turn, near }, epoch: 0.0, value, sigma });
        }
    }
    Ok(data)
}

/// The strains in a table of `twofold run` with the columns `h`.
///
/// # Errors
/// As for [`read_pulses`].
pub fn read_strain(path: &str, scene: &Scene, noise: &[Noise]) -> Result<Vec<Datum>, String> {
    let wanted = [format!("t [{}]", scene.units.time_name), "h_plus [1]".to_owned(), "h_cross [1]".to_owned()];
    let mut data = Vec::new();
    for row in Columns::open(path, &wanted)?.rows(path) {
        let (line, fields) = row?;
        let field = |column: usize| number(path, line, &wanted[column], &fields[column]);
        let place = Place::Time((field(0)? - scene.times.start()) / scene.units.time);
        for &(observable, sigma) in noise {
            let value = match observable {
                Observable::StrainPlus => field(1)?,
                Observable::StrainCross => field(2)?,
                _ => continue,
            };
            data.push(Datum { observable, place, epoch: 0.0, value, sigma });
        }
    }
    Ok(data)
}
