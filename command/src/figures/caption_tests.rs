//! The numbers of captions agree with the tables beside them.

use super::data_tests::{column, drawn};
use super::drawn::number;
use super::fixtures::{figure, fixtures};
use super::spin_down::{Timed, sizes};
use super::spin_down_tests;
use super::{Caption, Table};

/// A number of a caption, as `0.0025` or `2.5 × 10^{−7}`.
fn told(text: &str) -> f64 {
    number(&text.replace(['{', '}'], "")).unwrap_or_else(|| panic!("`{text}` is no number"))
}

/// Checks numbers of a caption, in its order: the text before and after each, its value, and the number of digits.
pub(super) fn assert_told(mut caption: &str, numbers: &[(&str, &str, f64, usize)]) {
    for &(before, after, expected, digits) in numbers {
        let (_, rest) = caption.split_once(before).unwrap_or_else(|| panic!("no `{before}` in {caption}"));
        let (words, _) = rest.split_once(after).unwrap_or_else(|| panic!("no `{after}` in {rest}"));
        let rounded: f64 = format!("{expected:.*e}", digits - 1).parse().unwrap();
        assert!((told(words) / rounded - 1.0).abs() < 1e-12, "`{before}{words}{after}`, expected {rounded}");
        caption = &rest[words.len()..];
    }
}

/// The beginnings of the four paragraphs of a caption.
pub(super) fn assert_begins(caption: &Caption, parts: [&str; 4]) {
    for (paragraph, part) in caption.paragraphs().into_iter().zip(parts) {
        assert!(paragraph.starts_with(part), "`{part}`, but\n`{paragraph}`");
    }
}

pub(super) fn table(figure_name: &str, name: &str) -> &'static Table {
    figure(figure_name).tables.iter().find(|table| table.name == name).expect("a table")
}

/// The smallest and the largest number of a column.
pub(super) fn extremes(table: &Table, column: usize) -> [f64; 2] {
    let values = || table.rows.iter().map(|row| row[column]);
    [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
}

#[test]
fn differences_in_captions_are_those_of_the_columns() {
    let mut compared = 0;
    for figure in fixtures().filter(|figure| figure.name.starts_with("motion")) {
        let table = figure.tables.iter().find(|table| table.name == "angles").unwrap();
        for solution in ["printed", "corrected"] {
            let Some((_, says)) = figure.caption.says.split_once(&format!("perturbation, {solution}: up to ")) else {
                assert!(!table.columns.iter().any(|head| head.contains(solution)), "{}", figure.caption.says);
                continue;
            };
            let [alpha, beta] = ["alpha", "beta"].map(|angle| {
                let [ours, theirs] = ["", &format!(" by perturbation {solution}")]
                    .map(|by| column(table, &format!("{angle}{by} [rad]")));
                table.rows.iter().map(|row| (row[ours] - row[theirs]).abs()).fold(0.0, f64::max)
            });
            assert_told(says, &[("", " rad in *α*", alpha, 2), (" and ", " rad in *β*", beta, 2)]);
            compared += 2;
        }
    }
    assert!(compared >= 16, "{compared}");
}

#[test]
fn parts_of_the_time_in_captions_are_those_of_the_columns() {
    let mut compared = 0;
    for (name, scene, figures) in drawn() {
        for figure in figures.into_iter().filter(|figure| figure.name == "beam-alignment") {
            let Some(table) = figure.tables.iter().find(|table| table.name == name) else { continue };
            let edge = scene.pulsar.unwrap().rho.cos();
            let inside = table.rows.iter().filter(|row| row[column(table, "m.n [1]")] > edge).count();
            let part = 100.0 * inside as f64 / table.rows.len() as f64;
            let says = &figure.caption.says;
            let Some((before, _)) = says.split_once(&format!(" % of the time for {name}")) else {
                assert!(part == 0.0 || part == 100.0, "{name}: {part} % and `{says}`");
                continue;
            };
            let words: Vec<_> = before.rsplit([',', ' ']).take(3).collect();
            let last = words.into_iter().rev().skip_while(|word| word.parse::<f64>().is_err());
            let said = told(&last.collect::<Vec<_>>().join(" "));
            // The caption has two digits.
            assert!((said - part).abs() <= 0.0501 * part, "{name}: {said} %, {part} % of the rows");
            compared += 1;
        }
    }
    assert!(compared >= 4, "{compared}");
}

/// At the inclinations of the table nearest to 0.2 and 1.4.
#[test]
fn factors_are_those_of_the_curves() {
    let figure = figure("bound-factor");
    let [small, large] = [12, 107].map(|k| &figure.tables[0].rows[k]);
    assert_told(
        &figure.caption.says,
        &[
            ("moves little: ", " at", small[2], 2),
            ("*β*_{0} = ", ", where", small[0], 2),
            ("1/cos *β*_{0} is ", ". It", 1.0 / small[0].cos(), 2),
            ("about 1.4 (", " at", large[2], 2),
            ("*β*_{0} = ", ", where", large[0], 2),
            ("1/cos *β*_{0} is ", "), and", 1.0 / large[0].cos(), 2),
        ],
    );
}

#[test]
fn waves_have_the_ranges_of_the_columns() {
    let numbers = ["tp-I", "tp-II"].map(|name| [1, 2].map(|column| extremes(table("waves", name), column)));
    let [[[a, b], [c, d]], [[e, f], [g, h]]] = numbers;
    let expected = [
        ("For tp-I, *h*_{+} is from ", " to ", a, 3),
        (" to ", " and ", b, 3),
        ("*h*_{×} from ", " to ", c, 3),
        (" to ", ". For", d, 3),
        ("tp-II, *h*_{+} is from ", " to ", e, 3),
        (" to ", " and ", f, 3),
        ("*h*_{×} from ", " to ", g, 3),
        (" to ", "; the", h, 3),
    ];
    assert_told(&figure("waves").caption.says, &expected);
}

#[test]
fn pulses_are_counted_and_have_the_ranges_of_the_columns() {
    for name in ["tp-I", "tp-II"] {
        let (_, says) = figure("pulse-series").caption.says.split_once(&format!("{name}: ")).unwrap();
        let [periods, lengths] = ["periods", "lengths"].map(|what| table("pulse-series", &format!("{name}-{what}")));
        let ([shortest, longest], [narrowest, widest]) = (extremes(periods, 1), extremes(lengths, 1));
        assert_told(
            says,
            &[
                ("", " whole pulses", lengths.rows.len() as f64, 3),
                ("periods from ", " to ", shortest, 3),
                (" to ", " *t*_{c}", longest, 3),
                ("lengths from ", " to ", narrowest, 3),
                (" to ", " *t*_{c}", widest, 3),
            ],
        );
    }
    let [gaps, kept] = ["tp-II-gaps", "tp-II-periods"].map(|name| table("pulse-series", name).rows.len() as f64);
    let left_out = [("*t*_{c} (", " of ", gaps, 3), (" of ", " intervals left out", gaps + kept, 3)];
    assert_told(&figure("pulse-series").caption.says, &left_out);
}

/// The strongest line of both polarizations, and the statements about other lines of that one, which is `h_+`.
#[test]
fn lines_of_waves_are_those_of_the_tables() {
    let says = &figure("wave-spectra").caption.says;
    for name in ["tp-I", "tp-II"] {
        let (_, says) = says.split_once(&format!("line of {name} is in *h*_{{+}}: ")).unwrap();
        let [plus, cross] = ["plus", "cross"].map(|what| table("wave-spectra", &format!("{name}-{what}-lines")));
        let strongest = |is_one: &dyn Fn(&[f64]) -> bool| {
            let rows = plus.rows.iter().filter(|row| is_one(row));
            rows.max_by(|a, b| a[1].total_cmp(&b[1])).expect("a line")
        };
        let (first, third) = (strongest(&|_| true), strongest(&|row| row[2].abs() == 3.0));
        assert!(first[1] > extremes(cross, 1)[1], "{name}");
        let mut numbers = vec![
            (" at ", " rad/*t*_{c}", first[0], 6),
            ("of an amplitude of ", "; the strongest of the third harmonic", first[1], 3),
            (" at ", " rad/*t*_{c}", third[0], 6),
            (", has ", " of it", third[1] / first[1], 2),
        ];
        if name == "tp-II" {
            let slow = strongest(&|row| row[2] == 0.0 && row[4].abs() == 1.0);
            numbers.push(("*l* by itself has ", " of it", slow[1] / first[1], 2));
        }
        assert_told(says, &numbers);
    }
}

#[test]
fn spin_down_is_that_of_its_tables() {
    let figure = figure("spin-down");
    let [curves, lines] = &figure.tables[..] else { panic!("two tables") };
    let [[rms, largest], [of_geometry, most]] = [1, 3].map(|k| sizes(&spin_down_tests::column(curves, k)));
    let [[slow, fast], [narrow, wide]] = [4, 5].map(|k| extremes(curves, k));
    let [absent, once, twice] = &lines.rows[..] else { panic!("three lines") };
    assert_told(
        &figure.caption.says,
        &[
            ("makes residuals of ", " ms (root mean square)", rms, 2),
            ("(root mean square), ", " ms at most", largest, 2),
            ("; geometry makes ", " ms", of_geometry, 2),
            (" ms, ", " ms at most", most, 2),
            ("frequency changes by ", " % of itself", 100.0 * (fast / slow - 1.0).abs(), 1),
            ("the beam width from ", " to ", narrow, 3),
            (" to ", " ms. Before", wide, 3),
            ("have lines of ", " ms at 500 d", once[1], 3),
            ("500 d and of ", " ms at 250 d", twice[1], 2),
            ("in the rate these are ", " and ", once[2], 3),
            (" and ", " × 10^{−15} Hz/s", twice[2], 3),
            ("in the width ", " and ", once[3], 2),
            (" and ", " ms. A biaxial", twice[3], 2),
            ("but none of ", " d: a line", absent[0], 3),
            ("a line fitted there has ", " ms. Stairs", absent[1], 1),
        ],
    );
    assert_told(&figure.caption.parameters, &[("*F*1 = ", " Hz/s", -3.6568e-13, 5)]);
    let bars = [
        ("Green bars: ", " d, the period of the free precession", once[0], 3),
        ("of the free precession, and ", " d, half of it", twice[0], 3),
    ];
    assert_told(&figure.caption.shows, &bars);
}

/// The table is in seconds.
#[test]
fn residuals_by_violation_are_those_of_their_table() {
    let figure = figure("violation-residuals");
    let [torque, geometry, least, middle, most, direct] =
        [1, 2, 3, 4, 5, 6].map(|k| sizes(&spin_down_tests::column(&figure.tables[0], k)));
    // At ten thousand times the limit, which is still small enough to be linear.
    let rate = |factor: f64| Timed::new(factor).unwrap().pulsar.clock.precession_rates().unwrap()[0];
    let shift = (rate(1e4) / rate(0.0) - 1.0).abs() / 1e4;
    assert_told(
        &figure.caption.says,
        &[
            ("Lorentz violation adds ", " ps (root mean square)", least[0] / 1e-12, 2),
            ("(root mean square), ", " ps at most", least[1] / 1e-12, 2),
            ("The torque makes ", " ms", torque[0] / 1e-3, 2),
            (" ms, ", " times as much", torque[0] / least[0], 2),
            ("geometry makes ", " ms", geometry[0] / 1e-3, 2),
            ("grows as *s*: ", " ns at", middle[0] / 1e-9, 2),
            ("times the limit, ", " μs at", most[0] / 1e-6, 2),
            (" by ", " of itself at the limit", shift, 2),
            ("the direct part is only ", " ps (", direct[0] / 1e-12, 2),
            (" ps (", " ps at", direct[1] / 1e-12, 2),
        ],
    );
}

/// The words of a caption about lines, points and names appear if and only if these are drawn.
#[test]
fn captions_tell_of_what_is_drawn() {
    let mut seen = [[0; 2]; 5];
    for figure in fixtures() {
        let caption = &figure.caption;
        for other in [&caption.shows, &caption.method, &caption.says] {
            assert!(!other.contains("Angles in rad"), "{}: parameters in {other}", figure.name);
        }
        let count = |what: &str| figure.tables.iter().filter(|table| table.name.ends_with(what)).count();
        // Rates of free precession are vermilion and dashed; the third harmonic is enlarged beside a dotted line.
        let has_line = |colour: &str, dashes: &str| {
            let lines = figure.svg.lines().filter(|line| line.contains(&format!("stroke=\"{colour}\"")));
            lines.filter(|line| line.contains(&format!("stroke-dasharray=\"{dashes}\""))).count() > 0
        };
        let mut told = |place: usize, is_told: bool, is_drawn: bool| {
            assert_eq!(is_told, is_drawn, "{}, {place}: {} {}", figure.name, caption.shows, caption.method);
            seen[place][usize::from(is_told)] += 1;
        };
        match figure.name {
            "beam-alignment-spectra" => told(0, caption.shows.contains("Dashed: "), has_line("#d55e00", "5 2.5")),
            "wave-spectra" => {
                told(0, caption.shows.contains("Dashed: "), has_line("#d55e00", "5 2.5"));
                told(
                    1,
                    caption.shows.contains("the insets enlarge"),
                    figure.svg.contains("stroke-dasharray=\"1.2 1.8\""),
                );
            }
            "pulse-series" => {
                told(2, caption.shows.contains("Intervals that are not"), count("-gaps") > 0);
                told(3, caption.method.contains("Solid curves"), count("-curves") > 0);
                // Points of a motion without curves are joined if there are two.
                let has_curves = |name: &str| figure.tables.iter().any(|table| table.name == format!("{name}-curves"));
                let is_joined = figure.tables.iter().any(|table| {
                    table.name.strip_suffix("-lengths").is_some_and(|name| {
                        let gaps = figure.tables.iter().find(|table| table.name == format!("{name}-gaps"));
                        !has_curves(name) && table.rows.len() > 1 + gaps.map_or(0, |gaps| gaps.rows.len())
                    })
                });
                told(4, caption.shows.contains("Thin grey lines join points"), is_joined);
            }
            _ => {}
        }
    }
    assert!(seen.iter().flatten().all(|count| *count > 0), "{seen:?}");
}
