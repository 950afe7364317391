//! The numbers of a file, recomputed at its times.

use twofold::Error;
use twofold::dynamics::{Problem, RotationState};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::wave_of_state;
use twofold::observables::pulsar::direction::magnetic_axis_direction;
use twofold::observables::pulsar::period::{azimuth_offset_rate, instantaneous_period};
use twofold::observables::pulsar::width::pulse_width;
use twofold::observables::pulsar::{Beam, PulseTrain, pulse_train};
use twofold::propagation::{ContinuousAngles, Motion, TaylorMotion};
use twofold::solutions::perturbation::{Form, Perturbation};

use super::table::Table;
use twofold_verify::check::largest;
use twofold_verify::paper_examples::{COEFFICIENTS, PaperExample, SPIN, spheroid};

/// Truncation error requested for a motion.
const TOLERANCE: f64 = 1e-14;

// The paper's observer and beam, with phi_o = delta = 0.
const THETA_O: f64 = 0.8;
const CHI: f64 = 0.5;
const RHO: f64 = 0.6;

fn observer() -> Observer<f64> {
    Observer::at(THETA_O, 0.0)
}

fn beam() -> Beam<f64> {
    Beam::new(CHI, 0.0, RHO)
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    angles: EulerAngles<f64>,
    rates: EulerRates<f64>,
}

impl Start {
    /// Start from alpha, beta and their rates, with gamma = 0 and Eq. (24).
    fn new(alpha: f64, beta: f64, alpha_rate: f64, beta_rate: f64) -> Self {
        let rates = EulerRates { alpha: alpha_rate, beta: beta_rate, gamma: SPIN - alpha_rate * beta.cos() };
        Self { angles: EulerAngles { alpha, beta, gamma: 0.0 }, rates }
    }

    /// The initial values of an example, Eq. (34).
    pub(super) fn of(example: &PaperExample) -> Result<Self, Error> {
        let start = example.initial_values()?;
        Ok(Self::new(start.alpha, start.beta, start.alpha_rate, start.beta_rate))
    }

    /// The same with beta and alpha' as in the caption of the figure, rounded to three decimals.
    pub(super) fn of_caption(example: &PaperExample) -> Result<Self, Error> {
        let start = example.initial_values()?;
        let rounded = |x: f64| (x * 1e3).round() / 1e3;
        Ok(Self::new(start.alpha, rounded(start.beta), rounded(start.alpha_rate), rounded(start.beta_rate)))
    }

    fn motion(&self, until: f64) -> Result<TaylorMotion<f64>, Error> {
        let problem = Problem::from_angles(spheroid(), COEFFICIENTS.tensor(), &self.angles, &self.rates)?;
        problem.taylor((0.0, until), TOLERANCE)
    }
}

/// Largest values in a motion of what determines the errors of the body axes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Scales {
    pub(super) duration: f64,
    pub(super) sin_beta: f64,
    pub(super) cos_beta: f64,
    pub(super) alpha_rate: f64,
    pub(super) beta_rate: f64,
    /// Largest phase in Eq. (33), rad; for the homogeneous solution multiplied by its amplitude.
    pub(super) phase: f64,
}

/// Rows of `tp1.dat` and similar files.
pub(super) fn angles(example: &PaperExample, table: &Table) -> Result<(Vec<Vec<f64>>, Scales), Error> {
    let start = Start::of(example)?;
    let motion = start.motion(table.last_time())?;
    let printed = Perturbation::new(Form::Printed, example.kind, &spheroid(), &COEFFICIENTS, SPIN, &example.constants)?;
    let mut continuous = ContinuousAngles::new(&motion, 0.0, &start.angles)?;
    let duration = table.last_time();
    let oscillation = example.constants.amplitude * (1.0 + printed.homogeneous_ratio.abs());
    let phase = example.constants.alpha_0.abs() + (printed.rate.abs() + oscillation) * duration;
    let mut scales = Scales { duration, phase, ..Scales::default() };
    let mut row = |t: f64| -> Result<Vec<f64>, Error> {
        let (angles, state, approximate) = (continuous.at(t)?, motion.state(t)?, printed.at(t));
        let rates = state.rates(motion.spheroid())?;
        let (sin, cos) = angles.beta.sin_cos();
        scales.sin_beta = largest([scales.sin_beta, sin]);
        scales.cos_beta = largest([scales.cos_beta, cos.abs()]);
        scales.alpha_rate = largest([scales.alpha_rate, rates.alpha.abs()]);
        scales.beta_rate = largest([scales.beta_rate, rates.beta.abs()]);
        let mut row = vec![angles.alpha, approximate.alpha, angles.beta, approximate.beta];
        row.extend(state.equatorial_axis.iter().chain(state.axis.iter()));
        Ok(row)
    };
    let rows = table.times().map(&mut row).collect::<Result<_, _>>()?;
    Ok((rows, scales))
}

/// Rows of `mntp1.dat` and similar files. The second column is the instantaneous period of Eqs. (51), (52). The third is
/// the instantaneous width of Eq. (56), zero without a pulse, over the time average of the rate behind that period.
pub(super) fn signal(example: &PaperExample, table: &Table) -> Result<Vec<Vec<f64>>, Error> {
    let start = Start::of(example)?;
    let motion = start.motion(table.last_time())?;
    let (beam, observer, body) = (beam(), observer(), spheroid());
    let mut rows = Vec::with_capacity(table.rows.len());
    let mut rates = Vec::with_capacity(table.rows.len());
    for t in table.times() {
        let state = motion.state(t)?;
        let (angles, euler_rates) = (state.angles()?, state.rates(&body)?);
        let offset_rate = azimuth_offset_rate(angles.beta, angles.gamma, euler_rates.gamma, CHI, 0.0);
        let rate = euler_rates.alpha + offset_rate;
        let (theta, _) = magnetic_axis_direction(&angles, CHI, 0.0)?;
        let width = pulse_width(RHO, theta, THETA_O).angle();
        rows.push(vec![beam.direction(&state).dot(&observer.direction), instantaneous_period(rate), width]);
        rates.push((t, rate));
    }
    let mean = mean_in_time(&rates);
    for row in &mut rows {
        row[2] /= mean;
    }
    Ok(rows)
}

/// Time average of a series by the trapezoidal rule.
fn mean_in_time(series: &[(f64, f64)]) -> f64 {
    let integral: f64 = series.windows(2).map(|pair| (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1) / 2.0).sum();
    match (series.first(), series.last()) {
        (Some(first), Some(last)) if last.0 > first.0 => integral / (last.0 - first.0),
        (Some(first), _) => first.1,
        _ => f64::NAN,
    }
}

/// Rows of `gwtp1.dat` and similar files, with r = 1.
pub(super) fn waves(example: &PaperExample, table: &Table) -> Result<Vec<Vec<f64>>, Error> {
    let motion = Start::of(example)?.motion(table.last_time())?;
    let (observer, body, s) = (observer(), spheroid(), COEFFICIENTS.tensor());
    let row = |t: f64| {
        let state = motion.state(t)?;
        let h = wave_of_state(&body, &s, &state.axis_state(), &observer);
        Ok(vec![h.plus, h.cross])
    };
    table.times().map(row).collect()
}

/// The pulses of a start, up to a few turns after the last stamp of the table, and the slowest rate of `m.n` at an edge.
pub(super) fn train(start: &Start, table: &Table) -> Result<(PulseTrain, f64), Error> {
    let until = table.last_time() + 20.0;
    let (motion, beam, n) = (start.motion(until)?, beam(), observer().direction);
    let train = pulse_train(&motion, &beam, &n, (0.0, until))?;
    let mut slowest = f64::INFINITY;
    for pulse in train.pulses.iter().filter(|pulse| pulse.is_whole()) {
        for edge in [pulse.start, pulse.end] {
            let [_, rate, ..] =
                beam.margin_rates(motion.spheroid(), motion.coefficients(), 0.0, &motion.state(edge)?, &n);
            slowest = slowest.min(rate.abs());
        }
    }
    Ok((train, slowest))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use twofold::dynamics::BodyState;
    use twofold::solutions::perturbation::Constants;

    use super::*;
    use twofold_verify::paper_examples::paper_examples;

    /// The period is a turn over the rate of the azimuth of `m` at constant beta, here from a difference quotient along the motion. The pulse ends
    /// where the triangle of `m`, `n` and Z on the sphere has the side `rho`; this angle becomes a time by division by the mean of that rate.
    #[test]
    fn periods_and_widths_are_those_of_the_azimuth_of_the_magnetic_axis() {
        let [example, ..] = paper_examples();
        // Steps grow: the mean over rows is not that over time.
        let times: Vec<f64> = (0..=2000).map(|k| 0.1 + 25.0 * (f64::from(k) / 2000.0).powi(2)).collect();
        let last = times[2000];
        let table = Table { rows: times.iter().map(|t| vec![*t]).collect() };
        let found = signal(&example, &table).unwrap();
        let motion = Start::of(&example).unwrap().motion(last + 1.0).unwrap();
        let angles = |t: f64| motion.state(t).unwrap().angles().unwrap();
        let axis = |angles: EulerAngles<f64>| {
            let rates = EulerRates { alpha: 0.0, beta: 0.0, gamma: 0.0 };
            beam().direction(&BodyState::from_angles(&spheroid(), &angles, &rates))
        };
        let rate = |t: f64| {
            let beta = angles(t).beta;
            let step = 1e-4;
            let [a, b] = [t - step, t + step].map(|t| axis(EulerAngles { beta, ..angles(t) }));
            (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y) / (2.0 * step)
        };
        let mean = (0..1000).map(|k| rate(0.1 + 25.0 * (f64::from(k) + 0.5) / 1000.0)).sum::<f64>() / 1000.0;
        let mut pulsed = 0;
        for (row, t) in found.iter().zip(times) {
            // The error of the quotient is 1e-8 / 6 of the third derivative.
            let period = TAU / rate(t);
            assert!((row[1] / period - 1.0).abs() < 1e-6, "t = {t}: {} and {period}", row[1]);
            let beam = axis(angles(t));
            let seen = THETA_O.sin() * beam.x + THETA_O.cos() * beam.z;
            assert!((row[0] - seen).abs() < 1e-12, "t = {t}: {} and {seen}", row[0]);
            let theta = beam.z.acos();
            let half = (RHO.cos() - theta.cos() * THETA_O.cos()) / (theta.sin() * THETA_O.sin());
            // acos is 0 above 1 and pi below -1; means in steps of up to 0.025 have an error of second order.
            let width = 2.0 * half.clamp(-1.0, 1.0).acos() / mean;
            assert!((row[2] - width).abs() < 1e-4 * width + 1e-12, "t = {t}: {} and {width}", row[2]);
            pulsed += usize::from((0.1..TAU / mean - 0.1).contains(&width));
        }
        assert!(pulsed > 100, "{pulsed}");
    }

    #[test]
    fn a_caption_has_three_decimals_of_the_start() {
        for example in paper_examples() {
            let [exact, caption] = [Start::of(&example).unwrap(), Start::of_caption(&example).unwrap()];
            for (exact, caption) in [
                (exact.angles.beta, caption.angles.beta),
                (exact.rates.alpha, caption.rates.alpha),
                (exact.rates.beta, caption.rates.beta),
            ] {
                assert!((exact - caption).abs() < 5.001e-4, "{}: {exact} {caption}", example.name);
                assert!((1e3 * caption - (1e3 * caption).round()).abs() < 1e-9, "{}: {caption}", example.name);
            }
        }
    }

    /// South of the equator, and with an angle of the other sign.
    #[test]
    fn scales_do_not_depend_on_signs() {
        let [example, ..] = paper_examples();
        let table = Table { rows: (1..=30).map(|k| vec![f64::from(k)]).collect() };
        let of = |alpha_0: f64, beta_0: f64| {
            let constants = Constants { alpha_0, beta_0, ..example.constants };
            angles(&PaperExample { constants, ..example }, &table).unwrap().1
        };
        let Constants { alpha_0, beta_0, .. } = example.constants;
        let north = of(alpha_0, beta_0);
        assert!(alpha_0 > 0.1 && north.cos_beta > 0.1 && of(alpha_0, PI - beta_0).cos_beta > 0.1);
        let [more, less] = [north.phase, of(-alpha_0, beta_0).phase];
        assert!((more / less - 1.0).abs() < 1e-12, "{more} {less}");
    }

    /// At times at which the rate is negative.
    #[test]
    fn the_scale_of_a_rate_is_its_largest_size() {
        let [example, ..] = paper_examples();
        let motion = Start::of(&example).unwrap().motion(30.0).unwrap();
        let rate = |t: f64| motion.state(t).unwrap().rates(&spheroid()).unwrap().beta;
        let times: Vec<f64> = (1..=300).map(|k| 0.1 * f64::from(k)).filter(|t| rate(*t) < 0.0).collect();
        let largest = times.iter().map(|t| -rate(*t)).fold(0.0, f64::max);
        let table = Table { rows: times.iter().map(|t| vec![*t]).collect() };
        let (_, scales) = angles(&example, &table).unwrap();
        // Two motions, each to its tolerance.
        assert!(largest > 1e-3 && (scales.beta_rate / largest - 1.0).abs() < 1e-8, "{scales:?} {largest}");
    }

    #[test]
    fn a_mean_is_over_time_and_not_over_rows() {
        // At uneven times, 1 + 2 t has the mean of its ends.
        let series = [0.5, 1.0, 4.0].map(|t| (t, 1.0 + 2.0 * t));
        assert_eq!(mean_in_time(&series), 5.5);
        assert_eq!(mean_in_time(&[(0.5, 7.0), (1.0, 9.0)]), 8.0);
        assert_eq!(mean_in_time(&[(3.0, 7.0)]), 7.0);
        assert!(mean_in_time(&[]).is_nan());
    }
}
