//! Exact frequencies of a motion, from the periods of its torus.

use core::f64::consts::TAU;

use nalgebra::Matrix2;

use super::found::{ROUNDING, Torus};
use crate::dynamics::Problem;
use crate::error::Error;
use crate::solutions::averaged::{AveragedRates, AveragedSolution, AveragingOrder};

/// Difference from the rates of the averaged motion, in slow ones, up to which it names the others.
const CLEAREST: f64 = 0.2;

/// Exact frequencies of a motion (rad per unit of time), named as in [`AveragedRates`](crate::solutions::averaged::AveragedRates).
///
/// Where `L` goes round the positive end of Z: in twofold precession `alpha' = about_momentum`, `gamma' = about_axis`; in single precession
/// `alpha' = slow`, `gamma' = about_momentum + about_axis - slow`; the nutation, `n` about `L` from the plane of `L` and Z, is `about_momentum - slow`. (With
/// `n` nearer to Z than `L`'s circle is wide, or about other axes, other whole sums.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorusFrequencies {
    /// The principal axis that `L` goes round.
    pub axis: usize,
    /// Mean rate of the azimuth of `L`, averaged over the fast rotation, about the positive end of that axis.
    pub slow: f64,
    /// Of the body about `L`. None where the averaged motion is not near enough to tell it from its sums with the slow one, as close to the
    /// separatrix.
    pub about_momentum: Option<f64>,
    /// Of the body about its symmetry axis. None with `about_momentum`.
    pub about_axis: Option<f64>,
    /// Estimated errors of the three.
    pub uncertainty: [f64; 3],
}

/// Exact frequencies of the motion of a problem in the principal frame of its `s`, which turns fast against the torque.
///
/// `H` and `K` have commuting flows on the torus of `(n, L)`. The times `(t_i, k_i)` along both that lead back to the start form a lattice; a basis
/// of it, once round `L` and once round the slow circle of `L`, is found by Newton steps from symmetric states, which need no derivatives of the flow. The
/// frequencies solve
///
/// ```text
/// w_1 (t_1, k_1) + w_2 (t_2, k_2) = 2 pi (1, 0)
/// ```
///
/// The body comes back turned about `n` by `psi_i`, and the third frequency is `(w_1 psi_1 + w_2 psi_2) / (2 pi)` and the constant rate
/// `-epsilon Omega^z`. Nothing is averaged and no way is long, however slow the precession: exact but for rounding, about 1e-15 of the rotation rate for
/// all three. (So where the strength of the torque is below 1e-5 the averaged motion to second order has the better slow rate.) Which whole sums of them the
/// frequencies are is a matter of names: those nearest to the rates of the averaged motion are taken.
///
/// # Errors
/// [`Error::Domain`] as for [`AveragedSolution::new`], and for isotropic `s`. [`Error::NotConverged`] where the torus is thin or no torus: `n` on `L`, `L` on an axis, the
/// separatrix.
pub fn torus_frequencies(problem: &Problem<f64>) -> Result<TorusFrequencies, Error> {
    let mean = AveragedSolution::new(problem, AveragingOrder::Second)?;
    let torus = Torus::of(problem)?;
    let initial = problem.initial();
    let fast_rate = torus.unit / torus.spheroid.inertia_xx;
    let [fast, slow] = torus.periods()?;
    let not_closed = Error::NotConverged { what: "periods of the torus", iterations: 1, residual: f64::NAN };
    let periods = Matrix2::new(fast.times[0], slow.times[0], fast.times[1], slow.times[1]);
    let inverse = periods.try_inverse().ok_or(not_closed)?;
    let [round_l, round_axis] = [inverse[(0, 0)] * TAU, inverse[(1, 0)] * TAU];
    let errors = errors_of_rates(&inverse, [fast.error, slow.error]);

    // Names.
    let turned = (round_l * fast.turn + round_axis * slow.turn) / TAU;
    let spheroid = problem.spheroid();
    let turned = turned - spheroid.oblateness() * initial.momentum.dot(&initial.axis) / spheroid.inertia_zz;
    let names = named([round_l, turned], round_axis, &mean.rates);
    let uncertainty = [errors[1], errors[0] + errors[1], errors[0] + errors[1] + ROUNDING * fast_rate];
    Ok(TorusFrequencies {
        axis: torus.axis(),
        slow: round_axis * torus.sense(),
        about_momentum: names.map(|[about_momentum, _]| about_momentum),
        about_axis: names.map(|[_, about_axis]| about_axis),
        uncertainty,
    })
}

/// Errors of the rates `2 pi (T^-1)_i0` with the inverse of the matrix `T` of periods, from those of the periods: `d(T^-1) = -T^-1 dT T^-1`.
fn errors_of_rates(inverse: &Matrix2<f64>, of_periods: [f64; 2]) -> [f64; 2] {
    let moved = of_periods[0] * inverse[(0, 0)].abs() + of_periods[1] * inverse[(1, 0)].abs();
    [0, 1].map(|i| TAU * moved * (inverse[(i, 0)].abs() + inverse[(i, 1)].abs()))
}

/// The two fast rates `about_momentum` and `about_axis` by the names of the averaged motion: with whole sums of the others beside them. None if it is not near
/// enough to tell.
fn named([round_l, turned]: [f64; 2], round_axis: f64, mean: &AveragedRates<f64>) -> Option<[f64; 2]> {
    let by_whole = |value: f64, base: f64, wanted: f64| value + ((wanted - value) / base).round() * base;
    let about_momentum = by_whole(round_l, round_axis, mean.about_momentum);
    let about_axis = by_whole(by_whole(turned, about_momentum, mean.about_axis), round_axis, mean.about_axis);
    let unclear = (about_momentum - mean.about_momentum).abs().max((about_axis - mean.about_axis).abs());
    (unclear < CLEAREST * round_axis.abs()).then_some([about_momentum, about_axis])
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::first_integrals::{FirstIntegrals, first_integrals};
    use crate::dynamics::{BodyState, RigidSpheroid};
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::solutions::torus::{separatrix_motion, states_with_integrals};

    const S: PrincipalCoefficients<f64> = PrincipalCoefficients { xx: 0.02, yy: 0.01, zz: -0.04 };
    const BODY: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.1, constant_c: 1.0 };

    fn state(direction: Vector3<f64>) -> BodyState<f64> {
        BodyState { axis: Vector3::new(0.6, 0.0, 0.8), momentum: direction * 1.4, equatorial_axis: Vector3::y() }
    }

    /// By the inverse of periods that are changed one after the other, each by a share of its error.
    #[test]
    fn errors_of_rates_are_those_of_changed_periods() {
        let (periods, of_periods) = (Matrix2::new(5.0, -0.7, 1.9, 311.0), [3e-6, 2e-5]);
        let inverse = periods.try_inverse().unwrap();
        let found = errors_of_rates(&inverse, of_periods);
        for (i, error) in found.into_iter().enumerate() {
            let mut worst = 0.0_f64;
            for signs in 0..16 {
                let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                let moved = Matrix2::from_fn(|row, k| sign((2 * row + k) as u32) * of_periods[k]);
                let changed = (periods + moved).try_inverse().unwrap() - inverse;
                worst = worst.max((TAU * changed[(i, 0)]).abs());
            }
            assert!((worst / error - 1.0).abs() < 1e-4, "{i}: {worst:e} {error:e}");
        }
    }

    fn frequencies(s: &PrincipalCoefficients<f64>, state: BodyState<f64>) -> Result<TorusFrequencies, Error> {
        torus_frequencies(&Problem::new(BODY, s.tensor(), state).unwrap())
    }

    #[test]
    fn components_are_images_with_the_same_frequencies() {
        let integrals = first_integrals(&BODY, &S.tensor(), &state(Vector3::new(0.0, 0.28, 0.96)));
        let found = states_with_integrals(&BODY, &S, &integrals).unwrap();
        let ends = found.components().unwrap().map(|state| frequencies(&S, state).unwrap());
        assert_eq!(found.round, Some(ends[0].axis));
        assert!((ends[0].slow + ends[1].slow).abs() < 1e-14 && ends[0].slow.abs() > 1e-3);
        let off = |a: Option<f64>, b: Option<f64>| (a.unwrap() - b.unwrap()).abs();
        assert!(off(ends[0].about_momentum, ends[1].about_momentum) < 1e-14);
        assert!(off(ends[0].about_axis, ends[1].about_axis) < 1e-14);
    }

    #[test]
    fn what_is_no_torus_is_refused() {
        let state = state(Vector3::z());
        let isotropic = PrincipalCoefficients::new([0.01; 3]);
        assert!(matches!(frequencies(&isotropic, state), Err(Error::Domain { .. })));
        let spin = BodyState { axis: Vector3::z(), equatorial_axis: Vector3::x(), ..state };
        assert!(matches!(frequencies(&S, spin), Err(Error::NotConverged { .. })));
        let integrals = first_integrals(&BODY, &S.tensor(), &state);
        for wrong in [
            FirstIntegrals { clebsch: integrals.clebsch + 0.2, ..integrals },
            FirstIntegrals { clebsch: integrals.clebsch - 0.2, ..integrals },
            FirstIntegrals { energy: 0.1, ..integrals },
            FirstIntegrals { spin: f64::NAN, ..integrals },
        ] {
            assert!(matches!(states_with_integrals(&BODY, &S, &wrong), Err(Error::Domain { .. })), "{wrong:?}");
        }
        assert!(states_with_integrals(&BODY, &isotropic, &integrals).is_err());
        assert!(separatrix_motion(&BODY, &isotropic, integrals.energy, integrals.spin).is_err());
        let unstable = separatrix_motion(&BODY, &S, integrals.energy, integrals.spin).unwrap();
        assert!(frequencies(&S, unstable).is_err());
    }

    #[test]
    fn names_are_those_nearest_to_the_mean_motion() {
        let mean = AveragedRates { slow: 0.01, about_momentum: 1.3, about_axis: -0.4 };
        let base = 0.0101;
        let (about_momentum, about_axis) = (1.3004, -0.4003);
        for (turns, more) in [(0.0, 0.0), (3.0, 0.0), (-7.0, 2.0), (5.0, -1.0)] {
            let round_l = about_momentum + turns * base;
            let turned = about_axis + more * about_momentum - turns * base;
            let found = named([round_l, turned], base, &mean).unwrap();
            let off = (found[0] - about_momentum).abs().max((found[1] - about_axis).abs());
            assert!(off < 1e-14, "{turns} {more}: {found:?}");
            assert_eq!(named([round_l, turned], -base, &mean).map(|_| ()), Some(()));
        }
        // Farther than a fifth of a slow turn off: another sum might be meant.
        let off = |momentum: f64, axis: f64| named([1.3 + momentum * base, -0.4 + axis * base], base, &mean);
        for far in [0.25, 0.45, -0.25, -0.45] {
            assert_eq!((off(far, 0.0), off(0.0, far), off(far, far)), (None, None, None));
        }
        for near in [0.15, -0.15] {
            assert!(off(near, 0.0).is_some() && off(0.0, near).is_some() && off(near, -near).is_some());
        }
    }
}
