//! Least-squares slopes, for measuring convergence orders and other power laws.
//!
//! # Example
//!
//! ```
//! use twofold::numerics::straight_line::{order, slope};
//!
//! assert_eq!(slope(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)])?.value, 2.0);
//! // An error of second order; the last point is rounding.
//! let second = order(&[(0.1, 1e-2), (0.01, 1e-4), (0.001, 1e-6), (0.0001, 1e-7)], 5e-7)?;
//! assert!((second.value - 2.0).abs() < 1e-12 && second.error < 1e-12);
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::error::Error;

/// Slope of a least-squares line with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// The slope.
    pub value: f64,
    /// Its standard error from the scatter about the line.
    pub error: f64,
}

/// Least-squares slope of `y` against `x`.
///
/// # Errors
/// [`Error::Domain`] for fewer than three points, which have no scatter from which to estimate the error, for points at a single `x`, and for a slope
/// or an error that is not finite, for example because a point is not.
pub fn slope(points: &[(f64, f64)]) -> Result<Slope, Error> {
    let n = points.len() as f64;
    Error::ensure(n >= 3.0, "number of points of a slope", n, "at least 3")?;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / n;
    let sxx: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let sxy: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    let value = sxy / sxx;
    let scatter: f64 = points.iter().map(|p| (p.1 - mean_y - value * (p.0 - mean_x)).powi(2)).sum();
    let error = (scatter / (n - 2.0) / sxx).sqrt();
    // Because their mean is rounded, equal values of x could have a spread.
    let spread = points.iter().any(|p| p.0 != points[0].0);
    let allowed = "a finite number with a finite error; the points must be finite and not all at one x";
    Error::ensure(spread && value.is_finite() && error.is_finite(), "slope", value, allowed)?;
    Ok(Slope { value, error })
}

/// Slope of `log10 y` against `log10 x`, from the points with `y` above `floor` (the rounding).
///
/// # Errors
/// As for [`slope`], applied to the logarithms: every `x` of these points must be above zero.
pub fn order(points: &[(f64, f64)], floor: f64) -> Result<Slope, Error> {
    let kept: Vec<_> = points.iter().filter(|p| p.1 > floor).map(|p| (p.0.log10(), p.1.log10())).collect();
    slope(&kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_lie_on_no_line_have_no_slope() {
        let rising = |x: [f64; 3]| [(x[0], 1.0), (x[1], 2.0), (x[2], 4.0)];
        assert!(slope(&rising([0.1, 0.2, 0.3])).is_ok() && order(&rising([0.1, 0.2, 0.3]), 0.0).is_ok());
        for x in [[0.1; 3], [0.0; 3], [0.1, 0.2, f64::NAN], [0.1, 0.2, f64::INFINITY]] {
            assert!(slope(&rising(x)).is_err(), "{x:?}");
        }
        assert!(slope(&[(0.1, 1.0), (0.2, f64::INFINITY), (0.3, 1.0)]).is_err());
        for first in [0.0, -0.1] {
            assert!(order(&rising([first, 0.2, 0.3]), 0.0).is_err(), "{first}");
        }
    }
}
