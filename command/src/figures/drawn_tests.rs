//! Every curve, mark and path of every figure, read off the picture by its axes, is the column that labels and legend say.

use std::collections::BTreeSet;

use super::drawn::{Ball, Element, Frame, Point, arrows, elements, frames, legend, number};
use super::layout_tests::FIGURES;
use super::{Figure, Table, plain};

/// Half a pixel of the PNG, in points. The picture is rounded to 0.01, and lines are simplified by 0.02.
const HALF_A_PIXEL: f64 = 0.12;

/// What labels say and the heads of columns with the same quantity in the same unit.
const LABELS: &[(&str, &str)] = &[
    ("t / t_c", "t [t_c]"),
    ("t [s]", "t [s]"),
    ("α [rad]", "alpha{} [rad]"),
    ("β [rad]", "beta{} [rad]"),
    ("m · n", "m.n [1]"),
    ("amplitude of m · n", "amplitude [1]"),
    ("angular frequency × t_c", "frequency [rad/t_c]"),
    ("frequency [Hz]", "frequency [Hz]"),
    ("period / t_c", "period{} [t_c]"),
    ("period [s]", "period{} [s]"),
    ("length / t_c", "length{} [t_c]"),
    ("length [s]", "length{} [s]"),
    ("h_+ r / I^xx", "h_+ [G I^xx / (c^4 t_c^2 r)]"),
    ("h_× r / I^xx", "h_x [G I^xx / (c^4 t_c^2 r)]"),
    ("h_+", "h_+ [1]"),
    ("h_×", "h_x [1]"),
    // The caption has the unit of these amplitudes.
    ("amplitude of h_+", "h_+ [1]"),
    ("amplitude of h_×", "h_x [1]"),
    ("β_0 [rad]", "beta_0 [rad]"),
    ("η", "{}"),
    ("largest error of a component", "error [1]"),
    ("time [ms]", "time [ms]"),
];

/// What legends say and what the heads of columns have in its place.
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

fn entry<'a>(list: &[(&str, &'a str)], words: &str) -> &'a str {
    list.iter().find(|(known, _)| *known == words).unwrap_or_else(|| panic!("what is `{words}`?")).1
}

fn distance([px, py]: Point, [ax, ay]: Point, [bx, by]: Point) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let part = if squared > 0.0 { (((px - ax) * dx + (py - ay) * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (px - ax - part * dx).hypot(py - ay - part * dy)
}

/// How far points are from the nearest part of some lines, at most; no farther than asked is looked.
fn farthest(points: &[Point], lines: &[Vec<Point>]) -> f64 {
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

/// Both ways: no row is away from the line, and no corner of the line away from a row.
fn assert_same(what: &str, rows: &[Point], line: &[Vec<Point>], corners: &[f64; 4]) {
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

/// Table and columns of a curve of a frame by what the picture says about it.
fn columns<'f>(figure: &'f Figure, frame: &Frame, name: &str) -> (&'f Table, usize, usize) {
    let bare = |label: &str| label.replace(" − P", "").replace(" − W", "");
    // The methods of one figure are tables, not columns.
    let of_method = frame.y.label == "time [ms]";
    let [x, y] = [&frame.x, &frame.y].map(|scale| {
        let head = entry(LABELS, &bare(&scale.label)).replace("{}", if of_method { "" } else { entry(NAMES, name) });
        let in_paper_units = frame.x.label.contains("t_c") && scale.label.starts_with("amplitude of h");
        if in_paper_units { head.replace("[1]", "[G I^xx / (c^4 t_c^2 r)]") } else { head }
    });
    // Curves have no other abscissa of that name.
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
        .filter(|table| !table.name.ends_with("lines"))
        .filter_map(|table| Some((table, place(table, &x)?, place(table, &y)?)))
        .collect();
    assert_eq!(found.len(), 1, "{}: {x} and {y} of `{name}` under `{}`", figure.name, frame.heading);
    found[0]
}

fn carried(table: &str) -> &'static str {
    if table.contains("e_x") || table.contains("ex") { "n, L, e_x" } else { "n, L" }
}

/// Columns that no curve shows: lists of lines and gaps, the paths on spheres, what maps are made of.
fn is_not_a_curve(figure: &str, table: &str, column: &str) -> bool {
    match figure {
        "perturbation-regimes"
        | "method-regimes"
        | "momentum-sphere"
        | "beam-cone"
        | "euler-angles"
        | "euler-angles-yzx" => true,
        _ => {
            table.ends_with("lines") || table.ends_with("-gaps") || table == "paths" || column.starts_with("frequency")
        }
    }
}

#[test]
fn every_curve_of_every_figure_is_the_column_that_its_axes_and_legend_name() {
    let mut count = 0;
    for figure in FIGURES.iter().filter(|figure| !figure.name.ends_with("-regimes")) {
        let elements = elements(&figure.svg);
        let (lines, marks) = legend(&elements);
        let mut drawn = BTreeSet::new();
        for frame in frames(&elements) {
            // What is taken off is told in the panel.
            let taken_off = frame.y.label.contains(" − ").then(|| {
                let told = frame.remarks.iter().find_map(|words| words.strip_prefix(['P', 'W'])?.strip_prefix(" = "));
                number(told.expect("a remark").trim_end_matches(" s").trim_end_matches(" t_c")).expect("a number")
            });
            let place = |row: &[f64], x: usize, y: usize| {
                [
                    frame.x.place(row[x]),
                    frame.y.place((row[y] - taken_off.unwrap_or(0.0)).max(if frame.y.label.starts_with("amp") {
                        1e-300
                    } else {
                        f64::NEG_INFINITY
                    })),
                ]
            };
            for (style, pieces) in &frame.curves {
                let named: Vec<_> =
                    lines.iter().filter(|(line, _)| line == style).map(|(_, name)| name.as_str()).collect();
                // A style that serves twice serves its methods in order.
                let of: Vec<(&str, &[Vec<Point>])> = match named[..] {
                    [] => vec![("numerical", &pieces[..])],
                    _ if pieces.len() > 1 && named.len() > 1 => named.into_iter().zip(pieces.chunks(1)).collect(),
                    _ => vec![(named[0], &pieces[..])],
                };
                for (name, pieces) in of {
                    let (table, x, y) = columns(figure, &frame, name);
                    let rows: Vec<_> = table.rows.iter().map(|row| place(row, x, y)).collect();
                    let what = format!("{} {}: {}", figure.name, table.name, table.columns[y]);
                    let is_part = match (figure.name.as_str(), style.1.as_str()) {
                        // Pulses are drawn thick where m.n is above the level; grey lines join what has no gap between.
                        ("beam-alignment", "1.7") | ("pulse-series", "0.5") => true,
                        _ => false,
                    };
                    if is_part && figure.name == "beam-alignment" {
                        let edge = frame.levels[0];
                        // A pulse of one row is no line.
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
                        drawn.insert((table.name.clone(), table.columns[x].clone()));
                        drawn.insert((table.name.clone(), table.columns[y].clone()));
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
                drawn.insert((table.name.clone(), table.columns[x].clone()));
                drawn.insert((table.name.clone(), table.columns[y].clone()));
                count += 1;
            }
        }
        for table in &figure.tables {
            for column in table.columns.iter().filter(|column| !is_not_a_curve(&figure.name, &table.name, column)) {
                let is_drawn = drawn.contains(&(table.name.clone(), column.clone()));
                assert!(is_drawn || table.rows.is_empty(), "{} {}: no curve is `{column}`", figure.name, table.name);
            }
        }
    }
    assert!(count > 120, "{count} curves");
}

/// Lines on a sphere: table, the three columns, colours before and behind the sphere.
type OnSphere = (&'static str, [&'static str; 3], &'static str, &'static str);

const MOTION: [OnSphere; 2] = [
    ("paths", ["e_x_X [1]", "e_x_Y [1]", "e_x_Z [1]"], "#009e73", "#9fd4c4"),
    ("paths", ["e_z_X [1]", "e_z_Y [1]", "e_z_Z [1]"], "#0072b2", "#94bcd9"),
];

const DIRECTIONS: [(&str, &str, &str); 5] = [
    ("tp-I", "#0072b2", "#b3d0e4"),
    ("tp-II", "#d55e00", "#f2c7a9"),
    ("sp-I", "#009e73", "#b0dccf"),
    ("sp-II", "#cc79a7", "#ead0dd"),
    ("near Y", "#e69f00", "#f5dba6"),
];

/// The paths in a picture of the sphere, each with the rows that it shows.
fn paths(figure: &Figure, elements: &[Element]) -> Vec<(String, Vec<[f64; 3]>, &'static str, &'static str)> {
    let vectors = |table: &Table, heads: [&str; 3], until: f64| -> Vec<[f64; 3]> {
        let places = heads.map(|head| table.columns.iter().position(|column| column == head).expect("a column"));
        table.rows.iter().filter(|row| row[0].abs() <= until).map(|row| places.map(|place| row[place])).collect()
    };
    if figure.name == "momentum-sphere" {
        let name_is = |colour: &str, name: &str| {
            elements
                .iter()
                .any(|element| matches!(element, Element::Text { words, fill, .. } if words == name && fill == colour))
        };
        return DIRECTIONS
            .into_iter()
            .map(|(name, front, back)| {
                assert!(name_is(front, name), "{name} is not written in {front}");
                let heads = ["X", "Y", "Z"].map(|axis| format!("l_{axis} of {name} [1]"));
                let rows = vectors(&figure.tables[0], [&heads[0], &heads[1], &heads[2]], f64::INFINITY);
                (name.to_owned(), rows, front, back)
            })
            .collect();
    }
    // `(thin, green; for t up to 40 t_c)`, `(thick, blue; ...`
    let caption = plain(figure.caption.paragraphs()[0]);
    MOTION
        .into_iter()
        .zip(["thin, green; for t up to ", "thick, blue; for t up to "])
        .map(|((name, heads, front, back), words)| {
            let until = caption.split_once(words).expect("a span").1.split(" t_c").next().expect("a number");
            let until = number(until.split(" s)").next().expect("a number")).expect("a number");
            let table = figure.tables.iter().find(|table| table.name == name).expect("a table");
            // The caption has six digits.
            (heads[0].to_owned(), vectors(table, heads, until.abs() * (1.0 + 1e-5)), front, back)
        })
        .collect()
}

#[test]
fn every_path_on_a_sphere_is_that_of_its_columns() {
    let mut count = 0;
    for figure in FIGURES.iter() {
        let (lengths, is_motion) = match figure.name.as_str() {
            "momentum-sphere" => ([1.16; 3], false),
            name if name.starts_with("motion") => ([1.22; 3], true),
            _ => continue,
        };
        let elements = elements(&figure.svg);
        let ball = Ball::of(&elements, ["X", "Y", "Z"], lengths).expect("three axes");
        for (name, rows, front, back) in paths(figure, &elements) {
            let what = format!("{} {name}", figure.name);
            let of = |colour: &str| -> Vec<Vec<Point>> {
                let lines = elements.iter().filter_map(|element| match element {
                    // The arrows and the curves beside have other widths.
                    Element::Path { points, style, clip: None, .. }
                        if style.0 == colour && (!is_motion || ["0.5", "1.1"].contains(&style.1.as_str())) =>
                    {
                        Some(points.clone())
                    }
                    _ => None,
                });
                lines.collect()
            };
            let lines = [of(back), of(front)];
            for (is_front, lines) in [false, true].into_iter().zip(&lines) {
                // Both colours meet at the edge of the sphere.
                let side =
                    |row: &&[f64; 3]| if is_front { ball.towards(**row) > 1e-3 } else { ball.towards(**row) < -1e-3 };
                let seen: Vec<_> = rows.iter().filter(side).map(|row| ball.place(*row)).collect();
                let off = farthest(&seen, lines);
                assert!(
                    seen.len() < 2 || off < HALF_A_PIXEL,
                    "{what}, front {is_front}: a row is {off} pt off the path"
                );
            }
            let all: Vec<_> = rows.iter().map(|row| vec![ball.place(*row); 2]).collect();
            let corners: Vec<_> = lines.iter().flatten().flatten().copied().collect();
            let off = farthest(&corners, &all);
            assert!(off < HALF_A_PIXEL, "{what}: a corner of the path is {off} pt off the rows");
            assert!(corners.len() > 1, "{what} is not drawn");
            if is_motion {
                // The arrow at the start.
                let [x, y] = ball.place(rows[0]);
                let is_there = arrows(&elements).iter().any(|(_, from, to)| {
                    (from[0] - ball.origin[0]).abs() < 0.02 && (to[0] - x).hypot(to[1] - y) < HALF_A_PIXEL
                });
                assert!(is_there, "{what}: no arrow at the start");
            }
            count += 1;
        }
    }
    assert!(count > 20, "{count} paths");
}

/// The heads of named arrows are the columns called like them; the line of nodes passes the origin.
#[test]
fn vectors_in_pictures_of_frames_are_those_of_the_tables() {
    const BODY: &[(&str, &str, f64)] = &[("x", "e_x", 1.0), ("y", "e_y", 1.0), ("z", "e_z", 1.0)];
    for (name, axes, lengths, vectors) in [
        ("euler-angles", ["X", "Y", "Z"], [1.0; 3], BODY),
        ("euler-angles-yzx", ["Y", "Z", "X"], [1.0; 3], BODY),
        ("beam-cone", ["X", "Y", "Z"], [0.85, 0.85, 1.08], &[("m", "m", 1.0), ("n", "n", 1.08)]),
    ] {
        let figure = FIGURES.iter().find(|figure| figure.name == name).expect("a figure");
        let (elements, table) = (elements(&figure.svg), &figure.tables[0]);
        let ball = Ball::of(&elements, axes, lengths).expect("three axes");
        let vector = |name: &str| {
            let head = format!("{name} along {} [1]", axes.join(" "));
            let place = table.columns.iter().position(|column| *column == head).expect("a column");
            [0, 1, 2].map(|i| table.rows[i][place])
        };
        let arrows = arrows(&elements);
        for (arrow, head, length) in vectors {
            let (_, _, at) = arrows.iter().find(|(found, ..)| found == arrow).expect("an arrow");
            let [x, y] = ball.place(vector(head).map(|part| part * length));
            let off = (at[0] - x).hypot(at[1] - y);
            assert!(off < HALF_A_PIXEL, "{name}: the arrow {arrow} is {off} pt off {head}");
        }
        if name != "beam-cone" {
            let node = vector("line of nodes");
            let ends = [node.map(|part| -part), node].map(|end| ball.place(end));
            let is_drawn = elements.iter().any(|element| match element {
                Element::Path { points, style, .. } => {
                    style.0 == "#d55e00"
                        && points.len() == 2
                        && ends.iter().zip(points).all(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) < HALF_A_PIXEL)
                }
                _ => false,
            });
            assert!(is_drawn, "{name}: the line of nodes is elsewhere");
        }
    }
}

fn frames_with_titles(elements: &[Element]) -> Vec<(String, Frame)> {
    let frames = frames(elements);
    let title = |frame: &Frame| {
        // The upper frame of a column has the title.
        let upper = frames.iter().find(|other| other.corners[0] == frame.corners[0] && !other.heading.is_empty());
        if frame.heading.is_empty() { upper.expect("a title").heading.clone() } else { frame.heading.clone() }
    };
    frames.iter().map(|frame| (title(frame), frame.clone())).collect()
}

/// The colours of the map are those that the scale beside it gives the numbers of the table; so are the lines and the rings.
#[test]
fn the_map_of_the_errors_is_its_table() {
    let figure = FIGURES.iter().find(|figure| figure.name == "perturbation-regimes").expect("a figure");
    let elements = elements(&figure.svg);
    let cells = elements.iter().filter_map(|element| match element {
        Element::Cell { corners, fill } => Some((*corners, fill.as_str())),
        _ => None,
    });
    let cells: Vec<_> = cells.collect();
    let frames = frames_with_titles(&elements);
    assert_eq!(frames.len(), 4);
    // The bar is to the right of all frames; its numbers are powers of ten.
    let right = frames.iter().map(|(_, frame)| frame.corners[2]).fold(0.0, f64::max);
    let bar: Vec<_> = cells.iter().filter(|(corners, _)| corners[0] > right && corners[1] < 200.0).collect();
    let powers = elements.iter().filter_map(|element| match element {
        Element::Text { at: [x, y], words, .. } if *x > right && *y < 200.0 => Some((y - 2.8, number(words)?.log10())),
        _ => None,
    });
    let powers: Vec<_> = powers.collect();
    let [(p, a), (q, b)] = [powers[0], powers[powers.len() - 1]];
    let power = |y: f64| a + (b - a) * (y - p) / (q - p);
    let range = |colour: &str| {
        let (corners, _) = bar.iter().find(|(_, fill)| *fill == colour).expect("a colour of the scale");
        // A cell reaches 0.3 below its end.
        let [low, high] = [power(corners[3] - 0.3), power(corners[1])];
        [if low < a - 0.4 { f64::NEG_INFINITY } else { low }, if high > b + 0.4 { f64::INFINITY } else { high }]
    };
    let mut lines = 0;
    for (title, frame) in &frames {
        let table = figure.tables.iter().find(|table| table.name == title.replace(", ", "-")).expect("a table");
        let column = entry(
            &[("A t_c", "A [1/t_c]"), ("asymmetry of s", "|s^XX - s^YY| / |2 s^ZZ - s^XX - s^YY| [1]")],
            &frame.y.label,
        );
        assert_eq!([&table.columns[0], &table.columns[1]], [entry(LABELS, &frame.x.label), column]);
        let wide = table.rows.iter().take_while(|row| row[1] == table.rows[0][1]).count();
        let high = table.rows.len() / wide;
        let value = |i: usize, j: usize| table.rows[i + wide * j][2].log10();
        let fine = [
            (frame.corners[2] - frame.corners[0]) / (6 * (wide - 1)) as f64,
            (frame.corners[3] - frame.corners[1]) / (6 * (high - 1)) as f64,
        ];
        for i in 1..wide - 1 {
            for j in 1..high - 1 {
                let row = &table.rows[i + wide * j];
                let at = [frame.x.place(row[0]), frame.y.place(row[1])];
                let probes = [[-0.4, -0.4], [0.4, -0.4], [-0.4, 0.4], [0.4, 0.4]]
                    .map(|[u, v]| [at[0] + u * fine[0], at[1] + v * fine[1]]);
                let colour = |[x, y]: Point| {
                    cells.iter().rev().find(|(c, _)| c[0] <= x && x < c[2] && c[1] <= y && y < c[3]).expect("a cell").1
                };
                let ranges = probes.map(|probe| range(colour(probe)));
                let (low, high) = ranges
                    .iter()
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), [low, high]| (l.min(*low), h.max(*high)));
                let beside = [value(i - 1, j), value(i + 1, j), value(i, j - 1), value(i, j + 1)];
                let slack = beside.iter().map(|other| (other - value(i, j)).abs()).fold(0.0, f64::max) / 6.0;
                let is_in = value(i, j) > low - slack && value(i, j) < high + slack;
                assert!(is_in, "{title}: {row:?} is drawn as 10^{low} to 10^{high}");
            }
        }
        let between = |at: Point| {
            let u = (frame.x.value(at[0]) - table.rows[0][0]) / (table.rows[1][0] - table.rows[0][0]);
            let v = (frame.y.value(at[1]) / table.rows[0][1]).ln() / (table.rows[wide][1] / table.rows[0][1]).ln();
            let (i, j) = ((u.max(0.0) as usize).min(wide - 2), (v.max(0.0) as usize).min(high - 2));
            let (p, q) = (u - i as f64, v - j as f64);
            let (across, up) = (value(i + 1, j), value(i, j + 1));
            let end = value(i + 1, j + 1);
            let steepest = [across, up, end].iter().map(|x| (x - value(i, j)).abs()).fold(0.0, f64::max);
            let value = if p >= q {
                value(i, j) + p * (across - value(i, j)) + q * (end - across)
            } else {
                value(i, j) + q * (up - value(i, j)) + p * (end - up)
            };
            (value, steepest / fine.iter().map(|size| 6.0 * size).fold(f64::INFINITY, f64::min))
        };
        for element in &elements {
            let Element::Path { points, style, .. } = element else { continue };
            let is_inside = points.iter().all(|[x, y]| {
                (*x - frame.corners[0]) * (frame.corners[2] - x) >= -0.1
                    && (*y - frame.corners[1]) * (frame.corners[3] - y) >= -0.1
            });
            if points.len() == 2 && style.1 == "0.8" && is_inside {
                for (value, slope) in points.iter().map(|at| between(*at)) {
                    let off = (value - value.round()).abs();
                    assert!(off < 0.02 * slope + 1e-3, "{title}: a line at 10^{value}");
                    assert_eq!(style.0 == "#ffffff", value.round() > -2.0, "{title}: colour of the line at 10^{value}");
                }
                lines += 1;
            }
        }
        let examples: &[(&str, f64, f64)] = match frame.y.label.as_str() {
            "A t_c" => &[("tp-II", 0.7, 0.4)],
            _ => &[("sp-I", 0.7, 1.0 / 11.0), ("sp-II", 1.4, 1.0 / 11.0)],
        };
        for (name, beta, parameter) in examples {
            let ring = elements.windows(2).find_map(|pair| match pair {
                [Element::Circle { at, radius, .. }, Element::Text { words, .. }]
                    if words == name && *radius == 2.2 && at[0] > frame.corners[0] && at[0] < frame.corners[2] =>
                {
                    Some(*at)
                }
                _ => None,
            });
            let [x, y] = ring.expect("a ring");
            let off = (x - frame.x.place(*beta)).hypot(y - frame.y.place(*parameter));
            assert!(off < HALF_A_PIXEL || title.ends_with("corrected"), "{title}: {name} is {off} pt off");
        }
    }
    assert!(lines > 300, "{lines} pieces of lines");
}

/// Where each method meets the error, up to the height at which the column of that method crosses it.
#[test]
fn the_map_of_the_methods_is_its_tables() {
    let figure = FIGURES.iter().find(|figure| figure.name == "method-regimes").expect("a figure");
    let elements = elements(&figure.svg);
    let colours = elements.iter().enumerate().filter_map(|(i, element)| match (element, elements.get(i + 2)) {
        (Element::Cell { fill, .. }, Some(Element::Text { words, .. })) => Some((fill.clone(), words.clone())),
        _ => None,
    });
    let colours: Vec<_> = colours.collect();
    let titles = [
        ("twofold, L near Z", "near-axis"),
        ("twofold, L tilted", "tilted"),
        ("single", "single"),
        ("near the separatrix", "near-separatrix"),
    ];
    let methods = [
        ("averaged motion, order 2", "mean second: error of n [rad]"),
        ("averaged motion, order 1", "mean first: error of n [rad]"),
        ("perturbation, corrected", "corrected: error of n [rad]"),
        ("perturbation, printed", "printed: error of n [rad]"),
    ];
    let frames = frames_with_titles(&elements);
    let mut areas = 0;
    for (title, frame) in &frames {
        let [left, top, right, bottom] = frame.corners;
        let table = figure.tables.iter().find(|table| table.name == entry(&titles, title)).expect("a table");
        assert_eq!((frame.x.label.as_str(), frame.y.label.as_str()), ("time [t_c]", "strength x"));
        assert_eq!(table.columns[..2], ["x [1]", "t [t_c]"]);
        let asked = elements.iter().find_map(|element| match element {
            Element::Text { at, words, .. } if at[1] > top && at[1] < bottom => {
                number(words.strip_prefix("error ")?.strip_suffix(" rad")?)
            }
            _ => None,
        });
        let asked = asked.expect("an error").log10();
        let mut times: Vec<_> = table.rows.iter().map(|row| row[1]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut shown = Vec::new();
        for pair in elements.windows(2) {
            let [Element::Path { points, fill, .. }, Element::Path { points: edge, .. }] = pair else { continue };
            let Some((_, name)) = colours.iter().find(|(colour, _)| colour == fill) else { continue };
            let is_here =
                points.iter().all(|[x, y]| *x > left - 0.1 && *x < right + 0.1 && *y > top - 0.1 && *y < bottom + 0.1);
            if !is_here {
                continue;
            }
            let head = entry(&methods, name);
            let column = table.columns.iter().position(|column| column == head).expect("a column");
            let height = |t: &f64| {
                let errors = table
                    .rows
                    .iter()
                    .filter(|row| row[1] == *t)
                    .map(|row| (row[0].log10(), row[column].max(1e-16).log10() - asked));
                let errors: Vec<_> = errors.collect();
                let strength = match errors.iter().position(|(_, error)| *error > 0.0) {
                    None => errors[errors.len() - 1].0,
                    Some(0) => errors[0].0,
                    Some(i) => {
                        let [(x, e), (y, f)] = [errors[i - 1], errors[i]];
                        x + (y - x) * e / (e - f)
                    }
                };
                [frame.x.place(*t), frame.y.place(10f64.powf(strength))]
            };
            let rows: Vec<_> = times.iter().map(height).collect();
            assert_same(
                &format!("{title} {name}"),
                &rows,
                std::slice::from_ref(edge),
                &[left, top - 1.0, right, bottom + 1.0],
            );
            // The area is what lies below the edge.
            let lowest = points.iter().filter(|p| (p[1] - bottom).abs() < 0.02).count();
            assert!(
                lowest >= 2 && edge.iter().all(|p| points.contains(p)),
                "{title} {name}: the area is not below its edge"
            );
            shown.push(name.clone());
            areas += 1;
        }
        let columns = table.columns.iter().filter(|column| column.ends_with(": error of n [rad]")).count();
        assert_eq!(shown.len(), columns, "{title}: {shown:?}");
    }
    assert_eq!((frames.len(), areas), (8, 28));
}
