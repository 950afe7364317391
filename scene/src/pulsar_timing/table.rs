//! The table of arrival times.

use std::fmt::Write;

use twofold::dynamics::RotationState;
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

/// Columns of the contributions to the residuals.
const CAUSES: [&str; 4] = ["geometry [s]", "torque [s]", "violation [s]", "spin_down_rate [Hz/s]"];

/// Comma-separated values with a header and a row for each pulse; the contributions to its residual come last, if given. Values that do not exist
/// are left empty.
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
        let state = pulse.state.axis_state();
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

#[cfg(test)]
mod tests {
    use super::super::tests::{scene, timed};
    use super::*;

    /// Strains are half at twice the distance, and have no numbers without a distance; the contributions are in their columns.
    #[test]
    fn every_field_is_in_its_column() {
        let mut scene = scene("[0.0, 0.0, 0.0]");
        let fields = |text: &str| text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect();
        let (pulsar, timing) = timed(&scene, &[0.0, 1e5, 3e7]);
        let causes = Causes {
            geometry: vec![1.0, 2.0, 3.0],
            torque: vec![4.0, 5.0, 6.0],
            violation: vec![7.0, f64::NAN, 9.0],
            spin_down_rate: vec![10.0, 11.0, 12.0],
        };
        let near: Vec<Vec<_>> = fields(&csv(&pulsar, &timing, Some(&causes)));
        assert_eq!(near[0][..16], HEADER);
        assert_eq!(near[0][16..], CAUSES);
        assert_eq!(near[2][16..], ["2.0", "5.0", "", "11.0"]);
        let distance = scene.observer.and_then(|observer| observer.distance).unwrap();
        for (factor, rest) in [(Some(2.0), 0.5), (None, 0.0)] {
            scene.observer.as_mut().unwrap().distance = factor.map(|factor| factor * distance);
            let (pulsar, timing) = timed(&scene, &[0.0, 1e5, 3e7]);
            let table: Vec<Vec<_>> = fields(&csv(&pulsar, &timing, None));
            assert_eq!(table.len(), 4);
            for (row, near) in table.iter().zip(&near).skip(1) {
                assert_eq!(row[..12], near[..12]);
                let strains = row.iter().zip(near).skip(12).map(|(field, near)| {
                    if factor.is_none() {
                        assert_eq!(field, "")
                    }
                    [field, near].map(|field| field.parse().unwrap_or(0.0))
                });
                // The unit is rounded before the multiplication.
                assert!(
                    strains
                        .into_iter()
                        .all(|[far, near]: [f64; 2]| (far - rest * near).abs() <= 4.0 * f64::EPSILON * far.abs())
                );
                assert_eq!(row.len(), 16);
            }
        }
    }
}
