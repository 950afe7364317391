//! Spectrum of the residuals of a fit: where further lines are, and how far they shift those found.

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

    /// Waves at the peaks above `least`, far enough from each other and from the waves already there, and out of reach of those refused: what is
    /// near them is left by lines that cannot be told apart, and is no line.
    pub(super) fn peaks(&self, least: f64, waves: &[Wave], refused: &[Wave]) -> Vec<Wave> {
        let a = &self.amplitudes;
        let mut tops: Vec<usize> =
            (1..a.len() - 1).filter(|&i| a[i] >= least && a[i] >= a[i - 1] && a[i] > a[i + 1]).collect();
        tops.sort_by(|&i, &j| a[j].total_cmp(&a[i]));
        let highest = tops.first().map_or(0.0, |&i| a[i]);
        let distance = |one: f64, other: f64| (one - other).abs() * self.count as f64;
        let mut taken: Vec<Wave> = Vec::new();
        for &i in tops.iter().take_while(|&&i| a[i] >= ROUND * highest) {
            // The top of a parabola through three logarithms: exact for the nearly Gaussian line, within half a point, and none where all
            // three are below the smallest normal number.
            let [low, top, high] = [a[i - 1], a[i], a[i + 1]].map(|x| x.max(f64::MIN_POSITIVE).ln());
            let shift = 0.5 * (low - high) / (low - 2.0 * top + high);
            let phase = Self::phase_of(self.count, i as f64 + if shift.is_finite() { shift } else { 0.0 });
            let clear_of_ends = distance(phase, 0.0).min(distance(phase, PI / 2.0)) >= LEAST_DISTANCE;
            let clear_of_waves = waves.iter().all(|wave| distance(phase, wave.phase) >= LEAST_DISTANCE);
            let clear_of_peaks = taken.iter().all(|wave| distance(phase, wave.phase) >= 1.5 * SHAPE);
            let clear_of_refused = refused.iter().all(|wave| distance(phase, wave.phase) >= SHAPE.hypot(PI));
            if clear_of_ends && clear_of_waves && clear_of_peaks && clear_of_refused {
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

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::super::Window;
    use super::*;

    const COUNT: usize = 240;

    /// A place on the axis of `phase N`, on which the grid has the spacing pi / 2 and the window's lines the half width 20.2.
    fn at(place: f64, cos_part: f64, sin_part: f64) -> Wave {
        Wave { phase: place / COUNT as f64, cos_part, sin_part }
    }

    fn place(wave: &Wave) -> f64 {
        wave.phase * COUNT as f64
    }

    /// A spectrum with these amplitudes at and beside some points, nothing elsewhere.
    fn with_tops(tops: &[(usize, [f64; 3])]) -> ResidualSpectrum {
        let mut amplitudes = vec![0.0; COUNT + 1];
        for (index, three) in tops {
            amplitudes[index - 1..=index + 1].copy_from_slice(three);
        }
        let parts = amplitudes.iter().map(|a| (0.6 * a, -0.8 * a)).collect();
        ResidualSpectrum { parts, amplitudes, count: COUNT }
    }

    #[test]
    fn parts_are_sums_about_the_middle() {
        let weights = Window::Kaiser { shape: 20.0 }.weights(COUNT).unwrap();
        let values: Vec<f64> =
            (0..COUNT).map(|j| (0.37 * j as f64).cos() + 0.2 * (1.9 * j as f64 + 0.4).sin()).collect();
        let spectrum = ResidualSpectrum::of(&values, &weights);
        assert_eq!(spectrum.parts.len(), COUNT + 1);
        for index in [0, 1, 13, 57, 145, COUNT] {
            let phase = PI * index as f64 / (2 * COUNT) as f64;
            let (mut cos_part, mut sin_part) = (0.0, 0.0);
            for (j, (value, weight)) in values.iter().zip(&weights).enumerate() {
                let m = (2 * j + 1) as f64 - COUNT as f64;
                cos_part += 2.0 / COUNT as f64 * value * weight * (phase * m).cos();
                sin_part += 2.0 / COUNT as f64 * value * weight * (phase * m).sin();
            }
            let (found_cos, found_sin) = spectrum.parts[index];
            assert!((found_cos - cos_part).abs().max((found_sin - sin_part).abs()) < 1e-14, "{index}");
            assert_relative_eq!(spectrum.amplitudes[index], cos_part.hypot(sin_part), epsilon = 1e-14);
        }
    }

    #[test]
    fn peaks_are_the_tops_of_parabolas_through_logarithms() {
        let spectrum = with_tops(&[
            (60, [0.3, 1.0, 0.5]),
            (100, [0.02, 0.05, 0.01]),
            (160, [0.0, 0.4, 0.4]),
            (190, [0.0, 2e-3, 0.0]),
        ]);
        let peaks = spectrum.peaks(1e-9, &[], &[]);
        let shift = |[low, top, high]: [f64; 3]| {
            let [low, top, high] = [low, top, high].map(|x| x.max(f64::MIN_POSITIVE).ln());
            (low - high) / (2.0 * (low + high - 2.0 * top))
        };
        // The second of two that are equal is the top.
        let expected = [
            (60.0 + shift([0.3, 1.0, 0.5]), 1.0),
            (161.0 + shift([0.4, 0.4, 0.0]), 0.4),
            (100.0 + shift([0.02, 0.05, 0.01]), 0.05),
            (190.0, 2e-3),
        ];
        assert_eq!(peaks.len(), expected.len());
        for (peak, (index, amplitude)) in peaks.iter().zip(expected) {
            assert_relative_eq!(place(peak), index * PI / 2.0, max_relative = 1e-14);
            assert_eq!((peak.cos_part, peak.sin_part), (0.6 * amplitude, -0.8 * amplitude));
        }
        // Three logarithms of numbers below the smallest normal one are equal.
        let tiny = with_tops(&[(60, [0.0, 1e-310, 1e-311])]).peaks(1e-312, &[], &[]);
        assert_eq!((tiny.len(), place(&tiny[0])), (1, 60.0 * PI / 2.0));
        assert_eq!(spectrum.peaks(0.05, &[], &[]).len(), 3);
        assert_eq!(spectrum.peaks(0.051, &[], &[]).len(), 2);
    }

    #[test]
    fn peaks_keep_their_distance() {
        let one = |index| with_tops(&[(index, [0.1, 1.0, 0.1])]);
        let count = |spectrum: &ResidualSpectrum, waves: &[Wave]| spectrum.peaks(1e-9, waves, &[]).len();
        // From the ends of the spectrum, 4 at least.
        for (index, found) in [(2, 0), (3, 1), (COUNT - 3, 1), (COUNT - 2, 0)] {
            assert_eq!(count(&one(index), &[]), found, "{index}");
        }
        // From waves that are there.
        for (distance, found) in [(-4.1, 1), (-3.9, 0), (0.1, 0), (3.9, 0), (4.1, 1)] {
            let wave = at(100.0 * PI / 2.0 + distance, 1.0, 0.0);
            assert_eq!(count(&one(100), &[wave]), found, "{distance}");
            assert_eq!(count(&one(100), &[at(300.0, 1.0, 0.0), wave]), found, "{distance}");
        }
        // From what was refused, as far as a line reaches.
        for (distance, found) in [(-20.3, 1), (-20.2, 0), (0.1, 0), (20.2, 0), (20.3, 1)] {
            let refused = at(100.0 * PI / 2.0 + distance, 1.0, 0.0);
            assert_eq!(one(100).peaks(1e-9, &[], &[refused]).len(), found, "{distance}");
        }
        // From higher peaks, 30 at least; and no more than a thousand below the highest.
        for (index, amplitude, found) in
            [(119, 0.5, 1), (120, 0.5, 2), (81, 0.5, 1), (80, 0.5, 2), (140, 1.01e-3, 2), (140, 0.99e-3, 1)]
        {
            let both = with_tops(&[(100, [0.1, 1.0, 0.1]), (index, [0.0, amplitude, 0.0])]);
            assert_eq!(count(&both, &[]), found, "{index} {amplitude}");
        }
        // The highest may be too near to an end to be a line itself; beyond the last point but one there is none.
        for (index, found) in [(1, 0), (COUNT - 1, 0)] {
            let both = with_tops(&[(100, [0.0, 0.99e-3, 0.0]), (index, [0.0, 1.0, 0.0])]);
            assert_eq!(count(&both, &[]), found, "{index}");
        }
        let mut rising = one(100);
        rising.amplitudes[COUNT] = 2e3;
        assert_eq!(count(&rising, &[]), 1);
    }

    #[test]
    fn what_is_left_near_a_line_shifts_it_by_the_slope_of_the_line() {
        let wave = at(100.3 * PI / 2.0, 3.0, -4.0);
        let shift = |indices: &[usize]| {
            let tops: Vec<_> = indices.iter().map(|&index| (index, [0.0, 0.7, 0.1])).collect();
            with_tops(&tops).shift_of(&wave)
        };
        let slope = |index: f64| {
            let distance = ((index - 100.3) * PI / 2.0).abs().max(20.0_f64.sqrt());
            0.7 / 5.0 * distance * (-distance * distance / 40.0).exp().max(1.8e-8)
        };
        // Within the width of the line as at its inflection, then by the slope, then by the sidelobes as far as 40.5.
        for index in [99_usize, 100, 102, 96, 106, 115, 85, 122, 74, 127] {
            assert_relative_eq!(shift(&[index]), slope(index as f64), max_relative = 1e-12);
        }
        assert_eq!([73, 128, 200, 3].map(|index| shift(&[index])), [0.0; 4]);
        assert_relative_eq!(shift(&[90, 96, 104]), slope(90.0) + slope(96.0) + slope(104.0), max_relative = 1e-12);
        // What rises or falls without a top does not count.
        let slopes =
            with_tops(&[(96, [0.1, 0.2, 0.3]), (98, [0.3, 0.4, 0.5]), (100, [0.5, 0.6, 0.7]), (102, [0.7, 0.8, 0.2])]);
        assert_relative_eq!(slopes.shift_of(&wave), slope(102.0) * 0.8 / 0.7, max_relative = 1e-12);
        // A line as near to an end of the spectrum as its window reaches.
        for (index, top) in [(3.0, 1), (COUNT as f64 - 3.0, COUNT - 1)] {
            let found = with_tops(&[(top, [0.0, 0.7, 0.0])]).shift_of(&at(index * PI / 2.0, 0.0, 5.0));
            let distance = (PI / 2.0 * (top as f64 - index).abs()).max(20.0_f64.sqrt());
            assert_relative_eq!(
                found,
                0.7 / 5.0 * distance * (-distance * distance / 40.0).exp(),
                max_relative = 1e-12
            );
        }
    }

    #[test]
    fn the_median_is_of_all_and_the_largest_is_above_zero() {
        let amplitudes = vec![9.0, 1.0, 0.5, 3.0, 2.0];
        let spectrum = ResidualSpectrum { parts: Vec::new(), amplitudes, count: 4 };
        assert_eq!((spectrum.median(), spectrum.largest()), (2.0, 3.0));
        let falling = ResidualSpectrum { parts: Vec::new(), amplitudes: vec![9.0, 4.0, 0.5, 3.0, 2.0], count: 4 };
        assert_eq!(falling.largest(), 4.0);
    }
}
