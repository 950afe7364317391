//! Time against error for every method on some scenes.

use super::Figure;
use super::drawing::*;
use twofold_bench::method::Carries;
use twofold_bench::table::methods;
use twofold_bench::work_precision::{Row, front};

const NAME: &str = "work-precision";

/// The scenes that are drawn, from left to right.
const SCENES: [&str; 3] = ["tp-II", "nearly-free", "strongly-violated"];

const ERRORS: (f64, f64) = (1e-15, 1e-2);

/// Lines and marks of the methods, in order of appearance; they are reused if there are more.
const STYLES: [(Line, Mark); 8] = [
    (solid(BLACK, 1.5), Mark::Disc),
    (dashed(VERMILION, 1.1), Mark::Ring),
    (solid(BLUE, 1.1), Mark::Disc),
    (dash_dotted(GREEN, 1.1), Mark::Ring),
    (dotted(PURPLE, 1.4), Mark::Disc),
    (solid(ORANGE, 1.1), Mark::Ring),
    (dashed(GREY, 1.1), Mark::Disc),
    (dotted(BLUE, 1.4), Mark::Ring),
];

/// Time of a motion of 1,000 t_c against its error: the best runs of each method; `n` and `L` above, with `e_x` below.
pub fn work_precision(rows: &[Row]) -> Figure {
    let width = (PAGE - LEFT - 6.0 - 2.0 * 14.0) / 3.0;
    let grid = Grid { left: LEFT, top: 16.0, width, height: 118.0, between: [14.0, 22.0] };
    let names = names(rows);
    let legend_lines = names.len().div_ceil(PER_LINE);
    let bottom = grid.bottom(2) + BELOW;
    let mut page = Page::new(NAME, PAGE, bottom + 6.0 + 13.0 * legend_lines as f64);
    let y = times(rows);
    let mut tables = Vec::new();
    for (down, carries) in Carries::ALL.into_iter().enumerate() {
        for (across, scene) in SCENES.into_iter().enumerate() {
            let x = Axis::logarithmic("largest error of a component", ERRORS.0, ERRORS.1);
            let x = if down == 0 { x.bare() } else { x };
            let label = Axis::logarithmic("time [ms]", y.0, y.1);
            let panel = Panel::new(grid.frame(across, down), x, if across == 0 { label } else { label.bare() });
            for (name, (line, mark)) in names.iter().zip(STYLES.iter().cycle()) {
                let of_this = |row: &&Row| row.scene == scene && row.carries == carries && row.method == *name;
                let runs = rows.iter().filter(of_this).map(|row| (row.error.max(ERRORS.0), row.times.least * 1e3));
                let points: Vec<_> = front(runs).into_iter().filter(|(error, _)| *error < 0.7 * ERRORS.1).collect();
                panel.curve(&mut page, &points, *line);
                panel.marks(&mut page, &points, *mark, 1.6, line.colour);
                let mut table = Table::new(
                    format!("{scene}.{}.{name}", carries.to_string().replace(' ', "-")),
                    ["error [1]", "time [ms]"],
                );
                points.iter().for_each(|(error, time)| table.push([*error, *time]));
                tables.push(table);
            }
            panel.draw_frame(&mut page);
            let carried = if carries == Carries::Axis { "*n*, *L*" } else { "*n*, *L*, *e*_{x}" };
            panel.letter(&mut page, 3 * down + across, 6, &format!("{scene}: {carried}"));
        }
    }
    for (line, chunk) in names.chunks(PER_LINE).enumerate() {
        let entries: Vec<_> = chunk
            .iter()
            .enumerate()
            .map(|(i, name)| {
                let (style, _) = STYLES[(line * PER_LINE + i) % STYLES.len()];
                (Sample::Line(style), *name, (PAGE - LEGEND_LEFT) / PER_LINE as f64)
            })
            .collect();
        legend_row(&mut page, [LEGEND_LEFT, bottom + 6.0 + 13.0 * line as f64], &entries);
    }
    let svg = page.finish("Time against error");
    Figure {
        name: NAME.to_owned(),
        paper_figure: None,
        summary: "Time of a motion against its error, by method".to_owned(),
        caption: Caption::of(NAME, &[]),
        tables,
        svg,
    }
}

/// Number of names per line of the legend.
const PER_LINE: usize = 4;

const LEGEND_LEFT: f64 = 12.0;

/// All methods, those of `n` and `L` first.
fn names(rows: &[Row]) -> Vec<&str> {
    let mut names = methods(rows, Carries::Axis);
    for name in methods(rows, Carries::Orientation) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Ends of the axis of times (ms): a factor of 1.5 beyond those of runs whose error is shown.
fn times(rows: &[Row]) -> (f64, f64) {
    let shown = rows.iter().filter(|row| row.error <= ERRORS.1).map(|row| row.times.least * 1e3);
    let (low, high) = shown.fold((f64::INFINITY, 0.0_f64), |(l, h), t| (l.min(t), h.max(t)));
    (low / 1.5, high * 1.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::drawn::{Element, elements, texts};
    use crate::figures::fixtures::made_up_runs;
    use twofold_bench::timing::Times;

    /// Nine methods take 0.1 ms times their index and the number of the run, 1 to 7; the first run has an error of 1e-2.
    #[test]
    fn the_axis_of_times_has_room_for_all_that_are_shown() {
        let mut rows = made_up_runs();
        let (low, high) = times(&rows);
        assert!((low * 1.5 - 0.1).abs() < 1e-12 && (high / 1.5 - 6.3).abs() < 1e-12, "{low} {high}");
        // A run that is not shown takes no room.
        for row in rows.iter_mut().filter(|row| row.times.least > 3.45e-3) {
            row.error = 0.011;
        }
        assert!((times(&rows).1 / 1.5 - 3.2).abs() < 1e-12, "{:?}", times(&rows));
    }

    /// For each method those runs that no other of its runs beats, with errors from 1e-15 to 0.007; all times and errors differ. Times are some
    /// microseconds.
    #[test]
    fn panels_have_the_runs_of_their_scene_and_what_is_carried() {
        let run = |scene: &str, carries, method: &str, error: f64, time: f64| Row {
            scene: scene.to_owned(),
            method: method.to_owned(),
            carries,
            setting: 0.0,
            error,
            times: Times { least: 1e-6 * time, median: 1.0 },
            steps: 0,
            evaluations: 0,
        };
        let (mut rows, mut expected) = (Vec::new(), Vec::new());
        for (carries, carried, unit) in [(Carries::Axis, "n-L", 1.0), (Carries::Orientation, "n-L-e_x", 7.0)] {
            for (scene, unit) in SCENES.into_iter().zip([unit, 2.0 * unit, 3.0 * unit]) {
                let errors = [(1e-20, 9.0), (1e-8, 2.0), (1e-7, 3.0), (6.9e-3, 1.0), (7.1e-3, 0.5)];
                rows.extend(errors.map(|(error, time)| run(scene, carries, "one", error, time * unit)));
                let left = [[6.9e-3, 1e-3 * unit], [1e-8, 2e-3 * unit], [1e-15, 9e-3 * unit]];
                expected.push((format!("{scene}.{carried}.one"), left.to_vec()));
                let more = (carries == Carries::Orientation).then_some([1e-5, 4e-3 * unit]);
                rows.extend(more.map(|[error, time]| run(scene, carries, "two", error, 1e3 * time)));
                expected.push((format!("{scene}.{carried}.two"), more.into_iter().collect()));
            }
        }
        rows.push(run("tp-I", Carries::Axis, "one", 1e-9, 10.0));
        let figure = work_precision(&rows);
        assert_eq!(figure.tables.len(), expected.len());
        for (table, (name, rows)) in figure.tables.iter().zip(&expected) {
            assert_eq!((&table.name, table.rows.len()), (name, rows.len()));
            for (found, expected) in table.rows.iter().zip(rows) {
                assert!(
                    found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-14),
                    "{name}: {found:?} {expected:?}"
                );
            }
        }
        assert_eq!(names(&rows), ["one", "two"]);
        // From 0.5 to 9 * 21 microseconds, in milliseconds.
        let (low, high) = times(&rows);
        assert!((low * 1.5 / 5e-4 - 1.0).abs() < 1e-14 && (high / 1.5 / 0.189 - 1.0).abs() < 1e-14, "{low} {high}");
        let elements = elements(&figure.svg);
        let headings: Vec<_> =
            texts(&elements).map(|text| text.words.as_str()).filter(|words| words.starts_with('(')).collect();
        let known = [
            "(a) tp-II: n, L",
            "(b) nearly-free: n, L",
            "(c) strongly-violated: n, L",
            "(d) tp-II: n, L, e_x",
            "(e) nearly-free: n, L, e_x",
            "(f) strongly-violated: n, L, e_x",
        ];
        assert_eq!(headings, known);
        let marks = elements.iter().filter(|element| matches!(element, Element::Circle { .. })).count();
        assert_eq!(marks, 3 * 3 + 3 * 4);
    }
}
