//! Line lists of known sums.

use super::signals::{beam, examples, line_of_sight, motion_of};
use crate::prelude::*;

checks! {
    /// the lines of a known sum, amplitudes 1 to 1e-6, at random frequencies 0.02 apart or more, beside a constant: none missed, none invented,
    /// frequencies, amplitudes and phases found
    Oracle "line-list-synthetic" [47, 71]: synthetic_sums;
    AtMost(1e-9) "largest error of a frequency [1/t_c], 8 sums of 24 lines over 4,000 t_c";
    because "the documented error of a frequency of a line list";
    /// two lines 10/T to 40/T apart, amplitude ratios 1 to 1e-3, and one line 10/T to 40/T from zero are found as such, and no error of a frequency
    /// exceeds three times its estimate
    Oracle "line-list-resolution" [47, 71]: close_lines;
    AtMost(1e-6) "largest error of a frequency in units of 2/T, T = 4,000 t_c";
    because "1e-9 / t_c at T = 2,000 t_c in that unit: the documented error of a frequency, at the least distance documented";
    /// of m.n of tp-II over spans too short to resolve its lines, cut at 10 to 50 of them, the estimated errors of the frequencies are not too small
    Oracle "line-list-incomplete" [47]: incomplete_lists;
    AtMost(3.0) "largest error / estimated error of the ten strongest lines, spans of 3,000 to 8,000 t_c";
    because "an estimate; three times it for the other lists too";
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
        let turned = wrapped(nearest.phase - line.phase).abs();
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
    let mut others = 0.0_f64;
    let measured = worst_of_draws(1990, 8, |random| {
        let mut lines: Vec<SpectralLine> = Vec::new();
        while lines.len() < 24 {
            let frequency = random.within(0.02, 4.5);
            if lines.iter().all(|l| (l.frequency - frequency).abs() > 0.02) {
                let amplitude = 10f64.powf(-6.0 * lines.len() as f64 / 23.0);
                lines.push(SpectralLine { frequency, amplitude, phase: random.within(-PI, PI), uncertainty: 0.0 });
            }
        }
        let constant = random.within(-1.0, 1.0);
        let list = spectral_lines(&sum_of(&lines, constant, -700.0, 4000.0 / 8192.0, 8192), 3e-7, 100)?;
        let [frequency, amplitude, phase] = compare(&list, &lines, 1e-10);
        others = largest([others, amplitude, phase, (list.constant - constant).abs() / 1e-10]);
        Ok(frequency)
    })?;
    // Amplitudes, phases times amplitudes and constants: to 1e-10 of the strongest line.
    let figure = if others <= 1.0 { measured.figure } else { f64::INFINITY };
    let detail = format!("{}; amplitudes, phases, constants within {:.1e}", measured.detail, others * 1e-10);
    Ok(Measured::new(figure, detail))
}

fn close_lines() -> Result<Measured, String> {
    let mut random = Random::with_seed(1993);
    let (span, count) = (4000.0, 8192);
    let ratios = |distance| [1.0, 0.1, 1e-3].map(|ratio| (distance, ratio));
    let cases = [10.0, 12.0, 16.0, 20.0, 30.0, 40.0].into_iter().flat_map(ratios);
    worst_of(cases.flat_map(|(distance, ratio)| [false, true].map(|near_zero| (distance, ratio, near_zero))), |case| {
        let (distance, ratio, near_zero) = *case;
        let mut line = |frequency, amplitude| SpectralLine {
            frequency,
            amplitude,
            phase: random.within(-PI, PI),
            uncertainty: 0.0,
        };
        let first = if near_zero { distance / span } else { 1.4 };
        let mut lines = vec![line(first, 1.0)];
        if !near_zero {
            lines.push(line(first + distance / span, ratio));
        }
        let series = sum_of(&lines, ratio, 0.0, span / count as f64, count);
        let [frequency, ..] = compare(&spectral_lines(&series, 1e-7, 20)?, &lines, 1.0);
        Ok(frequency * span / 2.0)
    })
}

fn incomplete_lists() -> Result<Measured, String> {
    let example = &examples()?[1];
    worst_of([3000.0, 4000.0, 6000.0, 8000.0], |&span| {
        let (motion, beam, observer) = (motion_of("tp-2", span)?, beam(), line_of_sight());
        let series = Series::of_motion(&motion, (span * 4.0) as usize, |state| beam.direction(state).dot(&observer))?;
        worst_of([10, 25, 50], |&most| {
            worst_of(spectral_lines(&series, 1e-6, most)?.lines.iter().take(10), |line| {
                let away = |known: &SpectralLine| (known.frequency - line.frequency).abs();
                Ok(smallest(example.pulsar.lines.iter().map(away)) / line.uncertainty)
            })
        })
    })
}
