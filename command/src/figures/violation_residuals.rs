//! The effect of Lorentz violation of several sizes on the residuals of PSR B1828-11.

use super::drawing::*;
use super::spin_down::{Timed, angles, dates, sizes};

const NAME: &str = "violation-residuals";

/// 95 % limit on `alpha_2` in the scene.
pub(super) const LIMIT: f64 = 1.6e-9;

/// Factors on `s` of the scene, which is that of the limit, with line style and name.
pub(super) const SIZES: [(f64, Line, &str); 3] = [
    (1.0, solid(BLUE, 1.2), "limit"),
    (1e2, dashed(BLUE, 1.1), "limit × 10^{2}"),
    (1e4, dash_dotted(BLUE, 1.1), "limit × 10^{4}"),
];

const TORQUE: Line = solid(VERMILION, 1.2);
const GEOMETRY: Line = solid(BLACK, 1.0);
const DIRECT: Line = dashed(PURPLE, 1.1);

/// Enlargement of the direct part.
pub(super) const ENLARGED: f64 = 50.0;

/// Range of residuals (s).
const SHOWN: (f64, f64) = (1e-14, 0.1);

pub(super) fn sheet() -> Result<Sheet, String> {
    let (free, largest) = (Timed::new(0.0)?, Timed::new(SIZES[2].0)?);
    let rate = |timed: &Timed| timed.pulsar.clock.stretched_time().precession().rate;
    let shift = (rate(&largest) / rate(&free) - 1.0).abs() / SIZES[2].0;
    let violated = SIZES.iter().map(|(factor, ..)| Timed::new(*factor)).collect::<Result<Vec<_>, String>>()?;
    let columns = ["date [MJD]", "torque [s]", "geometry [s]"].map(str::to_owned);
    let added = SIZES.iter().map(|(factor, ..)| format!("added for alpha_2 = {:.1e} [s]", factor * LIMIT));
    let direct = format!("of that without the torque for alpha_2 = {LIMIT:e} [s]");
    let mut table = Table::new("", columns.into_iter().chain(added).chain([direct]));
    for (i, date) in free.dates().enumerate() {
        // Differences of causes are free of the rounding of arrival times.
        let added = |timed: &Timed| timed.causes.violation[i] + (timed.causes.torque[i] - free.causes.torque[i]);
        let first = [date, free.causes.torque[i], free.causes.geometry[i]];
        let direct = violated[0].causes.violation[i];
        table.push(first.into_iter().chain(violated.iter().map(added)).chain([direct]).collect::<Vec<_>>());
    }
    Ok(Sheet { svg: draw(&table), caption: caption(&free, &table, shift), tables: vec![table] })
}

fn draw(table: &Table) -> String {
    let (left, top, names) = (LEFT + 4.0, 18.0, 72.0);
    let upper = Rectangle { left, top, width: PAGE - left - names, height: 150.0 };
    let lower = Rectangle { top: upper.bottom() + 20.0, height: 92.0, ..upper };
    let mut page = Page::new(NAME, PAGE, lower.bottom() + BELOW);
    let x = dates(table);
    let curves = |panel: &Panel, page: &mut Page, drawn: &[(usize, f64, Line, String)], size: fn(f64) -> f64| {
        let mut ends = Vec::new();
        for (column, factor, line, name) in drawn {
            let points: Vec<_> = table.rows.iter().map(|row| (row[0], size(factor * row[*column]))).collect();
            panel.curve(page, &points, *line);
            let &(at, last) = points.last().expect("pulses");
            ends.push((panel.at(at, last), name.clone(), line.colour));
        }
        panel.draw_frame(page);
        name_ends(page, panel.frame, ends);
    };

    let panel = Panel::new(upper, x.bare(), Axis::logarithmic("size of the residual [s]", SHOWN.0, SHOWN.1));
    let causes = [(1, 1.0, TORQUE, "torque".to_owned()), (2, 1.0, GEOMETRY, "geometry".to_owned())];
    let violations = (3..).zip(SIZES).map(|(column, (_, line, name))| (column, 1.0, line, name.to_owned()));
    // Changes of sign are below the frame.
    let size = |late: f64| late.abs().max(0.1 * SHOWN.0);
    curves(&panel, &mut page, &causes.into_iter().chain(violations).collect::<Vec<_>>(), size);
    panel.letter(&mut page, 0, 2, "torque, geometry, and what Lorentz violation adds");

    let at_limit = |column: usize| table.rows.iter().map(move |row| 1e12 * row[column]);
    let y = Axis::around("residual [ps]", at_limit(3));
    let panel = Panel::new(lower, x, y);
    panel.level(&mut page, 0.0, solid(LIGHT, 0.5));
    let direct = (6, 1e12 * ENLARGED, DIRECT, format!("direct × {ENLARGED}"));
    curves(&panel, &mut page, &[(3, 1e12, SIZES[0].1, "all".to_owned()), direct], |late| late);
    panel.letter(&mut page, 1, 2, "what it adds at the limit");
    page.finish("Residuals of PSR B1828-11 by Lorentz violation")
}

fn caption(timed: &Timed, table: &Table, shift: f64) -> Caption {
    let column = |k: usize| table.rows.iter().map(|row| row[k]).collect::<Vec<_>>();
    let [torque, geometry, least, middle, most, direct] = [1, 2, 3, 4, 5, 6].map(|k| sizes(&column(k)));
    let numbers = [
        ("enlarged", ENLARGED),
        ("limit", LIMIT),
        ("torque_rms", 1e3 * torque[0]),
        ("geometry_rms", 1e3 * geometry[0]),
        ("least_rms", 1e12 * least[0]),
        ("least_largest", 1e12 * least[1]),
        ("middle_rms", 1e9 * middle[0]),
        ("most_rms", 1e6 * most[0]),
        ("direct_rms", 1e12 * direct[0]),
        ("direct_largest", 1e12 * direct[1]),
        ("below_torque", torque[0] / least[0]),
        ("shift", shift),
    ];
    let numbers = numbers.map(|(name, value)| (name, significant(value, 2)));
    Caption::of(NAME, &[&numbers[..], &angles(timed)].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each is 1.0495 of its unit, printed with two digits: 0.1 % more would be 1.1.
    #[test]
    fn a_caption_tells_sizes_in_their_units() {
        let mut table = Table::new("", ["date", "torque", "geometry", "1", "2", "3", "direct"]);
        for sign in [1.0, -1.0] {
            table.push([0.0, 1e-3, 1e-3, 1e-12, 1e-9, 1e-6, 1e-12].map(|unit| sign * 1.0495 * unit));
        }
        let told = caption(&Timed::new(0.0).unwrap(), &table, 2.34e-7);
        for says in [
            "At the limit Lorentz violation adds 1 ps (root mean square), 1 ps at most. The torque makes 1 ms, 1 × 10^{9} times as much; \
             geometry makes 1 ms.",
            "What is added grows as *s*: 1 ns at 10^{2} times the limit, 1 μs at 10^{4} times.",
            "by 2.3 × 10^{−7} of itself at the limit",
            "the direct part is only 1 ps (1 ps at most).",
        ] {
            assert!(told.says.contains(says), "{says}, but {}", told.says);
        }
        assert!(
            told.shows.contains("2013), 1.6 × 10^{−9} (solid)") && told.shows.ends_with("times 50 (dashed)."),
            "{}",
            told.shows
        );
    }
}
