//! Windows that taper a series towards its ends.

use core::f64::consts::PI;

use crate::error::Error;

/// A taper. Its transform decides how far the lines of a spectrum reach: sidelobes say what a line leaks to distant
/// frequencies, the width how near two lines may be.
///
/// | window | largest sidelobe | half width of a line [rad / T], to its first zero |
/// |---|---|---|
/// | `Uniform` | 0.22 | 6.3 |
/// | `Hann` | 0.027 | 12.6 |
/// | `Kaiser { shape }` | `0.217 shape / sinh(shape)` | `2 sqrt(shape^2 + pi^2)` |
/// | `Kaiser { shape: 10 }` | 2.0e-4 | 21.0 |
/// | `Kaiser { shape: 20 }` | 1.8e-8 | 40.5 |
/// | `Kaiser { shape: 30 }` | 1.2e-12 | 60.3 |
///
/// with `T` the length of the series. Kaiser's window (J. F. Kaiser, Proc. IEEE ISCAS 20 (1974)) is close to the one that has
/// least outside its main lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Window {
    /// No taper: all weights are equal.
    Uniform,
    /// `sin^2(pi x)` for `x` in (0, 1).
    Hann,
    /// `I_0(shape sqrt(1 - u^2))` for `u = 2 x - 1` in (-1, 1), with `I_0` the modified Bessel function.
    Kaiser {
        /// From 0 (uniform) to 100.
        shape: f64,
    },
}

impl Window {
    /// Weights of `count` samples, each in the middle of its cell of width `1 / count`; their mean is one.
    ///
    /// # Errors
    /// [`Error::Domain`] for a shape outside [0, 100].
    pub fn weights(self, count: usize) -> Result<Vec<f64>, Error> {
        if let Window::Kaiser { shape } = self {
            Error::ensure((0.0..=100.0).contains(&shape), "shape of the Kaiser window", shape, "between 0 and 100")?;
        }
        let mut weights: Vec<f64> = (0..count).map(|j| self.value((j as f64 + 0.5) / count as f64)).collect();
        let mean = weights.iter().sum::<f64>() / count as f64;
        weights.iter_mut().for_each(|weight| *weight /= mean);
        Ok(weights)
    }

    /// The window at `x` in (0, 1), not normalised.
    fn value(self, x: f64) -> f64 {
        match self {
            Window::Uniform => 1.0,
            Window::Hann => (PI * x).sin().powi(2),
            Window::Kaiser { shape } => bessel_i0(shape * 2.0 * (x * (1.0 - x)).sqrt()),
        }
    }

    /// Distance in frequency at which the line of a series of length `duration` has its first zero, rad per unit of time.
    pub fn half_width(self, duration: f64) -> f64 {
        let bins = match self {
            Window::Uniform => PI,
            Window::Hann => 2.0 * PI,
            Window::Kaiser { shape } => shape.hypot(PI),
        };
        2.0 * bins / duration
    }
}

/// `I_0(x) = sum_k ((x/2)^k / k!)^2`, all terms positive.
fn bessel_i0(x: f64) -> f64 {
    let quarter = x * x / 4.0;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1.. {
        term *= quarter / f64::from(k * k);
        if sum + term == sum {
            break;
        }
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_function_is_that_of_the_tables() {
        // Abramowitz and Stegun, table 9.8, and DLMF 10.40 for the last.
        for (x, value) in [(0.0, 1.0), (1.0, 1.266_065_877_752_008_4), (10.0, 2_815.716_628_466_254)] {
            assert!((bessel_i0(x) / value - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn shape_out_of_range_is_refused() {
        for shape in [-1.0, 101.0, f64::NAN] {
            assert!(Window::Kaiser { shape }.weights(8).is_err());
        }
    }
}
