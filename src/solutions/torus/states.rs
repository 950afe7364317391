//! States with given first integrals.

use nalgebra::Vector3;

use super::plane::{ROUNDING, Wanted, is_image};
use crate::dynamics::first_integrals::FirstIntegrals;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;

/// `|C| (s_max - s_min) I^xx / L.L` below which rotation is fast, and `L` circles an axis.
const LARGEST_STRENGTH: f64 = 0.2;

/// All motions with given integrals, represented by states on their tori.
#[derive(Debug, Clone, PartialEq)]
pub struct TorusStates {
    /// Index of the principal axis that `L` circles: the axis normal to the only plane without a state. `None` on the separatrix, for slow
    /// rotation (`|C| (s_max - s_min) I^xx / L.L` of 0.2 and more), and for `L` in the plane of two equal eigenvalues.
    pub round: Option<usize>,
    /// States in the principal frame of `s`: in a principal plane with `e_x` normal to it, or with `n` on an axis. The torus of each motion with
    /// these integrals contains one of them, or the image of one under half turns about the principal axes, and under rotations about the third
    /// axis if two eigenvalues are equal. The motion itself need not pass through it.
    pub states: Vec<BodyState<f64>>,
}

impl TorusStates {
    /// A state on each of the two components of the level set: `L` circles the positive and the negative end of the axis [`round`](Self::round).
    /// They are images of one another under a half turn about another axis, with the same frequencies, except for the sense of the slow precession.
    /// `None` if `L` does not circle an axis.
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

/// States with the energy `E`, the spin `Omega^z` and the third integral `K`, in the principal frame of `s`.
///
/// Where `n_z` is largest or smallest on a torus, both `dn_z/dt = e_z.(L x n) / I^xx` and its rate along the flow of `K`, `2 e_z.(s L x n)`, vanish.
/// There `n` and `L` lie in one principal plane, or `n` or `L` is along Z. With Z the axis of the smallest eigenvalue of `C s`,
/// `n_z'' = -2 C n_z (s_z - n.(s n)) / I^xx` excludes that `L` is along Z at both ends. So a list of the states in the planes, and of those with
/// `n` on that axis, misses no motion. In the plane of the axes `i`, `j`, with `n = (cos b, sin b)` and `L = L.n n + u (-sin b, cos b)`, `H` gives
/// `u^2` as a linear function of `x = cos 2b`, and `K` gives a quartic equation for `x`.
///
/// # Errors
/// [`Error::Domain`] for values that are not finite or positive, `C = 0` and isotropic `s` (where `K` gives no condition), an energy below that of
/// this spin and the least eigenvalue of `C s`, and a `K` that no motion of this energy and spin has.
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
        Error::ensure(value.is_finite(), name, value, "a finite number")?;
    }
    Error::ensure(constant_c != 0.0, "C", constant_c, "other than zero; without a torque L does not move")?;
    let wanted = Wanted::new(spheroid, integrals)?;
    let spread = values.max() - values.min();
    Error::ensure(spread > 0.0, "s_max - s_min", spread, "above zero; otherwise K adds nothing to E and Omega^z")?;
    let spin_energy = inertia_zz * spin * spin / 2.0;
    let pull = values * constant_c;
    // `n` and `L` along the axis of the least potential have this energy up to rounding.
    let rounding = ROUNDING * (energy.abs() + spin_energy + pull.amax());
    Error::ensure(
        energy - spin_energy >= pull.min() - rounding,
        "energy E without that of the spin, I^zz Omega^z^2 / 2",
        energy - spin_energy,
        "at least the least eigenvalue of C s; the energy of the spin is too large for this E",
    )?;
    let planes = [0, 1, 2].map(|normal| wanted.in_plane(&values, normal));
    let absent = planes.iter().filter(|states| states.is_empty()).count();
    let normal = planes.iter().position(Vec::is_empty).filter(|_| absent == 1);
    let mut states = planes.concat();
    let unit = wanted.unit(&values);
    for state in wanted.on_axis(&values, pull.imin()) {
        if !states.iter().any(|other| is_image(other, &state, unit)) {
            states.push(state);
        }
    }
    Error::ensure(
        !states.is_empty(),
        "third integral K",
        clebsch,
        "within the range that K has for motions of this energy and spin",
    )?;
    let least = states.iter().map(|state| state.momentum.norm_squared()).fold(f64::INFINITY, f64::min);
    let fast = constant_c.abs() * spread * inertia_xx < LARGEST_STRENGTH * least;
    Ok(TorusStates { round: normal.filter(|_| fast), states })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::super::plane::tests::{BODY, PROLATE, S};
    use super::super::separatrix_motion;
    use super::*;
    use crate::dynamics::first_integrals::first_integrals;

    const NEEDLE: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1e-3, constant_c: 1.0 };

    #[test]
    fn an_energy_below_the_potential_is_refused() {
        for body in [BODY, PROLATE] {
            let pull = Vector3::new(S.xx, S.yy, S.zz) * body.constant_c;
            for spin in [0.0, 0.7, 40.0] {
                let spin_energy = body.inertia_zz * spin * spin / 2.0;
                let quantity = |energy: f64| {
                    let integrals = FirstIntegrals { energy, spin, clebsch: 0.0 };
                    match states_with_integrals(&body, &S, &integrals) {
                        Err(Error::Domain { quantity, value, .. }) => (quantity, value),
                        other => panic!("{other:?}"),
                    }
                };
                let least = spin_energy + pull.min();
                let (below, value) = quantity(least - 1e-9);
                assert!(below.contains("without that of the spin"), "{below}");
                assert_relative_eq!(value, least - 1e-9 - spin_energy, max_relative = 1e-9);
                // The rounding of the energy is that of its terms.
                let rounding = 4.0 * f64::EPSILON * (least.abs() + spin_energy + pull.amax());
                assert!(quantity(least - 1.4 * rounding).0.contains("without that of the spin"), "{spin}");
                assert!(quantity(least - 0.7 * rounding).0.contains("third integral"), "{spin}");
            }
        }
        let integrals = FirstIntegrals { energy: 1.0, spin: 0.1, clebsch: 0.0 };
        let refused = states_with_integrals(&RigidSpheroid { constant_c: 0.0, ..BODY }, &S, &integrals);
        assert!(matches!(refused, Err(Error::Domain { quantity: "C", value: 0.0, .. })), "{refused:?}");
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

    /// The axis that `L` circles is reported if rotation is fast compared with the effect of the torque, whatever the sign
    /// of `C`.
    #[test]
    fn an_axis_is_told_of_fast_rotation_only() {
        for body in [BODY, PROLATE] {
            let (mut told, mut untold) = (0, 0);
            for direction in [[0.3, 0.5, 1.9], [1.7, -0.6, 0.4]] {
                for i in 0..60 {
                    let momentum = Vector3::from(direction).normalize() * (0.7 + 0.02 * f64::from(i));
                    let axis = Vector3::new(0.6, 0.0, 0.8);
                    let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
                    let integrals = first_integrals(&body, &S.tensor(), &start);
                    let found = states_with_integrals(&body, &S, &integrals).unwrap();
                    let least = found.states.iter().map(|state| state.momentum.norm_squared()).fold(9.0, f64::min);
                    let strength = 0.8 * 0.25 * body.inertia_xx / least;
                    // One plane has no state, and the others have some; planes are labelled by the axes normal to them.
                    let absent: Vec<usize> = (0..3)
                        .filter(|&normal| {
                            found.states.iter().all(|s| s.axis[normal] != 0.0 || s.momentum[normal] != 0.0)
                        })
                        .collect();
                    let expected = (absent.len() == 1 && strength < 0.2).then(|| absent[0]);
                    assert_eq!(found.round, expected, "{direction:?} {i}: {strength} {absent:?}");
                    told += usize::from(expected.is_some());
                    untold += usize::from(absent.len() == 1 && expected.is_none());
                }
            }
            assert!(told > 10 && untold > 10, "{told} {untold}");
        }
    }

    /// With `C` of either sign `n` may be along the axis of the smallest eigenvalue of `C s`: states there, with the integrals.
    #[test]
    fn states_with_the_axis_of_the_body_on_that_of_least_energy_are_found() {
        for (body, on) in [(BODY, 1), (PROLATE, 0)] {
            let mut axis = Vector3::zeros();
            axis[on] = 1.0;
            let mut equatorial_axis = Vector3::zeros();
            equatorial_axis[(on + 1) % 3] = 1.0;
            let momentum = Vector3::new(0.9, 0.7, -0.8);
            let start = BodyState { axis, momentum, equatorial_axis };
            let integrals = first_integrals(&body, &S.tensor(), &start);
            let found = states_with_integrals(&body, &S, &integrals).unwrap();
            // Its mirror image is another state: half turns do not change the sign of the product of both components of L across n.
            for side in [1.0, -1.0] {
                let same = found.states.iter().filter(|state| {
                    let [given, found] = [momentum, state.momentum].map(|l| l[(on + 1) % 3] * l[(on + 2) % 3]);
                    (state.axis - axis).norm() < 1e-9
                        && (state.momentum.abs() - momentum.abs()).norm() < 1e-9
                        && (found - side * given).abs() < 1e-9
                });
                assert_eq!(same.count(), 1, "{found:?}");
            }
            for state in &found.states {
                assert_relative_eq!(state.equatorial_axis.sum(), 1.0, max_relative = 1e-15);
            }
        }
    }

    /// Two states near an extremum of `K` are distinct as long as they differ, and the extremum itself is a single state.
    #[test]
    fn a_double_root_is_one_state() {
        for body in [BODY, PROLATE] {
            let unstable = separatrix_motion(&body, &S, 2.0, 0.3).unwrap();
            let at = first_integrals(&body, &S.tensor(), &unstable);
            // Up to half turns about the axes.
            let off = |s: &BodyState<f64>| {
                (s.axis.abs() - unstable.axis.abs()).norm() + (s.momentum.abs() - unstable.momentum.abs()).norm()
            };
            let beside =
                |found: &TorusStates| found.states.iter().filter(|s| off(s) < 1e-2).copied().collect::<Vec<_>>();
            let one = beside(&states_with_integrals(&body, &S, &at).unwrap());
            assert_eq!(one.len(), 1, "{one:?}");
            // On the side on which there are states.
            let sides = [1e-9, -1e-9].map(|off| {
                let integrals = FirstIntegrals { clebsch: at.clebsch + off, ..at };
                beside(&states_with_integrals(&body, &S, &integrals).unwrap())
            });
            let two = if sides[0].is_empty() { &sides[1] } else { &sides[0] };
            assert_eq!(two.len(), 2, "{sides:?}");
            let apart = (two[0].axis - two[1].axis).norm().min((two[0].axis + two[1].axis).norm());
            assert!((1e-5..7e-4).contains(&apart), "{apart:e}");
        }
    }

    /// A state with `n` on an axis and `L` in a principal plane is found both in the plane and on the axis, on whichever side rounding puts the
    /// third component.
    #[test]
    fn a_state_on_an_axis_and_in_a_plane_is_one() {
        for momentum in [[0.0, 0.7, 0.9], [0.9, 0.7, 0.0], [1.0, 0.7, 0.0]] {
            let start = BodyState { axis: Vector3::y(), momentum: momentum.into(), equatorial_axis: Vector3::x() };
            let integrals = first_integrals(&BODY, &S.tensor(), &start);
            let found = states_with_integrals(&BODY, &S, &integrals).unwrap();
            let on_axis = found.states.iter().filter(|state| state.axis.y.abs() > 1.0 - 1e-9);
            assert_eq!(on_axis.count(), 1, "{momentum:?}: {found:?}");
        }
    }

    /// Coefficients of any size: the states are those of the tensor in its own unit, for a correspondingly slower rotation.
    #[test]
    fn tiny_coefficients_have_as_many_states() {
        let s = |scale: f64| PrincipalCoefficients { xx: 0.21 * scale, yy: -0.04 * scale, zz: 0.09 * scale };
        for direction in [[0.3, 0.5, 1.9], [1.7, -0.6, 0.4], [-0.5, 1.8, 0.3]] {
            let axis = Vector3::new(0.6, 0.0, 0.8);
            let start = BodyState { axis, momentum: Vector3::from(direction), equatorial_axis: Vector3::y() };
            let count = |s: &PrincipalCoefficients<f64>| {
                let found = states_with_integrals(&BODY, s, &first_integrals(&BODY, &s.tensor(), &start)).unwrap();
                (found.states.len(), found.round)
            };
            assert_eq!(count(&s(1e-82)), count(&s(1e-8)), "{direction:?}");
            assert_eq!(count(&s(1e-200)), count(&s(1e-8)), "{direction:?}");
        }
    }

    /// The states of the integrals of any motion: there are some, all finite, with these integrals.
    fn assert_found(body: &RigidSpheroid<f64>, s: [f64; 3], axis: [f64; 3], momentum: [f64; 3]) -> TorusStates {
        let s = PrincipalCoefficients::new(s);
        let axis = Vector3::from(axis).normalize();
        let start = BodyState { axis, momentum: momentum.into(), equatorial_axis: Vector3::x() };
        let integrals = first_integrals(body, &s.tensor(), &start);
        let found =
            states_with_integrals(body, &s, &integrals).unwrap_or_else(|e| panic!("{body:?} {s:?} {start:?}: {e}"));
        let strength = Vector3::new(s.xx, s.yy, s.zz).amax();
        let pull = body.constant_c.abs() * strength;
        let energies = integrals.energy.abs() + body.inertia_zz * integrals.spin.powi(2) + pull;
        for state in &found.states {
            let here = first_integrals(body, &s.tensor(), state);
            let (energy, third) = (here.energy - integrals.energy, here.clebsch - integrals.clebsch);
            assert!(energy.abs() < 1e-14 * energies, "{energy:e} of {energies:e}: {body:?} {s:?} {start:?} {state:?}");
            let size = 2.0 * body.inertia_xx * energies * strength;
            assert!(third.abs() < 2e-13 * size, "{third:e} of {size:e}: {body:?} {s:?} {start:?} {state:?}");
        }
        found
    }

    /// Slow and fast rotation, strong and weak torques, `n` and `L` anywhere, along axes, along one another, and nearly so, also with two equal
    /// eigenvalues, and with two that are neighbours.
    #[test]
    fn any_motion_has_states() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for (k, body) in (0..3000).flat_map(|k| [BODY, PROLATE, NEEDLE].map(|body| (k, body))) {
            let mut between = |low: f64, high: f64| random.random_range(low..high);
            let size = 10f64.powf(between(-2.0, 2.5));
            let mut s = [(); 3].map(|()| between(-1.0, 1.0));
            match k % 10 {
                0 => s[1] = s[0],
                1 => s[0] = s[2],
                2 => s[2] = s[1] * (1.0 + 1e-15),
                _ => (),
            }
            let strength = 10f64.powf(between(-10.0, 0.0));
            let mut vector = |small: f64| {
                Vector3::from_fn(|_, _| {
                    let size =
                        if between(0.0, 1.0) < 0.7 { 1.0 } else { [0.0, small][usize::from(between(0.0, 1.0) < 0.5)] };
                    size * between(-1.0, 1.0)
                })
            };
            let axis = (vector(1e-9) + Vector3::ith(k % 3, 1e-3)).normalize();
            let momentum = match k % 7 {
                0 => axis,
                1 | 2 => axis + vector(1e-7).cross(&axis) * 10f64.powf(between(-12.0, 0.0)),
                _ => vector(1e-7),
            };
            assert_found(&body, s.map(|x| x * strength), axis.into(), (momentum * size).into());
        }
    }

    /// Small swings of `n` about the axis of the least energy, with two equal or nearly equal eigenvalues: at most four states for each plane, as
    /// the quartic has roots.
    #[test]
    fn swings_have_few_states() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        for k in 0..4000 {
            let mut between = |low: f64, high: f64| random.random_range(low..high);
            let amplitude = 10f64.powf(between(-4.0, -0.5));
            let gap = [0.0, 1e-12, 1e-9, 1e-6, 1e-4][k % 5];
            let mut small = || between(-1.0, 1.0) * amplitude;
            let (axis, momentum) = ([small(), small(), 1.0], [small(), small(), 0.0]);
            let found = assert_found(&BODY, [0.1, 0.1 * (1.0 + gap), -0.2], axis, momentum);
            assert!(found.states.len() <= 12, "{axis:?} {momentum:?} {found:?}");
        }
    }

    /// A state in a principal plane, or its image under half turns, is in the list, at rest as well.
    #[test]
    fn a_state_in_a_plane_is_found_again() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        for k in 0..3000 {
            let mut between = |low: f64, high: f64| random.random_range(low..high);
            let s = [(); 3].map(|()| between(-1.0, 1.0)).map(|x| x * 10f64.powi(-(k % 4)));
            let b = between(-3.0, 3.0);
            let size = if k % 10 == 0 { 0.0 } else { 10f64.powf(between(-1.0, 2.0)) };
            let direction = between(-3.0, 3.0);
            let normal = k as usize % 3;
            let placed = |x: f64, y: f64| {
                let mut v = [0.0; 3];
                (v[(normal + 1) % 3], v[(normal + 2) % 3]) = (x, y);
                v
            };
            let (axis, momentum) = (placed(b.cos(), b.sin()), placed(size * direction.cos(), size * direction.sin()));
            let found = assert_found(&BODY, s, axis, momentum);
            let start = BodyState { axis: axis.into(), momentum: momentum.into(), equatorial_axis: Vector3::x() };
            let is_start = |state: &BodyState<f64>| is_image(state, &start, size + 1.0);
            assert!(found.states.iter().any(is_start), "{s:?} {axis:?} {momentum:?}: {found:?}");
            assert!(found.states.len() <= 12, "{s:?} {axis:?} {momentum:?}: {found:?}");
        }
    }

    /// Some of those that are rarest in random motions: double roots whose place the quartic does not tell, slow rotation with `L` nearly along `n`, and
    /// `L` along `n` under a torque so weak that the rounding of `L.L` is worth a large angle.
    #[test]
    fn rare_motions_have_states() {
        for (body, s, axis, momentum) in [
            (
                PROLATE,
                [-6.295e-8, -7.784e-8, 9.621e-8],
                [-0.828_67, -0.559_71, 0.004_167],
                [-1.716e-6, -9.258e-7, 6.091],
            ),
            (PROLATE, [7.957e-11, -1.796e-11, -1.796e-11], [0.002_64, 0.0, 0.999_996_5], [-2.376, 7.455e-8, -7.657e-7]),
            (BODY, [0.1, 0.1, -0.2], [0.001, 0.001, 1.0], [0.001, 0.002, 0.0]),
            (BODY, [0.1, 0.1, -0.2], [0.002, 0.003, 1.0], [0.004, -0.003, 0.0]),
            (
                BODY,
                [-1.741_701_961_288_880_5e-9, -1.291_860_649_069_871_5e-10, -1.291_854_239_685_691_2e-10],
                [-0.999_999_965_248_582_3, 0.0, 0.000_263_633_901_854_422],
                [8.552_182_188_934_894e-10, 0.0, 1.506_388_695_363_153e-8],
            ),
            (NEEDLE, [0.536_87, 0.079_69, -0.395_62], [0.999_908_1, 0.013_556_9, 0.0], [0.010_565_2, 0.000_228_9, 0.0]),
            (
                NEEDLE,
                [-1.402_773_989_174_843_8e-9, 1.121_385_168_399_594_5e-9, 1.121_385_168_399_596e-9],
                [0.813_847_966_843_925_5, -0.005_935_122_145_856_603, -0.581_047_555_015_183_6],
                [3.609_524_439_881_434_3, -0.026_323_059_480_296_413, -2.577_023_517_910_766_3],
            ),
        ] {
            assert_found(&body, s, axis, momentum);
        }
    }

    /// With two equal eigenvalues `L` circles the third axis, unless it stays in their plane; with `n` on the third axis as well.
    #[test]
    fn with_two_equal_eigenvalues_the_third_axis_is_told() {
        for body in [BODY, PROLATE] {
            for (third, turn) in [(2, [0, 1, 2]), (0, [2, 0, 1]), (1, [1, 2, 0])] {
                let placed = |v: [f64; 3]| turn.map(|i| v[i]);
                let s = placed([0.1, 0.1, -0.2]);
                for (axis, height, round) in [
                    ([0.6, 0.8, 0.0], 0.5, Some(third)),
                    ([0.6, 0.0, 0.8], 2.0, Some(third)),
                    ([0.0, 0.0, 1.0], 0.7, Some(third)),
                    ([0.6, 0.8, 0.0], 0.0, None),
                    ([0.0, 0.6, 0.8], 0.0, None),
                ] {
                    let found = assert_found(&body, s, placed(axis), placed([1.0, -2.0, height]));
                    assert_eq!(found.round, round, "{body:?} {axis:?} {height}");
                }
            }
        }
    }
}
