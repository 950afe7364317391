//! The exact motion when `s^IJ` is symmetric about Z, `s^XX = s^YY`: every inclination, spin and time, in elliptic functions.
//!
//! Besides `Omega^z` the component `L_Z` of the angular momentum is conserved then, and Eq. (25) `[eleq]` is solved by
//! quadratures. With `u = cos beta`, `omega = I^zz Omega^z / I^xx`, `b = L_Z / I^xx` and `k = 2 C (s^ZZ - s^XX) / I^xx`,
//!
//! ```text
//! u'^2   = P(u) = [w - k u^2] (1 - u^2) - (b - omega u)^2,     w = b'^2 + a'^2 sin^2 b + k cos^2 b, conserved
//! alpha' = (b - omega u) / (1 - u^2),     gamma' = Omega^z - alpha' u
//! ```
//!
//! where the bracket is `(dn/dt)^2`. `P` is a quartic, so that `u` is an elliptic function and the angles are elliptic
//! integrals of the third kind. The steady precession of Eq. (26) `[sol1]` is the double root, free precession `k = 0`; both
//! kinds of precession and all between are covered, oscillations through the equator too.

mod oscillation;
mod quartic;

use oscillation::{Oscillation, Place, Pole, PoleTerm};
use quartic::InclinationQuartic;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::scalar::Real;

/// The motion through given initial angles and rates at `t = 0`, ready to be evaluated at any time.
///
/// Error of the angles: a few ulp of one near `t = 0`, and `2e-16 |t|` times the rates for large times. The error grows as
/// the inverse of the distance to the separatrix, relative to the other roots of `P`, and rates near a pole as
/// `1 / sin beta`. Derivatives by the initial values, the parameters and the time come with dual numbers, to third order.
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

/// Constant inclination. The terms beside the rates are zero up to rounding; they carry the first derivatives.
#[derive(Debug, Clone, Copy)]
struct Steady<S> {
    rates: EulerRates<S>,
    /// Frequency of small oscillations about it.
    frequency: S,
    sin: S,
    cos: S,
    acceleration: S,
}

/// Inclination between two different turning points.
#[derive(Debug, Clone, Copy)]
struct Nutating<S> {
    oscillation: Oscillation<S>,
    /// `1 - u` and `1 + u` at the turning points (low, high).
    north_distance: (S, S),
    south_distance: (S, S),
    /// Half of `b - omega` and of `b + omega`.
    north_constant: S,
    south_constant: S,
    north: PoleTerm<S>,
    south: PoleTerm<S>,
    /// Integrals at `t = 0`.
    north_start: S,
    south_start: S,
}

impl<S: Real> SymmetricSolution<S> {
    /// The motion of `spheroid` through the Euler angles and rates at `t = 0`, with `Omega^z = a' cos b + g'`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless `s^XX = s^YY`; where `sin beta` is not above 2.2e-16 at `t = 0`; and on the separatrix, where
    /// the motion approaches an unstable steady precession, or for an axis at rest without a restoring force.
    pub fn new(
        spheroid: &RigidSpheroid<S>,
        s: &PrincipalCoefficients<S>,
        angles: &EulerAngles<S>,
        rates: &EulerRates<S>,
    ) -> Result<Self, Error> {
        Error::unless(
            s.asymmetry().re() == 0.0,
            "asymmetry s^XX - s^YY",
            s.asymmetry().re(),
            "zero: use a frame whose Z axis is the symmetry axis of s^IJ",
        )?;
        let (sin, cos) = angles.beta.sin_cos();
        Error::unless(sin.re() > f64::EPSILON, "sin beta", sin.re(), "above 2.2e-16: beta in (0, pi), not on a pole")?;
        let spin = rates.alpha * cos + rates.gamma;
        let omega = spheroid.free_precession_constant(spin);
        let k = spheroid.constant_c * (s.zz - s.xx) * 2.0 / spheroid.inertia_xx;
        // About u0 the coefficients are sums of the initial values, without the cancellation of P(u) itself near a pole.
        let sin2 = sin * sin;
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
        };
        let rounding = 8.0 * f64::EPSILON * slope.iter().map(|x| x.re().abs()).sum::<f64>();
        let [p0, p1, p2, ..] = quartic.coefficients;
        let motion = if p1.re().abs() <= rounding && p0.re() * p2.re().abs() <= rounding * rounding {
            Error::unless(p2.re() < 0.0, "half of P'' at the steady inclination", p2.re(), "below zero: stable")?;
            Motion::Steady(Steady { rates: *rates, frequency: (-p2).sqrt(), sin, cos, acceleration: p1 * 0.5 })
        } else {
            Motion::Nutating(Nutating::new(&quartic, angles, rates, omega, g)?)
        };
        Ok(Self { initial: *angles, spin, omega, motion })
    }

    /// Euler angles at time `t`, `beta` in [0, pi], `alpha` and `gamma` continuous in `t`.
    ///
    /// In a motion through a pole itself `alpha` jumps by half a turn there, and `gamma` with it so that the body does not.
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

    /// Extreme inclinations `(smallest, largest)` [rad].
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

impl<S: Real> Nutating<S> {
    /// `g = b - omega u0`, with `u0` the initial `cos beta`.
    fn new(
        quartic: &InclinationQuartic<S>,
        angles: &EulerAngles<S>,
        rates: &EulerRates<S>,
        omega: S,
        g: S,
    ) -> Result<Self, Error> {
        let (sin_half, cos_half) = (angles.beta * 0.5).sin_cos();
        let (north, south) = (sin_half * sin_half * 2.0, cos_half * cos_half * 2.0);
        let points = quartic.turning_points(-south.re(), north.re());
        let (sin, _) = angles.beta.sin_cos();
        let oscillation = Oscillation::new(&points, -(sin * rates.beta))?;
        let (north_constant, south_constant) = ((g - omega * north) * 0.5, (g + omega * south) * 0.5);
        // (1 - low)(1 - high) Q(1) = (b - omega)^2 gives a distance from the pole that a difference would lose.
        let near_a_pole = |difference: S, from_here: S, constant: S, far: S, pole: S| {
            if difference.re() > 0.1 * from_here.re() {
                difference
            } else {
                constant * constant * 4.0 / (far * points.quotient(pole, pole))
            }
        };
        let (north_far, south_far) = (north - points.low, south + points.high);
        let north_near = near_a_pole(north - points.high, north, north_constant, north_far, north);
        let south_near = near_a_pole(south + points.low, south, south_constant, south_far, -south);
        let north_term = oscillation.pole_term(north_constant, Pole::North, north_far, north_near);
        let south_term = oscillation.pole_term(south_constant, Pole::South, south_far, south_near);
        let start = oscillation.place(S::zero());
        Ok(Self {
            north_distance: (north_far, north_near),
            south_distance: (south_near, south_far),
            north_constant,
            south_constant,
            north_start: oscillation.integral(&north_term, Pole::North, &start, S::zero()),
            south_start: oscillation.integral(&south_term, Pole::South, &start, S::zero()),
            north: north_term,
            south: south_term,
            oscillation,
        })
    }

    /// `1 - u` and `1 + u`, sums of positive terms.
    fn distances(&self, place: &Place<S>) -> (S, S) {
        let (low, high) = place.shares;
        (
            self.north_distance.0 * low + self.north_distance.1 * high,
            self.south_distance.0 * low + self.south_distance.1 * high,
        )
    }
}

impl<S: Real> Steady<S> {
    /// Slope of `alpha'` by `u` at constant `b` and `omega`.
    fn slope_of_alpha(&self, omega: S) -> S {
        (self.cos * self.rates.alpha * 2.0 - omega) / (self.sin * self.sin)
    }

    fn angles(&self, initial: &EulerAngles<S>, spin: S, omega: S, t: S) -> EulerAngles<S> {
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

    fn rates(&self, omega: S, t: S) -> EulerRates<S> {
        let nu = self.frequency;
        let (sin, cos) = (nu * t).sin_cos();
        let (start, pull) = (-(self.sin * self.rates.beta), self.acceleration / nu);
        let beta = -((start * cos + pull * sin) / self.sin);
        EulerRates { beta, ..self.rates_at(omega, (start * sin + pull * (S::one() - cos)) / nu) }
    }

    fn rates_at(&self, omega: S, v: S) -> EulerRates<S> {
        let turn = self.slope_of_alpha(omega) * v;
        EulerRates {
            alpha: self.rates.alpha + turn,
            beta: S::zero(),
            gamma: self.rates.gamma - self.cos * turn - self.rates.alpha * v,
        }
    }
}
