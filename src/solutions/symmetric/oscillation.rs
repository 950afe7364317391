//! The inclination between its turning points as an elliptic function of time, and the integrals of `1 / (1 -+ cos beta)`.
//!
//! With `v` from `low` to `high`, `P = (v - low)(high - v) Q(v)` and
//!
//! ```text
//! D2 = Q(high)/4,  D1 = Q(low)/4,  H = sqrt(D1 D2),  M = Q(low, high)/4  (polar form),
//! v = (low D2 + high x) / (x + D2)   makes   x'^2 = 4 x (x^2 + 2 M x + H^2),
//! ```
//!
//! so `x` is a Weierstrass function minus one of its values `e_i`, infinite when `v = high` and zero when `v = low`. The
//! other two zeros are real or complex conjugate, and enter only through `M` and `H`: nothing changes where they meet, as
//! they do when the Lorentz violation vanishes. `x -> H^2 / x` exchanges the two turning points, and time is counted from the
//! nearer one, so that no root loses digits. `x = (xi / eta)^2` keeps both ends finite.

use core::f64::consts::FRAC_PI_2;

use super::quartic::TurningPoints;
use crate::error::Error;
use crate::numerics::elliptic::carlson::{rf_of_roots, rj_of_roots};
use crate::numerics::elliptic::jacobi::ArithmeticGeometricMean;
use crate::numerics::scalar::Real;

/// Rounding of the values of `P`, relative.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The periodic motion of `v = u - u0` and the constants of `x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Oscillation<S> {
    low: S,
    high: S,
    d_low: S,
    d_high: S,
    mean: S,
    root_of_product: S,
    /// `M + H`, and `H^2 - M^2`, positive for a conjugate pair.
    sum: S,
    determinant: S,
    ladder: ArithmeticGeometricMean<S>,
    /// Time from one turning point to the next.
    pub(super) half_period: S,
    /// Time since `high`, and since `low`, at `t = 0`.
    since_high: S,
    since_low: S,
}

/// The point of the motion at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<S> {
    from_high: Side<S>,
    from_low: Side<S>,
    /// Weights of `low` and `high` in `v`: they are positive and sum to one.
    pub(super) shares: (S, S),
    /// Rate of `v`.
    pub(super) rate: S,
}

/// `x = (xi / eta)^2` counted from one turning point: `eta` has the sign of the time since it, `xi > 0`.
#[derive(Debug, Clone, Copy)]
struct Side<S> {
    periods: f64,
    xi: S,
    eta: S,
}

/// `int dt / (1 -+ u)` times a constant, expressed with the turning point away from the pole in question.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoleTerm<S> {
    /// Coefficient of the linear term in time.
    rate: S,
    /// Coefficient of `int dt / (x + delta)`.
    amplitude: S,
    delta: S,
    /// `amplitude` times that integral over half a period.
    over_half_period: S,
}

impl<S: Real> Oscillation<S> {
    /// The motion through `v = 0` at `t = 0` with the given rate there.
    ///
    /// # Errors
    /// [`Error::Domain`] on the separatrix.
    pub(super) fn new(points: &TurningPoints<S>, initial_rate: S) -> Result<Self, Error> {
        let TurningPoints { low, high, .. } = *points;
        let d_low = points.at_low * 0.25;
        let d_high = points.at_high * 0.25;
        let mean = points.quotient(low, high) * 0.25;
        let root_of_product = (d_low * d_high).sqrt();
        // Near the separatrix a turning point nearly meets another root (H -> 0), or a conjugate pair comes close to the
        // path between them (M + H -> 0). Rounding of P moves a root by its square root in the first case.
        let largest = d_low.re().abs().max(d_high.re().abs()).max(mean.re().abs());
        let between = |quantity: f64, least: f64| {
            Error::ensure(
                quantity > least * largest,
                "distance of the roots of P(cos beta), relative",
                quantity / largest,
                "above the rounding error; on the separatrix the period is infinite",
            )
        };
        let span = high - low;
        let determinant = span * span * points.quotient_determinant() / 64.0;
        let sum = if mean.re() < 0.0 { determinant / (root_of_product - mean) } else { mean + root_of_product };
        between(d_low.re().min(d_high.re()), ROUNDING.sqrt())?;
        between(sum.re(), ROUNDING)?;
        let ladder = ArithmeticGeometricMean::new((sum * 0.5).sqrt(), root_of_product.sqrt());
        let half_period = ladder.quarter_period();
        let mut motion = Self {
            low,
            high,
            d_low,
            d_high,
            mean,
            root_of_product,
            sum,
            determinant,
            ladder,
            half_period,
            since_high: S::zero(),
            since_low: S::zero(),
        };
        let root_q0 = points.quotient(S::zero(), S::zero()).sqrt();
        // x at v = 0 is -low D2 / high; H is halfway.
        if -low.re() * d_high.re() >= high.re() * root_of_product.re() {
            motion.since_high = motion.time_from_turning(initial_rate / (low * d_high.sqrt() * root_q0));
            motion.since_low = motion.since_high + half_period;
        } else {
            motion.since_low = motion.time_from_turning(initial_rate / (high * d_low.sqrt() * root_q0));
            motion.since_high = motion.since_low + half_period;
        }
        Ok(motion)
    }

    /// Time since the turning point where `w = 1 / sqrt x` vanishes, odd in `w`: `w R_F(1, 1 + a w^2, 1 + b w^2)`.
    fn time_from_turning(&self, w: S) -> S {
        let (sum, product) = self.roots_of_pair(S::one(), w);
        w * rf_of_roots(S::one(), sum, product)
    }

    /// Sum and product of the roots of the pair `xi^2 + a eta^2`, `xi^2 + b eta^2`; `(a + b)/2 = M`, `a b = H^2`.
    fn roots_of_pair(&self, xi: S, eta: S) -> (S, S) {
        let (xi2, eta2) = (xi * xi, eta * eta);
        let difference = xi2 - self.root_of_product * eta2;
        let product = (difference * difference + self.sum * xi2 * eta2 * 2.0).sqrt();
        let mean = xi2 + self.mean * eta2;
        let half_square =
            if mean.re() < 0.0 { self.determinant * eta2 * eta2 / (product - mean) } else { mean + product };
        ((half_square * 2.0).sqrt(), product)
    }

    /// The place at time `t`.
    pub(super) fn place(&self, t: S) -> Place<S> {
        let period = self.half_period * 2.0;
        let reduced = |since: S| {
            let periods = (since.re() / period.re()).round();
            (periods, since - period * periods)
        };
        let (periods_high, from_high) = reduced(self.since_high + t);
        let (periods_low, from_low) = reduced(self.since_low + t);
        let ((xi_high, eta_high), (xi_low, eta_low)) = if from_high.re().abs() <= from_low.re().abs() {
            let w = self.inverse_root(from_high);
            ((S::one(), w), self.seen_from_the_other(w, from_low))
        } else {
            let w = self.inverse_root(from_low);
            (self.seen_from_the_other(w, from_high), (S::one(), w))
        };
        let (xi2, eta2) = (xi_high * xi_high, eta_high * eta_high);
        let total = xi2 + self.d_high * eta2;
        let (_, speed) = self.roots_of_pair(xi_high, eta_high);
        Place {
            from_high: Side { periods: periods_high, xi: xi_high, eta: eta_high },
            from_low: Side { periods: periods_low, xi: xi_low, eta: eta_low },
            shares: (self.d_high * eta2 / total, xi2 / total),
            rate: (self.low - self.high) * self.d_high * xi_high * eta_high * speed * 2.0 / (total * total),
        }
    }

    /// `1 / sqrt x` at the given time after a turning point, at most a quarter of the period: `sn / (a cn dn)`.
    fn inverse_root(&self, time: S) -> S {
        let f = self.ladder.functions(time);
        f.sn / (f.cn * f.dn)
    }

    /// `(xi, eta)` counted from the turning point that is farther away, with `x = (H w)^2`.
    fn seen_from_the_other(&self, w: S, time: S) -> (S, S) {
        let sign = if time.re() < 0.0 { -1.0 } else { 1.0 };
        (-(self.root_of_product * w) * sign, S::from_f64(sign))
    }

    /// The term `int constant dt / distance`, where the `distance` from a pole is `far` at the turning point away from it
    /// and `near` at the other.
    pub(super) fn pole_term(&self, constant: S, pole: Pole, far: S, near: S) -> PoleTerm<S> {
        let d = match pole {
            Pole::North => self.d_low,
            Pole::South => self.d_high,
        };
        let delta = d * near / far;
        let amplitude = constant * (self.high - self.low) * d / (far * far);
        let over_half_period = if near.re() == 0.0 {
            // Through the pole itself: half a turn at each passage, where either sense is valid.
            S::from_f64(FRAC_PI_2.copysign(constant.re()))
        } else {
            amplitude * rj_of_roots(S::zero(), (self.sum * 2.0).sqrt(), self.root_of_product, delta) / 3.0
        };
        PoleTerm { rate: constant / far, amplitude, delta, over_half_period }
    }

    /// The term's integral from the nearest passage before `t = 0` (up to a constant) to the `place` at `t`.
    pub(super) fn integral(&self, term: &PoleTerm<S>, pole: Pole, place: &Place<S>, t: S) -> S {
        let side = match pole {
            Pole::North => place.from_low,
            Pole::South => place.from_high,
        };
        let (sum, product) = self.roots_of_pair(side.xi, side.eta);
        let p = side.xi * side.xi + term.delta * side.eta * side.eta;
        if p.re() == 0.0 {
            // At the pole, where the sense of the half turn is arbitrary.
            return term.rate * t + term.over_half_period * (2.0 * side.periods);
        }
        let part = side.eta * side.eta * side.eta * rj_of_roots(side.xi, sum, product, p) / 3.0;
        term.rate * t + term.over_half_period * (2.0 * side.periods) + term.amplitude * part
    }
}

/// The pole of the sphere whose distance is in the denominator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pole {
    /// `1 - u = 0`; counted from `low`.
    North,
    /// `1 + u = 0`; counted from `high`.
    South,
}

impl<S: Real> PoleTerm<S> {
    /// Mean rate over a period.
    pub(super) fn mean_rate(&self, half_period: S) -> S {
        self.rate + self.over_half_period / half_period
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Complex;

    use super::*;
    use crate::numerics::elliptic::jacobi::complete_integral;

    fn oscillation(mean: f64, root_of_product: f64) -> Oscillation<f64> {
        let sum = mean + root_of_product;
        Oscillation {
            low: -0.3,
            high: 0.2,
            d_low: 0.4,
            d_high: root_of_product * root_of_product / 0.4,
            mean,
            root_of_product,
            sum,
            determinant: root_of_product * root_of_product - mean * mean,
            ladder: ArithmeticGeometricMean::new((sum * 0.5).sqrt(), root_of_product.sqrt()),
            half_period: 1.3,
            since_high: 0.0,
            since_low: 1.3,
        }
    }

    /// `P = (1 - v^2) (v^2 + e^2)`: half of the period is `2 K / sqrt(1 + e^2)` with the complementary parameter `e^2 / (1 + e^2)`, also where the conjugate
    /// pair `+-i e` is so close to the path that `M + H = e^2 / 2` is the difference of nearly equal numbers.
    #[test]
    fn a_conjugate_pair_near_the_path_keeps_the_digits_of_the_period() {
        for distance in [1.0_f64, 1e-2, 1e-4, 1e-6] {
            let square = distance * distance;
            let (at_low, at_high, condition) = (1.0 + square, 1.0 + square, 1.0);
            let points =
                TurningPoints { low: -1.0, high: 1.0, quotient: [square, 0.0, 1.0], at_low, at_high, condition };
            let found = Oscillation::new(&points, distance).unwrap().half_period;
            let expected = 2.0 * complete_integral(square / (1.0 + square)) / (1.0 + square).sqrt();
            assert_relative_eq!(found, expected, max_relative = 4e-15);
        }
    }

    /// By complex arithmetic, also where `xi^2 + M eta^2` is below zero.
    #[test]
    fn roots_of_a_pair_are_those_of_complex_numbers() {
        for (mean, root_of_product) in [(0.5, 0.7), (-0.5, 0.7), (-2.6, 3.0)] {
            let motion = oscillation(mean, root_of_product);
            let a = Complex::new(mean, motion.determinant.sqrt());
            for (xi, eta) in [(1.0, 0.4), (0.3, 1.0), (0.1, 2.5), (0.0, 0.8)] {
                let (sum, product) = motion.roots_of_pair(xi, eta);
                let square = a * (eta * eta) + xi * xi;
                assert_relative_eq!(sum, 2.0 * square.sqrt().re, max_relative = 1e-14, epsilon = 0.0);
                assert_relative_eq!(product, square.norm(), max_relative = 1e-14, epsilon = 0.0);
            }
        }
    }

    /// Near the pole and through it, where the square of the constant is out of range.
    #[test]
    fn through_a_pole_there_is_half_a_turn_in_the_sense_of_the_constant() {
        let motion = oscillation(0.5, 0.7);
        for pole in [Pole::North, Pole::South] {
            for sign in [1.0, -1.0] {
                let turn =
                    |constant: f64, near: f64| motion.pole_term(constant * sign, pole, 0.9, near).over_half_period;
                assert!(turn(0.1, 1e-2) * sign > 0.0);
                assert_eq!(turn(1e-200, 0.0), sign * FRAC_PI_2);
            }
        }
    }

    #[test]
    fn on_a_pole_the_integral_counts_the_passages() {
        let motion = oscillation(0.5, 0.7);
        let term = PoleTerm { rate: 0.7, amplitude: 0.3, delta: 0.0, over_half_period: 1.1 };
        let on_pole = Side { periods: 3.0, xi: 0.0, eta: 1.0 };
        let away = Side { periods: -8.0, xi: 1.0, eta: 0.4 };
        for (pole, from_low, from_high) in [(Pole::North, on_pole, away), (Pole::South, away, on_pole)] {
            let place = Place { from_high, from_low, shares: (0.5, 0.5), rate: 0.1 };
            assert_relative_eq!(motion.integral(&term, pole, &place, 0.9), 0.63 + 6.6, max_relative = 1e-15);
        }
    }
}
