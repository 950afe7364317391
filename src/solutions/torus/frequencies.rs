//! Exact frequencies of a motion, from the periods of its torus.

use core::f64::consts::TAU;

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector3};

use super::flow::{Axes, Integrals};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::solutions::mean::{MeanMotion, MeanOrder, Top, mean_direction};

/// Newton steps.
const MOST_CORRECTIONS: usize = 30;

/// Newton steps along the fast angle alone.
const FAST_CORRECTIONS: usize = 4;

/// Parts of a turn, fast or slow, that are looked at.
const PARTS_OF_TURN: usize = 48;

/// A slow turn may take so many times what the mean motion says, near the separatrix.
const LONGEST_TURN: usize = 5;

/// Difference from the rates of the mean motion, in slow ones, up to which it names the others.
const CLEAREST: f64 = 0.2;

/// A torus whose two flows differ by less than this, relative, is a circle or a point.
const THINNEST: f64 = 1e-8;

/// Gap at which a way still counts as closed, near the separatrix, where rounding grows.
const WIDEST_GAP: f64 = 1e-8;

/// Rounding of a flow for a period.
const ROUNDING: f64 = 1e-15;

/// Exact frequencies of a motion (rad per unit of time), named as in [`MeanRates`](crate::solutions::mean::MeanRates).
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
    /// Of the body about `L`. None where the mean motion is not near enough to tell it from its sums with the slow one, as close to the
    /// separatrix.
    pub about_momentum: Option<f64>,
    /// Of the body about its symmetry axis. None with `about_momentum`.
    pub about_axis: Option<f64>,
    /// Estimated errors of the three.
    pub uncertainty: [f64; 3],
}

/// A closed way on the torus: along the flow of `H` for the first time and along that of `K` for the second.
struct Period {
    times: [f64; 2],
    /// Turn of the body about `n` (rad).
    turn: f64,
    /// Estimated error of the times.
    error: f64,
}

struct Torus {
    integrals: Integrals<f64>,
    start: Axes<f64>,
    size: f64,
}

impl Torus {
    fn vector(&self, [n, momentum]: [Vector3<f64>; 2]) -> SVector<f64, 6> {
        let l = momentum / self.size;
        SVector::from([n.x, n.y, n.z, l.x, l.y, l.z])
    }

    /// How far apart the ends of a way are of which the start is the middle.
    fn gap(&self, times: [f64; 2]) -> (SVector<f64, 6>, [Axes<f64>; 2]) {
        let ends = [0.5, -0.5].map(|half| self.integrals.moved(times.map(|time| time * half), &self.start));
        let [a, b] = &ends;
        (self.vector([a[0] - b[0], a[1] - b[1]]), ends)
    }

    /// The period near given times. Flows commute, so that the rates at an end close the gap.
    fn period(&self, mut times: [f64; 2]) -> Option<Period> {
        let mut best: Option<(f64, Period)> = None;
        let mut worse = 0;
        for _ in 0..MOST_CORRECTIONS {
            let (gap, [end, other]) = self.gap(times);
            // A decomposition of what is not finite need not end.
            if !gap.norm().is_finite() {
                break;
            }
            let rates = [[1.0, 0.0], [0.0, 1.0]].map(|unit| self.vector(self.integrals.rates(unit, &end)));
            let columns: SMatrix<f64, 6, 2> = SMatrix::from_columns(&rates);
            let svd = columns.svd(true, true);
            let least = svd.singular_values.min();
            if least <= THINNEST * svd.singular_values.max() || !least.is_finite() {
                return None;
            }
            let change: Vector2<f64> = svd.solve(&gap, 0.0).ok()?;
            let size = gap.norm();
            if best.as_ref().is_none_or(|(smallest, _)| size < *smallest) {
                let [n, _, after] = end;
                let turn = n.dot(&other[2].cross(&after)).atan2(other[2].dot(&after));
                best = Some((size, Period { times, turn, error: (size + ROUNDING) / least }));
                worse = 0;
            } else {
                worse += 1;
            }
            if worse > 1 || size < 0.1 * ROUNDING {
                break;
            }
            times = [times[0] - change.x, times[1] - change.y];
        }
        best.filter(|(gap, _)| *gap < WIDEST_GAP).map(|(_, period)| period)
    }
}

impl Torus {
    /// Once round the slow circle, from a time `k` along `K`: where along a turn of `n` about `L`, the time `fast`, that nearly leads back.
    fn slow_period(&self, fast: [f64; 2], k: f64) -> Option<Period> {
        let distance = |at: &Axes<f64>| self.vector([at[0] - self.start[0], at[1] - self.start[1]]);
        let mut at = self.integrals.moved([0.0, k], &self.start);
        let part = fast.map(|time| time / PARTS_OF_TURN as f64);
        let mut nearest = (f64::INFINITY, 0);
        for parts in 0..PARTS_OF_TURN {
            let off = distance(&at).norm();
            if off < nearest.0 {
                nearest = (off, parts);
            }
            at = self.integrals.moved(part, &at);
        }
        let turned = nearest.1 as f64;
        let mut times = [part[0] * turned, k + part[1] * turned];
        // First the fast angle alone: the slow circle may be much smaller.
        let along = self.vector(self.integrals.rates(fast, &self.start));
        for _ in 0..FAST_CORRECTIONS {
            let turn = along.dot(&distance(&self.integrals.moved(times, &self.start))) / along.norm_squared();
            times = [0, 1].map(|i| times[i] - turn * fast[i]);
        }
        self.period(times)
    }
}

/// Exact frequencies of the motion from `initial`, in the principal frame of `s`, which turns fast against the torque.
///
/// `H` and `K` have commuting flows on the torus of `(n, L)`. The times `(t_i, k_i)` along both that lead back to the start form a lattice; a basis
/// of it, once round `L` and once round the slow circle of `L`, is found by Newton steps, which need no derivatives of the flow: what is left to
/// close lies in the torus. The frequencies solve
///
/// ```text
/// w_1 (t_1, k_1) + w_2 (t_2, k_2) = 2 pi (1, 0)
/// ```
///
/// The body comes back turned about `n` by `psi_i`, and the third frequency is `(w_1 psi_1 + w_2 psi_2) / (2 pi)` and the constant rate
/// `-epsilon Omega^z`. Nothing is averaged and no way is long, however slow the precession: exact but for rounding, about 1e-15 of the rotation rate for
/// all three. (So where the strength of the torque is below 1e-5 the mean motion to second order has the better slow rate.) Which whole sums of them the
/// frequencies are is a matter of names: those nearest to the rates of the mean motion are taken.
///
/// # Errors
/// [`Error::Domain`] as for [`MeanMotion::new`], and for isotropic `s`. [`Error::NotConverged`] where the torus is thin or no torus: `n` on `L`, `L` on an axis, the
/// separatrix.
pub fn torus_frequencies(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    initial: &BodyState<f64>,
) -> Result<TorusFrequencies, Error> {
    let mean = MeanMotion::new(spheroid, s, initial, MeanOrder::Second)?;
    let values = Vector3::new(s.xx, s.yy, s.zz);
    let values = values.map(|value| value - values.mean());
    let spread = values.max() - values.min();
    Error::unless(spread > 0.0, "s_max - s_min", spread, "above zero: without it there is no torque")?;
    let integrals = Integrals::new(spheroid, &values, spread);
    let size = initial.momentum.norm();
    let not_closed = |what| Error::NotConverged { what, iterations: MOST_CORRECTIONS, residual: f64::NAN };

    let (fast_rate, c) = (size / spheroid.inertia_xx, initial.axis.dot(&initial.momentum) / size);
    let course = SlowCourse::along(&integrals, spheroid, &values, initial)?;
    let torus = Torus { integrals, start: course.fastest, size };
    let p2 = (3.0 * c * c - 1.0) / 2.0;
    let t = TAU / fast_rate;
    let k = -t * spheroid.constant_c * p2 * spread * spheroid.inertia_xx / (size * size);
    let fast = torus.period([t, k]).ok_or(not_closed("way of n round L on the torus: n is on L, or L on an axis"))?;
    // The time along K for a turn is well known from the mean motion away from the separatrix, and from the course near it.
    let once = |found: &Period| {
        let area = fast.times[0] * found.times[1] - fast.times[1] * found.times[0];
        (0.7..1.4).contains(&(area / (t * course.period)))
    };
    let starts = [course.guess, course.period, 0.9 * course.period, 1.1 * course.period];
    let slow = starts
        .into_iter()
        .find_map(|start| torus.slow_period([t, k], start).filter(once))
        .ok_or(not_closed("way of L round its axis on the torus: L is on an axis, or this is the separatrix"))?;
    // Where the slow circle is small the fast way may have gone round it as well.
    let besides = ((fast.times[1] - k) / slow.times[1]).round();
    let fast = Period {
        times: [0, 1].map(|i| fast.times[i] - besides * slow.times[i]),
        turn: fast.turn - besides * slow.turn,
        error: fast.error + besides.abs() * slow.error,
    };

    let periods = Matrix2::new(fast.times[0], slow.times[0], fast.times[1], slow.times[1]);
    let inverse = periods.try_inverse().ok_or(not_closed("periods of the torus"))?;
    let [round_l, round_axis] = [inverse[(0, 0)] * TAU, inverse[(1, 0)] * TAU];
    let spread_of_error = fast.error * round_l.abs() + slow.error * round_axis.abs();
    let errors = [0, 1].map(|i| spread_of_error * (inverse[(i, 0)].abs() + inverse[(i, 1)].abs()));

    // Names.
    let rates = mean.rates();
    let by_whole = |value: f64, base: f64, wanted: f64| value + ((wanted - value) / base).round() * base;
    let about_momentum = by_whole(round_l, round_axis, rates.about_momentum);
    let turned = (round_l * fast.turn + round_axis * slow.turn) / TAU;
    let turned = turned - spheroid.oblateness() * initial.momentum.dot(&initial.axis) / spheroid.inertia_zz;
    let about_axis = by_whole(by_whole(turned, about_momentum, rates.about_axis), round_axis, rates.about_axis);
    let unclear = (about_momentum - rates.about_momentum).abs().max((about_axis - rates.about_axis).abs());
    let named = unclear < CLEAREST * round_axis.abs();
    let uncertainty = [errors[1], errors[0] + errors[1], errors[0] + errors[1] + ROUNDING * fast_rate];
    Ok(TorusFrequencies {
        axis: course.axis,
        slow: round_axis * course.sense,
        about_momentum: named.then_some(about_momentum),
        about_axis: named.then_some(about_axis),
        uncertainty,
    })
}

/// The averaged `L` along the flow of `K`, once round its axis.
struct SlowCourse {
    /// Time along `K` of a turn, from what is seen and from the top that the averaged `L` is.
    period: f64,
    guess: f64,
    /// Where it moves fastest.
    fastest: Axes<f64>,
    /// The axis that it goes round, and in which sense about its positive end.
    axis: usize,
    sense: f64,
}

impl SlowCourse {
    fn along(
        integrals: &Integrals<f64>,
        spheroid: &RigidSpheroid<f64>,
        values: &Vector3<f64>,
        initial: &BodyState<f64>,
    ) -> Result<Self, Error> {
        let spread = values.max() - values.min();
        let direction = |[axis, momentum, equatorial_axis]: Axes<f64>| {
            mean_direction(spheroid, values, &BodyState { axis, momentum, equatorial_axis })
        };
        // Averaged, the flow of K turns l as a top with the tensor 2 s L.
        let tensor = values * (2.0 * initial.momentum.norm() / (spheroid.inertia_xx * spread));
        let rate = |l: &Vector3<f64>| tensor.component_mul(l).cross(l);
        let mut axes = [initial.axis, initial.momentum, initial.equatorial_axis];
        let guess = TAU / Top::new(tensor.into(), &direction(axes)).rates().slow.abs();
        let part = guess / PARTS_OF_TURN as f64;
        let still = Error::NotConverged {
            what: "way of L round its axis: L is on an axis, or this is the separatrix",
            iterations: LONGEST_TURN * PARTS_OF_TURN,
            residual: guess,
        };
        if !guess.is_finite() {
            return Err(still);
        }
        // Near the separatrix L lingers by the middle axis, where nothing tells how far it has come.
        let mut best = (0.0, axes);
        for _ in 0..PARTS_OF_TURN {
            let speed = rate(&direction(axes)).norm();
            if speed > best.0 {
                best = (speed, axes);
            }
            axes = integrals.moved([0.0, part], &axes);
        }
        let fastest = best.1;
        let first = direction(fastest);
        let tangent = rate(&first);
        axes = fastest;
        let (mut least, mut before, mut turned) = (first.abs(), 0.0, false);
        for step in 1..=LONGEST_TURN * PARTS_OF_TURN {
            axes = integrals.moved([0.0, part], &axes);
            let l = direction(axes);
            let ahead = (l - first).dot(&tangent);
            least = least.zip_map(&l.abs(), f64::min);
            // Behind the start after half a turn, in front of it again after a whole one.
            turned |= ahead < 0.0;
            if turned && ahead >= 0.0 {
                let period = part * (step as f64 - ahead / (ahead - before));
                let (high, low) = (values.imax(), values.imin());
                let axis = if least[high] > least[low] { high } else { low };
                let sense = if axis == high { l[axis].signum() } else { -l[axis].signum() };
                return Ok(Self { period, guess, fastest, axis, sense });
            }
            before = ahead;
        }
        Err(still)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::first_integrals::{FirstIntegrals, first_integrals};
    use crate::solutions::torus::{separatrix_motion, states_with_integrals};

    fn scene(direction: Vector3<f64>) -> (RigidSpheroid<f64>, PrincipalCoefficients<f64>, BodyState<f64>) {
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let state = BodyState { axis, momentum: direction * 1.4, equatorial_axis: Vector3::y() };
        (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new([0.02, 0.01, -0.04]), state)
    }

    #[test]
    fn components_are_images_with_the_same_frequencies() {
        let (body, s, state) = scene(Vector3::new(0.0, 0.28, 0.96));
        let integrals = first_integrals(&body, &s.tensor(), &state);
        let found = states_with_integrals(&body, &s, &integrals).unwrap();
        let ends = found.components().unwrap().map(|state| torus_frequencies(&body, &s, &state).unwrap());
        assert_eq!(found.round, Some(ends[0].axis));
        assert!((ends[0].slow + ends[1].slow).abs() < 1e-14 && ends[0].slow.abs() > 1e-3);
        let off = |a: Option<f64>, b: Option<f64>| (a.unwrap() - b.unwrap()).abs();
        assert!(off(ends[0].about_momentum, ends[1].about_momentum) < 1e-14);
        assert!(off(ends[0].about_axis, ends[1].about_axis) < 1e-14);
    }

    #[test]
    fn what_is_no_torus_is_refused() {
        let (body, s, state) = scene(Vector3::z());
        let isotropic = PrincipalCoefficients::new([0.01; 3]);
        assert!(matches!(torus_frequencies(&body, &isotropic, &state), Err(Error::Domain { .. })));
        let spin = BodyState { axis: Vector3::z(), equatorial_axis: Vector3::x(), ..state };
        assert!(matches!(torus_frequencies(&body, &s, &spin), Err(Error::NotConverged { .. })));
        let integrals = first_integrals(&body, &s.tensor(), &state);
        let refused = |change: &dyn Fn(&mut FirstIntegrals<f64>)| {
            let mut integrals = integrals;
            change(&mut integrals);
            assert!(matches!(states_with_integrals(&body, &s, &integrals), Err(Error::Domain { .. })));
        };
        refused(&|integrals| integrals.clebsch += 0.2);
        refused(&|integrals| integrals.clebsch -= 0.2);
        refused(&|integrals| integrals.energy = 0.1);
        refused(&|integrals| integrals.spin = f64::NAN);
        assert!(states_with_integrals(&body, &isotropic, &integrals).is_err());
        assert!(separatrix_motion(&body, &isotropic, integrals.energy, integrals.spin).is_err());
        let unstable = separatrix_motion(&body, &s, integrals.energy, integrals.spin).unwrap();
        assert!(torus_frequencies(&body, &s, &unstable).is_err());
    }
}
