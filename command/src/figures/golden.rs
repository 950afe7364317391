//! The data of the figures: a few numbers of each, from the tables behind the pictures.

use twofold_verify::golden::{self, GoldenLine, GoldenTable, Printed};

use super::{Figure, RECIPES, Table};

/// Selected numbers; the file describes its format.
const NUMBERS: &str = include_str!("../../data/golden_figures.txt");

/// All golden tables: those of the verification, then those of `figures`, which must be complete.
pub fn golden_tables(figures: &[Figure]) -> Result<Vec<GoldenTable>, String> {
    let mut tables = golden::tables()?;
    tables.extend(of_figures(NUMBERS, figures)?);
    Ok(tables)
}

/// The tables requested by a text in that format.
fn of_figures(text: &'static str, figures: &[Figure]) -> Result<Vec<GoldenTable>, String> {
    let lines: Vec<_> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let snapshot = |line: &'static str| line.split(' ').next().unwrap_or_default();
    let figure_of = |line: &'static str| snapshot(line).trim_start_matches("figure_").replace('_', "-");
    if let Some(figure) = figures.iter().find(|figure| !lines.iter().any(|line| figure_of(line) == figure.name)) {
        return Err(format!("the figure {} has no golden numbers", figure.name));
    }
    let mut tables = Vec::new();
    for of_figure in lines.chunk_by(|a, b| snapshot(a) == snapshot(b)) {
        let name = figure_of(of_figure[0]);
        let figure = figures.iter().find(|figure| figure.name == name).ok_or(format!("there is no figure {name}"))?;
        let title = RECIPES.iter().find(|recipe| recipe.name == name).map_or("", |recipe| recipe.summary);
        let mut lines = Vec::new();
        for line in of_figure {
            lines.extend(numbers(figure, line).ok_or(format!("{name}: no numbers for `{line}`"))?);
        }
        tables.push(GoldenTable { name: snapshot(of_figure[0]), title, lines });
    }
    Ok(tables)
}

/// The numbers requested by a line of the file.
fn numbers(figure: &Figure, line: &str) -> Option<Vec<GoldenLine>> {
    // Three digits for errors of approximations, as in the tables of regimes, and for residuals far below those of the torque; six for lines and
    // other residuals, which are fitted.
    let digits = match figure.name.as_str() {
        "perturbation-regimes" | "method-regimes" | "violation-residuals" => 3,
        "beam-alignment-spectra" | "wave-spectra" | "line-atlas" | "spin-down" => 6,
        _ => 9,
    };
    let mut words = line.split(' ').skip(1);
    let (name, columns) = (words.next()?.trim_start_matches('-'), words.next()?);
    let table = figure.tables.iter().find(|table| table.name == name)?;
    let mut found = Vec::new();
    for column in columns.split(',') {
        for pick in words.clone() {
            found.push(GoldenLine { digits, ..number(table, column.parse().ok()?, pick)? });
        }
    }
    Some(found)
}

fn number(table: &Table, column: usize, pick: &str) -> Option<GoldenLine> {
    let nearest =
        |distance: &dyn Fn(&Vec<f64>) -> f64| table.rows.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let by_value = |a: &&Vec<f64>, b: &&Vec<f64>| a[column].total_cmp(&b[column]);
    let (pick, values) = pick.split_once('=').unwrap_or((pick, ""));
    let values: Vec<f64> = values.split(',').filter_map(|value| value.parse().ok()).collect();
    let row = match (pick, &values[..]) {
        ("line", [place]) => table.rows.get(*place as usize - 1),
        ("first", []) => table.rows.first(),
        ("last", []) => table.rows.last(),
        ("least", []) => table.rows.iter().min_by(by_value),
        ("most", []) => table.rows.iter().max_by(by_value),
        ("at", [value]) => nearest(&|row| (row[0] - value).abs()),
        ("of", [first, second]) => nearest(&|row| (row[0] - first).abs() + (row[1] / second).ln().abs()),
        _ => None,
    }?;
    let place = match pick {
        "least" => "least".to_owned(),
        "most" => "largest".to_owned(),
        "of" => format!("at {:.4}, {:.4e}", row[0], row[1]),
        _ if table.columns[0].starts_with("beta_0") => format!("at {:.4}", row[0]),
        // A table of vectors has no time.
        _ if table.columns[0].starts_with("t [") => format!("at t = {:.3}", row[0]),
        "line" => format!("of line {}", values[0]),
        "first" => "first".to_owned(),
        _ => "last".to_owned(),
    };
    let name = if table.name.is_empty() { String::new() } else { format!("{}: ", table.name) };
    Some(GoldenLine::new(format!("{name}{} {place}", table.columns[column]), Printed::No, row[column]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{Caption, Figure};

    fn figure(name: &str, table: &str, first: &str) -> Figure {
        let mut table = Table::new(table, [first, "x [1]"]);
        for row in [[1.0, 8.0], [2.0, -3.0], [4.0, 20.0], [7.0, 5.0]] {
            table.push(row);
        }
        let caption =
            Caption { shows: String::new(), parameters: String::new(), method: String::new(), says: String::new() };
        Figure {
            name: name.to_owned(),
            paper_figure: None,
            summary: String::new(),
            caption,
            tables: vec![table],
            svg: String::new(),
        }
    }

    #[test]
    fn a_line_of_the_file_names_numbers_of_a_table() {
        let asked = |first: &str, picks: &str| {
            let figure = figure("motion", "", first);
            let lines = numbers(&figure, &format!("figure_motion - 1 {picks}")).unwrap();
            lines.into_iter().map(|line| (line.label, line.ours)).collect::<Vec<_>>()
        };
        let line = |label: &str, ours: f64| (label.to_owned(), ours);
        let rows = [line("x [1] first", 8.0), line("x [1] last", 5.0), line("x [1] of line 3", 20.0)];
        assert_eq!(asked("n_X [1]", "first last line=3"), rows);
        let extremes = [line("x [1] least", -3.0), line("x [1] largest", 20.0)];
        assert_eq!(asked("t [t_c]", "least most"), extremes);
        assert_eq!(asked("t [t_c]", "at=5.0"), [line("x [1] at t = 4.000", 20.0)]);
        assert_eq!(asked("beta_0 [rad]", "at=5.0"), [line("x [1] at 4.0000", 20.0)]);
        // Nearest in the first column and in the logarithm of the second.
        assert_eq!(asked("beta_0 [rad]", "of=4.1,20.5"), [line("x [1] at 4.0000, 2.0000e1", 20.0)]);
        assert_eq!(asked("beta_0 [rad]", "of=2.5,6.0"), [line("x [1] at 1.0000, 8.0000e0", 8.0)]);
        assert_eq!(asked("beta_0 [rad]", "of=5.5,20.0"), [line("x [1] at 4.0000, 2.0000e1", 20.0)]);
    }

    #[test]
    fn digits_are_those_that_every_machine_has() {
        for (name, digits) in [("spin-down", 6), ("method-regimes", 3), ("motion-tp-1", 9)] {
            let lines = numbers(&figure(name, "lines", "t [d]"), "figure_x lines 0,1 last").unwrap();
            assert_eq!(lines.iter().map(|line| line.digits).collect::<Vec<_>>(), [digits; 2]);
            assert_eq!(
                [lines[0].label.as_str(), lines[1].label.as_str()],
                ["lines: t [d] at t = 7.000", "lines: x [1] at t = 7.000"]
            );
        }
        assert!(numbers(&figure("motion", "", "t [d]"), "figure_motion other 1 last").is_none());
        assert!(numbers(&figure("motion", "", "t [d]"), "figure_motion - 1 middle").is_none());
    }

    #[test]
    fn every_figure_has_a_table_of_the_numbers_that_are_asked() {
        const TEXT: &str = "# what is asked\nfigure_beam_cone - 1 most\nfigure_motion_tp_1 - 1 first last\nfigure_motion_tp_1 - 0 last";
        let figures = ["motion-tp-1", "beam-cone"].map(|name| figure(name, "", "t [t_c]"));
        let tables = of_figures(TEXT, &figures).unwrap();
        let found: Vec<_> = tables
            .iter()
            .map(|table| (table.name, table.title, table.lines.iter().map(|line| line.ours).collect::<Vec<_>>()))
            .collect();
        let expected = [
            ("figure_beam_cone", "Cone model of pulsar radiation: magnetic axis and line of sight", vec![20.0]),
            (
                "figure_motion_tp_1",
                "Example I of twofold precession: Euler angles and the paths of the body axes",
                vec![8.0, 5.0, 7.0],
            ),
        ];
        assert_eq!(found, expected);
        assert_eq!(of_figures(TEXT, &figures[..1]).unwrap_err(), "there is no figure beam-cone");
        let more = [&figures[..], &[figure("waves", "", "t [t_c]")]].concat();
        assert_eq!(of_figures(TEXT, &more).unwrap_err(), "the figure waves has no golden numbers");
        let unknown = of_figures("figure_beam_cone - 1 middle", &figures[1..]).unwrap_err();
        assert_eq!(unknown, "beam-cone: no numbers for `figure_beam_cone - 1 middle`");
    }
}
