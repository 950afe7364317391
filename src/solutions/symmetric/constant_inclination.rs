//! Steady precession and the first-order motion about it, which carries its derivatives. Eq. (26).

use crate::euler_angles::{EulerAngles, EulerRates};
use crate::scalar::Real;

/// Constant inclination. The terms beside the rates are zero up to rounding; they carry the first derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steady<S> {
    pub(super) rates: EulerRates<S>,
    /// Frequency of small oscillations about it.
    pub(super) frequency: S,
    pub(super) sin: S,
    pub(super) cos: S,
    pub(super) acceleration: S,
}

impl<S: Real> Steady<S> {
    /// Slope of `alpha'` by `u` at constant `b` and `omega`.
    pub(super) fn slope_of_alpha(&self, omega: S) -> S {
        (self.cos * self.rates.alpha * 2.0 - omega) / (self.sin * self.sin)
    }

    pub(super) fn angles(&self, initial: &EulerAngles<S>, spin: S, omega: S, t: S) -> EulerAngles<S> {
        let nu = self.frequency;
        let (sin, cos) = (nu * t).sin_cos();
        let (start, pull) = (-(self.sin * self.rates.beta), self.acceleration / (nu * nu));
        // Deviation of u to first order, v'' = -nu^2 v + acceleration, and its integral.
        let v = start * sin / nu + pull * (S::one() - cos);
        let v_integral = start * (S::one() - cos) / (nu * nu) + pull * (t - sin / nu);
        let turn = self.slope_of_alpha(omega) * v_integral;
        let alpha = self.rates.alpha * t + turn;
        EulerAngles {
            alpha: initial.alpha + alpha,
            beta: initial.beta - v / self.sin,
            gamma: initial.gamma + spin * t - self.cos * alpha - self.rates.alpha * v_integral,
        }
    }

    pub(super) fn rates(&self, omega: S, t: S) -> EulerRates<S> {
        let nu = self.frequency;
        let (sin, cos) = (nu * t).sin_cos();
        let (start, pull) = (-(self.sin * self.rates.beta), self.acceleration / nu);
        let beta = -((start * cos + pull * sin) / self.sin);
        EulerRates { beta, ..self.rates_at(omega, (start * sin + pull * (S::one() - cos)) / nu) }
    }

    pub(super) fn rates_at(&self, omega: S, v: S) -> EulerRates<S> {
        let turn = self.slope_of_alpha(omega) * v;
        EulerRates {
            alpha: self.rates.alpha + turn,
            beta: S::zero(),
            gamma: self.rates.gamma - self.cos * turn - self.rates.alpha * v,
        }
    }
}
