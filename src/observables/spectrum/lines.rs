//! Lines of a quasi-periodic series: frequencies, amplitudes and phases far beyond the spacing of a Fourier transform.

use core::f64::consts::PI;

use super::joint_fit::{JointFit, Wave};
use super::residual_spectrum::{LEAST_DISTANCE, ResidualSpectrum, SHAPE};
use super::{Series, Window};
use crate::error::Error;

/// The window under which lines are fitted.
const WINDOW: Window = Window::Kaiser { shape: SHAPE };

/// Steps of the fit after a round, and where they are to lead to the end.
const STEPS: (usize, usize) = (2, 12);

/// How much more than in a line alone an error may grow in the frequency of one among others: beyond, the lines are not told apart. Two lines
/// `8 / T` apart reach 4, three in a row 28.
const MOST_AMPLIFIED: f64 = 30.0;

/// Lines are this many times the noise: of white noise an amplitude passes `x` times its median with the probability `2^(-x^2)`, 1.5e-11 for six.
const ABOVE_NOISE: f64 = 6.0;

/// One line `amplitude cos(frequency t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectralLine {
    /// Angular frequency, above zero (rad per unit of time).
    pub frequency: f64,
    /// Amplitude, above zero.
    pub amplitude: f64,
    /// Phase at `t = 0`, in (-pi, pi] (rad).
    pub phase: f64,
    /// Estimated error of the frequency, from what is left of the series near the line and, where lines are missing from the list, from the
    /// strongest of those. Above `1 / T` the phase at the ends of the series is off by more than half a radian: such a line stands for several
    /// that the series is too short to tell apart.
    pub uncertainty: f64,
}

/// A constant and the lines of a series, strongest first.
#[derive(Debug, Clone, PartialEq)]
pub struct LineList {
    /// The constant term.
    pub constant: f64,
    /// The lines.
    pub lines: Vec<SpectralLine>,
    /// Largest amplitude in the spectrum of what is left. Above the amplitude asked for it says that lines are missing.
    pub remainder: f64,
    /// Six times the noise, which is the median amplitude of what is left or the rounding of the values and of their times, whichever is more.
    /// What is below that is not listed.
    pub noise: f64,
    /// About the least distance of two lines that are told apart, and of a line from zero: `8 / T` (rad per unit of time).
    pub resolution: f64,
}

/// All lines of a series with an amplitude of at least `least`, at most `most` of them.
///
/// The highest peaks of the spectrum are taken out again and again, as in the frequency analysis of J. Laskar (Icarus 88, 266
/// (1990); Physica D 67, 257 (1993)); but all lines found so far, each with frequency, amplitude and phase, are fitted
/// together by weighted least squares after every round. So neither the lines at `-frequency` of a real series nor near
/// neighbours bias the result.
///
/// Resolution: with `T` the length of the series, lines `40 / T` or more apart (and from zero and Nyquist's frequency) do not
/// know of each other; down to `10 / T` they are separated by the fit, at the price of digits; below `8 / T`, or where many
/// lines are crowded, they are taken as one line, of which the [`uncertainty`](SpectralLine::uncertainty) counts what it leaves. Lines below `least` are left in
/// the series and shift a stronger one within `40 / T` by up to
/// `6 / T` times the ratio of the amplitudes: ask for weaker lines than are wanted. For a series that is a sum of lines
/// the error of a frequency is below 1e-9 for amplitudes from 1 to 1e-6, at `T = 4000`, whatever the phases; see
/// [`SpectralLine::uncertainty`].
///
/// # Errors
/// [`Error::Domain`] for a series that has no spectrum (too short, not finite), and for a `least` that is not above zero.
pub fn spectral_lines(series: &Series, least: f64, most: usize) -> Result<LineList, Error> {
    series.check()?;
    Error::ensure(least > 0.0 && least.is_finite(), "least amplitude", least, "above zero and finite")?;
    let weights = WINDOW.weights(series.values.len())?;
    let Fitted { fit, amplifications, residual } = separated(series, &weights, least, most)?;
    let spectrum = ResidualSpectrum::of(&residual, &weights);
    // The values are rounded, and so are the times for which they were computed: independently, but near each line.
    let largest = series.values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let latest = series.start.abs().max((series.start + series.duration()).abs());
    let turned = fit.waves.iter().fold(0.0_f64, |most, wave| most.max(wave.phase)) * 2.0 / series.step * latest;
    let rounding = f64::EPSILON * largest * (1.0 + turned / (series.values.len() as f64).sqrt());
    // Lines that are missing elsewhere say that there may be as strong ones under the lines found, where the fit hides them.
    let remainder = spectrum.largest();
    let hidden = if remainder >= least { remainder } else { 0.0 };
    let (median, middle) = (spectrum.median(), series.start + series.step * (series.values.len() - 1) as f64 / 2.0);
    let noise = rounding.max(median);
    let (noise, error) = (ABOVE_NOISE * noise, noise + hidden);
    let mut lines: Vec<_> = fit
        .waves
        .iter()
        .zip(amplifications)
        .filter(|(wave, _)| wave.amplitude() >= least.max(noise))
        .map(|(wave, amplification)| {
            let frequency = wave.phase * 2.0 / series.step;
            let shift = spectrum.shift_of(wave) + error * amplification;
            let phase = (-wave.sin_part).atan2(wave.cos_part) - frequency * middle;
            SpectralLine {
                frequency,
                amplitude: wave.amplitude(),
                phase: PI - (PI - phase).rem_euclid(2.0 * PI),
                uncertainty: shift * 2.0 / series.duration() + f64::EPSILON * frequency,
            }
        })
        .collect();
    lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let resolution = 2.0 * LEAST_DISTANCE / series.duration();
    Ok(LineList { constant: fit.constant, lines, remainder, noise, resolution })
}

/// A fit with what it leaves.
struct Fitted<'s> {
    fit: JointFit<'s>,
    amplifications: Vec<f64>,
    residual: Vec<f64>,
}

/// The fit of the lines that can be told apart.
fn separated<'s>(series: &'s Series, weights: &'s [f64], least: f64, most: usize) -> Result<Fitted<'s>, Error> {
    let constant = JointFit::new(&series.values, weights, WINDOW)?;
    let residual = constant.residual();
    let mut found = Fitted { fit: constant, amplifications: Vec::new(), residual };
    // Peaks of the spectrum that are no lines of their own, but what a line leaves that stands for several.
    let mut refused: Vec<Wave> = Vec::new();
    while found.fit.waves.len() < most {
        let mut peaks = ResidualSpectrum::of(&found.residual, weights).peaks(least, &found.fit.waves, &refused);
        peaks.truncate(most - found.fit.waves.len());
        if peaks.is_empty() {
            break;
        }
        if let Some(together) = found.with(&peaks, STEPS.0) {
            found = together;
            continue;
        }
        for peak in peaks {
            if !found.take_in(peak, weights)? {
                refused.push(peak);
            }
        }
    }
    Ok(found.settled())
}

impl<'s> Fitted<'s> {
    /// The fit with some more waves after some steps; none if its lines cannot be told apart then, or leave more than before: of what is not
    /// a sum of as many lines, the steps may lead anywhere.
    fn with(&self, peaks: &[Wave], steps: usize) -> Option<Self> {
        let mut fit = self.fit.clone();
        fit.waves.extend(peaks);
        improve(&mut fit, steps)?;
        let (alone, amplifications) = ((2.0 * SHAPE).sqrt(), fit.amplification()?);
        let certain = |(wave, amplification): (&Wave, &f64)| amplification * wave.amplitude() <= MOST_AMPLIFIED * alone;
        if fit.least_distance() <= 0.0 || !fit.waves.iter().zip(&amplifications).all(certain) {
            return None;
        }
        // The last steps move within rounding.
        let allowed = if peaks.is_empty() { 4.0 } else { 1.0 };
        let residual = fit.residual();
        let closer = fit.power(&residual) <= allowed * fit.power(&self.residual);
        closer.then_some(Self { fit, amplifications, residual })
    }

    /// Takes in one more wave, fitted together with those within reach of its line alone; false if it cannot be told from them.
    fn take_in(&mut self, peak: Wave, weights: &[f64]) -> Result<bool, Error> {
        let count = self.residual.len() as f64;
        let is_near = |wave: &Wave| (wave.phase - peak.phase).abs() * count < 2.0 * SHAPE.hypot(PI);
        let (near, far): (Vec<Wave>, Vec<Wave>) = self.fit.waves.iter().partition(|&wave| is_near(wave));
        let of_residual = |values, waves| -> Result<JointFit<'_>, Error> {
            let mut fit = JointFit::new(values, weights, WINDOW)?;
            (fit.constant, fit.waves) = (0.0, waves);
            Ok(fit)
        };
        let opposite = |wave: &Wave| Wave { cos_part: -wave.cos_part, sin_part: -wave.sin_part, ..*wave };
        let alone = of_residual(&self.residual, near.iter().map(opposite).collect())?.residual();
        let local =
            Fitted { fit: of_residual(&alone, near)?, amplifications: Vec::new(), residual: self.residual.clone() };
        let Some(Fitted { fit, residual, .. }) = local.with(&[peak], STEPS.1) else { return Ok(false) };
        self.fit.constant += fit.constant;
        self.fit.waves = far.into_iter().chain(fit.waves).collect();
        self.residual = residual;
        Ok(true)
    }

    /// The fit after all steps. As long as its lines cannot be told apart, that goes which is told apart worst.
    fn settled(mut self) -> Self {
        loop {
            // Without lines there is nothing to tell apart.
            if let Some(settled) = self.with(&[], STEPS.1) {
                return settled;
            }
            let amplifications = self.fit.amplification().unwrap_or_default();
            let uncertain = self.fit.waves.iter().zip(amplifications).map(|(wave, a)| wave.amplitude() * a);
            let worst = uncertain.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k);
            self.fit.waves.remove(worst);
            self.residual = self.fit.residual();
        }
    }
}

/// Steps of the fit until no frequency moves by more than rounding.
fn improve(fit: &mut JointFit<'_>, steps: usize) -> Option<()> {
    for _ in 0..steps {
        let residual = fit.residual();
        if fit.improve(&residual, LEAST_DISTANCE / 2.0)? < 1e-13 {
            break;
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(values: Vec<f64>) -> Series {
        Series { start: 0.0, step: 0.25, values }
    }

    #[test]
    fn what_has_no_spectrum_is_refused() {
        let refused = |series: &Series| spectral_lines(series, 1e-6, 10).is_err();
        assert!(refused(&series(vec![1.0; 15])) && !refused(&series(vec![1.0; 16])));
        for wrong in [f64::NAN, f64::INFINITY, 1e200] {
            let mut values = vec![1.0; 64];
            values[20] = wrong;
            assert!(refused(&series(values)));
            assert!(wrong.is_finite() || refused(&Series { start: wrong, ..series(vec![1.0; 64]) }));
        }
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refused(&Series { step, ..series(vec![1.0; 64]) }));
        }
        for least in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(spectral_lines(&series(vec![1.0; 64]), least, 10).is_err());
        }
    }

    #[test]
    fn a_constant_has_no_lines_and_the_number_of_lines_is_kept() {
        let none = spectral_lines(&series(vec![-3.0; 256]), 1e-9, 10).unwrap();
        assert!(none.lines.is_empty() && (none.constant + 3.0).abs() < 1e-14 && none.remainder < 1e-14);
        let sum = (0..1024).map(|j| 0.25 * f64::from(j)).map(|t| t.cos() + 0.1 * (2.3 * t).sin()).collect();
        let one = spectral_lines(&series(sum), 1e-3, 1).unwrap();
        assert!(one.lines.len() == 1 && (one.remainder - 0.1).abs() < 0.01);
        assert!((one.lines[0].frequency - 1.0).abs() < 1e-6);
    }

    /// Values do not depend on where the times begin; the rounding of what they were computed from does.
    #[test]
    fn the_uncertainty_is_that_of_rounded_values_and_times() {
        let (step, count) = (0.25, 1024);
        let (strong, weak) = (3.0, 0.5);
        let value = |j: usize| {
            let t = step * (j as f64 - 511.5);
            -1.5 + strong * (0.9 * t + 0.3).cos() + weak * (4.1 * t).sin()
        };
        let values: Vec<f64> = (0..count).map(value).collect();
        let highest = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let list = |start: f64, values: Vec<f64>, unit: f64| {
            let found = spectral_lines(&Series { start, step, values }, 1e-3 * unit, 10).unwrap();
            found.lines.iter().map(|line| line.uncertainty).collect::<Vec<_>>()
        };
        let duration = step * count as f64;
        let latest = [1e9, 3e5, -1e9, -3e5, -200.0, -50.0];
        for (start, latest) in latest.iter().zip([1e9 + duration, 3e5 + duration, 1e9, 3e5, 200.0, duration - 50.0]) {
            let rounding = f64::EPSILON * highest * (1.0 + 4.1 * latest / (count as f64).sqrt());
            let found = list(*start, values.clone(), 1.0);
            assert_eq!(found.len(), 2);
            for (found, (amplitude, frequency)) in found.iter().zip([(strong, 0.9), (weak, 4.1)]) {
                let shift = rounding * 40.0_f64.sqrt() / amplitude;
                let expected = shift * 2.0 / duration + f64::EPSILON * frequency;
                // Something is left of the series by rounding too.
                assert!((0.97..1.1).contains(&(found / expected)), "{start} {frequency}: {found:e} {expected:e}");
            }
            // In any unit.
            let small = list(*start, values.iter().map(|x| x / 1024.0).collect(), 1.0 / 1024.0);
            assert!(small.iter().zip(&found).all(|(small, found)| (small / found - 1.0).abs() < 1e-6), "{start}");
        }
        // Of slow oscillations the values are rounded more than the times.
        let slow = (0..count).map(|j| (0.2 * step * (j as f64 - 511.5)).cos()).collect();
        let found = list(-duration / 2.0, slow, 1.0);
        let rounding = f64::EPSILON * (1.0 + 0.2 * duration / 2.0 / (count as f64).sqrt());
        let expected = rounding * 40.0_f64.sqrt() * 2.0 / duration + f64::EPSILON * 0.2;
        assert!(found.len() == 1 && (0.97..1.15).contains(&(found[0] / expected)), "{found:?} {expected:e}");
    }

    #[test]
    fn noise_has_no_lines_and_hides_those_below_it() {
        // A generator of low quality is noise enough.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        let noise: Vec<f64> = (0..2048).map(|_| uniform()).collect();
        let list = spectral_lines(&series(noise.clone()), 1e-3, 20).unwrap();
        assert!(list.lines.is_empty(), "{list:?}");
        // Amplitudes of white noise of the variance 1/12 in N values are about 2 sqrt(w2 / 12 N), w2 = 2.9 the mean square of the weights.
        assert!((0.08..0.3).contains(&list.noise), "{}", list.noise);
        for (amplitude, found) in [(0.5, 1), (0.02, 0)] {
            let with_line = noise.iter().enumerate().map(|(j, x)| x + amplitude * (0.3 * j as f64).cos()).collect();
            let list = spectral_lines(&series(with_line), 1e-3, 20).unwrap();
            assert_eq!(list.lines.len(), found, "{amplitude}: {list:?}");
        }
    }

    /// Amplitudes that are rounding beside a constant: none is a line.
    #[test]
    fn the_rounding_of_a_constant_is_no_line() {
        let (step, count) = (0.25, 4096);
        for size in [1e-16, 1e-15] {
            let value = |j: usize| 1.0 + size * (0.7 * step * j as f64).cos();
            let list = spectral_lines(&series((0..count).map(value).collect()), 1e-17, 20).unwrap();
            assert!(list.lines.is_empty() && list.noise > 6.0 * f64::EPSILON, "{list:?}");
        }
    }

    /// Three lines `d / T` apart, and one so near to zero: where they cannot be told apart the list stays within what the series can be made of.
    #[test]
    fn lines_that_are_too_near_are_taken_as_one() {
        for distance in [0.3, 1.0, 1.7, 2.6, 3.3] {
            let (_, values) = of_waves(&[
                (100.0, 0.5),
                (100.0 + distance, 0.7),
                (100.0 + 2.0 * distance, 0.4),
                (200.0, 1e-3),
                (distance, 0.3),
            ]);
            let list = spectral_lines(&series(values), 1e-4, 20).unwrap();
            assert!((list.resolution * 128.0 - 4.0).abs() < 1e-12);
            let (near, far): (Vec<SpectralLine>, Vec<SpectralLine>) =
                list.lines.iter().partition(|line| line.frequency * 128.0 < 150.0);
            for line in &near {
                assert!(line.frequency > 0.0 && line.amplitude < 2.0, "{distance}: {list:?}");
            }
            // Lines are missing and said to be, or all are found.
            let found = |place: f64| list.lines.iter().any(|line| (line.frequency * 128.0 - place).abs() < 1e-3);
            let all = [0.0, 1.0, 2.0].iter().all(|k| found(100.0 + k * distance)) && found(distance);
            assert!(list.remainder >= 1e-4 || all, "{distance}: {list:?}");
            assert!(far.iter().any(|line| (line.frequency * 128.0 - 200.0).abs() < 1e-2), "{distance}: {list:?}");
        }
    }

    /// The weights and the values of waves of these amplitudes at these places (frequencies times half the length), in phase in the middle.
    fn of_waves(waves: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
        let value = |j: usize| -> f64 {
            let y = (j as f64 - 511.5) / 512.0;
            waves.iter().map(|(place, amplitude)| amplitude * (place * y + 0.3).cos()).sum()
        };
        (WINDOW.weights(1024).unwrap(), (0..1024).map(value).collect())
    }

    #[test]
    fn lines_that_are_missing_may_be_hidden_under_those_found() {
        let (_, values) = of_waves(&[(100.0, 1.0), (300.0, 0.1)]);
        let duration = 256.0;
        for (least, most, hidden) in [(1e-3, 1, true), (0.11, 10, false)] {
            let list = spectral_lines(&series(values.clone()), least, most).unwrap();
            assert!(list.lines.len() == 1 && (0.09..0.11).contains(&list.remainder), "{list:?}");
            let expected = list.remainder * 40.0_f64.sqrt() * 2.0 / duration;
            let found = list.lines[0].uncertainty / expected;
            assert!(if hidden { (0.97..1.1).contains(&found) } else { (0.0..0.1).contains(&found) }, "{found}");
        }
    }

    #[test]
    fn lines_are_in_the_order_of_their_amplitudes_not_of_their_peaks() {
        // Two lines that are near each other have one peak, higher than that of a stronger line.
        let (_, values) = of_waves(&[(100.0, 0.9), (106.0, 0.5), (300.0, 1.0)]);
        let list = spectral_lines(&series(values), 1e-3, 10).unwrap();
        let found: Vec<_> = list.lines.iter().map(|line| (line.frequency * 128.0, line.amplitude)).collect();
        assert_eq!(found.len(), 3);
        for (found, exact) in found.iter().zip([(300.0, 1.0), (100.0, 0.9), (106.0, 0.5)]) {
            assert!((found.0 - exact.0).abs() < 1e-6 && (found.1 - exact.1).abs() < 1e-6, "{found:?}");
        }
    }
}
