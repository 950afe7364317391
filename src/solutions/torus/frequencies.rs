//! Exact frequencies of a motion, from the periods of its torus.

use core::f64::consts::TAU;

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector3};

use super::flow::{Axes, Integrals};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::solutions::mean::slow_precession::slow_precession;
use crate::solutions::mean::{MeanMotion, MeanOrder, Top, mean_direction};

/// Newton steps.
const MOST_CORRECTIONS: usize = 30;

/// Parts of a turn of `n` about `L` at which the way round the slow circle is closed at best.
const PARTS_OF_TURN: usize = 48;

/// Rounding of a flow for a period.
const ROUNDING: f64 = 1e-15;

/// Exact frequencies of a motion (rad per unit of time), with the names of [`MeanRates`](crate::solutions::mean::MeanRates), and estimates of their errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorusFrequencies {
    /// The principal axis that `L` goes round.
    pub axis: usize,
    /// Mean rate of the azimuth of `L`, averaged over the fast rotation, about the positive end of that axis.
    pub slow: f64,
    /// Of the body about `L`: for twofold precession that of `alpha`, where `L` is near the third axis.
    pub about_momentum: f64,
    /// Of the body about its symmetry axis.
    pub about_axis: f64,
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

    fn distance(&self, axes: &Axes<f64>) -> SVector<f64, 6> {
        self.vector([axes[0] - self.start[0], axes[1] - self.start[1]])
    }

    /// The period near given times. Flows commute, so the distance from the start is closed by the rates at the start.
    fn period(&self, mut times: [f64; 2]) -> Option<Period> {
        let rates = [[1.0, 0.0], [0.0, 1.0]].map(|unit| self.vector(self.integrals.rates(unit, &self.start)));
        let columns: SMatrix<f64, 6, 2> = SMatrix::from_columns(&rates);
        let svd = columns.svd(true, true);
        let least = svd.singular_values.min();
        let mut best = (f64::INFINITY, times, self.start);
        let mut worse = 0;
        for _ in 0..MOST_CORRECTIONS {
            let axes = self.integrals.moved(times, &self.start);
            let off = self.distance(&axes);
            let change: Vector2<f64> = svd.solve(&off, 0.0).ok()?;
            let step = (columns * change).norm();
            if step < best.0 {
                best = (step, times, axes);
                worse = 0;
            } else {
                worse += 1;
                if worse > 2 || !step.is_finite() {
                    break;
                }
            }
            if step < 0.1 * ROUNDING {
                break;
            }
            (times[0], times[1]) = (times[0] - change.x, times[1] - change.y);
        }
        let (_, times, axes) = best;
        let off = self.distance(&axes).norm();
        if !(off < 1e-9) {
            return None;
        }
        let [n, _, before] = self.start;
        let turn = n.dot(&before.cross(&axes[2])).atan2(before.dot(&axes[2]));
        Some(Period { times, turn, error: (off + ROUNDING) / least })
    }
}

/// Exact frequencies of the motion from `initial`, in the principal frame of `s`, which turns fast against the torque.
///
/// `H` and `K` have commuting flows on the torus of `(n, L)`. The times `(t, k)` along both that lead back to the start form a lattice; two of
/// its vectors, once round `L` and once round the slow circle of `L`, are found by Newton steps, and
///
/// ```text
/// w_1 t_1 + w_2 t_2 = 2 pi,    w_1 k_1 + w_2 k_2 = 0    with (w_1, w_2) read as turns along each:   sum w_i (t_i, k_i) = 2 pi (1, 0)
/// ```
///
/// are the frequencies of the flow of `H`. The body comes back turned about `n` by `psi_i`, and the third frequency is `sum w_i psi_i / (2 pi)`
/// and the constant rate `-epsilon Omega^z`. Nothing is averaged and no time is long: exact but for rounding, about `1e-15` for the fast rates and `1e-15` over
/// the strength of the torque, relative, for the slow one. Which multiples of the others a frequency takes along is a matter of names: those nearest
/// to the rates of the mean motion are taken.
///
/// # Errors
/// [`Error::Domain`] as for [`MeanMotion::new`], and for isotropic `s`. [`Error::NotConverged`] where the torus is thin or no torus: `n` on `L`, `L` on an axis, the
/// separatrix; and where the mean motion is not near enough to name the frequencies.
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
    let start = [initial.axis, initial.momentum, initial.equatorial_axis];
    let size = initial.momentum.norm();
    let torus = Torus { integrals, start, size };
    let not_closed = |what| Error::NotConverged { what, iterations: MOST_CORRECTIONS, residual: f64::NAN };

    let (fast_rate, c) = (size / spheroid.inertia_xx, initial.axis.dot(&initial.momentum) / size);
    let p2 = (3.0 * c * c - 1.0) / 2.0;
    let t = TAU / fast_rate;
    let k = -t * spheroid.constant_c * p2 * spread * spheroid.inertia_xx / (size * size);
    let fast = torus.period([t, k]).ok_or(not_closed("way of n round L on the torus: n is on L, or L on an axis"))?;

    let l = mean_direction(spheroid, &values, initial);
    let top = Top::new((values * (2.0 * fast_rate / spread)).into(), &l);
    let guess = TAU / top.rates().slow.abs();
    let mut slow = None;
    for factor in [1.0, 0.9, 1.1, 0.8, 1.25] {
        let half_way = [0.0, guess * factor];
        let mut at = integrals.moved(half_way, &torus.start);
        let part = fast.times.map(|time| time / PARTS_OF_TURN as f64);
        let mut nearest = (f64::INFINITY, 0);
        for parts in 0..PARTS_OF_TURN {
            let off = torus.distance(&at).norm();
            if off < nearest.0 {
                nearest = (off, parts);
            }
            at = integrals.moved(part, &at);
        }
        let times = [0, 1].map(|i| half_way[i] + part[i] * nearest.1 as f64);
        slow = torus.period(times).filter(|found| {
            let whole = (found.times[1] - fast.times[1] * found.times[0] / fast.times[0]) / guess;
            (0.6..1.6).contains(&whole)
        });
        if slow.is_some() {
            break;
        }
    }
    let slow = slow.ok_or(not_closed("way of L round its axis on the torus: L is on an axis, or this is the separatrix"))?;

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
    if !(unclear < 0.2 * round_axis.abs()) {
        return Err(Error::NotConverged {
            what: "names of the frequencies: the rates of the mean motion are not near enough",
            iterations: 1,
            residual: unclear,
        });
    }
    // Along the flow of K the averaged L turns as by the torque of a star that spins about it.
    let spinning = RigidSpheroid { constant_c: 1.0, ..*spheroid };
    let around = slow_precession(&spinning, &PrincipalCoefficients::new(values.into()), &l, &l)?;
    let sense = around.rate.signum();
    let uncertainty = [errors[1], errors[0] + errors[1], errors[0] + errors[1] + ROUNDING * fast_rate];
    Ok(TorusFrequencies { axis: around.axis, slow: round_axis * sense, about_momentum, about_axis, uncertainty })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::dynamics::first_integrals::first_integrals;
    use crate::solutions::torus::states_with_integrals;

    #[test]
    fn proto() {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        for k in [1.0, 0.3, 0.1, 0.01, 1e-4, 1e-6] {
            let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).scaled(k);
            for beta_rates in [(0.7, 1.438, 0.05), (0.7, 1.0, 0.0), (0.9, -0.07, 0.1), (1.4,-0.02,0.1)] {
            let angles = EulerAngles { alpha: 1.5, beta: beta_rates.0, gamma: 0.0 };
            let rates = EulerRates { alpha: beta_rates.1, beta: beta_rates.2, gamma: 1.0 - beta_rates.1 * f64::cos(beta_rates.0) };
            let start = BodyState::from_angles(&spheroid, &angles, &rates);
            let clock = std::time::Instant::now();
            let found = torus_frequencies(&spheroid, &s, &start);
            println!("{k} {beta_rates:?} {:?} {found:?}", clock.elapsed());
            let mean = MeanMotion::new(&spheroid, &s, &start, MeanOrder::Second).unwrap();
            println!("   mean {:?}", mean.rates());
            let integrals = first_integrals(&spheroid, &s.tensor(), &start);
            let states = states_with_integrals(&spheroid, &s, &integrals).unwrap();
            println!("  {:?} {}", states.round, states.states.len());
            for state in states.states {
                let again = first_integrals(&spheroid, &s.tensor(), &state);
                println!("   {:e} {:e} {:e}", again.energy-integrals.energy, again.spin-integrals.spin, again.clebsch-integrals.clebsch);
                if let Ok(f)=torus_frequencies(&spheroid, &s, &state) {
                    println!("    {:.16} {:.16} {:.16} {:?}", f.slow, f.about_momentum, f.about_axis, f.uncertainty);
                } else { println!("    {:?}", torus_frequencies(&spheroid, &s, &state)); }
            }
            }
        }
    }
}
