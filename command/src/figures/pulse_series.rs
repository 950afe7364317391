//! The series of pulse periods and of pulse lengths, with the curves of Eqs. (51) and (56).

use twofold::observables::pulsar::Stamped;
use twofold::observables::pulsar::period::approximate_period;
use twofold::solutions::perturbation::{Perturbation, ShiftedRates};

use super::drawing::*;
use twofold_verify::pulse_series::{PaperCurves, PulseSeries, Viewing, pulse_series};

/// The curves with the names of their angles and rates in the legend and in the data.
const CURVES: [(Line, &str); 3] = [
    (solid(BLUE, 1.0), "at the instant"),
    (dotted(GREEN, 1.2), "with mean rates"),
    (dashed(VERMILION, 1.0), "with rates (57)"),
];

/// Curves are drawn if the amplitude A is below this fraction of omega.
const MOST_SWING: f64 = 0.1;

/// Series of one motion in the units of the figure, and curves if Eqs. (51), (56) apply.
struct Series {
    pulses: PulseSeries,
    curves: Option<Table>,
}

impl Series {
    /// A curve of periods (row 0) or lengths (row 1).
    fn curve(&self, row: usize, i: usize) -> Option<Vec<(f64, f64)>> {
        self.curves.as_ref().map(|table| table.points(0, 1 + row + 2 * i))
    }

    fn values(&self, row: usize) -> Vec<f64> {
        let points = if row == 0 { &self.pulses.periods } else { &self.pulses.lengths };
        let on_curves = (0..CURVES.len()).filter_map(|i| self.curve(row, i)).flatten().map(|(_, y)| y);
        points.iter().map(|point| point.value).chain(on_curves).collect()
    }

    /// The pieces of a series between gaps.
    fn pieces<'a>(&'a self, points: &'a [Stamped]) -> impl Iterator<Item = &'a [Stamped]> {
        let gap_between = |a: f64, b: f64| self.pulses.gaps.iter().any(|gap| a < gap.time && gap.time < b);
        points.chunk_by(move |a, b| !gap_between(a.time, b.time))
    }
}

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let series = subjects.iter().map(|subject| series(subject)).collect::<Result<Vec<_>, _>>()?;
    let mut tables = Vec::new();
    for (subject, series) in subjects.iter().zip(&series) {
        let pulses = &series.pulses;
        for (what, points) in [("period", &pulses.periods), ("gap", &pulses.gaps), ("length", &pulses.lengths)] {
            if what == "gap" && points.is_empty() {
                continue;
            }
            let columns = ["t", what].map(|of| subject.scale.time_column(of));
            let mut table = Table::new(format!("{}-{what}s", subject.name), columns);
            points.iter().for_each(|point| table.push([point.time, point.value]));
            tables.push(table);
        }
        tables.extend(series.curves.clone());
    }
    Ok(Sheet { svg: draw(name, subjects, &series), caption: caption(subjects, &series), tables })
}

fn series(subject: &Subject) -> Result<Series, String> {
    let message = |error: twofold::Error| format!("{}: {error}", subject.name);
    let (viewer, pulsar) = subject.line_of_sight()?;
    let span = (0.0, subject.shown.pulses);
    let mut pulses = pulse_series(&subject.motion, &pulsar.beam(), &viewer.basis().direction, span).map_err(message)?;
    for point in pulses.periods.iter_mut().chain(&mut pulses.gaps).chain(&mut pulses.lengths) {
        (point.time, point.value) = (subject.scale.time(point.time), subject.scale.time(point.value));
    }
    let steady = subject.printed.as_ref().ok().filter(|solution| is_steady(solution));
    let curves = steady.map(|solution| curves(subject, solution)).transpose()?;
    Ok(Series { pulses, curves })
}

/// Whether the formulas apply to a solution: twofold precession with a beta that is nearly constant during a turn. They fail for tp-II, whose A is
/// 0.36 omega.
fn is_steady(solution: &Perturbation<f64>) -> bool {
    solution.zeroth_rate != 0.0 && solution.constants.amplitude.abs() < MOST_SWING * solution.omega.abs()
}

/// Period and length with the angles and rates at the instant, by Eqs. (51) and (56) with mean rates, and with the rates of Eq. (57).
fn curves(subject: &Subject, solution: &Perturbation<f64>) -> Result<Table, String> {
    let message = |error: twofold::Error| format!("{}: {error}", subject.name);
    let (viewer, pulsar) = subject.line_of_sight()?;
    let viewing = Viewing { chi: pulsar.chi, delta: pulsar.delta, rho: pulsar.rho, theta_o: viewer.theta_o };
    let (end, beta_0) = (subject.shown.pulses, solution.constants.beta_0);
    let paper = PaperCurves::new(&subject.motion, viewing, end).map_err(message)?;
    let angles = subject.angles(&[0.0, end])?;
    let [(_, first), (_, last)] = angles[..] else { return Err("the axis is on a pole".into()) };
    let mean = ShiftedRates { alpha: (last.alpha - first.alpha) / end, gamma: (last.gamma - first.gamma) / end };
    let shifted = ShiftedRates { alpha: solution.rate, gamma: subject.spin() - solution.rate * beta_0.cos() };
    let columns =
        CURVES.iter().flat_map(|(_, of)| ["period", "length"].map(|q| subject.scale.time_column(&format!("{q} {of}"))));
    let columns = std::iter::once(subject.scale.time_column("t")).chain(columns);
    let mut table = Table::new(format!("{}-curves", subject.name), columns);
    for t in times(end, 1000) {
        let mut row = vec![t];
        row.extend(paper.at(t).map_err(message)?);
        for rates in [mean, shifted] {
            let at = viewing.formulas([beta_0, first.gamma + rates.gamma * t], [rates.alpha, rates.gamma]);
            let at = at.map_err(message)?;
            row.extend([approximate_period(rates.alpha, at.offset_rate), at.width / at.azimuth_rate]);
        }
        table.push(row.into_iter().map(|time| subject.scale.time(time)).collect::<Vec<_>>());
    }
    Ok(table)
}

fn draw(name: &str, subjects: &[&Subject], series: &[Series]) -> String {
    let grid = Grid::two_rows(subjects.len(), 92.0, 46.0);
    let with_legend = series.iter().any(|series| series.curves.is_some());
    let legend_height = if with_legend { 14.0 } else { 0.0 };
    let mut page = Page::new(name, PAGE, grid.bottom(2) + BELOW + legend_height);
    for (i, (subject, series)) in subjects.iter().zip(series).enumerate() {
        let x = subject.scale.time_axis(subject.shown.pulses);
        for (row, (points, label, taken_off)) in
            [(&series.pulses.periods, "period", "*P*"), (&series.pulses.lengths, "length", "*W*")]
                .into_iter()
                .enumerate()
        {
            let frame = grid.frame(i, row);
            let curve = |i: usize| series.curve(row, i);
            let values = series.values(row);
            // Differences invisible on an axis are drawn as differences.
            let reference = reference(&values);
            let shift = reference.unwrap_or(0.0);
            let difference = reference.map_or(String::new(), |_| format!(" − {taken_off}"));
            let label = subject.scale.time_label(&format!("{label}{difference}"));
            let y = match values.is_empty() {
                true => Axis::linear(&label, 0.0, 1.0).unnumbered(),
                false => Axis::around(&label, values.iter().map(|value| value - shift)),
            };
            let mut panel = Panel::new(frame, if row == 0 { x.bare() } else { x.clone() }, y);
            panel.y_label_distance = 26.0;
            // The paper's curve is above the others.
            for (i, (line, _)) in CURVES.iter().enumerate().rev() {
                if let Some(points) = curve(i) {
                    panel.curve(&mut page, &shifted(points.into_iter(), shift), *line);
                }
            }
            let pairs = |points: &[Stamped]| shifted(points.iter().map(|point| (point.time, point.value)), shift);
            if series.curves.is_none() {
                for piece in series.pieces(points) {
                    panel.curve(&mut page, &pairs(piece), solid(GREY, 0.5));
                }
            }
            let points = pairs(points);
            panel.marks(&mut page, &points, Mark::Disc, 1.4, BLACK);
            if points.is_empty() {
                panel.remark(&mut page, if series.pulses.lengths.is_empty() { "no whole pulse" } else { "no period" });
            }
            panel.draw_frame(&mut page);
            if let Some(reference) = reference {
                let text = format!("{taken_off} = {} {}", significant(reference, 15), subject.scale.time_unit());
                page.text([frame.right() - 5.0, frame.top + 12.0], Anchor::End, SMALL, BLACK, &text);
            }
            if row == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
        }
    }
    if with_legend {
        let y = grid.bottom(2) + BELOW + 8.0;
        legend(&mut page, [LEFT, y], &[(Sample::Mark(Mark::Disc, BLACK), "pulses")]);
        for ((line, of), x) in CURVES.iter().zip([66.0, 210.0, 316.0]) {
            let name = if x < 70.0 { format!("Eqs. (51), (56) {of}") } else { (*of).to_owned() };
            legend(&mut page, [LEFT + x, y], &[(Sample::Line(*line), &name)]);
        }
    }
    page.finish("Pulse periods and lengths in time")
}

/// The value subtracted from numbers whose differences would be invisible on an axis.
fn reference(values: &[f64]) -> Option<f64> {
    Spread::of(values.iter().copied()).and_then(Spread::reference)
}

fn shifted(points: impl Iterator<Item = (f64, f64)>, by: f64) -> Vec<(f64, f64)> {
    points.map(|(t, value)| (t, value - by)).collect()
}

fn caption(subjects: &[&Subject], series: &[Series]) -> Caption {
    let text = |part| sentences("pulse-series", part, &[("kind", subjects[0].kind().to_owned())]);
    let ranges = subjects.iter().zip(series).map(|(subject, Series { pulses, .. })| {
        let name = &subject.name;
        let unit = format!(" {}", subject.scale.time_unit());
        let range = |points: &[Stamped]| {
            Spread::of(points.iter().map(|point| point.value)).map(|spread| spread.in_words(&unit))
        };
        let whole = match pulses.lengths.len() {
            0 => "no whole pulse".to_owned(),
            1 => "1 whole pulse".to_owned(),
            count => format!("{count} whole pulses"),
        };
        let left_out = match pulses.gaps.len() {
            0 => String::new(),
            count => format!(" ({count} of {} intervals left out)", count + pulses.periods.len()),
        };
        let periods = range(&pulses.periods).map_or(String::new(), |range| format!(", periods {range}")) + &left_out;
        let lengths = range(&pulses.lengths).map_or(String::new(), |range| format!(", lengths {range}"));
        format!("{name}: {whole}{periods}{lengths}.")
    });
    let mut says: Vec<_> = ranges.collect();
    if series.iter().any(|series| series.curves.is_some()) {
        says.push(text("formulas"));
    }
    if subjects.len() > 1 {
        says.push(text("modulation"));
    }
    let mut shows = text("shows");
    let mut method = text("method");
    if series.iter().any(|series| !series.pulses.gaps.is_empty()) {
        shows += &format!(" {}", text("gaps"));
    }
    let apart = |row: usize| series.iter().any(|series| reference(&series.values(row)).is_some());
    shows += match [apart(0), apart(1)] {
        [true, true] => " Drawn are the differences from the *P* and *W* given in the panels.",
        [true, false] => " Of the periods the differences from the *P* given in the panel are drawn.",
        [false, true] => " Of the lengths the differences from the *W* given in the panel are drawn.",
        [false, false] => "",
    };
    let is_joined = |series: &&Series| {
        series.curves.is_none() && series.pieces(&series.pulses.lengths).any(|piece| piece.len() > 1)
    };
    if series.iter().any(|series| is_joined(&series)) {
        let only = if series.iter().any(|series| series.curves.is_some()) { " where there are no curves" } else { "" };
        let broken = match series.iter().filter(is_joined).any(|series| !series.pulses.gaps.is_empty()) {
            true => ", broken where an interval is left out",
            false => "",
        };
        shows += &format!(" Thin grey lines join points{only}{broken}.");
    }
    if series.iter().any(|series| series.curves.is_some()) {
        method += &format!(" {}", text("curves"));
    }
    Caption { shows, parameters: parameters(&line_of_sight(subjects, true), subjects), method, says: says.join(" ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::fixtures::free;
    use twofold::solutions::perturbation::{Constants, Form, Precession};
    use twofold_scene::scene_file::{Scene, built_in};
    use twofold_verify::paper_examples::{COEFFICIENTS, spheroid};

    #[test]
    fn a_gap_parts_a_series() {
        let stamped = |times: &[f64]| times.iter().map(|&time| Stamped { time, value: 1.0 }).collect::<Vec<_>>();
        let pulses = PulseSeries { periods: Vec::new(), gaps: stamped(&[2.5, 9.0]), lengths: Vec::new() };
        let (series, points) = (Series { pulses, curves: None }, stamped(&[1.0, 2.0, 3.0, 4.0]));
        let pieces: Vec<Vec<f64>> =
            series.pieces(&points).map(|piece| piece.iter().map(|point| point.time).collect()).collect();
        assert_eq!(pieces, [[1.0, 2.0], [3.0, 4.0]]);
    }

    /// `omega` is 1.1 times the spin; the paper's tp-II has A = 0.4.
    #[test]
    fn the_formulas_are_for_twofold_precession_with_little_swing() {
        let is_steady = |kind, spin: f64, amplitude: f64| {
            let constants = Constants { alpha_0: 0.0, beta_0: 0.7, amplitude, phase: 0.0 };
            is_steady(&Perturbation::new(Form::Printed, kind, &spheroid(), &COEFFICIENTS, spin, &constants).unwrap())
        };
        for (spin, sign) in [(2.0, 1.0), (2.0, -1.0), (-2.0, 1.0), (-2.0, -1.0)] {
            let found = [0.0, 0.21, 0.23].map(|amplitude| is_steady(Precession::Twofold, spin, sign * amplitude));
            assert_eq!(found, [true, true, false], "{spin} {sign}");
            assert!(!is_steady(Precession::Single, spin, 0.0));
        }
    }

    /// Without Lorentz violation the rates of Eq. (57) are those of the motion and constant, so that the curves with them are those with the mean
    /// rates. The motion has errors of 1e-14 per t_c over five t_c.
    #[test]
    fn rates_of_eq_57_are_the_mean_ones_of_free_precession() {
        let star = free("a");
        let table = curves(&star, star.printed.as_ref().unwrap()).unwrap();
        for row in &table.rows {
            for (mean, shifted) in [(row[3], row[5]), (row[4], row[6])] {
                assert!((mean / shifted - 1.0).abs() < 1e-12 && mean > 0.0, "{row:?}");
            }
        }
    }

    /// A star that starts a full turn further about its axis is the same star.
    #[test]
    fn mean_rates_are_those_since_the_start() {
        let text = built_in("tp-1").unwrap().toml;
        let of = |gamma: &str| {
            let scene = Scene::from_toml("x", &text.replace("gamma = 0.0", gamma)).unwrap();
            let subject = Subject::of_scene("x", &scene).unwrap();
            curves(&subject, subject.printed.as_ref().unwrap()).unwrap()
        };
        let (start, turned) = (of("gamma = 0.0"), of("gamma = 6.283185307179586"));
        for (a, b) in start.rows.iter().flatten().zip(turned.rows.iter().flatten()) {
            assert!((a - b).abs() <= 1e-9 * b.abs() && !start.rows.is_empty(), "{a} {b}");
        }
    }

    fn told(all: &[Series]) -> [String; 3] {
        let stars = ["a", "b"].map(free);
        let subjects: Vec<_> = stars.iter().take(all.len()).collect();
        let told = caption(&subjects, all);
        assert!(
            told.parameters.starts_with("*θ*_{o} = 0.8, *φ*_{o} = 0, *χ* = 0.5, *δ* = 0, *ρ* = 0.6."),
            "{}",
            told.parameters
        );
        let text = |part| sentences("pulse-series", part, &[("kind", "numerical".to_owned())]);
        let rest = |said: &str, part| said.strip_prefix(&text(part)).expect("the text").to_owned();
        let says = told.says.replace(&text("formulas"), "<formulas>").replace(&text("modulation"), "<modulation>");
        [
            rest(&told.shows, "shows").replace(&text("gaps"), "<gaps>"),
            rest(&told.method, "method").replace(&text("curves"), "<curves>"),
            says,
        ]
    }

    fn made_up(periods: &[f64], gaps: &[f64], lengths: &[f64], curve: Option<f64>) -> Series {
        let of = |values: &[f64]| values.iter().map(|&value| Stamped { time: 0.0, value }).collect::<Vec<_>>();
        let curves = curve.map(|value| {
            let mut table = Table::new("", ["t", "1", "2", "3", "4", "5", "6"]);
            table.push([0.0, value, 1.0, value, 1.0, value, 1.0]);
            table
        });
        Series { pulses: PulseSeries { periods: of(periods), gaps: of(gaps), lengths: of(lengths) }, curves }
    }

    #[test]
    fn a_caption_tells_the_ranges_of_periods_and_lengths() {
        let says = |series: Series| told(&[series])[2].clone();
        assert_eq!(says(made_up(&[], &[], &[], None)), "a: no whole pulse.");
        assert_eq!(
            says(made_up(&[], &[], &[0.5], None)),
            "a: 1 whole pulse, lengths 0.5 *t*_{c} within 10^{−11} of that."
        );
        assert_eq!(
            says(made_up(&[4.0, 5.0], &[9.0], &[0.5, 1.0, 0.75, 0.5], None)),
            "a: 4 whole pulses, periods from 4 to 5 *t*_{c} (1 of 3 intervals left out), lengths from 0.5 to 1 *t*_{c}."
        );
        let both = told(&[made_up(&[], &[], &[], Some(1.0)), made_up(&[], &[], &[], None)]);
        assert_eq!(both[2], "a: no whole pulse. b: no whole pulse. <formulas> <modulation>");
    }

    /// Curves, lines between points, differences from a nearly common value, and gaps.
    #[test]
    fn a_caption_tells_what_is_drawn() {
        let joined = |gaps: &[f64]| made_up(&[4.0, 5.0], gaps, &[0.5, 1.0], None);
        let lines = " Thin grey lines join points";
        for (all, shows, method) in [
            (vec![made_up(&[], &[], &[0.5], None)], String::new(), ""),
            (vec![joined(&[])], format!("{lines}."), ""),
            (vec![joined(&[9.0])], format!(" <gaps>{lines}, broken where an interval is left out."), ""),
            (vec![made_up(&[4.0], &[], &[0.5, 1.0], Some(5.0))], String::new(), " <curves>"),
            (
                vec![joined(&[]), made_up(&[], &[], &[1.0], Some(1.0))],
                format!("{lines} where there are no curves."),
                " <curves>",
            ),
            (
                vec![made_up(&[], &[9.0], &[1.0], Some(1.0)), joined(&[])],
                format!(" <gaps>{lines} where there are no curves."),
                " <curves>",
            ),
            (
                vec![made_up(&[1.0], &[], &[1.0, 1.000_01], Some(1.000_01))],
                " Drawn are the differences from the *P* and *W* given in the panels.".into(),
                " <curves>",
            ),
            (
                vec![made_up(&[1.0], &[], &[1.0], Some(1.000_01))],
                " Of the periods the differences from the *P* given in the panel are drawn.".into(),
                " <curves>",
            ),
            (
                vec![made_up(&[1.0, 2.0], &[], &[1.0, 1.000_01], None)],
                format!(" Of the lengths the differences from the *W* given in the panel are drawn.{lines}."),
                "",
            ),
        ] {
            let told = told(&all);
            assert_eq!([&told[0], &told[1]], [&shows, method]);
        }
    }
}
