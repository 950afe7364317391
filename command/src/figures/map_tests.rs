//! Every cell and line of the maps, read off the picture, agrees with the tables.

use super::curve_tests::{HALF_A_PIXEL, LABELS, assert_same, entry};
use super::drawn::{Element, Frame, Path, Point, Text, elements, frames, holds, number, paths, texts};
use super::fixtures::figure;

fn frames_with_titles(elements: &[Element]) -> Vec<(String, Frame)> {
    let frames = frames(elements);
    let title = |frame: &Frame| {
        // The upper frame of a column has the title.
        let upper = frames.iter().find(|other| other.corners[0] == frame.corners[0] && !other.heading.is_empty());
        if frame.heading.is_empty() { upper.expect("a title").heading.clone() } else { frame.heading.clone() }
    };
    frames.iter().map(|frame| (title(frame), frame.clone())).collect()
}

/// The colours of the map are those that the scale beside it assigns to the numbers of the table; the same holds for the lines and rings.
#[test]
fn the_map_of_the_errors_is_its_table() {
    let figure = figure("perturbation-regimes");
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
    let beside = texts(&elements).filter(|text| text.at[0] > right && text.at[1] < 200.0);
    let powers = beside.filter_map(|text| Some((text.at[1] - 2.8, number(&text.words)?.log10())));
    let powers: Vec<_> = powers.collect();
    let [(p, a), (q, b)] = [powers[0], powers[powers.len() - 1]];
    let power = |y: f64| a + (b - a) * (y - p) / (q - p);
    let range = |colour: &str| {
        let (corners, _) = bar.iter().find(|(_, fill)| *fill == colour).expect("a colour of the scale");
        // A cell extends 0.3 below its end.
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
        for Path { points, style, .. } in paths(&elements) {
            let is_inside = points.iter().all(|at| holds(&frame.corners, *at, 0.02));
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
                [Element::Circle { at, radius, .. }, Element::Text(Text { words, .. })]
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

/// The area of each method ends at the height at which the column of that method crosses the error.
#[test]
fn the_map_of_the_methods_is_its_tables() {
    let figure = figure("method-regimes");
    let elements = elements(&figure.svg);
    let colours = elements.iter().enumerate().filter_map(|(i, element)| match (element, elements.get(i + 2)) {
        (Element::Cell { fill, .. }, Some(Element::Text(Text { words, .. }))) => Some((fill.clone(), words.clone())),
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
        ("exact motion", "torus: error of n [rad]"),
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
        let mut beside = texts(&elements).filter(|text| text.at[1] > top && text.at[1] < bottom);
        let asked = beside.find_map(|text| number(text.words.strip_prefix("error ")?.strip_suffix(" rad")?));
        let asked = asked.expect("an error").log10();
        let mut times: Vec<_> = table.rows.iter().map(|row| row[1]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut shown = Vec::new();
        for pair in elements.windows(2) {
            let [Element::Path(Path { points, fill, .. }), Element::Path(Path { points: edge, .. })] = pair else {
                continue;
            };
            let Some((_, name)) = colours.iter().find(|(colour, _)| colour == fill) else { continue };
            if !points.iter().all(|at| holds(&frame.corners, *at, 0.1)) {
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
            // The area is below the edge.
            let lowest = points.iter().filter(|p| (p[1] - bottom).abs() < 0.02).count();
            assert!(
                lowest >= 2 && edge.iter().all(|p| points.contains(p)),
                "{title} {name}: the area is not below its edge"
            );
            // The exact motion meets every error: nothing stays white.
            if name == "exact motion" {
                assert!(edge.iter().all(|p| (p[1] - top).abs() < 0.02), "{title}: white above {edge:?}");
                assert!(table.rows.iter().all(|row| row[column] < 1e-11), "{title}: the caption says less than 1e-11");
            }
            shown.push(name.clone());
            areas += 1;
        }
        let columns = table.columns.iter().filter(|column| column.ends_with(": error of n [rad]")).count();
        assert_eq!(shown.len(), columns, "{title}: {shown:?}");
    }
    assert_eq!((frames.len(), areas), (8, 36));
}
