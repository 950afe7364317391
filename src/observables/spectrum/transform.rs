//! Fourier coefficients of a function on a torus of three angles.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Coefficients `c_m` of `sum_m c_m exp(i m.theta)` from the values at `counts[0] x counts[1] x counts[2]` equally spaced points, the last angle
/// varying fastest, in the same order: `m` from 0 up, then the negative values in ascending order.
pub(super) fn coefficients(values: &[f64], mut counts: [usize; 3]) -> Vec<Complex<f64>> {
    let mut all: Vec<Complex<f64>> = values.iter().map(|value| Complex::from(value / values.len() as f64)).collect();
    let mut planner = FftPlanner::new();
    for _ in 0..3 {
        let count = counts[2];
        planner.plan_fft_forward(count).process(&mut all);
        // The last angle becomes the first.
        let rows = all.len() / count;
        all = (0..count).flat_map(|m| (0..rows).map(move |row| row * count + m)).map(|from| all[from]).collect();
        counts.rotate_right(1);
    }
    all
}

/// The multiples of the three angles for an index among all coefficients.
pub(super) fn multiples(place: usize, counts: [usize; 3]) -> [i32; 3] {
    let places = places(place, counts);
    core::array::from_fn(|i| {
        let (place, count) = (places[i] as i32, counts[i] as i32);
        if 2 * place > count { place - count } else { place }
    })
}

/// The points of a grid, in turns.
pub(super) fn points(counts: [usize; 3]) -> impl Iterator<Item = [f64; 3]> {
    (0..counts.iter().product()).map(move |place| {
        let places = places(place, counts);
        core::array::from_fn(|i| places[i] as f64 / counts[i] as f64)
    })
}

fn places(place: usize, [_, second, third]: [usize; 3]) -> [usize; 3] {
    [place / (second * third), place / third % second, place % third]
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    #[test]
    fn coefficients_are_those_of_the_sum() {
        let counts = [8, 4, 2];
        let waves = [([2, -1, 0], 0.7, 0.3), ([-3, 1, 0], 0.2, -1.0), ([0, 0, 0], 0.5, 0.0)];
        let value = |[a, b, c]: [f64; 3]| -> f64 {
            let wave = |([j, k, l], amplitude, phase): &([i32; 3], f64, f64)| {
                amplitude * (TAU * (f64::from(*j) * a + f64::from(*k) * b + f64::from(*l) * c) + phase).cos()
            };
            waves.iter().map(wave).sum()
        };
        let values: Vec<f64> = points(counts).map(value).collect();
        for (place, found) in coefficients(&values, counts).iter().enumerate() {
            let m = multiples(place, counts);
            let mut expected = Complex::from(0.0);
            for (of, amplitude, phase) in waves {
                let half = if of == [0; 3] { amplitude } else { amplitude / 2.0 };
                if m == of {
                    expected = Complex::from_polar(half, phase);
                } else if m == of.map(|k| -k) {
                    expected = Complex::from_polar(half, -phase);
                }
            }
            assert!((found - expected).norm() < 1e-15, "{m:?}: {found} {expected}");
        }
    }
}
