//! Upper limits on a wobble that arrival times do not show.

use core::f64::consts::FRAC_PI_2;

use nalgebra::{DMatrix, DVector};

use super::least_squares::Comparison;
use super::wobble_posterior::WobblePosterior;
use super::{InferenceError, TimingData};
use crate::error::Error;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter};

/// The wobble of a star from its arrival times, for one precession period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WobbleLimit {
    /// Rate of the precession (rad/s).
    pub precession_rate: f64,
    /// Wobble angle at the minimum of `chi^2` (rad).
    pub best: f64,
    /// Reduction of `chi^2` at this minimum relative to no wobble. With two extra parameters, values of 6 or more occur by chance
    /// at one in twenty periods.
    pub gain: f64,
    /// Upper limit on the wobble at the requested probability (rad).
    pub limit: f64,
}

/// A wobble (rad) below this counts as none: it is rounding of the initial state.
const NO_WOBBLE: f64 = 1e-12;

/// Upper limits on the wobble at each precession rate, for a star that was fitted to the arrival times without a wobble. `unknowns` are the fitted
/// parameters and must not include those of the wobble or of the torque.
///
/// Residuals of a small wobble are `theta (D_c cos psi_0 + D_s sin psi_0)`, where `D_c` and `D_s` are derivatives with respect to the wobble at two phases of
/// the precession: `theta cot chi sin psi / (2 pi f)` from geometry, with the rate `f` of the phase, plus the timing delay due to the torque. The other
/// unknowns are projected out. The limit is the quantile of the posterior of `theta`, with a flat prior for `theta` and for `psi_0`. Where this quantile or the
/// wider standard deviation of the wobble is above 0.1 rad, the data do not limit the wobble, and the limit is infinite.
///
/// # Errors
/// [`InferenceError::TooFew`] if there are no more arrivals than unknowns; as for [`fit_timing`](super::fit_timing) for the model; [`Error::Domain`]
/// unless `0 <= probability < 1`, and for a fitted model with a wobble; [`Error::Unsupported`] for unknowns on which residuals without a wobble do
/// not depend: `wobble`, `chi`, `precession_phase`, `precession_rate` and `torque_share`. If a wobble does not move the pulses, as for `chi` a right
/// angle, the limit is infinite.
pub fn wobble_limits(
    fitted: &TimingModel,
    data: &TimingData,
    unknowns: &[TimingParameter],
    precession_rates: &[f64],
    probability: f64,
) -> Result<Vec<WobbleLimit>, InferenceError> {
    use TimingParameter::{Chi, PrecessionPhase, PrecessionRate, TorqueShare, Wobble};
    let wobble = fitted.value(Wobble);
    Error::ensure(
        wobble < NO_WOBBLE,
        "wobble (rad)",
        wobble,
        "zero; the limit is for a model fitted without a wobble",
    )?;
    let of_wobble = [Wobble, Chi, PrecessionPhase, PrecessionRate, TorqueShare];
    if let Some(unknown) = unknowns.iter().find(|unknown| of_wobble.contains(unknown)) {
        let why = "it must be held fixed, since residuals without a wobble do not depend on it";
        return Err(Error::Unsupported { what: unknown.key(), why }.into());
    }
    let without = |rate: f64, phase: f64| {
        let [old_rate, old_phase] = [PrecessionRate, PrecessionPhase].map(|of| fitted.value(of));
        fitted.moved(&[(Wobble, -wobble), (PrecessionRate, rate - old_rate), (PrecessionPhase, phase - old_phase)])
    };
    if data.arrivals.len() <= unknowns.len() {
        return Err(InferenceError::TooFew { data: data.arrivals.len(), least: unknowns.len() + 1 });
    }
    let rest = without(0.0, 0.0)?;
    let data = data.numbered(&rest)?;
    let (residuals, jacobian) = data.linearised(&rest, unknowns)?;
    let others = orthonormal(jacobian.matrix);
    let project = |v: DVector<f64>| -> DVector<f64> { &v - &others * (others.transpose() * &v) };
    // Twice, to remove what rounding left the first time.
    let residuals = project(project(DVector::from_vec(residuals)));
    precession_rates
        .iter()
        .map(|&rate| {
            let column = |phase: f64| -> Result<DVector<f64>, InferenceError> {
                let (_, jacobian) = data.linearised(&without(rate, phase)?, &[Wobble])?;
                Ok(project(project(jacobian.matrix.column(0).into_owned())))
            };
            let columns = DMatrix::from_columns(&[column(0.0)?, column(FRAC_PI_2)?]);
            let posterior = WobblePosterior::new(columns, &residuals)?;
            let [x, y] = posterior.best();
            let (gain, limit) = (posterior.gain(), posterior.limit(probability)?);
            Ok(WobbleLimit { precession_rate: rate, best: x.hypot(y), gain, limit })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::MeasuredArrival;

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
                matches!(found, Err(InferenceError::TooFew { data, least: 3 }) if data == times.len()),
                "{found:?}"
            );
        }
    }

    /// Limits cannot be computed for such a model.
    #[test]
    fn fitted_wobbles_and_unknowns_of_the_wobble_are_refused() {
        use TimingParameter::{Chi, F0, Phase, PrecessionPhase, PrecessionRate, TorqueShare, Wobble};
        let model = |wobble: f64| TimingModel::new([2.5, 0.0], &[(Chi, 1.4), (Wobble, wobble)]).expect("a model");
        let arrival = |k: i32| MeasuredArrival { time: [f64::from(k) * 4e5, 0.0], sigma: 1e-6, number: None };
        let data = TimingData { arrivals: (0..20).map(arrival).collect(), ..TimingData::default() };
        let limits =
            |wobble: f64, unknowns: &[TimingParameter]| wobble_limits(&model(wobble), &data, unknowns, &[1e-6], 0.95);
        assert!(limits(1e-13, &[Phase, F0]).is_ok());
        let refused = limits(1e-10, &[Phase]).expect_err("a wobble");
        assert!(
            matches!(refused, InferenceError::Model(Error::Domain { quantity: "wobble (rad)", value: 1e-10, .. })),
            "{refused:?}"
        );
        for unknown in [Chi, PrecessionPhase, PrecessionRate, TorqueShare, Wobble] {
            let refused = limits(0.0, &[Phase, unknown]).expect_err("no effect");
            assert!(
                matches!(refused, InferenceError::Model(Error::Unsupported { what, .. }) if what == unknown.key()),
                "{refused:?}"
            );
        }
    }

    /// Columns of any length and nearly parallel keep their span.
    #[test]
    fn a_basis_spans_its_columns() {
        let of =
            |columns: &[[f64; 3]]| orthonormal(DMatrix::from_fn(3, columns.len(), |row, column| columns[column][row]));
        let spans = |basis: &DMatrix<f64>, vector: [f64; 3]| {
            let vector = DVector::from_row_slice(&vector);
            (&vector - basis * (basis.transpose() * &vector)).norm() < 1e-4
        };
        let small = of(&[[1e-20, 0.0, 0.0], [0.0, 3.0, 0.0]]);
        assert!(small.ncols() == 2 && spans(&small, [1.0, 0.0, 0.0]) && spans(&small, [0.0, 1.0, 0.0]));
        let alike = of(&[[1.0, 0.0, 0.0], [1.0, 1e-11, 0.0]]);
        assert!(alike.ncols() == 2 && spans(&alike, [0.0, 1.0, 0.0]) && !spans(&alike, [0.0, 0.0, 1.0]));
        assert_eq!(of(&[[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0; 3]]).ncols(), 1);
        assert!(of(&[]).is_empty());
    }
}
