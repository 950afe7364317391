//! States in a principal plane, or with `n` on a principal axis, with given integrals.

use nalgebra::Vector3;

use super::polynomial::roots_and_touches;
use crate::dynamics::first_integrals::FirstIntegrals;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;

/// Tolerance for `K` of a state, relative to the terms of `2 I^xx H` times `s`: a double root of the quartic is known to half the
/// digits, and `K` then to all.
const TOLERANCE: f64 = 1e-13;

/// Rounding of the energy and of `L.L`, relative to their terms.
pub(super) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// States with axes closer than this are identical: a double root is known to half the digits.
const NEAREST: f64 = 1e-6;

/// Largest distance that Newton's method may go from a root of the quartic, which is accurate to at least half the digits: another root is
/// another candidate.
const FARTHEST: f64 = 1e-3;

/// The required integrals of a state.
pub(super) struct Wanted {
    constant_c: f64,
    inertia: f64,
    /// `L.L / (2 I^xx) + C n.(s n)`.
    hamiltonian: f64,
    /// `L.n`.
    along: f64,
    third: f64,
    /// Sum of the magnitudes of the terms of `2 I^xx H`.
    size: f64,
}

/// `n` and `L` in a principal plane: `n = (cos b, sin b)`, `L = p n + u (-sin b, cos b)` in the axes `axes`.
pub(super) struct Plane {
    axes: [usize; 2],
    along: f64,
    /// `(s_i - s_j) / 2`.
    half: f64,
    /// `L.L = m0 + m1 x`, `x = cos 2b`.
    square: [f64; 2],
    /// `K - K_0 = q(x) - 2 half p u sin 2b`.
    q: [f64; 3],
    /// Upper limit on `L.L` and on the terms of which it is computed.
    size: f64,
}

impl Plane {
    /// Rounding of `u^2`, the difference of `L.L` and `p^2`.
    fn rounding(&self) -> f64 {
        ROUNDING * self.size
    }

    /// `u^2`; where it is below zero by more than its rounding, there is no state of this energy.
    fn square_across(&self, b: f64) -> f64 {
        self.square[0] + self.square[1] * (2.0 * b).cos() - self.along * self.along
    }

    fn momentum_across(&self, b: f64) -> f64 {
        self.square_across(b).max(0.0).sqrt()
    }

    /// `K - K_0`.
    fn miss(&self, b: f64) -> f64 {
        let ((y, x), u) = ((2.0 * b).sin_cos(), self.momentum_across(b));
        (self.q[2] * x + self.q[1]) * x + self.q[0] - 2.0 * self.half * self.along * u * y
    }

    /// `dK / db`.
    pub(super) fn slope(&self, b: f64) -> f64 {
        let ((y, x), u) = ((2.0 * b).sin_cos(), self.momentum_across(b));
        let turn = 2.0 * u * x - self.square[1] * y * y / u;
        -2.0 * y * (2.0 * self.q[2] * x + self.q[1]) - 2.0 * self.half * self.along * turn
    }

    pub(super) fn state(&self, b: f64) -> BodyState<f64> {
        let ([i, j], p, u) = (self.axes, self.along, self.momentum_across(b));
        let (sin, cos) = b.sin_cos();
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        (axis[i], axis[j]) = (cos, sin);
        (momentum[i], momentum[j]) = (p * cos - u * sin, p * sin + u * cos);
        equatorial_axis[3 - i - j] = 1.0;
        BodyState { axis, momentum, equatorial_axis }
    }

    /// `b` after Newton steps, as long as each removes at least half of the remainder of `K - K_0`: at a double root it removes
    /// three quarters.
    fn corrected(&self, start: f64) -> f64 {
        let mut b = start;
        loop {
            let next = b - self.miss(b) / self.slope(b);
            // NaN on the edge, where the slope has a pole.
            let helps = self.miss(next).abs() < 0.5 * self.miss(b).abs()
                && (next - start).abs() < FARTHEST
                && self.square_across(next) >= -2.0 * self.rounding();
            if !helps {
                return b;
            }
            b = next;
        }
    }

    /// Tolerance for `K` of the state at the angle `b`: the rounding of its terms, and that of `u`.
    fn tolerance(&self, s: &Vector3<f64>, b: f64) -> f64 {
        let rounding = self.rounding();
        let of_u = rounding.sqrt().min(rounding / (2.0 * self.momentum_across(b)));
        TOLERANCE * self.size * s.amax() + 4.0 * (self.half * self.along).abs() * of_u
    }

    /// `x` between -1 and 1 where `u^2 >= 0` to its rounding: the rounded energy of a motion may be slightly too small for any state.
    fn range(&self) -> Option<(f64, f64)> {
        let ([m0, m1], square) = (self.square, self.along * self.along - self.rounding());
        let (mut low, mut high) = (-1.0_f64, 1.0_f64);
        if m1 == 0.0 {
            return (m0 >= square).then_some((low, high));
        }
        let edge = (square - m0) / m1;
        if m1 > 0.0 {
            low = low.max(edge);
        } else {
            high = high.min(edge);
        }
        (low <= high).then_some((low, high))
    }

    /// Angles at which `K = K_0` or at which the curve may touch it.
    fn candidates(&self) -> Vec<f64> {
        let Some((low, high)) = self.range().filter(|_| self.half != 0.0) else { return Vec::new() };
        let ([q0, q1, q2], [m0, m1]) = (self.q, self.square);
        let f = 4.0 * self.half * self.half * self.along * self.along;
        if f == 0.0 {
            return roots_and_touches(&self.q, low, high);
        }
        let (r0, r1) = (f * (m0 - self.along * self.along), f * m1);
        let quartic = [q0 * q0 - r0, 2.0 * q0 * q1 - r1, q1 * q1 + 2.0 * q0 * q2 + r0, 2.0 * q1 * q2 + r1, q2 * q2];
        roots_and_touches(&quartic, low, high)
    }
}

/// Whether two states with the same integrals, at least one of them in a principal plane, are identical or images under half turns about the
/// principal axes. These change the signs of the components of both vectors, two at a time.
pub(super) fn is_image(one: &BodyState<f64>, other: &BodyState<f64>) -> bool {
    let size = one.momentum.norm();
    let apart = |a: &Vector3<f64>, b: &Vector3<f64>| (a.abs() - b.abs()).norm();
    // For n and L that cross in the plane, K has another value for (n_x, n_z) than for (n_x, -n_z) with the same L: the products
    // distinguish them.
    let turned = one.axis.component_mul(&one.momentum) - other.axis.component_mul(&other.momentum);
    apart(&one.axis, &other.axis) < NEAREST
        && apart(&one.momentum, &other.momentum) < NEAREST * size
        && turned.norm() < NEAREST * size
}

impl Wanted {
    /// A state of this body with these integrals.
    pub(super) fn new(body: &RigidSpheroid<f64>, integrals: &FirstIntegrals<f64>) -> Result<Self, Error> {
        let RigidSpheroid { inertia_xx: inertia, inertia_zz, constant_c } = *body;
        let FirstIntegrals { energy, spin, clebsch: third } = *integrals;
        let least = inertia.min(inertia_zz);
        Error::ensure(least > 0.0, "moments of inertia", least, "above zero")?;
        let along = inertia_zz * spin;
        let terms = [energy, -along * spin / 2.0, along * along / (2.0 * inertia)];
        let size = 2.0 * inertia * terms.iter().map(|term| term.abs()).sum::<f64>();
        Ok(Self { constant_c, inertia, hamiltonian: terms.iter().sum(), along, third, size })
    }

    pub(super) fn plane(&self, s: &Vector3<f64>, axes: [usize; 2]) -> Plane {
        let [si, sj] = axes.map(|i| s[i]);
        let (middle, half) = ((si + sj) / 2.0, (si - sj) / 2.0);
        let Self { constant_c: c, inertia, hamiltonian, along, third, .. } = *self;
        let square @ [m0, m1] = [2.0 * inertia * (hamiltonian - c * middle), -2.0 * inertia * c * half];
        let normal_pull = 2.0 * c * inertia * s[3 - axes[0] - axes[1]];
        let q = [
            middle * m0 - normal_pull * middle - third,
            middle * m1 + half * (2.0 * along * along - m0) + normal_pull * half,
            -half * m1,
        ];
        let size = self.size + 2.0 * c.abs() * inertia * s.amax();
        Plane { axes, along, half, square, q, size }
    }

    /// Range of the angle `b` in which `K` has an extremum in a plane: about the angle at which `L` is along the second axis, as far as the torque
    /// can move it for a given spread of the principal values of `s`.
    pub(super) fn about_second_axis(&self, spread: f64) -> [f64; 2] {
        let square = (2.0 * self.inertia * self.hamiltonian).max(0.0);
        let middle = self.along.atan2((square - self.along * self.along).max(0.0).sqrt());
        let reach = (4.0 * self.constant_c.abs() * spread * self.inertia / square).min(0.1);
        [middle - reach, middle + reach]
    }

    /// States with `n` and `L` in the plane normal to the axis `normal`, up to half turns about the axes.
    pub(super) fn in_plane(&self, s: &Vector3<f64>, normal: usize) -> Vec<BodyState<f64>> {
        let plane = self.plane(s, [(normal + 1) % 3, (normal + 2) % 3]);
        let mut states: Vec<BodyState<f64>> = Vec::new();
        for x in plane.candidates() {
            for side in [1.0, -1.0] {
                let b = plane.corrected(0.5 * x.acos() * side);
                let state = plane.state(b);
                if plane.miss(b).abs() <= plane.tolerance(s, b) && !states.iter().any(|other| is_image(other, &state)) {
                    states.push(state);
                }
            }
        }
        states
    }

    /// The state with `n` on the axis `on`, up to half turns about the axes.
    pub(super) fn on_axis(&self, s: &Vector3<f64>, on: usize) -> Option<BodyState<f64>> {
        let (i, j) = ((on + 1) % 3, (on + 2) % 3);
        let Self { constant_c: c, inertia, hamiltonian, along: p, third, .. } = *self;
        let across = 2.0 * inertia * (hamiltonian - c * s[on]) - p * p;
        let pulled = third - s[on] * p * p + 2.0 * c * inertia * s[i] * s[j];
        let squares = [(pulled - s[j] * across) / (s[i] - s[j]), (pulled - s[i] * across) / (s[j] - s[i])];
        if !(squares[0] >= 0.0 && squares[1] >= 0.0) {
            return None;
        }
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        (axis[on], momentum[on], equatorial_axis[i]) = (1.0, p, 1.0);
        (momentum[i], momentum[j]) = (squares[0].sqrt(), squares[1].sqrt());
        Some(BodyState { axis, momentum, equatorial_axis })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::first_integrals::first_integrals;
    use crate::lorentz_violation::PrincipalCoefficients;

    pub(in crate::solutions::torus) const BODY: RigidSpheroid<f64> =
        RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
    pub(in crate::solutions::torus) const PROLATE: RigidSpheroid<f64> =
        RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: -0.8 };
    pub(in crate::solutions::torus) const S: PrincipalCoefficients<f64> =
        PrincipalCoefficients { xx: 0.21, yy: -0.04, zz: 0.09 };

    /// The state in a plane with `n` at the angle `b`, and with the components `along` of `L` along `n` and `across` perpendicular to it.
    fn in_plane(axes: [usize; 2], b: f64, along: f64, across: f64) -> BodyState<f64> {
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let (sin, cos) = b.sin_cos();
        (axis[axes[0]], axis[axes[1]]) = (cos, sin);
        (momentum[axes[0]], momentum[axes[1]]) = (along * cos - across * sin, along * sin + across * cos);
        equatorial_axis[3 - axes[0] - axes[1]] = 1.0;
        BodyState { axis, momentum, equatorial_axis }
    }

    #[test]
    fn the_range_is_where_the_momentum_is_real() {
        let range = |along: f64, square: [f64; 2]| {
            Plane { axes: [0, 1], along, half: 0.1, square, q: [0.0; 3], size: 0.0 }.range()
        };
        assert_eq!(range(2.0, [9.0, 0.0]), Some((-1.0, 1.0)));
        assert_eq!(range(3.0, [9.0, 0.0]), Some((-1.0, 1.0)));
        assert_eq!(range(3.1, [9.0, 0.0]), None);
        assert_eq!(range(2.0, [4.5, 1.0]), Some((-0.5, 1.0)));
        assert_eq!(range(2.0, [4.5, -1.0]), Some((-1.0, 0.5)));
        assert_eq!(range(2.0, [3.5, 1.0]), Some((0.5, 1.0)));
        assert_eq!(range(2.0, [3.5, -1.0]), Some((-1.0, -0.5)));
        assert_eq!(range(2.0, [9.0, 1.0]), Some((-1.0, 1.0)));
        assert_eq!(range(2.0, [9.0, -1.0]), Some((-1.0, 1.0)));
        assert_eq!(range(2.0, [2.5, 1.0]), None);
        assert_eq!(range(2.0, [2.5, -1.0]), None);
        let square = Plane { axes: [0, 1], along: 2.0, half: 0.1, square: [3.5, 1.0], q: [0.0; 3], size: 0.0 };
        assert_eq!(square.momentum_across(1.2), 0.0);
    }

    /// By the magnitudes of the terms of `K` for an `L` normal to `n`, for slow and fast rotation and eigenvalues of any size; in the last two cases
    /// the two terms of `L.L` cancel.
    #[test]
    fn the_tolerance_is_relative_to_the_terms_of_the_integral() {
        let heavy = RigidSpheroid { inertia_xx: 10.0, inertia_zz: 12.0, constant_c: 5.0 };
        for body in [BODY, PROLATE, heavy] {
            for size in [1e-6, 1.0, 100.0] {
                for (s, b, across) in [
                    ([0.21, -0.04, 0.09], 0.3, 1.7),
                    ([0.21, -0.04, 0.09], 1.1, 1e-9),
                    ([1.0, -1.0, 0.1], 0.01, 1e-9),
                    ([1.0, -1.0, 0.1], 1.56, 1e-9),
                ] {
                    let s = Vector3::from(s) * size;
                    let state = in_plane([0, 1], b, 0.0, across);
                    let integrals = first_integrals(&body, &Matrix3::from_diagonal(&s), &state);
                    let wanted = Wanted::new(&body, &integrals).unwrap();
                    let plane = wanted.plane(&s, [0, 1]);
                    let pull = 2.0 * body.constant_c.abs() * body.inertia_xx * s.amax();
                    let expected = (2.0 * body.inertia_xx * integrals.energy.abs() + pull) * s.amax();
                    let found = plane.tolerance(&s, b);
                    assert_relative_eq!(found, TOLERANCE * expected, max_relative = 1e-12);
                    assert!(plane.miss(b).abs() < found);
                }
            }
        }
    }

    #[test]
    fn corrections_stay_at_their_root() {
        let body = BODY;
        let state = in_plane([0, 1], 0.3, 0.9, 1.7);
        let integrals = first_integrals(&body, &S.tensor(), &state);
        let plane = Wanted::new(&body, &integrals).unwrap().plane(&Vector3::new(S.xx, S.yy, S.zz), [0, 1]);
        for off in [5e-4, -5e-4, 1e-7] {
            assert_relative_eq!(plane.corrected(0.3 + off), 0.3, max_relative = 1e-13);
        }
        for off in [0.02, -0.02] {
            assert_eq!(plane.corrected(0.3 + off), 0.3 + off);
        }
        // With L.n at the rounding of zero, Newton steps do not reduce the remainder, and end at once.
        for along in [1e-13, 1e-18, 1e-300] {
            let integrals = FirstIntegrals { energy: 1.183_538_461_538_461_4, spin: along / 1.5, clebsch: -0.098_128 };
            let plane = Wanted::new(&body, &integrals).unwrap().plane(&Vector3::new(S.xx, S.yy, S.zz), [2, 0]);
            for start in [0.0, 1e-9, -1e-9, 1e-8] {
                assert!((plane.corrected(start) - start).abs() < FARTHEST);
            }
        }
    }

    #[test]
    fn images_are_those_by_half_turns() {
        let state = in_plane([0, 2], 0.7, 0.9, 1.7);
        let turned = |state: &BodyState<f64>, signs: [f64; 3]| BodyState {
            axis: state.axis.component_mul(&Vector3::from(signs)),
            momentum: state.momentum.component_mul(&Vector3::from(signs)),
            ..*state
        };
        for signs in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
            let image = turned(&state, signs);
            assert!(is_image(&state, &image));
            let moved = |axis: f64, momentum: f64| BodyState {
                axis: image.axis + Vector3::x() * axis,
                momentum: image.momentum + Vector3::x() * momentum,
                ..image
            };
            assert!(is_image(&moved(3e-7, 0.0), &state) && !is_image(&moved(3e-6, 0.0), &state));
            // In units of |L| = 1.92.
            assert!(is_image(&moved(0.0, 1.7e-6), &state) && !is_image(&moved(0.0, 3e-6), &state));
            let aside = BodyState { momentum: image.momentum + Vector3::y() * 3e-6, ..image };
            assert!(!is_image(&aside, &state));
        }
        // The same lengths of all components, with L on the other side of n.
        let other = BodyState { momentum: state.momentum.component_mul(&Vector3::new(-1.0, 1.0, 1.0)), ..state };
        assert!(!is_image(&state, &other));
    }

    /// `L` normal to `n`: both signs of `b` have the same `K`, and the positive one comes first.
    #[test]
    fn two_states_at_one_place_come_in_order() {
        let values = Vector3::new(S.xx, S.yy, S.zz);
        let state = in_plane([0, 1], 0.4, 0.0, 1.7);
        let found = Wanted::new(&BODY, &first_integrals(&BODY, &S.tensor(), &state)).unwrap().in_plane(&values, 2);
        let sides: Vec<_> =
            found.iter().filter(|s| (s.axis.x - 0.4_f64.cos()).abs() < 1e-9).map(|s| s.axis.y).collect();
        assert!(sides.len() == 2 && sides[0] > 0.38 && sides[1] < -0.38, "{found:?}");
    }

    /// With `L.n` exactly zero the equation is quadratic, and its roots are candidates without correction.
    #[test]
    fn roots_of_the_quadratic_on_one_side_are_both_found() {
        let plane = Plane { axes: [0, 1], along: 0.0, half: 0.3, square: [4.0, 0.1], q: [0.18, -0.9, 1.0], size: 0.0 };
        let candidates = plane.candidates();
        for root in [0.3, 0.6] {
            assert!(candidates.iter().any(|x| (x - root).abs() < 1e-14), "{candidates:?}");
        }
    }

    /// A state at which `K` has an extremum in the plane is found even if rounding has moved `K` beyond the extremum, and no state is returned where
    /// none has that `K`: with large `L`, and at rest, whatever the size of `s`.
    #[test]
    fn k_may_be_beyond_its_extremum_by_its_rounding() {
        let cases = [(1.0, 0.0, 40.0), (1e-3, 3.0, 40.0), (1.0, 0.0, 0.0), (1e-3, 0.0, 0.0), (1.0, 0.4, 0.9)];
        for (strength, along, across) in cases {
            let values = Vector3::new(S.xx, S.yy, S.zz) * strength;
            let tensor = nalgebra::Matrix3::from_diagonal(&values);
            let state = in_plane([0, 1], 0.4, along, across);
            let integrals = first_integrals(&BODY, &tensor, &state);
            let wanted = |third: f64| Wanted::new(&BODY, &FirstIntegrals { clebsch: third, ..integrals }).unwrap();
            // The largest K of the plane, on a fine grid and then by bisection of its slope.
            let here = wanted(0.0).plane(&values, [0, 1]);
            let at = |k: i32| 1e-3 * f64::from(k);
            let real = |b: f64| here.square[0] + here.square[1] * (2.0 * b).cos() - along * along > 1e-6;
            let best =
                (1..3141).map(at).filter(|b| real(*b)).max_by(|a, b| here.miss(*a).total_cmp(&here.miss(*b))).unwrap();
            let (mut left, mut right) = (best - 1e-3, best + 1e-3);
            assert!(here.slope(left) * here.slope(right) < 0.0, "{strength} {along} {across}");
            for _ in 0..60 {
                let middle = 0.5 * (left + right);
                if (here.slope(middle) > 0.0) == (here.slope(left) > 0.0) { left = middle } else { right = middle }
            }
            let top = here.miss(left);
            let pull = BODY.constant_c * BODY.inertia_xx * values.amax();
            let size = (2.0 * BODY.inertia_xx * integrals.energy).abs().max(pull) * values.amax();
            let found = |beyond: f64| {
                let states = wanted(top + beyond * size).in_plane(&values, 2);
                // For images under half turns the angle differs by a half turn.
                states.iter().any(|state| ((state.axis.y.atan2(state.axis.x) - left).sin()).abs() < 1e-4)
            };
            assert!(found(-1e-10) && found(3e-14) && !found(1e-12), "{strength} {along} {across}");
        }
    }
}
