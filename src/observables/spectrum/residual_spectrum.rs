//! Spectrum of what a fit leaves of a series: where further lines are, and how far what is left shifts those found.

use core::f64::consts::PI;

use super::amplitude::transform;
use super::joint_fit::Wave;

/// Shape of the window: lines reach no farther than 1.8e-8 of their amplitude beyond `40.5 / T`.
pub(super) const SHAPE: f64 = 20.0;

/// Least distance of two lines, and of a line from zero and from Nyquist's frequency, in units of `2 / T`.
pub(super) const LEAST_DISTANCE: f64 = 4.0;

/// The transform is this much finer than the series demands, so that a peak is near its highest point.
const PADDING: usize = 2;

/// Peaks taken in one round are within this ratio of the highest: their neighbours follow when it is gone.
const ROUND: f64 = 1e-3;

/// Largest sidelobe of that window.
const SIDELOBES: f64 = 1.8e-8;

/// Spectrum of what a fit leaves of a series, on a fine grid.
pub(super) struct ResidualSpectrum {
    /// Parts along cosine and sine about the middle of the series.
    parts: Vec<(f64, f64)>,
    amplitudes: Vec<f64>,
    /// Number of samples.
    count: usize,
}

impl ResidualSpectrum {
    pub(super) fn of(residual: &[f64], weights: &[f64]) -> Self {
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
    pub(super) fn peaks(&self, least: f64, waves: &[Wave]) -> Vec<Wave> {
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
    pub(super) fn shift_of(&self, wave: &Wave) -> f64 {
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
    pub(super) fn median(&self) -> f64 {
        let mut sorted = self.amplitudes.clone();
        let middle = sorted.len() / 2;
        *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Largest amplitude above frequency zero.
    pub(super) fn largest(&self) -> f64 {
        self.amplitudes[1..].iter().fold(0.0, |most, &x| most.max(x))
    }
}
