//! The same pulse train from every way of evaluating the magnetic axis. Eq. (44).

use twofold::observables::pulsar::PulseTrain;

use super::cases::{Case, edges, worst_over_random_cases};
use crate::given_states::GivenStates;
use crate::prelude::*;

checks! {
    /// the pulses of 600 random trains are the same from the series of the motion and from its states
    Property "pulse-train-ways" [44]: ways_agree;
    AtMost(1e-13) "largest difference of an edge times the slope of m.n; infinite for a wrong number";
    because "the same roots from other brackets: rounding of t up to 20 t_c, 4e-15, and of m.n over its slope";
    /// m.n and its first three time derivatives from the series of a motion are those from its states, in whatever order the times are evaluated
    Property "series-projection" [44]: projection_against_states;
    AtMost(8.0) "largest difference / (2.2e-16 (4 + t |Omega|), power of 1 + |Omega|), 25 times of 600 random trains; infinite if not the same";
    because "some roundings of vectors and, for the third angle, of t times its rate; each derivative adds products";
}

const END: f64 = 20.0;

fn ways_agree() -> Result<Measured, String> {
    worst_over_random_cases(48, 300, (END, 1e-14), |case| {
        let Case { motion, beam, observer, .. } = case;
        let by_series = case.train()?;
        let by_states = pulse_train(&GivenStates::like(motion, |t| motion.state(t)), beam, observer, (0.0, END))?;
        let cut = |train: &PulseTrain| train.pulses.iter().map(|p| (p.cut_at_start, p.cut_at_end)).collect::<Vec<_>>();
        let same = cut(&by_series) == cut(&by_states);
        Ok(if same { case.difference_of_edges(&edges(&by_series), &edges(&by_states)) } else { f64::INFINITY })
    })
}

fn projection_against_states() -> Result<Measured, String> {
    worst_over_random_cases(49, 300, (END, 1e-15), |case| {
        // On a processor without vector instructions there is nothing to compare.
        let Some(projection) = case.motion.projection(&case.beam.axis, &case.observer) else { return Ok(None) };
        let edge = case.beam.half_opening.cos();
        // Times out of order, so that earlier steps are found, too. In order, every digit is the same.
        let times = (0..25_u32).map(|i| 0.3 + 0.8 * f64::from((7 * i) % 25));
        let looks = times.map(|t| projection.at(t).map(|look| (t, look))).collect::<Result<Vec<_>, _>>()?;
        let mut in_order = looks.clone();
        in_order.sort_by(|a, b| a.0.total_cmp(&b.0));
        if in_order.iter().any(|(t, look)| projection.at(*t).ok() != Some(*look)) {
            return Ok(Some(f64::INFINITY));
        }
        largest_if_any(looks.into_iter().map(|(t, mut by_series)| {
            let by_states = case.margin(t);
            by_series[0] -= edge;
            let turning = case.turning(&case.motion.state(t)?);
            let scale = |k: i32| f64::EPSILON * (4.0 + t * turning) * (1.0 + turning).powi(k);
            Ok(largest((0..4).map(|k| (by_series[k] - by_states[k]).abs() / scale(k as i32))))
        }))
    })
}
