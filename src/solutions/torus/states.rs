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
