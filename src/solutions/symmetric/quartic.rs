//! The quartic that drives the inclination, its turning points and its quotient by them.

use crate::scalar::Real;

/// `u'^2 = P(u0 + v) = p0 + p1 v + p2 v^2 + p3 v^3 + p4 v^4` for `u = cos beta`, about the initial `u0`.
#[derive(Debug, Clone, Copy)]
pub(super) struct InclinationQuartic<S> {
    pub(super) coefficients: [S; 5],
}

/// Turning points `low <= 0 <= high` of `v` and the quotient `Q = q0 + q1 v + q2 v^2` in
/// `P = (v - low)(high - v) Q(v)`, positive between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurningPoints<S> {
    pub(super) low: S,
    pub(super) high: S,
    quotient: [S; 3],
}

impl<S: Real> InclinationQuartic<S> {
    /// Turning points next to `v = 0`, within the ends of the sphere `south = -1 - u0` and `north = 1 - u0`, where `P <= 0`.
    ///
    /// Bracketed by real parts between the extrema of `P`, then polished by Newton steps that carry the derivatives.
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
        // Where the axis lingers near its start, the initial rate alone tells how slowly: P(0) = -low high q0.
        let cancels = deflated.re().abs() < 0.1 * ((sum * q1).re().abs() + (product * q2).re().abs() + p2.re().abs());
        let q0 = if cancels && p[0] > 0.0 { -(p0 / product) } else { deflated };
        TurningPoints { low, high, quotient: [q0, q1, q2] }
    }

    /// Newton steps: each doubles the number of orders of derivatives that are right.
    fn polished(&self, root: f64) -> S {
        let [p0, p1, p2, p3, p4] = self.coefficients;
        let mut v = S::from_f64(root);
        for _ in 0..3 {
            let value = (((p4 * v + p3) * v + p2) * v + p1) * v + p0;
            let slope = ((p4 * v * 4.0 + p3 * 3.0) * v + p2 * 2.0) * v + p1;
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

    /// The polar form `q0 + q1 (v + w) / 2 + q2 v w` of the quotient; `Q(v)` for `w = v`.
    pub(super) fn quotient(&self, v: S, w: S) -> S {
        let [q0, q1, q2] = self.quotient;
        q0 + q1 * (v + w) * 0.5 + q2 * v * w
    }
}

/// The root nearest to zero on the way to `end` of a polynomial (coefficients ascending) that is positive at zero; `end` if
/// rounding hides the change of sign that must be there.
fn first_root(p: &[f64], end: f64) -> f64 {
    roots_between(p, end).first().copied().unwrap_or(end)
}

/// Roots at which the polynomial changes sign between zero and `end`, in the order from zero.
fn roots_between(p: &[f64], end: f64) -> Vec<f64> {
    if p.len() < 2 {
        return Vec::new();
    }
    let slope: Vec<f64> = p.iter().enumerate().skip(1).map(|(i, c)| c * i as f64).collect();
    let mut ends = vec![0.0];
    ends.extend(roots_between(&slope, end));
    ends.push(end);
    ends.windows(2).filter_map(|w| root_where_monotone(p, &slope, w[0], w[1])).collect()
}

/// The root between `a` and `b`, if the signs there differ: Newton's method kept inside the shrinking bracket.
fn root_where_monotone(p: &[f64], slope: &[f64], mut a: f64, mut b: f64) -> Option<f64> {
    let at = |p: &[f64], v: f64| p.iter().rev().fold(0.0, |sum, c| sum * v + c);
    let positive_at_a = at(p, a) > 0.0;
    if positive_at_a == (at(p, b) > 0.0) {
        return None;
    }
    let mut v = 0.5 * (a + b);
    // Bisection alone needs up to 1100 steps to a root next to zero; Newton's steps leave a few.
    for _ in 0..1200 {
        let value = at(p, v);
        if (value > 0.0) == positive_at_a {
            a = v;
        } else {
            b = v;
        }
        let newton = v - value / at(slope, v);
        let next = if (newton - a) * (newton - b) < 0.0 { newton } else { 0.5 * (a + b) };
        if (next - v).abs() <= f64::EPSILON * v.abs() {
            break;
        }
        v = next;
    }
    Some(v)
}
