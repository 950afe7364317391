//! A real time series in equal steps.

use crate::dynamics::BodyState;
use crate::error::Error;
use crate::propagation::Motion;

/// A real series in equal steps of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Time of the first value.
    pub start: f64,
    /// Time between two values.
    pub step: f64,
    /// The values.
    pub values: Vec<f64>,
}

impl Series {
    /// `count` values of an observable of the state, over the whole span of a motion in the direction of growing time.
    ///
    /// Frequencies above [`highest_frequency`](Self::highest_frequency) are folded back below it.
    ///
    /// # Errors
    /// [`Error::Domain`] for fewer than [`LEAST_LENGTH`] values or a span of no length, and for what the motion refuses.
    pub fn of_motion<M: Motion<f64, State = BodyState<f64>>>(
        motion: &M,
        count: usize,
        observable: impl Fn(&BodyState<f64>) -> f64,
    ) -> Result<Self, Error> {
        let (from, to) = motion.span();
        let (start, end) = (from.min(to), from.max(to));
        let series = Self { start, step: (end - start) / (count.max(2) - 1) as f64, values: Vec::new() };
        let values = (0..count).map(|i| {
            let time = if i + 1 == count { end } else { start + series.step * i as f64 };
            motion.state(time).map(|state| observable(&state))
        });
        let series = Self { values: values.collect::<Result<_, _>>()?, ..series };
        series.check()?;
        Ok(series)
    }

    /// Length in time: one step for each value.
    pub fn duration(&self) -> f64 {
        self.step * self.values.len() as f64
    }

    /// Nyquist's frequency `pi / step`, rad per unit of time.
    pub fn highest_frequency(&self) -> f64 {
        core::f64::consts::PI / self.step
    }

    /// Refuses what has no spectrum.
    pub(super) fn check(&self) -> Result<(), Error> {
        let length = self.values.len();
        Error::ensure(length >= LEAST_LENGTH, "length of the series", length as f64, "at least 16 values")?;
        Error::ensure(self.step > 0.0 && self.step.is_finite(), "time step", self.step, "above zero and finite")?;
        Error::ensure(self.start.is_finite(), "time of the first value", self.start, "a finite number")?;
        for &value in &self.values {
            // The square must not overflow either.
            Error::ensure(value.abs() <= 1e150, "value of the series", value, "a finite number of at most 1e150")?;
        }
        Ok(())
    }
}

/// Fewest values of which a spectrum is taken.
pub const LEAST_LENGTH: usize = 16;

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::observables::tests::Made;

    /// What is observed is the time itself.
    #[test]
    fn values_are_in_equal_steps_from_the_first_time_to_the_last() {
        for span in [(-3.1, 5.7), (5.7, -3.1)] {
            let state = |t: f64| {
                Ok(BodyState { axis: Vector3::z(), momentum: Vector3::new(t, 0.0, 1.0), equatorial_axis: Vector3::x() })
            };
            let motion = Made::new(span, state);
            // Some of these steps, added up, pass the end by rounding.
            for count in 16..200 {
                let series = Series::of_motion(&motion, count, |state| state.momentum.x).unwrap();
                assert_eq!((series.start, series.values.len()), (-3.1, count));
                assert!((series.step - 8.8 / (count - 1) as f64).abs() < 1e-14);
                assert_eq!((series.values[0], series.values[count - 1]), (-3.1, 5.7));
                for (i, value) in series.values.iter().enumerate() {
                    assert!((value - (-3.1 + 8.8 * i as f64 / (count - 1) as f64)).abs() < 1e-13, "{count} {i}");
                }
            }
            for count in [0, 1, 2, 15] {
                assert!(Series::of_motion(&motion, count, |state| state.momentum.x).is_err());
            }
        }
    }
}
