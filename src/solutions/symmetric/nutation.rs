//! Motion of the inclination between two turning points, with the distances of the axis from the poles.

use super::oscillation::{Oscillation, Place, Pole, PoleTerm};
use super::quartic::InclinationQuartic;
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::numerics::scalar::Real;

/// Inclination between two different turning points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nutating<S> {
    pub(super) oscillation: Oscillation<S>,
    /// `1 - u` and `1 + u` at the turning points (low, high).
    pub(super) north_distance: (S, S),
    pub(super) south_distance: (S, S),
    /// Half of `b - omega` and of `b + omega`.
    pub(super) north_constant: S,
    pub(super) south_constant: S,
    pub(super) north: PoleTerm<S>,
    pub(super) south: PoleTerm<S>,
    /// Integrals at `t = 0`.
    pub(super) north_start: S,
    pub(super) south_start: S,
    /// Factor by which rounding is amplified, by the turning points and near the poles.
    pub(super) condition: f64,
}

impl<S: Real> Nutating<S> {
    /// `g = b - omega u0`, with `u0` the initial `cos beta`.
    pub(super) fn new(
        quartic: &InclinationQuartic<S>,
        angles: &EulerAngles<S>,
        rates: &EulerRates<S>,
    ) -> Result<Self, Error> {
        let InclinationQuartic { north, south, omega, g, .. } = *quartic;
        let points = quartic.turning_points(-south.re(), north.re());
        let (sin, _) = angles.beta.sin_cos();
        let oscillation = Oscillation::new(&points, -(sin * rates.beta))?;
        let (north_constant, south_constant) = ((g - omega * north) * 0.5, (g + omega * south) * 0.5);
        // (1 - low)(1 - high) Q(1) = (b - omega)^2 gives a distance from the pole to digits that a difference would lose,
        // unless it loses more itself: if the body hardly rotates, `g` and `omega` are small and may cancel.
        let near_a_pole = |difference: S, from_here: S, constant: S, far: S, pole: S| {
            let quotient = points.quotient(pole, pole);
            let lost = from_here.re() / difference.re();
            let turning = (g.re().abs() + (omega * from_here).re().abs()) / (constant.re() * 2.0).abs();
            let product = 2.0 * turning + points.lost_at(pole);
            // A comparison with NaN is false: at the pole itself the product is zero, and exact.
            if difference.re() > 0.0 && (lost <= product || product.is_nan()) {
                (difference, lost)
            } else {
                (constant * constant * 4.0 / (far * quotient), product)
            }
        };
        let (north_far, south_far) = (north - points.low, south + points.high);
        let (north_near, lost_north) = near_a_pole(north - points.high, north, north_constant, north_far, north);
        let (south_near, lost_south) = near_a_pole(south + points.low, south, south_constant, south_far, -south);
        let north_term = oscillation.pole_term(north_constant, Pole::North, north_far, north_near);
        let south_term = oscillation.pole_term(south_constant, Pole::South, south_far, south_near);
        let start = oscillation.place(S::zero());
        let north_start = oscillation.integral(&north_term, Pole::North, &start, S::zero());
        let south_start = oscillation.integral(&south_term, Pole::South, &start, S::zero());
        // Near a pole the rounding of the angles of a state is divided by the distance from the pole; the error remains
        // after the passage.
        let sine = |distance: S| (distance.re() * (2.0 - distance.re())).abs().sqrt();
        let least_sine = sine(north_near).min(sine(south_near));
        let period = oscillation.half_period.re();
        let turns = north_start.re()
            + south_start.re()
            + north_term.mean_rate(oscillation.half_period).re()
            + south_term.mean_rate(oscillation.half_period).re();
        Error::ensure(
            period > 0.0 && turns.is_finite(),
            "half the period of the inclination",
            period,
            "within the range of doubles, and so must its fourth power; choose another unit of time",
        )?;
        Ok(Self {
            north_distance: (north_far, north_near),
            south_distance: (south_near, south_far),
            north_constant,
            south_constant,
            north_start,
            south_start,
            north: north_term,
            south: south_term,
            oscillation,
            condition: points.condition + lost_north + lost_south + 1.0 / least_sine,
        })
    }

    /// `1 - u` and `1 + u`, sums of positive terms.
    pub(super) fn distances(&self, place: &Place<S>) -> (S, S) {
        let (low, high) = place.shares;
        (
            self.north_distance.0 * low + self.north_distance.1 * high,
            self.south_distance.0 * low + self.south_distance.1 * high,
        )
    }
}
