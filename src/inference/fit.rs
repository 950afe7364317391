//! The fit of a star, its beam and its observer to data.

use std::collections::BTreeMap;

use super::least_squares::{self, Comparison, Fit, least_squares};
use super::signal::turning_rate;
use super::{Datum, Event, Fisher, InferenceError, Jacobian, Observable, Place, Signal, jacobian};
use crate::parameters::{Parameter, Parameters};

/// The pulses of a signal that belong to turns of data, each turn with the time near which its pulse was seen. Turns are counted as the data
/// count them: the pulse nearest to the first of them has its turn.
fn events_as_counted(signal: &Signal, turns: &BTreeMap<i64, f64>) -> Result<Vec<Event>, InferenceError> {
    let Some((&turn, &near)) = turns.iter().min_by(|a, b| a.1.total_cmp(b.1)) else { return Ok(Vec::new()) };
    let mut events = signal.events()?;
    let distance = |event: &&Event| (event.midpoint() - near).abs();
    let nearest = events.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let shift = turn - nearest.ok_or(InferenceError::NoPulse { turn, near })?.turn;
    events.iter_mut().for_each(|event| event.turn += shift);
    Ok(events)
}

/// The data that a star has, less those measured, in standard deviations; and its pulses.
fn compared(parameters: &Parameters<f64>, data: &[Datum], end: f64) -> Result<(Vec<f64>, Vec<Event>), InferenceError> {
    let turn = std::f64::consts::TAU / turning_rate(parameters);
    let signal = Signal::new(parameters, end + 2.0 * turn)?;
    let of_pulses = data.iter().filter_map(|datum| match datum.place {
        Place::Turn { number, near } => Some((number, near)),
        Place::Time(_) => None,
    });
    let turns: BTreeMap<i64, f64> = of_pulses.collect();
    let events = if signal.is_long {
        signal.events_of_turns(&turns.into_iter().collect::<Vec<_>>())?
    } else {
        events_as_counted(&signal, &turns)?
    };
    let find = |turn: i64| events.binary_search_by_key(&turn, |event| event.turn).ok().map(|place| events[place]);
    let compare = |datum: &Datum| {
        let value = match datum.place {
            Place::Time(t) => signal.strain(datum.observable, t)?,
            Place::Turn { number, near } => {
                let event = find(number);
                let value = event.and_then(|event| event.value(find(number - 1).as_ref(), datum.observable));
                let value = value.ok_or(InferenceError::NoPulse { turn: number, near })?;
                let is_time = matches!(datum.observable, Observable::Arrivals | Observable::ClosestApproaches);
                let epoch = event.map_or(0.0, |event| event.epoch);
                if is_time { (epoch - datum.epoch) + value } else { value }
            }
        };
        Ok((value - datum.value) / datum.sigma)
    };
    Ok((data.iter().map(compare).collect::<Result<_, InferenceError>>()?, events))
}

/// Data of a star over the time to `end`.
struct DataOfStar<'a> {
    data: &'a [Datum],
    end: f64,
}

impl Comparison<Parameters<f64>> for DataOfStar<'_> {
    fn len(&self) -> usize {
        self.data.len()
    }

    fn residuals(&self, parameters: &Parameters<f64>) -> Result<Vec<f64>, InferenceError> {
        Ok(compared(parameters, self.data, self.end)?.0)
    }

    fn linearised(
        &self,
        parameters: &Parameters<f64>,
        unknowns: &[Parameter],
    ) -> Result<(Vec<f64>, Jacobian), InferenceError> {
        let (residuals, events) = compared(parameters, self.data, self.end)?;
        Ok((residuals, jacobian(parameters, &events, self.data, unknowns)?.weighted(self.data)))
    }

    fn rounding(&self, found: &Fit) -> Result<Option<InferenceError>, InferenceError> {
        let of_all = rounding_of_all(found, self.data, self.end)?;
        Ok(of_all.map(|(observable, rounding)| InferenceError::Rounding { observable, rounding }))
    }
}

/// The fit of `unknowns` to `data` from a start, over the time to `end`.
///
/// The unknowns move in units of their standard deviations at the start. A trial step to a star without the pulses of the data is
/// rejected. The minimum is the one that the start leads to: its pulses must be those of the data to less than half a turn at the first
/// datum, and its phase well known over the whole span.
///
/// # Errors
/// [`InferenceError::Degenerate`] for data that do not determine the unknowns, at the start or at the minimum; for others see
/// [`InferenceError`].
pub fn fit(start: &Parameters<f64>, data: &[Datum], unknowns: &[Parameter], end: f64) -> Result<Fit, InferenceError> {
    least_squares(start, &DataOfStar { data, end }, unknowns)
}

/// How far `chi^2` is from the parabola that error bars stand for: the largest of `|chi^2 - chi^2_min - 1|` one standard deviation
/// up and down each principal axis of the correlations. Where it is well below one, the error bars hold. It takes two motions for each unknown.
///
/// # Errors
/// Parameters there of a star that has no such data.
pub fn nonlinearity(fisher: &Fisher, data: &[Datum], end: f64) -> Result<f64, InferenceError> {
    least_squares::nonlinearity(fisher, &DataOfStar { data, end })
}

/// If every residual is as small as the rounding of the model: the kind of data with the smallest errors against it, and that rounding.
fn rounding_of_all(fit: &Fit, data: &[Datum], end: f64) -> Result<Option<(Observable, f64)>, InferenceError> {
    let signal = Signal::new(&fit.fisher.parameters, end)?;
    let of_kinds: BTreeMap<Observable, f64> =
        data.iter().map(|datum| datum.observable).map(|kind| (kind, signal.rounding(kind))).collect();
    let rounding = |datum: &Datum| of_kinds[&datum.observable];
    if data.iter().zip(&fit.residuals).any(|(datum, residual)| residual.abs() * datum.sigma > rounding(datum)) {
        return Ok(None);
    }
    let finest = data.iter().max_by(|a, b| (rounding(a) / a.sigma).total_cmp(&(rounding(b) / b.sigma)));
    Ok(finest.map(|datum| (datum.observable, rounding(datum))))
}
