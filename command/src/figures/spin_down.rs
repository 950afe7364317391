//! PSR B1828-11 over ten years: residuals, rate of the frequency, beam width.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use twofold::dynamics::Problem;
use twofold::epoch::DAY;
use twofold_scene::pulsar_timing::{Causes, PulsarScene, Timing};
use twofold_scene::scene_file::Scene;

use super::drawing::*;

const NAME: &str = "spin-down";

pub(super) const SCENE: &str = "b1828-11";

/// Derivatives of the frequency that are fitted, F1 and F2.
pub(super) const FITTED: usize = 2;

/// Enlargement of the part of geometry.
pub(super) const ENLARGED: f64 = 50.0;

/// Periods of lines, in precession periods; a biaxial star lacks the first.
const LINES: [f64; 3] = [2.0, 1.0, 0.5];

const TOTAL: Line = solid(BLACK, 0.8);
const TORQUE: Line = solid("#f2b48c", 3.0);
const GEOMETRY: Line = dashed(BLUE, 1.1);

/// The pulsar of the scene with its `s` times a factor, timed at the epochs of the scene.
pub(super) struct Timed {
    pub(super) scene: Scene,
    pub(super) pulsar: PulsarScene,
    pub(super) timing: Timing,
    pub(super) causes: Causes,
}

impl Timed {
    pub(super) fn new(factor: f64) -> Result<Self, String> {
        let mut scene = Scene::named(SCENE).map_err(|error| error.to_string())?;
        let problem = &scene.problem;
        scene.problem = Problem::new(*problem.spheroid(), problem.coefficients() * factor, *problem.initial())?
            .with_bulge(problem.bulge())?;
        let pulsar = PulsarScene::new(&scene)?;
        // The times of the scene begin at zero.
        let epochs = scene.times.iter().map(|t| pulsar.epoch.after([t, 0.0])).collect::<Result<Vec<_>, _>>()?;
        let timing = pulsar.timed(&epochs, FITTED).map_err(|error| error.to_string())?;
        let causes = pulsar.causes(&timing)?;
        Ok(Self { scene, pulsar, timing, causes })
    }

    /// Dates of the pulses (MJD).
    pub(super) fn dates(&self) -> impl Iterator<Item = f64> {
        self.timing.pulses.iter().map(|timed| timed.arrival.day() as f64 + timed.arrival.fraction())
    }

    /// Period of the free precession (d).
    pub(super) fn precession(&self) -> f64 {
        TAU / self.pulsar.clock.stretched_time().precession().rate / DAY
    }
}

pub(super) fn sheet() -> Result<Sheet, String> {
    let timed = Timed::new(1.0)?;
    let columns = [
        "date [MJD]",
        "residual [ms]",
        "residual by torque [ms]",
        "residual by geometry [ms]",
        "rate of the frequency [1e-15 Hz/s]",
        "beam width [ms]",
    ];
    let mut curves = Table::new("curves", columns);
    let Causes { geometry, torque, spin_down_rate, .. } = &timed.causes;
    for (i, date) in timed.dates().enumerate() {
        let (late, width) = (timed.timing.fit.residuals[i], timed.timing.pulses[i].pulse.duration);
        curves.push([date, 1e3 * late, 1e3 * torque[i], 1e3 * geometry[i], 1e15 * spin_down_rate[i], 1e3 * width]);
    }
    let lines = lines(&curves, timed.precession())?;
    Ok(Sheet {
        svg: draw(&curves, timed.precession()),
        caption: caption(&timed, &curves, &lines),
        tables: vec![curves, lines],
    })
}

/// Amplitudes of lines of the curves, fitted together with the terms of the fit of F0, F1, F2, so that they are those before that fit.
fn lines(curves: &Table, precession: f64) -> Result<Table, String> {
    let columns = ["period [d]", "residual [ms]", "rate of the frequency [1e-15 Hz/s]", "beam width [ms]"];
    let mut table = Table::new("lines", columns);
    let (first, last) = (curves.rows[0][0], curves.rows[curves.rows.len() - 1][0]);
    let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
    let model = DMatrix::from_fn(curves.rows.len(), 4 + 2 * LINES.len(), |i, k| {
        let since = curves.rows[i][0] - middle;
        match k.checked_sub(4) {
            None => (since / half).powi(k as i32),
            Some(k) => {
                let phase = TAU * since / (LINES[k / 2] * precession);
                if k % 2 == 0 { phase.cos() } else { phase.sin() }
            }
        }
    });
    let normal = (model.transpose() * &model).cholesky().ok_or("lines that cannot be told apart")?;
    let fitted = [1, 4, 5].map(|column| {
        let values = DVector::from_iterator(curves.rows.len(), curves.rows.iter().map(|row| row[column]));
        normal.solve(&(model.transpose() * values))
    });
    for (k, period) in LINES.iter().enumerate() {
        let amplitudes = fitted.iter().map(|found| found[4 + 2 * k].hypot(found[5 + 2 * k]));
        table.push([period * precession].into_iter().chain(amplitudes).collect::<Vec<_>>());
    }
    Ok(table)
}

/// The axis of dates that all panels share.
pub(super) fn dates(table: &Table) -> Axis {
    Axis::linear("date [MJD]", table.rows[0][0], table.rows[table.rows.len() - 1][0]).in_full()
}

fn draw(curves: &Table, precession: f64) -> String {
    let (left, names) = (LEFT + 12.0, 66.0);
    let grid = Grid { left, top: 18.0, width: PAGE - left - names, height: 96.0, between: [0.0, 20.0] };
    let mut page = Page::new(NAME, PAGE, grid.bottom(3) + BELOW);
    let x = dates(curves);
    let values = |column: usize| curves.rows.iter().map(move |row| row[column]);
    let rates = Axis::around("d*ν*/d*t* [10^{−15} Hz/s]", values(4).chain([most(curves, 4)[1] + ABOVE]));
    let axes =
        [Axis::around("residual [ms]", values(1).chain(values(2))), rates, Axis::around("beam width [ms]", values(5))];
    let what = ["after the fit of *F*0, *F*1, *F*2", "rate of the frequency", "duration of the pulse"];
    for (row, (y, what)) in axes.into_iter().zip(what).enumerate() {
        let panel = Panel::new(grid.frame(0, row), if row < 2 { x.bare() } else { x.clone() }, y);
        match row {
            0 => {
                let enlarged: Vec<_> = curves.rows.iter().map(|row| (row[0], ENLARGED * row[3])).collect();
                let drawn = [
                    (curves.points(0, 2), TORQUE, "torque".to_owned(), VERMILION),
                    (enlarged, GEOMETRY, format!("geometry × {ENLARGED}"), BLUE),
                    (curves.points(0, 1), TOTAL, "total".to_owned(), BLACK),
                ];
                panel.level(&mut page, 0.0, solid(LIGHT, 0.5));
                let mut ends = Vec::new();
                for (points, line, name, colour) in drawn {
                    panel.curve(&mut page, &points, line);
                    let &(at, last) = points.last().expect("pulses");
                    ends.push((panel.at(at, last), name, colour));
                }
                panel.draw_frame(&mut page);
                name_ends(&mut page, panel.frame, ends);
            }
            1 => {
                panel.curve(&mut page, &curves.points(0, 4), solid(BLACK, 1.1));
                bars(&mut page, &panel, curves, precession);
                panel.draw_frame(&mut page);
            }
            _ => {
                panel.curve(&mut page, &curves.points(0, 5), solid(BLACK, 1.1));
                panel.draw_frame(&mut page);
            }
        }
        panel.letter(&mut page, row, 3, what);
    }
    page.finish("Residuals, rate of the frequency and beam width of PSR B1828-11")
}

/// Room for bars above the curve of the rate (1e-15 Hz/s).
const ABOVE: f64 = 0.45;

/// The largest number in a column: its date and its value.
fn most(curves: &Table, column: usize) -> [f64; 2] {
    let row = curves.rows.iter().max_by(|a, b| a[column].total_cmp(&b[column])).expect("pulses");
    [row[0], row[column]]
}

/// Bars as long as the precession period and half of it, each from a peak of the rate to the next such peak.
fn bars(page: &mut Page, panel: &Panel, curves: &Table, precession: f64) {
    let [peak, top] = most(curves, 4);
    let first = peak - ((peak - curves.rows[0][0]) / precession).floor() * precession;
    for (place, turns, length) in [(1.0, 1.0, precession), (3.0, 0.5, 0.5 * precession)] {
        let from = first + place * precession;
        let [[left, y], [right, _]] = [from, from + turns * precession].map(|date| panel.at(date, top + 0.3 * ABOVE));
        page.path(&[[left, y], [right, y]], solid(GREEN, 1.6));
        for end in [left, right] {
            page.path(&[[end, y - 3.0], [end, y + 3.0]], solid(GREEN, 1.0));
        }
        let name = format!("{} d", significant(length, 3));
        page.text([0.5 * (left + right), y - 4.0], Anchor::Middle, SMALL, GREEN, &name);
    }
}

/// Root mean square of numbers, and the largest.
pub(super) fn sizes(values: &[f64]) -> [f64; 2] {
    let squares: f64 = values.iter().map(|x| x * x).sum();
    [(squares / values.len() as f64).sqrt(), values.iter().fold(0.0, |most, x| most.max(x.abs()))]
}

/// Angles of the scene in degrees: wobble, magnetic axis, observer, half opening of the beam.
pub(super) fn angles(timed: &Timed) -> [(&'static str, String); 4] {
    let state = timed.pulsar.problem.initial();
    let wobble = state.axis.angle(&state.momentum);
    let (viewer, pulsar) = (timed.scene.observer.expect("an observer"), timed.scene.pulsar.expect("a beam"));
    let degrees = |angle: f64| significant(angle.to_degrees(), 3);
    [
        ("wobble", degrees(wobble)),
        ("chi", degrees(pulsar.chi)),
        ("theta_o", degrees(viewer.theta_o)),
        ("rho", degrees(pulsar.rho)),
    ]
}

fn caption(timed: &Timed, curves: &Table, lines: &Table) -> Caption {
    let column = |k: usize| curves.rows.iter().map(|row| row[k]).collect::<Vec<_>>();
    let [rms, largest] = sizes(&column(1));
    let [rms_geometry, largest_geometry] = sizes(&column(3));
    let [rates, widths] = [4, 5].map(|k| Spread::of(column(k)).expect("pulses"));
    let [absent, once, twice] = [0, 1, 2].map(|k| &lines.rows[k]);
    let part = 100.0 * (rates.high - rates.low) / rates.low.abs();
    let f1 = timed.scene.spin_down.as_ref().expect("a torque").f1;
    let numbers = [
        ("once_period", once[0], 3),
        ("twice_period", twice[0], 3),
        ("absent_period", absent[0], 3),
        ("enlarged", ENLARGED, 3),
        ("residual_rms", rms, 2),
        ("residual_largest", largest, 2),
        ("geometry_rms", rms_geometry, 2),
        ("geometry_largest", largest_geometry, 2),
        ("residual_once", once[1], 3),
        ("residual_twice", twice[1], 2),
        ("residual_absent", absent[1], 1),
        ("rate_once", once[2], 3),
        ("rate_twice", twice[2], 3),
        ("width_once", once[3], 2),
        ("width_twice", twice[3], 2),
        ("narrow", widths.low, 3),
        ("wide", widths.high, 3),
        ("part", part, 1),
        ("f1", f1, 5),
    ];
    let numbers = numbers.map(|(name, value, digits)| (name, significant(value, digits)));
    Caption::of(NAME, &[&numbers[..], &angles(timed)].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines of known amplitudes and phases plus a cubic polynomial, which the fit of the rotation absorbs.
    #[test]
    fn lines_have_the_amplitudes_that_they_were_made_with() {
        let precession = 100.0;
        let mut curves = Table::new("curves", ["date", "1", "2", "3", "4", "5"]);
        let tone = |t: f64, periods: f64, amplitude: f64, phase: f64| {
            amplitude * (TAU * t / (periods * precession) + phase).cos()
        };
        for date in (0..400).map(|k| 50_000.0 + 3.7 * f64::from(k)) {
            let t = date - 50_000.0;
            let cubic = 5.0 - 0.01 * t + 3e-6 * t * t - 2e-9 * t * t * t;
            let late = cubic + tone(t, 2.0, 0.3, 0.1) + tone(t, 1.0, 7.0, 1.3) + tone(t, 0.5, 2.0, -2.0);
            let rate = 40.0 + tone(t, 1.0, 11.0, 0.4) + tone(t, 0.5, 6.0, 2.2);
            let width = cubic + tone(t, 2.0, 0.7, 3.0);
            curves.push([date, late, 0.0, 0.0, rate, width]);
        }
        let found = lines(&curves, precession).unwrap().rows;
        let expected = [[200.0, 0.3, 0.0, 0.7], [100.0, 7.0, 11.0, 0.0], [50.0, 2.0, 6.0, 0.0]];
        for (found, expected) in found.iter().zip(expected) {
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-10, "{found:?}");
        }
        assert_eq!(found.len(), 3);
    }

    /// Root mean squares of 0.03, -0.0456 and of 3, -4.123; a rate that changes from -100 to -90.55.
    #[test]
    fn a_caption_tells_the_numbers_of_its_tables() {
        let (mut curves, mut lines) =
            (Table::new("", ["0", "1", "2", "3", "4", "5"]), Table::new("", ["0", "1", "2", "3"]));
        curves.push([1.0, 3.0, 7.0, 0.03, -100.0, 10.123]);
        curves.push([2.0, -4.123, 8.0, -0.0456, -90.55, 15.678]);
        lines.push([1234.0, 0.0123, 1.0, 1.0]);
        lines.push([512.34, 12.345, 45.678, 0.1234]);
        lines.push([256.78, 2.345, 23.456, 0.3456]);
        let told = caption(&Timed::new(1.0).unwrap(), &curves, &lines);
        assert!(
            told.shows.ends_with("Green bars: 512 d, the period of the free precession, and 257 d, half of it."),
            "{}",
            told.shows
        );
        assert!(told.shows.contains("the part due to geometry, times 50 (dashed"), "{}", told.shows);
        let parameters = "a period of 512 d and a wobble of 3 deg; magnetic axis at *χ* = 89 deg to the symmetry axis, beam of *ρ* = 6 deg, \
                          line of sight at *θ*_{o} = 88 deg to **L**. *F*1 = −3.6568 × 10^{−13} Hz/s";
        assert!(told.parameters.contains(parameters), "{}", told.parameters);
        for says in [
            "A wobble of 3 deg makes residuals of 3.6 ms (root mean square), 4.1 ms at most.",
            "geometry makes 0.039 ms, 0.046 ms at most. The rate of the frequency changes by 9 % of itself, the beam width from 10.1 to 15.7 ms.",
            "lines of 12.3 ms at 512 d and of 2.3 ms at 257 d; in the rate these are 45.7 and 23.5 × 10^{−15} Hz/s, in the width 0.12 and \
             0.35 ms.",
            "but none of 1230 d: a line fitted there has 0.01 ms.",
        ] {
            assert!(told.says.contains(says), "{says}, but {}", told.says);
        }
    }

    #[test]
    fn the_axis_of_dates_goes_from_the_first_to_the_last() {
        let mut table = Table::new("", ["date", "x"]);
        [[50.0, 1.0], [60.0, 2.0], [90.0, 3.0]].into_iter().for_each(|row| table.push(row));
        let frame = Rectangle { left: 0.0, top: 0.0, width: 1.0, height: 1.0 };
        let panel = Panel::new(frame, dates(&table), Axis::linear("x", 0.0, 1.0));
        assert_eq!([50.0, 60.0, 90.0].map(|date| panel.at(date, 0.0)[0]), [0.0, 0.25, 1.0]);
    }
}
