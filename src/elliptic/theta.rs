//! Jacobi's theta functions with their nome (DLMF 20.2, 20.7, 22.2), for motions that are functions of one phase and its turns.
//!
//! Their series converge as `q^(n^2)`: three terms serve most parameters, a dozen those within rounding of `k = 1`.
//!
//! Written here because no maintained Rust crate has them at complex arguments, without overflow.
//!
//! # Example
//!
//! ```
//! use twofold::elliptic::jacobi::{complete_integral, jacobi};
//! use twofold::elliptic::theta::{Nome, ThetaSeries};
//!
//! let (m, m1) = (0.3, 0.7_f64);
//! let nome = Nome::new(m, m1);
//! let series = ThetaSeries::new(nome.q, 0.5, nome.q / 0.5);
//! // At z = pi u / (2 K).
//! let z = 0.4_f64;
//! let at = series.at(z.sin(), z.cos());
//! let same = jacobi(z * complete_integral(m1) * core::f64::consts::FRAC_2_PI, m1);
//! assert!((at.sn - same.sn).abs() < 1e-15 && (at.dn - same.dn).abs() < 1e-15);
//! ```

use core::f64::consts::PI;

use crate::scalar::Real;

/// Most terms of a series: `q < 0.88` for `m1 > 1e-33`.
const MOST_TERMS: usize = 18;

/// Size below which the terms of a series are left out.
const NEGLIGIBLE: f64 = 1e-20;

/// The nome `q = exp(-pi K'/K)` of a parameter `m`, with the ratio that stays finite where both vanish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nome<S> {
    /// `q`.
    pub q: S,
    /// `q / m`; `1/16` at `m = 0`.
    pub q_over_m: S,
}

impl<S: Real> Nome<S> {
    /// From the parameter `m` in `[0, 1)` and its complement `m1 = 1 - m > 0`, which the caller knows without cancellation.
    pub fn new(m: S, m1: S) -> Self {
        if m.re() <= 0.5 {
            let (over_m, series) = epsilon(m, m1);
            return Self { q: m * over_m * series, q_over_m: over_m * series };
        }
        let (over_m1, series) = epsilon(m1, m);
        let q = (S::from_f64(PI * PI) / (m1 * over_m1 * series).ln()).exp();
        Self { q, q_over_m: q / m }
    }
}

/// `epsilon / m` with `epsilon = (1 - sqrt k') / (2 (1 + sqrt k'))`, and `q / epsilon = 1 + 2 epsilon^4 + ...` (DLMF 19.5.5), for `m <= 1/2`.
fn epsilon<S: Real>(m: S, m1: S) -> (S, S) {
    let complement = m1.sqrt();
    let root = complement.sqrt() + S::one();
    let over_m = S::one() / (root * root * (complement + S::one()) * 2.0);
    let e = m * over_m;
    let e4 = (e * e) * (e * e);
    let [two, fifteen, many] = [2.0, 15.0, 150.0].map(S::from_f64);
    (over_m, S::one() + e4 * (two + e4 * (fifteen + e4 * (many + e4 * 1707.0))))
}

/// The series of a nome, and of one imaginary shift of the argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThetaSeries<S> {
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

/// Theta functions at one real argument, and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtPhase<S> {
    /// `sn(u)` for `z = pi u / (2 K)`.
    pub sn: S,
    /// `cn(u)`.
    pub cn: S,
    /// `dn(u)`.
    pub dn: S,
    /// `theta_4'(z) / theta_4(z)`: Jacobi's zeta function is `pi / (2 K)` times this.
    pub slope: S,
    /// A complex number (real and imaginary part) in the direction of `i theta_1(z + i eta)`.
    pub shifted: [S; 2],
}

impl<S: Real> ThetaSeries<S> {
    /// For the nome `q`, and for `theta_1(z + i eta)` with `r = exp(-2 eta)` between `q` and one, given with `q / r`.
    pub fn new(q: S, r: S, q_over_r: S) -> Self {
        let zero = S::zero();
        let mut series = Self {
            terms: 0,
            odd: [zero; MOST_TERMS],
            even: [zero; MOST_TERMS],
            shifted: [[zero; 2]; MOST_TERMS],
            ratios: [zero; 3],
        };
        // q^(n^2), q^(n (n+1)), and q^(n (n+1)) / r^n, of which each factor q^2n / r is at most q.
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
            // To n + 1: q^(2n+1) more in the squares, q^(2n+2) in the oblongs.
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

    /// At the argument whose sine and cosine are given.
    pub fn at(&self, sin: S, cos: S) -> AtPhase<S> {
        let zero = S::zero();
        let [mut one, mut two, mut three, mut four, mut slope] = [zero; 5];
        let mut shifted = [zero; 2];
        // Turned by 2 z from each term to the next: (2n+1) z in the odd series, 2 n z in the even ones.
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

    /// Slope of the angle of [`shifted`](AtPhase::shifted) at `z = 0`.
    pub fn slope_of_shifted(&self) -> S {
        let (mut across, mut along) = (S::zero(), S::zero());
        for n in 0..self.terms {
            across += self.shifted[n][1] * (2 * n + 1) as f64;
            along += self.shifted[n][0];
        }
        across / along
    }
}
