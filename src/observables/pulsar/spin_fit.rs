//! A constant frequency, with or without a spin-down, fitted to numbered arrival times over decades.
//!
//! ```
//! use twofold::observables::pulsar::SpinFit;
//!
//! // Every hundredth of a thousand pulses, 0.1 s apart.
//! let points: Vec<_> = (0..10).map(|k| (100 * k, [10.0 * k as f64, 0.0])).collect();
//! let fit = SpinFit::new(&points, false)?;
//! assert!((fit.frequency[0] - 10.0).abs() < 1e-14 && fit.residuals.iter().all(|late| late.abs() < 1e-14));
//! assert!((fit.time_of(50)[0] - 5.0).abs() < 1e-14);
//! # Ok::<(), twofold::Error>(())
//! ```

use super::timing::check_number;
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;

/// The phase `phase + F0 t + F1 t^2 / 2` (turns) fitted to pulse numbers by least squares, as timing programs do.
#[derive(Debug, Clone, PartialEq)]
pub struct SpinFit {
    /// Turns at the time zero, as the unevaluated sum of two doubles.
    pub phase: [f64; 2],
    /// `F0` at the time zero (turns per unit of time), as the unevaluated sum of two doubles: over 1e12 turns 1e-9 of one is 21 digits.
    pub frequency: [f64; 2],
    /// `F1`; zero if it is not fitted.
    pub frequency_rate: f64,
    /// `(phase of the fit - number) / F0` at each time: above zero for a pulse that is late.
    pub residuals: Vec<f64>,
}

impl SpinFit {
    /// The fit to points `(number, time)`, the times as unevaluated sums of two doubles, all of the same weight; `F1` too if
    /// `with_rate`.
    ///
    /// A chord is taken away to 32 digits first. What is left of the numbers is fitted in doubles, by polynomials orthogonal over the
    /// points: residuals have rounding errors of some 1e-16 of the largest distance from the chord.
    ///
    /// # Errors
    /// [`Error::Domain`] for times that are not finite, numbers above 2^53 in size, or fewer different ones than are fitted.
    pub fn new(points: &[(i64, [f64; 2])], with_rate: bool) -> Result<Self, Error> {
        let wanted = if with_rate { 3.0 } else { 2.0 };
        let mut different: Vec<_> = points.iter().map(|(_, time)| time[0] + time[1]).collect();
        for &(number, _) in points {
            check_number(number)?;
        }
        for time in &different {
            Error::ensure(time.is_finite(), "time of arrival", *time, "a finite number")?;
        }
        different.sort_by(f64::total_cmp);
        different.dedup();
        let count = different.len() as f64;
        Error::ensure(count >= wanted, "number of different times", count, "at least two, or three with F1")?;

        let mut numbers: Vec<_> = points.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let pulses = numbers.len() as f64;
        Error::ensure(pulses >= wanted, "number of different pulses", pulses, "at least two, or three with F1")?;

        let (first, start) = points[0];
        let start = DoubleDouble::from(start);
        let since = |time: [f64; 2]| DoubleDouble::from(time) - start;
        let farthest = points
            .iter()
            .map(|&(number, time)| (number, since(time)))
            .max_by(|a, b| a.1.high.abs().total_cmp(&b.1.high.abs()));
        let (last, span) = farthest.expect("there are points");
        let chord = DoubleDouble::from((last - first) as f64).over(span);
        let left: Vec<_> = points
            .iter()
            .map(|&(number, time)| (DoubleDouble::from((number - first) as f64) - chord * since(time)).high)
            .collect();
        // Times in units of the chord's.
        let unit = span.high;
        let x: Vec<_> = points.iter().map(|&(_, time)| since(time).high / unit).collect();

        // 1, x - mean, (x - mean)^2 - slope (x - mean) - square: orthogonal over the points.
        let size = points.len() as f64;
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / size;
        let middle = mean(&mut x.iter().copied());
        let u: Vec<_> = x.iter().map(|x| x - middle).collect();
        let square = mean(&mut u.iter().map(|u| u * u));
        let slope = mean(&mut u.iter().map(|u| u * u * u)) / square;
        let second = |u: f64| if with_rate { u * (u - slope) - square } else { 0.0 };
        let mut fitted = [0.0; 3];
        let mut residues = left;
        // Twice: the second time takes away what rounding left.
        for _ in 0..2 {
            let norm = mean(&mut u.iter().map(|&u| second(u).powi(2)));
            let along = |weight: &dyn Fn(f64) -> f64| mean(&mut u.iter().zip(&residues).map(|(&u, z)| weight(u) * z));
            let curvature = if norm > 0.0 { along(&second) / norm } else { 0.0 };
            let change = [along(&|_| 1.0), along(&|u| u) / square, curvature];
            for (z, &u) in residues.iter_mut().zip(&u) {
                *z -= change[0] + change[1] * u + change[2] * second(u);
            }
            fitted = [0, 1, 2].map(|i| fitted[i] + change[i]);
        }

        // At the time zero of the caller.
        let zero = DoubleDouble::default() - start;
        let u = zero.high / unit - middle;
        let frequency = chord + ((fitted[1] + fitted[2] * (2.0 * u - slope)) / unit).into();
        let there = fitted[0] + fitted[1] * u + fitted[2] * second(u);
        Ok(Self {
            phase: (DoubleDouble::from(first as f64) + chord * zero + there.into()).into(),
            frequency: frequency.into(),
            frequency_rate: 2.0 * fitted[2] / (unit * unit),
            residuals: residues.iter().map(|z| -z / frequency.high).collect(),
        })
    }

    /// The time at which the fit has the phase `number`, as the unevaluated sum of two doubles: the root `2 n / (F0 + sqrt(F0^2 + 2 F1 n))`
    /// of the quadratic equation, `n` counted from the phase at the time zero. Not a number where the phase never comes so far.
    pub fn time_of(&self, number: i64) -> [f64; 2] {
        let wanted = (DoubleDouble::from(number as f64) - self.phase.into()) * 2.0;
        let frequency = DoubleDouble::from(self.frequency);
        let root = (frequency * frequency + wanted * self.frequency_rate).sqrt();
        wanted.over(if frequency.high < 0.0 { frequency - root } else { frequency + root }).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty years of a millisecond pulsar that is late by a known sine of 3 ns.
    #[test]
    fn a_signal_of_nanoseconds_is_found_over_decades() {
        let frequency = DoubleDouble::sum(641.928_233_334_553_6, 3.1e-15);
        let signal = |k: i64| 3e-9 * (k as f64 * 0.7).sin();
        let points: Vec<_> = (0..400)
            .map(|k| {
                let number = 1_000_000_007 * k - 200_000_000_000;
                let time = DoubleDouble::from((number as f64) - 0.25).over(frequency) + signal(k).into();
                (number, time.into())
            })
            .collect();
        for with_rate in [false, true] {
            let fit = SpinFit::new(&points, with_rate).expect("a fit");
            // A sine of many turns is left nearly as it is.
            for (k, residual) in fit.residuals.iter().enumerate() {
                assert!((residual - signal(k as i64)).abs() < 2e-10, "{k}: {residual:e}");
            }
            let off = DoubleDouble::from(fit.frequency) - frequency;
            assert!(off.high.abs() < 1e-16, "{off:?}");
            assert!((fit.phase[0] + fit.phase[1] - 0.25).abs() < 1e-6, "{:?}", fit.phase);
            let time = fit.time_of(5);
            assert!((time[0] - 4.75 / 641.928_233_334_553_6).abs() < 1e-8);
        }
    }
}
