//! States with given first integrals.

use nalgebra::Vector3;

use super::polynomial::roots_and_touches;
use crate::dynamics::first_integrals::FirstIntegrals;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;

/// `K` of a state may be off by this times `L.L (s_max - s_min)`: a double root of the quartic is known to half the digits, and `K` then to all.
const TOLERANCE: f64 = 1e-13;

/// `|C| (s_max - s_min) I^xx / L.L` below which rotation is fast, and `L` goes round an axis.
const LARGEST_STRENGTH: f64 = 0.2;

/// Newton steps from a root of the quartic.
const CORRECTIONS: usize = 4;

/// Every motion with given integrals, by states that it passes through.
#[derive(Debug, Clone, PartialEq)]
pub struct TorusStates {
    /// The principal axis that `L` goes round: the one normal to the only plane without a state. None on the separatrix, for slow rotation
    /// (`|C| (s_max - s_min) I^xx / L.L` of 0.2 and more), and where two eigenvalues are equal and all planes through one axis alike.
    pub round: Option<usize>,
    /// States in the principal frame of `s`: in a principal plane with `e_x` normal to it, or with `n` on an axis. Each motion with
    /// these integrals passes through one of them or an image of one by half turns about the principal axes.
    pub states: Vec<BodyState<f64>>,
}

impl TorusStates {
    /// A state on each of the two components of the level set: `L` goes round the positive and the negative end of the axis [`round`](Self::round).
    /// They are images of one another by a half turn about another axis, with the same frequencies, but for the sense of the slow precession.
    /// None where `L` goes round no axis.
    pub fn components(&self) -> Option<[BodyState<f64>; 2]> {
        let axis = self.round?;
        let state = *self.states.first()?;
        let half_turn = |v: Vector3<f64>| Vector3::from_fn(|i, _| if i == (axis + 1) % 3 { v[i] } else { -v[i] });
        let turned = BodyState {
            axis: half_turn(state.axis),
            momentum: half_turn(state.momentum),
            equatorial_axis: half_turn(state.equatorial_axis),
        };
        Some(if state.momentum[axis] >= 0.0 { [state, turned] } else { [turned, state] })
    }
}

/// What is asked of a state.
struct Wanted {
    constant_c: f64,
    inertia: f64,
    /// `L.L / (2 I^xx) + C n.(s n)`.
    hamiltonian: f64,
    /// `L.n`.
    along: f64,
    third: f64,
}

/// States with the energy `E`, the spin `Omega^z` and the third integral `K`, in the principal frame of `s`.
///
/// Where `n_z` is largest or least on a torus, both `dn_z/dt = e_z.(L x n) / I^xx` and its rate along the flow of `K`, `2 e_z.(s L x n)`, vanish: there `n` and
/// `L` lie in one principal plane, or `n` or `L` is along Z. With Z the axis of the least eigenvalue of `C s`, `n_z'' = -2 C n_z (s_z - n.(s n))` excludes
/// that `L` is along Z at both ends. So a list of the states in the planes, and of those with `n` on that axis, misses no motion. In
/// the plane of the axes `i`, `j`, with `n = (cos b, sin b)` and `L = L.n n + u (-sin b, cos b)`, `H` gives `u^2` as a linear function of `x = cos 2b`, and
/// `K` a quartic equation for `x`.
///
/// # Errors
/// [`Error::Domain`] for what is not finite or positive, isotropic `s` (where `K` says nothing), an energy below that of this spin, and a `K`
/// that no motion of this energy and spin has.
pub fn states_with_integrals(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    integrals: &FirstIntegrals<f64>,
) -> Result<TorusStates, Error> {
    let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = *spheroid;
    let FirstIntegrals { energy, spin, clebsch } = *integrals;
    let values = Vector3::new(s.xx, s.yy, s.zz);
    for (name, value) in
        [("energy E", energy), ("spin Omega^z", spin), ("third integral K", clebsch), ("C", constant_c)]
    {
        Error::unless(value.is_finite(), name, value, "a finite number")?;
    }
    Error::unless(
        inertia_xx > 0.0 && inertia_zz > 0.0,
        "moments of inertia",
        inertia_xx.min(inertia_zz),
        "above zero",
    )?;
    let spread = values.max() - values.min();
    Error::unless(spread > 0.0, "s_max - s_min", spread, "above zero: without it K says no more than E and Omega^z")?;
    let along = inertia_zz * spin;
    let spin_energy = along * spin / 2.0;
    let wanted = Wanted {
        constant_c,
        inertia: inertia_xx,
        hamiltonian: energy - spin_energy + along * along / (2.0 * inertia_xx),
        along,
        third: clebsch,
    };
    let potential = (values * constant_c).min();
    Error::unless(
        energy - spin_energy >= potential,
        "energy E without that of the spin, I^zz Omega^z^2 / 2",
        energy - spin_energy,
        "at least the least eigenvalue of C s: the spin takes more than there is",
    )?;
    let planes = [0, 1, 2].map(|normal| wanted.in_plane(&values, normal));
    let absent = planes.iter().filter(|states| states.is_empty()).count();
    let normal = planes.iter().position(Vec::is_empty).filter(|_| absent == 1);
    let mut states = planes.concat();
    states.extend(wanted.on_axis(&values, (values * constant_c).imin()));
    Error::unless(
        !states.is_empty(),
        "third integral K",
        clebsch,
        "within the range that K has for motions of this energy and spin",
    )?;
    let least = states.iter().map(|state| state.momentum.norm_squared()).fold(f64::INFINITY, f64::min);
    let fast = constant_c.abs() * spread * inertia_xx < LARGEST_STRENGTH * least;
    Ok(TorusStates { round: normal.filter(|_| fast), states })
}

/// `n` and `L` in a principal plane: `n = (cos b, sin b)`, `L = p n + u (-sin b, cos b)` in the axes `axes`.
struct Plane {
    axes: [usize; 2],
    along: f64,
    /// `(s_i - s_j) / 2`.
    half: f64,
    /// `L.L = m0 + m1 x`, `x = cos 2b`.
    square: [f64; 2],
    /// `K - K_0 = q(x) - 2 half p u sin 2b`.
    q: [f64; 3],
}

impl Plane {
    fn momentum_across(&self, b: f64) -> f64 {
        (self.square[0] + self.square[1] * (2.0 * b).cos() - self.along * self.along).max(0.0).sqrt()
    }

    /// `K - K_0`.
    fn miss(&self, b: f64) -> f64 {
        let ((y, x), u) = ((2.0 * b).sin_cos(), self.momentum_across(b));
        (self.q[2] * x + self.q[1]) * x + self.q[0] - 2.0 * self.half * self.along * u * y
    }

    /// `dK / db`.
    fn slope(&self, b: f64) -> f64 {
        let ((y, x), u) = ((2.0 * b).sin_cos(), self.momentum_across(b));
        let turn = 2.0 * u * x - self.square[1] * y * y / u;
        -2.0 * y * (2.0 * self.q[2] * x + self.q[1]) - 2.0 * self.half * self.along * turn
    }

    fn state(&self, b: f64) -> BodyState<f64> {
        let ([i, j], p, u) = (self.axes, self.along, self.momentum_across(b));
        let (sin, cos) = b.sin_cos();
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        (axis[i], axis[j]) = (cos, sin);
        (momentum[i], momentum[j]) = (p * cos - u * sin, p * sin + u * cos);
        equatorial_axis[3 - i - j] = 1.0;
        BodyState { axis, momentum, equatorial_axis }
    }

    /// `x` between -1 and 1 where `u^2 >= 0`.
    fn range(&self) -> Option<(f64, f64)> {
        let ([m0, m1], square) = (self.square, self.along * self.along);
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

    /// Places where `K = K_0` or may touch it.
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

impl Wanted {
    fn plane(&self, s: &Vector3<f64>, axes: [usize; 2]) -> Plane {
        let [si, sj] = axes.map(|i| s[i]);
        let (middle, half) = ((si + sj) / 2.0, (si - sj) / 2.0);
        let Self { constant_c: c, inertia, hamiltonian, along, third } = *self;
        let square @ [m0, m1] = [2.0 * inertia * (hamiltonian - c * middle), -2.0 * inertia * c * half];
        let normal_pull = 2.0 * c * inertia * s[3 - axes[0] - axes[1]];
        let q = [
            middle * m0 - normal_pull * middle - third,
            middle * m1 + half * (2.0 * along * along - m0) + normal_pull * half,
            -half * m1,
        ];
        Plane { axes, along, half, square, q }
    }

    /// States with `n` and `L` in the plane normal to the axis `normal`, but for half turns about the axes.
    fn in_plane(&self, s: &Vector3<f64>, normal: usize) -> Vec<BodyState<f64>> {
        let plane = self.plane(s, [(normal + 1) % 3, (normal + 2) % 3]);
        let size = plane.square[0].abs() + plane.square[1].abs() + self.constant_c.abs() * self.inertia;
        let allowed = TOLERANCE * size * s.amax();
        let mut states: Vec<BodyState<f64>> = Vec::new();
        for x in plane.candidates() {
            for side in [1.0, -1.0] {
                let mut b = 0.5 * x.clamp(-1.0, 1.0).acos() * side;
                for _ in 0..CORRECTIONS {
                    let next = b - plane.miss(b) / plane.slope(b);
                    // Not a number on the edge, where the slope has a pole.
                    if plane.miss(next).abs() >= plane.miss(b).abs() || next.is_nan() {
                        break;
                    }
                    b = next;
                }
                let state = plane.state(b);
                let size = state.momentum.norm();
                let known = |other: &BodyState<f64>| {
                    (other.axis - state.axis).norm() + (other.momentum - state.momentum).norm() / size < 1e-9
                };
                if plane.miss(b).abs() <= allowed && !states.iter().any(known) {
                    states.push(state);
                }
            }
        }
        states
    }

    /// The state with `n` on the axis `on`, but for half turns about the axes.
    fn on_axis(&self, s: &Vector3<f64>, on: usize) -> Option<BodyState<f64>> {
        let (i, j) = ((on + 1) % 3, (on + 2) % 3);
        let Self { constant_c: c, inertia, hamiltonian, along: p, third } = *self;
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

/// The unstable periodic motion of given energy and spin, in which `L` swings about the middle principal axis of `s`: a state in which `n` and `L`
/// lie in the plane of the axes of the largest and the middle eigenvalue, where its `K` is an extremum. That is the `K` of the separatrix.
///
/// A spin along the axis itself, `L = L.n n`, is another one, with `E` fixed by the spin.
///
/// # Errors
/// [`Error::Domain`] for what is not finite or positive, two equal eigenvalues, and an energy at which no extremum of `K` lies near: `n` must turn
/// about `L`, and fast against the torque.
pub fn separatrix_motion(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    energy: f64,
    spin: f64,
) -> Result<BodyState<f64>, Error> {
    let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = *spheroid;
    let values = Vector3::new(s.xx, s.yy, s.zz);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    let gap = (values[order[0]] - values[order[1]]).min(values[order[1]] - values[order[2]]);
    Error::unless(
        gap > 0.0,
        "least difference of two eigenvalues of s",
        gap,
        "above zero: else there is no separatrix",
    )?;
    Error::unless(
        inertia_xx > 0.0 && inertia_zz > 0.0,
        "moments of inertia",
        inertia_xx.min(inertia_zz),
        "above zero",
    )?;
    let along = inertia_zz * spin;
    let hamiltonian = energy - along * spin / 2.0 + along * along / (2.0 * inertia_xx);
    let wanted = Wanted { constant_c, inertia: inertia_xx, hamiltonian, along, third: 0.0 };
    let plane = wanted.plane(&values, [order[0], order[1]]);
    // L is near the second axis of the plane.
    let start = along.atan2((2.0 * inertia_xx * hamiltonian - along * along).max(0.0).sqrt());
    let size = (2.0 * inertia_xx * hamiltonian).sqrt();
    let reach = 0.1_f64.min(4.0 * constant_c.abs() * (values.max() - values.min()) * inertia_xx / (size * size));
    let (mut left, mut right) = (start - reach, start + reach);
    let (sign, end) = (plane.slope(left), plane.slope(right));
    Error::unless(
        sign * end < 0.0,
        "slope of K along the plane of the largest and the middle eigenvalue, product at both ends",
        sign * end,
        "below zero: n turns fast about an L near the middle axis",
    )?;
    for _ in 0..80 {
        let middle = 0.5 * (left + right);
        if plane.slope(middle) * sign > 0.0 { left = middle } else { right = middle }
    }
    Ok(plane.state(0.5 * (left + right)))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::first_integrals::first_integrals;

    const BODY: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
    const PROLATE: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: -0.8 };
    const S: PrincipalCoefficients<f64> = PrincipalCoefficients { xx: 0.21, yy: -0.04, zz: 0.09 };

    fn wanted(body: &RigidSpheroid<f64>, integrals: &FirstIntegrals<f64>) -> Wanted {
        let FirstIntegrals { energy, spin, clebsch } = *integrals;
        let along = body.inertia_zz * spin;
        Wanted {
            constant_c: body.constant_c,
            inertia: body.inertia_xx,
            hamiltonian: energy - along * spin / 2.0 + along * along / (2.0 * body.inertia_xx),
            along,
            third: clebsch,
        }
    }

    /// In a plane, `n` at the angle `b`, and what crosses it.
    fn in_plane(axes: [usize; 2], b: f64, along: f64, across: f64) -> BodyState<f64> {
        let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let (sin, cos) = b.sin_cos();
        (axis[axes[0]], axis[axes[1]]) = (cos, sin);
        (momentum[axes[0]], momentum[axes[1]]) = (along * cos - across * sin, along * sin + across * cos);
        equatorial_axis[3 - axes[0] - axes[1]] = 1.0;
        BodyState { axis, momentum, equatorial_axis }
    }

    #[test]
    fn a_plane_has_the_integrals_of_its_states() {
        let values = Vector3::new(S.xx, S.yy, S.zz);
        for body in [BODY, PROLATE] {
            for axes in [[0, 1], [1, 2], [2, 0]] {
                for b in [0.3, 1.2, -0.7, 2.9] {
                    for along in [0.9, -0.4, 0.0] {
                        let state = in_plane(axes, b, along, 1.7);
                        let integrals = first_integrals(&body, &S.tensor(), &state);
                        let plane = wanted(&body, &integrals).plane(&values, axes);
                        assert_relative_eq!(plane.momentum_across(b), 1.7, max_relative = 1e-14);
                        assert!(plane.miss(b).abs() < 1e-15, "{axes:?} {b} {along}: {}", plane.miss(b));
                        let found = plane.state(b);
                        assert_relative_eq!(found.axis, state.axis, epsilon = 1e-15);
                        assert_relative_eq!(found.momentum, state.momentum, epsilon = 1e-14);
                        let h = 1e-5;
                        let slope = (plane.miss(b + h) - plane.miss(b - h)) / (2.0 * h);
                        assert_relative_eq!(plane.slope(b), slope, epsilon = 1e-9);
                        // Without any correction.
                        let x = (2.0 * b).cos();
                        let candidates = plane.candidates();
                        let nearest = candidates.iter().fold(f64::INFINITY, |least, c| least.min((c - x).abs()));
                        assert!(nearest < 1e-6, "{axes:?} {b} {along}: {x} {candidates:?}");
                        // At another K it is the distance from that.
                        let other = FirstIntegrals { clebsch: integrals.clebsch - 0.25, ..integrals };
                        assert_relative_eq!(
                            wanted(&body, &other).plane(&values, axes).miss(b),
                            0.25,
                            max_relative = 1e-13
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_range_is_where_the_momentum_is_real() {
        let range =
            |along: f64, square: [f64; 2]| Plane { axes: [0, 1], along, half: 0.1, square, q: [0.0; 3] }.range();
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
        let square = Plane { axes: [0, 1], along: 2.0, half: 0.1, square: [3.5, 1.0], q: [0.0; 3] };
        assert_eq!(square.momentum_across(1.2), 0.0);
    }

    #[test]
    fn every_state_has_the_integrals_and_none_is_twice() {
        for body in [BODY, PROLATE] {
            for (k, direction) in [[0.3, 0.5, 1.9], [1.7, -0.6, 0.4], [-0.5, 1.8, 0.3]].into_iter().enumerate() {
                let axis = Vector3::new(0.6, 0.0, 0.8);
                let start = BodyState { axis, momentum: Vector3::from(direction), equatorial_axis: Vector3::y() };
                let integrals = first_integrals(&body, &S.tensor(), &start);
                let found = states_with_integrals(&body, &S, &integrals).unwrap();
                assert!(found.states.len() >= 2, "{k}");
                for (i, state) in found.states.iter().enumerate() {
                    let same = first_integrals(&body, &S.tensor(), state);
                    assert_relative_eq!(same.energy, integrals.energy, max_relative = 1e-14);
                    assert_relative_eq!(same.spin, integrals.spin, epsilon = 1e-14);
                    assert_relative_eq!(same.clebsch, integrals.clebsch, max_relative = 1e-12);
                    assert_relative_eq!(state.equatorial_axis.dot(&state.axis), 0.0, epsilon = 1e-15);
                    for other in &found.states[i + 1..] {
                        let apart = (other.axis - state.axis).norm() + (other.momentum - state.momentum).norm();
                        assert!(apart > 1e-6, "{k}: {state:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn an_energy_below_the_potential_is_refused() {
        for body in [BODY, PROLATE] {
            let least = (Vector3::new(S.xx, S.yy, S.zz) * body.constant_c).min();
            let spin = 0.7;
            let spin_energy = body.inertia_zz * spin * spin / 2.0;
            let quantity = |energy: f64| {
                let integrals = FirstIntegrals { energy: spin_energy + energy, spin, clebsch: 0.0 };
                match states_with_integrals(&body, &S, &integrals) {
                    Err(Error::Domain { quantity, value, .. }) => (quantity, value),
                    other => panic!("{other:?}"),
                }
            };
            let (below, value) = quantity(least - 1e-9);
            assert!(below.contains("without that of the spin"), "{below}");
            assert_relative_eq!(value, least - 1e-9, max_relative = 1e-9);
            assert!(quantity(least + 1e-9).0.contains("third integral"));
        }
        for (inertia_xx, inertia_zz, value) in [(0.0, 1.0, 0.0), (1.0, -2.0, -2.0), (-1.0, 3.0, -1.0)] {
            let body = RigidSpheroid { inertia_xx, inertia_zz, constant_c: 1.0 };
            let integrals = FirstIntegrals { energy: 1.0, spin: 0.1, clebsch: 0.0 };
            for refused in [
                states_with_integrals(&body, &S, &integrals).map(|_| ()),
                separatrix_motion(&body, &S, 1.0, 0.1).map(|_| ()),
            ] {
                assert_eq!(
                    refused,
                    Err(Error::Domain { quantity: "moments of inertia", value, allowed: "above zero" })
                );
            }
        }
    }

    /// Where `K` is largest or least in the plane, whatever the size of the torque.
    #[test]
    fn the_separatrix_is_an_extremum() {
        for body in [BODY, PROLATE] {
            for strength in [1.0, 1e-3, 1e-6] {
                let s = S.scaled(strength);
                for (energy, spin) in [(2.0, 0.3), (5.0, -0.9), (1.0, 0.0), (40.0, 1.1)] {
                    let state = separatrix_motion(&body, &s, energy, spin).unwrap();
                    let integrals = first_integrals(&body, &s.tensor(), &state);
                    assert_relative_eq!(integrals.energy, energy, max_relative = 1e-14);
                    assert_relative_eq!(integrals.spin, spin, epsilon = 1e-15);
                    // In the plane of X and Z, L near Z.
                    assert_eq!((state.axis.y, state.momentum.y), (0.0, 0.0));
                    let off = (state.momentum.x / state.momentum.norm()).abs();
                    assert!(off < 2.0 * strength, "{strength} {energy} {spin}: {off}");
                    let plane = wanted(&body, &integrals).plane(&Vector3::new(s.xx, s.yy, s.zz), [0, 2]);
                    let b = state.axis.z.atan2(state.axis.x);
                    let scale = strength * integrals.energy;
                    assert!(plane.slope(b).abs() < 1e-13 * scale, "{:e}", plane.slope(b) / scale);
                }
            }
        }
        for eigenvalues in [[0.1, 0.1, -0.2], [0.2, -0.1, -0.1], [0.0, 0.0, 0.0]] {
            let refused = separatrix_motion(&BODY, &PrincipalCoefficients::new(eigenvalues), 2.0, 0.3);
            assert!(matches!(refused, Err(Error::Domain { value: 0.0, .. })), "{refused:?}");
        }
    }
}
