//! Every curve and mark of every figure, read off the picture by its axes, is the column named by labels and legend.

use std::collections::BTreeSet;

use super::drawn::{Frame, Point, elements, frames, legend, number};
use super::fixtures::{Fixture, figure, fixtures};
use super::{Figure, Table};

/// Half a pixel of the PNG, in points. The picture is rounded to 0.01, and lines are simplified by 0.02.
pub(super) const HALF_A_PIXEL: f64 = 0.12;

/// Labels and the heads of columns for the same quantity in the same unit.
pub(super) const LABELS: &[(&str, &str)] = &[
    ("t / t_c", "t [t_c]"),
    ("t [s]", "t [s]"),
    ("α [rad]", "alpha{} [rad]"),
    ("β [rad]", "beta{} [rad]"),
    ("m · n", "m.n [1]"),
    ("period / t_c", "period{} [t_c]"),
    ("period [s]", "period{} [s]"),
    ("length / t_c", "length{} [t_c]"),
    ("length [s]", "length{} [s]"),
    ("h_+ r / I^xx", "h_+ [G I^xx / (c^4 t_c^2 r)]"),
    ("h_× r / I^xx", "h_x [G I^xx / (c^4 t_c^2 r)]"),
    ("h_+", "h_+ [1]"),
    ("h_×", "h_x [1]"),
    ("β_0 [rad]", "beta_0 [rad]"),
    ("η", "{}"),
    ("largest error of a component", "error [1]"),
    ("time [ms]", "time [ms]"),
];

/// Entries of legends and the corresponding parts of column heads.
const NAMES: &[(&str, &str)] = &[
    ("numerical", ""),
    ("perturbation, printed", " by perturbation printed"),
    ("perturbation, corrected", " by perturbation corrected"),
    ("pulses", ""),
    ("Eqs. (51), (56) at the instant", " at the instant"),
    ("with mean rates", " with mean rates"),
    ("with rates (57)", " with rates (57)"),
    ("root mean square", "eta [1]"),
    ("median", "eta at this inclination: median [1]"),
    ("97.5 %", "eta at this inclination: 97.5 % [1]"),
    ("1/cos β_0", "1/cos beta_0 [1]"),
    ("s^XX = s^YY", "eta for s^XX = s^YY [1]"),
];

pub(super) fn entry<'a>(list: &[(&str, &'a str)], words: &str) -> &'a str {
    list.iter().find(|(known, _)| *known == words).unwrap_or_else(|| panic!("what is `{words}`?")).1
}

fn distance([px, py]: Point, [ax, ay]: Point, [bx, by]: Point) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let part = if squared > 0.0 { (((px - ax) * dx + (py - ay) * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (px - ax - part * dx).hypot(py - ay - part * dy)
}

/// Largest distance of points from the nearest part of some lines; the search stops at the given distance.
pub(super) fn farthest(points: &[Point], lines: &[Vec<Point>]) -> f64 {
    let mut segments: Vec<_> = lines.iter().flat_map(|line| line.windows(2).map(|ends| [ends[0], ends[1]])).collect();
    segments.sort_by(|a, b| a[0][0].min(a[1][0]).total_cmp(&b[0][0].min(b[1][0])));
    let left: Vec<_> = segments.iter().map(|[a, b]| a[0].min(b[0])).collect();
    let widest = segments.iter().map(|[a, b]| (a[0] - b[0]).abs()).fold(0.0, f64::max);
    let of = |p: &Point| {
        let from = left.partition_point(|x| *x < p[0] - widest - 1.0);
        let to = left.partition_point(|x| *x <= p[0] + 1.0);
        segments[from..to].iter().map(|[a, b]| distance(*p, *a, *b)).fold(f64::INFINITY, f64::min)
    };
    points.iter().map(of).fold(0.0, f64::max)
}

/// In both directions: every row is near the line, and every corner of the line near a row.
pub(super) fn assert_same(what: &str, rows: &[Point], line: &[Vec<Point>], corners: &[f64; 4]) {
    let [left, top, right, bottom] = *corners;
    let is_inside = |p: &&Point| p[0] > left - 0.01 && p[0] < right + 0.01 && p[1] > top && p[1] < bottom;
    let seen: Vec<_> = rows.iter().filter(is_inside).copied().collect();
    let off = farthest(&seen, line);
    assert!(off < HALF_A_PIXEL, "{what}: a row is {off} pt off the curve");
    let corners: Vec<_> = line.iter().flatten().filter(is_inside).copied().collect();
    let alone: Vec<_> = rows.iter().map(|p| vec![*p, *p]).collect();
    let off = farthest(&corners, &alone);
    assert!(off < HALF_A_PIXEL, "{what}: a corner of the curve is {off} pt off the rows");
}

/// Table and columns of a curve in a frame, from its label and legend.
fn columns<'f>(figure: &'f Figure, frame: &Frame, name: &str) -> (&'f Table, usize, usize) {
    let bare = |label: &str| label.replace(" − P", "").replace(" − W", "");
    // In one figure the methods are tables, not columns.
    let of_method = frame.y.label == "time [ms]";
    let [x, y] = [&frame.x, &frame.y]
        .map(|scale| entry(LABELS, &bare(&scale.label)).replace("{}", if of_method { "" } else { entry(NAMES, name) }));
    // No other abscissa of these curves has that name.
    let x = if x.contains("{}") { x.replace("{}", "") } else { x };
    let place = |table: &Table, head: &str| table.columns.iter().position(|column| column == head);
    let scene = frame.heading.split(':').next().unwrap_or_default();
    let found: Vec<_> = figure
        .tables
        .iter()
        .filter(|table| !of_method || frame.heading == format!("{scene}: {}", carried(&table.name)))
        .filter(|table| !of_method || table.name.ends_with(name))
        .filter(|table| {
            table.name == scene
                || scene.is_empty()
                || table.name.starts_with(&format!("{scene}-"))
                || of_method && table.name.starts_with(scene)
        })
        .filter_map(|table| Some((table, place(table, &x)?, place(table, &y)?)))
        .collect();
    assert_eq!(found.len(), 1, "{}: {x} and {y} of `{name}` under `{}`", figure.name, frame.heading);
    found[0]
}

fn carried(table: &str) -> &'static str {
    if table.contains("e_x") || table.contains("ex") { "n, L, e_x" } else { "n, L" }
}

/// Columns that no curve shows: lists of lines and gaps, paths on spheres, data of maps.
fn is_not_a_curve(figure: &str, table: &str, column: &str) -> bool {
    let is_spatial = ["momentum-sphere", "beam-cone", "euler-angles", "euler-angles-yzx"].contains(&figure);
    let is_list = table.ends_with("lines") || table.ends_with("-gaps") || table == "paths";
    is_spatial || is_list || figure.ends_with("-regimes") || column.starts_with("frequency")
}

/// Spectral lines are vertical lines with their tops at the rows of a table, one for each row inside the frame. Returns the number of lines.
fn assert_lines(figure: &Figure, frame: &Frame) -> usize {
    let [left, top, right, bottom] = frame.corners;
    let tops: Vec<Point> = frame
        .curves
        .iter()
        .flat_map(|(_, pieces)| pieces)
        .filter_map(|piece| piece.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])))
        .collect();
    let rows_of = |table: &Table| -> Vec<Point> {
        let places = table.rows.iter().map(|row| [frame.x.place(row[0]), frame.y.place(row[1].max(1e-300))]);
        places
            .filter(|p| p[0] > left - 0.01 && p[0] < right && p[1] >= top && p[1] < bottom - 2.0 * HALF_A_PIXEL)
            .collect()
    };
    let off = |points: &[Point], others: &[Point]| {
        let nearest = |p: &Point| others.iter().map(|q| distance(*p, *q, *q)).fold(f64::INFINITY, f64::min);
        points.iter().map(nearest).fold(0.0, f64::max)
    };
    let tall: Vec<Point> = tops.iter().filter(|p| p[1] < bottom - 2.0 * HALF_A_PIXEL).copied().collect();
    let scene = frame.heading.split(':').next().unwrap_or_default();
    let tables = figure.tables.iter().filter(|table| {
        let of_scene = scene.is_empty() || table.name.starts_with(&format!("{scene}-"));
        let polarization = if frame.y.label.contains('×') { "cross" } else { "plus" };
        let of_wave = frame.y.label.contains("h_") && !table.name.contains(polarization);
        of_scene && !of_wave
    });
    // An inset has no heading.
    let best =
        tables.map(|table| off(&rows_of(table), &tops).max(off(&tall, &rows_of(table)))).fold(f64::INFINITY, f64::min);
    assert!(best < 2.0 * HALF_A_PIXEL, "{}: `{}` `{}`: {best}", figure.name, frame.heading, frame.y.label);
    tall.len()
}

#[test]
fn every_curve_of_every_figure_is_the_column_that_its_axes_and_legend_name() {
    let (mut count, mut spectra) = (0, 0);
    let own = ["line-atlas", "spin-down", "violation-residuals"];
    let has_own_test = |figure: &&Fixture| figure.name.ends_with("-regimes") || own.contains(&figure.name);
    for figure in fixtures().filter(|figure| !has_own_test(figure)) {
        let elements = elements(&figure.svg);
        let (lines, marks) = legend(&elements);
        let mut drawn = BTreeSet::new();
        for frame in frames(&elements) {
            // The subtracted value is written in the panel.
            let taken_off = frame.y.label.contains(" − ").then(|| {
                let told = frame.remarks.iter().find_map(|words| words.strip_prefix(['P', 'W'])?.strip_prefix(" = "));
                number(told.expect("a remark").trim_end_matches(" s").trim_end_matches(" t_c")).expect("a number")
            });
            let place = |row: &[f64], x: usize, y: usize| {
                [frame.x.place(row[x]), frame.y.place(row[y] - taken_off.unwrap_or(0.0))]
            };
            if frame.y.label.starts_with("amplitude of") || figure.name.ends_with("spectra") {
                spectra += assert_lines(figure, &frame);
                continue;
            }
            for (style, pieces) in &frame.curves {
                let named: Vec<_> =
                    lines.iter().filter(|(line, _)| line == style).map(|(_, name)| name.as_str()).collect();
                // A style that is used twice serves its methods in order.
                let of: Vec<(&str, &[Vec<Point>])> = match named[..] {
                    [] => vec![("numerical", &pieces[..])],
                    _ if pieces.len() > 1 && named.len() > 1 => named.into_iter().zip(pieces.chunks(1)).collect(),
                    _ => vec![(named[0], &pieces[..])],
                };
                for (name, pieces) in of {
                    let (table, x, y) = columns(figure, &frame, name);
                    let rows: Vec<_> = table.rows.iter().map(|row| place(row, x, y)).collect();
                    let what = format!("{} {}: {}", figure.name, table.name, table.columns[y]);
                    // Pulses are drawn thick where m.n is above the level; grey lines join neighbours without a gap.
                    let part = (figure.name, style.1.as_str());
                    let is_part = [("beam-alignment", "1.7"), ("pulse-series", "0.5")].contains(&part);
                    if is_part && figure.name == "beam-alignment" {
                        let edge = frame.levels[0];
                        // A pulse of one row gives no line.
                        let is_inside = |pair: &&[Vec<f64>]| pair.iter().all(|row| row[y] > edge + 1e-3);
                        let pulses = table.rows.windows(2).filter(is_inside).flatten();
                        let off = farthest(&pulses.map(|row| place(row, x, y)).collect::<Vec<_>>(), pieces);
                        assert!(off < HALF_A_PIXEL, "{what}: a pulse is not thick, {off} pt");
                        let thick: Vec<_> = pieces.iter().flatten().copied().collect();
                        assert!(
                            thick.iter().all(|p| frame.y.value(p[1]) > edge - 1e-2),
                            "{what}: thick below the level"
                        );
                        let rows: Vec<_> = rows.iter().map(|p| vec![*p, *p]).collect();
                        assert!(farthest(&thick, &rows) < HALF_A_PIXEL, "{what}: thick elsewhere");
                    } else if is_part {
                        let alone: Vec<_> = rows.iter().map(|p| vec![*p, *p]).collect();
                        let corners: Vec<_> = pieces.iter().flatten().copied().collect();
                        assert!(farthest(&corners, &alone) < HALF_A_PIXEL, "{what}: a grey line goes elsewhere");
                    } else {
                        assert_same(&what, &rows, pieces, &frame.corners);
                        drawn.extend([x, y].map(|column| (table.name.clone(), table.columns[column].clone())));
                    }
                    count += 1;
                }
            }
            for (colour, places) in &frame.marks {
                let name = marks.iter().find(|(known, _)| known == colour).map(|(_, name)| name.as_str());
                let of_line = lines.iter().find(|(line, _)| line.0 == *colour).map(|(_, name)| name.as_str());
                if figure.name == "work-precision" {
                    continue;
                }
                let (table, x, y) = columns(figure, &frame, name.or(of_line).unwrap_or("numerical"));
                let rows: Vec<_> = table.rows.iter().map(|row| place(row, x, y)).collect();
                assert_eq!(rows.len(), places.len(), "{} {}", figure.name, table.name);
                for (row, place) in rows.iter().zip(places) {
                    let off = (row[0] - place[0]).hypot(row[1] - place[1]);
                    assert!(off < HALF_A_PIXEL, "{} {}: a mark is {off} pt off its row", figure.name, table.name);
                }
                drawn.extend([x, y].map(|column| (table.name.clone(), table.columns[column].clone())));
                count += 1;
            }
        }
        for table in &figure.tables {
            for column in table.columns.iter().filter(|column| !is_not_a_curve(figure.name, &table.name, column)) {
                let is_drawn = drawn.contains(&(table.name.clone(), column.clone()));
                assert!(is_drawn || table.rows.is_empty(), "{} {}: no curve is `{column}`", figure.name, table.name);
            }
        }
    }
    assert!(count > 110 && spectra > 150, "{count} curves, {spectra} lines");
}

/// Curves stand in the order of the columns, with their names to the right. Lines absent in free precession fall with `s`, the others do not.
#[test]
fn the_atlas_of_lines_is_its_tables() {
    let figure = figure("line-atlas");
    let elements = elements(&figure.svg);
    let frames = frames(&elements);
    assert_eq!((frames.len(), figure.tables.len()), (6, 9));
    let (mut count, mut lacking) = (0, 0);
    for (place, frame) in frames.iter().enumerate() {
        let table = &figure.tables[3 * (place / 2) + place % 2];
        let variable = [("s_max − s_min", "s_max - s_min [1]"), ("wobble [rad]", "wobble [rad]")];
        assert_eq!(table.columns[0], entry(&variable, &frame.x.label));
        let pieces: Vec<_> = frame.curves.iter().flat_map(|(_, pieces)| pieces).collect();
        assert_eq!(pieces.len(), table.columns.len() - 1, "{}", table.name);
        for (column, piece) in (1..).zip(pieces) {
            let (name, _) = table.columns[column].split_once(" [").expect("a unit");
            let found = table.rows.iter().filter(|row| row[column] > 0.0);
            let rows: Vec<_> = found.map(|row| [frame.x.place(row[0]), frame.y.place(row[column])]).collect();
            assert_same(&format!("{} {name}", table.name), &rows, std::slice::from_ref(piece), &frame.corners);
            let symbols = [("nu'", "ν"), ("psi'", "ψ"), ("l'", "l"), (" - ", " − ")];
            let drawn = symbols.iter().fold(name.to_owned(), |name, (plain, symbol)| name.replace(plain, symbol));
            assert!(frame.remarks.contains(&drawn), "{}: no {drawn} in {:?}", table.name, frame.remarks);
            count += 1;
        }
    }
    for list in figure.tables.iter().skip(2).step_by(3) {
        for row in &list.rows {
            let [nutation, rotation, slow, kind, power] = row[..] else { panic!("{row:?}") };
            // Free precession has no slow rate; the waves have no constant line with satellites at multiples of that rate.
            let expected = match kind {
                2.0 if nutation == 0.0 && rotation == 0.0 => 2.0,
                2.0 => 1.0,
                _ => 0.0,
            };
            assert_eq!(kind == 0.0, kind < 2.0 && slow == 0.0, "{row:?}");
            assert!((power - expected).abs() < 0.01, "{}: {row:?}", list.name);
            lacking += usize::from(kind == 2.0);
        }
    }
    assert!(count == 48 && lacking == 9, "{count} curves, {lacking} lines that free precession lacks");
}
