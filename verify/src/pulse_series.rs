//! The paper's series of pulse periods and durations, compared with its curves. Eqs. (44), (47), (51), (52), (56).

use crate::prelude::*;
use twofold::observables::pulsar::Pulse;

/// Series of the complete pulses of a motion.
#[derive(Debug, Clone)]
pub struct PulseSeries {
    /// Times between pulses of consecutive single turns, each at the mean of the two midpoints.
    pub periods: Vec<Stamped>,
    /// Other times between pulses: over turns without a pulse, within one turn, to or from a pulse longer than a turn.
    pub gaps: Vec<Stamped>,
    /// Durations, at the midpoints.
    pub lengths: Vec<Stamped>,
}

/// The series for a beam in a span of a motion. Turns are counted as in [`arrivals`].
pub fn pulse_series(
    motion: &impl Motion<f64, State = BodyState<f64>>,
    beam: &Beam<f64>,
    line_of_sight: &Vector3<f64>,
    span: (f64, f64),
) -> Result<PulseSeries, Error> {
    let train = pulse_train(motion, beam, line_of_sight, span)?;
    let numbers = arrivals(motion, beam, line_of_sight, &train)?;
    let mean_turn = match (&numbers[..], numbers.last()) {
        ([first, ..], Some(last)) => (last.midpoint - first.midpoint) / (last.number - first.number) as f64,
        _ => f64::NAN,
    };
    // The middle of a pulse longer than a turn belongs to no turn.
    let of_one_turn = |pulse: &Pulse| pulse.duration() < mean_turn;
    // Only the first and the last pulse can be cut. The complete ones, which have numbers, are neighbours.
    let whole: Vec<_> = train.pulses.iter().filter(|pulse| pulse.is_whole()).zip(&numbers).collect();
    let single = whole
        .windows(2)
        .map(|pair| pair[1].1.number - pair[0].1.number == 1 && pair.iter().all(|(pulse, _)| of_one_turn(pulse)));
    let intervals: Vec<_> = train.periods().zip(single).collect();
    let chosen = |wanted: bool| {
        let chosen = intervals.iter().filter(|(_, single)| *single == wanted);
        chosen.map(|(interval, _)| *interval).collect()
    };
    Ok(PulseSeries { periods: chosen(true), gaps: chosen(false), lengths: train.durations().collect() })
}

/// Beam and observer as they enter the formulas.
#[derive(Debug, Clone, Copy)]
pub struct Viewing {
    /// Angle of the magnetic axis to the symmetry axis.
    pub chi: f64,
    /// Its azimuth in the body.
    pub delta: f64,
    /// Half opening angle of the beam.
    pub rho: f64,
    /// Colatitude of the observer.
    pub theta_o: f64,
}

/// The results of the formulas at a time.
#[derive(Debug, Clone, Copy)]
pub struct Formulas {
    /// `DeltaPhi'`, Eq. (52).
    pub offset_rate: f64,
    /// `alpha' + DeltaPhi'`.
    pub azimuth_rate: f64,
    /// `W`, Eq. (56): zero without a pulse, 2 pi for a beam that is always on.
    pub width: f64,
}

impl Viewing {
    /// The formulas for angles `[beta, gamma]` and rates `[alpha', gamma']`.
    pub fn formulas(&self, [beta, gamma]: [f64; 2], [alpha_rate, gamma_rate]: [f64; 2]) -> Result<Formulas, Error> {
        let offset_rate = azimuth_offset_rate(beta, gamma, gamma_rate, self.chi, self.delta);
        let theta = cosine_of_colatitude(beta, gamma, self.chi, self.delta).acos();
        let width = pulse_width(self.rho, theta, self.theta_o).angle();
        Ok(Formulas { offset_rate, azimuth_rate: alpha_rate + offset_rate, width })
    }

    /// The formulas for the angles and rates of a motion at a time.
    fn at(&self, motion: &impl Motion<f64, State = BodyState<f64>>, t: f64) -> Result<Formulas, Error> {
        let state = motion.state(t)?;
        let (angles, rates) = (state.angles()?, state.rates(motion.spheroid())?);
        self.formulas([angles.beta, angles.gamma], [rates.alpha, rates.gamma])
    }
}

/// The paper's curves for a motion: period `2 pi / (alpha' + DeltaPhi')`, Eq. (51) before the expansion, and width (56), with the
/// angles and rates of the numerical motion at each time. As in the authors' data, the mean of `alpha' + DeltaPhi'` converts a
/// width into a time.
pub struct PaperCurves<'m, M> {
    motion: &'m M,
    viewing: Viewing,
    mean_rate: f64,
}

impl<'m, M: Motion<f64, State = BodyState<f64>>> PaperCurves<'m, M> {
    /// The curves from time zero to `end`.
    pub fn new(motion: &'m M, viewing: Viewing, end: f64) -> Result<Self, Error> {
        // About ten samples per radian: more than the mean needs.
        let count = (10.0 * end.abs()).ceil() as usize;
        let mut sum = 0.0;
        for i in 0..=count {
            let weight = if i == 0 || i == count { 0.5 } else { 1.0 };
            sum += viewing.at(motion, end * i as f64 / count as f64)?.azimuth_rate * weight;
        }
        Ok(Self { motion, viewing, mean_rate: sum / count as f64 })
    }

    /// Period and duration at a time.
    pub fn at(&self, t: f64) -> Result<[f64; 2], Error> {
        let formulas = self.viewing.at(self.motion, t)?;
        Ok([instantaneous_period(formulas.azimuth_rate), formulas.width / self.mean_rate])
    }
}
