//! The fit of a star, its beam and its observer to data.

use std::collections::BTreeMap;

use super::least_squares::{self, Comparison, Fit, least_squares};
use super::signal::turning_rate;
use super::{Datum, Event, Fisher, InferenceError, Jacobian, Observable, Place, Signal, jacobian};
use crate::parameters::{Parameter, Parameters};

/// The pulses of a signal in the turns of the data; each turn is given with the approximate time of its pulse. Turns are numbered as in
/// the data: the pulse nearest to the first of these times gets the number of that turn.
fn events_as_counted(signal: &Signal, turns: &BTreeMap<i64, f64>) -> Result<Vec<Event>, InferenceError> {
    let Some((&turn, &near)) = turns.iter().min_by(|a, b| a.1.total_cmp(b.1)) else { return Ok(Vec::new()) };
    let mut events = signal.events()?;
    let distance = |event: &&Event| (event.midpoint() - near).abs();
    let nearest = events.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let shift = turn - nearest.ok_or(InferenceError::NoPulse { turn, near })?.turn;
    events.iter_mut().for_each(|event| event.turn += shift);
    Ok(events)
}

/// Residuals (data of the star minus measured data, in standard deviations) and the pulses of the star.
fn compared(parameters: &Parameters<f64>, data: &[Datum], end: f64) -> Result<(Vec<f64>, Vec<Event>), InferenceError> {
    let of_pulses = data.iter().filter_map(|datum| match datum.place {
        Place::Turn { number, near } => Some((number, near)),
        Place::Time(_) => None,
    });
    let turns: BTreeMap<i64, f64> = of_pulses.collect();
    // A pulse may come two turns late; a star at rest has an infinite turn, and strains.
    let late = if turns.is_empty() { 0.0 } else { 2.0 * std::f64::consts::TAU / turning_rate(parameters) };
    let signal = Signal::new(parameters, end + late)?;
    let events = if signal.is_long {
        signal.events_of_turns(&turns.into_iter().collect::<Vec<_>>())?
    } else {
        events_as_counted(&signal, &turns)?
    };
    let of_turn: BTreeMap<i64, Event> = events.iter().map(|event| (event.turn, *event)).collect();
    let compare = |datum: &Datum| {
        let value = match datum.place {
            Place::Time(t) => signal.strain(datum.observable, t)?,
            Place::Turn { number, near } => {
                let missing = InferenceError::NoPulse { turn: number, near };
                let event = of_turn.get(&number).ok_or_else(|| missing.clone())?;
                let value = event.value(of_turn.get(&(number - 1)), datum.observable).ok_or(missing)?;
                let is_time = matches!(datum.observable, Observable::Arrivals | Observable::ClosestApproaches);
                if is_time { (event.epoch - datum.epoch) + value } else { value }
            }
        };
        Ok((value - datum.value) / datum.sigma)
    };
    Ok((data.iter().map(compare).collect::<Result<_, InferenceError>>()?, events))
}

/// Data of a star from its start to the time `end`.
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

/// Fits `unknowns` to `data` from a starting model, over the time to `end`.
///
/// The unknowns are stepped in units of their standard deviations at the start. A trial step to a star without the pulses of the data
/// is rejected. The minimum found is the one that the start leads to: the pulses of the start must agree with those of the data to less
/// than half a turn at the first datum, and its phase must be well known over the whole span.
///
/// # Errors
/// [`InferenceError::Degenerate`] for data that do not determine the unknowns, at the start or at the minimum; for the others
/// see [`InferenceError`].
pub fn fit(start: &Parameters<f64>, data: &[Datum], unknowns: &[Parameter], end: f64) -> Result<Fit, InferenceError> {
    least_squares(start, &DataOfStar { data, end }, unknowns)
}

/// Departure of `chi^2` from the parabola that error bars assume: the largest of `|chi^2 - chi^2_min - 1|` one standard deviation up and down
/// each principal axis of the correlations. Error bars are reliable where this is well below one. Two motions are computed for each unknown.
///
/// # Errors
/// The displaced parameters belong to a star that lacks some of the data.
pub fn nonlinearity(fisher: &Fisher, data: &[Datum], end: f64) -> Result<f64, InferenceError> {
    least_squares::nonlinearity(fisher, &DataOfStar { data, end })
}

/// If every residual is as small as the rounding of the model, returns the kind of data with the smallest errors relative to rounding,
/// and that rounding.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::{Residuals, data_of, stars};
    use crate::parameters::ThirdRate;

    const OF_PULSES: [(Observable, f64); 4] = [
        (Observable::Arrivals, 1e-6),
        (Observable::ClosestApproaches, 2e-6),
        (Observable::Widths, 3e-6),
        (Observable::Periods, 4e-6),
    ];

    /// Data of a star up to a time, without errors: seven pulses, starting with the second, and the strain at two times.
    fn data(star: &Parameters<f64>, end: f64) -> Vec<Datum> {
        let signal = Signal::new(star, end).expect("a motion");
        let noise = [&OF_PULSES[..], &[(Observable::StrainPlus, 1e-3), (Observable::StrainCross, 1e-3)]].concat();
        data_of(&signal, &signal.events().expect("pulses")[1..8], &[3.0, 17.0], &noise).expect("data")
    }

    #[test]
    fn a_star_has_no_residuals_however_its_turns_are_counted() {
        let star = stars::precessing();
        let mut data = data(&star, 60.0);
        assert!(OF_PULSES.iter().all(|(kind, _)| data.iter().filter(|datum| datum.observable == *kind).count() > 3));
        assert!(data.iter().all(|datum| datum.epoch == 0.0));
        for _ in 0..2 {
            let (residuals, _) = compared(&star, &data, 60.0).expect("the same star");
            assert_eq!(residuals.len(), data.len());
            assert!(residuals.iter().all(|residual| residual.abs() < 1e-6), "{residuals:?}");
            for datum in &mut data {
                if let Place::Turn { number, .. } = &mut datum.place {
                    *number += 1000;
                }
            }
        }
    }

    /// The residuals are those of a star that turns a little slower: its data, found separately, minus the measured ones.
    #[test]
    fn residuals_are_the_data_of_the_model_less_those_measured() {
        let star = stars::precessing();
        let slower = star.moved(&[Parameter::AlphaRate, Parameter::Strain], &[-1e-3, 0.25]);
        let (measured, expected) = (data(&star, 60.0), data(&slower, 60.0));
        assert_eq!(measured.len(), expected.len());
        let (residuals, _) = compared(&slower, &measured, 60.0).expect("a star with these pulses");
        for ((residual, datum), of_slower) in residuals.iter().zip(&measured).zip(&expected) {
            let difference = (of_slower.value - datum.value) / datum.sigma;
            assert!((residual - difference).abs() < 1e-6 + 1e-9 * difference.abs(), "{datum:?}: {residual}");
            assert!(difference != 0.0, "{datum:?}");
        }
    }

    /// Pulses are searched for up to two turns after the last datum, so that those of a slower star are found: here the last comes 0.8 turns
    /// late.
    #[test]
    fn late_pulses_are_found_after_the_last_datum() {
        let star = stars::slow();
        let turn = std::f64::consts::TAU / turning_rate(&star);
        let signal = Signal::new(&star, 16.0 * turn).expect("a motion");
        let events = signal.events().expect("pulses");
        let (first, last) = (events[1], events[events.len() - 1]);
        let data = data_of(&signal, &[first, last], &[], &OF_PULSES[..1]).expect("data");
        let turns = (last.turn - first.turn) as f64;
        let rate = -star.alpha_rate * 0.8 / (turns + 0.8);
        let slower =
            star.moved(&[Parameter::AlphaRate, Parameter::Spin], &[rate, star.spin() * rate / star.alpha_rate]);
        let (residuals, found) = compared(&slower, &data, last.end).expect("late pulses");
        let late = residuals[1] * 1e-6 / turn;
        assert!((0.6..1.1).contains(&late), "{late} turns");
        assert!(found.iter().any(|event| event.turn == last.turn && event.start > last.end));
        // A pulse that would come 2.6 turns late is not found.
        let rate = -star.alpha_rate * 2.6 / (turns + 2.6);
        let slower =
            star.moved(&[Parameter::AlphaRate, Parameter::Spin], &[rate, star.spin() * rate / star.alpha_rate]);
        let told = compared(&slower, &data, last.end).expect_err("beyond two turns");
        assert!(matches!(told, InferenceError::NoPulse { turn, .. } if turn == last.turn), "{told:?}");
    }

    #[test]
    fn strains_of_a_star_at_rest_are_fitted() {
        let star =
            Parameters { alpha_rate: 0.0, beta_rate: 0.0, third_rate: ThirdRate::Spin(0.0), ..stars::precessing() };
        let signal = Signal::new(&star, 20.0).expect("a motion");
        let data = data_of(&signal, &[], &[0.0, 7.0, 13.0, 20.0], &[(Observable::StrainPlus, 1e-4)]).expect("data");
        let unknowns = [Parameter::Oblateness, Parameter::Beta];
        let found = fit(&star.moved(&unknowns, &[1e-5, -1e-5]), &data, &unknowns, 20.0).expect("a fit");
        let errors: Vec<f64> = found.fisher.values().iter().zip(star.values(&unknowns)).map(|(a, b)| a - b).collect();
        assert!(
            errors.iter().zip(found.fisher.sigmas()).all(|(error, sigma)| error.abs() < 0.01 * sigma),
            "{errors:?}"
        );
    }

    #[test]
    fn data_of_turns_without_a_pulse_are_told() {
        let star = stars::precessing();
        let mut data = data(&star, 60.0);
        let missing = data.len();
        data.push(Datum { place: Place::Turn { number: 999, near: 12.5 }, ..data[0] });
        let told = compared(&star, &data, 60.0).expect_err("no such turn");
        assert_eq!(told, InferenceError::NoPulse { turn: 999, near: 12.5 });
        // A period requires the previous pulse too.
        let first = Signal::new(&star, 60.0).expect("a motion").events().expect("pulses")[0];
        let of_first = Place::Turn { number: first.turn, near: first.midpoint() };
        data[missing] = Datum { observable: Observable::Periods, place: of_first, ..data[0] };
        let told = compared(&star, &data, 60.0).expect_err("no pulse before");
        assert_eq!(told, InferenceError::NoPulse { turn: first.turn, near: first.midpoint() });
    }

    /// If the errors are far below what doubles can resolve, the error names the kind of data with the smallest stated
    /// errors relative to rounding.
    #[test]
    fn a_fit_of_rounding_is_refused() {
        let star = stars::precessing();
        let signal = Signal::new(&star, 30.0).expect("a motion");
        let events = signal.events().expect("pulses");
        let of = |noise: &[(Observable, f64)], off: f64| {
            let mut data = data_of(&signal, &events, &[3.0, 17.0], noise).expect("data");
            data.iter_mut().enumerate().for_each(|(k, datum)| datum.value += if k % 2 == 0 { off } else { -off });
            fit(&star, &data, &[Parameter::Spin, Parameter::Oblateness], 30.0)
        };
        let rounding = signal.rounding(Observable::Arrivals);
        for (noise, finest) in [
            ([(Observable::Arrivals, 1e-19), (Observable::Widths, 1e-18)], Observable::Arrivals),
            ([(Observable::Arrivals, 1e-18), (Observable::Widths, 1e-19)], Observable::Widths),
        ] {
            match of(&noise, 0.3 * rounding) {
                Err(InferenceError::Rounding { observable, rounding: told }) => {
                    assert_eq!(observable, finest);
                    assert!((told / rounding - 1.0).abs() < 0.1, "{told:e} {rounding:e}");
                }
                other => panic!("{other:?}"),
            }
        }
        // Errors twenty times as large are not rounding.
        match of(&[(Observable::Arrivals, 1e-19), (Observable::Widths, 1e-18)], 20.0 * rounding) {
            Ok(found) => assert_eq!(found.consistency(), Residuals::Larger),
            Err(error) => assert!(
                matches!(error, InferenceError::NotConverged { .. } | InferenceError::Coarse { .. }),
                "{error:?}"
            ),
        }
    }

    /// Over a span too long to be followed turn by turn, pulses are found by their numbers, and their times are sums of two
    /// doubles.
    #[test]
    fn long_spans_have_residuals_in_two_doubles() {
        let star = stars::weak();
        let signal = Signal::new(&star, 3e6).expect("a motion");
        assert!(signal.is_long());
        let wanted = [10.0, 2e6, 2.9e6];
        let events = signal.events_after(&wanted).expect("pulses");
        let data =
            data_of(&signal, &events, &[], &[(Observable::Arrivals, 1e-9), (Observable::Widths, 1e-9)]).expect("data");
        for ((datum, event), time) in data.iter().zip(events.iter().cycle()).zip(wanted.iter().cycle()) {
            assert_eq!(datum.epoch, if datum.observable == Observable::Arrivals { event.epoch } else { 0.0 });
            let Place::Turn { number, near } = datum.place else { panic!("{datum:?}") };
            assert!(number == event.turn && (near - time).abs() < 20.0, "{datum:?} near {time:e}");
        }
        let (residuals, _) = compared(&star, &data, 3e6).expect("the same star");
        assert!(residuals.iter().all(|residual| residual.abs() < 1e-2), "{residuals:?}");
        // An observer at another azimuth sees the pulses earlier or later by less than a turn; the residuals show it although the epochs differ too.
        let turned = star.moved(&[Parameter::PhiO], &[0.2]);
        let (residuals, found) = compared(&turned, &data, 3e6).expect("pulses of the same numbers");
        for ((residual, event), before) in residuals.iter().zip(&found).zip(&events) {
            let late = (event.epoch - before.epoch) + (event.midpoint() - before.midpoint());
            assert!(
                event.epoch != before.epoch && (residual * 1e-9 - late).abs() < 1e-15 + 1e-12 * late.abs(),
                "{residual} {late}"
            );
        }
    }
}
