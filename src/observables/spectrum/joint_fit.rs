//! Weighted least squares for a constant and several sinusoids together, frequencies included.

use core::f64::consts::FRAC_PI_2;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::error::Error;
use crate::numerics::rounding::two_product;

/// Cells in which the window is summed for products of two waves: exact for smooth weights up to frequencies far above
/// those at which the products vanish.
const CELLS: usize = 64;

/// Samples whose phases follow from one exact phase by products: keeps rounding from adding up.
const BLOCK: usize = 64;

/// `cos_part cos(phase m) + sin_part sin(phase m)` at `m = 2 j + 1 - N`, the number of half steps from the middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wave {
    /// Phase per half step.
    pub(super) phase: f64,
    pub(super) cos_part: f64,
    pub(super) sin_part: f64,
}

impl Wave {
    pub(super) fn amplitude(&self) -> f64 {
        self.cos_part.hypot(self.sin_part)
    }
}

/// A constant and waves that approach a series.
#[derive(Debug, Clone)]
pub(super) struct JointFit<'s> {
    values: &'s [f64],
    /// Weights of mean one.
    weights: &'s [f64],
    /// Place and share of the weight in each cell of the window.
    cells: Vec<(f64, f64)>,
    pub(super) constant: f64,
    pub(super) waves: Vec<Wave>,
}

impl<'s> JointFit<'s> {
    pub(super) fn new(values: &'s [f64], weights: &'s [f64], window: super::Window) -> Result<Self, Error> {
        let shares = window.weights(CELLS)?;
        let place = |i: usize| (2 * i + 1) as f64 / CELLS as f64 - 1.0;
        let cells = shares.iter().enumerate().map(|(i, share)| (place(i), share / CELLS as f64)).collect();
        let constant = values.iter().zip(weights).map(|(x, w)| x * w).sum::<f64>() / values.len() as f64;
        Ok(Self { values, weights, cells, constant, waves: Vec::new() })
    }

    /// Series minus fit.
    pub(super) fn residual(&self) -> Vec<f64> {
        let mut residual: Vec<f64> = self.values.iter().map(|x| x - self.constant).collect();
        for wave in &self.waves {
            each_phase(wave.phase, self.values.len(), |j, sin, cos| {
                residual[j] -= wave.cos_part * cos + wave.sin_part * sin;
            });
        }
        residual
    }

    /// Weighted mean square of what is left.
    pub(super) fn power(&self, residual: &[f64]) -> f64 {
        let squares = residual.iter().zip(self.weights).map(|(r, w)| r * r * w);
        squares.sum::<f64>() / residual.len() as f64
    }

    /// One step of Gauss and Newton in all unknowns; the largest change of a frequency, times half the length of the series. None where the
    /// lines are no independent unknowns.
    ///
    /// The unknowns of a wave are its two parts and its frequency, with `y = m / N`:
    /// `u = cos(f y)`, `v = sin(f y)`, `d = (-cos_part y sin(f y) + sin_part y cos(f y)) / amplitude`.
    pub(super) fn improve(&mut self, residual: &[f64], longest: f64) -> Option<f64> {
        let count = residual.len() as f64;
        let unknowns = 1 + 3 * self.waves.len();
        let weighted: Vec<f64> = residual.iter().zip(self.weights).map(|(r, w)| r * w / count).collect();
        let mut right = DVector::zeros(unknowns);
        right[0] = weighted.iter().sum();
        for (k, wave) in self.waves.iter().enumerate() {
            let [mut u, mut v, mut yu, mut yv] = [0.0; 4];
            each_phase(wave.phase, residual.len(), |j, sin, cos| {
                let (y, r) = ((2 * j + 1) as f64 / count - 1.0, weighted[j]);
                let (by_cos, by_sin) = (r * cos, r * sin);
                (u, v, yu, yv) = (u + by_cos, v + by_sin, yu + y * by_cos, yv + y * by_sin);
            });
            let (c, s) = self.direction(k);
            [right[1 + 3 * k], right[2 + 3 * k], right[3 + 3 * k]] = [u, v, s * yu - c * yv];
        }
        let step = self.factors(count)?.solve(&right);
        self.constant += step[0];
        let mut largest = 0.0_f64;
        for (k, wave) in self.waves.iter_mut().enumerate() {
            let change = step[3 + 3 * k] / wave.amplitude();
            largest = if change.is_nan() { f64::NAN } else { largest.max(change.abs()) };
            wave.phase += change.clamp(-longest, longest) / count;
            wave.cos_part += step[1 + 3 * k];
            wave.sin_part += step[2 + 3 * k];
        }
        Some(largest)
    }

    /// How much an error of the projections is amplified in each frequency (times half the length): `sqrt(2 shape) / amplitude` for a
    /// line alone, more for close ones; none as for a step.
    pub(super) fn amplification(&self) -> Option<Vec<f64>> {
        let inverse = self.factors(self.values.len() as f64)?.inverse();
        let of = |(k, wave): (usize, &Wave)| inverse[(3 + 3 * k, 3 + 3 * k)].sqrt() / wave.amplitude();
        Some(self.waves.iter().enumerate().map(of).collect())
    }

    fn factors(&self, count: f64) -> Option<Cholesky<f64, Dyn>> {
        self.normal_matrix(count).cholesky()
    }

    /// Least distance of two lines, or of one from zero or Nyquist's frequency, times half the length of the series; not above zero for a line
    /// outside of these.
    pub(super) fn least_distance(&self) -> f64 {
        let apart = |(k, wave): (usize, &Wave)| {
            let others = self.waves[k + 1..].iter().map(|other| (wave.phase - other.phase).abs());
            others.fold(wave.phase.min(FRAC_PI_2 - wave.phase), f64::min)
        };
        self.waves.iter().enumerate().map(apart).fold(f64::INFINITY, f64::min) * self.values.len() as f64
    }

    fn direction(&self, k: usize) -> (f64, f64) {
        let (wave, amplitude) = (&self.waves[k], self.waves[k].amplitude());
        (wave.cos_part / amplitude, wave.sin_part / amplitude)
    }

    /// Weighted products of all pairs of basis functions. Cosines are even about the middle and sines odd, so that only the
    /// products of equal parity are not zero.
    fn normal_matrix(&self, count: f64) -> DMatrix<f64> {
        let waves = &self.waves;
        let mut matrix = DMatrix::zeros(1 + 3 * waves.len(), 1 + 3 * waves.len());
        matrix[(0, 0)] = 1.0;
        for (j, first) in waves.iter().enumerate() {
            let (c1, s1) = self.direction(j);
            let own = self.moments(first.phase * count);
            let with_constant = [own.even, 0.0, -c1 * own.odd];
            for (k, second) in waves.iter().enumerate().skip(j) {
                let (c2, s2) = self.direction(k);
                let near = self.moments((first.phase - second.phase) * count);
                let far = self.moments((first.phase + second.phase) * count);
                // Products of u and d: cos_j y sin_k and sin_j y cos_k.
                let cos_y_sin = |sign: f64| (far.odd - sign * near.odd) / 2.0;
                let sin_y_cos = |sign: f64| (far.odd + sign * near.odd) / 2.0;
                let block = [
                    [(near.even + far.even) / 2.0, 0.0, -c2 * cos_y_sin(1.0)],
                    [0.0, (near.even - far.even) / 2.0, s2 * sin_y_cos(1.0)],
                    [
                        -c1 * cos_y_sin(-1.0),
                        s1 * sin_y_cos(-1.0),
                        (c1 * c2 * (near.second - far.second) + s1 * s2 * (near.second + far.second)) / 2.0,
                    ],
                ];
                for (row, entries) in block.iter().enumerate() {
                    for (column, &entry) in entries.iter().enumerate() {
                        matrix[(1 + 3 * j + row, 1 + 3 * k + column)] = entry;
                        matrix[(1 + 3 * k + column, 1 + 3 * j + row)] = entry;
                    }
                }
            }
            for (row, &entry) in with_constant.iter().enumerate() {
                matrix[(1 + 3 * j + row, 0)] = entry;
                matrix[(0, 1 + 3 * j + row)] = entry;
            }
        }
        matrix
    }

    /// Weighted means of `cos(f y)`, `y sin(f y)`, `y^2 cos(f y)`; zero where the window has them below rounding.
    fn moments(&self, f: f64) -> Moments {
        let mut moments = Moments { even: 0.0, odd: 0.0, second: 0.0 };
        if f.abs() < CELLS as f64 {
            for &(y, share) in &self.cells {
                let (sin, cos) = (f * y).sin_cos();
                moments.even += share * cos;
                moments.odd += share * y * sin;
                moments.second += share * y * y * cos;
            }
        }
        moments
    }
}

struct Moments {
    even: f64,
    odd: f64,
    second: f64,
}

/// Calls `see(j, sin, cos)` with the phases `phase (2 j + 1 - count)`.
fn each_phase(phase: f64, count: usize, mut see: impl FnMut(usize, f64, f64)) {
    let offsets: [(f64, f64); BLOCK] = core::array::from_fn(|k| (phase * (2 * k) as f64).sin_cos());
    for start in (0..count).step_by(BLOCK) {
        let (product, lost) = two_product(phase, (2 * start + 1) as f64 - count as f64);
        let (sin, cos) = product.sin_cos();
        let (sin, cos) = (sin + lost * cos, cos - lost * sin);
        for (k, (s, c)) in offsets.iter().enumerate().take(count - start) {
            see(start + k, sin * c + cos * s, cos * c - sin * s);
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::super::Window;
    use super::*;

    const WINDOW: Window = Window::Kaiser { shape: 20.0 };
    const COUNT: usize = 4096;

    fn waves(of: &[(f64, f64, f64)]) -> Vec<Wave> {
        of.iter().map(|&(place, cos_part, sin_part)| Wave { phase: place / COUNT as f64, cos_part, sin_part }).collect()
    }

    fn value(constant: f64, waves: &[Wave], j: usize) -> f64 {
        let m = (2 * j + 1) as f64 - COUNT as f64;
        let wave = |w: &Wave| w.cos_part * (w.phase * m).cos() + w.sin_part * (w.phase * m).sin();
        constant + waves.iter().map(wave).sum::<f64>()
    }

    fn fit<'a>(values: &'a [f64], weights: &'a [f64], waves: Vec<Wave>) -> JointFit<'a> {
        JointFit { waves, ..JointFit::new(values, weights, WINDOW).unwrap() }
    }

    #[test]
    fn the_matrix_has_the_products_of_the_basis() {
        let weights = WINDOW.weights(COUNT).unwrap();
        let values = vec![0.0; COUNT];
        let waves = waves(&[(9.0, 0.3, 0.8), (17.5, -0.6, 0.1), (31.0, 0.2, -0.9)]);
        let fit = fit(&values, &weights, waves.clone());
        let found = fit.normal_matrix(COUNT as f64);
        let mut expected = DMatrix::zeros(10, 10);
        for (j, weight) in weights.iter().enumerate() {
            let y = (2 * j + 1) as f64 / COUNT as f64 - 1.0;
            let mut basis = DVector::from_element(10, 1.0);
            for (k, wave) in waves.iter().enumerate() {
                let (sin, cos) = (wave.phase * COUNT as f64 * y).sin_cos();
                let along = (wave.sin_part * cos - wave.cos_part * sin) * y / wave.amplitude();
                (basis[1 + 3 * k], basis[2 + 3 * k], basis[3 + 3 * k]) = (cos, sin, along);
            }
            expected += &basis * basis.transpose() * (weight / COUNT as f64);
        }
        // The edges of the window are 2e-8 of its middle.
        assert!((&found - &expected).amax() < 1e-7, "{found} {expected}");
        // A line alone: its frequency is as certain as the second moment of the window, of the width 1 / sqrt(40), says.
        let alone = fit_of_one(&values, &weights).amplification().unwrap();
        assert_relative_eq!(alone[0], 40.0_f64.sqrt() / 5.0, max_relative = 0.03);
        let three = fit.amplification().unwrap();
        for (wave, found) in waves.iter().zip(&three) {
            assert!(*found > 40.0_f64.sqrt() / wave.amplitude());
        }
        let inverse = expected.try_inverse().unwrap();
        for (k, wave) in waves.iter().enumerate() {
            let exact = inverse[(3 + 3 * k, 3 + 3 * k)].sqrt() / wave.amplitude();
            assert_relative_eq!(three[k], exact, max_relative = 1e-4);
        }
    }

    fn fit_of_one<'a>(values: &'a [f64], weights: &'a [f64]) -> JointFit<'a> {
        fit(values, weights, waves(&[(200.0, 3.0, -4.0)]))
    }

    #[test]
    fn a_frequency_moves_no_farther_than_allowed() {
        let weights = WINDOW.weights(COUNT).unwrap();
        let exact = waves(&[(200.0, 3.0, -4.0)]);
        let values: Vec<f64> = (0..COUNT).map(|j| value(0.0, &exact, j)).collect();
        for (place, allowed, moved) in [(200.3, 0.1, -0.1), (199.7, 0.1, 0.1), (200.01, 0.1, -0.01)] {
            let start = Wave { phase: place / COUNT as f64, ..exact[0] };
            let mut fit = fit(&values, &weights, vec![start]);
            let change = fit.improve(&fit.residual(), allowed).unwrap();
            assert_relative_eq!(change, (place - 200.0_f64).abs(), max_relative = 0.05);
            assert_relative_eq!((fit.waves[0].phase - start.phase) * COUNT as f64, moved, max_relative = 0.01);
        }
    }

    #[test]
    fn the_least_distance_is_that_of_two_lines_or_of_one_from_an_end() {
        let (values, weights) = (vec![0.0; COUNT], vec![1.0; COUNT]);
        let least = |of: &[(f64, f64, f64)]| fit(&values, &weights, waves(of)).least_distance();
        let highest = FRAC_PI_2 * COUNT as f64;
        for (places, distance) in [
            (&[30.0, 55.0, 37.5][..], 7.5),
            (&[30.0, 5.0], 5.0),
            (&[6.0, 50.0], 6.0),
            (&[-6.0, 50.0], -6.0),
            (&[40.0, highest - 3.0], 3.0),
            (&[40.0, highest + 3.0], -3.0),
        ] {
            let waves: Vec<_> = places.iter().map(|&place| (place, 1.0, 0.0)).collect();
            assert_relative_eq!(least(&waves), distance, max_relative = 1e-11);
        }
        assert_eq!(least(&[]), f64::INFINITY);
    }

    #[test]
    fn lines_without_a_direction_are_no_unknowns() {
        let (values, weights) = (vec![0.0; COUNT], WINDOW.weights(COUNT).unwrap());
        let none = waves(&[(30.0, 1.0, 0.0), (55.0, 0.0, 0.0)]);
        assert!(fit(&values, &weights, none.clone()).amplification().is_none());
        assert!(fit(&values, &weights, none).improve(&values, 2.0).is_none());
        let same = waves(&[(30.0, 1.0, 0.0), (30.0, 1.0, 0.0)]);
        assert!(fit(&values, &weights, same).amplification().is_none());
    }

    #[test]
    fn phases_are_exact_however_many() {
        for (phase, count) in [(0.7341, 20_001), (1.5702, 30_000), (1e-4, 100)] {
            let mut seen = 0;
            each_phase(phase, count, |j, sin, cos| {
                assert_eq!(j, seen);
                seen += 1;
                let m = (2 * j + 1) as f64 - count as f64;
                let product = phase * m;
                let lost = phase.mul_add(m, -product);
                let (s, c) = product.sin_cos();
                let error = (sin - (s + lost * c)).abs().max((cos - (c - lost * s)).abs());
                assert!(error < 3e-14, "{phase} {j}: {error:e}");
            });
            assert_eq!(seen, count);
        }
    }

    #[test]
    fn products_vanish_beyond_the_last_frequency_that_is_summed() {
        let (values, weights) = (vec![0.0; COUNT], WINDOW.weights(COUNT).unwrap());
        let fit = fit(&values, &weights, Vec::new());
        let largest = |f: f64| {
            let Moments { even, odd, second } = fit.moments(f);
            even.abs().max(odd.abs()).max(second.abs())
        };
        for sign in [1.0, -1.0] {
            // The largest sidelobe of the window is 1.8e-8.
            assert!((1e-12..3e-8).contains(&largest(63.5 * sign)), "{:e}", largest(63.5 * sign));
            assert_eq!(largest(64.5 * sign), 0.0);
        }
    }
}
