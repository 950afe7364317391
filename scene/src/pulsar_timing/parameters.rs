//! The files for timing programs: a `.par` file of the fit and a `.tim` file of the arrival times (FORMAT 1, barycentre).

use std::fmt::Write;
use twofold::Error;

use super::Timing;
use super::decimal::decimal;
use crate::scene_file::{Catalogued, NAMELESS, Scene};

/// Number of the pulse from which the numbers in the files are counted: the one nearest to `PEPOCH`, whose time is `TZRMJD`.
fn reference(timing: &Timing) -> i64 {
    timing.fit.phase[0].round() as i64
}

/// The `.par` file: the fitted frequency in TDB. Nothing in it requires an ephemeris or a clock file, since the site is the
/// barycentre.
pub fn par(scene: &Scene, timing: &Timing) -> Result<String, Error> {
    let at_reference = timing.epoch.after(timing.fit.time_of(reference(timing)))?;
    let mut text = String::new();
    let mut line = |key: &str, value: &str| writeln!(text, "{key:<10}{value}").expect("writing to a string succeeds");
    for source in &scene.sources {
        line("#", source);
    }
    let name = scene.catalogued.as_ref().map_or(NAMELESS, |catalogued| catalogued.name.as_str());
    line("PSR", name);
    if let Some(Catalogued { position: Some((ascension, declination)), .. }) = &scene.catalogued {
        line("RAJ", &ascension.text);
        line("DECJ", &declination.text);
        line("POSEPOCH", &timing.epoch.to_string());
    }
    line("F0", &decimal(timing.fit.frequency));
    for (name, value) in ["F1", "F2"].into_iter().zip(timing.fit.derivatives).take(timing.derivatives) {
        line(name, &format!("{value:e}"));
    }
    line("PEPOCH", &timing.epoch.to_string());
    line("TZRMJD", &at_reference.to_string());
    line("TZRSITE", "@");
    line("TZRFRQ", "0.0");
    line("UNITS", "TDB");
    line("TRACK", "-2");
    Ok(text)
}

/// The `.tim` file: one line for each pulse, at infinite frequency, with its number counted from that of `TZRMJD` and the
/// uncertainty (s).
pub fn tim(timing: &Timing, uncertainty: f64) -> String {
    let (first, microseconds) = (reference(timing), uncertainty * 1e6);
    let mut text = String::from("FORMAT 1\n");
    for timed in &timing.pulses {
        let number = timed.pulse.number - first;
        writeln!(text, "twofold 0.0 {} {microseconds} @ -pn {number}", timed.arrival)
            .expect("writing to a string succeeds");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::tests::{scene, timed};
    use super::*;

    /// Every line is in its place. The reference pulse is within half a turn of `PEPOCH`.
    #[test]
    fn the_files_have_what_was_fitted() {
        for mut scene in [scene("[0.0, 0.0, 0.0]"), Scene::named("b1828-11").unwrap()] {
            scene.spin_down = None;
            let (pulsar, timing) = timed(&scene, &[0.0, 1e5, 3e7]);
            let text = par(&scene, &timing).unwrap();
            let lines: Vec<_> = text.lines().map(|line| line.split_at(10)).collect();
            let value = |key: &str| lines.iter().find(|line| line.0.trim() == key).map_or("", |line| line.1);
            let is_known = scene.catalogued.is_some();
            let mut keys = vec!["#"; scene.sources.len()];
            keys.push("PSR");
            keys.extend(if is_known { &["RAJ", "DECJ", "POSEPOCH"][..] } else { &[] });
            keys.extend(["F0", "PEPOCH", "TZRMJD", "TZRSITE", "TZRFRQ", "UNITS", "TRACK"]);
            assert_eq!(lines.iter().map(|line| line.0.trim()).collect::<Vec<_>>(), keys);
            assert!(lines.iter().zip(&scene.sources).all(|(line, source)| line.1 == source));
            let [name, ascension, declination] =
                if is_known { ["B1828-11", "18:30:47.567", "-10:59:27.92"] } else { [NAMELESS, "", ""] };
            assert_eq!([value("PSR"), value("RAJ"), value("DECJ")], [name, ascension, declination]);
            assert_eq!([value("TZRSITE"), value("TZRFRQ"), value("UNITS")], ["@", "0.0", "TDB"]);
            // The mean of the days 0, 1 and 347 from the epoch on.
            let middle = format!("{}.0", pulsar.epoch.day() + 116);
            assert_eq!([value("POSEPOCH"), value("PEPOCH")], [if is_known { &middle } else { "" }, &middle]);
            assert_eq!(value("F0").parse::<f64>().unwrap(), timing.fit.frequency[0]);
            let (zero, period) = (value("TZRMJD").parse::<twofold::epoch::Epoch>().unwrap(), pulsar.clock.period());
            let from_middle = zero.seconds_since(&timing.epoch)[0];
            assert!(from_middle.abs() <= 0.5 * period, "{from_middle} s of {period} s");
            // From there to each pulse the phase is its number of turns, except for the residual.
            for (line, (timed, residual)) in
                tim(&timing, 1e-5).lines().skip(1).zip(timing.pulses.iter().zip(&timing.fit.residuals))
            {
                let number: f64 = line.split(" -pn ").nth(1).unwrap().parse().unwrap();
                let turns = (timed.arrival.seconds_since(&zero)[0] - residual) * timing.fit.frequency[0];
                assert!((turns - number).abs() < 1e-6, "{line}: {turns}");
                assert!(line.contains(" 10 @ "), "{line}");
            }
        }
    }
}
