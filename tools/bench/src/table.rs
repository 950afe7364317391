//! What was measured, as text for a reader and as CSV for a program.

use std::fmt::Write as _;

use super::method::{BASELINE, Carries};
use super::work_precision::{self, ERRORS, ratios, time_at};
use super::{growth, overhead, scaling};

/// All that is measured.
#[derive(Debug, Clone, Default)]
pub struct Results {
    /// Times against errors.
    pub work_precision: Vec<work_precision::Row>,
    /// Errors along long motions.
    pub growth: Vec<growth::Row>,
    /// Costs in addition to a motion.
    pub overhead: Vec<overhead::Row>,
    /// Times by the number of outputs, scenes and cores.
    pub scaling: Vec<scaling::Row>,
    /// Time before the first step (s).
    pub set_up: f64,
}

/// A table in Markdown, readable as it stands: columns padded, all but the first to the right.
fn markdown(header: &[&str], rows: &[Vec<String>]) -> String {
    let width = |i: usize| {
        rows.iter().map(|row| row[i].chars().count()).chain([header[i].chars().count(), 3]).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..header.len()).map(width).collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let mut line = String::from("|");
        for (i, (cell, width)) in cells.zip(&widths).enumerate() {
            let _ = if i == 0 { write!(line, " {cell:width$} |") } else { write!(line, " {cell:>width$} |") };
        }
        line + "\n"
    };
    let mut text = line(&mut header.iter().copied());
    let rule: Vec<_> =
        widths.iter().enumerate().map(|(i, w)| if i == 0 { "-".repeat(*w) } else { "-".repeat(w - 1) + ":" }).collect();
    text += &line(&mut rule.iter().map(String::as_str));
    for row in rows {
        text += &line(&mut row.iter().map(String::as_str));
    }
    text
}

/// A time with three digits.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.3} us", s * 1e6).replacen(".000", "", 1),
        s if s < 1.0 => format!("{:.3} ms", s * 1e3),
        s => format!("{s:.3} s"),
    }
}

fn scenes(rows: &[work_precision::Row]) -> Vec<&str> {
    distinct(rows.iter().map(|row| row.scene.as_str()))
}

/// Names of the methods that compute the given vectors, in order of appearance.
pub fn methods(rows: &[work_precision::Row], carries: Carries) -> Vec<&str> {
    distinct(rows.iter().filter(|row| row.carries == carries).map(|row| row.method.as_str()))
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// Times (ms) at equal errors, and their ratios to the baseline.
fn work_precision(rows: &[work_precision::Row]) -> String {
    let errors: Vec<_> = ERRORS.iter().map(|error| format!("{error:.0e}")).collect();
    let header: Vec<_> = ["scene", "method"].into_iter().chain(errors.iter().map(String::as_str)).collect();
    let mut text = String::new();
    for carries in Carries::ALL {
        let mut lines = Vec::new();
        for scene in scenes(rows) {
            for method in methods(rows, carries) {
                let ratios = ratios(rows, scene, method, carries);
                let cell = |(error, ratio): (&f64, Option<f64>)| match (
                    time_at(rows, scene, method, carries, *error),
                    ratio,
                ) {
                    (None, _) => "-".to_owned(),
                    (Some(t), Some(ratio)) if method != BASELINE => format!("{:.3} ({ratio:.2})", t * 1e3),
                    (Some(t), _) => format!("{:.3}", t * 1e3),
                };
                let cells = ERRORS.iter().zip(ratios).map(cell);
                lines.push([scene.to_owned(), method.to_owned()].into_iter().chain(cells).collect());
            }
        }
        let _ = writeln!(
            text,
            "Least time of work [ms] of a motion of 1,000 t_c at equal error, {carries} (in brackets: over {BASELINE})\n\n{}",
            markdown(&header, &lines)
        );
    }
    text
}

fn growth(rows: &[growth::Row]) -> String {
    let mut lines: Vec<_> = rows
        .iter()
        .map(|row| {
            let errors = [row.energy, row.clebsch, row.phase].map(|error| format!("{error:.1e}"));
            [row.method.to_owned(), format!("{:.0e}", row.time)].into_iter().chain(errors).collect::<Vec<_>>()
        })
        .collect();
    for method in distinct(rows.iter().map(|row| row.method)) {
        let exponents = [
            growth::exponent(rows, method, |row| row.energy),
            growth::exponent(rows, method, |row| row.clebsch),
            growth::exponent(rows, method, |row| row.phase),
        ];
        let cells = exponents.map(|p| p.map_or("-".to_owned(), |p| format!("{:.2}", p.value)));
        lines.push([method.to_owned(), "exponent".to_owned()].into_iter().chain(cells).collect());
    }
    markdown(&["method", "time [t_c]", "energy", "K", "phase"], &lines)
}

fn overhead(rows: &[overhead::Row]) -> String {
    let cells = |row: &overhead::Row| {
        vec![row.what.to_owned(), row.carries.to_string(), time(row.times.least), format!("{:.2}", row.ratio)]
    };
    markdown(
        &["tp-II, 1,000 t_c", "carries", "least time", "over the motion"],
        &rows.iter().map(cells).collect::<Vec<_>>(),
    )
}

fn scaling(rows: &[scaling::Row]) -> String {
    let cells = |row: &scaling::Row| vec![row.of.to_owned(), row.count.to_string(), time(row.least), time(row.each)];
    markdown(&["number of", "", "least time", "of each"], &rows.iter().map(cells).collect::<Vec<_>>())
}

/// Everything, for a terminal or a page of Markdown.
pub fn text(results: &Results) -> String {
    let Results { work_precision: wp, growth: g, overhead: o, scaling: s, set_up } = results;
    format!(
        "{}Growth of errors along tp-II: energy and K over their terms, phase as error of n\n\n{}\n\
         What comes on top of a motion\n\n{}\n\
         Cost against the number of outputs of one motion, of scenes, and of cores (1,600 scenes, 16 side by side)\n\n{}\n\
         Before the first step: {}\n",
        work_precision(wp),
        growth(g),
        overhead(o),
        scaling(s),
        time(*set_up)
    )
}

/// Header of [`csv()`]; rows of other programs have the same columns.
pub const COLUMNS: &str = "scene,method,carries,setting,error,least_s,median_s,steps,evaluations";

/// Every run of the work-precision tables.
pub fn csv(rows: &[work_precision::Row]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for row in rows {
        let work_precision::Row { scene, method, carries, setting, error, times, steps, evaluations } = row;
        let _ = writeln!(
            text,
            "{scene},{method},{carries},{setting:?},{error:?},{:?},{:?},{steps},{evaluations}",
            times.least, times.median
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::timing::Times;
    use super::*;

    fn row(method: &str, least: f64) -> work_precision::Row {
        work_precision::Row {
            scene: "tp-II".to_owned(),
            method: method.to_owned(),
            carries: Carries::Axis,
            setting: 1e-9,
            error: 1e-8,
            times: Times { least, median: 5.0 * least },
            steps: 20,
            evaluations: 300,
        }
    }

    #[test]
    fn times_have_three_digits_in_the_unit_of_their_size() {
        for (seconds, text) in
            [(25e-6, "25 us"), (1.5e-6, "1.500 us"), (0.25e-3, "250 us"), (2.5e-3, "2.500 ms"), (1.5, "1.500 s")]
        {
            assert_eq!(time(seconds), text);
        }
    }

    /// Each number under its own name.
    #[test]
    fn errors_stand_under_their_names() {
        let row = |time: f64| growth::Row {
            method: "m",
            time,
            energy: 1e-15 * (time / 1e3).sqrt(),
            clebsch: 2e-12 * (time / 1e3),
            phase: 3e-9 * (time / 1e3).powi(2),
        };
        let text = growth(&[1e3, 1e4, 1e5].map(row));
        let cells = |start: &str| {
            let line = text.lines().find(|line| line.contains(start)).expect("a line");
            line.split('|').map(str::trim).filter(|cell| !cell.is_empty()).skip(2).collect::<Vec<_>>()
        };
        assert_eq!(cells("method"), ["energy", "K", "phase"]);
        assert_eq!(cells("1e3"), ["1.0e-15", "2.0e-12", "3.0e-9"]);
        assert_eq!(cells("exponent"), ["0.50", "1.00", "2.00"]);
    }

    #[test]
    fn times_stand_over_those_of_the_baseline() {
        let text = work_precision(&[row(BASELINE, 4e-3), row("ours", 1e-3)]);
        let cells = |method: &str| {
            let line = text.lines().find(|line| line.contains(method) && line.starts_with("| tp-II")).expect("a line");
            line.split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>()
        };
        assert_eq!([&cells("ours")[3], &cells(BASELINE)[3]], ["1.000 (0.25)", "4.000"]);
    }

    #[test]
    fn fields_are_those_of_the_header() {
        let text = csv(&[row("ours", 1e-3)]);
        let lines: Vec<Vec<_>> = text.lines().map(|line| line.split(',').collect()).collect();
        let field = |name: &str| lines[1][lines[0].iter().position(|column| *column == name).expect("a column")];
        let names = ["scene", "method", "setting", "error", "least_s", "median_s", "steps", "evaluations"];
        assert_eq!(names.map(field), ["tp-II", "ours", "1e-9", "1e-8", "0.001", "0.005", "20", "300"]);
    }
}
