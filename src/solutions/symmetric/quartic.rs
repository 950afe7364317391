//! The quartic that governs the inclination, its turning points and its quotient by them.

use crate::numerics::polynomial::first_root;
use crate::numerics::scalar::Real;

/// `u'^2 = P(u0 + v) = p0 + p1 v + p2 v^2 + p3 v^3 + p4 v^4` for `u = cos beta`, about the initial `u0`.
///
/// With `w2 = b'^2 + a'^2 sin^2 b` and `g = a' sin^2 b` at the start, `P(u0 + v) = p0 + v B(v)`,
///
/// ```text
/// B(v) = -(2 u0 + v) (w2 + k sin^2 b) + omega (2 g - omega v),    sin^2 b = (1 - u0 - v) (1 + u0 + v).
/// ```
///
/// Far from `u0` the powers of `v` cancel, but this form does not.
#[derive(Debug, Clone, Copy)]
pub(super) struct InclinationQuartic<S> {
    pub(super) coefficients: [S; 5],
    /// `u0`, `1 - u0` and `1 + u0`.
    pub(super) cos: S,
    pub(super) north: S,
    pub(super) south: S,
    pub(super) speed_squared: S,
    pub(super) g: S,
    pub(super) omega: S,
    pub(super) k: S,
}

/// Turning points `low <= 0 <= high` of `v` and the quotient `Q = q0 + q1 v + q2 v^2` in
/// `P = (v - low)(high - v) Q(v)`, positive between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurningPoints<S> {
    pub(super) low: S,
    pub(super) high: S,
    pub(super) quotient: [S; 3],
    /// `Q(low)` and `Q(high)`.
    pub(super) at_low: S,
    pub(super) at_high: S,
    /// Factor by which rounding is amplified: the sum of the magnitudes of the terms of `Q` divided by their sum, the larger of its
    /// values at the two points.
    pub(super) condition: f64,
}

impl<S: Real> InclinationQuartic<S> {
    /// Turning points next to `v = 0`, within the ends of the sphere `south = -1 - u0` and `north = 1 - u0`, where `P <= 0`.
    ///
    /// They are bracketed by real parts between the extrema of `P`, then polished by Newton steps that carry the derivatives.
    pub(super) fn turning_points(&self, south: f64, north: f64) -> TurningPoints<S> {
        let p = self.coefficients.map(S::re);
        let (low, high) = if p[0] > 0.0 {
            (first_root(&p, south), first_root(&p, north))
        } else if p[1] > 0.0 {
            (0.0, first_root(&p[1..], north))
        } else {
            (first_root(&p[1..].iter().map(|c| -c).collect::<Vec<_>>(), south), 0.0)
        };
        let (low, high) = (self.polished(low), self.polished(high));
        let [p0, _, p2, p3, p4] = self.coefficients;
        let (sum, product) = (low + high, low * high);
        let q2 = -p4;
        let q1 = sum * q2 - p3;
        let deflated = sum * q1 - product * q2 - p2;
        // If the axis lingers near its start, only the initial rate determines how slowly: P(0) = -low high q0.
        let cancels = deflated.re().abs() < 0.1 * ((sum * q1).re().abs() + (product * q2).re().abs() + p2.re().abs());
        let q0 = if cancels && p[0] > 0.0 { -(p0 / product) } else { deflated };
        let mut points = TurningPoints { low, high, quotient: [q0, q1, q2], at_low: q0, at_high: q0, condition: 1.0 };
        let (at_low, lost_low) = self.quotient_at(&points, low, high);
        let (at_high, lost_high) = self.quotient_at(&points, high, low);
        (points.at_low, points.at_high, points.condition) = (at_low, at_high, lost_low.max(lost_high));
        points
    }

    /// `Q` at a turning point, from its coefficients or as `P'(low) / (high - low)`, `-P'(high) / (high - low)`, whichever cancels
    /// less; and the sum of the magnitudes of the terms used divided by their sum.
    fn quotient_at(&self, points: &TurningPoints<S>, v: S, other: S) -> (S, f64) {
        let (of_powers, powers) = (points.quotient(v, v), points.lost_at(v));
        let (_, slope, terms) = self.value_and_slope(v);
        let of_slope = slope / (other - v);
        let slopes = terms / slope.re().abs();
        // A NaN is not used.
        if slopes < powers { (of_slope, slopes) } else { (of_powers, powers) }
    }

    /// `P`, `P'` and the sum of the magnitudes of the terms of `P'` at `u0 + v`.
    fn value_and_slope(&self, v: S) -> (S, S, f64) {
        let twice_mean = self.cos * 2.0 + v;
        let sin_squared = (self.north - v) * (self.south + v);
        let speed = self.speed_squared + self.k * sin_squared;
        let by_spin = self.omega * (self.g * 2.0 - self.omega * v);
        let terms = -(twice_mean * speed) + by_spin;
        let bent = twice_mean * (self.cos + v) * self.k * 2.0;
        let twisted = self.omega * self.omega;
        let terms_slope = bent - speed - twisted;
        let size = |x: S| x.re().abs();
        let speed_size = size(self.speed_squared) + size(self.k * sin_squared);
        let sum = size(twice_mean) * speed_size + size(by_spin) + size(v) * (size(bent) + speed_size + size(twisted));
        (self.coefficients[0] + v * terms, terms + v * terms_slope, sum)
    }

    /// Newton steps: each doubles the order to which the derivatives are correct.
    fn polished(&self, root: f64) -> S {
        let mut v = S::from_f64(root);
        for _ in 0..3 {
            let (value, slope, _) = self.value_and_slope(v);
            v -= value / slope;
        }
        v
    }
}

impl<S: Real> TurningPoints<S> {
    /// `4 q0 q2 - q1^2`: minus the discriminant of the quotient.
    pub(super) fn quotient_determinant(&self) -> S {
        let [q0, q1, q2] = self.quotient;
        q0 * q2 * 4.0 - q1 * q1
    }

    /// Sum of the magnitudes of the terms of `Q(v)` divided by `Q(v)`.
    pub(super) fn lost_at(&self, v: S) -> f64 {
        let [q0, q1, q2] = self.quotient;
        let terms = [q0, q1 * v, q2 * v * v];
        terms.iter().map(|x| x.re().abs()).sum::<f64>() / self.quotient(v, v).re().abs()
    }

    /// The polar form `q0 + q1 (v + w) / 2 + q2 v w` of the quotient; `Q(v)` for `w = v`.
    pub(super) fn quotient(&self, v: S, w: S) -> S {
        let [q0, q1, q2] = self.quotient;
        q0 + q1 * (v + w) * 0.5 + q2 * v * w
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Near an unstable steady precession, with a small rate: `P(0) = -low high q0`, of which the powers of the turning points give
    /// only half of the digits.
    #[test]
    fn where_the_axis_lingers_the_quotient_has_the_digits_of_the_rate() {
        let (cos, omega, k) = (0.1, 0.5, -2.0_f64);
        let sin2 = 1.0 - cos * cos;
        let alpha_rate = (omega - (omega * omega - 4.0 * cos * k * cos).sqrt()) / (2.0 * cos);
        for beta_rate in [1e-4, 3e-6] {
            let speed_squared = beta_rate * beta_rate + alpha_rate * alpha_rate * sin2;
            let g = alpha_rate * sin2;
            let p0 = beta_rate * beta_rate * sin2;
            let quartic = InclinationQuartic {
                coefficients: [
                    p0,
                    -2.0 * cos * speed_squared - 2.0 * k * cos * sin2 + 2.0 * omega * g,
                    4.0 * k * cos * cos - speed_squared - k * sin2 - omega * omega,
                    4.0 * k * cos,
                    k,
                ],
                cos,
                north: 1.0 - cos,
                south: 1.0 + cos,
                speed_squared,
                g,
                omega,
                k,
            };
            let points = quartic.turning_points(-1.0 - cos, 1.0 - cos);
            assert!(points.low < -0.1 && points.high > 0.1, "{points:?}");
            let product = -points.low * points.high * points.quotient(0.0, 0.0);
            assert_relative_eq!(product, p0, epsilon = 0.0, max_relative = 1e-13);
        }
    }
}
