//! A frequency and its derivatives fitted to numbered arrival times over decades.
//!
//! ```
//! use twofold::observables::pulsar::SpinFit;
//!
//! // Every hundredth of a thousand pulses, 0.1 s apart.
//! let points: Vec<_> = (0..10).map(|k| (100 * k, [10.0 * k as f64, 0.0])).collect();
//! let fit = SpinFit::new(&points, 0)?;
//! assert!((fit.frequency[0] - 10.0).abs() < 1e-14 && fit.residuals.iter().all(|late| late.abs() < 1e-14));
//! assert!((fit.time_of(50)[0] - 5.0).abs() < 1e-14);
//! # Ok::<(), twofold::Error>(())
//! ```

use super::constant_period::check_number;
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;

/// The phase `phase + F0 t + F1 t^2 / 2 + F2 t^3 / 6` (turns) fitted to pulse numbers by least squares, as in timing programs.
#[derive(Debug, Clone, PartialEq)]
pub struct SpinFit {
    /// Turns at the time zero, as the unevaluated sum of two doubles.
    pub phase: [f64; 2],
    /// `F0` at the time zero (turns per unit of time), as the unevaluated sum of two doubles: 1e-9 turn in 1e12 turns requires 21
    /// digits.
    pub frequency: [f64; 2],
    /// `F1` and `F2` at the time zero; zero if they are not fitted.
    pub derivatives: [f64; 2],
    /// `(phase of the fit - number) / frequency`, with the frequency of the fit at each time: positive for a pulse that arrives late.
    pub residuals: Vec<f64>,
}

impl SpinFit {
    /// Fits points `(number, time)` of equal weight, with the times as unevaluated sums of two doubles. `derivatives` is the number of derivatives of
    /// the frequency that are fitted: none, one (`F1`) or two (`F2` too).
    ///
    /// A chord is subtracted with 32 digits first. The remainders of the numbers are fitted in doubles, by polynomials orthogonal
    /// over the points: residuals have rounding errors of some 1e-16 of the largest distance from the chord.
    ///
    /// # Errors
    /// [`Error::Domain`] for times that are not finite, numbers above 2^53 in size, more than two derivatives, or fewer distinct points than fitted
    /// parameters.
    pub fn new(points: &[(i64, [f64; 2])], derivatives: usize) -> Result<Self, Error> {
        Error::ensure(derivatives <= 2, "number of derivatives", derivatives as f64, "0, 1 (F1) or 2 (F1 and F2)")?;
        let wanted = 2.0 + derivatives as f64;
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
        let at_least = "at least 2, or 3 with F1, or 4 with F2";
        Error::ensure(count >= wanted, "number of different times", count, at_least)?;

        let mut numbers: Vec<_> = points.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let pulses = numbers.len() as f64;
        Error::ensure(pulses >= wanted, "number of different pulses", pulses, at_least)?;

        let (first, start) = points[0];
        let start = DoubleDouble::from(start);
        let since = |time: [f64; 2]| DoubleDouble::from(time) - start;
        let farthest = points
            .iter()
            .map(|&(number, time)| (number, since(time)))
            .max_by(|a, b| a.1.high.abs().total_cmp(&b.1.high.abs()));
        let (last, span) = farthest.expect("there are points");
        let chord = DoubleDouble::from((last - first) as f64) / span;
        let left: Vec<_> = points
            .iter()
            .map(|&(number, time)| (DoubleDouble::from((number - first) as f64) - chord * since(time)).high)
            .collect();
        // Times in units of the length of the chord.
        let unit = span.high;
        let times: Vec<_> = points.iter().map(|&(_, time)| since(time).high / unit).collect();
        let (middle, fitted, rest) = without_polynomial(&times, left, 1 + derivatives);

        // At the caller's time zero.
        let zero = DoubleDouble::default() - start;
        let [there, rate, second, third] = horner(&fitted, zero.high / unit - middle);
        let fit = Self {
            phase: (DoubleDouble::from(first as f64) + chord * zero + there.into()).into(),
            frequency: (chord + (rate / unit).into()).into(),
            derivatives: [second / (unit * unit), third / (unit * unit * unit)],
            residuals: Vec::new(),
        };
        let late = points.iter().zip(&rest).map(|((_, time), z)| -z / fit.frequency_at(time[0] + time[1]));
        Ok(Self { residuals: late.collect(), ..fit })
    }

    /// The frequency of the fit at a time.
    fn frequency_at(&self, time: f64) -> f64 {
        let [rate, second] = self.derivatives;
        self.frequency[0] + time * (rate + time * second / 2.0)
    }

    /// The contribution to the residuals (a time) if the pulses at `times` are late by `turns`: phase, frequency and `derivatives` derivatives are
    /// fitted to `turns` and subtracted, and the rest is divided by the frequency of this fit at each time. There must be as many `turns` as `times`,
    /// and more distinct times than fitted parameters.
    pub fn residuals_of_turns(&self, times: &[f64], turns: Vec<f64>, derivatives: usize) -> Vec<f64> {
        let left = without_polynomial(times, turns, 1 + derivatives).2;
        left.iter().zip(times).map(|(turns, time)| turns / self.frequency_at(*time)).collect()
    }

    /// The time at which the fit has the phase `number`, as the unevaluated sum of two doubles, by Newton's method from the root
    /// `2 n / (F0 + sqrt(F0^2 + 2 F1 n))` of the quadratic equation, with `n` counted from the phase at the time zero. NaN if that equation
    /// has no root, or if `F2` changes the phase so much by then that the method does not converge in five steps; for a pulsar neither
    /// happens.
    pub fn time_of(&self, number: i64) -> [f64; 2] {
        let wanted = (DoubleDouble::from(number as f64) - self.phase.into()) * 2.0;
        let frequency = DoubleDouble::from(self.frequency);
        let [rate, second] = self.derivatives;
        let root = (frequency * frequency + wanted * rate).sqrt();
        let mut t = wanted / (if frequency.high < 0.0 { frequency - root } else { frequency + root });
        if second != 0.0 {
            let wanted = wanted * 0.5;
            let mut step = DoubleDouble::default();
            for _ in 0..NEWTON_STEPS {
                let phase = t * (frequency + t * (DoubleDouble::from(rate / 2.0) + t * (second / 6.0)));
                let slope = frequency.high + t.high * (rate + t.high * second / 2.0);
                step = (phase - wanted) / slope;
                t -= step;
            }
            // The last step squares an error that is below 1e-14.
            if step.high.abs() > 1e-14 * t.high.abs() {
                return [f64::NAN; 2];
            }
        }
        t.into()
    }
}

/// Number of Newton steps, each of which squares the error: from a thousandth to 32 digits in four.
const NEWTON_STEPS: usize = 5;

/// Fits a polynomial of a degree of at most 3 to values at given times. Returns the mean of the times, the coefficients by powers of the time since
/// that mean, and the residuals.
fn without_polynomial(times: &[f64], values: Vec<f64>, degree: usize) -> (f64, [f64; 4], Vec<f64>) {
    let middle = times.iter().sum::<f64>() / times.len() as f64;
    let u: Vec<_> = times.iter().map(|time| time - middle).collect();
    let basis = orthogonal(&u, degree);
    let (mut fitted, mut rest) = ([0.0; 4], values);
    // Twice: the second pass removes what rounding left.
    for _ in 0..2 {
        let change: Vec<_> = basis
            .iter()
            .map(|p| {
                let along: f64 = u.iter().zip(&rest).map(|(&u, z)| horner(p, u)[0] * z).sum();
                let square: f64 = u.iter().map(|&u| horner(p, u)[0].powi(2)).sum();
                along / square
            })
            .collect();
        for (p, change) in basis.iter().zip(&change) {
            (0..4).for_each(|power| fitted[power] += change * p[power]);
        }
        for (z, &u) in rest.iter_mut().zip(&u) {
            *z -= basis.iter().zip(&change).map(|(p, change)| change * horner(p, u)[0]).sum::<f64>();
        }
    }
    (middle, fitted, rest)
}

/// Coefficients, by powers of `u`, of the polynomials up to a degree of at most 3 that are orthogonal over points whose mean is
/// zero.
fn orthogonal(u: &[f64], degree: usize) -> Vec<[f64; 4]> {
    let mut basis = vec![[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
    let sum = |value: &dyn Fn(f64) -> f64| u.iter().map(|&u| value(u)).sum::<f64>();
    while basis.len() <= degree {
        let [.., before, last] = basis.as_slice() else { break };
        let square = |p: &[f64; 4]| sum(&|u| horner(p, u)[0].powi(2));
        let along = sum(&|u| u * horner(last, u)[0].powi(2)) / square(last);
        let back = square(last) / square(before);
        let next = |power: usize| {
            let raised = if power == 0 { 0.0 } else { last[power - 1] };
            raised - along * last[power] - back * before[power]
        };
        basis.push([0, 1, 2, 3].map(next));
    }
    basis
}

/// A cubic polynomial and its three derivatives.
fn horner([a, b, c, d]: &[f64; 4], u: f64) -> [f64; 4] {
    [a + u * (b + u * (c + u * d)), b + u * (2.0 * c + u * 3.0 * d), 2.0 * c + 6.0 * d * u, 6.0 * d]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `10 t + F2 t^3 / 6`: five steps from `n / 10` reach the root for a small `F2`, and no number is made up for a large one.
    #[test]
    fn a_time_of_a_phase_is_one_of_that_phase_or_none() {
        let fit = |second: f64| SpinFit {
            phase: [0.0; 2],
            frequency: [10.0, 0.0],
            derivatives: [0.0, second],
            residuals: Vec::new(),
        };
        for (second, number) in [(1e-10, 100_000), (-1e-9, 10_000), (1e-3, 0)] {
            let t = fit(second).time_of(number)[0];
            let phase = 10.0 * t + second * t.powi(3) / 6.0;
            assert!((phase - number as f64).abs() < 1e-9, "{second} {number}: {t}");
        }
        for (second, number) in [(1e-3, 100_000), (1e-3, 10_000_000), (-1e-3, 1000)] {
            assert!(fit(second).time_of(number)[0].is_nan(), "{second} {number}");
        }
        // From cubics so weak that Newton's method converges to others for which it does not, in two units of time.
        for unit in [1.0_f64, 1e12] {
            let (mut exact, mut none) = (0, 0);
            for k in 0..1000 {
                let second = 1e-6 * 10f64.powf(0.005 * f64::from(k)) * unit.powi(3);
                let fit = SpinFit { frequency: [10.0 * unit, 0.0], ..fit(second) };
                let t = DoubleDouble::from(fit.time_of(1000));
                if t.high.is_nan() {
                    none += 1;
                    continue;
                }
                exact += 1;
                let off = t * (DoubleDouble::from(10.0 * unit) + t * t * (second / 6.0)) - 1000.0.into();
                assert!(off.high.abs() < 1e-23, "{second:e}: {off:?}");
            }
            assert!(exact > 100 && none > 100, "{exact} {none}");
        }
    }

    /// Times in two parts are their sums, and as many derivatives as are fitted leave nothing of a polynomial.
    #[test]
    fn residuals_are_at_the_sums_of_times_and_without_polynomials() {
        let numbers = [0, 9, 17, 40, 71, 93, 120];
        let time = |number: i64| (number as f64 + 50.0).powf(0.6) * 10.0;
        let fit = |parts: fn(f64) -> [f64; 2]| {
            let points: Vec<_> = numbers.iter().map(|&number| (number, parts(time(number)))).collect();
            SpinFit::new(&points, 1).expect("a fit")
        };
        let (of_one, of_two) = (fit(|t| [t, 0.0]), fit(|t| [0.25 * t, 0.75 * t]));
        for (one, two) in of_one.residuals.iter().zip(&of_two.residuals) {
            assert!((one - two).abs() < 1e-11 && one.abs() > 1e-4, "{one} {two}");
        }
        let times = numbers.map(time);
        let turns: Vec<f64> = times.iter().map(|t| 0.3 - 0.02 * t + 1e-3 * t * t).collect();
        assert!(of_one.residuals_of_turns(&times, turns.clone(), 1).iter().all(|left| left.abs() < 1e-10));
        assert!(of_one.residuals_of_turns(&times, turns, 0).iter().any(|left| left.abs() > 1e-2));
    }

    /// Twenty years of a millisecond pulsar with a known sinusoidal delay of 3 ns.
    #[test]
    fn a_signal_of_nanoseconds_is_found_over_decades() {
        let frequency = DoubleDouble::sum(641.928_233_334_553_6, 3.1e-15);
        let signal = |k: i64| 3e-9 * (k as f64 * 0.7).sin();
        let points: Vec<_> = (0..400)
            .map(|k| {
                let number = 1_000_000_007 * k - 200_000_000_000;
                let time = DoubleDouble::from((number as f64) - 0.25) / frequency + signal(k).into();
                (number, time.into())
            })
            .collect();
        for derivatives in 0..3 {
            let fit = SpinFit::new(&points, derivatives).expect("a fit");
            // The fit leaves a sine of many turns nearly unchanged.
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

    /// For a pulsar that has lost a sixth of its rotation, and for fits with a second derivative, with frequencies of either
    /// sign.
    #[test]
    fn the_time_of_a_number_has_its_phase() {
        for (frequency, rate, second) in
            [(0.5, -1e-9, 0.0), (0.5, -1e-9, 3e-18), (-2.0, 4e-9, 0.0), (-2.0, 4e-9, -8e-18), (100.0, -2e-7, 3e-16)]
        {
            let (phase, residuals) = ([0.25, 1e-18], Vec::new());
            let fit = SpinFit { phase, frequency: [frequency, 1e-18], derivatives: [rate, second], residuals };
            for number in [-30_000_000_i64, -7, 0, 1, 40_000_000] {
                let t = DoubleDouble::from(fit.time_of(number));
                let slope = DoubleDouble::from(fit.frequency) + t * (t * (second / 6.0) + (rate / 2.0).into());
                let off = DoubleDouble::from(phase) + t * slope - (number as f64).into();
                // Of 4e7 turns, with 32 digits.
                assert!(off.high.abs() < 1e-22, "{frequency} {rate:e} {second:e}, {number}: {off:?}");
            }
        }
    }

    /// A cubic phase is recovered exactly.
    #[test]
    fn derivatives_are_those_of_the_phase() {
        let [f0, f1, f2] = [DoubleDouble::from(2.46), DoubleDouble::from(-3.65e-13), DoubleDouble::from(8.7e-25)];
        let phase = |t: DoubleDouble| t * (f0 + t * (f1 * 0.5 + t * (f2 / 6.0)));
        let points: Vec<_> = (-200..200)
            .map(|k: i32| {
                let number = f64::from(k) * 2e6;
                let mut t = DoubleDouble::from(number / 2.46);
                (0..4).for_each(|_| t = t - (phase(t) - number.into()) / 2.46);
                (number as i64, t.into())
            })
            .collect();
        let fit = SpinFit::new(&points, 2).expect("a fit");
        assert!((fit.derivatives[0] / -3.65e-13 - 1.0).abs() < 1e-10, "{:?}", fit.derivatives);
        assert!((fit.derivatives[1] / 8.7e-25 - 1.0).abs() < 1e-5, "{:?}", fit.derivatives);
        // The phase is up to 5,000 turns from the chord.
        assert!(fit.residuals.iter().all(|late| late.abs() < 2e-12));
        for (number, time) in points.iter().step_by(50) {
            assert!((fit.time_of(*number)[0] - time[0]).abs() < 1e-6);
        }
        // Without F2: the root of the quadratic equation, for a rate a thousand times as large.
        let quadratic = SpinFit { derivatives: [-3.65e-10, 0.0], ..fit.clone() };
        let t = DoubleDouble::from(quadratic.time_of(400_000_000));
        let phase = DoubleDouble::from(fit.phase) + t * (DoubleDouble::from(fit.frequency) + t * -1.825e-10);
        assert!((phase.high - 4e8).abs() < 1e-6 && t.high > 1.63e8, "{t:?}");
        assert!(SpinFit::new(&points, 3).is_err());
    }

    /// A star that loses a twentieth of its rotation, and one that regains it: pulses late by the same time are late by as many turns more as the
    /// star is faster.
    #[test]
    fn residuals_are_times_however_fast_the_star_turns() {
        for (f2, derivatives, taken) in [(0.0, 1, 2e-5), (4e-19, 2, 3.3e-5)] {
            let (f0, f1) = (30.0, -3e-10);
            let rate = |t: f64| f0 + t * (f1 + t * f2 / 2.0);
            let late = |k: usize| if k.is_multiple_of(2) { 3e-4 } else { -3e-4 };
            let times: Vec<f64> = (0..60).map(|k| 5e9 / 59.0 * f64::from(k)).collect();
            let points: Vec<_> = times
                .iter()
                .enumerate()
                .map(|(k, &t)| {
                    let phase = t * (f0 + t * (f1 / 2.0 + t * f2 / 6.0));
                    (phase.round() as i64, [t, (phase.round() - phase) / rate(t) + late(k)])
                })
                .collect();
            let fit = SpinFit::new(&points, derivatives).unwrap();
            let turns = times.iter().enumerate().map(|(k, t)| late(k) * rate(*t)).collect();
            let parts = fit.residuals_of_turns(&times, turns, derivatives);
            for (k, (residual, part)) in fit.residuals.iter().zip(parts).enumerate().skip(3).take(54) {
                // The fit takes away a part of the alternation, largest at the ends.
                for found in [*residual, part] {
                    assert!((found - late(k)).abs() < taken, "{f2} {k}: {residual} {part}");
                }
            }
        }
    }
}
