//! Measured series in the format of `twofold pulses` and `twofold run`.

use std::collections::{HashMap, HashSet};
use std::fs::File;

use twofold::inference::{Datum, Noise, Observable, Place};

use crate::scene_file::{Scene, shortened};
use crate::text_file::{read_text, text_of};

/// Largest number of rows of a file: a fit stores the derivative of each datum with respect to each unknown. A scene may
/// have as many samples.
pub(super) const MOST_ROWS: usize = 100_000;

/// Largest number of columns named in a message.
const MOST_NAMED: usize = 30;

/// Largest absolute value of an integer, for example of a turn number: every integer up to it is a double.
const LARGEST_TURN: i64 = 1_000_000_000_000_000;

/// A table of measured numbers, with its name for messages.
#[derive(Debug)]
pub struct DataFile {
    pub(super) name: String,
    pub(super) text: String,
}

fn is_among(kind: Observable, noise: &[Noise]) -> bool {
    noise.iter().any(|(observable, _)| *observable == kind)
}

/// The names in a header, for messages.
fn listed(header: &csv::StringRecord) -> String {
    let mut found: Vec<_> = header.iter().take(MOST_NAMED).map(shortened).collect();
    found.extend((header.len() > MOST_NAMED).then(|| format!("and {} more", header.len() - MOST_NAMED)));
    found.join(", ")
}

/// Every row with its line number, with its fields in the requested order.
type Rows = Vec<(u64, Vec<String>)>;

impl DataFile {
    /// Reads the file at `path`, up to 64 MiB.
    pub fn read(path: &str) -> Result<Self, String> {
        let file = File::open(path).map_err(|error| format!("{path}: {error}"))?;
        let text = read_text(file).map_err(|why| format!("{path}: {why}"))?;
        Ok(Self { name: path.to_owned(), text })
    }

    /// A table with given bytes; messages call it `name`.
    pub fn of_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, String> {
        let text = text_of(bytes).map_err(|why| format!("{name}: {why}"))?;
        Ok(Self { name: name.to_owned(), text })
    }

    /// Whether it is a table of pulses or else of strains, according to its header.
    ///
    /// # Errors
    /// It is neither.
    pub fn is_of_pulses(&self) -> Result<bool, String> {
        let header = self.columns()?;
        let has = |start: &str| header.iter().any(|column| column.starts_with(start));
        let of_pulses = header.iter().any(|column| column == "turn") || has("midpoint [");
        if of_pulses || has("t [") {
            return Ok(of_pulses);
        }
        Err(format!(
            "{}: expected the columns `turn` and `midpoint` of pulses, or `t` of strains; found {}, separated by commas",
            self.name,
            listed(&header)
        ))
    }

    fn reader(&self) -> csv::Reader<&[u8]> {
        csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(self.text.as_bytes())
    }

    /// The names in the header.
    pub(super) fn columns(&self) -> Result<csv::StringRecord, String> {
        Ok(self.reader().headers().map_err(|error| format!("{}: {error}", self.name))?.clone())
    }

    /// The fields of the wanted columns; a name that is empty stands for a column that is not used, and has empty fields.
    pub(super) fn rows(&self, wanted: &[String]) -> Result<Rows, String> {
        let name = &self.name;
        let header = self.columns()?;
        let place = |column: &String| {
            let mut places = (0..header.len()).filter(|place| header[*place] == **column);
            match (places.next(), places.next()) {
                _ if column.is_empty() => Ok(None),
                (Some(_), Some(_)) => Err(format!("{name}: the column `{column}` occurs twice")),
                (None, _) => Err(format!("{name}: missing column `{column}`; found {}", listed(&header))),
                (place, None) => Ok(place),
            }
        };
        let places = wanted.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        let mut rows = Vec::new();
        for record in self.reader().into_records() {
            let record = record.map_err(|error| format!("{name}: {error}"))?;
            let line = record.position().expect("a record that was read has a place").line();
            if rows.len() == MOST_ROWS {
                return Err(format!("{name}:{line}: too many rows; a file can have at most {MOST_ROWS}"));
            }
            let field = |place: &Option<usize>| place.and_then(|place| record.get(place)).unwrap_or("").to_owned();
            rows.push((line, places.iter().map(field).collect()));
        }
        Ok(rows)
    }

    pub(super) fn number(&self, line: u64, column: &str, text: &str) -> Result<f64, String> {
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.refused(line, column, text, "a finite number")),
        }
    }

    fn positive(&self, line: u64, column: &str, text: &str) -> Result<f64, String> {
        match self.number(line, column, text)? {
            value if value > 0.0 => Ok(value),
            _ => Err(self.refused(line, column, text, "a number above zero")),
        }
    }

    pub(super) fn whole(&self, line: u64, column: &str, text: &str) -> Result<i64, String> {
        let whole = text.parse().ok().filter(|whole| (-LARGEST_TURN..=LARGEST_TURN).contains(whole));
        whole.ok_or_else(|| {
            self.refused(line, column, text, "a whole number from -1e15 to 1e15, written in digits only")
        })
    }

    fn refused(&self, line: u64, column: &str, text: &str, allowed: &str) -> String {
        format!("{}:{line}: `{column}` = `{}`: must be {allowed}", self.name, shortened(text))
    }

    /// The data of the whole pulses of the first beam in a table of `twofold pulses`, in units of `t_c` from the start of the
    /// scene. The columns `beam` and `cut` are read if the table has them, those of quantities if these are observed.
    ///
    /// Pulses that share a turn are left out; their number is returned with the data.
    ///
    /// # Errors
    /// A column that is missing or there twice, a field that is not a number, a duration that is not positive, a pulse that is there twice, or more than 100,000
    /// rows; the error names file, line, column and field.
    pub fn pulses(&self, scene: &Scene, noise: &[Noise]) -> Result<(Vec<Datum>, usize), String> {
        let (unit, header) = (scene.units.time_name, self.columns()?);
        let if_there = |name: &str| header.iter().find(|column| *column == name).unwrap_or("").to_owned();
        let of = |kind: Observable, name: &str| {
            if is_among(kind, noise) { format!("{name} [{unit}]") } else { String::new() }
        };
        let wanted = [
            if_there("beam"),
            "turn".to_owned(),
            format!("midpoint [{unit}]"),
            of(Observable::Widths, "duration"),
            of(Observable::ClosestApproaches, "closest_approach"),
            of(Observable::Periods, "period"),
            if_there("cut"),
        ];
        let mut rows = Vec::new();
        let mut of_turn: HashMap<i64, usize> = HashMap::new();
        let mut seen = HashSet::new();
        for (line, fields) in self.rows(&wanted)? {
            let is_first = match fields[0].as_str() {
                "1" => true,
                "2" => false,
                "" if wanted[0].is_empty() => true,
                other => return Err(self.refused(line, "beam", other, "1 or 2")),
            };
            let is_whole = match fields[6].as_str() {
                "" => true,
                "start" | "end" | "both" => false,
                other => {
                    return Err(self.refused(line, "cut", other, "start, end or both, or empty for a whole pulse"));
                }
            };
            if !(is_first && is_whole) {
                continue;
            }
            let turn = self.whole(line, "turn", &fields[1])?;
            *of_turn.entry(turn).or_default() += 1;
            if !seen.insert((turn, fields[2].clone())) {
                let (name, midpoint) = (&self.name, shortened(&fields[2]));
                return Err(format!(
                    "{name}:{line}: the pulse of turn {turn} at {midpoint} occurs twice; each datum can be given only once"
                ));
            }
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
                    Observable::Widths => self.positive(*line, &wanted[3], &fields[3])? / time,
                    Observable::ClosestApproaches => (field(4)? - start) / time,
                    // A period across turns without a pulse does not count.
                    Observable::Periods if !fields[5].is_empty() && single(turn - 1) => field(5)? / time,
                    _ => continue,
                };
                data.push(Datum { observable, place: Place::Turn { number: *turn, near }, epoch: 0.0, value, sigma });
            }
        }
        let shared = rows.iter().filter(|(_, turn, _)| !single(*turn)).count();
        Ok((data, shared))
    }

    /// The strains in a table of `twofold run` with the columns `h`.
    pub fn strain(&self, scene: &Scene, noise: &[Noise]) -> Result<Vec<Datum>, String> {
        let of = |kind: Observable, name: &str| if is_among(kind, noise) { name } else { "" }.to_owned();
        let (plus, cross) = (of(Observable::StrainPlus, "h_plus [1]"), of(Observable::StrainCross, "h_cross [1]"));
        let wanted = [format!("t [{}]", scene.units.time_name), plus, cross];
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::Times;

    fn table(text: &str) -> DataFile {
        DataFile::of_bytes("data", text.as_bytes().to_vec()).unwrap()
    }

    /// Times start at 10, in units of 2. A period exists if the previous turn has exactly one pulse.
    #[test]
    fn data_are_in_units_of_the_scene_from_its_start() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.units.time = 2.0;
        scene.times = Times::Listed { start: 10.0, times: vec![100.0] };
        let file = table(
            "beam,turn,midpoint [t_c],duration [t_c],closest_approach [t_c],period [t_c]\n1,4,30,3,31,\n1,5,38,3,39,8\n1,6,46,3,47,\n\
             2,6,46,3,47,8\n1,8,62,3,63,16\n1,9,70,3,71,8\n1,9,71,3,72,1\n1,10,78,3,79,8\n",
        );
        let noise = [Observable::Arrivals, Observable::Widths, Observable::ClosestApproaches, Observable::Periods];
        let (data, shared) = file.pulses(&scene, &noise.map(|observable| (observable, 0.5))).unwrap();
        assert_eq!(shared, 2);
        let of = |observable| {
            let data = data.iter().filter(move |datum| datum.observable == observable);
            data.map(|datum| (datum.place, datum.value)).collect::<Vec<_>>()
        };
        let turns = [(4, 10.0), (5, 14.0), (6, 18.0), (8, 26.0), (10, 34.0)];
        let place = |(number, near): (i64, f64)| Place::Turn { number, near };
        assert_eq!(of(Observable::Arrivals), turns.map(|turn| (place(turn), turn.1)));
        assert_eq!(of(Observable::Widths), turns.map(|turn| (place(turn), 1.5)));
        assert_eq!(of(Observable::ClosestApproaches), turns.map(|turn| (place(turn), turn.1 + 0.5)));
        assert_eq!(of(Observable::Periods), [(place(turns[1]), 4.0)]);
        let file = table("t [t_c],h_cross [1],h_plus [1]\n14,2.5,-1\n");
        let strain = |observable, value| Datum { observable, place: Place::Time(2.0), epoch: 0.0, value, sigma: 0.5 };
        let (plus, cross) = (Observable::StrainPlus, Observable::StrainCross);
        let found = file.strain(&scene, &[(plus, 0.5), (cross, 0.5)]).unwrap();
        assert_eq!(found, [strain(plus, -1.0), strain(cross, 2.5)]);
    }

    #[test]
    fn messages_name_thirty_columns_and_whole_numbers_go_to_ten_to_the_fifteen() {
        let names: Vec<_> = (1..=31).map(|i| format!("c{i}")).collect();
        let why = table(&names.join(",")).rows(&["x".to_owned()]).unwrap_err();
        assert!(why.ends_with("c29, c30, and 1 more"), "{why}");
        for sign in ["", "-"] {
            assert!(table("").whole(2, "turn", &format!("{sign}1000000000000000")).is_ok());
            let why = table("").whole(2, "turn", &format!("{sign}1000000000000001")).unwrap_err();
            assert!(why.starts_with("data:2: `turn`"), "{why}");
        }
    }
}
