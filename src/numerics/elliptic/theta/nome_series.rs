//! Theta functions by their series in the nome (DLMF 20.2), for nomes that are not near one.

use crate::numerics::scalar::Real;

use super::AtPhase;

/// Maximum number of terms of a series below [`TRANSFORMED`](super::TRANSFORMED).
const MOST_TERMS: usize = 8;

/// Terms of the series below this size are left out.
const NEGLIGIBLE: f64 = 1e-20;

/// The series of a nome, and of one imaginary shift of the argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NomeSeries<S> {
    terms: usize,
    /// `(-1)^n q^(n (n + 1))`.
    odd: [S; MOST_TERMS],
    /// `2 (-1)^n q^(n^2)`, one at `n = 0`.
    even: [S; MOST_TERMS],
    /// Coefficients of `cos((2n+1) z)` and `sin((2n+1) z)` in the shifted series.
    shifted: [[S; 2]; MOST_TERMS],
    /// `theta_3(0) / theta_2(0)`, `theta_4(0) / theta_2(0)`, `theta_4(0) / theta_3(0)`, without the factor of `theta_2`.
    ratios: [S; 3],
}

impl<S: Real> NomeSeries<S> {
    /// See [`ThetaSeries::new`](super::ThetaSeries::new).
    pub(super) fn new(q: S, r: S, q_over_r: S) -> Self {
        let zero = S::zero();
        let mut series = Self {
            terms: 0,
            odd: [zero; MOST_TERMS],
            even: [zero; MOST_TERMS],
            shifted: [[zero; 2]; MOST_TERMS],
            ratios: [zero; 3],
        };
        // q^(n^2), q^(n (n+1)), and q^(n (n+1)) / r^n, in which each factor q^2n / r is at most q.
        let (mut square, mut oblong, mut weight) = (S::one(), S::one(), S::one());
        let mut r_power = r;
        let mut q_power = S::one();
        let [mut two, mut three, mut four] = [zero; 3];
        let mut sign = 1.0;
        for n in 0..MOST_TERMS {
            series.odd[n] = oblong * sign;
            series.even[n] = square * if n == 0 { 1.0 } else { 2.0 * sign };
            series.shifted[n] = [weight * (r_power - S::one()) * sign, weight * (r_power + S::one()) * sign];
            two += oblong;
            three += square * if n == 0 { 1.0 } else { 2.0 };
            four += series.even[n];
            series.terms = n + 1;
            // From n to n + 1: a factor q^(2n+1) in the squares, q^(2n+2) in the oblongs.
            let odd_power = q_power * q;
            square *= odd_power;
            q_power = odd_power * q;
            oblong *= q_power;
            weight *= odd_power * q_over_r;
            r_power = r_power * r * r;
            sign = -sign;
            // Where q vanishes its derivatives are in the second term.
            if n > 0 && square.re() < NEGLIGIBLE && weight.re() < NEGLIGIBLE {
                break;
            }
        }
        series.ratios = [three / two, four / two, four / three];
        series
    }

    pub(super) fn at(&self, sin: S, cos: S) -> AtPhase<S> {
        let zero = S::zero();
        let [mut one, mut two, mut three, mut four, mut slope] = [zero; 5];
        let mut shifted = [zero; 2];
        // The argument advances by 2 z from each term to the next: (2n+1) z in the odd series, 2 n z in the even ones.
        let (sin_2, cos_2) = (sin * cos * 2.0, S::one() - sin * sin * 2.0);
        let mut odd = [cos, sin];
        let mut even = [S::one(), zero];
        let turned = |[c, s]: [S; 2]| [c * cos_2 - s * sin_2, s * cos_2 + c * sin_2];
        let mut sign = 1.0;
        for n in 0..self.terms {
            one += self.odd[n] * odd[1];
            two += self.odd[n] * sign * odd[0];
            three += self.even[n] * sign * even[0];
            four += self.even[n] * even[0];
            slope -= self.even[n] * even[1] * (2 * n) as f64;
            shifted[0] += self.shifted[n][0] * odd[0];
            shifted[1] += self.shifted[n][1] * odd[1];
            (odd, even, sign) = (turned(odd), turned(even), -sign);
        }
        let [of_sn, of_cn, of_dn] = self.ratios;
        AtPhase {
            sn: of_sn * one / four,
            cn: of_cn * two / four,
            dn: of_dn * three / four,
            slope: slope / four,
            shifted,
        }
    }
}
