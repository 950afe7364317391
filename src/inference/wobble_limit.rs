//! How large a wobble can be that arrival times do not show.

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::least_squares::Comparison;
use super::{InferenceError, TimingData};
use crate::error::Error;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter};

/// The wobble of a star by its arrival times, for one period of precession.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WobbleLimit {
    /// Rate of the precession (rad/s).
    pub precession_rate: f64,
    /// Wobble angle of the least `chi^2` (rad).
    pub best: f64,
    /// By how much `chi^2` is less there than without a wobble. Of two more unknowns: 6 or more in one of twenty periods by chance.
    pub gain: f64,
    /// The wobble that is not exceeded with the probability asked (rad).
    pub limit: f64,
}

/// Points over the wobble and least number over the phase.
const POINTS: usize = 2000;
const PHASES: usize = 512;

/// Standard deviations about the best wobble that are integrated over.
const REACH: f64 = 9.0;

/// `exp(-x)` is zero from here on.
const NOTHING: f64 = 746.0;

/// A wobble (rad) that is none: rounding of the initial state.
const NO_WOBBLE: f64 = 1e-12;

/// Largest wobble (rad) for which residuals are taken as in proportion to it: what is left out is of relative size `theta`.
const LARGEST: f64 = 0.1;

/// The wobble that arrival times allow at each of some rates of precession, of a star that was fitted to them without one, by the `unknowns`: none of them of the wobble or of the torque.
///
/// Residuals of a small wobble are `theta (D_c cos psi_0 + D_s sin psi_0)`, with the derivatives of the phase by the wobble at two phases: `theta cot chi sin psi / (2 pi F0)` by geometry, and the
/// lateness by the torque. The other unknowns are projected out. The limit is the quantile of the posterior of `theta`, with a flat prior for `theta` and for `psi_0`. Where it is above 0.1 rad the
/// data do not limit it, and it is infinite.
///
/// # Errors
/// [`InferenceError::TooFew`] for no more arrivals than unknowns; as for [`fit_timing`](super::fit_timing) by the model; [`Error::Domain`] for a probability outside 0 to 1, for a fitted model with a wobble, and for unknowns on which residuals without a wobble do not depend: `wobble`, `chi`, `precession_phase`, `precession_rate` and `torque_share`. Where a wobble does not move the pulses, as with `chi` a right angle, the limit is infinite.
pub fn wobble_limits(
    fitted: &TimingModel,
    data: &TimingData,
    unknowns: &[TimingParameter],
    precession_rates: &[f64],
    probability: f64,
) -> Result<Vec<WobbleLimit>, InferenceError> {
    use TimingParameter::{Chi, PrecessionPhase, PrecessionRate, TorqueShare, Wobble};
    Error::ensure((0.0..1.0).contains(&probability), "confidence", probability, "from 0 to below 1")?;
    let wobble = fitted.value(Wobble);
    Error::ensure(wobble < NO_WOBBLE, "wobble (rad)", wobble, "zero, for a limit of what can be")?;
    let of_wobble = [Wobble, Chi, PrecessionPhase, PrecessionRate, TorqueShare];
    if let Some(unknown) = unknowns.iter().find(|unknown| of_wobble.contains(unknown)) {
        let why = "residuals without a wobble do not depend on it: it is held fixed";
        return Err(Error::Unsupported { what: unknown.key(), why }.into());
    }
    let without = |rate: f64, phase: f64| {
        let [old_rate, old_phase] = [PrecessionRate, PrecessionPhase].map(|of| fitted.value(of));
        fitted.moved(&[(Wobble, -wobble), (PrecessionRate, rate - old_rate), (PrecessionPhase, phase - old_phase)])
    };
    if data.arrivals.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: data.arrivals.len(), unknowns: unknowns.len() });
    }
    let rest = without(0.0, 0.0)?;
    let data = data.numbered(&rest)?;
    let (residuals, jacobian) = data.linearised(&rest, unknowns)?;
    let others = orthonormal(jacobian.matrix);
    let project = |v: DVector<f64>| -> DVector<f64> { &v - &others * (others.transpose() * &v) };
    // Twice, so that what rounding left goes too.
    let residuals = project(project(DVector::from_vec(residuals)));
    precession_rates
        .iter()
        .map(|&rate| {
            let column = |phase: f64| -> Result<DVector<f64>, InferenceError> {
                let (_, jacobian) = data.linearised(&without(rate, phase)?, &[Wobble])?;
                Ok(project(project(jacobian.matrix.column(0).into_owned())))
            };
            let (along, across) = (column(0.0)?, column(FRAC_PI_2)?);
            let curvature =
                Matrix2::new(along.dot(&along), along.dot(&across), across.dot(&along), across.dot(&across));
            let pull = -Vector2::new(along.dot(&residuals), across.dot(&residuals));
            Ok(Posterior { curvature, pull }.limit(rate, probability))
        })
        .collect()
}

/// An orthonormal basis of the columns, each scaled to unit length first.
fn orthonormal(mut matrix: DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_empty() {
        return matrix;
    }
    for mut column in matrix.column_iter_mut() {
        let length = column.norm();
        if length > 0.0 {
            column /= length;
        }
    }
    let svd = matrix.svd(true, false);
    let rank = svd.singular_values.iter().filter(|value| **value > 1e-13).count();
    svd.u.expect("asked for").columns(0, rank).into_owned()
}

/// `-2 ln` of the posterior of `x = theta (cos psi_0, sin psi_0)` is `x.(curvature x) - 2 pull.x`.
struct Posterior {
    curvature: Matrix2<f64>,
    pull: Vector2<f64>,
}

impl Posterior {
    fn limit(&self, precession_rate: f64, probability: f64) -> WobbleLimit {
        let none = WobbleLimit { precession_rate, best: f64::NAN, gain: 0.0, limit: f64::INFINITY };
        let inverse = self.curvature.try_inverse().filter(|inverse| inverse.iter().all(|entry| entry.is_finite()));
        let Some(inverse) = inverse else { return none };
        let best = inverse * self.pull;
        let widths = inverse.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
        let (widest, finest) = (widths.max(), widths.min());
        let gain = self.pull.dot(&best);
        let found = WobbleLimit { best: best.norm(), gain, ..none };
        if widest.is_nan() || widest <= 0.0 || widest > LARGEST {
            return found;
        }
        let low = (best.norm() - REACH * widest).max(0.0);
        if low > LARGEST {
            return found;
        }
        let step = (best.norm() + REACH * widest - low) / POINTS as f64;
        // A needle of the width `finest` across is seen at an angle of that over the wobble. Points an angle apart that is an eighth of it leave nothing of a normal distribution.
        let phases = PHASES.max((8.0 * TAU * (best.norm() + REACH * widest) / finest).min(2e5) as usize);
        let mut sums = vec![0.0; POINTS + 1];
        for k in 0..phases {
            let (sin, cos) = (TAU * k as f64 / phases as f64).sin_cos();
            let direction = Vector2::new(cos, sin);
            let (bend, slope) = (direction.dot(&(self.curvature * direction)), direction.dot(&self.pull));
            // Elsewhere the exponential is zero.
            let (peak, reach) = (slope / bend, ((2.0 * NOTHING + slope * slope / bend - gain) / bend).sqrt());
            let places = [peak - reach, peak + reach].map(|theta| ((theta - low) / step).clamp(0.0, POINTS as f64));
            let (first, last) = (places[0] as usize, places[1].ceil() as usize);
            for (place, sum) in (first..).zip(&mut sums[first..=last]) {
                let theta = low + step * place as f64;
                *sum += (theta * slope - 0.5 * (theta * theta * bend + gain)).exp();
            }
        }
        let mut total = vec![0.0; POINTS + 1];
        (1..=POINTS).for_each(|place| total[place] = total[place - 1] + 0.5 * (sums[place - 1] + sums[place]));
        let wanted = probability * total[POINTS];
        let after = total.partition_point(|sum| *sum < wanted).clamp(1, POINTS);
        let part = (wanted - total[after - 1]) / (total[after] - total[after - 1]);
        let limit = low + step * ((after - 1) as f64 + part);
        if limit <= LARGEST { WobbleLimit { limit, ..found } } else { found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::MeasuredArrival;

    /// Without a pull and with one width the wobble has half a normal distribution; far from zero a normal one.
    #[test]
    fn limits_of_known_distributions() {
        let round = |pull: [f64; 2]| Posterior { curvature: Matrix2::identity() * 1e12, pull: pull.into() };
        let none = round([0.0; 2]).limit(1.0, 0.95);
        assert!((none.limit / 1.959964e-6 - 1.0).abs() < 1e-5, "{none:?}");
        let far = round([1e9, 2e9]).limit(1.0, 0.95);
        // The prior is flat in theta, not over the plane: the density has a factor theta^(-1/2) more, which moves it by 2.2e-10. Straight lines between the points are right to 3e-11.
        let expected = 5.0_f64.sqrt() * 1e-3 + 1.644854e-6 - 0.5e-12 / (5.0_f64.sqrt() * 1e-3);
        assert!((far.limit - expected).abs() < 4e-11, "{far:?} {expected:e}");
        assert!((far.gain / 5e6 - 1.0).abs() < 1e-12);
        assert!(round([1e9; 2]).limit(1.0, 0.5).limit < far.limit);
        // A thousand times as long as wide: the limit does not depend on where it points.
        let needle = |turn: f64| {
            let (sin, cos) = f64::sin_cos(turn);
            let along = Matrix2::new(cos * cos, cos * sin, cos * sin, sin * sin);
            Posterior { curvature: along * 1e10 + (Matrix2::identity() - along) * 1e16, pull: Vector2::zeros() }
        };
        let limits = [0.0, 0.3, 1.234].map(|turn| needle(turn).limit(1.0, 0.95).limit);
        assert!(limits.iter().all(|limit| (limit / limits[0] - 1.0).abs() < 1e-3), "{limits:?}");
        // Far above what residuals are in proportion to, where the posterior is nowhere a number.
        assert_eq!(round([1e23, 0.0]).limit(1.0, 0.95).limit, f64::INFINITY);
        let blind = Posterior { curvature: Matrix2::new(1.0, 0.0, 0.0, 0.0), pull: Vector2::zeros() };
        assert_eq!(blind.limit(1.0, 0.95).limit, f64::INFINITY);
    }

    #[test]
    fn a_star_of_which_all_is_known_has_a_limit_too() {
        let model = TimingModel::new([2.5, 0.0], &[(TimingParameter::Chi, 1.4)]).expect("a model");
        let arrival = |k: i32| MeasuredArrival { time: [f64::from(k) * 4e5, 0.0], sigma: 1e-6, number: None };
        let data = TimingData { arrivals: (0..20).map(arrival).collect(), ..TimingData::default() };
        let limits = wobble_limits(&model, &data, &[], &[1e-6], 0.95).expect("a limit");
        assert!((1e-7..1e-3).contains(&limits[0].limit), "{limits:?}");
    }

    #[test]
    fn as_many_data_as_unknowns_limit_nothing() {
        let model = TimingModel::new([2.5, 0.0], &[(TimingParameter::Chi, 1.4)]).expect("a model");
        let arrival = |time: f64| MeasuredArrival { time: [time, 0.0], sigma: 1e-6, number: None };
        let unknowns = [TimingParameter::Phase, TimingParameter::F0];
        for times in [&[][..], &[0.0, 1e7]] {
            let arrivals = times.iter().map(|time| arrival(*time)).collect();
            let data = TimingData { arrivals, ..TimingData::default() };
            let found = wobble_limits(&model, &data, &unknowns, &[1e-6], 0.95);
            assert!(
                matches!(found, Err(InferenceError::TooFew { data, unknowns: 2 }) if data == times.len()),
                "{found:?}"
            );
        }
    }
}
