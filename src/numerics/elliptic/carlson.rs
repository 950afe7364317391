//! Carlson's symmetric elliptic integrals `R_F`, `R_C`, `R_D`, `R_J` by duplication (Carlson 1995, Numer. Algorithms 10,
//! 13; DLMF 19.36(i)).
//!
//! Written here because derivatives are needed: the crate `ellip` computes the same integrals, but only for floats, and
//! serves as the independent reference of the checks.
//!
//! Two of the arguments can be given by the sum and the product of their roots, `sqrt y + sqrt z` and `sqrt y sqrt z`. Only
//! these symmetric functions enter, so one formula covers two real arguments and two complex conjugate ones (sum
//! `sqrt(2 (|y| + Re y))`, product `|y|`), and is smooth where one case passes into the other.
//!
//! Accuracy: a few ulp (2.2e-16) relative to the value, and as much for the first three derivatives relative to their
//! natural size (value over powers of the argument). Squares of arguments must neither overflow nor underflow. Outside the
//! domain the result is NaN, infinite, or a number without meaning.
//!
//! # Example
//!
//! ```
//! use twofold::numerics::elliptic::carlson::{rc, rd, rf, rf_of_roots, rj, rj_of_roots};
//!
//! // The period of a pendulum of 90 degrees: K(k) = R_F(0, 1 - k^2, 1) with k^2 = 1/2.
//! assert!((rf(0.0, 0.5, 1.0) - 1.854_074_677_301_372_f64).abs() < 1e-15);
//! assert!((rc(0.0, 0.25) - core::f64::consts::PI).abs() < 1e-15);
//! // Equal arguments x give x^(-1/2) and x^(-3/2).
//! assert!((rd(4.0, 4.0, 4.0_f64) - 0.125).abs() < 1e-16 && (rj(4.0, 4.0, 4.0, 4.0_f64) - 0.125).abs() < 1e-16);
//! // Arguments 9, 4, 4 by sqrt(x), sqrt(y) + sqrt(z) and sqrt(y z), which stay real where y and z do not.
//! assert!((rf_of_roots(3.0, 4.0, 4.0) - rf(9.0, 4.0, 4.0_f64)).abs() < 1e-15);
//! assert!((rj_of_roots(3.0, 4.0, 4.0, 2.0) - rj(9.0, 4.0, 4.0, 2.0_f64)).abs() < 1e-15);
//! ```

use crate::numerics::scalar::Real;

/// Largest relative distance of an argument from the common mean at which the series is summed. The first neglected terms
/// have degree 8; after three differentiations, degree 5, they are still at 1e-15.
const SERIES_RADIUS: f64 = 1e-3;

/// More duplications than finite arguments need, since each brings them closer by a factor of four. Only NaN gets this far.
const MOST_DUPLICATIONS: usize = 600;

/// `R_F(x, y, z) = (1/2) int_0^inf dt / sqrt((t + x)(t + y)(t + z))`, DLMF (19.16.1).
///
/// Arguments not negative, at most one of them zero. With a zero argument all derivatives are NaN; [`rf_of_roots`] has those that exist.
pub fn rf<S: Real>(x: S, y: S, z: S) -> S {
    let (root_y, root_z) = (y.sqrt(), z.sqrt());
    rf_of_roots(x.sqrt(), root_y + root_z, root_y * root_z)
}

/// `R_F(x, y, z)` from `sqrt x`, `sqrt y + sqrt z` and `sqrt y sqrt z` (see the module).
///
/// `root_x >= 0`; smooth at `root_x = 0`, where the integral is complete.
pub fn rf_of_roots<S: Real>(root_x: S, root_sum: S, root_product: S) -> S {
    let mut at = Arguments::new(root_x, root_sum, root_product);
    for _ in 0..MOST_DUPLICATIONS {
        let centre = (at.x + at.mean * 2.0) / 3.0;
        let (x, _, yz) = at.deviations(centre);
        if near(&[x.re(), yz.re().abs().sqrt()]) {
            // x + y + z = 0 makes E2 = x (y + z) + y z = y z - x^2.
            let (e2, e3) = (yz - x * x, x * yz);
            let e2_e2 = e2 * e2;
            let series =
                S::one() - e2 / 10.0 + e3 / 14.0 + e2_e2 / 24.0 - e2 * e3 * (3.0 / 44.0) - e2 * e2_e2 * (5.0 / 208.0)
                    + e3 * e3 * (3.0 / 104.0)
                    + e2_e2 * e3 / 16.0;
            return series / centre.sqrt();
        }
        at.duplicate();
    }
    S::from_f64(f64::NAN)
}

/// `R_C(x, y) = R_F(x, y, y)`, DLMF (19.16.6): `x >= 0`, `y > 0`.
pub fn rc<S: Real>(x: S, y: S) -> S {
    let (mut x, mut y) = (x, y);
    for _ in 0..MOST_DUPLICATIONS {
        let centre = (x + y * 2.0) / 3.0;
        let s = (y - centre) / centre;
        if near(&[s.re() * 2.0]) {
            // 1 + 3/10 s^2 + 1/7 s^3 + 3/8 s^4 + 9/22 s^5 + 159/208 s^6 + 9/8 s^7
            let series = [9.0 / 22.0, 3.0 / 8.0, 1.0 / 7.0, 3.0 / 10.0]
                .into_iter()
                .fold(s * (9.0 / 8.0) + S::from_f64(159.0 / 208.0), |sum, c| sum * s + S::from_f64(c));
            return (series * s * s + S::one()) / centre.sqrt();
        }
        let lambda = (x * y).sqrt() * 2.0 + y;
        x = (x + lambda) / 4.0;
        y = (y + lambda) / 4.0;
    }
    S::from_f64(f64::NAN)
}

/// `R_D(x, y, z) = R_J(x, y, z, z) = (3/2) int_0^inf dt / ((t + z) sqrt((t + x)(t + y)(t + z)))`, DLMF (19.16.5).
///
/// `x`, `y` not negative and at most one of them zero, `z > 0`. With a zero argument all derivatives are NaN; [`rj_of_roots`] has
/// those that exist.
pub fn rd<S: Real>(x: S, y: S, z: S) -> S {
    let (root_x, root_y) = (x.sqrt(), y.sqrt());
    let mut at = Arguments::new(z.sqrt(), root_x + root_y, root_x * root_y);
    let (mut sum, mut scale) = (S::zero(), 1.0);
    for _ in 0..MOST_DUPLICATIONS {
        let centre = (at.mean * 2.0 + at.x * 3.0) / 5.0;
        let (z, _, xy) = at.deviations(centre);
        if near(&[z.re(), xy.re().abs().sqrt()]) {
            let z2 = z * z;
            let e2 = xy - z2 * 6.0;
            let e3 = (xy * 3.0 - z2 * 8.0) * z;
            let e4 = (xy - z2) * z2 * 3.0;
            let e5 = xy * z2 * z;
            return sum * 3.0 + degree_seven(e2, e3, e4, e5) * scale / (centre * centre.sqrt());
        }
        sum += S::from_f64(scale) / (at.root_x * (at.x + at.lambda()));
        scale *= 0.25;
        at.duplicate();
    }
    S::from_f64(f64::NAN)
}

/// `R_J(x, y, z, p) = (3/2) int_0^inf dt / ((t + p) sqrt((t + x)(t + y)(t + z)))`, DLMF (19.16.2).
///
/// `x`, `y`, `z` not negative and at most one of them zero, `p > 0`. With a zero argument all derivatives are NaN;
/// [`rj_of_roots`] has those that exist.
pub fn rj<S: Real>(x: S, y: S, z: S, p: S) -> S {
    let (root_y, root_z) = (y.sqrt(), z.sqrt());
    rj_of_roots(x.sqrt(), root_y + root_z, root_y * root_z, p)
}

/// `R_J(x, y, z, p)` from `sqrt x`, `sqrt y + sqrt z`, `sqrt y sqrt z` and `p` (see the module).
///
/// `root_x >= 0`, `p > 0`; smooth at `root_x = 0`, where the integral is complete.
pub fn rj_of_roots<S: Real>(root_x: S, root_sum: S, root_product: S, p: S) -> S {
    let mut at = Arguments::new(root_x, root_sum, root_product);
    let mut p = p;
    let (mut sum, mut scale) = (S::zero(), 1.0);
    for _ in 0..MOST_DUPLICATIONS {
        let centre = (at.x + at.mean * 2.0 + p * 2.0) / 5.0;
        let (x, y_and_z, yz) = at.deviations(centre);
        let q = (centre - p) / centre;
        if near(&[x.re(), q.re(), yz.re().abs().sqrt()]) {
            let (q2, xyz) = (q * q, x * yz);
            let e2 = x * y_and_z + yz - q2 * 3.0;
            let e3 = xyz + e2 * q * 2.0 + q2 * q * 4.0;
            let e4 = (xyz * 2.0 + e2 * q + q2 * q * 3.0) * q;
            let e5 = xyz * q2;
            return sum * 6.0 + degree_seven(e2, e3, e4, e5) * scale / (centre * centre.sqrt());
        }
        let root_p = p.sqrt();
        let d = (root_p + at.root_x) * (p + root_p * at.root_sum + at.root_product);
        // 1 + (p - x)(p - y)(p - z) / d^2, as a sum of positive terms.
        let y = root_p * (p + at.lambda()) * 2.0 / d;
        sum += rc(S::one(), y) * scale / d;
        scale *= 0.25;
        p = (p + at.lambda()) * 0.25;
        at.duplicate();
    }
    S::from_f64(f64::NAN)
}

/// The argument `x` and the pair `y`, `z` as they approach a common value.
struct Arguments<S> {
    x: S,
    root_x: S,
    /// `(y + z) / 2`.
    mean: S,
    /// `sqrt y + sqrt z`.
    root_sum: S,
    /// `sqrt y sqrt z`.
    root_product: S,
}

impl<S: Real> Arguments<S> {
    fn new(root_x: S, root_sum: S, root_product: S) -> Self {
        let mean = root_sum * root_sum * 0.5 - root_product;
        Self { x: root_x * root_x, root_x, mean, root_sum, root_product }
    }

    /// `sqrt x sqrt y + sqrt x sqrt z + sqrt y sqrt z`.
    fn lambda(&self) -> S {
        self.root_x * self.root_sum + self.root_product
    }

    /// Replaces every argument `x` by `(x + lambda) / 4`, which leaves `R_F` unchanged.
    ///
    /// With `s = sqrt y + sqrt z`, `(y + z) / 2 + lambda = s (s / 2 + sqrt x)` and `(y + lambda)(z + lambda) = s^2 (x + lambda)`: nothing cancels,
    /// also where `y` and `z` are near the negative axis.
    fn duplicate(&mut self) {
        let lambda = self.lambda();
        let x = (self.x + lambda) * 0.25;
        let mean = self.root_sum * (self.root_sum * 0.5 + self.root_x) * 0.25;
        let root_product = self.root_sum * x.sqrt() * 0.5;
        let root_sum = ((mean + root_product) * 2.0).sqrt();
        *self = Self { x, root_x: x.sqrt(), mean, root_sum, root_product };
    }

    /// Relative deviations from `centre`: that of `x`, the sum of those of the pair, and their product.
    fn deviations(&self, centre: S) -> (S, S, S) {
        (
            (centre - self.x) / centre,
            (centre - self.mean) * 2.0 / centre,
            (centre * centre - centre * self.mean * 2.0 + self.root_product * self.root_product) / (centre * centre),
        )
    }
}

/// Whether every relative deviation is small enough for the series.
fn near(deviations: &[f64]) -> bool {
    deviations.iter().all(|d| d.abs() <= SERIES_RADIUS)
}

/// The common series of `R_D` and `R_J` to degree 7, DLMF (19.36.2).
fn degree_seven<S: Real>(e2: S, e3: S, e4: S, e5: S) -> S {
    S::one() - e2 * (3.0 / 14.0) + e3 / 6.0 + e2 * e2 * (9.0 / 88.0) - e4 * (3.0 / 22.0) - e2 * e3 * (9.0 / 52.0)
        + e5 * (3.0 / 26.0)
        - e2 * e2 * e2 / 16.0
        + e3 * e3 * (3.0 / 40.0)
        + e2 * e4 * (3.0 / 20.0)
        + e2 * e2 * e3 * (45.0 / 272.0)
        - (e3 * e4 + e2 * e5) * (9.0 / 68.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `R_J(1, 1, 1, 4)` is `(3/2) int_1^inf u^(-3/2) du / (u + 3)`, with u = v^2 an arc tangent: `1 - pi / (3 sqrt 3)`. With 1/4 for 4 the
    /// integral is an inverse hyperbolic tangent instead.
    #[test]
    fn three_equal_arguments_of_the_third_kind_have_a_closed_form() {
        let root_three = 3f64.sqrt();
        let far = 1.0 - core::f64::consts::PI / (3.0 * root_three);
        let near = 4.0 * (2.0 * (root_three / 2.0).atanh() / root_three - 1.0);
        for (p, expected) in [(4.0, far), (0.25, near)] {
            for z in [1.0, 1.0 + 1e-15] {
                assert!((rj(1.0, 1.0, z, p) / expected - 1.0).abs() < 1e-14, "{p}: {} {expected}", rj(1.0, 1.0, z, p));
            }
        }
    }

    /// `R_F` of these roots, by mpmath with 60 digits.
    const REFERENCES: [([f64; 3], f64); 4] = [
        ([1e-3, 1e-8, 1.0], 20.499_113_036_244_412),
        ([1.0, 1e-8, 1.0], 14.362_679_314_918_039),
        ([0.0, 1e-9, 1.0], 22.802_707_378_626_25),
        ([0.5, 0.01, 1.0], 5.748_115_486_319_065),
    ];

    #[test]
    fn a_conjugate_pair_near_the_negative_axis_keeps_its_digits() {
        for ([root_x, root_sum, root_product], expected) in REFERENCES {
            let found = rf_of_roots(root_x, root_sum, root_product);
            assert!((found / expected - 1.0).abs() < 2e-15, "{root_x} {root_sum} {root_product}: {found} {expected}");
        }
        let found = rj_of_roots(1e-3, 1e-8, 1.0, 0.7);
        assert!((found / 36.546_563_163_515_29 - 1.0).abs() < 2e-15, "{found}");
    }

    /// Of 1, 2, 1 and p = 1/2 the mean (x + y + z + 2 p) / 5 is 1: only y and p are far from it.
    #[test]
    fn an_integral_of_the_third_kind_is_symmetric() {
        let of = |[x, y, z]: [f64; 3]| rj(x, y, z, 0.5);
        let expected = of([2.0, 1.0, 1.0]);
        for arguments in [[1.0, 2.0, 1.0], [1.0, 1.0, 2.0]] {
            assert!((of(arguments) / expected - 1.0).abs() < 1e-15, "{} {expected}", of(arguments));
        }
    }
}
