//! Functions on the torus as Fourier series of its two angles.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// The effect of a reflection in the plane on a function: `f(-theta) = f(theta)` or `-f(theta)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reflection {
    Even,
    Odd,
}

/// Values of a function on a grid of the torus: at all `points` of the first angle, and for the second one at those of its first quarter turn,
/// `0..=quarter` of `4 quarter` points. The others follow by symmetry.
#[derive(Debug, Clone)]
pub(super) struct QuarterGrid {
    pub(super) points: usize,
    pub(super) quarter: usize,
}

/// Coefficients of one function for one multiple `j` of the first angle, by multiples `k` of the second: for an even function those of
/// `cos j theta_1 cos k theta_2` and `sin j theta_1 sin k theta_2`, for an odd one of `sin cos` and `cos sin`.
pub(super) type Pair = [f64; 2];

impl QuarterGrid {
    /// Coefficients of a function for all `j` up to half of the points, and `k = parity, parity + 2, ...`, where half a turn of the second angle
    /// multiplies the function by `(-1)^parity`. `values[m]` are those at the point `m` of the second angle.
    pub(super) fn coefficients(&self, values: &[Vec<f64>], reflection: Reflection, parity: usize) -> Vec<Vec<Pair>> {
        let Self { points, quarter } = *self;
        let plan = FftPlanner::new().plan_fft_forward(points);
        let multiples = quarter - usize::from(parity == 1) + 1;
        let count = points / 2;
        let mut table = vec![vec![[0.0; 2]; multiples]; count];
        let whole = 4 * quarter;
        let turns: Vec<(f64, f64)> =
            (0..whole).map(|q| (core::f64::consts::TAU * q as f64 / whole as f64).sin_cos()).collect();
        for (m, values) in values.iter().enumerate() {
            let mut output: Vec<Complex<f64>> = values.iter().map(Complex::from).collect();
            plan.process(&mut output);
            // Ends of the quarter count once, other points twice because of their mirror images, and all twice because of
            // the half turn.
            let weight = if m == 0 || m == quarter { 2.0 } else { 4.0 } / (points * whole) as f64;
            for (j, row) in table.iter_mut().enumerate() {
                let weight = if j == 0 { weight } else { 2.0 * weight };
                let (cos, sin) = (output[j].re * weight, -output[j].im * weight);
                let (of_cos, of_sin) = match reflection {
                    Reflection::Even => (cos, sin),
                    Reflection::Odd => (sin, cos),
                };
                for (i, pair) in row.iter_mut().enumerate() {
                    let k = 2 * i + parity;
                    let (sin, cos) = turns[k * m % whole];
                    let twice = if k == 0 { 1.0 } else { 2.0 };
                    pair[0] += twice * of_cos * cos;
                    pair[1] += twice * of_sin * sin;
                }
            }
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    /// A series summed on the grid is recovered.
    #[test]
    fn coefficients_of_a_sum_are_its_own() {
        let grid = QuarterGrid { points: 12, quarter: 4 };
        for (reflection, parity) in
            [(Reflection::Even, 0), (Reflection::Even, 1), (Reflection::Odd, 0), (Reflection::Odd, 1)]
        {
            let wanted = |j: usize, k: usize| {
                let sines = match reflection {
                    Reflection::Even => j > 0 && k > 0,
                    Reflection::Odd => k > 0,
                };
                let cosines = reflection == Reflection::Even || j > 0;
                let size = 1.0 / (1.0 + j as f64 + 3.0 * k as f64);
                [if cosines { size } else { 0.0 }, if sines { -0.3 * size } else { 0.0 }]
            };
            let multiples = || (0..4).flat_map(|j| (0..3).map(move |i| (j, 2 * i + parity)));
            let value = |a: f64, b: f64| {
                multiples()
                    .map(|(j, k)| {
                        let [p, q] = wanted(j, k);
                        let ((sj, cj), (sk, ck)) = ((j as f64 * a).sin_cos(), (k as f64 * b).sin_cos());
                        match reflection {
                            Reflection::Even => p * cj * ck + q * sj * sk,
                            Reflection::Odd => p * sj * ck + q * cj * sk,
                        }
                    })
                    .sum::<f64>()
            };
            let values: Vec<Vec<f64>> = (0..=4)
                .map(|m| (0..12).map(|j| value(TAU * f64::from(j) / 12.0, TAU * f64::from(m) / 16.0)).collect())
                .collect();
            let found = grid.coefficients(&values, reflection, parity);
            for (j, k) in multiples() {
                let (found, wanted) = (found[j][(k - parity) / 2], wanted(j, k));
                assert!((0..2).all(|i| (found[i] - wanted[i]).abs() < 1e-15), "{j} {k}: {found:?} {wanted:?}");
            }
        }
    }
}
