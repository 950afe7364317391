//! States in a principal plane, or with `n` on a principal axis, with given integrals.

use core::f64::consts::PI;

use nalgebra::{Vector2, Vector3};

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

/// Longest step of Newton's method: at an extremum of `K` the step has no limit. Candidates are accurate to more than this.
const LONGEST: f64 = 1e-4;

/// Most steps of Newton's method: from a step of 1e-4 at a double root each halves the distance, until rounding ends it at about 1e-8, after 13.
const STEPS: usize = 30;

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

/// `n` and `L` in a principal plane: `n = (cos b, sin b)`, `L = p n + u (-sin b, cos b)` in the axes `axes`. The states with the integrals are the
/// points `(b, u)` at which both equations below hold; `u` is in units of `unit`.
pub(super) struct Plane {
    axes: [usize; 2],
    along: f64,
    /// `(s_i - s_j) / 2`.
    half: f64,
    /// `L.L = m0 + m1 x`, `x = cos 2b`.
    square: [f64; 2],
    /// `K - K_0 = q(x) - 2 half p u sin 2b`.
    q: [f64; 3],
    /// Rounding of both equations: of `L.L` and of `K`.
    rounding: Vector2<f64>,
    /// An upper limit on `|L|`.
    unit: f64,
}

impl Plane {
    /// `L.L - p^2`, which is `u^2`; where it is below zero by more than its rounding, there is no state of this energy.
    fn square_across(&self, b: f64) -> f64 {
        self.square[0] + self.square[1] * (2.0 * b).cos() - self.along * self.along
    }

    /// The point with this energy at the angle `b`.
    fn at(&self, b: f64) -> Vector2<f64> {
        Vector2::new(b, self.square_across(b).max(0.0).sqrt() / self.unit)
    }

    /// `u^2 - (L.L - p^2)`, if it is more than rounding, and `K - K_0`. Under a weak torque `L.L` hardly depends on `b`, and correcting its rounding
    /// would change `b` by a large angle.
    fn misses(&self, point: Vector2<f64>) -> Vector2<f64> {
        let ((y, x), u) = ((2.0 * point.x).sin_cos(), point.y * self.unit);
        let third = (self.q[2] * x + self.q[1]) * x + self.q[0] - 2.0 * self.half * self.along * u * y;
        let square = u * u - self.square_across(point.x);
        Vector2::new(if square.abs() <= self.rounding.x { 0.0 } else { square }, third)
    }

    /// The gradients of [`misses`](Self::misses).
    fn gradients(&self, point: Vector2<f64>) -> [Vector2<f64>; 2] {
        let ((y, x), u) = ((2.0 * point.x).sin_cos(), point.y * self.unit);
        let pull = 2.0 * self.half * self.along;
        let by_b = -2.0 * (y * (2.0 * self.q[2] * x + self.q[1]) + pull * u * x);
        [Vector2::new(2.0 * self.square[1] * y, 2.0 * u * self.unit), Vector2::new(by_b, -pull * y * self.unit)]
    }

    /// `dK / db` at this energy.
    pub(super) fn slope(&self, b: f64) -> f64 {
        let [square, third] = self.gradients(self.at(b));
        third.x - third.y * square.x / square.y
    }

    /// The state with this energy at the angle `b`.
    pub(super) fn state(&self, b: f64) -> BodyState<f64> {
        self.state_at(self.at(b))
    }

    fn state_at(&self, point: Vector2<f64>) -> BodyState<f64> {
        let ([i, j], p, u) = (self.axes, self.along, point.y * self.unit);
        let (sin, cos) = point.x.sin_cos();
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        (axis[i], axis[j]) = (cos, sin);
        (momentum[i], momentum[j]) = (p * cos - u * sin, p * sin + u * cos);
        equatorial_axis[3 - i - j] = 1.0;
        BodyState { axis, momentum, equatorial_axis }
    }

    /// The larger miss of both equations, in units of its rounding.
    fn remainder(&self, point: Vector2<f64>) -> f64 {
        self.misses(point).component_div(&self.rounding).amax()
    }

    /// The nearest point with this energy, by Newton's method.
    fn on_energy(&self, mut point: Vector2<f64>) -> Vector2<f64> {
        for _ in 0..3 {
            let (miss, gradient) = (self.misses(point).x, self.gradients(point)[0]);
            if miss == 0.0 {
                break;
            }
            point -= gradient * (miss / gradient.norm_squared());
        }
        point
    }

    /// The best point of Newton's method for `K` along the curve of this energy, from the angle `start`. Along the curve there is no pole where `L`
    /// is along `n`, as there is in `b`.
    fn corrected(&self, start: f64) -> Vector2<f64> {
        let mut point = self.at(start);
        let (mut best, mut least) = (point, f64::INFINITY);
        for _ in 0..STEPS {
            point = self.on_energy(point);
            let remainder = self.remainder(point);
            if remainder < least {
                (best, least) = (point, remainder);
            } else if least <= 1.0 {
                break;
            }
            let [square, third] = self.gradients(point);
            let along = Vector2::new(square.y, -square.x).normalize();
            let step = -self.misses(point).y / third.dot(&along);
            point += along * step.clamp(-LONGEST, LONGEST);
            // Not a number, too, ends it.
            let is_near = (point.x - start).abs() < FARTHEST;
            if !is_near {
                break;
            }
        }
        best
    }

    /// Whether two points, up to half turns about the axes, are one to rounding: a point between them has the integrals, too, if put back on the
    /// curve of this energy. It is not that in the middle, which by symmetry may be a third state.
    fn are_one(&self, one: Vector2<f64>, other: Vector2<f64>) -> bool {
        [other, -other].into_iter().any(|image| {
            let turn = PI * ((one.x - image.x) / PI).round();
            let way = image + Vector2::new(turn, 0.0) - one;
            self.remainder(self.on_energy(one + way * 0.4)) <= 1.0
        })
    }

    /// `x` between -1 and 1 where `u^2 >= 0` to its rounding: the rounded energy of a motion may be slightly too small for any state.
    fn range(&self) -> Option<(f64, f64)> {
        let ([m0, m1], square) = (self.square, self.along * self.along - self.rounding.x);
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
        let Some(range) = self.range() else { return Vec::new() };
        // In units of the rounding of K, so that no power of it vanishes.
        let unit = self.rounding.y;
        let ([q0, q1, q2], [m0, m1]) = (self.q.map(|q| q / unit), self.square);
        let f = (2.0 * self.half / unit * self.along).powi(2);
        let (r0, r1) = (f * (m0 - self.along * self.along), f * m1);
        let quartic = [q0 * q0 - r0, 2.0 * q0 * q1 - r1, q1 * q1 + 2.0 * q0 * q2 + r0, 2.0 * q1 * q2 + r1, q2 * q2];
        roots_and_touches(&quartic, range)
    }
}

/// Whether two states are identical or images under half turns about the principal axes, which change the signs of two components of both vectors.
pub(super) fn is_image(one: &BodyState<f64>, other: &BodyState<f64>, unit: f64) -> bool {
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].into_iter().any(|signs| {
        let apart =
            |one: &Vector3<f64>, other: &Vector3<f64>| (other.component_mul(&Vector3::from(signs)) - one).norm();
        apart(&one.axis, &other.axis) < NEAREST && apart(&one.momentum, &other.momentum) < NEAREST * unit
    })
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
        Plane { axes, along, half, square, q, rounding: self.rounding(s), unit: self.unit(s) }
    }

    /// An upper limit on `|L|`, and on the square root of the terms of which `L.L` is computed.
    pub(super) fn unit(&self, s: &Vector3<f64>) -> f64 {
        (self.size + 2.0 * self.constant_c.abs() * self.inertia * s.amax()).sqrt()
    }

    /// Rounding of `L.L` and of `K`.
    fn rounding(&self, s: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(ROUNDING, TOLERANCE * s.amax()) * self.unit(s).powi(2)
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
        let mut points: Vec<Vector2<f64>> = Vec::new();
        for b in plane.candidates().into_iter().flat_map(|x| [0.5, -0.5].map(|side| side * x.acos())) {
            let point = plane.corrected(b);
            if plane.remainder(point) <= 1.0 && !points.iter().any(|other| plane.are_one(*other, point)) {
                points.push(point);
            }
        }
        points.into_iter().map(|point| plane.state_at(point)).collect()
    }

    /// States with `n` on the axis `on`, up to half turns about the axes. If the other two eigenvalues are so close that `K` does not tell the
    /// direction of `L`, two of those that `K` allows.
    pub(super) fn on_axis(&self, s: &Vector3<f64>, on: usize) -> Vec<BodyState<f64>> {
        let (i, j) = ((on + 1) % 3, (on + 2) % 3);
        let Self { constant_c: c, inertia, hamiltonian, along: p, third, .. } = *self;
        let rounding = self.rounding(s);
        let across = 2.0 * inertia * (hamiltonian - c * s[on]) - p * p;
        if across < -rounding.x {
            return Vec::new();
        }
        let across = across.max(0.0);
        let pulled = third - s[on] * p * p + 2.0 * c * inertia * s[i] * s[j];
        // The sum of both squares is L.L - p^2. For equal eigenvalues the quotient is infinite or 0 / 0, and any square will do.
        let square = ((pulled - s[j] * across) / (s[i] - s[j])).max(0.0).min(across);
        let squares = [square, across - square];
        if (s[i] * squares[0] + s[j] * squares[1] - pulled).abs() > rounding.y {
            return Vec::new();
        }
        let (axis, equatorial_axis) = (Vector3::ith(on, 1.0), Vector3::ith(i, 1.0));
        let on_side = |side: f64| {
            let mut momentum = axis * p;
            (momentum[i], momentum[j]) = (squares[0].sqrt(), side * squares[1].sqrt());
            BodyState { axis, momentum, equatorial_axis }
        };
        [1.0, -1.0].map(on_side).into()
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

    /// A plane for tests of some of its numbers.
    const PLANE: Plane = Plane {
        axes: [0, 1],
        along: 0.0,
        half: 0.3,
        square: [4.0, 0.1],
        q: [0.0; 3],
        rounding: Vector2::new(1e-13, 1e-13),
        unit: 2.0,
    };

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
        let exact = |along: f64, square: [f64; 2]| Plane { along, square, rounding: Vector2::zeros(), ..PLANE };
        let range = |along: f64, square: [f64; 2]| exact(along, square).range();
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
        assert_eq!(exact(2.0, [3.5, 1.0]).at(1.2).y, 0.0);
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
                    assert_relative_eq!(plane.rounding.y, TOLERANCE * expected, max_relative = 1e-12);
                    assert_relative_eq!(plane.rounding.x, ROUNDING * expected / s.amax(), max_relative = 1e-12);
                    assert!(plane.remainder(Vector2::new(b, across / plane.unit)) < 1.0);
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
            let found = plane.corrected(0.3 + off);
            assert_relative_eq!(found, Vector2::new(0.3, 1.7 / plane.unit), max_relative = 1e-13);
        }
        for off in [0.02, -0.02] {
            assert!((plane.corrected(0.3 + off).x - 0.3 - off).abs() < FARTHEST);
        }
        // With L.n at the rounding of zero, Newton steps do not reduce the remainder, and end at once.
        for along in [1e-13, 1e-18, 1e-300] {
            let integrals = FirstIntegrals { energy: 1.183_538_461_538_461_4, spin: along / 1.5, clebsch: -0.098_128 };
            let plane = Wanted::new(&body, &integrals).unwrap().plane(&Vector3::new(S.xx, S.yy, S.zz), [2, 0]);
            for start in [0.0, 1e-9, -1e-9, 1e-8] {
                assert!((plane.corrected(start).x - start).abs() < FARTHEST);
            }
        }
    }

    #[test]
    fn images_are_those_by_half_turns() {
        let mut state = in_plane([0, 2], 0.7, 0.9, 1.7);
        (state.axis.y, state.momentum.y) = (0.3, -0.4);
        let size = state.momentum.norm();
        let turned = |state: &BodyState<f64>, signs: [f64; 3]| BodyState {
            axis: state.axis.component_mul(&Vector3::from(signs)),
            momentum: state.momentum.component_mul(&Vector3::from(signs)),
            ..*state
        };
        for signs in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
            let image = turned(&state, signs);
            assert!(is_image(&state, &image, size));
            let moved = |axis: f64, momentum: f64| BodyState {
                axis: image.axis + Vector3::x() * axis,
                momentum: image.momentum + Vector3::x() * momentum,
                ..image
            };
            assert!(is_image(&moved(3e-7, 0.0), &state, size) && !is_image(&moved(3e-6, 0.0), &state, size));
            // In units of |L| = 1.96.
            assert!(is_image(&moved(0.0, 1.7e-6), &state, size) && !is_image(&moved(0.0, 3e-6), &state, size));
            let aside = BodyState { momentum: image.momentum + Vector3::y() * 3e-6, ..image };
            assert!(!is_image(&aside, &state, size));
        }
        // The same lengths of all components, with L on the other side of n.
        let other = BodyState { momentum: state.momentum.component_mul(&Vector3::new(-1.0, 1.0, 1.0)), ..state };
        assert!(!is_image(&state, &other, size));
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
        let plane = Plane { q: [0.18, -0.9, 1.0], ..PLANE };
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
            let third = |b: f64| here.misses(here.at(b)).y;
            let at = |k: i32| 1e-3 * f64::from(k);
            let real = |b: f64| here.square[0] + here.square[1] * (2.0 * b).cos() - along * along > 1e-6;
            let best = (1..3141).map(at).filter(|b| real(*b)).max_by(|a, b| third(*a).total_cmp(&third(*b))).unwrap();
            let (mut left, mut right) = (best - 1e-3, best + 1e-3);
            assert!(here.slope(left) * here.slope(right) < 0.0, "{strength} {along} {across}");
            for _ in 0..60 {
                let middle = 0.5 * (left + right);
                if (here.slope(middle) > 0.0) == (here.slope(left) > 0.0) { left = middle } else { right = middle }
            }
            let top = third(left);
            let found = |beyond: f64| {
                let states = wanted(top + beyond * here.rounding.y).in_plane(&values, 2);
                // For images under half turns the angle differs by a half turn.
                states.iter().any(|state| ((state.axis.y.atan2(state.axis.x) - left).sin()).abs() < 1e-4)
            };
            assert!(found(-1e3) && found(0.9) && !found(1.1), "{strength} {along} {across}");
            // Below the extremum there are two points, which are one as long as K there is the same to rounding.
            for (below, is_one) in [(0.9, true), (1.1, false)] {
                let plane = wanted(top - below * here.rounding.y).plane(&values, [0, 1]);
                let [one, other] = [left - 1e-5, left + 1e-5].map(|b| plane.corrected(b));
                assert!(plane.remainder(one) < 0.5 && plane.remainder(other) < 0.5 && one.x < left && other.x > left);
                for image in [other, -other, other + Vector2::new(PI, 0.0), -other - Vector2::new(PI, 0.0)] {
                    assert_eq!(plane.are_one(one, image), is_one, "{strength} {along} {across} {below}");
                }
            }
        }
    }

    /// `K = K_0` at the angles 0, where it has an extremum, and 0.4 on both sides of it.
    #[test]
    fn states_on_both_sides_of_a_third_are_two() {
        let plane = Plane { q: [0.8_f64.cos(), -1.0 - 0.8_f64.cos(), 1.0], ..PLANE };
        let points = [-0.4, 0.0, 0.4].map(|b| plane.at(b));
        assert!(points.iter().all(|point| plane.remainder(*point) <= 1.0));
        for (i, one) in points.iter().enumerate() {
            for (j, other) in points.iter().enumerate() {
                assert_eq!(plane.are_one(*one, *other), i == j, "{one} {other}");
            }
        }
    }

    /// `n` on an axis and `L` along it: a state even if the energy is too small for one by its rounding, or `K` beside that of one.
    #[test]
    fn a_spin_along_an_axis_is_found_to_rounding() {
        for strength in [1.0, 1e-3] {
            let values = Vector3::new(S.xx, S.yy, S.zz) * strength;
            let state = BodyState { axis: Vector3::z(), momentum: Vector3::z() * 1.7, equatorial_axis: Vector3::x() };
            let integrals = first_integrals(&BODY, &Matrix3::from_diagonal(&values), &state);
            let rounding = Wanted::new(&BODY, &integrals).unwrap().rounding(&values);
            let found = |less: f64, beside: f64| {
                let energy = integrals.energy - less * rounding.x / (2.0 * BODY.inertia_xx);
                let clebsch = integrals.clebsch + beside * rounding.y;
                let wanted = Wanted::new(&BODY, &FirstIntegrals { energy, clebsch, ..integrals }).unwrap();
                !wanted.on_axis(&values, 2).is_empty()
            };
            assert!(found(0.0, 0.0) && found(0.8, 0.0) && found(0.0, 0.8) && found(0.0, -0.8));
            assert!(!found(1.2, 0.0) && !found(0.0, 1.2) && !found(0.0, -1.2));
        }
    }
}
