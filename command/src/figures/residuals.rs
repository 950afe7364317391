//! The residuals and widths of a pulsar's pulses against the date.

use twofold_scene::pulsar_timing::{Causes, Timing};

use super::drawing::*;

/// Largest number of points of a curve that a page can resolve.
const MOST_POINTS: usize = 5_000;

/// Units of time for small numbers.
const UNITS: [(f64, &str); 5] = [(1.0, "s"), (1e3, "ms"), (1e6, "μs"), (1e9, "ns"), (1e12, "ps")];

/// The unit in which the largest of some times (s) is at least one, and its factor.
fn unit(times: &[f64]) -> (f64, &'static str) {
    let largest = times.iter().fold(0.0, |most: f64, time| most.max(time.abs()));
    *UNITS.iter().find(|(factor, _)| factor * largest >= 1.0).unwrap_or(&UNITS[4])
}

/// The picture of a pulsar called `name`, an SVG document: residuals, with their causes if they are given, and widths.
pub(crate) fn residuals(name: &str, timing: &Timing, causes: Option<&Causes>) -> String {
    let dates: Vec<_> =
        timing.pulses.iter().map(|timed| timed.arrival.day() as f64 + timed.arrival.fraction()).collect();
    let step = dates.len().div_ceil(MOST_POINTS);
    let widths: Vec<_> = timing.pulses.iter().map(|timed| timed.pulse.duration).collect();
    let mut curves = vec![(timing.fit.residuals.as_slice(), solid(BLACK, 0.8), "total", BLACK)];
    if let Some(Causes { torque, geometry, violation, .. }) = causes {
        curves.extend([
            (torque.as_slice(), solid("#f2b48c", 3.0), "torque", VERMILION),
            (geometry.as_slice(), dashed(BLUE, 1.1), "geometry", BLUE),
            (violation.as_slice(), dash_dotted(GREEN, 1.1), "violation", GREEN),
        ]);
        // The sum is drawn above its parts.
        curves.rotate_left(1);
    }
    let names = if causes.is_some() { 56.0 } else { 14.0 };
    let left = LEFT + 12.0;
    let grid = Grid { left, top: 18.0, width: PAGE - left - names, height: 120.0, between: [0.0, 20.0] };
    let mut page = Page::new("residuals", PAGE, grid.bottom(2) + BELOW);
    let ends = dates.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)]);
    let x = Axis::linear("date [MJD]", ends[0], ends[1].max(ends[0] + 1.0)).in_full();
    let derivatives: String = (1..=timing.derivatives).map(|k| format!(", *F*{k}")).collect();
    let all: Vec<_> = curves.iter().flat_map(|(times, ..)| times.iter().copied()).collect();
    let (of_residuals, of_widths) = (unit(&all), unit(&widths));
    let panels = [
        (curves, of_residuals, "residual", format!("after the fit of *F*0{derivatives}")),
        (vec![(widths.as_slice(), solid(BLACK, 1.1), "", BLACK)], of_widths, "width", "duration of the pulse".into()),
    ];
    for (row, (curves, (factor, unit), what, title)) in panels.into_iter().enumerate() {
        let values = curves.iter().flat_map(|(times, ..)| times.iter().map(|time| factor * time));
        let y = Axis::around(&format!("{what} [{unit}]"), values);
        let panel = Panel::new(grid.frame(0, row), if row == 0 { x.bare() } else { x.clone() }, y);
        if row == 0 {
            panel.level(&mut page, 0.0, solid(LIGHT, 0.5));
        }
        let mut ends = Vec::new();
        for (times, line, name, colour) in curves {
            let points: Vec<_> = dates.iter().zip(times).step_by(step).map(|(x, y)| (*x, factor * y)).collect();
            if colour == BLACK && row == 0 {
                // The epochs may undersample the signal, so that no line joins them.
                panel.marks(&mut page, &points, Mark::Disc, 0.9, BLACK);
            } else {
                panel.curve(&mut page, &points, line);
            }
            ends.extend(points.last().map(|(x, y)| (panel.at(*x, *y), name.to_owned(), colour)));
        }
        panel.draw_frame(&mut page);
        if row == 0 && causes.is_some() {
            name_ends(&mut page, panel.frame, ends);
        }
        panel.letter(&mut page, row, 2, &title);
    }
    page.finish(&format!("Residuals and pulse widths of {name}"))
}

#[cfg(test)]
mod tests {
    use twofold_scene::pulsar_timing::PulsarScene;
    use twofold_scene::scene_file::Scene;

    use super::*;
    use crate::figures::curve_tests::{HALF_A_PIXEL, assert_same};
    use crate::figures::drawn::{Frame, Point, elements, frames, holds};

    #[test]
    fn units_have_numbers_above_one() {
        assert_eq!([1.5, -1.5e-3, 3e-6, 1e-12, 1e-20].map(|time| unit(&[0.0, time]).1), ["s", "ms", "μs", "ps", "ps"]);
    }

    /// Forty pulses in nine years.
    fn timed() -> (Timing, Causes) {
        let scene = Scene::named("b1828-11").expect("a scene");
        let pulsar = PulsarScene::new(&scene).expect("a pulsar");
        let epochs: Vec<_> = (0..40).map(|k| pulsar.epoch.after([7e6 * f64::from(k), 0.0]).expect("a date")).collect();
        let timing = pulsar.timed(&epochs, 2).expect("pulses");
        let causes = pulsar.causes(&timing).expect("causes");
        (timing, causes)
    }

    fn date(timing: &Timing, k: usize) -> f64 {
        timing.pulses[k].arrival.day() as f64 + timing.pulses[k].arrival.fraction()
    }

    /// The heights of the dots are a linear function of the residuals, and their abscissas of the dates.
    #[test]
    fn a_dot_for_each_residual() {
        let (timing, causes) = timed();
        for causes in [None, Some(&causes)] {
            let picture = residuals("b1828-11", &timing, causes);
            let number = |text: &str, key: &str| -> f64 {
                let rest = text.split_once(&format!("{key}=\"")).expect("an attribute").1;
                rest.split('"').next().and_then(|number| number.parse().ok()).expect("a number")
            };
            let dots: Vec<_> =
                picture.split("<circle").skip(1).map(|dot| (number(dot, "cx"), number(dot, "cy"))).collect();
            assert_eq!(dots.len(), timing.pulses.len());
            let late = &timing.fit.residuals;
            let (first, last) = (dots[0], dots[39]);
            for (k, (x, y)) in dots.iter().enumerate() {
                let date = |k: usize| date(&timing, k);
                let along = first.0 + (date(k) - date(0)) / (date(39) - date(0)) * (last.0 - first.0);
                let height = first.1 + (late[k] - late[0]) / (late[39] - late[0]) * (last.1 - first.1);
                // Places are rounded to a hundredth; the scale comes from differences of such places over part of the panel.
                assert!((x - along).abs() < 0.03 && (y - height).abs() < 1.0, "{k}: {x} {along}, {y} {height}");
            }
            assert_eq!(picture.contains(">geometry<"), causes.is_some());
        }
    }

    /// Read off by its axes, the picture has the residuals as dots, their causes as curves in the order of drawing, and below them the complete
    /// widths from the first date to the last.
    #[test]
    fn curves_are_the_causes_and_the_widths() {
        let (timing, causes) = timed();
        let elements = elements(&residuals("b1828-11", &timing, Some(&causes)));
        let found = frames(&elements);
        let [above, below] = &found[..] else { panic!("two frames") };
        assert_eq!([above.y.label.as_str(), below.y.label.as_str()], ["residual [ms]", "width [ms]"]);
        assert_eq!(above.x.label, "date [MJD]");
        assert_eq!(above.heading, "after the fit of F0, F1, F2");
        let place = |frame: &Frame, times: &[f64]| -> Vec<Point> {
            times
                .iter()
                .enumerate()
                .map(|(k, time)| [frame.x.place(date(&timing, k)), frame.y.place(1e3 * time)])
                .collect()
        };
        for frame in [above, below] {
            let ends = [0, 39].map(|k| frame.x.place(date(&timing, k)));
            assert!(
                (ends[0] - frame.corners[0]).abs() < HALF_A_PIXEL && (ends[1] - frame.corners[2]).abs() < HALF_A_PIXEL
            );
        }
        let widths: Vec<_> = timing.pulses.iter().map(|timed| timed.pulse.duration).collect();
        let of_causes = [&causes.torque, &causes.geometry, &causes.violation].map(|cause| (above, place(above, cause)));
        let expected: Vec<_> = of_causes.into_iter().chain([(below, place(below, &widths))]).collect();
        let drawn: Vec<_> = found.iter().flat_map(|frame| &frame.curves).collect();
        assert_eq!(drawn.len(), expected.len());
        for ((_, pieces), (frame, places)) in drawn.into_iter().zip(expected) {
            assert!(places.iter().all(|at| holds(&frame.corners, *at, HALF_A_PIXEL)));
            assert_same("a curve", &places, pieces, &frame.corners);
        }
        let [(_, dots)] = &above.marks[..] else { panic!("dots of one colour") };
        for (dot, at) in dots.iter().zip(place(above, &timing.fit.residuals)) {
            assert!(
                (dot[0] - at[0]).hypot(dot[1] - at[1]) < HALF_A_PIXEL && holds(&above.corners, at, HALF_A_PIXEL),
                "{dot:?} {at:?}"
            );
        }
        let [zero] = above.levels[..] else { panic!("{:?}", above.levels) };
        assert!((above.y.place(zero) - above.y.place(0.0)).abs() < HALF_A_PIXEL && below.levels.is_empty(), "{zero}");
    }

    #[test]
    fn the_axis_of_one_date_is_a_day_long_and_others_end_at_the_last() {
        let (all, _) = timed();
        for (count, days) in [(1, 1.0), (2, date(&all, 1) - date(&all, 0))] {
            let mut timing = all.clone();
            timing.pulses.truncate(count);
            timing.fit.residuals.truncate(count);
            for frame in frames(&elements(&residuals("b1828-11", &timing, None))) {
                let [from, to] = [0, 2].map(|k| frame.x.value(frame.corners[k]));
                // Places are written to a hundredth of a point, in frames of some 400.
                assert!(
                    (from - date(&all, 0)).abs() < 1e-3 * days && ((to - from) / days - 1.0).abs() < 1e-3,
                    "{from} {to}"
                );
            }
        }
    }
}
