//! Averages of Jacobi's functions over a period, from arithmetic-geometric means.

use crate::numerics::scalar::Real;

/// Relative difference of the means at which the next step makes them equal, including their derivatives.
const NEARLY_EQUAL: f64 = 1e-12;

/// Mean of `cn^2`, from `k^2` and `k'`. The smaller of the two determines the digits of the result and of its derivatives.
pub(crate) fn mean_of_cn2<S: Real>(parameter: S, complement: S) -> S {
    let one = S::one();
    if parameter.re() > 0.5 {
        mean_of_ratio(complement, one, [one, S::zero()])
    } else {
        one - mean_of_sn2(parameter, complement)
    }
}

/// Mean of `sn^2`, the sum `(1 - E/K) / k^2` of the sequence of means (DLMF 19.8.6), for `k^2 <= 1/2`.
fn mean_of_sn2<S: Real>(parameter: S, complement: S) -> S {
    let (mut a, mut b) = (S::one(), complement);
    // (c_n / k)^2 of the sequence: c_1 = k^2 / (2 (1 + k')).
    let first = (S::one() + complement) * 2.0;
    let mut square = parameter / (first * first);
    let (mut sum, mut weight) = (S::from_f64(0.5), 1.0);
    for _ in 0..40 {
        let share = square * weight;
        sum += share;
        if share.re() <= 1e-40 {
            break;
        }
        // c_(n+1) = c_n^2 / (4 a_(n+1))
        (a, b) = ((a + b) * 0.5, (a * b).sqrt());
        let next_a = (a + b) * 0.5;
        square = square * square * parameter / (next_a * next_a * 16.0);
        weight *= 2.0;
    }
    sum
}

/// Mean of `(a cn^2 + b sn^2) / (cn^2 + p sn^2)` for `p > 0`, from `k'`: Bulirsch's complete integral `cel(k', p, a, b)` over `K` (DLMF
/// 19.2.11), by steps whose sums are of one sign if `a` and `b` are.
pub(super) fn mean_of_ratio<S: Real>(complement: S, p: S, [a, b]: [S; 2]) -> S {
    let one = S::one();
    let mut root = p.sqrt();
    let (mut first, mut second) = (a, b / root);
    let (mut whole, mut part, mut product) = (one, complement, complement);
    // K = 2^steps pi / (2 whole)
    let mut power = 1.0;
    for _ in 0..40 {
        let half = product / root;
        (first, second) = (first + second / root, (second + first * half) * 2.0);
        root += half;
        let before = whole;
        whole += part;
        power *= 2.0;
        if (before - part).abs().re() <= before.re() * NEARLY_EQUAL {
            break;
        }
        part = product.sqrt() * 2.0;
        product = part * whole;
    }
    (second + first * whole) / ((whole + root) * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean is compared with the sum over the amplitude, which converges exponentially, and close to the separatrix with
    /// `1 / ln(4 / k')`, to the last digits.
    #[test]
    fn the_mean_of_cn_squared_has_its_digits_at_any_parameter() {
        for parameter in [0.0, 1e-9, 0.2, 0.49, 0.51, 0.8, 0.93_f64] {
            let points = 400;
            let (mut whole, mut part) = (0.0, 0.0);
            for i in 0..points {
                let (sin, cos) = (core::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(points)).sin_cos();
                let weight = 1.0 / (1.0 - parameter * sin * sin).sqrt();
                (whole, part) = (whole + weight, part + weight * cos * cos);
            }
            let found = mean_of_cn2(parameter, (1.0 - parameter).sqrt());
            assert!((found - part / whole).abs() < 2e-14, "{parameter}");
        }
        for complement in [1e-11, 1e-12, 1e-14, 1e-15_f64] {
            let (found, exact) = (mean_of_cn2(1.0, complement), 1.0 / (4.0 / complement).ln());
            assert!((found / exact - 1.0).abs() < 1.5e-15, "{complement}: {:e}", found / exact - 1.0);
        }
    }
}
