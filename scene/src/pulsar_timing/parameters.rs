//! The files of timing programs: a `.par` of the fit and a `.tim` of the arrival times (FORMAT 1, barycentre).

use std::fmt::Write;
use twofold::Error;

use super::Timing;
use super::decimal::decimal;
use crate::scene_file::{Catalogued, NAMELESS, Scene};

/// Number of the pulse from which the numbers in the files are counted: the one nearest to `PEPOCH`, at which `TZRMJD` is.
fn reference(timing: &Timing) -> i64 {
    (timing.fit.phase[0] + timing.fit.phase[1]).round() as i64
}

/// The `.par`: the fitted frequency in TDB. Nothing in it needs an ephemeris or a clock file, since the site is the barycentre.
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

/// The `.tim`: one line for each pulse, of infinite frequency, with its number from that of `TZRMJD` and the uncertainty (s).
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
