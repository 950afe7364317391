//! Measured series as `twofold pulses` and `twofold run` write them.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;

use twofold::inference::{Datum, Noise, Observable, Place};

use crate::scene_file::{LARGEST_FILE, Scene, shortened};

/// Most rows of a file: a fit keeps a derivative of each datum by each unknown, and as many samples are allowed of a scene.
pub(super) const MOST_ROWS: usize = 100_000;

/// Most columns that a message names.
const MOST_NAMED: usize = 30;

/// Largest whole number in size, as of a turn: every one up to it is a double.
const LARGEST_TURN: i64 = 1_000_000_000_000_000;

/// A table of measured numbers, with the name that messages call it by.
#[derive(Debug)]
pub struct DataFile {
    pub(super) name: String,
    pub(super) text: String,
}

/// Every row with its line, its fields in the order wanted.
type Rows = Vec<(u64, Vec<String>)>;

impl DataFile {
    /// Reads the file at `path`, up to 64 MiB.
    pub fn read(path: &str) -> Result<Self, String> {
        let mut bytes = Vec::new();
        let file = File::open(path).map_err(|error| format!("{path}: {error}"))?;
        // Bounded while reading, so that a device or pipe cannot fill the memory.
        file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| format!("{path}: {error}"))?;
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(format!("{path}: is longer than {} MiB, the most that is read", LARGEST_FILE >> 20));
        }
        Self::of_bytes(path, bytes)
    }

    /// A table whose bytes are known; messages call it `name`.
    pub fn of_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, String> {
        let text = String::from_utf8(bytes).map_err(|error| {
            let byte = error.utf8_error().valid_up_to() + 1;
            format!("{name}: is not UTF-8 text (byte {byte}): a table of comma-separated values is")
        })?;
        Ok(Self { name: name.to_owned(), text })
    }

    /// Whether it is a table of pulses, by its header.
    pub fn is_of_pulses(&self) -> Result<bool, String> {
        Ok(self.columns()?.iter().any(|column| column == "turn"))
    }

    /// The names in the header.
    pub(super) fn columns(&self) -> Result<csv::StringRecord, String> {
        let mut reader = csv::Reader::from_reader(self.text.as_bytes());
        Ok(reader.headers().map_err(|error| format!("{}: {error}", self.name))?.clone())
    }

    pub(super) fn rows(&self, wanted: &[String]) -> Result<Rows, String> {
        let name = &self.name;
        let mut reader = csv::Reader::from_reader(self.text.as_bytes());
        let header = reader.headers().map_err(|error| format!("{name}: {error}"))?.clone();
        let place = |column: &String| {
            header.iter().position(|found| found == column).ok_or_else(|| {
                let mut found: Vec<_> = header.iter().take(MOST_NAMED).map(shortened).collect();
                found.extend((header.len() > MOST_NAMED).then(|| format!("and {} more", header.len() - MOST_NAMED)));
                let found = found.join(", ");
                format!("{name}: no column `{column}`: its columns are {found}")
            })
        };
        let places = wanted.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        let mut rows = Vec::new();
        for record in reader.into_records() {
            let record = record.map_err(|error| format!("{name}: {error}"))?;
            let line = record.position().map_or(0, csv::Position::line);
            if rows.len() == MOST_ROWS {
                return Err(format!("{name}:{line}: one row too many: allowed are {MOST_ROWS} in a file"));
            }
            rows.push((line, places.iter().map(|place| record.get(*place).unwrap_or("").to_owned()).collect()));
        }
        Ok(rows)
    }

    pub(super) fn number(&self, line: u64, column: &str, text: &str) -> Result<f64, String> {
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("{}:{line}: `{column}` is `{}`: allowed is a finite number", self.name, shortened(text))),
        }
    }

    pub(super) fn whole(&self, line: u64, column: &str, text: &str) -> Result<i64, String> {
        let whole = text.parse().ok().filter(|whole| (-LARGEST_TURN..=LARGEST_TURN).contains(whole));
        whole.ok_or_else(|| {
            let (name, text) = (&self.name, shortened(text));
            format!("{name}:{line}: `{column}` is `{text}`: allowed is a whole number from -1e15 to 1e15")
        })
    }

    /// The data of the whole pulses of the first beam in a table of `twofold pulses`, in units of `t_c` from the start of the
    /// scene.
    ///
    /// Pulses without a turn, and two of one turn, are left out.
    ///
    /// # Errors
    /// A column that is missing, a field that is no number and more than 100,000 rows; file, line, column and field are named.
    pub fn pulses(&self, scene: &Scene, noise: &[Noise]) -> Result<Vec<Datum>, String> {
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
        let mut of_turn: HashMap<i64, usize> = HashMap::new();
        for (line, fields) in self.rows(&wanted)? {
            if fields[0] != "1" || fields[1].is_empty() {
                continue;
            }
            let turn = self.whole(line, "turn", &fields[1])?;
            *of_turn.entry(turn).or_default() += 1;
            rows.push((line, turn, fields));
        }
        let single = |turn: i64| of_turn.get(&turn) == Some(&1);
        let (start, time) = (scene.times.start(), scene.units.time);
        let mut data = Vec::new();
        for (line, turn, fields) in rows.iter().filter(|(_, turn, _)| single(*turn)) {
            let field = |column: usize| self.number(*line, &wanted[column], &fields[column]);
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
    pub fn strain(&self, scene: &Scene, noise: &[Noise]) -> Result<Vec<Datum>, String> {
        let wanted = [format!("t [{}]", scene.units.time_name), "h_plus [1]".to_owned(), "h_cross [1]".to_owned()];
        let mut data = Vec::new();
        for (line, fields) in self.rows(&wanted)? {
            let field = |column: usize| self.number(line, &wanted[column], &fields[column]);
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
}
