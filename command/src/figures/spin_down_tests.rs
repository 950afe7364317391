//! The figures of the star that slows down: curves agree with their tables, tables with the output of `timing`, and both with closed forms.

use std::f64::consts::{PI, TAU};

use super::Table;
use super::curve_tests::assert_same;
use super::drawn::{Frame, elements, frames, paths};
use super::fixtures::figure;
use super::spin_down::{self, Timed, sizes};
use super::violation_residuals::{self, LIMIT, SIZES};
use twofold_scene::pulsar_timing::{PulsarScene, csv};
use twofold_scene::scene_file::Scene;

pub(super) fn column(table: &Table, k: usize) -> Vec<f64> {
    table.rows.iter().map(|row| row[k]).collect()
}

fn near(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found:e}, expected {expected:e}");
}

/// The curves of a frame are columns times factors, in the order of drawing; magnitudes for a logarithmic axis.
fn assert_curves(what: &str, frame: &Frame, table: &Table, columns: &[(usize, f64)], sized: bool) {
    let pieces: Vec<_> = frame.curves.iter().flat_map(|(_, pieces)| pieces).collect();
    assert_eq!(pieces.len(), columns.len(), "{what}");
    for (piece, (k, factor)) in pieces.into_iter().zip(columns) {
        let value = |x: f64| if sized { (factor * x).abs().max(1e-15) } else { factor * x };
        let rows: Vec<_> =
            table.rows.iter().map(|row| [frame.x.place(row[0]), frame.y.place(value(row[*k]))]).collect();
        assert_same(&format!("{what}: {}", table.columns[*k]), &rows, std::slice::from_ref(piece), &frame.corners);
    }
}

#[test]
fn curves_are_the_columns() {
    let spin_down = figure("spin-down");
    let elements_of = elements(&spin_down.svg);
    let found = frames(&elements_of);
    let labels: Vec<_> = found.iter().map(|frame| (frame.x.label.as_str(), frame.y.label.as_str())).collect();
    let date = "date [MJD]";
    assert_eq!(labels, [(date, "residual [ms]"), (date, "dν/dt [Hz/s]"), (date, "beam width [ms]")]);
    let table = &spin_down.tables[0];
    assert_curves("residuals", &found[0], table, &[(2, 1.0), (3, spin_down::ENLARGED), (1, 1.0)], false);
    // The label contains the power of ten.
    assert_curves("rate", &found[1], table, &[(4, 1e-15)], false);
    assert_curves("width", &found[2], table, &[(5, 1.0)], false);
    // Bars are as long as the periods, and begin and end at peaks of the rate.
    let is_bar = |path: &&super::drawn::Path| path.points.len() == 2 && path.style.1 == "1.6";
    let bars: Vec<_> = paths(&elements_of).filter(is_bar).collect();
    assert_eq!(bars.len(), 2);
    for (bar, row) in bars.iter().zip(&spin_down.tables[1].rows[1..]) {
        let ends = [bar.points[0], bar.points[1]].map(|at| found[1].x.value(at[0]));
        assert!((ends[1] - ends[0] - row[0]).abs() < 0.2, "{ends:?}: {} d", row[0]);
        for end in ends {
            let here: Vec<_> = table.rows.iter().filter(|row| (row[0] - end).abs() < 60.0).collect();
            let peak = here.iter().max_by(|a, b| a[4].total_cmp(&b[4])).unwrap();
            assert!((peak[0] - end).abs() < 8.0, "a bar ends at {end}, the peak is at {}", peak[0]);
        }
    }

    let violation = figure("violation-residuals");
    let found = frames(&elements(&violation.svg));
    let labels: Vec<_> = found.iter().map(|frame| (frame.x.label.as_str(), frame.y.label.as_str())).collect();
    assert_eq!(labels, [(date, "size of the residual [s]"), (date, "residual [ps]")]);
    let table = &violation.tables[0];
    assert_curves("sizes", &found[0], table, &[1, 2, 3, 4, 5].map(|k| (k, 1.0)), true);
    assert_curves("limit", &found[1], table, &[(3, 1e12), (6, 1e12 * violation_residuals::ENLARGED)], false);
}

/// For the same scene, read from its file.
#[test]
fn tables_are_those_of_timing() {
    let scene = Scene::named(spin_down::SCENE).unwrap();
    let pulsar = PulsarScene::new(&scene).unwrap();
    let epochs: Vec<_> = scene.times.iter().map(|t| pulsar.epoch.after([t, 0.0]).unwrap()).collect();
    let timing = pulsar.timed(&epochs, 2).unwrap();
    let text = csv(&pulsar, &timing, Some(&pulsar.causes(&timing).unwrap()));
    let mut lines = text.lines();
    let heads: Vec<_> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    let of = |head: &str| {
        let k = heads.iter().position(|found| *found == head).unwrap_or_else(|| panic!("{head} in {heads:?}"));
        rows.iter().map(|row| row[k]).collect::<Vec<_>>()
    };
    let same = |found: &[f64], head: &str, unit: f64| {
        let known = of(head);
        let [_, size] = sizes(&known);
        assert_eq!(found.len(), known.len());
        for (found, known) in found.iter().zip(&known) {
            assert!((found * unit - known).abs() <= 1e-14 * size, "{head}: {found:e} and {known:e}");
        }
    };
    let table = &figure("spin-down").tables[0];
    let heads = [
        (1, "residual [s]", 1e-3),
        (2, "torque [s]", 1e-3),
        (3, "geometry [s]", 1e-3),
        (4, "spin_down_rate [Hz/s]", 1e-15),
        (5, "duration [s]", 1e-3),
    ];
    for (k, head, unit) in heads {
        same(&column(table, k), head, unit);
    }
    same(&column(&figure("violation-residuals").tables[0], 6), "violation [s]", 1.0);
    let (day, fraction) = (of("arrival_day [MJD]"), of("arrival_fraction [d]"));
    for (i, date) in column(table, 0).into_iter().enumerate() {
        assert!((date - day[i] - fraction[i]).abs() < 1e-10);
    }
}

/// A dipole in vacuum brakes as `sin^2` of the angle of the magnetic axis to `L`, `1 - (cos theta cos chi + sin theta sin chi cos psi)^2`: the lines
/// of its rate are `F1` times the harmonics of that over its mean, those of the residuals are these over `F0 (2 pi / P)^2`, `P` the period of each.
/// Geometry contributes 0.05 ms.
#[test]
fn lines_are_those_of_the_torque_of_a_dipole() {
    let [curves, lines] = &figure("spin-down").tables[..] else { panic!("two tables") };
    let (theta, chi, day) = (3.0_f64.to_radians(), 89.0_f64.to_radians(), 86_400.0);
    let (f0, f1) = (2.468_871_714_7, -3.6568e-13);
    let sine = |psi: f64| 1.0 - (theta.cos() * chi.cos() + theta.sin() * chi.sin() * psi.cos()).powi(2);
    let harmonic =
        |k: f64| (0..64).map(|i| TAU * f64::from(i) / 64.0).map(|psi| sine(psi) * (k * psi).cos()).sum::<f64>() / 32.0;
    let mean = 0.5 * harmonic(0.0);
    for (row, k) in lines.rows[1..].iter().zip([1.0, 2.0]) {
        near(row[0], 500.0 / k, 1e-7);
        let rate = (f1 * harmonic(k) / mean).abs();
        near(1e-15 * row[2], rate, 1e-3);
        let late = rate / f0 / (TAU * k / (500.0 * day)).powi(2);
        let [_, geometry] = sizes(&column(curves, 3));
        assert!((row[1] - 1e3 * late).abs() < geometry, "{} ms, expected {} ms", row[1], 1e3 * late);
    }
    near(lines.rows[1][1], 12.8, 0.005);
    near(lines.rows[2][1], 2.4, 0.005);
    // No curve has a line at 1000 d.
    for k in 1..4 {
        assert!(lines.rows[0][k] < 1e-3 * lines.rows[1][k], "{:?}", lines.rows[0]);
    }
    let [rms, largest] = sizes(&column(curves, 1));
    near(rms, 9.125, 1e-3);
    near(largest, 16.93, 1e-3);
}

/// The pulse lasts while the axis of the beam is within `rho` of the line of sight: `cos rho = cos theta_m cos i + sin theta_m sin i cos phi`, with
/// `phi` the rotation in half of that time.
#[test]
fn the_beam_width_is_that_of_a_cone() {
    let curves = &figure("spin-down").tables[0];
    let [theta, chi, i, rho] = [3.0_f64, 89.0, 88.0, 6.0].map(f64::to_radians);
    let width = |psi: f64| {
        let cos = theta.cos() * chi.cos() + theta.sin() * chi.sin() * psi.cos();
        let sin = (1.0 - cos * cos).sqrt();
        1e3 / (PI * 2.468_871_714_7) * ((rho.cos() - cos * i.cos()) / (sin * i.sin())).acos()
    };
    let psi = |k: usize| TAU * k as f64 / 1000.0;
    let all: Vec<_> = (0..1000).map(|k| width(psi(k))).collect();
    let of = |values: &[f64]| values.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(*x), h.max(*x)));
    let ((narrow, wide), (least, most)) = (of(&all), of(&column(curves, 5)));
    // The frequency of the star falls by 5e-5.
    near(least, narrow, 2e-4);
    near(most, wide, 2e-4);
}

/// The contribution of violation is the residuals with it minus those without, each fitted; it is proportional to `s`.
#[test]
fn violation_adds_the_difference_of_residuals() {
    let table = &figure("violation-residuals").tables[0];
    let [free, violated] = [0.0, SIZES[2].0].map(|factor| Timed::new(factor).unwrap().timing.fit.residuals);
    let added = column(table, 5);
    let [_, size] = sizes(&added);
    let off = (0..added.len()).map(|k| (violated[k] - free[k] - added[k]).abs()).fold(0.0, f64::max);
    // Arrival times are rounded to 9 ps each.
    assert!(off < 1e-11, "{off:e} of {size:e}");
    for (k, (factor, ..)) in (3..5).zip(SIZES) {
        for (less, more) in column(table, k).into_iter().zip(&added) {
            // The largest violation changes the phase of the precession by 2.4e-5 rad at the end, visible to second order, and turns L by 0.03 rad,
            // visible to third order.
            assert!((less * SIZES[2].0 / factor - more).abs() < 1e-4 * size, "{less:e} {more:e}");
        }
    }
    let [rms, largest] = sizes(&column(table, 3));
    near(rms, 13.6e-12, 0.02);
    near(largest, 36.8e-12, 0.02);
    let [torque, _] = sizes(&column(table, 1));
    assert!(torque > 1e8 * rms, "{torque:e} {rms:e}");
    let file = twofold_scene::scene_file::built_in(spin_down::SCENE).expect("a scene");
    assert!(file.toml.contains(&format!("alpha_2 = {LIMIT:e} ")));
}
