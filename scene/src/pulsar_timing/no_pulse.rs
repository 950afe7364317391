//! Reasons why a pulsar has no arrival times.

use std::f64::consts::TAU;

use twofold::Error;
use twofold::epoch::Epoch;

use super::PulsarScene;
use crate::Refusal;

/// Largest number of epochs, equally spaced, in whose turns the angles are evaluated.
const MOST: usize = 1000;

/// Evaluations in one turn. The extrema between them are found by a step of Newton's method, to some `(2 pi / LOOKS)^4` of a
/// radian.
const LOOKS: usize = 180;

/// The reason why the turns of `epochs` have no pulse.
pub(super) fn no_pulse(pulsar: &PulsarScene, epochs: &[Epoch]) -> Refusal {
    let found = angles_to_line_of_sight(pulsar, epochs);
    found.map_or_else(Refusal::Model, |[nearest, farthest]| {
        Refusal::Input(sentence(nearest, farthest, pulsar.beam.half_opening))
    })
}

/// The smallest and the largest angle of the magnetic axis to the line of sight in these turns.
fn angles_to_line_of_sight(pulsar: &PulsarScene, epochs: &[Epoch]) -> Result<[f64; 2], Error> {
    let beam = &pulsar.beam;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let period = pulsar.clock.period();
    let (edge, problem) = (beam.half_opening.cos(), &pulsar.problem);
    for epoch in epochs.iter().step_by(epochs.len().div_ceil(MOST)) {
        let near = pulsar.clock.near(epoch.seconds_since(&pulsar.epoch));
        let at = |t: f64| -> Result<[f64; 4], Error> {
            let state = near(t)?;
            Ok(beam.margin_rates(
                problem.spheroid(),
                problem.coefficients(),
                problem.bulge(),
                &state,
                &pulsar.observer.direction,
            ))
        };
        let step = period / LOOKS as f64;
        for k in 0..LOOKS {
            let t = period * (k as f64 / LOOKS as f64 - 0.5);
            let [margin, rate, second, _] = at(t)?;
            let to_extremum = -rate / second;
            let margins = if to_extremum.abs() <= step { [margin, at(t + to_extremum)?[0]] } else { [margin, margin] };
            (least, most) = margins.iter().fold((least, most), |(least, most), m| (m.min(least), m.max(most)));
        }
    }
    let angle = |margin: f64| (margin + edge).clamp(-1.0, 1.0).acos();
    Ok([angle(most), angle(least)])
}

/// The reason, from the smallest and the largest angle (rad) of the magnetic axis to the line of sight.
fn sentence(nearest: f64, farthest: f64, half_opening: f64) -> String {
    if nearest >= half_opening {
        format!(
            "no pulse: the beam never crosses the line of sight at these epochs. The magnetic axis comes to {nearest:.6} rad of it at \
             closest, and `pulsar.rho` is {half_opening} rad. Use a `pulsar.rho` above that distance, or a `pulsar.chi` or an \
             observer for which it is smaller"
        )
    } else if farthest <= half_opening {
        format!(
            "no pulse: the line of sight is always inside the beam at these epochs. The magnetic axis is {farthest:.6} rad from it at \
             most ({nearest:.6} rad at closest), and `pulsar.rho` is {half_opening} rad. Use a `pulsar.rho` below that distance, \
             or a `pulsar.chi` or an observer for which it is larger"
        )
    } else {
        format!(
            "no pulse: no turn near these epochs has both edges of a pulse within {:.1} rad of its middle. The magnetic axis is from \
             {nearest:.6} to {farthest:.6} rad from the line of sight, and `pulsar.rho` is {half_opening} rad. Pulses that last \
             more than a turn are not timed; use another `pulsar.rho`",
            1.5 * TAU
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{Scene, text_of};

    /// The isolated pulsar with some of its lines replaced, and the angles in the turn about an epoch a day later.
    fn angles(replaced: &[(&str, &str)]) -> (PulsarScene, Epoch, [f64; 2]) {
        let text = replaced.iter().fold(text_of("isolated-pulsar").unwrap(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        });
        let mut scene = Scene::from_toml("scene", &text).unwrap_or_else(|error| panic!("{error}"));
        scene.spin_down = None;
        let pulsar = PulsarScene::new(&scene).unwrap();
        let epoch = pulsar.epoch.after([86400.0, 0.0]).unwrap();
        let angles = angles_to_line_of_sight(&pulsar, &[epoch]).unwrap();
        (pulsar, epoch, angles)
    }

    /// A magnetic axis at `chi` to `L` has angles from `|i - chi|` to `i + chi` to a line of sight at `i`. Newton's step has an error of less than
    /// 1e-8 rad; along the line of sight a rounding of the cosine is some 1e-8 rad too.
    #[test]
    fn a_star_without_wobble_shows_its_axis_at_the_difference_and_the_sum_of_angles() {
        // At 20.7 degrees the cosine of the smallest angle is rounded to above one.
        let equal = [60.0, 75.0, 82.0, 20.7].map(|angle| (angle, angle));
        for (inclination, chi) in equal.into_iter().chain([(60.0, 65.0), (82.0, 98.0), (35.0, 145.0), (120.0, 60.0)]) {
            let (_, _, [nearest, farthest]) = angles(&[
                ("\"60 deg\"", &format!("\"{inclination} deg\"")),
                ("\"65 deg\"", &format!("\"{chi} deg\"")),
                ("\"1.0 deg\"", "\"0 deg\""),
            ]);
            let (inclination, chi) = (f64::to_radians(inclination), f64::to_radians(chi));
            let sum = (inclination + chi).min(2.0 * std::f64::consts::PI - inclination - chi);
            assert!((nearest - (inclination - chi).abs()).abs() < 5e-8, "{nearest}");
            assert!((farthest - sum).abs() < 5e-8, "{farthest}");
        }
    }

    /// A star that precesses within some turns, compared with 20,000 evaluations in the half turn before the epoch and the half turn after. An
    /// extremum is flat: between evaluations it changes by 1e-7 rad.
    #[test]
    fn the_turn_is_that_about_the_epoch() {
        let (pulsar, epoch, found) = angles(&[
            ("precession_period = 400.0", "oblateness = 0.3"),
            ("\nfrequency = ", "\nspin_frequency = "),
            ("\"1.0 deg\"", "\"30 deg\""),
        ]);
        let near = pulsar.clock.near(epoch.seconds_since(&pulsar.epoch));
        let looks = (0..=20_000).map(|k| pulsar.clock.period() * (f64::from(k) / 20_000.0 - 0.5));
        let seen = looks.map(|t| pulsar.beam.direction(&near(t).unwrap()).angle(&pulsar.observer.direction));
        let [least, most] = seen.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], x| [least.min(x), most.max(x)]);
        assert!((found[0] - least).abs() < 1e-6 && (found[1] - most).abs() < 1e-6, "{found:?}: {least} {most}");
    }

    /// The beam of `a_pulse_is_not_given_where_it_lasts_over_more_turns_than_are_searched`: it comes and goes with the wobble.
    #[test]
    fn pulses_longer_than_a_turn_are_told_from_no_passage_and_from_no_end() {
        for (nearest, farthest, part) in [
            (0.2, 0.8, "no turn near these epochs has both edges of a pulse within 9.4 rad"),
            (0.8, 0.9, "never crosses the line of sight"),
            (0.2, 0.7, "always inside the beam"),
        ] {
            let text = sentence(nearest, farthest, 0.75);
            assert!(text.contains(part) && text.contains("`pulsar.rho` is 0.75 rad"), "{text}");
        }
    }
}
