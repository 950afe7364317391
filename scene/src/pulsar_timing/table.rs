//! The table of arrival times.

use std::fmt::Write;

use twofold::dynamics::AxisState;
use twofold::observables::wave_harmonics::WaveHarmonics;

use super::{Causes, PulsarScene, Timing};

const HEADER: [&str; 16] = [
    "pulse",
    "arrival_day [MJD]",
    "arrival_fraction [d]",
    "residual [s]",
    "duration [s]",
    "psi [rad]",
    "psi_rate [rad/s]",
    "swing [rad]",
    "inclination [rad]",
    "orientation [rad]",
    "wobble [rad]",
    "wave_phase [rad]",
    "h_once [1]",
    "h_twice [1]",
    "h_plus [1]",
    "h_cross [1]",
];

/// Columns of the causes.
const CAUSES: [&str; 4] = ["geometry [s]", "torque [s]", "violation [s]", "spin_down_rate [Hz/s]"];

/// Comma-separated values with a header, a row for each pulse, the causes of its residual last if they are given. What does not exist is left empty.
pub fn csv(pulsar: &PulsarScene, timing: &Timing, causes: Option<&Causes>) -> String {
    let mut text = HEADER.join(",");
    if causes.is_some() {
        text = text + "," + &CAUSES.join(",");
    }
    text.push('\n');
    let mut row = |values: &[f64], place: (i64, i64, f64)| {
        let (number, day, fraction) = place;
        write!(text, "{number},{day},{fraction:?}").expect("writing to a string succeeds");
        for value in values {
            if value.is_finite() {
                write!(text, ",{value:?}").expect("writing to a string succeeds");
            } else {
                text.push(',');
            }
        }
        text.push('\n');
    };
    for (i, (timed, residual)) in timing.pulses.iter().zip(&timing.fit.residuals).enumerate() {
        let pulse = &timed.pulse;
        let state = AxisState::from(&pulse.state);
        let harmonics = WaveHarmonics::of(pulsar.problem.spheroid(), &state, &pulsar.observer).ok();
        let of = |value: fn(&WaveHarmonics<f64>) -> f64| harmonics.as_ref().map_or(f64::NAN, value);
        let unit = pulsar.strain_unit.unwrap_or(f64::NAN);
        let wave = pulsar.wave(&state);
        let mut values = vec![
            *residual,
            pulse.duration,
            pulse.position_angle,
            pulse.position_angle_rate,
            pulse.swing,
            of(|h| h.inclination),
            of(|h| h.orientation),
            of(|h| h.wobble),
            of(|h| h.phase),
            of(|h| h.once) * unit,
            of(|h| h.twice) * unit,
            wave.map_or(f64::NAN, |wave| wave.plus),
            wave.map_or(f64::NAN, |wave| wave.cross),
        ];
        if let Some(Causes { geometry, torque, violation, spin_down_rate }) = causes {
            values.extend([geometry, torque, violation, spin_down_rate].map(|column| column[i]));
        }
        row(&values, (pulse.number, timed.arrival.day(), timed.arrival.fraction()));
    }
    text
}
