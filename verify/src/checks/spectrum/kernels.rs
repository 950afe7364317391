//! The kernels: amplitude spectra, windows, line lists of known sums, identification of known and of random frequencies.

use std::f64::consts::{PI, TAU};

use twofold::observables::spectrum::{
    FrequencyBasis, Generator, Identification, LineList, Series, SpectralLine, Window, amplitude_spectrum,
    spectral_lines,
};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::random::Random;

const WINDOWS: [Window; 4] =
    [Window::Uniform, Window::Hann, Window::Kaiser { shape: 10.0 }, Window::Kaiser { shape: 20.0 }];

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "spectrum-amplitudes",
            kind: Kind::Property,
            equations: &[47, 71],
            statement: "a sinusoid of amplitude A on a frequency of the transform has the amplitude A there, for every window, and a constant its size at frequency zero",
            figure: "largest relative error, even and odd lengths",
            bound: Bound::AtMost(4e-8),
            reason: "what the Kaiser windows leak from the line at the negative frequency and the constant is below 1.8e-8 (shape 20), of the sum with the constant twice that; \
                 the others leak nothing to whole bins; shape 10 is left out as it leaks 2e-4",
            measure: amplitudes,
        },
        Check {
            id: "spectrum-parseval",
            kind: Kind::Property,
            equations: &[47, 71],
            statement: "the squares of a spectrum's amplitudes sum to the mean square of the tapered series (Parseval), for every window",
            figure: "largest relative difference, random series of 16 to 1,000 values",
            bound: Bound::AtMost(1e-14),
            reason: "rounding of a transform, about 2.2e-16 log2(N) / 2, and of a sum of 1,000 squares",
            measure: parseval,
        },
        Check {
            id: "spectrum-windows",
            kind: Kind::Property,
            equations: &[47, 71],
            statement: "each window's line has its first zero and its largest sidelobe where the documentation says",
            figure: "largest relative deviation of the largest sidelobe and of the half width",
            bound: Bound::AtMost(0.03),
            reason: "two digits are documented; the scan has 100 points a bin",
            measure: windows,
        },
        Check {
            id: "line-list-synthetic",
            kind: Kind::Oracle,
            equations: &[47, 71],
            statement: "the lines of a known sum, amplitudes 1 to 1e-6, at random frequencies 0.02 apart or more, beside a constant: none missed, none invented, \
                 frequencies, amplitudes and phases found",
            figure: "largest error of a frequency [1/t_c], 8 sums of 24 lines over 4,000 t_c",
            bound: Bound::AtMost(1e-9),
            reason: "the accuracy asked of line lists",
            measure: synthetic_sums,
        },
        Check {
            id: "line-list-resolution",
            kind: Kind::Oracle,
            equations: &[47, 71],
            statement: "two lines 10/T to 40/T apart, amplitude ratios 1 to 1e-3, and one line 10/T to 40/T from zero are found as such, and no error of a frequency exceeds its estimate",
            figure: "largest error of a frequency in units of 2/T, T = 4,000 t_c",
            bound: Bound::AtMost(1e-6),
            reason: "1e-9 / t_c at T = 2,000 t_c in that unit: the accuracy asked of line lists, at the least distance documented",
            measure: close_lines,
        },
        Check {
            id: "line-identification-random",
            kind: Kind::Property,
            equations: &[47, 71],
            statement: "frequencies that are no combination are reported as unidentified: of 20,000 random ones no more than the chance of 1e-3 allows are taken for one",
            figure: "share identified / 1e-3, with an error of 1e-5; infinite if one is identified with an error of 1e-11, or if none is with 1e-5",
            bound: Bound::AtMost(1.68),
            reason: "1e-3 is allowed: 20 of 20,000, and three standard deviations are 13.4",
            measure: random_frequencies,
        },
        Check {
            id: "line-identification-known",
            kind: Kind::Property,
            equations: &[47, 71],
            statement: "every combination up to order 8 of the frequencies of tp-II, given with an error of 1e-10, is identified as itself",
            figure: "combinations not identified, or as another one",
            bound: Bound::AtMost(0.0),
            reason: "no two combinations of orders up to 10 are within 1e-9 of each other",
            measure: known_combinations,
        },
    ]
}

fn message(e: twofold::Error) -> String {
    e.to_string()
}

fn amplitudes() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for count in [256, 257] {
        for window in [Window::Uniform, Window::Hann, Window::Kaiser { shape: 20.0 }] {
            for (bin, amplitude, phase) in [(24, 0.7, 0.3), (60, 2.0, -1.2), (100, 1e-3, 3.0)] {
                let step = 0.37;
                let wave = |j: usize| amplitude * ((TAU * (bin * j) as f64 / count as f64) + phase).cos();
                let series = |constant: f64| Series {
                    start: -5.0,
                    step,
                    values: (0..count).map(|j| constant + wave(j)).collect(),
                };
                let spectrum = amplitude_spectrum(&series(amplitude), window).map_err(message)?;
                let frequency = TAU * bin as f64 / (count as f64 * step);
                let errors = [
                    spectrum.amplitudes[bin] / amplitude - 1.0,
                    spectrum.amplitudes[0] / amplitude - 1.0,
                    spectrum.frequency(bin) / frequency - 1.0,
                ];
                worst.see(largest(errors.map(f64::abs)), || format!("{window:?}, N = {count}, bin {bin}: {errors:?}"));
            }
        }
    }
    worst.finish()
}

fn parseval() -> Result<Measured, String> {
    let (mut random, mut worst) = (Random::with_seed(47), Worst::default());
    for count in [16, 17, 100, 243, 512, 1000] {
        for window in WINDOWS {
            let values: Vec<f64> = (0..count).map(|_| random.within(-1.0, 3.0)).collect();
            let weights = window.weights(count).map_err(message)?;
            let square: f64 = values.iter().zip(&weights).map(|(x, w)| (x * w).powi(2)).sum::<f64>() / count as f64;
            let spectrum = amplitude_spectrum(&Series { start: 0.0, step: 0.1, values }, window).map_err(message)?;
            let whole = |index: usize| index == 0 || 2 * index == count;
            let share = |(index, a): (usize, &f64)| if whole(index) { a * a } else { a * a / 2.0 };
            let sum: f64 = spectrum.amplitudes.iter().enumerate().map(share).sum();
            worst.see((sum / square - 1.0).abs(), || format!("{window:?}, N = {count}"));
        }
    }
    worst.finish()
}

fn windows() -> Result<Measured, String> {
    let mut worst = Worst::default();
    // The documentation's table: sidelobe, half width times T.
    let documented = [(0.217, 6.28), (0.0267, 12.57), (2.0e-4, 21.0), (1.79e-8, 40.5)];
    for (window, (sidelobe, width)) in WINDOWS.into_iter().zip(documented) {
        let weights = window.weights(128).map_err(message)?;
        let transform = |f: f64| {
            let cosines = weights.iter().enumerate().map(|(j, w)| w * (f * ((j as f64 + 0.5) / 128.0 - 0.5)).cos());
            cosines.sum::<f64>() / 128.0
        };
        let scan: Vec<f64> = (0..1000).map(|i| transform(0.02 * PI * f64::from(i))).collect();
        let zero = scan.iter().position(|&x| x <= 0.0).ok_or("no zero")?;
        let found = largest(scan[zero..].iter().map(|x| x.abs()));
        let first = 0.02 * PI * zero as f64;
        let deviations = [found / sidelobe - 1.0, first / width - 1.0, window.half_width(1.0) / width - 1.0];
        worst.see(largest(deviations.map(f64::abs)), || {
            format!("{window:?}: sidelobe {found:.3e}, first zero {first:.2} / T")
        });
    }
    worst.finish()
}

fn sum_of(lines: &[SpectralLine], constant: f64, start: f64, step: f64, count: usize) -> Series {
    let value = |j: usize| {
        let t = start + step * j as f64;
        constant + lines.iter().map(|l| l.amplitude * (l.frequency * t + l.phase).cos()).sum::<f64>()
    };
    Series { start, step, values: (0..count).map(value).collect() }
}

/// Largest error of a frequency, and of an amplitude and a phase relative to what the rounding of the series allows; infinite
/// if a line is missing, invented, or farther off than its uncertainty says.
fn compare(found: &LineList, known: &[SpectralLine], rounding: f64) -> [f64; 3] {
    if found.lines.len() != known.len() {
        return [f64::INFINITY; 3];
    }
    let mut errors = [0.0_f64; 3];
    for line in known {
        let near = |l: &&SpectralLine| (l.frequency - line.frequency).abs();
        let nearest = found.lines.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("there are lines");
        let turned = ((nearest.phase - line.phase + PI).rem_euclid(TAU) - PI).abs();
        let error = near(&nearest);
        let honest = error <= 3.0 * nearest.uncertainty;
        let here = [
            if honest { error } else { f64::INFINITY },
            (nearest.amplitude - line.amplitude).abs() / rounding,
            turned * line.amplitude / rounding,
        ];
        errors = std::array::from_fn(|i| largest([errors[i], here[i]]));
    }
    errors
}

fn synthetic_sums() -> Result<Measured, String> {
    let (mut random, mut worst, mut others) = (Random::with_seed(1990), Worst::default(), 0.0_f64);
    for case in 0..8 {
        let mut lines: Vec<SpectralLine> = Vec::new();
        while lines.len() < 24 {
            let frequency = random.within(0.02, 4.5);
            if lines.iter().all(|l| (l.frequency - frequency).abs() > 0.02) {
                let amplitude = 10f64.powf(-6.0 * lines.len() as f64 / 23.0);
                lines.push(SpectralLine { frequency, amplitude, phase: random.within(-PI, PI), uncertainty: 0.0 });
            }
        }
        let constant = random.within(-1.0, 1.0);
        let series = sum_of(&lines, constant, -700.0, 4000.0 / 8192.0, 8192);
        let list = spectral_lines(&series, 3e-7, 100).map_err(message)?;
        let [frequency, amplitude, phase] = compare(&list, &lines, 1e-10);
        others = largest([others, amplitude, phase, (list.constant - constant).abs() / 1e-10]);
        worst.see(frequency, || format!("sum {case} of seed 1990, {} lines found", list.lines.len()));
    }
    // Amplitudes, phases times amplitudes and constants: to 1e-10 of the strongest line.
    let measured = worst.finish()?;
    let figure = if others <= 1.0 { measured.figure } else { f64::INFINITY };
    Ok(Measured::new(
        figure,
        format!("{}; amplitudes, phases, constants within {:.1e}", measured.detail, others * 1e-10),
    ))
}

fn close_lines() -> Result<Measured, String> {
    let (mut random, mut worst) = (Random::with_seed(1993), Worst::default());
    let (span, count) = (4000.0, 8192);
    for distance in [10.0, 12.0, 16.0, 20.0, 30.0, 40.0] {
        for ratio in [1.0, 0.1, 1e-3] {
            for near_zero in [false, true] {
                let line = |frequency, amplitude, random: &mut Random| SpectralLine {
                    frequency,
                    amplitude,
                    phase: random.within(-PI, PI),
                    uncertainty: 0.0,
                };
                let first = if near_zero { distance / span } else { 1.4 };
                let mut lines = vec![line(first, 1.0, &mut random)];
                if !near_zero {
                    lines.push(line(first + distance / span, ratio, &mut random));
                }
                let series = sum_of(&lines, ratio, 0.0, span / count as f64, count);
                let list = spectral_lines(&series, 1e-7, 20).map_err(message)?;
                let [frequency, ..] = compare(&list, &lines, 1.0);
                worst.see(frequency * span / 2.0, || {
                    format!("{distance} / T apart, ratio {ratio}, near zero: {near_zero}; {} lines", list.lines.len())
                });
            }
        }
    }
    worst.finish()
}

/// The frequencies of tp-II.
fn basis(uncertainty: f64) -> Result<FrequencyBasis, String> {
    let generators = [("alpha'", 1.39467831103), ("gamma'", -0.14421753117), ("l'", -0.03546436867)];
    let generator = |(symbol, frequency)| Generator { symbol, frequency, uncertainty };
    FrequencyBasis::new(generators.map(generator).to_vec()).map_err(message)
}

fn random_frequencies() -> Result<Measured, String> {
    let (basis, mut random) = (basis(1e-13)?, Random::with_seed(7));
    let (mut taken, mut taken_if_precise) = (0, 0);
    let cases = 20_000;
    for _ in 0..cases {
        let frequency = random.within(0.0, 4.5);
        let identified = |error| matches!(basis.identify(frequency, error), Identification::Identified(_));
        taken += usize::from(identified(1e-5));
        taken_if_precise += usize::from(identified(1e-11));
    }
    let share = taken as f64 / cases as f64 / 1e-3;
    let figure = if taken_if_precise == 0 && taken > 0 { share } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("seed 7: {taken} with an error of 1e-5, {taken_if_precise} with 1e-11")))
}

fn known_combinations() -> Result<Measured, String> {
    let basis = basis(1e-12)?;
    let (mut wrong, mut total, mut first) = (0, 0, String::new());
    for a in -8_i32..=8 {
        for g in -8_i32..=8 {
            for l in -8_i32..=8 {
                if a.abs() + g.abs() + l.abs() > 8 {
                    continue;
                }
                total += 1;
                let value: f64 =
                    basis.generators().iter().zip([a, g, l]).map(|(f, k)| f.frequency * f64::from(k)).sum();
                let identified = basis.identify(value + 2e-10, 1e-10);
                if identified.combination().map(|c| c.integers()) != Some(vec![a, g, l]) {
                    wrong += 1;
                    first = format!("; last {:?}: {identified}", [a, g, l]);
                }
            }
        }
    }
    Ok(Measured::new(f64::from(wrong), format!("of {total} combinations{first}")))
}
