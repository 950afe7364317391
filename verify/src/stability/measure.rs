//! The measurement of a case: largest errors in ulp of the conditioned scale, and digits lost.

use super::input::points;
use crate::prelude::*;

use super::{Case, Scale, Wide, WideDual};

/// Default number of points per round.
pub const POINTS: usize = 40;

/// Relative change of an input for the scale of derivatives: small compared with the spacing of doubles, large compared with 31 digits.
const CHANGE: f64 = 1e-20;

/// Largest errors of a kernel, of a formula or of a derivative.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Largest error in ulp of the conditioned scale.
    pub ulp: f64,
    /// Inputs where it occurred.
    pub place: Vec<f64>,
    /// Index of the result.
    pub component: usize,
    /// Largest number of decimal digits lost of the value itself, by conditioning and kernel together.
    pub digits: f64,
    /// Condition number, scale over value, where most digits were lost.
    pub condition: f64,
}

impl Default for Errors {
    fn default() -> Self {
        Self { ulp: 0.0, place: Vec::new(), component: 0, digits: 0.0, condition: 1.0 }
    }
}

impl Errors {
    fn see(&mut self, found: f64, exact: Wide, scale: f64, x: &[f64], component: usize) {
        let error = if found.is_finite() { (Wide::from_f64(found) - exact).high().abs() } else { f64::INFINITY };
        let ulp = if error == 0.0 { 0.0 } else { error / spacing(scale) };
        let ulp = if ulp.is_nan() { f64::INFINITY } else { ulp };
        if ulp > self.ulp {
            (self.ulp, self.place, self.component) = (ulp, x.to_vec(), component);
        }
        let value = exact.high().abs();
        // A zero has no digits.
        let digits = (error / spacing(value)).log10().clamp(0.0, 17.0);
        if value > 0.0 && digits > self.digits {
            (self.digits, self.condition) = (digits, scale / value);
        }
    }
}

/// Results of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Number of points.
    pub points: usize,
    /// Errors of the kernel.
    pub kernel: Errors,
    /// Of its derivatives by the first input.
    pub derivative: Option<Errors>,
    /// Errors of the formula compared with it.
    pub naive: Option<Errors>,
}

/// Distance from a number to the next larger one.
pub(super) fn spacing(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// The largest error of some cases, derivatives included, relative to its bound.
pub(super) fn largest_over_bound(cases: Vec<Case>) -> Result<Measured, String> {
    let mut worst = Worst::default();
    for case in cases {
        let found = case.measure(1);
        let of_values = ("value", Some(found.kernel), case.class);
        for (what, errors, class) in [of_values, ("derivative", found.derivative, case.class_of_derivatives)] {
            let Some(errors) = errors else { continue };
            worst.see(errors.ulp / class.bound(), || {
                format!(
                    "{what} {} of {}, {}: {:e} ulp at {:?}",
                    errors.component, case.name, case.limit, errors.ulp, errors.place
                )
            });
        }
    }
    worst.finish()
}

impl Case {
    /// Measures the case in some rounds; the first round does not depend on their number.
    pub fn measure(&self, rounds: u64) -> Found {
        let mut found = Found {
            points: rounds as usize * self.points,
            kernel: Errors::default(),
            derivative: self.derivative.map(|_| Errors::default()),
            naive: self.naive.map(|_| Errors::default()),
        };
        for round in 0..rounds {
            for x in points(&self.inputs, 1 + round, self.points) {
                self.see(&x, &mut found);
            }
        }
        found
    }

    fn see(&self, x: &[f64], found: &mut Found) {
        let exact = (self.oracle)(&x.iter().map(|&x| Wide::from_f64(x)).collect::<Vec<_>>());
        let scales = self.scales(x, &exact);
        let compare = |errors: &mut Errors, values: Vec<f64>| {
            assert_eq!(values.len(), exact.len(), "as many results as the oracle has: {}", self.name);
            for (i, value) in values.into_iter().enumerate() {
                errors.see(value, exact[i], scales[i], x, i);
            }
        };
        compare(&mut found.kernel, (self.kernel)(x));
        if let (Some(naive), Some(errors)) = (self.naive, &mut found.naive) {
            compare(errors, naive(x));
        }
        if let (Some(derivative), Some(errors)) = (self.derivative, &mut found.derivative) {
            let duals: Vec<Dual64> =
                x.iter().enumerate().map(|(i, &x)| Dual64::new(x, if i == 0 { 1.0 } else { 0.0 })).collect();
            let slopes = self.slopes(x, 0, None);
            let mut of_slopes = self.scales_of_slopes(x, &slopes);
            if self.natural_derivatives {
                of_slopes.iter_mut().zip(&scales).for_each(|(of_slope, scale)| *of_slope += scale / x[0].abs());
            }
            for (i, dual) in derivative(&duals).into_iter().enumerate() {
                errors.see(dual.eps, slopes[i], of_slopes[i], x, i);
            }
        }
    }

    /// Derivatives of the oracle by the input `by`; the input `moved` is changed slightly.
    fn slopes(&self, x: &[f64], by: usize, moved: Option<usize>) -> Vec<Wide> {
        let inputs: Vec<WideDual> = (0..x.len())
            .map(|i| {
                let change =
                    if moved == Some(i) { Wide::from_f64(x[i]) * Wide::from_f64(CHANGE) } else { Wide::from_f64(0.0) };
                let unit = if i == by { 1.0 } else { 0.0 };
                WideDual::new(Wide::from_f64(x[i]) + change, Wide::from_f64(unit))
            })
            .collect();
        (self.oracle_slope)(&inputs).into_iter().map(|result| result.eps).collect()
    }

    pub(super) fn scales(&self, x: &[f64], exact: &[Wide]) -> Vec<f64> {
        let mut scales: Vec<f64> = exact.iter().map(|f| f.high().abs()).collect();
        for (i, value) in x.iter().enumerate() {
            if *value != 0.0 {
                for (scale, slope) in scales.iter_mut().zip(self.slopes(x, i, None)) {
                    *scale += (value * slope.high()).abs();
                }
            }
        }
        self.shared(scales)
    }

    fn scales_of_slopes(&self, x: &[f64], slopes: &[Wide]) -> Vec<f64> {
        let mut scales: Vec<f64> = slopes.iter().map(|f| f.high().abs()).collect();
        for (i, value) in x.iter().enumerate() {
            if *value != 0.0 {
                for (k, moved) in self.slopes(x, 0, Some(i)).into_iter().enumerate() {
                    scales[k] += ((moved - slopes[k]).high() / CHANGE).abs();
                }
            }
        }
        self.shared(scales)
    }

    fn shared(&self, scales: Vec<f64>) -> Vec<f64> {
        match self.scale {
            Scale::Each => scales,
            Scale::Unit => vec![1.0; scales.len()],
            Scale::Vector => {
                let largest = crate::check::largest(scales.iter().copied());
                vec![largest; scales.len()]
            }
        }
    }
}
