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

/// What is asked of a state in a principal plane.
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
    for (name, value) in [("energy E", energy), ("spin Omega^z", spin), ("third integral K", clebsch), ("C", constant_c)] {
        Error::unless(value.is_finite(), name, value, "a finite number")?;
    }
    Error::unless(inertia_xx > 0.0 && inertia_zz > 0.0, "moments of inertia", inertia_xx.min(inertia_zz), "above zero")?;
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

impl Wanted {
    /// States with `n` and `L` in the plane normal to the axis `normal`, but for half turns about the axes.
    fn in_plane(&self, s: &Vector3<f64>, normal: usize) -> Vec<BodyState<f64>> {
        let (i, j) = ((normal + 1) % 3, (normal + 2) % 3);
        let (middle, half) = ((s[i] + s[j]) / 2.0, (s[i] - s[j]) / 2.0);
        let Self { constant_c: c, inertia, hamiltonian, along: p, third } = *self;
        // L.L = m0 + m1 x; K - K_0 = q(x) - 2 half p u sin 2b.
        let (m0, m1) = (2.0 * inertia * (hamiltonian - c * middle), -2.0 * inertia * c * half);
        let normal_pull = 2.0 * c * inertia * s[normal];
        let q = [
            middle * m0 - normal_pull * middle - third,
            middle * m1 + half * (2.0 * p * p - m0) + normal_pull * half,
            -half * m1,
        ];
        let off = |x: f64, y: f64, u: f64| (q[2] * x + q[1]) * x + q[0] - 2.0 * half * p * u * y;
        // Where u^2 >= 0.
        let edge = (p * p - m0) / m1;
        let (mut low, mut high) = (-1.0, 1.0);
        if m1 > 0.0 {
            low = edge.max(low);
        } else if m1 < 0.0 {
            high = edge.min(high);
        }
        if low > high || half == 0.0 || (m1 == 0.0 && m0 < p * p) {
            return Vec::new();
        }
        let f = 4.0 * half * half * p * p;
        let (r0, r1) = (f * (m0 - p * p), f * m1);
        let quartic = [
            q[0] * q[0] - r0,
            2.0 * q[0] * q[1] - r1,
            q[1] * q[1] + 2.0 * q[0] * q[2] + r0,
            2.0 * q[1] * q[2] + r1,
            q[2] * q[2],
        ];
        let roots = if p == 0.0 { roots_and_touches(&q, low, high) } else { roots_and_touches(&quartic, low, high) };
        let mut states: Vec<BodyState<f64>> = Vec::new();
        for x in roots {
            for side in [1.0, -1.0] {
                let mut b = 0.5 * x.clamp(-1.0, 1.0).acos() * side;
                let momentum = |b: f64| (m0 + m1 * (2.0 * b).cos() - p * p).max(0.0).sqrt();
                let miss = |b: f64| off((2.0 * b).cos(), (2.0 * b).sin(), momentum(b));
                for _ in 0..CORRECTIONS {
                    let ((y, x), u) = ((2.0 * b).sin_cos(), momentum(b));
                    let slope = -2.0 * y * (2.0 * q[2] * x + q[1]) - 2.0 * half * p * (2.0 * u * x - m1 * y * y / u);
                    let next = b - miss(b) / slope;
                    if !(miss(next).abs() < miss(b).abs()) {
                        break;
                    }
                    b = next;
                }
                let u = momentum(b);
                let (sin, cos) = b.sin_cos();
                let (mut axis, mut l, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
                (axis[i], axis[j]) = (cos, sin);
                (l[i], l[j]) = (p * cos - u * sin, p * sin + u * cos);
                equatorial_axis[normal] = 1.0;
                let allowed = TOLERANCE * (m0.abs() + m1.abs() + c.abs() * inertia) * s.amax();
                let known = |other: &BodyState<f64>| (other.axis - axis).norm() + (other.momentum - l).norm() / l.norm() < 1e-9;
                if miss(b).abs() <= allowed && !states.iter().any(known) {
                    states.push(BodyState { axis, momentum: l, equatorial_axis });
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
