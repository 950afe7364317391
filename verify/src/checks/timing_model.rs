//! The timing model: phases and widths of pulses, their derivatives, fits and limits.

use twofold::inference::{Model, TimingData, fit_timing, timing_fisher, wobble_limits};
use twofold::observables::pulsar::PulsarClock;
use twofold::observables::pulsar::timing_model::TimingParameter::{self, *};
use twofold::observables::pulsar::timing_model::{TimingModel, Turns};
use twofold::propagation::PhasedMotion;
use twofold::spin_down::Braking;

use super::spin_down::{CHI, LongDipole, beam, long_dipole, problem, sight};
use crate::coverage::{Case, Coverage};
use crate::prelude::*;
use crate::timing_simulation::{YEAR, arrivals_of, widths_of};

checks! {
    /// the phase of the timing model is an integer, the number of the pulse, at the midpoints of the clock's pulses, whose edges are found in the
    /// motion
    Oracle "timing-model-clock" []: of_clock;
    AtMost(1e-9) "largest difference (turns), 642 Hz, 20 years before and after the epoch, wobbles of 1e-6 to 0.6 rad and one of pi - 0.3, periods of 500 and 30 d, with and without torque, n = 3 and 2.5, damped in 200 years and undamped";
    because "between the edges the wobble changes the midpoint by w / (2 pi F0) = 6e-10 of the turn at most; in 8e11 turns 32 digits leave 1e-20 and \
     the delay of up to 10 turns 1e-15";
    /// the same phase compared with the integration of the torque, for a star scaled so that 1,000 precessions can be integrated
    Oracle "timing-model-torque" []: of_torque;
    AtMost(1e-3) "largest difference of phase / delay (rad), wobble 0.3 rad, epsilon = 0.05, 8 % of the rotation lost";
    because "as for `spin-down-residual`: the integrator's 1e-8 rad beside a delay of 5e-5 rad";
    /// every derivative of phase and width is the slope of the function itself
    Autodiff "timing-model-derivatives" []: slopes;
    AtMost(1e-6) "largest relative difference from central differences of sixth order, every parameter, phase and width, 20 random stars at 5 times, half of them with a damped wobble";
    because "differences over 3e-3 of a parameter's scale: rounding 1e-13 over that, and truncation (3e-3)^6 times derivatives of higher order";
    /// widths are those of the clock's pulses
    Oracle "timing-model-widths" []: widths;
    AtMost(1e-8) "largest relative difference from the time between the edges in the motion";
    because "the width is taken at the middle and over the mean rate of turns: right to w / (2 pi F0) = 6e-10, times wobble and slope of the width";
    /// a fit over 15 years finds the true parameters from data without errors, among them F0 to more digits than a double has
    Property "timing-fit-decades" []: decades;
    AtMost(1e-4) "largest (found - true) / standard deviation, 12 fits of 8 parameters to 300 arrivals to 1e-6 s and widths of stars of 2.4 to 642 Hz, begun three standard deviations off";
    because "a fit may end where the remaining gradient moves no unknown by more than a hundredth of its error; without residuals its last step squares that";
    /// error bars of fits with spin-down and torque hold: pulls and chi^2 have the distribution for normal errors
    Property "timing-error-bars" []: error_bars;
    AtMost(4.0) "largest of five scores in standard deviations (parts within one and two, mean pull, both chi^2), 60 simulated pulsars over 10 to 20 years, 9 unknowns";
    because "one of five normal numbers is beyond four in 3e-4 of all seeds";
    /// a small wobble is found by the linear limit at its period, and exceeds no limit
    Property "timing-wobble-limits" []: limits;
    AtMost(1.0) "largest |best / true wobble - 1| / (theta tan chi), chi = 0.5, 1.2 and 1.47, with and without torque, wobbles theta of 3e-5 rad, 400 arrivals";
    because "the neglected terms are of relative size theta, times tan chi";
}

/// A clock of a pulsar with frequency (Hz), wobble and rate of the free precession, in seconds.
fn clock(frequency: f64, wobble: f64, rate: f64, braking: &Braking) -> Result<PulsarClock, String> {
    let of_axis = TAU * frequency + rate;
    let problem = problem(rate / of_axis, wobble, Matrix3::zeros())?;
    let start = BodyState { momentum: problem.initial().momentum * of_axis, ..*problem.initial() };
    let motion = PhasedMotion::new(&problem.starting_from(start)?, 0.0)?;
    // If n is near -L, -n is near L, and the beam is at the angle pi - CHI to -n.
    let theta_o = if wobble > FRAC_PI_2 { PI - 1.1 } else { 1.1 };
    let clock = PulsarClock::new(motion, &Beam::new(CHI, 0.4, 0.9), &Observer::at(theta_o, 0.2))?;
    Ok(clock.braked(braking)?)
}

fn clocks() -> Result<Vec<PulsarClock>, String> {
    let mut found = Vec::new();
    for (days, wobble) in [(500.0, 0.05), (500.0, 0.6), (30.0, 0.05), (30.0, 1e-6), (30.0, PI - 0.3)] {
        let clock = |braking: &Braking| clock(642.0, wobble, TAU / (days * 86_400.0), braking);
        for (rate, index, torque_share) in [(0.0, 3.0, 0.0), (1e-17, 3.0, 1.0), (1e-17, 2.5, 0.5)] {
            found.push(clock(&Braking { rate, index, torque_share })?);
        }
        let dipole = Braking { rate: 1e-17, index: 3.0, torque_share: 1.0 };
        found.push(clock(&dipole)?.damped(1.0 / (200.0 * YEAR))?);
    }
    Ok(found)
}

fn of_clock() -> Result<Measured, String> {
    worst_of(clocks()?, |clock| {
        let model = clock.timing_model()?;
        let mut worst = 0.0_f64;
        for k in -20..=20 {
            let Some(pulse) = clock.pulse_near([f64::from(k) * YEAR, 0.0])? else { return Err("dark".to_owned()) };
            let Turns { whole, fraction } = model.phase(pulse.midpoint)?;
            worst = largest([worst, ((whole - pulse.number) as f64 + fraction).abs()]);
        }
        Ok(worst)
    })
}

fn of_torque() -> Result<Measured, String> {
    let LongDipole { clock, times, states } = long_dipole()?;
    let (model, time) = (clock.timing_model()?, clock.stretched_time());
    let (sight, beam) = (sight(), beam(CHI));
    let late = largest(times.iter().map(|&t| time.delay(t).abs()));
    let off = worst_of(times.iter().zip(states), |(time, state)| {
        let (l, o) = (state.momentum.normalize(), sight.direction);
        let (m, o) = (beam.direction(state), o - l * o.dot(&l));
        let azimuth = l.dot(&o.cross(&m)).atan2(o.dot(&m));
        Ok(wrapped(TAU * model.phase([**time, 0.0])?.fraction - azimuth).abs())
    })?;
    Ok(Measured::new(off.figure / late, format!("delay up to {late:.1e} rad, differences up to {:.1e}", off.figure)))
}

/// A random star with ten turns in a unit of time and parameters large enough for finite differences.
fn random_model(random: &mut Random, is_damped: bool) -> Result<TimingModel, String> {
    let mut within = |from: f64, to: f64| random.within(from, to);
    let parameters = [
        (Phase, within(-0.3, 0.3)),
        (F1, -within(1e-4, 1e-3)),
        (F2, within(0.0, 1e-7)),
        (Wobble, within(0.05, 0.2)),
        (Chi, within(0.9, 1.4)),
        (PrecessionPhase, within(-3.0, 3.0)),
        (PrecessionRate, within(0.1, 0.3)),
        (TorqueShare, within(0.2, 1.0)),
        (Inclination, within(1.0, 1.3)),
        (InclinationRate, within(-1e-4, 1e-4)),
        (Rho, within(0.6, 0.8)),
        (Damping, if is_damped { within(-5e-3, 5e-3) } else { 0.0 }),
    ];
    Ok(TimingModel::new([10.0, 0.0], &parameters)?)
}

fn slopes() -> Result<Measured, String> {
    let mut random = Random::with_seed(23);
    let stars = (0..20).map(|k| random_model(&mut random, k % 2 == 1)).collect::<Result<Vec<_>, _>>()?;
    worst_of(stars, |star| {
        let mut worst = 0.0_f64;
        for t in [-90.0, -7.0, 0.5, 31.0, 100.0] {
            let phase = |model: &TimingModel| {
                let Turns { whole, fraction } = model.phase([t, 0.0])?;
                Ok((whole - star.phase([t, 0.0])?.whole) as f64 + fraction)
            };
            let (_, of_phase) = star.phase_and_derivatives([t, 0.0])?;
            let (_, of_width) = star.width_and_derivatives(t)?;
            for parameter in TimingParameter::ALL {
                let scale = match parameter {
                    F1 => 1e-4,
                    F2 => 1e-6,
                    InclinationRate => 1e-3,
                    PrecessionRate => 3e-3,
                    F0 => 0.1,
                    Damping => 1e-2,
                    _ => 0.3,
                };
                let h = 3e-3 * scale;
                let slope = |of: &dyn Fn(&TimingModel) -> Result<f64, twofold::Error>| -> Result<f64, String> {
                    let at = |k: f64| of(&star.moved(&[(parameter, k * h)])?);
                    let difference = |k: f64| Ok::<f64, twofold::Error>(at(k)? - at(-k)?);
                    Ok((45.0 * difference(1.0)? - 9.0 * difference(2.0)? + difference(3.0)?) / (60.0 * h))
                };
                for (found, expected) in [
                    (of_phase[parameter as usize], slope(&phase)?),
                    (of_width[parameter as usize], slope(&|model| model.width(t))?),
                ] {
                    // Relative to the slope, or to a thousandth of a turn over the scale.
                    worst = largest([worst, (found - expected).abs() / (expected.abs() + 1e-3 / scale)]);
                }
            }
        }
        Ok(worst)
    })
}

fn widths() -> Result<Measured, String> {
    worst_of(clocks()?, |clock| {
        let model = clock.timing_model()?;
        let mut worst = 0.0_f64;
        for k in -20..=20 {
            let Some(pulse) = clock.pulse_near([f64::from(k) * YEAR, 0.0])? else { return Err("dark".to_owned()) };
            worst = largest([worst, (model.width(pulse.midpoint[0])? / pulse.duration - 1.0).abs()]);
        }
        Ok(worst)
    })
}

/// A star with a precession period of 500 days.
fn star(frequency: f64, wobble: f64, chi: f64, torque_share: f64) -> Result<TimingModel, String> {
    let f1 = -1e-15 * frequency;
    let parameters = [
        (F1, f1),
        (F2, 3.0 * f1 * f1 / frequency),
        (Wobble, wobble),
        (Chi, chi),
        (PrecessionPhase, 0.7),
        (PrecessionRate, TAU / (500.0 * 86_400.0)),
        (TorqueShare, torque_share),
        (Inclination, 1.0),
        (Rho, 0.5),
    ];
    Ok(TimingModel::new([frequency, 1e-17 * frequency], &parameters)?)
}

fn decades() -> Result<Measured, String> {
    let mut random = Random::with_seed(29);
    let unknowns = [Phase, F0, F1, F2, Wobble, PrecessionPhase, PrecessionRate, Rho];
    let stars = [2.4, 11.0, 173.0, 642.0].into_iter().flat_map(|frequency| [0.02, 0.05, 0.1].map(|w| (frequency, w)));
    worst_of(stars, |&(frequency, wobble)| {
        let truth = star(frequency, wobble, 1.3, 0.5)?;
        let arrivals = arrivals_of(&truth, 300, 15.0 * YEAR, 1e-6)?;
        let widths = widths_of(&truth, &arrivals, 1e-3 / frequency)?;
        let data = TimingData { arrivals, widths, priors: Vec::new() };
        let sigmas = timing_fisher(&truth, &data, &unknowns)?.determined()?.sigmas();
        let off: Vec<_> =
            unknowns.iter().zip(&sigmas).map(|(of, sigma)| (*of, 3.0 * sigma * random.within(-1.0, 1.0))).collect();
        let found = fit_timing(&truth.moved(&off)?, &data, &unknowns)?;
        let fitted = &found.fisher.parameters;
        let pulls = unknowns.iter().zip(&sigmas).map(|(of, sigma)| fitted.difference(&truth, *of) / sigma);
        Ok(largest(pulls))
    })
}

fn limits() -> Result<Measured, String> {
    worst_of([(0.5, 0.0), (1.2, 1.0), (1.47, 1.0)], |&(chi, torque_share)| {
        let (wobble, unknowns) = (3e-5, [Phase, F0, F1]);
        let truth = star(642.0, wobble, chi, torque_share)?;
        let data = TimingData { arrivals: arrivals_of(&truth, 400, 15.0 * YEAR, 1e-9)?, ..TimingData::default() };
        let without = fit_timing(&truth.moved(&[(Wobble, -wobble)])?, &data, &unknowns)?.fisher.parameters;
        let [found] = wobble_limits(&without, &data, &unknowns, &[truth.value(PrecessionRate)], 0.95)?[..] else {
            return Err("one period has one limit".to_owned());
        };
        if found.limit < wobble {
            return Err(format!("a limit of {:e} rad for a wobble of {wobble:e}", found.limit));
        }
        Ok((found.best / wobble - 1.0).abs() / (wobble * chi.tan()))
    })
}

fn error_bars() -> Result<Measured, String> {
    Coverage::of(0..60, Case::of_pulsar).worst_score()
}
