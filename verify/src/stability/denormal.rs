//! Denormal inputs: below the smallest normal number 31 digits are not available, but there every kernel has its limit, which the oracle
//! determines from three inputs far above.

use super::input::{self, Input};
use super::measure::{Errors, spacing};
use super::{Case, Wide};
use crate::prelude::*;

/// Where the first input is put: the smallest number of all, and some up to the smallest normal one.
const PLACES: [f64; 4] = [5e-324, 3.5e-321, 7.77e-313, 1.234e-308];

/// Inputs of the oracle, a decade apart: far from its other inputs, with 31 digits for products of both.
const FROM: [f64; 3] = [1e-80, 1e-90, 1e-100];

/// Least of the other inputs, so that the first one is the smallest by far.
const LEAST_OTHER: f64 = 1e-12;

/// Sweeps that go farther down than this reach zero; the domain of others ends before.
const TO_ZERO: f64 = -140.0;

/// A tensor of rank one loses its form where its entries lose their digits: it is refused, or known to what is left.
const LOSES_ITS_FORM: &str = "preferred_frame_parameter";

/// Points of a case.
pub const POINTS: usize = 10;

/// What was found at denormal inputs.
#[derive(Debug, Clone, Default)]
pub struct Denormal {
    /// Points within the domain, of [`POINTS`].
    pub points: usize,
    /// Numbers compared with their limit.
    pub compared: usize,
    /// Results that go to zero or infinity neither as a power, nor as a logarithm, nor are constant: a defect of this measure.
    pub without_limit: usize,
    /// Largest error in ulp of the conditioned scale.
    pub errors: Errors,
}

/// A result at a small input, from those at [`FROM`]: constant, a power, or linear in the logarithm.
fn limit(results: [Wide; 3], at: f64) -> Option<f64> {
    let [before, slope] = [results[0] - results[1], results[1] - results[2]].map(|difference| difference.high());
    let [far, near, nearer] = results.map(|result| result.high());
    if far == near && near == nearer {
        return Some(nearer);
    }
    let power = (near / nearer).ln() / (FROM[1] / FROM[2]).ln();
    // Powers of what is swept are multiples of a half.
    let half = (2.0 * power).round() / 2.0;
    if half > 0.0 && (power - half).abs() < 1e-14 {
        // Each factor of the power by itself: no part of it underflows before the whole does.
        return Some(nearer * (at / FROM[2]).powf(half));
    }
    let logarithm = (before / slope - 1.0).abs() < 1e-12;
    logarithm.then(|| nearer + slope * (at / FROM[2]).ln() / (FROM[1] / FROM[2]).ln())
}

impl Case {
    /// Whether the first input is swept to zero, not to the end of a domain, and has all its digits there.
    pub fn goes_to_zero(&self) -> bool {
        let to_zero = matches!(self.inputs[0], Input::Log(low, _) | Input::Signed(low, _) if low < TO_ZERO);
        to_zero && self.name != LOSES_ITS_FORM
    }

    /// Values at denormal numbers.
    pub fn measure_denormal(&self) -> Denormal {
        let mut found = Denormal::default();
        for mut x in input::points(&self.inputs, 1, POINTS) {
            let sign = x[0].signum();
            for other in x.iter_mut().filter(|x| **x != 0.0) {
                *other = other.abs().max(LEAST_OTHER).copysign(*other);
            }
            let results = FROM.map(|from| {
                x[0] = sign * from;
                (self.oracle)(&x.iter().map(|&x| Wide::from_f64(x)).collect::<Vec<_>>())
            });
            // The other inputs, as they are now, may lie outside of the domain.
            if results.iter().flatten().any(|result| result.high().is_nan()) {
                continue;
            }
            found.points += 1;
            let scales = self.scales(&x, &results[2]);
            for place in PLACES {
                x[0] = sign * place;
                for (k, value) in (self.kernel)(&x).into_iter().enumerate() {
                    let nearer = results[2][k].high();
                    let Some(exact) = limit(results.each_ref().map(|all| all[k]), place) else {
                        found.without_limit += 1;
                        continue;
                    };
                    found.compared += 1;
                    // The scale goes to the limit as the value does.
                    let scale = if exact == nearer { scales[k] } else { (scales[k] / nearer * exact).abs() };
                    let ulp = (value - exact).abs() / spacing(scale);
                    if ulp > found.errors.ulp || ulp.is_nan() {
                        found.errors = Errors { ulp, place: x.clone(), component: k, ..Errors::default() };
                    }
                }
            }
        }
        found
    }
}
