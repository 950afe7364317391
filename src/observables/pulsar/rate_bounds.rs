//! Bounds on the rates of directions fixed in the body that hold at all times of a motion.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::observables::pulsar::rate_bounds::rate_bounds;
//! use twofold::{BodyState, RigidSpheroid};
//!
//! let state = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 2.2, equatorial_axis: Vector3::x() };
//! let bounds = rate_bounds(&RigidSpheroid::in_units_of_tc(1.1), &Matrix3::zeros(), 0.0, &state);
//! assert!(bounds.first >= 2.0 && bounds.second >= 4.0 && bounds.first < 2.0001); // Omega = 2
//! ```

use nalgebra::Matrix3;

use crate::dynamics::equations_of_motion::angular_velocity;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::traceless;
use crate::numerics::scalar::{Real, real_part};
use crate::propagation::{MOST_COUNTED, Motion, Turning};

/// Bounds on time derivatives of any unit vector fixed in the body, hence of `m.n`, that hold at all times of the motion
/// through a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateBounds {
    /// Bound on `|dm/dt|`, the largest `|Omega|`.
    pub first: f64,
    /// Bound on `|d2m/dt2|`.
    pub second: f64,
    /// Bound on `|d3m/dt3|`.
    pub third: f64,
    /// Bound on the fourth derivative.
    pub fourth: f64,
    /// Bound on the sixth derivative.
    pub sixth: f64,
}

impl RateBounds {
    /// From bounds on `|Omega|` and its first five time derivatives: with `m' = Omega x m` the derivatives of `m` are at
    /// most `m_0 = 1, m_(k+1) = sum_j (k over j) w_j m_(k-j)`.
    pub(super) fn of_angular_velocity(omega: &[f64; 6]) -> Self {
        let mut m = [0.0; HIGHEST + 1];
        m[0] = 1.0;
        for k in 0..HIGHEST {
            m[k + 1] = leibniz(k, omega, &m);
        }
        // Unit vectors are of unit length only to 1e-9.
        let slack = 1.0 + 1e-7;
        let [_, first, second, third, fourth, _, sixth] = m.map(|bound| bound * slack);
        Self { first, second, third, fourth, sixth }
    }

    /// The bounds for a motion, from its state at a time of the span and its [`Turning`].
    pub(super) fn of_motion<M: Motion<f64, State = BodyState<f64>>>(
        motion: &M,
        turning: &Turning<'_>,
        t: f64,
    ) -> Result<Self, Error> {
        let bounds = match turning {
            Turning::Equations { bulge } => {
                return Ok(rate_bounds(motion.spheroid(), motion.coefficients(), *bulge, &motion.state(t)?));
            }
            Turning::Given { bounds, .. } => bounds,
        };
        for &bound in bounds {
            let allowed = "finite and not negative";
            Error::ensure(bound >= 0.0 && bound.is_finite(), "bound on a derivative of Omega", bound, allowed)?;
        }
        Ok(Self::of_angular_velocity(bounds))
    }

    /// Refuses an interval of time with more turns than can be followed one by one, or so late that doubles do not resolve its turns.
    pub(super) fn check_countable(&self, from: f64, to: f64) -> Result<(), Error> {
        let rotation = self.first * (to - from).abs();
        if rotation.is_nan() {
            // The error is reported with the state that causes it.
            return Ok(());
        }
        Error::ensure(
            rotation <= MOST_COUNTED,
            "rotation (rad)",
            rotation,
            "at most 1e9; turns are examined one by one",
        )?;
        let latest = from.abs().max(to.abs());
        Error::ensure(
            // A sum changes if the addend is more than half the spacing of doubles.
            from == to || latest + LEAST_RESOLVED / 2.0 / self.first > latest,
            "time t",
            latest,
            "a time at which doubles resolve a rotation of 0.2 rad",
        )
    }
}

/// Rotation (rad) that times have to resolve.
const LEAST_RESOLVED: f64 = 0.2;

/// Highest derivative that is bounded.
const HIGHEST: usize = 6;

/// The bounds from one state of the motion, using its energy and spin.
///
/// With `T = |C| (largest - smallest eigenvalue of s) / I^xx`, bounded by the Frobenius norm of its anisotropic part, the torque is
/// at most `I^xx T`. Conservation of energy gives `|dn/dt|^2 <= |dn/dt|^2(now) + 2 T = v^2`, and the spin `Omega^z` is constant.
/// Hence, with `w = sqrt(v^2 + Omega^z^2)`, `e = |I^zz - I^xx| |Omega^z| / I^xx` and
/// `g = sqrt(v^2 + (I^zz Omega^z / I^xx)^2) >= |L| / I^xx`, the derivatives of order `k` of `L / I^xx`, `n`, `Omega` and `m` are at
/// most `l_k`, `n_k`, `w_k` and `m_k`, the last with `m_0 = 1, m_(k+1) = sum_j (k over j) w_j m_(k-j)` from `m' = Omega x m`:
///
/// ```text
/// l_0 = g,   l_(k+1) = T sum_j (k over j) n_j n_(k-j)          L' = 2 C (s n) x n, to s any multiple of 1 may be added
/// n_0 = 1,   n_1 = v,   n_(k+1) = sum_j (k over j) l_j n_(k-j)   I^xx n' = L x n
/// w_0 = w,   w_k = l_k + e n_k                                 Omega = L / I^xx - (I^zz - I^xx) Omega^z n / I^xx
/// ```
///
/// A bulge of the energy `b L.(s L)` rotates everything by `2 b s L`, at most `B |L| / I^xx` with `B = 2 |b| |s| I^xx`. The energy then gives
/// `(1 - B) g^2 <= (1 + B) g^2(now) + 2 T`, and `v^2` grows by `2 T + B (g^2(now) + g^2)`. In the rate of `n` and in `w`, `(1 + B) l` replaces `l`,
/// and `l_(k+1)` has the additional term `B sum_j (k over j) l_j l_(k-j)`. For `B >= 1` the bounds are infinite.
pub fn rate_bounds<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, bulge: S, state: &BodyState<S>) -> RateBounds {
    let (xx, zz) = (spheroid.inertia_xx.re(), spheroid.inertia_zz.re());
    let s = s.map(S::re);
    let anisotropic = traceless(&s);
    let torque = spheroid.constant_c.re().abs() * anisotropic.norm() * core::f64::consts::SQRT_2 / xx;
    let omega = real_part(&angular_velocity(spheroid, &state.axis, &state.momentum));
    let axis = real_part(&state.axis);
    let spin = omega.dot(&axis).abs();
    let of_bulge = 2.0 * bulge.re().abs() * anisotropic.norm() * xx;
    // Without a bulge this is zero even if `size` is infinite.
    let by_bulge = |size: f64| if of_bulge > 0.0 { of_bulge * size } else { 0.0 };
    let (across, along) = (omega.cross(&axis).norm_squared(), zz / xx * spin);
    let now = across + along * along;
    let most = if of_bulge < 1.0 { (now * (1.0 + of_bulge) + 2.0 * torque) / (1.0 - of_bulge) } else { f64::INFINITY };
    let v = (across + 2.0 * torque + by_bulge(now + most)).sqrt();
    let e = ((zz - xx) / xx).abs() * spin;
    let g = v.hypot(along);
    let w = v.hypot(spin) + by_bulge(g);

    let ([mut l, mut n], mut omega) = ([[0.0; HIGHEST]; 2], [0.0; HIGHEST]);
    (l[0], n[0], omega[0]) = (g, 1.0, w);
    for k in 0..HIGHEST - 1 {
        l[k + 1] = torque * leibniz(k, &n, &n) + by_bulge(leibniz(k, &l, &l));
        n[k + 1] = if k == 0 { v + by_bulge(g) } else { (1.0 + of_bulge) * leibniz(k, &l, &n) };
        omega[k + 1] = (1.0 + of_bulge) * l[k + 1] + e * n[k + 1];
    }
    RateBounds::of_angular_velocity(&omega)
}

/// Derivative of order `k` of a product from those of its factors.
fn leibniz(k: usize, a: &[f64], b: &[f64]) -> f64 {
    let mut binomial = 1.0;
    let mut sum = 0.0;
    for j in 0..=k {
        sum += binomial * a[j] * b[k - j];
        binomial *= (k - j) as f64 / (j + 1) as f64;
    }
    sum
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn the_limits_on_rotation_and_on_late_times_are_checked_on_both_sides() {
        let is_refused = |first: f64, from: f64, to: f64| {
            let bounds = RateBounds { first, second: 1.0, third: 1.0, fourth: 1.0, sixth: 1.0 };
            bounds.check_countable(from, to).is_err()
        };
        // 1e9 rad, in either order.
        for (length, refused) in [(1.99e9, false), (2.01e9, true)] {
            for (from, to) in [(3.0, 3.0 + length), (3.0 + length, 3.0)] {
                assert_eq!(is_refused(0.5, from, to), refused, "{from} {to}");
            }
        }
        // From this time on doubles are one apart, before it half of that: the nearest one that is more than a half away is
        // resolved.
        let late = 2_f64.powi(52);
        for (first, refused) in [(0.19, false), (0.21, true)] {
            for (from, to) in [(late - 50.0, late), (late, late - 50.0), (-late, 50.0 - late), (50.0 - late, -late)] {
                assert_eq!(is_refused(first, from, to), refused, "{first} {from} {to}");
            }
        }
        assert!(!is_refused(0.21, late - 50.0, late - 1.0) && !is_refused(0.21, late, late));
        assert!(!is_refused(f64::NAN, 0.0, 1.0));
    }

    /// With `n` and `L` on a principal axis of `s` a bulge adds its contribution to a uniform rotation.
    #[test]
    fn the_bounds_have_the_turning_of_a_bulge() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.9, constant_c: 0.0 };
        let state = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 1.9, equatorial_axis: Vector3::x() };
        for value in [0.2, -0.2] {
            let s = Matrix3::from_diagonal(&Vector3::new(-0.5 * value, -0.5 * value, value));
            let bounds = |bulge: f64| rate_bounds(&spheroid, &s, bulge, &state);
            // Omega = 1 + 2 b s L.
            let (found, omega) = (bounds(0.2), 1.0 + 2.0 * 0.2 * value * 1.9_f64);
            let all = [found.first, found.second, found.third, found.fourth, found.sixth];
            for (bound, order) in all.into_iter().zip([1, 2, 3, 4, 6]) {
                assert!(bound >= omega.powi(order), "{order}: {bound} {omega}");
            }
            assert!(found.first < 2.0, "{found:?}");
            assert!(bounds(0.0).first < 1.0 + 1e-6 && bounds(20.0).first == f64::INFINITY);
        }
    }

    /// From rest at the largest self-energy to the least: `I^xx |dn/dt|^2 / 2 = |C| (0.8 - (-0.8))`, which the bound meets for eigenvalues of this form.
    #[test]
    fn a_star_that_falls_from_rest_reaches_the_bound() {
        let s = Matrix3::from_diagonal(&Vector3::new(0.8, 0.0, -0.8));
        for constant_c in [0.7, -0.7] {
            let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.9, constant_c };
            let state = BodyState { axis: Vector3::x(), momentum: Vector3::zeros(), equatorial_axis: Vector3::y() };
            let found = rate_bounds(&spheroid, &s, 0.0, &state);
            assert_relative_eq!(found.first, (2.0_f64 * 0.7 * 1.6 / 1.3).sqrt(), max_relative = 1e-6);
        }
    }

    /// Without a torque, a star that rotates about its own axis does so uniformly: the derivative of order `k` is the `k`-th
    /// power of the rate.
    #[test]
    fn uniform_rotation_has_the_powers_of_its_rate_for_bounds() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.9, constant_c: 0.7 };
        let axis = Vector3::new(0.36, -0.48, 0.8);
        let equatorial_axis = axis.cross(&Vector3::x()).normalize();
        let rate = 1.7_f64;
        let state = BodyState { axis, momentum: axis * (-1.9 * rate), equatorial_axis };
        let found = rate_bounds(&spheroid, &Matrix3::zeros(), 0.0, &state);
        for (bound, order) in
            [(found.first, 1), (found.second, 2), (found.third, 3), (found.fourth, 4), (found.sixth, 6)]
        {
            assert_relative_eq!(bound, rate.powi(order), max_relative = 1e-6);
            assert!(bound > rate.powi(order));
        }
        // The size of a torque does not depend on the sign of C.
        let s = Matrix3::new(0.02, 0.01, 0.0, 0.01, -0.03, 0.004, 0.0, 0.004, 0.01);
        let opposite = RigidSpheroid { constant_c: -0.7, ..spheroid };
        assert_eq!(rate_bounds(&opposite, &s, 0.0, &state), rate_bounds(&spheroid, &s, 0.0, &state));
        assert!(rate_bounds(&spheroid, &s, 0.0, &state).first > 1.001 * rate);
    }
}
