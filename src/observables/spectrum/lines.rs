//! Lines of a quasi-periodic series: frequencies, amplitudes and phases far beyond the spacing of a Fourier transform.

use core::f64::consts::PI;

use super::amplitude::transform;
use super::joint_fit::{JointFit, Wave};
use super::{Series, Window};
use crate::error::Error;

/// Shape of the window: lines reach no farther than 1.8e-8 of their amplitude beyond `40.5 / T`.
const SHAPE: f64 = 20.0;

/// Largest sidelobe of that window.
const SIDELOBES: f64 = 1.8e-8;

/// The window under which lines are fitted.
const WINDOW: Window = Window::Kaiser { shape: SHAPE };

/// Least distance of two lines, and of a line from zero and from Nyquist's frequency, in units of `2 / T`.
const LEAST_DISTANCE: f64 = 4.0;

/// The transform is this much finer than the series demands, so that a peak is near its highest point.
const PADDING: usize = 2;

/// Peaks taken in one round are within this ratio of the highest: their neighbours follow when it is gone.
const ROUND: f64 = 1e-3;

/// Steps of the fit after a round, and at the end.
const STEPS: (usize, usize) = (2, 12);

/// One line `amplitude cos(frequency t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectralLine {
    /// Angular frequency, above zero (rad per unit of time).
    pub frequency: f64,
    /// Amplitude, above zero.
    pub amplitude: f64,
    /// Phase at `t = 0`, in (-pi, pi] (rad).
    pub phase: f64,
    /// Estimated error of the frequency, from what is left of the series near the line.
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
}

/// All lines of a series with an amplitude of at least `least`, at most `most` of them.
///
/// The highest peaks of the spectrum are taken out again and again, as in the frequency analysis of J. Laskar (Icarus 88, 266
/// (1990); Physica D 67, 257 (1993)); but all lines found so far, each with frequency, amplitude and phase, are fitted
/// together by weighted least squares after every round. So neither the lines at `-frequency` of a real series nor near
/// neighbours bias the result.
///
/// Resolution: with `T` the length of the series, lines `40 / T` or more apart (and from zero and Nyquist's frequency) do not
/// know of each other; down to `8 / T` they are separated by the fit, at the price of digits; nearer ones are taken as one
/// line. Lines below `least` are left in the series and shift a stronger one within `40 / T` by up to
/// `6 / T` times the ratio of the amplitudes: ask for weaker lines than are wanted. For a series that is a sum of lines
/// the error of a frequency is below 1e-9 for amplitudes from 1 to 1e-6, at `T = 4000`, whatever the phases; see
/// [`SpectralLine::uncertainty`].
///
/// # Errors
/// [`Error::Domain`] for a series that has no spectrum (too short, not finite), and for a `least` that is not above zero;
/// [`Error::NotConverged`] if two lines cannot be told apart.
pub fn spectral_lines(series: &Series, least: f64, most: usize) -> Result<LineList, Error> {
    series.check()?;
    Error::unless(least > 0.0 && least.is_finite(), "least amplitude", least, "above zero and finite")?;
    let weights = WINDOW.weights(series.values.len())?;
    let mut fit = JointFit::new(&series.values, &weights, WINDOW)?;
    let mut spectrum = ResidualSpectrum::of(&fit.residual(), &weights);
    while fit.waves.len() < most {
        let peaks = spectrum.peaks(least, &fit.waves);
        let room = most - fit.waves.len();
        fit.waves.extend(peaks.iter().take(room));
        if peaks.is_empty() {
            break;
        }
        improve(&mut fit, STEPS.0)?;
        spectrum = ResidualSpectrum::of(&fit.residual(), &weights);
    }
    improve(&mut fit, STEPS.1)?;
    spectrum = ResidualSpectrum::of(&fit.residual(), &weights);
    // The values are rounded, and so are the times for which they were computed: independently, but near each line.
    let largest = series.values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let latest = series.start.abs().max((series.start + series.duration()).abs());
    let turned = fit.waves.iter().fold(0.0_f64, |most, wave| most.max(wave.phase)) * 2.0 / series.step * latest;
    let rounding = f64::EPSILON * largest * (1.0 + turned / (series.values.len() as f64).sqrt());
    let noise = rounding.max(spectrum.median());
    let middle = series.start + series.step * (series.values.len() - 1) as f64 / 2.0;
    let mut lines: Vec<_> = fit
        .waves
        .iter()
        .zip(fit.amplification()?)
        .filter(|(wave, _)| wave.amplitude() >= least)
        .map(|(wave, amplification)| {
            let frequency = wave.phase * 2.0 / series.step;
            let shift = spectrum.shift_of(wave) + noise * amplification;
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
    Ok(LineList { constant: fit.constant, lines, remainder: spectrum.largest() })
}

/// Steps of the fit until no frequency moves by more than rounding.
fn improve(fit: &mut JointFit<'_>, steps: usize) -> Result<(), Error> {
    for _ in 0..steps {
        let residual = fit.residual();
        if fit.improve(&residual, LEAST_DISTANCE / 2.0)? < 1e-13 {
            break;
        }
    }
    Ok(())
}

/// Spectrum of what a fit leaves of a series, on a fine grid.
struct ResidualSpectrum {
    /// Parts along cosine and sine about the middle of the series.
    parts: Vec<(f64, f64)>,
    amplitudes: Vec<f64>,
    /// Number of samples.
    count: usize,
}

impl ResidualSpectrum {
    fn of(residual: &[f64], weights: &[f64]) -> Self {
        let count = residual.len();
        let mut padded: Vec<f64> = residual.iter().zip(weights).map(|(r, w)| r * w * 2.0 / count as f64).collect();
        padded.resize(PADDING * count, 0.0);
        let parts: Vec<(f64, f64)> = transform(padded)
            .iter()
            .enumerate()
            .map(|(index, z)| {
                // From the phase at the first sample to that in the middle.
                let (sin, cos) = (Self::phase_of(count, index as f64) * (count - 1) as f64).sin_cos();
                (z.re * cos - z.im * sin, -(z.re * sin + z.im * cos))
            })
            .collect();
        let amplitudes = parts.iter().map(|(c, s)| c.hypot(*s)).collect();
        Self { parts, amplitudes, count }
    }

    /// Phase per half step at a place on the grid.
    fn phase_of(count: usize, index: f64) -> f64 {
        PI * index / (PADDING * count) as f64
    }

    /// Waves at the peaks above `least`, far enough from each other and from the waves already there.
    fn peaks(&self, least: f64, waves: &[Wave]) -> Vec<Wave> {
        let a = &self.amplitudes;
        let mut tops: Vec<usize> =
            (1..a.len() - 1).filter(|&i| a[i] >= least && a[i] >= a[i - 1] && a[i] > a[i + 1]).collect();
        tops.sort_by(|&i, &j| a[j].total_cmp(&a[i]));
        let highest = tops.first().map_or(0.0, |&i| a[i]);
        let distance = |one: f64, other: f64| (one - other).abs() * self.count as f64;
        let mut taken: Vec<Wave> = Vec::new();
        for &i in tops.iter().take_while(|&&i| a[i] >= ROUND * highest) {
            // The top of a parabola through three logarithms: exact for the nearly Gaussian line.
            let [low, top, high] = [a[i - 1], a[i], a[i + 1]].map(|x| x.max(f64::MIN_POSITIVE).ln());
            let shift = 0.5 * (low - high) / (low - 2.0 * top + high);
            let phase = Self::phase_of(self.count, i as f64 + if shift.abs() <= 1.0 { shift } else { 0.0 });
            let clear_of_ends = distance(phase, 0.0).min(distance(phase, PI / 2.0)) >= LEAST_DISTANCE;
            let clear_of_waves = waves.iter().all(|wave| distance(phase, wave.phase) >= LEAST_DISTANCE);
            let clear_of_peaks = taken.iter().all(|wave| distance(phase, wave.phase) >= 1.5 * SHAPE);
            if clear_of_ends && clear_of_waves && clear_of_peaks {
                let (cos_part, sin_part) = self.parts[i];
                taken.push(Wave { phase, cos_part, sin_part });
            }
        }
        taken
    }

    /// Estimated shift of the frequency of a wave, times half the length of the series, by lines left in the spectrum: each, of the
    /// amplitude `a` at the distance `d`, shifts by `(a / amplitude) d exp(-d^2 / (2 shape))`, the slope of the line at its place. One within
    /// the width of the line counts as if it stood where that is largest: the fit hides it in part.
    fn shift_of(&self, wave: &Wave) -> f64 {
        let a = &self.amplitudes;
        let per_index = Self::phase_of(self.count, 1.0) * self.count as f64;
        let place = wave.phase * self.count as f64 / per_index;
        let reach = 2.0 * SHAPE.hypot(PI) / per_index;
        let first = (place - reach).floor().max(1.0) as usize;
        let last = ((place + reach).ceil() as usize).min(a.len() - 2);
        let tops = (first..=last).filter(|&i| a[i] >= a[i - 1] && a[i] > a[i + 1]);
        let shifts = tops.map(|i| {
            let distance = ((i as f64 - place) * per_index).abs().max(SHAPE.sqrt());
            // Between the main lobe and the sidelobes the Gaussian falls too far.
            a[i] * distance * (-distance * distance / (2.0 * SHAPE)).exp().max(SIDELOBES)
        });
        shifts.sum::<f64>() / wave.amplitude()
    }

    /// Median of the amplitudes: the noise, unless lines crowd the whole spectrum.
    fn median(&self) -> f64 {
        let mut sorted = self.amplitudes.clone();
        let middle = sorted.len() / 2;
        *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Largest amplitude above frequency zero.
    fn largest(&self) -> f64 {
        self.amplitudes[1..].iter().fold(0.0, |most, &x| most.max(x))
    }
}
