//! Arrival times and pulse widths over decades: `.tim` files, and tables in the format of `twofold timing`.

use std::collections::HashSet;

use twofold::epoch::Epoch;
use twofold::inference::{MeasuredArrival, MeasuredWidth, Noise, Observable, TimingData};
use twofold::observables::pulsar::timing_model::TimingModel;

use super::DataFile;
use super::data_file::MOST_ROWS;
use crate::scene_file::shortened;

/// Sites of a `.tim` file that mean the solar-system barycentre.
const BARYCENTRE: [&str; 4] = ["@", "bat", "ssb", "bary"];

/// Allowed standard deviations (s) of an arrival time.
const SIGMAS: std::ops::RangeInclusive<f64> = 1e-15..=1e6;

/// Longest width of a pulse (s).
const LONGEST_WIDTH: f64 = 1e9;

/// Flags of a `.tim` file that change a time or its phase.
const CHANGING: [&str; 4] = ["-to", "-padd", "-addsat", "-jump"];

/// The arrival times and widths of several files, each read as by [`DataFile::add_timing`]. Every file counts its pulses from its own origin, and
/// `model` relates these origins ([`TimingData::numbered`]). Without a model the numbers are unchanged, and only one file may have numbers.
///
/// # Errors
/// A file that cannot be read; a second file with numbers if there is no model; the same datum twice.
pub fn read_timing(
    paths: &[String],
    epoch: &Epoch,
    noise: &[Noise],
    model: Option<&TimingModel>,
) -> Result<TimingData, String> {
    let has_numbers = |data: &TimingData| data.arrivals.iter().any(|arrival| arrival.number.is_some());
    let mut data = TimingData::default();
    for path in paths {
        let mut more = TimingData::default();
        DataFile::read(path)?.add_timing(epoch, noise, &mut more)?;
        match model {
            Some(model) => more = more.numbered(model).map_err(|error| format!("{path}: {error}"))?,
            None if has_numbers(&data) && has_numbers(&more) => {
                return Err(format!(
                    "{path}: it numbers its pulses, and so does an earlier file, perhaps from another pulse; give a model to count them by, \
                     or one file with numbers"
                ));
            }
            None => (),
        }
        data.arrivals.extend(more.arrivals);
        data.widths.extend(more.widths);
        if let Some(time) = measured_twice(&data) {
            let date = epoch.after(time).map_err(|error| format!("{path}: {error}"))?;
            return Err(format!(
                "{path}: the datum of MJD {date} occurs twice, or also in an earlier file; each datum can be given only once"
            ));
        }
    }
    Ok(data)
}

/// The sum of two doubles as the nearest double and the rest, whichever two doubles were given (Knuth's exact sum); zeros are positive.
fn same([time, rest]: [f64; 2]) -> [f64; 2] {
    let sum = time + rest;
    let added = sum - time;
    [sum + 0.0, (time - (sum - added)) + (rest - added)]
}

/// The time (s) of an arrival that has the time of another one, or of a width that has the time and the length of another one; `None` if there is none. No two
/// measurements agree to sixteen digits, so it is the same measurement twice.
pub fn measured_twice(data: &TimingData) -> Option<[f64; 2]> {
    let (mut arrivals, mut widths) = (HashSet::new(), HashSet::new());
    let arrival =
        data.arrivals.iter().map(|arrival| arrival.time).find(|time| !arrivals.insert(same(*time).map(f64::to_bits)));
    let width = data.widths.iter().find(|width| !widths.insert([width.time, width.duration].map(f64::to_bits)));
    arrival.or(width.map(|width| [width.time, 0.0]))
}

impl DataFile {
    /// Adds the arrival times and widths of a `.tim` file (FORMAT 1, barycentred, infinite frequency), or of a table with the columns
    /// `arrival_day [MJD]`, `arrival_fraction [d]` and, for widths, `duration [s]`; a column `pulse` numbers the pulses. `noise` gives the standard
    /// deviations (s) for a table; a `.tim` file has its own.
    ///
    /// # Errors
    /// An invalid line, column or field; the error names file, line, field and the allowed values.
    pub fn add_timing(&self, epoch: &Epoch, noise: &[Noise], data: &mut TimingData) -> Result<(), String> {
        let is_comment = |line: &&str| line.is_empty() || line.starts_with('#') || line.starts_with("C ");
        let first = self.text.lines().map(str::trim).find(|line| !is_comment(line));
        if self.name.ends_with(".tim") || first.is_some_and(|line| line.starts_with("FORMAT")) {
            self.tim(epoch, data)
        } else {
            self.table(epoch, noise, data)
        }
    }

    fn tim(&self, epoch: &Epoch, data: &mut TimingData) -> Result<(), String> {
        let mut has_format = false;
        for (place, line) in self.text.lines().enumerate() {
            let refuse = |what: String| format!("{}:{}: {what}", self.name, place + 1);
            if line.trim_end().contains('\r') {
                return Err(refuse("a carriage return within the line; lines must end with a line feed".to_owned()));
            }
            let fields: Vec<_> = line.split_whitespace().collect();
            match fields[..] {
                [] | ["MODE", "1"] => continue,
                ["FORMAT", "1"] => has_format = true,
                [first, ..] if first.starts_with('#') || first == "C" => continue,
                ["FORMAT", other, ..] => {
                    return Err(refuse(format!("`FORMAT {}`: must be FORMAT 1", shortened(other))));
                }
                [..] if !has_format => {
                    return Err(refuse(format!(
                        "`{}`: the line FORMAT 1 must come before the first arrival",
                        shortened(line)
                    )));
                }
                [_, frequency, date, error, site, ref flags @ ..] => {
                    if !BARYCENTRE.contains(&site.to_lowercase().as_str()) {
                        return Err(refuse(format!(
                            "site `{}`: must be one of {}, for barycentred arrival times as a timing program writes them",
                            shortened(site),
                            BARYCENTRE.join(", ")
                        )));
                    }
                    if !frequency.parse::<f64>().is_ok_and(|frequency| frequency == 0.0 || frequency == f64::INFINITY) {
                        return Err(refuse(format!(
                            "frequency `{}`: must be 0 (infinite), for arrival times corrected for dispersion",
                            shortened(frequency)
                        )));
                    }
                    let sigma = error.parse::<f64>().ok().map(|sigma| sigma * 1e-6);
                    let sigma = sigma.filter(|sigma| SIGMAS.contains(sigma)).ok_or_else(|| {
                        refuse(format!(
                            "uncertainty `{}`: must be a number of microseconds from 1e-9 to 1e12",
                            shortened(error)
                        ))
                    })?;
                    if let Some(flag) = flags.iter().find(|flag| CHANGING.contains(flag)) {
                        return Err(refuse(format!(
                            "`{flag}` changes the time or its phase; use times that are already corrected for it"
                        )));
                    }
                    let number = match flags.iter().position(|flag| *flag == "-pn") {
                        None => None,
                        Some(at) => {
                            let text = flags.get(at + 1).copied().unwrap_or("");
                            // As PINT writes it.
                            Some(self.whole(place as u64 + 1, "-pn", text.strip_suffix(".0").unwrap_or(text))?)
                        }
                    };
                    let at: Epoch = date.parse().map_err(|error| refuse(format!("`{}`: {error}", shortened(date))))?;
                    data.arrivals.push(MeasuredArrival { time: at.seconds_since(epoch), sigma, number });
                }
                _ => {
                    return Err(refuse(format!(
                        "`{}`: expected a name, a frequency, a date, an uncertainty and a site, or FORMAT 1, MODE 1 or a comment",
                        shortened(line)
                    )));
                }
            }
            if data.arrivals.len() > MOST_ROWS {
                return Err(refuse(format!("too many arrivals; at most {MOST_ROWS} are read")));
            }
        }
        Ok(())
    }

    fn table(&self, epoch: &Epoch, noise: &[Noise], data: &mut TimingData) -> Result<(), String> {
        let sigma =
            |kind: Observable| noise.iter().find(|(observable, _)| *observable == kind).map(|(_, sigma)| *sigma);
        let (of_arrival, of_width) = (sigma(Observable::Arrivals), sigma(Observable::Widths));
        if of_arrival.is_none() && of_width.is_none() {
            return Err(format!(
                "{}: a table has no standard deviations; give them with --observe, such as arrivals:1e-6 or widths:1e-5 in seconds",
                self.name
            ));
        }
        let has_numbers = self.columns()?.iter().any(|column| column == "pulse");
        let mut wanted = vec!["arrival_day [MJD]".to_owned(), "arrival_fraction [d]".to_owned()];
        wanted.extend(of_width.map(|_| "duration [s]".to_owned()));
        wanted.extend(has_numbers.then(|| "pulse".to_owned()));
        for (line, fields) in self.rows(&wanted)? {
            let field = |column: usize| self.number(line, &wanted[column], &fields[column]);
            let day = self.whole(line, &wanted[0], &fields[0])?;
            let fraction = field(1)?;
            if !(0.0..1.0).contains(&fraction) {
                let (name, column) = (&self.name, &wanted[1]);
                return Err(format!("{name}:{line}: `{column}` = `{fraction}`: must be a number from 0 to below 1"));
            }
            let at = Epoch::new(day, fraction).map_err(|error| format!("{}:{line}: {error}", self.name))?;
            let time = at.seconds_since(epoch);
            let number = has_numbers.then(|| self.whole(line, "pulse", &fields[wanted.len() - 1])).transpose()?;
            data.arrivals.extend(of_arrival.map(|sigma| MeasuredArrival { time, sigma, number }));
            if let Some(sigma) = of_width {
                let duration = field(2)?;
                if !(0.0..=LONGEST_WIDTH).contains(&duration) || duration == 0.0 {
                    let (name, column) = (&self.name, &wanted[2]);
                    return Err(format!(
                        "{name}:{line}: `{column}` = `{}`: must be a number above zero and at most {LONGEST_WIDTH:e}",
                        shortened(&fields[2])
                    ));
                }
                data.widths.push(MeasuredWidth { time: time[0], duration, sigma });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Result<TimingData, String> {
        let file = DataFile::of_bytes(name, text.as_bytes().to_vec())?;
        let mut data = TimingData { arrivals: Vec::new(), widths: Vec::new(), priors: Vec::new() };
        let noise = [(Observable::Arrivals, 0.5), (Observable::Widths, 0.25)];
        file.add_timing(&Epoch::new(55000, 0.0).unwrap(), &noise, &mut data).map(|()| data)
    }

    #[test]
    fn the_same_time_is_found_in_whatever_two_parts() {
        let twice = |times: [[f64; 2]; 2]| {
            let arrivals = times.map(|time| MeasuredArrival { time, sigma: 1.0, number: None });
            measured_twice(&TimingData { arrivals: arrivals.to_vec(), ..TimingData::default() })
        };
        for [one, other] in [
            [[1e9, 0.25], [1e9 + 0.25, 0.0]],
            [[0.1, 0.2], [0.2, 0.1]],
            [[1e-9, 1e9], [1e9, 1e-9]],
            [[-3.0, 0.0], [-1.0, -2.0]],
            [[0.0, 0.0], [-0.0, -0.0]],
            [[5.0, 1e-20], [5.0, 1e-20]],
        ] {
            assert_eq!(twice([one, other]), Some(other));
        }
        for times in [
            [[1e9, 0.25], [1e9, 0.5]],
            [[5.0, 1e-20], [5.0, 2e-20]],
            [[5.0, 0.0], [5.0, 1e-20]],
            [[1e-17, 0.0], [2e-17, 0.0]],
            [[1.0, 0.0], [-1.0, 0.0]],
        ] {
            assert_eq!(twice(times), None);
        }
        let width = |time| MeasuredWidth { time, duration: 0.1, sigma: 1.0 };
        let widths = |times: [f64; 2]| TimingData { widths: times.map(width).to_vec(), ..TimingData::default() };
        assert_eq!(measured_twice(&widths([7.0, 7.0])), Some([7.0, 0.0]));
        assert_eq!(measured_twice(&widths([7.0, 8.0])), None);
    }

    #[test]
    fn two_files_with_numbers_need_a_model() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path.to_str().unwrap().to_owned()
        };
        let line = |day: &str, flag: &str| format!("FORMAT 1\nx 0.0 {day} 2.0 @{flag}\n");
        let numbered = [path("a.tim", &line("55000.5", " -pn 3")), path("b.tim", &line("55001.5", " -pn 9"))];
        let plain = path("c.tim", &line("55002.5", ""));
        let read = |paths: &[&String]| {
            let paths: Vec<String> = paths.iter().map(|path| path.to_string()).collect();
            read_timing(&paths, &Epoch::new(55000, 0.0).unwrap(), &[], None)
        };
        let [a, b] = &numbered;
        assert!(read(&[a, b]).unwrap_err().starts_with(&format!("{b}: it numbers its pulses")));
        for paths in [[a, &plain], [&plain, b]] {
            assert_eq!(read(&paths).unwrap().arrivals.len(), 2);
        }
    }

    /// A `.tim` file is recognised by its name, or by its first line that is not a comment. Uncertainties are in
    /// microseconds; half a day is 43,200 s.
    #[test]
    fn arrival_times_of_timing_programs_are_told_from_tables() {
        let arrival = |number| vec![MeasuredArrival { time: [43_200.0, 0.0], sigma: 2e-6, number }];
        let line = "x 0.0 55000.5 2.0 @";
        assert_eq!(read("data", &format!("\n# a\nC b\nFORMAT 1\n{line} -pn 3\n")).unwrap().arrivals, arrival(Some(3)));
        assert_eq!(read("data.tim", &format!("FORMAT 1\n{line}\n")).unwrap().arrivals, arrival(None));
        // `C` alone begins a comment; a name may begin with it.
        let named = format!("C {line}\nFORMAT 1\nCHIME_0812{}\n", &line[1..]);
        assert_eq!(read("data.tim", &named).unwrap().arrivals, arrival(None));
        // A flag that changes the time is refused wherever it stands.
        for flags in ["-to 1e-3", "-pn 3 -to 1e-3", "-fe L -pn 3 -padd 0.5"] {
            let why = read("data.tim", &format!("FORMAT 1\n{line} {flags}\n")).unwrap_err();
            assert!(why.starts_with("data.tim:2: `-") && why.contains("changes the time or its phase"), "{why}");
        }
        let header = "arrival_day [MJD],arrival_fraction [d],duration [s]\n";
        let data = read("data", &format!("{header}55000,0.5,3\n")).unwrap();
        assert_eq!((data.arrivals[0].time, data.arrivals[0].sigma), ([43_200.0, 0.0], 0.5));
        assert_eq!(data.widths, [MeasuredWidth { time: 43_200.0, duration: 3.0, sigma: 0.25 }]);
        assert_eq!(read("data", &format!("{header}55000,0.5,1e9\n")).unwrap().widths[0].duration, 1e9);
        for (row, column) in [
            ("x,0.5,3", "arrival_day [MJD]"),
            ("55000,x,3", "arrival_fraction [d]"),
            ("55000,0.5,0", "duration [s]"),
            ("55000,0.5,2e9", "duration [s]"),
        ] {
            let why = read("data", &format!("{header}{row}\n")).unwrap_err();
            assert!(why.starts_with(&format!("data:2: `{column}`")), "{why}");
        }
    }
}
