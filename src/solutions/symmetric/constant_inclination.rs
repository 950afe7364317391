//! Steady precession and the first-order motion about it, which contains its derivatives. Eq. (26).

use crate::euler_angles::{EulerAngles, EulerRates};
use crate::numerics::scalar::Real;

/// Motion at constant inclination. The terms in addition to the rates are zero up to rounding; they carry the first
/// derivatives.
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
    /// Slope of `alpha'` with respect to `u` at constant `b` and `omega`.
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

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use num_dual::{Dual2_64, Dual64};

    use super::*;

    const INITIAL: [f64; 3] = [0.4, 1.1, -0.3];

    fn steady<S: Real>() -> Steady<S> {
        let [alpha, beta, gamma, frequency, acceleration] = [1.7, 0.02, -0.6, 1.3, 0.03].map(S::from_f64);
        let (sin, cos) = S::from_f64(INITIAL[1]).sin_cos();
        Steady { rates: EulerRates { alpha, beta, gamma }, frequency, sin, cos, acceleration }
    }

    fn angles<S: Real>(omega: f64, t: S) -> EulerAngles<S> {
        let motion = steady::<S>();
        let [alpha, beta, gamma] = INITIAL.map(S::from_f64);
        let spin = motion.rates.gamma + motion.cos * motion.rates.alpha;
        motion.angles(&EulerAngles { alpha, beta, gamma }, spin, S::from_f64(omega), t)
    }

    #[test]
    fn rates_are_those_of_the_angles() {
        let omega = 0.9;
        let start = angles(omega, 0.0);
        assert_eq!([start.alpha, start.beta, start.gamma], INITIAL);
        for t in [0.0, 0.3, -0.8, 2.5, 17.0] {
            let moving = angles(omega, Dual64::from(t).derivative());
            let rates = steady::<f64>().rates(omega, t);
            for (found, exact) in [(rates.alpha, moving.alpha), (rates.beta, moving.beta), (rates.gamma, moving.gamma)]
            {
                assert_relative_eq!(found, exact.eps, max_relative = 1e-13, epsilon = 1e-14);
            }
        }
    }

    #[test]
    fn the_inclination_swings_about_where_it_is_pulled_to() {
        let (omega, motion) = (0.9, steady::<f64>());
        for t in [0.0, 0.3, -0.8, 2.5, 17.0] {
            let u = -(angles(omega, Dual2_64::from(t).derivative()).beta - INITIAL[1]) * motion.sin;
            let pull = motion.acceleration - motion.frequency * motion.frequency * u.re;
            assert_relative_eq!(u.v2, pull, max_relative = 1e-12, epsilon = 1e-14);
            // alpha' = alpha'_0 + slope u, and the spin about the axis is constant.
            let rates = motion.rates(omega, t);
            let alpha = motion.rates.alpha + motion.slope_of_alpha(omega) * u.re;
            assert_relative_eq!(rates.alpha, alpha, max_relative = 1e-14);
            let spin = motion.rates.gamma + motion.cos * motion.rates.alpha;
            let gamma = spin - motion.cos * alpha - motion.rates.alpha * u.re;
            assert_relative_eq!(rates.gamma, gamma, max_relative = 1e-13);
        }
        assert_relative_eq!(motion.rates(omega, 0.0).beta, 0.02, max_relative = 1e-14);
    }
}
