//! The solution that meets a given error, against strength of the torque and time.

use super::drawing::*;
use twofold_verify::checks::regimes::method_errors::{Errors, Geometry, errors};

/// Powers of ten of the strength, two per decade.
const STRENGTHS: (f64, f64, usize) = (-6.5, -1.5, 11);

/// Powers of ten of the time in `t_c`, four per decade.
const TIMES: (f64, f64, usize) = (0.0, 3.5, 15);

/// Required errors of the rows of panels.
const ASKED: [(f64, &str); 2] = [(1e-3, "10^{−3}"), (1e-6, "10^{−6}")];

/// Methods from the last to the first choice, with their colours from viridis, which are also legible in grey.
const METHODS: [(&str, &str); 5] = [
    ("exact motion", "#fde725"),
    ("averaged motion, order 2", "#5ec962"),
    ("averaged motion, order 1", "#21918c"),
    ("perturbation, corrected", "#3b528b"),
    ("perturbation, printed", "#440154"),
];

/// Columns of the tables with the errors of these methods, in the same order, but that of the first is the last.
const COLUMNS: [&str; 4] = ["mean second", "mean first", "corrected", "printed"];

pub(super) fn sheet() -> Result<Sheet, String> {
    let maps: Vec<Map> = Geometry::ALL.into_iter().map(map).collect::<Result<_, _>>()?;
    let svg = draw(&maps);
    let counts = [("points", maps.iter().map(|map| map.table.rows.len()).sum()), ("motions", maps.len() * STRENGTHS.2)];
    Ok(Sheet {
        svg,
        caption: Caption::of("method-regimes", &counts.map(written)),
        tables: maps.into_iter().map(|map| map.table).collect(),
    })
}

struct Map {
    table: Table,
    /// Methods in the table, by place in [`METHODS`], with their columns there.
    methods: Vec<(usize, usize)>,
}

/// Names in tables and in headings.
fn names(geometry: Geometry) -> (&'static str, &'static str) {
    match geometry {
        Geometry::NearAxis => ("near-axis", "twofold, *L* near *Z*"),
        Geometry::Tilted => ("tilted", "twofold, *L* tilted"),
        Geometry::Single => ("single", "single"),
        Geometry::NearSeparatrix => ("near-separatrix", "near the separatrix"),
    }
}

fn map(geometry: Geometry) -> Result<Map, String> {
    let times: Vec<f64> = powers_of_ten(TIMES).collect();
    let rows: Vec<(f64, Vec<Errors>)> = powers_of_ten(STRENGTHS)
        .map(|x| errors(geometry, x, &times).map(|errors| (x, errors)))
        .collect::<Result<_, String>>()?;
    Ok(tabulated(names(geometry).0, &rows))
}

/// Errors by strength and time, for the same solutions everywhere.
fn tabulated(name: &str, rows: &[(f64, Vec<Errors>)]) -> Map {
    let sample = rows[0].1[0];
    let present = [true, true, sample.corrected.is_some(), sample.printed.is_some()];
    let shown = (0..4).filter(|&i| present[i]);
    let mut methods: Vec<_> = shown.clone().enumerate().map(|(column, i)| (i + 1, column + 2)).collect();
    let mut columns = vec!["x [1]".to_owned(), "t [t_c]".to_owned()];
    columns.extend(shown.map(|i| format!("{}: error of n [rad]", COLUMNS[i])));
    columns.extend(["second", "first"].map(|order| format!("mean {order}: error of n; L/G or e_x [1]")));
    methods.insert(0, (0, columns.len()));
    columns.push("torus: error of n [rad]".to_owned());
    let mut table = Table::new(name, columns);
    for (strength, errors) in rows {
        for Errors { time, printed, corrected, averaged, averaged_state, torus } in errors {
            let mut row = vec![*strength, *time, averaged[1], averaged[0]];
            row.extend(*corrected);
            row.extend(*printed);
            row.extend([averaged_state[1], averaged_state[0], *torus]);
            table.push(row);
        }
    }
    Map { table, methods }
}

fn draw(maps: &[Map]) -> String {
    let left = LEFT + 2.0;
    let width = (PAGE - left - 22.0 - 3.0 * 12.0) / 4.0;
    let grid = Grid { left, top: 16.0, width, height: 92.0, between: [12.0, 20.0] };
    let bottom = grid.bottom(2) + BELOW;
    let mut page = Page::new("method-regimes", PAGE, bottom + 18.0);
    for (down, (asked, power)) in ASKED.into_iter().enumerate() {
        for (across, (map, geometry)) in maps.iter().zip(Geometry::ALL).enumerate() {
            let frame = grid.frame(across, down);
            let x = Axis::logarithmic("time [*t*_{c}]", 10f64.powf(TIMES.0), 10f64.powf(TIMES.1));
            let x = if down == 0 { x.bare() } else { x };
            let y = Axis::logarithmic("strength *x*", 10f64.powf(STRENGTHS.0), 10f64.powf(STRENGTHS.1));
            let panel = Panel::new(frame, x, if across == 0 { y } else { y.bare() });
            fill(&mut page, map, frame, asked);
            panel.draw_frame(&mut page);
            panel.letter(&mut page, 4 * down + across, 8, if down == 0 { names(geometry).1 } else { "" });
        }
        let middle = grid.frame(0, down).top + grid.height / 2.0;
        page.turned_text([PAGE - 14.0, middle], 90.0, Anchor::Middle, SMALL, BLACK, &format!("error {power} rad"));
    }
    legend(&mut page, bottom + 8.0);
    page.finish("Which solution meets a given error")
}

/// Fills the area in which each method meets the error, the first choice on top.
fn fill(page: &mut Page, map: &Map, frame: Rectangle, asked: f64) {
    for &(method, column) in &map.methods {
        let edge: Vec<_> = (0..TIMES.2)
            .map(|i| {
                let across = i as f64 / (TIMES.2 - 1) as f64;
                let height = height(map, i, column, asked);
                [frame.left + across * frame.width, frame.bottom() - height * frame.height]
            })
            .collect();
        let corners = [[frame.right(), frame.bottom()], [frame.left, frame.bottom()]];
        page.area(&[edge.as_slice(), &corners].concat(), METHODS[method].1);
        page.path(&edge, solid(BLACK, 0.6));
    }
}

/// Height in the frame up to which the error at a time is as required: it grows with the strength.
fn height(map: &Map, time: usize, column: usize, asked: f64) -> f64 {
    let error = |row: usize| map.table.rows[time + TIMES.2 * row][column].max(1e-16).log10() - asked.log10();
    let steps = STRENGTHS.2 - 1;
    match (0..STRENGTHS.2).find(|&row| error(row) > 0.0) {
        None => 1.0,
        Some(0) => 0.0,
        Some(row) => (row as f64 - error(row) / (error(row) - error(row - 1))) / steps as f64,
    }
}

fn legend(page: &mut Page, top: f64) {
    let widths = [96.0, 105.0, 114.0, 114.0, 62.0];
    let mut left = 6.0;
    for ((name, colour), width) in METHODS.iter().rev().zip(widths) {
        let r = Rectangle { left, top, width: 12.0, height: 8.0 };
        page.cell(r, colour);
        page.outline(r, solid(BLACK, 0.6));
        page.text([left + 15.0, top + 7.0], Anchor::Start, SMALL, BLACK, name);
        left += width;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For any set of solutions, the exact motion is below all others and each method has its column.
    #[test]
    fn a_method_is_drawn_from_its_column() {
        let of = |perturbation: Option<f64>, unit: f64| Errors {
            time: 30.0 * unit,
            printed: perturbation.map(|size| 2.0 * size * unit),
            corrected: perturbation.map(|size| size * unit),
            averaged: [0.25 * unit, 0.125 * unit],
            averaged_state: [0.5 * unit, 0.75 * unit],
            torus: 1e-13 * unit,
        };
        for (perturbation, expected) in
            [(None, vec![1e-13, 0.125, 0.25]), (Some(3.0), vec![1e-13, 0.125, 0.25, 3.0, 6.0])]
        {
            let rows = [(0.5, vec![of(perturbation, 1.0), of(perturbation, 2.0)]), (0.75, vec![of(perturbation, 4.0)])];
            let Map { table, methods } = tabulated("made up", &rows);
            assert!(methods.iter().map(|(method, _)| *method).eq(0..expected.len()));
            let heads = ["torus", "mean second", "mean first", "corrected", "printed"];
            for ((_, column), head) in methods.iter().zip(heads) {
                assert_eq!(table.columns[*column], format!("{head}: error of n [rad]"));
            }
            assert_eq!(table.columns.len() - methods.len(), 4);
            for (row, (strength, unit)) in table.rows.iter().zip([(0.5, 1.0), (0.5, 2.0), (0.75, 4.0)]) {
                let found: Vec<_> = methods.iter().map(|(_, column)| row[*column] / unit).collect();
                assert_eq!((&found, row[..2].to_vec()), (&expected, vec![strength, 30.0 * unit]));
                assert_eq!(row[table.columns.len() - 3..][..2], [0.75 * unit, 0.5 * unit]);
            }
            assert_eq!(
                table.columns[table.columns.len() - 3..][..2],
                ["second", "first"].map(|order| format!("mean {order}: error of n; L/G or e_x [1]"))
            );
        }
    }

    /// An error equal to strength times time is as required up to strength 1 / time, on a logarithmic axis; the other cases are everywhere and
    /// nowhere.
    #[test]
    fn a_method_reaches_to_where_its_error_is_as_asked() {
        let mut table = Table::new("", ["x", "t", "nothing", "error"]);
        for strength in powers_of_ten(STRENGTHS) {
            powers_of_ten(TIMES).for_each(|time| table.push([strength, time, 0.0, strength * time]));
        }
        let map = Map { table, methods: Vec::new() };
        let place = |strength: f64| (strength.log10() - STRENGTHS.0) / (STRENGTHS.1 - STRENGTHS.0);
        for (i, time) in powers_of_ten(TIMES).enumerate() {
            assert!((height(&map, i, 3, 1e-3) - place(1e-3 / time)).abs() < 1e-14, "{time}");
            assert_eq!((height(&map, i, 3, 1e-7), height(&map, i, 3, 1e3)), (0.0, 1.0));
        }
    }
}
