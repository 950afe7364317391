//! Theta functions by Jacobi's imaginary transformation (DLMF 20.7.30 to 20.7.33), for nomes near one.
//!
//! With `q = exp(-a)`, `Q = exp(-pi^2 / a)`, `w = pi z / a` and a factor `sqrt(pi / a) exp(-z^2 / a)` that is common to all four
//!
//! ```text
//! theta_1 = 2 sum (-1)^n Q^((n+1/2)^2) sinh((2n+1) w)        theta_4 = 2 sum Q^((n+1/2)^2) cosh((2n+1) w)
//! theta_2 = 1 + 2 sum (-1)^n Q^(n^2) cosh(2n w)              theta_3 = 1 + 2 sum Q^(n^2) cosh(2n w)
//! ```
//!
//! No sum cancels for `z` in [0, pi/4]; beyond, `z = pi/2 - y` exchanges `theta_1` with `theta_2` and `theta_3` with `theta_4`.

use core::f64::consts::PI;

use crate::numerics::scalar::Real;

use super::AtPhase;

/// Terms after the first: the next is below 1e-40 at `q = 0.3`.
const TERMS: usize = 4;

/// The series of one nome and one imaginary shift `eta`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transformed<S> {
    decay: S,
    /// `pi / a`.
    growth: S,
    /// `Q^(n^2)` and `Q^(n^2 - n)` from `n = 0`.
    squares: [S; TERMS + 1],
    oblongs: [S; TERMS + 2],
    /// `pi eta / a`, with cosine and sine of its multiples from zero.
    turned: S,
    multiples: [[S; 2]; 2 * TERMS + 2],
    /// `theta_3(0) / theta_2(0)`, and without their factor `Q^(1/4)` `theta_4(0) / theta_2(0)` and `theta_4(0) / theta_3(0)`.
    ratios: [S; 3],
}

/// The sums at an argument in [0, pi/4], of `theta_1` and `theta_4` in units of `Q^(1/4) exp(w)`.
struct Sums<S> {
    one: S,
    two: S,
    three: S,
    four: S,
    /// Derivatives of the sums for `theta_3` and `theta_4` with respect to `w`.
    three_slope: S,
    four_slope: S,
    /// Real and imaginary part of the sums for `theta_1` at `z + i eta`, and for `theta_2` at `z - i eta`.
    one_shifted: [S; 2],
    two_shifted: [S; 2],
}

impl<S: Real> Transformed<S> {
    /// See [`ThetaSeries::transformed`](super::ThetaSeries::transformed).
    pub(super) fn new(decay: S, turned: S) -> Self {
        let one = S::one();
        let complement = (S::from_f64(-PI * PI) / decay).exp();
        let (mut squares, mut oblongs) = ([one; TERMS + 1], [one; TERMS + 2]);
        let mut power = one;
        for n in 0..=TERMS {
            squares[n] = oblongs[n] * power;
            oblongs[n + 1] = squares[n] * power;
            power *= complement;
        }
        let mut multiples = [[one, S::zero()]; 2 * TERMS + 2];
        for (k, multiple) in multiples.iter_mut().enumerate() {
            let (sin, cos) = (turned * k as f64).sin_cos();
            *multiple = [cos, sin];
        }
        let [mut two, mut three, mut four] = [one, one, one * 2.0];
        let mut sign = -2.0;
        for n in 1..=TERMS {
            two += squares[n] * sign;
            three += squares[n] * 2.0;
            four += oblongs[n + 1] * 2.0;
            sign = -sign;
        }
        let growth = S::from_f64(PI) / decay;
        let ratios = [three / two, four / two, four / three];
        Self { decay, growth, squares, oblongs, turned, multiples, ratios }
    }

    pub(super) fn at(&self, sin: S, cos: S) -> AtPhase<S> {
        // Under a shift by half a turn theta_1 and theta_2 change sign; under z to -z theta_1 and the slope of theta_4 do.
        let half_turn = if cos.re() < 0.0 { -1.0 } else { 1.0 };
        let (sin, cos) = (sin * half_turn, cos * half_turn);
        let side = if sin.re() < 0.0 { -1.0 } else { 1.0 };
        let sin = sin * side;
        let swapped = sin.re() > cos.re();
        let z = if swapped { cos.atan2(sin) } else { sin.atan2(cos) };
        let w = z * self.growth;
        let sums = self.sums(w);
        let [of_sn, of_cn, of_dn] = self.ratios;
        // The phase of exp(-(z +- i eta)^2 / a).
        let (sin_phase, cos_phase) = (z * self.turned * (2.0 / PI)).sin_cos();
        let drift = z * 2.0 / self.decay;
        let (sn, cn, dn, slope, [re, im]);
        if swapped {
            // Q^(1/2) exp(w)
            let small = (w - self.growth * (0.5 * PI)).exp();
            sn = of_sn * sums.two / sums.three;
            cn = of_cn * small * sums.one / sums.three;
            dn = of_dn * small * sums.four / sums.three;
            slope = drift - self.growth * sums.three_slope / sums.three;
            let [x, y] = sums.two_shifted;
            [re, im] = [x * cos_phase - y * sin_phase, y * cos_phase + x * sin_phase];
        } else {
            let small = (-w).exp();
            sn = of_sn * sums.one / sums.four;
            cn = of_cn * small * sums.two / sums.four;
            dn = of_dn * small * sums.three / sums.four;
            slope = self.growth * sums.four_slope / sums.four - drift;
            let [x, y] = sums.one_shifted;
            [re, im] = [x * cos_phase + y * sin_phase, y * cos_phase - x * sin_phase];
        }
        let shifted = [-im * half_turn, re * (side * half_turn)];
        AtPhase { sn: sn * (side * half_turn), cn: cn * half_turn, dn, slope: slope * side, shifted }
    }

    fn sums(&self, w: S) -> Sums<S> {
        let one = S::one();
        // exp(-2 w), its difference from one, and Q exp(2 w).
        let lost = one_minus_exp(w * 2.0);
        let decayed = one - lost;
        let ratio = (w * 2.0 - self.growth * PI).exp();
        let mut sums = Sums {
            one: S::zero(),
            two: one,
            three: one,
            four: S::zero(),
            three_slope: S::zero(),
            four_slope: S::zero(),
            one_shifted: [S::zero(); 2],
            two_shifted: [one, S::zero()],
        };
        // 1 - exp(-2 k w) for k = 2 n and 2 n + 1, and (Q exp(2 w))^n.
        let mut even_lost = S::zero();
        let mut power = one;
        let mut sign = 1.0;
        for n in 0..=TERMS {
            let odd_lost = lost + decayed * even_lost;
            let [even, odd] = [self.oblongs[n] * power, self.squares[n] * power];
            let [even_cos, even_sin] = self.multiples[2 * n];
            let [odd_cos, odd_sin] = self.multiples[2 * n + 1];
            let odd_whole = S::from_f64(2.0) - odd_lost;
            sums.one += odd * odd_lost * sign;
            sums.four += odd * odd_whole;
            sums.four_slope += odd * odd_lost * (2 * n + 1) as f64;
            sums.one_shifted[0] += odd * odd_lost * odd_cos * sign;
            sums.one_shifted[1] += odd * odd_whole * odd_sin * sign;
            if n > 0 {
                let even_whole = S::from_f64(2.0) - even_lost;
                sums.two += even * even_whole * sign;
                sums.three += even * even_whole;
                sums.three_slope += even * even_lost * (2 * n) as f64;
                sums.two_shifted[0] += even * even_whole * even_cos * sign;
                sums.two_shifted[1] -= even * even_lost * even_sin * sign;
            }
            even_lost = lost + decayed * odd_lost;
            power *= ratio;
            sign = -sign;
        }
        sums
    }
}

/// `1 - exp(-x)` for `x >= 0`, without cancellation.
fn one_minus_exp<S: Real>(x: S) -> S {
    if x.re() > 1.0 {
        return S::one() - (-x).exp();
    }
    // 1 - exp(-x) = 2 exp(-x/2) sinh(x/2), whose series has terms of one sign.
    let half = x * 0.5;
    let square = half * half;
    let mut sinh = S::one();
    for k in (1..=13).rev() {
        sinh = S::one() + square * sinh / (2 * k * (2 * k + 1)) as f64;
    }
    half * sinh * (-half).exp() * 2.0
}
