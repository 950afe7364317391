//! Coefficients of the Newtonian potential inside a uniform spheroid. Eqs. (73), (74).
//!
//! The closed forms of Eq. (74) lose all digits near the sphere and are 0/0 on it. Here everything is computed from one
//! positive function of the shape,
//!
//! ```text
//! beta = (A_1 - q^2 A_3) / (q e^2) = int_0^1 v^(1/2) (1 - v) (1 - e^2 v)^(-3/2) dv = (4/15) 2F1(3/2, 3/2; 7/2; e^2)
//! ```
//!
//! by half-angle steps. With `q = cos(theta)` (or `cosh`), `N(theta) = theta (2 + cos 2 theta) - (3/2) sin 2 theta` and
//! `beta = N(theta) / sin^5(theta)`, the addition theorems give, with `q' = cos(theta / 2) = sqrt((1 + q) / 2)`,
//!
//! ```text
//! beta(q) = [3 + (1 + 2 q^2) beta(q') / (4 q')] / [(2 + q) (1 + q)^2],      e'^2 = e^2 / (2 (1 + q))
//! ```
//!
//! Every term is positive for every shape, so nothing cancels; every step is analytic, so derivatives are as regular as
//! values; and a step brings the spheroid four times closer to the sphere, where a short series ends the recursion.
//!
//! For a needle, `q > 64`, the closed form loses nothing, and avoids the accumulated rounding of some ten steps:
//!
//! ```text
//! A_1 - q^2 A_3 = 3 (1 + u) - (2 + 3 u) p,   A_0 = 2 p,   p = sqrt(1 + u) ln(q + sqrt(q^2 - 1)),   u = 1 / (q^2 - 1)
//! ```
//!
//! ```
//! use twofold::star::potential_coefficients::{potential_coefficients, reduced_difference};
//! use twofold::star::spheroid_shape::SpheroidShape;
//!
//! let shape = SpheroidShape::from_axis_ratio(0.9_f64)?;
//! let a = potential_coefficients(&shape);
//! assert!((2.0 * a.a1 + a.a3 - 2.0).abs() < 1e-15 && (a.a1 - 0.81 * a.a3 - a.difference).abs() < 1e-14);
//! assert!((reduced_difference(&shape) * 0.9 * shape.eccentricity_squared() / a.difference - 1.0).abs() < 1e-14);
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::numerics::rounding::{two_product, two_sum};
use crate::numerics::scalar::Real;
use crate::star::spheroid_shape::SpheroidShape;

/// For `|e^2|` below this the series in `e^2` is summed: the first neglected term is 2e-22 of the sum, and still 1e-16 of it
/// after two differentiations.
const SERIES_RADIUS: f64 = 1.0 / 64.0;
const SERIES_TERMS: usize = 12;

/// Axis ratio of a needle.
const NEEDLE: f64 = 64.0;

/// Coefficients of `Phi = -pi rho (A_0 - A_1 (x^2 + y^2) - A_3 z^2)` inside a uniform spheroid, Eq. (73).
///
/// Largest errors found against 40-digit values at 100,000 random shapes (`e` from 1e-13 to 0.999, `a3 / a1` from 1 to 10):
/// `A_0` 3.6 ulp, `A_1` 3.1 ulp, `A_3` 3.2 ulp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PotentialCoefficients<S> {
    /// `A_0 / a1^2 = 2 q arcsin(e) / e`, Eq. (74). Equal to `2 A_1 + q^2 A_3`.
    pub a0: S,
    /// `A_1 = A_2 = (q / e^2) (arcsin(e) / e - q)`, Eq. (74).
    pub a1: S,
    /// `A_3 = (2 / e^2) (1 - q arcsin(e) / e)`, Eq. (74). Equal to `2 - 2 A_1`.
    pub a3: S,
    /// `A_1 - q^2 A_3 = q e^2 beta`, the bracket of Eqs. (75) and (77) in units of `a1^2`: zero for the sphere, negative for
    /// a prolate spheroid, and `(4/15) e^2` near the sphere.
    pub difference: S,
}

/// Coefficients of Eq. (74) for any shape, to full precision and with regular derivatives at the sphere.
///
/// With `D = A_1 - q^2 A_3` and the sum rule `2 A_1 + A_3 = 2`, all are sums of terms of one sign:
/// `A_1 = (2 q^2 + D) / (1 + 2 q^2)`, `A_3 = 2 (1 - D) / (1 + 2 q^2)`, `A_0 = 2 (3 q^2 + e^2 D) / (1 + 2 q^2)`. For a
/// prolate spheroid `A_1 = 1 - A_3 / 2` is used, because its derivatives do not cancel.
pub fn potential_coefficients<S: Real>(shape: &SpheroidShape<S>) -> PotentialCoefficients<S> {
    let (q, q2, e2) = (shape.axis_ratio, shape.axis_ratio_squared, shape.eccentricity_squared);
    let sum = q2 * 2.0 + S::one();
    if q.re() > NEEDLE {
        let (difference, a0) = needle(q, q2);
        let a3 = (S::one() - difference) * 2.0 / sum;
        return PotentialCoefficients { a0, a1: S::one() - a3 * 0.5, a3, difference };
    }
    let difference = e2 * reduced_difference(shape) * q;
    let a3 = (S::one() - difference) * 2.0 / sum;
    let a1 = if q2.re() > 1.0 { S::one() - a3 * 0.5 } else { (q2 * 2.0 + difference) / sum };
    PotentialCoefficients { a0: (q2 * 3.0 + e2 * difference) * 2.0 / sum, a1, a3, difference }
}

/// `A_1 - q^2 A_3` and `A_0` of a needle, by the formulas of the module documentation.
fn needle<S: Real>(q: S, q2: S) -> (S, S) {
    let u = S::one() / (q2 - S::one());
    let root = (u + S::one()).sqrt();
    // q + sqrt(q^2 - 1) = q (1 + 1 / root).
    let p = root * (q * (S::one() + S::one() / root)).ln();
    ((u + S::one()) * 3.0 - (u * 3.0 + S::from_f64(2.0)) * p, p * 2.0)
}

/// The function `beta = (A_1 - q^2 A_3) / (q e^2)` of the module documentation: positive, analytic, 4/15 for the sphere.
pub fn reduced_difference<S: Real>(shape: &SpheroidShape<S>) -> S {
    let (q, q2, e2) = (shape.axis_ratio, shape.axis_ratio_squared, shape.eccentricity_squared);
    if q.re() > NEEDLE { needle(q, q2).0 / (q * e2) } else { half_angle_step(q, q2, e2) }
}

fn half_angle_step<S: Real>(q: S, q2: S, e2: S) -> S {
    // NaN ends here as well.
    if e2.re().abs() < SERIES_RADIUS || e2.re().is_nan() {
        return near_sphere(e2);
    }
    let next_q2 = (q + S::one()) * 0.5;
    let next_q = next_q2.sqrt();
    let next = half_angle_step(next_q, next_q2, e2 / (next_q2 * 4.0));
    let three = S::from_f64(3.0);
    let carried = (q2 * 2.0 + S::one()) * next / (next_q * 4.0);
    let (denominator, lost) = denominator(q);
    // The rounding error of the denominator is applied to the smaller term, where the correction itself rounds least.
    (three + (carried - (three + carried) * (lost / denominator))) / denominator
}

/// `(2 + q) (1 + q)^2` and its rounding error: without the second part this would make up half of the error of `C`.
fn denominator<S: Real>(q: S) -> (S, S) {
    let (two, two_lost) = two_sum(S::from_f64(2.0), q);
    let (one, one_lost) = two_sum(S::one(), q);
    let (square, square_lost) = two_product(one, one);
    let (product, product_lost) = two_product(two, square);
    (product, product_lost + two * (square_lost + one * one_lost * 2.0) + two_lost * square)
}

/// `(4/15) 2F1(3/2, 3/2; 7/2; e^2)` by its series.
fn near_sphere<S: Real>(e2: S) -> S {
    let mut sum = S::one();
    for k in (0..SERIES_TERMS).rev().map(|k| k as f64) {
        sum = sum * e2 * ((k + 1.5) * (k + 1.5) / ((k + 3.5) * (k + 1.0))) + S::one();
    }
    sum * (4.0 / 15.0)
}
