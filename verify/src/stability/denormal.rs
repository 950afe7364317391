//! Denormal inputs: below the smallest normal number 31 digits are not available, but there every kernel has a limit, which the oracle
//! determines from three inputs far above.

use super::input::{self, Input};
use super::measure::{Errors, spacing};
use super::{Case, Wide};
use crate::prelude::*;

/// Values of the first input: the smallest positive number, and some up to the smallest normal one.
const PLACES: [f64; 4] = [5e-324, 3.5e-321, 7.77e-313, 1.234e-308];

/// Inputs of the oracle, a decade apart.
const FROM: [f64; 3] = [1e-80, 1e-90, 1e-100];

/// Smallest magnitude of the other inputs, far above the first.
const LEAST_OTHER: f64 = 1e-12;

/// Sweeps that extend below this power of ten reach zero; the domain of others ends before.
const TO_ZERO: f64 = -140.0;

/// A tensor of rank one loses this property if its entries lose digits: it is refused, or known only to the remaining digits.
const LOSES_ITS_FORM: &str = "preferred_frame_parameter";

/// Points of a case.
pub const POINTS: usize = 10;

/// Results at denormal inputs.
#[derive(Debug, Clone, Default)]
pub struct Denormal {
    /// Number of points within the domain, out of [`POINTS`].
    pub points: usize,
    /// Number of values compared with their limit.
    pub compared: usize,
    /// Results that are neither constant nor go to zero or infinity as a power or a logarithm: a defect of this method.
    pub without_limit: usize,
    /// Largest error in ulp of the conditioned scale.
    pub errors: Errors,
}

/// The result at a small input, extrapolated from those at [`FROM`]: constant, a power, or linear in the logarithm.
fn limit(results: [Wide; 3], at: f64) -> Option<f64> {
    let [before, slope] = [results[0] - results[1], results[1] - results[2]].map(|difference| difference.high());
    let [far, near, nearer] = results.map(|result| result.high());
    if far == near && near == nearer {
        return Some(nearer);
    }
    let power = (near / nearer).ln() / (FROM[1] / FROM[2]).ln();
    // The exponents are multiples of a half.
    let half = (2.0 * power).round() / 2.0;
    if half > 0.0 && (power - half).abs() < 1e-14 {
        // The power is taken of the ratio, so that no factor underflows before the result does.
        return Some(nearer * (at / FROM[2]).powf(half));
    }
    let logarithm = (before / slope - 1.0).abs() < 1e-12;
    logarithm.then(|| nearer + slope * (at / FROM[2]).ln() / (FROM[1] / FROM[2]).ln())
}

impl Case {
    /// Whether the first input is swept to zero, and not to the end of a domain, and keeps all its digits there.
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
            // With their new values the other inputs may lie outside the domain.
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
                    // The scale approaches its limit as the value does.
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
