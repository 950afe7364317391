//! Spectral lines, their identification, mean rates and fundamental frequencies.

use twofold::dynamics::BodyState;
use twofold::observables::fundamental_frequencies::{fundamental_frequencies, mean_rate, mean_rates_about};
use twofold::observables::spectrum::{
    FrequencyBasis, Generator, Identification, Series, Window, amplitude_spectrum, spectral_lines,
};
use twofold::propagation::propagate;

use crate::values::scene::{STAR, general, state, tensor};
use crate::values::table::Table;

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
    let cases = [
        ("three", series(&[(1.3, 1.0, 0.3), (2.1, 0.02, -1.0), (0.41, 3e-4, 2.0)], 0.7, 2000)),
        ("close", series(&[(1.3, 1.0, 0.3), (1.3 + 25.0 / 800.0, 0.5, 1.0)], 0.0, 2000)),
        ("very close", series(&[(1.3, 1.0, 0.3), (1.3 + 6.0 / 800.0, 0.5, 1.0)], 0.0, 2000)),
        ("low and high", series(&[(0.03, 1.0, 0.3), (7.8, 0.5, 1.0)], -0.2, 2000)),
        ("constant", series(&[], 0.3, 64)),
        ("short", series(&[(1.3, 1.0, 0.3)], 0.3, 17)),
    ];
    for (name, series) in &cases {
        table.parts(&format!("{name}: duration, Nyquist"), [series.duration(), series.highest_frequency()]);
        for (least, most) in [(1e-6, 20), (1e-2, 2)] {
            let name = format!("{name} from {least:e}, {most}");
            match spectral_lines(series, least, most) {
                Ok(found) => {
                    table.parts(&format!("{name}: constant"), [found.constant]);
                    table.text(
                        &format!("{name}: remainder below 1e-9, number"),
                        &format!("{} {}", found.remainder < 1e-9, found.lines.len()),
                    );
                    for line in found.lines.iter().take(4) {
                        table.parts(&format!("{name}: line"), [line.frequency, line.amplitude, line.phase]);
                        if line.uncertainty > 1e-10 {
                            table.text(&format!("{name}: uncertainty"), &format!("{:.3e}", line.uncertainty));
                        }
                    }
                }
                Err(error) => table.error(&name, &error),
            }
        }
        for window in [Window::Uniform, Window::Hann, Window::Kaiser { shape: 9.0 }] {
            let spectrum = amplitude_spectrum(series, window).expect("a spectrum");
            table.number(&format!("{name}, {window:?}: spacing"), spectrum.spacing);
            table.number(&format!("{name}, {window:?}: half width"), window.half_width(series.duration()));
            for (k, (frequency, amplitude)) in
                spectrum.points().enumerate().filter(|(k, _)| k % (spectrum.amplitudes.len() / 5).max(1) == 1)
            {
                table.parts(&format!("{name}, {window:?}: {k}"), [frequency, amplitude, spectrum.frequency(k)]);
            }
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
            let name = format!("{uncertainty:e}: {frequency} +- {error:e}");
            let found = basis.identify(frequency, error);
            match found.combination() {
                Some(combination) => {
                    table.text(
                        &name,
                        &format!("{:?} order {} {:?}", combination.terms, combination.order(), combination.integers()),
                    );
                    table.parts(&format!("{name}: frequency"), [combination.frequency]);
                    table.text(
                        &format!("{name}: misfit, chance"),
                        &format!("{:.4e} {:.4e}", combination.misfit, combination.chance),
                    );
                }
                None => table
                    .text(&name, if matches!(found, Identification::Unidentified) { "unidentified" } else { "other" }),
            }
        }
    }
    table.refusal("no generators", &FrequencyBasis::new(Vec::new()));
    let same = FrequencyBasis::new(vec![generators(0.0)[0], generators(0.0)[0]]);
    table.refusal("a generator twice", &same);
    table.check("identifications");
}

/// A rate with its uncertainty, if that is more than a rounding.
fn of_rate(rate: f64, uncertainty: f64) -> String {
    if uncertainty < 1e-12 { format!("{rate:.8}") } else { format!("{rate:.8} +- {uncertainty:.3e}") }
}

#[test]
fn frequencies() {
    let mut table = Table::default();
    let angle = |k: u32| 0.3 * f64::from(k) + 0.2 * (0.11 * f64::from(k)).sin() + 1e-3 * (0.003 * f64::from(k)).cos();
    for count in [16, 200, 3000] {
        let found = mean_rate(&(0..count).map(angle).collect::<Vec<_>>(), 0.7).expect("a rate");
        table.parts(&format!("mean rate of {count}"), [found.value, found.uncertainty]);
    }
    let near = BodyState { momentum: state().momentum * 0.1 + state().axis * 2.0, ..state() };
    for (name, s, initial, end) in [
        ("general", general() * 8.0, state(), 3000.0),
        ("n near L", general() * 8.0, near, 2000.0),
        ("backwards", general() * 8.0, state(), -2500.0),
        ("symmetric", tensor([0.2, 0.2, -0.3]), state(), 2000.0),
        ("too short", general(), state(), 30.0),
    ] {
        let motion = propagate(&STAR, &s, &initial, (0.0, end), 1e-9).expect("a motion");
        match fundamental_frequencies(&motion) {
            Ok(found) => {
                table.matrix(&format!("{name}: frame"), &found.frame);
                for (of, rate) in [
                    ("alpha", found.alpha),
                    ("gamma", found.gamma),
                    ("L", found.momentum),
                    ("slow", found.slow),
                    ("nutation", found.nutation),
                    ("body", found.body),
                ] {
                    match rate {
                        Some(rate) => {
                            table.text(&format!("{name}: {of}"), &of_rate(rate.value, rate.uncertainty));
                        }
                        None => table.text(&format!("{name}: {of}"), "none"),
                    }
                }
                match found.basis() {
                    Ok(basis) => {
                        for generator in basis.generators() {
                            table.text(
                                &format!("{name}: {}", generator.symbol),
                                &of_rate(generator.frequency, generator.uncertainty),
                            );
                        }
                    }
                    Err(error) => table.error(&format!("{name}: basis"), &error),
                }
            }
            Err(error) => table.error(name, &error),
        }
        match mean_rates_about(&motion, &nalgebra::Matrix3::identity()) {
            Ok(found) => {
                let value = |rate: Option<twofold::observables::fundamental_frequencies::MeanRate>| {
                    rate.map_or("none".to_string(), |r| format!("{:.8}", r.value))
                };
                table.text(
                    &format!("{name}: about the given axes"),
                    &[found.alpha, found.gamma, found.momentum, found.slow, found.nutation, found.body]
                        .map(value)
                        .join(" "),
                );
            }
            Err(error) => table.error(&format!("{name}: about the given axes"), &error),
        }
    }
    table.check("frequencies");
}
