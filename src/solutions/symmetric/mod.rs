//! The exact motion when `s^IJ` is symmetric about Z, `s^XX = s^YY`: every inclination, spin and time, in elliptic functions.
//!
//! Besides `Omega^z` the component `L_Z` of the angular momentum is then conserved, and Eq. (25) `[eleq]` is solved by
//! quadratures. With `u = cos beta`, `omega = I^zz Omega^z / I^xx`, `b = L_Z / I^xx` and `k = 2 C (s^ZZ - s^XX) / I^xx`,
//!
//! ```text
//! u'^2   = P(u) = [w - k u^2] (1 - u^2) - (b - omega u)^2,     w = beta'^2 + alpha'^2 sin^2 beta + k u^2, conserved
//! alpha' = (b - omega u) / (1 - u^2),     gamma' = Omega^z - alpha' u
//! ```
//!
//! where the bracket is `(dn/dt)^2`. `P` is a quartic, so that `u` is an elliptic function and the angles are elliptic
//! integrals of the third kind. The steady precession of Eq. (26) `[sol1]` is the double root, free precession is `k = 0`;
//! both kinds of precession and all intermediate cases are covered, also oscillations through the equator.
//!
//! # Example
//!
//! ```
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::solutions::symmetric::SymmetricSolution;
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let symmetric = PrincipalCoefficients::new([0.01, 0.01, -0.02]);
//! let solution = SymmetricSolution::new(&star, &symmetric, &angles, &rates)?;
//! let (least, largest) = solution.inclinations();
//! let after = solution.angles(solution.period());
//! assert!(least <= angles.beta && angles.beta <= largest && (after.beta - angles.beta).abs() < 1e-12);
//! # Ok::<(), twofold::Error>(())
//! ```

mod constant_inclination;
mod nutation;
mod oscillation;
mod quartic;

use constant_inclination::Steady;
use nutation::Nutating;
use oscillation::Pole;
use quartic::InclinationQuartic;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Real;

/// The motion through given initial angles and rates at `t = 0`, ready to be evaluated at any time.
///
/// Error of the angles: about `2e-16 (1 + rate |t|)`, plus the growth of the rounding of the initial values, which is large near a
/// separatrix. Near a pole `alpha` and `gamma` separately have that error divided by `sin beta`, but the orientation does not.
/// Derivatives with respect to initial values, parameters and time are obtained with dual numbers; for a steady precession those with
/// respect to initial values and parameters are limited to first order. They are derivatives within `s^XX = s^YY`: only the common
/// change of `s^XX` and `s^YY` counts, as that of `s^XX`, and any other derivative of `s^YY` is ignored.
#[derive(Debug, Clone, Copy)]
pub struct SymmetricSolution<S> {
    initial: EulerAngles<S>,
    spin: S,
    omega: S,
    motion: Motion<S>,
}

#[derive(Debug, Clone, Copy)]
enum Motion<S> {
    Steady(Steady<S>),
    Nutating(Nutating<S>),
}

impl<S: Real> SymmetricSolution<S> {
    /// The motion of `spheroid` through the Euler angles and rates at `t = 0`, with `Omega^z = a' cos b + g'`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `s^XX = s^YY`; where `sin beta` is not above 2.2e-16 at `t = 0`; on the separatrix, where the
    /// motion approaches an unstable steady precession; and for an axis at rest without a restoring force.
    pub fn new(
        spheroid: &RigidSpheroid<S>,
        s: &PrincipalCoefficients<S>,
        angles: &EulerAngles<S>,
        rates: &EulerRates<S>,
    ) -> Result<Self, Error> {
        Error::ensure(
            s.asymmetry().re() == 0.0,
            "asymmetry s^XX - s^YY",
            s.asymmetry().re(),
            "zero; use a frame whose Z axis is the symmetry axis of s^IJ",
        )?;
        let (sin, cos) = angles.beta.sin_cos();
        Error::ensure(
            sin.re() > f64::EPSILON,
            "sin beta",
            sin.re(),
            "above 2.2e-16; beta must be above 0 and below pi, not on a pole",
        )?;
        let spin = rates.alpha * cos + rates.gamma;
        let omega = spheroid.free_precession_constant(spin);
        let k = spheroid.constant_c * (s.zz - s.xx) * 2.0 / spheroid.inertia_xx;
        // About u0 the coefficients are sums of the initial values, without the cancellation of P(u) itself near a pole.
        let sin2 = sin * sin;
        let (sin_half, cos_half) = (angles.beta * 0.5).sin_cos();
        let (north, south) = (sin_half * sin_half * 2.0, cos_half * cos_half * 2.0);
        let speed2 = rates.beta * rates.beta + rates.alpha * rates.alpha * sin2;
        let g = rates.alpha * sin2;
        let slope = [-(cos * speed2 * 2.0), -(k * cos * sin2 * 2.0), omega * g * 2.0];
        let quartic = InclinationQuartic {
            coefficients: [
                rates.beta * rates.beta * sin2,
                slope[0] + slope[1] + slope[2],
                k * cos * cos * 4.0 - speed2 - k * sin2 - omega * omega,
                k * cos * 4.0,
                k,
            ],
            cos,
            north,
            south,
            speed_squared: speed2,
            g,
            omega,
            k,
        };
        let rounding = 8.0 * f64::EPSILON * slope.iter().map(|x| x.re().abs()).sum::<f64>();
        let [p0, p1, p2, ..] = quartic.coefficients;
        let motion = if p1.re().abs() <= rounding && p0.re() * p2.re().abs() <= rounding * rounding {
            Error::ensure(
                p2.re() < 0.0,
                "half of P'' at the steady inclination",
                p2.re(),
                "below zero, so that it is stable",
            )?;
            Motion::Steady(Steady { rates: *rates, frequency: (-p2).sqrt(), sin, cos, acceleration: p1 * 0.5 })
        } else {
            Motion::Nutating(Nutating::new(&quartic, angles, rates)?)
        };
        Ok(Self { initial: *angles, spin, omega, motion })
    }

    /// Factor, at least 1, by which the turning points of the inclination amplify rounding.
    pub(crate) fn condition(&self) -> f64 {
        match &self.motion {
            Motion::Steady(_) => 1.0,
            Motion::Nutating(nutating) => nutating.condition,
        }
    }

    /// Euler angles at time `t`, `beta` in [0, pi], `alpha` and `gamma` continuous in `t`.
    ///
    /// In a motion through a pole itself `alpha` jumps by half a turn there, and `gamma` with it so that the orientation is
    /// continuous; at the pole their derivatives (duals) do not exist and are not finite.
    pub fn angles(&self, t: S) -> EulerAngles<S> {
        let (initial, free_turn) = (&self.initial, (self.spin - self.omega) * t);
        match &self.motion {
            Motion::Steady(m) => m.angles(initial, self.spin, self.omega, t),
            Motion::Nutating(m) => {
                let place = m.oscillation.place(t);
                let (north, south) = m.distances(&place);
                let north_turn = m.oscillation.integral(&m.north, Pole::North, &place, t) - m.north_start;
                let south_turn = m.oscillation.integral(&m.south, Pole::South, &place, t) - m.south_start;
                EulerAngles {
                    alpha: initial.alpha + south_turn + north_turn,
                    beta: north.sqrt().atan2(south.sqrt()) * 2.0,
                    gamma: initial.gamma + free_turn + south_turn - north_turn,
                }
            }
        }
    }

    /// Euler rates at time `t`.
    pub fn rates(&self, t: S) -> EulerRates<S> {
        match &self.motion {
            Motion::Steady(m) => m.rates(self.omega, t),
            Motion::Nutating(m) => {
                let place = m.oscillation.place(t);
                let (north, south) = m.distances(&place);
                let (by_north, by_south) = (m.north_constant / north, m.south_constant / south);
                EulerRates {
                    alpha: by_south + by_north,
                    beta: -(place.rate / (north * south).sqrt()),
                    gamma: self.spin - self.omega + by_south - by_north,
                }
            }
        }
    }

    /// Period of the inclination; for steady precession, that of small oscillations about it.
    pub fn period(&self) -> S {
        match &self.motion {
            Motion::Steady(m) => S::from_f64(core::f64::consts::TAU) / m.frequency,
            Motion::Nutating(m) => m.oscillation.half_period * 2.0,
        }
    }

    /// Mean rates: the advance of each angle in one period over the period (zero for `beta`).
    pub fn mean_rates(&self) -> EulerRates<S> {
        match &self.motion {
            Motion::Steady(m) => m.rates_at(self.omega, m.acceleration / (m.frequency * m.frequency)),
            Motion::Nutating(m) => {
                let north = m.north.mean_rate(m.oscillation.half_period);
                let south = m.south.mean_rate(m.oscillation.half_period);
                EulerRates { alpha: south + north, beta: S::zero(), gamma: self.spin - self.omega + south - north }
            }
        }
    }

    /// Extreme inclinations `(smallest, largest)`, in rad.
    pub fn inclinations(&self) -> (S, S) {
        match &self.motion {
            Motion::Steady(_) => (self.initial.beta, self.initial.beta),
            Motion::Nutating(m) => (
                m.north_distance.1.sqrt().atan2(m.south_distance.1.sqrt()) * 2.0,
                m.north_distance.0.sqrt().atan2(m.south_distance.0.sqrt()) * 2.0,
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use num_dual::Dual64;

    use super::*;

    const ALPHA_RATE: f64 = 0.6;

    /// From Eq. (26), `omega = (alpha'^2 + k) cos beta / alpha'`, with additions to the rates.
    fn precession<S: Real>(more_alpha: S, more_beta: f64) -> SymmetricSolution<S> {
        let [inertia_xx, inertia_zz, constant_c] = [1.3, 1.5, 0.8];
        let (beta, s) = (0.7_f64, [0.05, 0.05, -0.1]);
        let k = 2.0 * constant_c * (s[2] - s[0]) / inertia_xx;
        let omega = (ALPHA_RATE * ALPHA_RATE + k) * beta.cos() / ALPHA_RATE;
        let gamma = omega * inertia_xx / inertia_zz - ALPHA_RATE * beta.cos();
        let [inertia_xx, inertia_zz, constant_c] = [inertia_xx, inertia_zz, constant_c].map(S::from_f64);
        let [alpha, beta, gamma_0] = [0.4, beta, -0.3].map(S::from_f64);
        let rates = EulerRates {
            alpha: S::from_f64(ALPHA_RATE) + more_alpha,
            beta: S::from_f64(more_beta),
            gamma: S::from_f64(gamma),
        };
        SymmetricSolution::new(
            &RigidSpheroid { inertia_xx, inertia_zz, constant_c },
            &PrincipalCoefficients::new(s.map(S::from_f64)),
            &EulerAngles { alpha, beta, gamma: gamma_0 },
            &rates,
        )
        .unwrap()
    }

    #[test]
    fn steady_precession_is_the_limit_of_small_oscillations() {
        let (steady, nutating) = (precession(0.0, 0.0), precession(0.0, 1e-5));
        let (Motion::Steady(_), Motion::Nutating(_)) = (steady.motion, nutating.motion) else { panic!("not both") };
        assert_relative_eq!(steady.period(), nutating.period(), max_relative = 1e-8);
        assert!(nutating.period() > 7.0);
        // Without turning points nothing is amplified.
        assert_eq!(steady.condition(), 1.0);
        assert!(nutating.condition() > 1.0);
    }

    /// A rate of the inclination counts as zero if its square is rounding: if `beta'^2 sin^2 beta |P''| / 2` is below the square of the rounding of
    /// `P'`.
    #[test]
    fn steady_precession_ends_where_the_inclination_turns_round() {
        let Motion::Steady(Steady { frequency, sin, cos, .. }) = precession(0.0, 0.0).motion else { panic!("steady") };
        let k = 2.0 * 0.8 * -0.15 / 1.3;
        let omega = (ALPHA_RATE * ALPHA_RATE + k) * cos / ALPHA_RATE;
        let turn = ALPHA_RATE * sin;
        let slope = 2.0 * cos * turn * turn + (2.0 * k * cos * sin * sin).abs() + 2.0 * omega * turn * sin;
        let rate = 8.0 * f64::EPSILON * slope / frequency / sin;
        // So that a factor of its square differs from a factor of its inverse.
        assert!(frequency < 0.9, "{frequency}");
        for sign in [1.0, -1.0] {
            assert!(matches!(precession(0.0, 0.99 * sign * rate).motion, Motion::Steady(_)));
            assert!(matches!(precession(0.0, 1.01 * sign * rate).motion, Motion::Nutating(_)));
        }
    }

    /// The inclinations of the turning points are half a period apart.
    #[test]
    fn inclinations_are_those_of_the_turning_points() {
        for more in [0.2, -0.2] {
            let solution: SymmetricSolution<f64> = precession(more, 0.0);
            let [start, turned] = [0.0, 0.5 * solution.period()].map(|t| solution.angles(t).beta);
            let (least, largest) = solution.inclinations();
            assert_relative_eq!(least, start.min(turned), max_relative = 1e-13);
            assert_relative_eq!(largest, start.max(turned), max_relative = 1e-13);
            assert!(largest - least > 0.02, "{least} {largest}");
        }
    }

    /// The derivatives with respect to the initial rate are compared with central differences of nutating motions.
    #[test]
    fn mean_rates_of_a_steady_precession_have_their_derivatives() {
        let found = precession(Dual64::from(0.0).derivative(), 0.0).mean_rates();
        let h = 1e-4;
        let [more, less] = [h, -h].map(|change| precession(change, 0.0).mean_rates());
        assert_relative_eq!(found.alpha.eps, (more.alpha - less.alpha) / (2.0 * h), max_relative = 1e-5);
        assert_relative_eq!(found.gamma.eps, (more.gamma - less.gamma) / (2.0 * h), max_relative = 1e-5);
        assert!((found.alpha.eps - 1.0).abs() > 0.1);
    }
}
