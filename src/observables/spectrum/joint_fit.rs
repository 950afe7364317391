//! Weighted least squares for a constant and any number of real waves together, frequencies included.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::error::Error;
use crate::rounding::two_product;

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

    /// One step of Gauss and Newton in all unknowns; the largest change of a frequency, times half the length of the series.
    ///
    /// The unknowns of a wave are its two parts and its frequency, with `y = m / N`:
    /// `u = cos(f y)`, `v = sin(f y)`, `d = (-cos_part y sin(f y) + sin_part y cos(f y)) / amplitude`.
    pub(super) fn improve(&mut self, residual: &[f64], longest: f64) -> Result<f64, Error> {
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
        Ok(largest)
    }

    /// How much an error of the projections is amplified in each frequency (times half the length): `sqrt(2 shape) / amplitude` for a
    /// line alone, more for close ones.
    pub(super) fn amplification(&self) -> Result<Vec<f64>, Error> {
        let inverse = self.factors(self.values.len() as f64)?.inverse();
        let of = |(k, wave): (usize, &Wave)| inverse[(3 + 3 * k, 3 + 3 * k)].sqrt() / wave.amplitude();
        Ok(self.waves.iter().enumerate().map(of).collect())
    }

    fn factors(&self, count: f64) -> Result<Cholesky<f64, Dyn>, Error> {
        self.normal_matrix(count).cholesky().ok_or_else(|| {
            let apart = |(k, wave): (usize, &Wave)| {
                let others = self.waves[k + 1..].iter().map(|other| (wave.phase - other.phase).abs() * count);
                others.fold(wave.phase.abs() * count, f64::min)
            };
            Error::NotConverged {
                what: "lines of a spectrum (the residual is the least distance of two, times T / 2)",
                iterations: self.waves.len(),
                residual: self.waves.iter().enumerate().map(apart).fold(f64::INFINITY, f64::min),
            }
        })
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
