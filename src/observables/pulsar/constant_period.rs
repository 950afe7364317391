//! Residuals of arrival times against a constant period.

use crate::error::Error;

/// A constant period fitted to numbered times by least squares: `time = epoch + period number + residual`.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantPeriod {
    /// Time from one number to the next.
    pub period: f64,
    /// Time of the number zero.
    pub epoch: f64,
    /// Time minus fit, in the order of the points.
    pub residuals: Vec<f64>,
}

impl ConstantPeriod {
    /// The fit to points `(number, time)` that minimises `sum weight residual^2`. A weight is the inverse square of a time's
    /// uncertainty in any unit; without weights all points count equally.
    ///
    /// Numbers and times are counted from their weighted means, so that the residuals keep the digits of the times.
    ///
    /// # Errors
    /// [`Error::Domain`] unless there is one weight for each point, finite and not negative, times are finite, numbers are at most
    /// 2^53 in size, and at least two numbers differ among the points with weight.
    pub fn fit(points: &[(i64, f64)], weights: Option<&[f64]>) -> Result<Self, Error> {
        let equal = vec![1.0; points.len()];
        let weights = weights.unwrap_or(&equal);
        let (counted, wanted) = (weights.len() as f64, "the number of points");
        Error::ensure(weights.len() == points.len(), "number of weights", counted, wanted)?;
        for (&(number, time), &weight) in points.iter().zip(weights) {
            check_number(number)?;
            Error::ensure(time.is_finite(), "time of arrival", time, "a finite number")?;
            Error::ensure(weight >= 0.0 && weight.is_finite(), "weight", weight, "finite and not negative")?;
        }
        // Relative to the first point, so that the means lose no digits.
        let (first, start) = points.first().copied().unwrap_or_default();
        let offsets = || points.iter().map(|&(number, time)| ((number - first) as f64, time - start));
        let mean = |values: &mut dyn Iterator<Item = f64>| {
            values.zip(weights).map(|(value, weight)| value * weight).sum::<f64>() / weights.iter().sum::<f64>()
        };
        let mean_number = mean(&mut offsets().map(|(number, _)| number));
        let mean_time = mean(&mut offsets().map(|(_, time)| time));
        let centred = || offsets().map(|(number, time)| (number - mean_number, time - mean_time));
        let variance = mean(&mut centred().map(|(number, _)| number * number));
        let covariance = mean(&mut centred().map(|(number, time)| number * time));
        Error::ensure(
            variance > 0.0,
            "variance of the pulse numbers",
            variance,
            "above zero; at least two numbers must differ",
        )?;
        let period = covariance / variance;
        Ok(Self {
            period,
            epoch: start + (mean_time - period * (mean_number + first as f64)),
            residuals: centred().map(|(number, time)| time - period * number).collect(),
        })
    }
}

/// Refuses a pulse number that is not exact as a double, so that differences of numbers stay within 64 bits.
pub(super) fn check_number(number: i64) -> Result<(), Error> {
    const LARGEST: u64 = 1 << 53;
    let allowed = "a whole number of at most 2^53 in size, which a double holds";
    Error::ensure(number.unsigned_abs() <= LARGEST, "pulse number", number as f64, allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_without_weight_do_not_count() {
        let points = [(0, 1.0), (1, 9.0), (2, 5.0), (4, 9.5)];
        let fit = ConstantPeriod::fit(&points, Some(&[1.0, 0.0, 1.0, 1.0])).unwrap();
        let without = ConstantPeriod::fit(&[points[0], points[2], points[3]], None).unwrap();
        assert_eq!((fit.period, fit.epoch), (without.period, without.epoch));
        assert_eq!(fit.residuals[1], 9.0 - fit.epoch - fit.period);
    }
}
