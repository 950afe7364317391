//! The series of pulse periods and of pulse lengths, with the curves of Eqs. (51) and (56).

use twofold::observables::pulsar::direction::cosine_of_colatitude;
use twofold::observables::pulsar::period::{approximate_period, azimuth_offset_rate};
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{PulseTrain, Stamped, pulse_train};
use twofold::solutions::perturbation::{Perturbation, ShiftedRates};

use super::axes::{Axis, BELOW, Mark, Panel};
use super::legend::{Sample, legend};
use super::parameters::{line_of_sight, parameters};
use super::style::{BLACK, BLUE, GREY, Line, PAGE, SMALL, VERMILION, dashed, solid};
use super::subject::times;
use super::svg::{Anchor, Page, Rectangle};
use super::table::Table;
use super::{Caption, Sheet, Subject};

const MEAN_RATES: Line = solid(BLUE, 1.0);
const SHIFTED_RATES: Line = dashed(VERMILION, 1.0);

/// Curves are drawn for an amplitude A below this part of omega.
const MOST_SWING: f64 = 0.1;

/// Series of one motion, and curves where Eqs. (51), (56) are meant to hold.
struct Series {
    periods: Vec<Stamped>,
    lengths: Vec<Stamped>,
    curves: Option<Table>,
}

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let series = subjects.iter().map(|subject| series(subject)).collect::<Result<Vec<_>, _>>()?;
    let mut tables = Vec::new();
    for (subject, series) in subjects.iter().zip(&series) {
        for (what, points) in [("period", &series.periods), ("length", &series.lengths)] {
            let mut table = Table::new(format!("{}-{what}s", subject.name), ["t [t_c]", &format!("{what} [t_c]")]);
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
    let train: PulseTrain =
        pulse_train(&subject.motion, &pulsar.beam(), &viewer.basis().direction, span).map_err(message)?;
    // The formulas take beta for constant: they fail for tp-II, whose A is 0.36 omega.
    let steady = |solution: &&Perturbation<f64>| solution.constants.amplitude.abs() < MOST_SWING * solution.omega.abs();
    let twofold = subject.printed.as_ref().filter(|solution| solution.zeroth_rate != 0.0);
    let curves = twofold.filter(steady).map(|solution| curves(subject, solution)).transpose()?;
    Ok(Series { periods: train.periods().collect(), lengths: train.durations().collect(), curves })
}

/// Period and length by Eqs. (51) and (56), with the mean rates of the motion and with those of Eq. (57).
fn curves(subject: &Subject, solution: &Perturbation<f64>) -> Result<Table, String> {
    let message = |error: twofold::Error| error.to_string();
    let (viewer, pulsar) = subject.line_of_sight()?;
    let (end, beta_0) = (subject.shown.pulses, solution.constants.beta_0);
    let angles = subject.angles(&[0.0, end])?;
    let [(_, first), (_, last)] = angles[..] else { return Err("the axis is on a pole".into()) };
    let mean = ShiftedRates { alpha: (last.alpha - first.alpha) / end, gamma: (last.gamma - first.gamma) / end };
    let shifted = ShiftedRates { alpha: solution.rate, gamma: subject.start.spin() - solution.rate * beta_0.cos() };
    let columns =
        ["mean rates", "Eq. (57)"].iter().flat_map(|r| ["period", "length"].map(|q| format!("{q} by {r} [t_c]")));
    let mut table =
        Table::new(format!("{}-curves", subject.name), std::iter::once("t [t_c]".to_owned()).chain(columns));
    for t in times(end, 1000) {
        let mut row = vec![t];
        for rates in [mean, shifted] {
            let gamma = first.gamma + rates.gamma * t;
            let offset = azimuth_offset_rate(beta_0, gamma, rates.gamma, pulsar.chi, pulsar.delta).map_err(message)?;
            let theta = cosine_of_colatitude(beta_0, gamma, pulsar.chi, pulsar.delta).acos();
            let length = match pulse_width(pulsar.rho, theta, viewer.theta_o) {
                PulseWidth::Pulsed(width) => width / (rates.alpha + offset),
                PulseWidth::AlwaysOn | PulseWidth::NeverOn => 0.0,
            };
            row.extend([approximate_period(rates.alpha, offset), length]);
        }
        table.push(row);
    }
    Ok(table)
}

fn draw(name: &str, subjects: &[&Subject], series: &[Series]) -> String {
    let (left, top, panel_height, gap, between) = (36.0, 18.0, 92.0, 8.0, 40.0);
    let count = subjects.len() as f64;
    let width = (PAGE - left - 8.0 - (count - 1.0) * between) / count;
    let with_legend = series.iter().any(|series| series.curves.is_some());
    let legend_height = if with_legend { 14.0 } else { 0.0 };
    let mut page = Page::new(name, PAGE, top + 2.0 * panel_height + gap + BELOW + legend_height);
    for (i, (subject, series)) in subjects.iter().zip(series).enumerate() {
        let shown = subject.shown.pulses;
        let x = Axis::linear("*t* / *t*_{c}", shown.min(0.0), shown.max(0.0));
        for (row, (points, label)) in
            [(&series.periods, "period / *t*_{c}"), (&series.lengths, "pulse length / *t*_{c}")].into_iter().enumerate()
        {
            let frame = Rectangle {
                left: left + (width + between) * i as f64,
                top: top + (panel_height + gap) * row as f64,
                width,
                height: panel_height,
            };
            let curve = |rates: usize| series.curves.as_ref().map(|table| table.points(0, 1 + row + 2 * rates));
            let on_curves = (0..2).filter_map(curve).flatten().map(|(_, y)| y);
            let values: Vec<_> = points.iter().map(|point| point.value).chain(on_curves).collect();
            let y = if values.is_empty() { Axis::linear(label, 0.0, 1.0) } else { Axis::around(label, values) };
            let mut panel = Panel::new(frame, if row == 0 { x.bare() } else { x.clone() }, y);
            panel.y_label_distance = 26.0;
            for (rates, line) in [(1, SHIFTED_RATES), (0, MEAN_RATES)] {
                if let Some(points) = curve(rates) {
                    panel.curve(&mut page, &points, line);
                }
            }
            let points: Vec<_> = points.iter().map(|point| (point.time, point.value)).collect();
            if series.curves.is_none() {
                panel.curve(&mut page, &points, solid(GREY, 0.5));
            }
            panel.marks(&mut page, &points, Mark::Disc, 1.4, BLACK);
            if points.is_empty() {
                let middle = [frame.left + frame.width / 2.0, frame.top + frame.height / 2.0];
                page.text(middle, Anchor::Middle, SMALL, GREY, "no whole pulse");
            }
            panel.draw_frame(&mut page);
            if row == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
        }
    }
    if with_legend {
        let y = top + 2.0 * panel_height + gap + BELOW + 8.0;
        let entries = [
            (Sample::Mark(Mark::Disc, BLACK), "pulses"),
            (Sample::Line(MEAN_RATES), "Eqs. (51), (56), mean rates"),
            (Sample::Line(SHIFTED_RATES), "Eqs. (51), (56), rates by (57)"),
        ];
        for (entry, x) in entries.into_iter().zip([left, left + 66.0, left + 216.0]) {
            legend(&mut page, [x, y], &[entry]);
        }
    }
    page.finish("Pulse periods and lengths in time")
}

fn caption(subjects: &[&Subject], series: &[Series]) -> Caption {
    let range = |points: &[Stamped]| {
        let values = points.iter().map(|point| point.value);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        format!("from {low:.2} to {high:.2} *t*_{{c}}")
    };
    let ranges = subjects.iter().zip(series).map(|(subject, series)| {
        let (name, whole) = (&subject.name, series.lengths.len());
        if whole < 2 {
            return format!("{name}: {whole} whole pulses.");
        }
        let (periods, lengths) = (range(&series.periods), range(&series.lengths));
        format!("{name}: {whole} whole pulses, periods {periods}, lengths {lengths}.")
    });
    let mut says: Vec<_> = ranges.collect();
    if series.iter().any(|series| series.curves.is_some()) {
        says.push(
            "The formulas follow the mean rates of the motion; with the rates of Eq. (57), which are of first order, they drift out of step."
                .to_owned(),
        );
    }
    if subjects.len() > 1 {
        says.push(
            "Both are modulated with the period of *γ*, about 40 *t*_{c}; tp-II has a second modulation of about 180 *t*_{c}, that of \
             its angular momentum about *Z*. In tp-I the rates of Eq. (57) are off by a radian of *γ* in 400 *t*_{c}."
                .to_owned(),
        );
    }
    Caption {
        shows: "Periods (top) and lengths in time (bottom) of the pulses: the period is the time between the midpoints of two \
                consecutive pulses, at the mean of both midpoints, the length is at its midpoint. Thin grey lines join points."
            .to_owned(),
        parameters: parameters(&line_of_sight(subjects, true), subjects),
        method: "Edges of the pulses: roots of **m** · **n** = cos *ρ*, Eq. (44), along the numerical motion, with bounds that let none be \
                 missed. Curves: Eqs. (51), (52) and (56), the width in azimuth divided by the rate of azimuth, at constant *β*_{0} \
                 and constant rates of *α* and *γ*."
            .to_owned(),
        says: says.join(" "),
    }
}
