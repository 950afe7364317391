//! Formulas for 31 digits, where the kernels have constants, series or thresholds for 16 digits.

use crate::prelude::*;

/// Largest relative distance from the mean at which Carlson's series is summed: the first omitted terms are of degree 8.
const SERIES_RADIUS: f64 = 1e-6;

/// `pi`, to 32 digits.
pub fn pi<S: Real>() -> S {
    S::from_f64(core::f64::consts::PI) + S::from_f64(1.224_646_799_147_353_2e-16)
}

/// A quotient of whole numbers.
pub fn ratio<S: Real>(over: f64, under: f64) -> S {
    S::from_f64(over) / S::from_f64(under)
}

/// `beta = (4/15) 2F1(3/2, 3/2; 7/2; e^2)` of a spheroid: half-angle steps down to a shorter series than the kernel's.
///
/// The identity of the steps is that of the kernel. A test here compares its values with a table of 34 digits.
pub fn reduced_difference<S: Real>(q: S, q2: S, e2: S) -> S {
    if e2.re().abs() < 1e-3 || e2.re().is_nan() {
        let term = |k: f64| ratio::<S>((k + 1.5) * (k + 1.5), (k + 3.5) * (k + 1.0));
        return (0..16).rev().fold(S::one(), |sum, k| sum * e2 * term(f64::from(k)) + S::one()) * ratio::<S>(4.0, 15.0);
    }
    let half2 = (q + S::one()) / 2.0;
    let half = half2.sqrt();
    let next = reduced_difference(half, half2, e2 / (half2 * 4.0));
    let one = S::one();
    (S::from_f64(3.0) + (one + q2 * 2.0) * next / (half * 4.0)) / ((q + one + one) * (one + q) * (one + q))
}

/// `A_0, A_1, A_3` and `A_1 - q^2 A_3`.
pub fn potential_coefficients<S: Real>(q: S, q2: S, e2: S) -> [S; 4] {
    let difference = q * e2 * reduced_difference(q, q2, e2);
    let sum = S::one() + q2 * 2.0;
    let a3 = (S::one() - difference) * 2.0 / sum;
    // Of two equal expressions, this is the one whose derivative does not cancel.
    let a1 = if q2.re() > 1.0 { S::one() - a3 / 2.0 } else { (q2 * 2.0 + difference) / sum };
    let a0 = if q2.re() > 1e3 {
        // 2 q arsinh(s) / s, s^2 = q^2 - 1.
        let s = (q2 - S::one()).sqrt();
        q / s * (q + s).ln() * 2.0
    } else {
        a1 * 2.0 + q2 * a3
    };
    [a0, a1, a3, difference]
}

/// Carlson's `R_F`, by duplication of its arguments.
pub fn rf<S: Real>(x: S, y: S, z: S) -> S {
    let mut at = [x, y, z];
    for _ in 0..1000 {
        let mean = (at[0] + at[1] + at[2]) / 3.0;
        let [x, y, z] = at.map(|v| (mean - v) / mean);
        if [x, y, z].iter().all(|d| d.re().abs() < SERIES_RADIUS) {
            let (e2, e3) = (x * y + y * z + z * x, x * y * z);
            let r = ratio::<S>;
            let series = S::one() - e2 * r(1.0, 10.0) + e3 * r(1.0, 14.0) + e2 * e2 * r(1.0, 24.0)
                - e2 * e3 * r(3.0, 44.0)
                - e2 * e2 * e2 * r(5.0, 208.0)
                + e3 * e3 * r(3.0, 104.0)
                + e2 * e2 * e3 * r(1.0, 16.0);
            return series / mean.sqrt();
        }
        let lambda = lambda(&at);
        at = at.map(|v| (v + lambda) / 4.0);
    }
    S::from_f64(f64::NAN)
}

/// Carlson's `R_C(x, y) = R_F(x, y, y)`.
pub fn rc<S: Real>(x: S, y: S) -> S {
    rf(x, y, y)
}

/// Carlson's `R_J`.
pub fn rj<S: Real>(x: S, y: S, z: S, p: S) -> S {
    let (mut at, mut p, mut sum, mut scale) = ([x, y, z], p, S::zero(), S::one());
    for _ in 0..1000 {
        let mean = (at[0] + at[1] + at[2] + p * 2.0) / 5.0;
        let [x, y, z] = at.map(|v| (mean - v) / mean);
        let q = (mean - p) / mean;
        if [x, y, z, q].iter().all(|d| d.re().abs() < SERIES_RADIUS) {
            let e2 = x * y + y * z + z * x - q * q * 3.0;
            let e3 = x * y * z + e2 * q * 2.0 + q * q * q * 4.0;
            let e4 = (x * y * z * 2.0 + e2 * q + q * q * q * 3.0) * q;
            let e5 = x * y * z * q * q;
            return sum * 6.0 + scale * series([e2, e3, e4, e5]) / (mean * mean.sqrt());
        }
        let roots = at.map(S::sqrt);
        let root = p.sqrt();
        let d = (root + roots[0]) * (root + roots[1]) * (root + roots[2]);
        let one = S::one();
        let e = (p - at[0]) * (p - at[1]) * (p - at[2]) / (d * d);
        // 1 + e cancels for small p; then it is computed as 2 sqrt p (p + lambda) / d.
        let lambda = lambda(&at);
        let y = if e.re() < -0.5 { root * (p + lambda) * 2.0 / d } else { one + e };
        sum += scale / d * rc(one, y);
        scale = scale / 4.0;
        at = at.map(|v| (v + lambda) / 4.0);
        p = (p + lambda) / 4.0;
    }
    S::from_f64(f64::NAN)
}

/// Series of `R_J` and `R_D` in the elementary symmetric functions of the deviations from the mean (DLMF 19.36.2).
fn series<S: Real>([e2, e3, e4, e5]: [S; 4]) -> S {
    let r = ratio::<S>;
    S::one() - e2 * r(3.0, 14.0) + e3 * r(1.0, 6.0) + e2 * e2 * r(9.0, 88.0)
        - e4 * r(3.0, 22.0)
        - e2 * e3 * r(9.0, 52.0)
        + e5 * r(3.0, 26.0)
        - e2 * e2 * e2 * r(1.0, 16.0)
        + e3 * e3 * r(3.0, 40.0)
        + e2 * e4 * r(3.0, 20.0)
}

/// Carlson's `R_D(x, y, z) = R_J(x, y, z, z)`, by a separate duplication: `R_J` would cancel in `p - z`.
pub fn rd<S: Real>(x: S, y: S, z: S) -> S {
    let (mut at, mut sum, mut scale) = ([x, y, z], S::zero(), S::one());
    for _ in 0..1000 {
        let mean = (at[0] + at[1] + at[2] * 3.0) / 5.0;
        let [x, y, z] = at.map(|v| (mean - v) / mean);
        if [x, y, z].iter().all(|d| d.re().abs() < SERIES_RADIUS) {
            let (xy, z2) = (x * y, z * z);
            let (e2, e3) = (xy - z2 * 6.0, (xy * 3.0 - z2 * 8.0) * z);
            let (e4, e5) = ((xy - z2) * z2 * 3.0, xy * z2 * z);
            return sum * 3.0 + scale * series([e2, e3, e4, e5]) / (mean * mean.sqrt());
        }
        let lambda = lambda(&at);
        sum += scale / (at[2].sqrt() * (at[2] + lambda));
        scale = scale / 4.0;
        at = at.map(|v| (v + lambda) / 4.0);
    }
    S::from_f64(f64::NAN)
}

fn lambda<S: Real>(at: &[S; 3]) -> S {
    let [x, y, z] = at.map(S::sqrt);
    x * y + y * z + z * x
}
