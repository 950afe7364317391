//! Jacobi's elliptic functions `sn`, `cn`, `dn` by the arithmetic-geometric mean (Landen's descending transformation, DLMF
//! 22.7(i), 22.20(ii)).
//!
//! Written here because no maintained Rust crate has them. The complementary parameter `m1 = 1 - m = k'^2` is the argument,
//! so that no precision is lost as `m -> 1`; `m1 > 1`, a negative parameter, is allowed.
//!
//! # Example
//!
//! ```
//! use twofold::numerics::elliptic::jacobi::{ArithmeticGeometricMean, complete_integral, jacobi};
//!
//! // By the complementary parameter m1 = 1 - k^2, which keeps its digits near the separatrix.
//! let quarter: f64 = complete_integral(0.5);
//! assert!((quarter - 1.854_074_677_301_372).abs() < 1e-15);
//! let end = jacobi(quarter, 0.5);
//! assert!((end.sn - 1.0).abs() < 1e-15 && end.cn.abs() < 1e-15 && (end.dn - 0.5_f64.sqrt()).abs() < 1e-15);
//! let mean = ArithmeticGeometricMean::new(1.0, 2.0_f64.sqrt());
//! assert!((mean.limit() - 1.198_140_234_735_592_f64).abs() < 1e-15);
//! ```

use core::f64::consts::FRAC_PI_2;

use crate::numerics::scalar::Real;

/// Relative difference of the means at which one more step makes them equal to rounding.
const NEARLY_EQUAL: f64 = 1e-9;

/// Additional steps, after which the derivatives of the first three orders have converged too.
const STEPS_FOR_DERIVATIVES: usize = 2;

/// Below this `1 - share` keeps its digits, in a step with `dn = (1 - share) / (1 + share)`.
const SMALL_SHARE: f64 = 0.5;

/// More steps than any start needs: the ratio of the means is replaced by its square root, later their difference by its
/// square.
const MOST_STEPS: usize = 20;

/// The arithmetic-geometric mean of two positive numbers with its steps: a sequence of Landen transformations for the Jacobi
/// functions of parameter `m = 1 - (b/a)^2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArithmeticGeometricMean<S> {
    /// The larger and the smaller starting value and the means after each step; the first `used` of them count, the last is
    /// the limit.
    steps: [(S, S); MOST_STEPS],
    used: usize,
    /// Whether `a < b`, a negative parameter: the steps then start with `(b, a)`.
    negative_parameter: bool,
}

/// The values `sn(u | m)`, `cn(u | m)`, `dn(u | m)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JacobiFunctions<S> {
    /// Sine amplitude; divided by `a` in the result of [`ArithmeticGeometricMean::functions`].
    pub sn: S,
    /// Cosine amplitude.
    pub cn: S,
    /// Delta amplitude.
    pub dn: S,
}

impl<S: Real> ArithmeticGeometricMean<S> {
    /// The mean of `a` and `b`, both above zero and with a finite sum; NaN unless both are above zero.
    pub fn new(a: S, b: S) -> Self {
        // The means of a positive number and zero would only halve, and stop before their limit zero.
        let b = if a.re() > 0.0 && b.re() > 0.0 { b } else { S::from_f64(f64::NAN) };
        let negative_parameter = a.re() < b.re();
        let mut steps = [if negative_parameter { (b, a) } else { (a, b) }; MOST_STEPS];
        let (mut used, mut to_go) = (1, STEPS_FOR_DERIVATIVES + 1);
        while used < MOST_STEPS && to_go > 0 {
            let (a, b) = steps[used - 1];
            if (a - b).re().abs() <= NEARLY_EQUAL * a.re() {
                to_go -= 1;
            }
            let product = a * b;
            // With fewer roundings, but only while the product neither under- nor overflows.
            let root = if product.re().is_normal() { product.sqrt() } else { a.sqrt() * b.sqrt() };
            steps[used] = ((a + b) * 0.5, root);
            used += 1;
        }
        Self { steps, used, negative_parameter }
    }

    /// The mean itself.
    pub fn limit(&self) -> S {
        self.steps[self.used - 1].0
    }

    /// `K(m) / a = pi / (2 AGM(a, b))`: the time in which `sn(a t | m)` rises from 0 to 1.
    pub(crate) fn quarter_period(&self) -> S {
        S::from_f64(FRAC_PI_2) / self.limit()
    }

    /// `sn(a t | m) / a`, `cn(a t | m)`, `dn(a t | m)` for `|t|` up to half the quarter period `K(m) / a`.
    ///
    /// Relative error of each a few ulp there, also for `m -> 1`; it grows towards the zeros of `cn` beyond. Squares of `a` and `b` must neither
    /// overflow nor underflow.
    pub fn functions(&self, t: S) -> JacobiFunctions<S> {
        let (sin, cos) = (self.limit() * t).sin_cos();
        let mut f = JacobiFunctions { sn: sin / self.limit(), cn: cos, dn: S::one() };
        for &(a, b) in self.steps[..self.used - 1].iter().rev() {
            let c2 = (a - b) * (a + b);
            let share = c2 * f.sn * f.sn * 0.25;
            let denominator = S::one() + share;
            let (sn, cn) = (f.sn / denominator, f.cn * f.dn / denominator);
            // If `dn` were computed from `cn`, which has a factor `dn` of the previous step, an error would double at each step; but for small
            // `dn` the other form cancels.
            let dn = if share.re() < SMALL_SHARE {
                (S::one() - share) / denominator
            } else {
                (b * b + c2 * cn * cn).sqrt() / a
            };
            f = JacobiFunctions { sn, cn, dn };
        }
        if self.negative_parameter {
            // DLMF 22.17(i): nothing cancels in the functions of the positive parameter.
            return JacobiFunctions { sn: f.sn / f.dn, cn: f.cn / f.dn, dn: S::one() / f.dn };
        }
        f
    }
}

/// `K(m) = int_0^{pi/2} dphi / sqrt(1 - m sin^2 phi)`, the complete integral of the first kind, from `m1 = 1 - m > 0`.
///
/// Error: a few ulp. The logarithmic growth as `m1 -> 0` is resolved down to the smallest `m1`.
pub fn complete_integral<S: Real>(m1: S) -> S {
    ArithmeticGeometricMean::new(S::one(), m1.sqrt()).quarter_period()
}

/// `sn`, `cn`, `dn` of the real argument `u` and the complementary parameter `m1 = 1 - m > 0` (DLMF 22.2).
///
/// Error: a few ulp relative for `|u|` up to `K/2` and relative to the largest value elsewhere, plus the rounding of `u`
/// modulo `4 K`, about `2e-16 |u|` times the slope. Derivatives to the third order: by `u` as accurate as the values, by `m1`
/// relative to their natural size, value over powers of `m1`. NaN unless `m1 > 0` (at `m = 1` they are `tanh` and `sech`).
pub fn jacobi<S: Real>(u: S, m1: S) -> JacobiFunctions<S> {
    let complement = m1.sqrt();
    let ladder = ArithmeticGeometricMean::new(S::one(), complement);
    let quarter = ladder.quarter_period();
    let half_periods = (u.re() / (quarter.re() * 2.0)).round();
    let sign = if half_periods.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    let u = u - quarter * (half_periods * 2.0);
    let f = if u.re().abs() <= 0.5 * quarter.re() {
        ladder.functions(u)
    } else {
        // From the other end of the quarter period: sn(K - u) = cn/dn, cn(K - u) = k' sn/dn, dn(K - u) = k'/dn.
        let side = if u.re() < 0.0 { -1.0 } else { 1.0 };
        let f = ladder.functions(quarter - u * side);
        JacobiFunctions { sn: f.cn / f.dn * side, cn: complement * f.sn / f.dn, dn: complement / f.dn }
    };
    JacobiFunctions { sn: f.sn * sign, cn: f.cn * sign, dn: f.dn }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of `a` and 2 a is 1.456791031046907 a. That of `a` and `b` far below it is `pi a / (2 ln(4 a / b))`.
    #[test]
    fn means_of_tiny_and_of_huge_numbers_keep_their_digits() {
        let mean = |a: f64, b: f64| ArithmeticGeometricMean::new(a, b).limit();
        for a in [1e-300, 1e-200, 1e-160, 1.0, 1e160, 1e300] {
            assert!((mean(a, 2.0 * a) / a - 1.456_791_031_046_907).abs() < 1e-14, "{a:e}: {:e}", mean(a, 2.0 * a));
            assert_eq!(mean(a, a), a);
        }
        let far = FRAC_PI_2 * 1e300 / (4.0_f64.ln() + 600.0 * 10.0_f64.ln());
        assert!((mean(1e-300, 1e300) / far - 1.0).abs() < 1e-14, "{:e} {far:e}", mean(1e-300, 1e300));
        assert!([(0.0, 1.0), (1.0, 0.0), (-1.0, -1.0)].iter().all(|(a, b)| mean(*a, *b).is_nan()));
    }
}
