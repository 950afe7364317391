//! Every path on a sphere and every vector of the figures, read off the picture, agrees with the tables.

use super::curve_tests::{HALF_A_PIXEL, farthest};
use super::drawn::{Ball, Element, Path, Point, arrows, elements, number, paths as drawn_paths, texts};
use super::fixtures::{figure, fixtures};
use super::{Figure, Table, plain};

/// Lines on a sphere: table, the three columns, colours in front of and behind the sphere.
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

fn paths(figure: &Figure, elements: &[Element]) -> Vec<(String, Vec<[f64; 3]>, &'static str, &'static str)> {
    let vectors = |table: &Table, heads: [&str; 3], until: f64| -> Vec<[f64; 3]> {
        let places = heads.map(|head| table.columns.iter().position(|column| column == head).expect("a column"));
        table.rows.iter().filter(|row| row[0].abs() <= until).map(|row| places.map(|place| row[place])).collect()
    };
    if figure.name == "momentum-sphere" {
        let name_is = |colour: &str, name: &str| texts(elements).any(|text| text.words == name && text.fill == colour);
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
    // The caption has `(thin, green; for t up to 40 t_c)`, `(thick, blue; ...`
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
    for figure in fixtures() {
        let (lengths, is_motion) = match figure.name {
            "momentum-sphere" => ([1.16; 3], false),
            name if name.starts_with("motion") => ([1.22; 3], true),
            _ => continue,
        };
        let elements = elements(&figure.svg);
        let ball = Ball::of(&elements, ["X", "Y", "Z"], lengths).expect("three axes");
        for (name, rows, front, back) in paths(figure, &elements) {
            let what = format!("{} {name}", figure.name);
            let of = |colour: &str| -> Vec<Vec<Point>> {
                // Arrows and neighbouring curves have other widths.
                let is_of = |Path { style, clip, .. }: &&Path| {
                    let (stroke, width, _) = style;
                    clip.is_none() && stroke == colour && (!is_motion || ["0.5", "1.1"].contains(&width.as_str()))
                };
                drawn_paths(&elements).filter(is_of).map(|path| path.points.clone()).collect()
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
                // The arrow is at the start.
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

/// The heads of named arrows are the columns with the same names; the line of nodes passes through the origin.
#[test]
fn vectors_in_pictures_of_frames_are_those_of_the_tables() {
    const BODY: &[(&str, &str, f64)] = &[("x", "e_x", 1.0), ("y", "e_y", 1.0), ("z", "e_z", 1.0)];
    for (name, axes, lengths, vectors) in [
        ("euler-angles", ["X", "Y", "Z"], [1.0; 3], BODY),
        ("euler-angles-yzx", ["Y", "Z", "X"], [1.0; 3], BODY),
        ("beam-cone", ["X", "Y", "Z"], [0.85, 0.85, 1.08], &[("m", "m", 1.0), ("n", "n", 1.08)]),
    ] {
        let figure = figure(name);
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
            let is_drawn = drawn_paths(&elements).any(|Path { points, style, .. }| {
                style.0 == "#d55e00"
                    && points.len() == 2
                    && ends.iter().zip(points).all(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) < HALF_A_PIXEL)
            });
            assert!(is_drawn, "{name}: the line of nodes is elsewhere");
        }
    }
}
