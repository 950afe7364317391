//! Mean rate of an angle of quasi-periodic motion by a weighted average over time.

use crate::error::Error;
use crate::numerics::window::Window;

/// Weight of the averages: what leaks from an oscillation is below 1.2e-12 of its size.
pub(crate) const WEIGHT: Window = Window::Kaiser { shape: 30.0 };

/// Share of the series in each of the two parts whose averages are compared with that of the whole.
const PART: f64 = 0.75;

/// A mean rate with its estimated error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanRate {
    /// The rate (rad per unit of time).
    pub value: f64,
    /// Estimated error: twice the largest difference from the averages over the first and over the last three quarters. That is
    /// the error of a shorter span, so an upper bound as long as averaging converges.
    pub uncertainty: f64,
}

/// Mean rate of a continuous angle given in equal steps of time: `sum w_i (angle_{i+1} - angle_i) / step` with the weights of a
/// Kaiser window of shape 30 and sum one.
///
/// A weighted Birkhoff average: an oscillation of the rate with the frequency `f` and the amplitude `a` contributes less than
/// `1.2e-12 a` as soon as the series is longer than `60.3 / f`, whatever its phase. (With the weight `exp(-1/(x (1-x)))` of
/// that average's literature the same takes six times the length.) In a motion of several frequencies `f` is the lowest of
/// their combinations that has an amplitude worth mentioning.
///
/// # Errors
/// [`Error::Domain`] for fewer than 16 angles, one that is not finite, or a step that is not above zero.
pub fn mean_rate(angles: &[f64], step: f64) -> Result<MeanRate, Error> {
    let count = angles.len();
    Error::ensure(count >= 16, "number of angles", count as f64, "at least 16")?;
    Error::ensure(step > 0.0 && step.is_finite(), "time step", step, "above zero and finite")?;
    for &angle in angles {
        Error::ensure(angle.is_finite(), "angle", angle, "a finite number")?;
    }
    let part = (PART * count as f64) as usize;
    let [whole, first, last] = [angles, &angles[..part], &angles[count - part..]].map(|angles| average(angles, step));
    let (whole, first, last) = (whole?, first?, last?);
    Ok(MeanRate { value: whole, uncertainty: 2.0 * (first - whole).abs().max((last - whole).abs()) })
}

fn average(angles: &[f64], step: f64) -> Result<f64, Error> {
    let intervals = angles.len() - 1;
    let weights = WEIGHT.weights(intervals)?;
    // About the secant, whose size would cost digits.
    let secant = (angles[intervals] - angles[0]) / intervals as f64;
    let excess: f64 =
        weights.iter().zip(angles.windows(2)).map(|(weight, pair)| weight * (pair[1] - pair[0] - secant)).sum();
    Ok((secant + excess / intervals as f64) / step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_far_from_zero_keeps_the_digits_of_its_rate() {
        // All of them doubles.
        let angles: Vec<f64> = (0..2000).map(|i| 0.5_f64.powi(-40) + f64::from(i) * 0.5_f64.powi(10)).collect();
        let found = mean_rate(&angles, 0.5).unwrap();
        assert!((found.value / 0.5_f64.powi(9) - 1.0).abs() < 1e-13, "{found:?}");
        assert!(found.uncertainty < 1e-15, "{found:?}");
    }
}
