//! Spectral lines, their identification, mean rates and fundamental frequencies.

use nalgebra::Matrix3;
use twofold::dynamics::{BodyState, Problem};
use twofold::observables::fundamental_frequencies::{MeanRate, fundamental_frequencies, mean_rate, mean_rates_about};
use twofold::observables::spectrum::{
    FrequencyBasis, Generator, Identification, Series, Window, amplitude_spectrum, spectral_lines,
};

use crate::values::scene::{STAR, general, state, tensor};
use crate::values::table::{Table, Written};

fn series(waves: &[(f64, f64, f64)], constant: f64, count: usize) -> Series {
    let step = 0.4;
    let value = |k: usize| {
        let t = 1.0 + step * k as f64;
        constant
            + waves.iter().map(|(frequency, amplitude, phase)| amplitude * (frequency * t + phase).cos()).sum::<f64>()
    };
    Series { start: 1.0, step, values: (0..count).map(value).collect() }
}

#[test]
fn lines() {
    let mut table = Table::default();
    for (name, series) in [
        ("three", series(&[(1.3, 1.0, 0.3), (2.1, 0.02, -1.0), (0.41, 3e-4, 2.0)], 0.7, 2000)),
        ("close", series(&[(1.3, 1.0, 0.3), (1.3 + 25.0 / 800.0, 0.5, 1.0)], 0.0, 2000)),
        ("very close", series(&[(1.3, 1.0, 0.3), (1.3 + 6.0 / 800.0, 0.5, 1.0)], 0.0, 2000)),
        ("low and high", series(&[(0.03, 1.0, 0.3), (7.8, 0.5, 1.0)], -0.2, 2000)),
        ("constant", series(&[], 0.3, 64)),
        ("short", series(&[(1.3, 1.0, 0.3)], 0.3, 17)),
    ] {
        table.row(name, &[("duration", &series.duration()), ("highest frequency", &series.highest_frequency())]);
        for (least, most) in [(1e-6, 20), (1e-2, 2)] {
            let name = format!("{name} from {least:e}, {most}");
            table.found(&name, spectral_lines(&series, least, most), |table, found| {
                table.row(
                    &name,
                    &[("constant", &found.constant), ("lines", &found.lines.len()), ("all", &(found.remainder < 1e-9))],
                );
                for line in found.lines.iter().take(4) {
                    let known = line.uncertainty > 1e-10;
                    table.row(
                        "  line",
                        &[
                            ("frequency", &line.frequency),
                            ("amplitude", &line.amplitude),
                            ("phase", &line.phase),
                            ("+-", &known.then_some(line.uncertainty)),
                        ],
                    );
                }
            });
        }
        for window in [Window::Uniform, Window::Hann, Window::Kaiser { shape: 9.0 }] {
            let spectrum = amplitude_spectrum(&series, window).expect("a spectrum");
            let apart = (spectrum.amplitudes.len() / 5).max(1);
            let points: Vec<_> = spectrum.points().skip(1).step_by(apart).take(5).collect();
            assert_eq!(points[0].0, spectrum.frequency(1));
            let half_width = window.half_width(series.duration());
            // What rounds to zero is a rounding.
            let amplitude = |amplitude: f64| ((amplitude * 1e9).round() / 1e9).written();
            let points =
                points.iter().map(|(frequency, size)| format!("{} at {}", amplitude(*size), frequency.written()));
            table.row(
                &format!("  {window:?}"),
                &[
                    ("spacing", &spectrum.spacing),
                    ("half width", &half_width),
                    ("amplitudes", &points.collect::<Vec<_>>().join(", ")),
                ],
            );
        }
    }
    table.check("lines");
}

#[test]
fn identifications() {
    let mut table = Table::default();
    let generators = |uncertainty: f64| {
        [("a", 1.0), ("b", 0.618_033_988_7), ("c", 0.01)]
            .map(|(symbol, frequency)| Generator { symbol, frequency, uncertainty })
            .to_vec()
    };
    for uncertainty in [0.0, 1e-9, 1e-5] {
        let basis = FrequencyBasis::new(generators(uncertainty)).expect("a basis");
        for (frequency, error) in [
            (2.0, 1e-9),
            (1.618_033_988_7, 1e-9),
            (0.763_932_022_6, 1e-9),
            (3.03, 1e-8),
            (1.02 + 1e-7, 1e-8),
            (1.02 + 1e-7, 1e-6),
            (0.123_456, 1e-9),
            (0.123_456, 1e-2),
            (7.0, 1e-9),
        ] {
            let name = format!("{frequency} +- {error:e} of generators +- {uncertainty:e}");
            let found = basis.identify(frequency, error);
            let Some(combination) = found.combination() else {
                let is_none = matches!(found, Identification::Unidentified);
                table.row(&name, &[("", &if is_none { "unidentified" } else { "other" })]);
                continue;
            };
            table.row(
                &name,
                &[
                    ("a, b, c", &format!("{:?}", combination.integers())),
                    ("order", &combination.order().to_string()),
                    ("frequency", &combination.frequency),
                    ("misfit", &combination.misfit),
                    ("chance", &combination.chance),
                ],
            );
        }
    }
    table.refusal("no generators", FrequencyBasis::new(Vec::new()));
    table.refusal("a generator twice", FrequencyBasis::new(vec![generators(0.0)[0]; 2]));
    table.check("identifications");
}

/// A rate with its uncertainty, if that is more than a rounding.
impl Written for MeanRate {
    fn written(&self) -> String {
        let MeanRate { value, uncertainty } = self;
        if *uncertainty < 1e-12 { format!("{value:.8}") } else { format!("{value:.8} +- {uncertainty:.3e}") }
    }
}

#[test]
fn frequencies() {
    let mut table = Table::default();
    let angle = |k: u32| 0.3 * f64::from(k) + 0.2 * (0.11 * f64::from(k)).sin() + 1e-3 * (0.003 * f64::from(k)).cos();
    for count in [16, 200, 3000] {
        let found = mean_rate(&(0..count).map(angle).collect::<Vec<_>>(), 0.7).expect("a rate");
        table.row(&format!("{count} angles"), &[("mean rate", &found)]);
    }
    let near = BodyState { momentum: state().momentum * 0.1 + state().axis * 2.0, ..state() };
    for (name, s, initial, end) in [
        ("general", general() * 8.0, state(), 3000.0),
        ("n near L", general() * 8.0, near, 2000.0),
        ("backwards", general() * 8.0, state(), -2500.0),
        ("symmetric", tensor([0.2, 0.2, -0.3]), state(), 2000.0),
        ("too short", general(), state(), 30.0),
    ] {
        let motion =
            Problem::new(STAR, s, initial).and_then(|problem| problem.taylor((0.0, end), 1e-9)).expect("a motion");
        let about_given = mean_rates_about(&motion, &Matrix3::identity());
        for (of, found) in [("", fundamental_frequencies(&motion)), (", about the given axes", about_given)] {
            let name = format!("{name}{of}");
            table.found(&name, found, |table, found| {
                table.row(
                    &name,
                    &[
                        ("alpha", &found.alpha),
                        ("gamma", &found.gamma),
                        ("L", &found.momentum),
                        ("slow", &found.slow),
                        ("nutation", &found.nutation),
                        ("body", &found.body),
                    ],
                );
                if of.is_empty() {
                    let axes: Vec<_> = (0..3).map(|i| found.frame.row(i).transpose()).collect();
                    table.row("  axes", &[("X", &axes[0]), ("Y", &axes[1]), ("Z", &axes[2])]);
                    table.found("  basis", found.basis(), |table, basis| {
                        for Generator { symbol, frequency: value, uncertainty } in basis.generators() {
                            table.row("  basis", &[(symbol, &MeanRate { value: *value, uncertainty: *uncertainty })]);
                        }
                    });
                }
            });
        }
    }
    table.check("frequencies");
}
