//! The series of periods and widths of the pulses compared with ours.

use twofold::observables::pulsar::Stamped;

use super::allowed::{Allowed, allowed_of_series};
use super::known::{Content, KnownFile};
use super::recompute::{self, Start};
use super::table::Table;
use super::{ComparedFile, Verdict, judged};
use twofold_verify::paper_examples::PaperExample;

/// Two stamps closer than this, in t_c, belong to the same pulse; pulses of the examples are at least 3 t_c apart.
const SAME_PULSE: f64 = 1.0;

/// A series of stamps and values compared with our series with the nearest stamps: from the rounded initial values, with
/// which the authors' series were computed, and from those of Eq. (34).
pub(super) fn by_stamps(
    known: &'static KnownFile,
    table: &Table,
    example: &PaperExample,
) -> Result<Vec<ComparedFile>, twofold::Error> {
    let mut files = Vec::new();
    for (start, name, of_the_file) in
        [(Start::of_caption(example)?, "caption", true), (Start::of(example)?, "Eq. (34)", false)]
    {
        let (train, slowest) = recompute::train(&start, table)?;
        let ours: Vec<Stamped> = match known.content {
            Content::Periods => train.periods().collect(),
            _ => train.durations().collect(),
        };
        let distance = |stamped: &Stamped, row: &[f64]| (stamped.time - row[0]).abs();
        let mut taken = vec![false; ours.len()];
        // A pulse belongs to one row.
        let mut near = |row: &[f64]| {
            let nearest =
                (0..ours.len()).min_by(|&a, &b| distance(&ours[a], row).total_cmp(&distance(&ours[b], row)))?;
            let is_its = distance(&ours[nearest], row) < SAME_PULSE && !taken[nearest];
            taken[nearest] |= is_its;
            is_its.then_some(&ours[nearest])
        };
        let pairs: Vec<(&[f64], &Stamped)> =
            table.rows.iter().filter_map(|row| near(row).map(|stamped| (row.as_slice(), stamped))).collect();
        let alone = table.rows.len() - pairs.len();
        let mut columns = Vec::new();
        let [value] = known.columns()[..] else { continue };
        for (name, index) in [("stamp", 0), (value.name, 1)] {
            let differences = pairs.iter().map(|(row, ours)| (row[0], row[index] - [ours.time, ours.value][index]));
            let allowed = if of_the_file { allowed_of_series(known, name, slowest) } else { Allowed::OTHER_START };
            let mut column = judged(name, value.unit, differences, allowed);
            if alone > 0 && column.verdict == Verdict::Agrees {
                column.verdict = Verdict::Differs;
            }
            columns.push(column);
        }
        let mut notes = Vec::new();
        if alone > 0 {
            let rows = if alone == 1 { "row of the file has" } else { "rows of the file have" };
            notes.push(format!("{alone} {rows} no counterpart of its own in ours within {SAME_PULSE} t_c"));
        }
        let (first, last) = (table.rows[0][0], table.last_time());
        let in_file = |stamped: &Stamped| pairs.iter().any(|(_, ours)| *ours == stamped);
        let left_out: Vec<_> =
            ours.iter().filter(|ours| (first..=last).contains(&ours.time) && !in_file(ours)).collect();
        if !left_out.is_empty() {
            let shortest = left_out.iter().map(|stamped| stamped.value).fold(f64::INFINITY, f64::min);
            let are = if left_out.len() == 1 { "is" } else { "are" };
            notes
                .push(format!("{} of ours {are} not in the file, the shortest {shortest:.3} t_c long", left_out.len()));
        }
        files.push(ComparedFile { file: known.name, start: name.into(), rows: table.rows.len(), columns, notes });
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use twofold_verify::paper_examples::paper_examples;

    use super::super::known::KNOWN;
    use super::*;

    /// The series computed here agrees with itself; with a row between two of its pulses it does not.
    #[test]
    fn a_file_with_a_row_of_no_pulse_differs() {
        let [example, ..] = paper_examples();
        let known = KNOWN.iter().find(|file| file.name == "mntp1_pset.dat").expect("it is known");
        let start = Start::of_caption(&example).unwrap();
        let table = Table { rows: vec![vec![0.0, 0.0], vec![30.0, 0.0]] };
        let mut rows: Vec<_> =
            recompute::train(&start, &table).unwrap().0.periods().map(|found| vec![found.time, found.value]).collect();
        let verdicts = |rows: &[Vec<f64>]| {
            let files = by_stamps(known, &Table { rows: rows.to_vec() }, &example).unwrap();
            let largest_at = files.iter().flat_map(|file| &file.columns).map(|column| column.time).collect::<Vec<_>>();
            assert!(largest_at.iter().all(|time| rows.iter().any(|row| row[0] == *time)), "{largest_at:?}");
            files.iter().map(|file| file.columns.iter().map(|column| column.verdict).collect()).collect::<Vec<Vec<_>>>()
        };
        use Verdict::{Agrees, Differs, NotJudged};
        assert_eq!(verdicts(&rows), [[Agrees, Agrees], [NotJudged, NotJudged]]);
        rows.insert(1, vec![(rows[0][0] + rows[1][0]) / 2.0, rows[0][1]]);
        assert_eq!(verdicts(&rows), [[Differs, Differs], [NotJudged, NotJudged]]);
        // The second row again, a little earlier, replaces the first.
        rows.splice(..2, [vec![rows[2][0] - 1e-6, rows[2][1]]]);
        assert_eq!(verdicts(&rows), [[Differs, Differs], [NotJudged, NotJudged]]);
    }

    /// Periods are about 4.4 t_c long: a stamp midway between two belongs to neither.
    #[test]
    fn a_row_between_two_pulses_is_of_none() {
        let [example, ..] = paper_examples();
        let known = KNOWN.iter().find(|file| file.name == "mntp1_pset.dat").expect("it is known");
        let notes = |rows: &[[f64; 2]]| {
            let table = Table { rows: rows.iter().map(|row| row.to_vec()).collect() };
            by_stamps(known, &table, &example).unwrap().into_iter().flat_map(|file| file.notes).collect::<Vec<_>>()
        };
        let start = Start::of(&example).unwrap();
        let table = Table { rows: vec![vec![0.0, 0.0], vec![30.0, 0.0]] };
        let ours: Vec<Stamped> = recompute::train(&start, &table).unwrap().0.periods().collect();
        let [first, second] = [&ours[0], &ours[1]].map(|stamped| [stamped.time, stamped.value]);
        let middle = [(first[0] + second[0]) / 2.0, first[1]];
        let alone = |notes: &[String], rows: &str| {
            let text = format!("{rows} no counterpart of its own in ours within 1 t_c");
            notes.iter().filter(|note| **note == text).count()
        };
        assert!(!notes(&[first, second]).iter().any(|note| note.contains("no counterpart")));
        // Compared with both of our starts.
        let found = notes(&[first, middle, second]);
        assert_eq!(alone(&found, "1 row of the file has"), 2, "{found:?}");
        let found = notes(&[first, middle, [middle[0] + 1e-3, middle[1]], second]);
        assert_eq!(alone(&found, "2 rows of the file have"), 2, "{found:?}");
        // Pulses missing in the file are reported with its shortest period.
        assert!(!notes(&[first, second]).iter().any(|note| note.contains("not in the file")));
        let rows = [0, 2, 5].map(|k| [ours[k].time, ours[k].value]);
        let shortest = [1, 3, 4].map(|k| ours[k].value).into_iter().fold(f64::INFINITY, f64::min);
        let lacking = format!("3 of ours are not in the file, the shortest {shortest:.3} t_c long");
        assert!(notes(&rows).contains(&lacking), "{lacking}: {:?}", notes(&rows));
        let lacking = format!("1 of ours is not in the file, the shortest {:.3} t_c long", ours[1].value);
        let found = notes(&[0, 2].map(|k| [ours[k].time, ours[k].value]));
        assert!(found.contains(&lacking), "{lacking}: {found:?}");
    }
}
