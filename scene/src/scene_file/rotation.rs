//! Oblateness and rotation of a physical star, given directly or through the observed rates of a pulsar.

use std::f64::consts::{FRAC_PI_2, PI};

use twofold::epoch::DAY;

use super::document::{Entry, Section};
use super::fault::Fault;

/// Angles of a wobbling pulsar, if given in the scene: of the symmetry axis to `L`, and of the magnetic axis to the symmetry axis (rad).
pub(super) struct WobbleAngles {
    wobble: Option<f64>,
    chi: Option<f64>,
}

impl WobbleAngles {
    /// Reads the angles from `initial.wobble` and `pulsar.chi`.
    pub(super) fn read(document: &Section<'_>) -> Result<Self, Fault> {
        let angle = |section: &str, key: &str| {
            let entry = document.section(section)?.and_then(|section| section.optional(key));
            entry.map(|entry| entry.angle()).transpose()
        };
        Ok(Self { wobble: angle("initial", "wobble")?, chi: angle("pulsar", "chi")? })
    }
}

/// Oblateness, and `Omega^z / (2 pi)` (Hz) with the entry that defines it.
pub(super) struct Rotation<'a> {
    pub(super) entry: Entry<'a>,
    pub(super) frequency: f64,
    pub(super) oblateness: f64,
}

/// The form in which the oblateness is given.
enum Flattening<'a> {
    /// The precession rate in the body over `2 pi` (Hz), with the entry that defines it.
    Precession(f64, Entry<'a>),
    Oblateness(f64),
}

/// The rotation from `oblateness` or `precession_period`, and `spin_frequency` or `frequency`.
///
/// With the wobble `theta` and the oblateness `epsilon` the body precesses at the rate `epsilon Omega^z`, its axis circles `L` at
/// `(1 + epsilon) Omega^z / cos theta`, and pulses arrive at the rate of the magnetic axis about `L`: that of the symmetry axis, minus that of the
/// precession if `theta < chi < pi - theta`.
pub(super) fn rotation<'a>(section: &Section<'a>, angles: &WobbleAngles) -> Result<Rotation<'a>, Fault> {
    const OBLATENESS: &str = "from 1e-15 to 0.99; the star must be oblate, so that C is above zero";
    let in_range = |oblateness: &f64| (1e-15..=0.99).contains(oblateness);
    let wobble = |entry: &Entry<'a>| {
        let wobble = angles.wobble.filter(|wobble| (0.0..FRAC_PI_2).contains(wobble));
        wobble.ok_or_else(|| entry.refuse_because("requires `initial.wobble`, from 0 to below pi/2 [rad]"))
    };
    let flattening = match section.optional("precession_period") {
        Some(entry) => {
            let days = entry.number_in("a period from 1e-9 to 1e9 [d]", 1e-9..=1e9)?;
            Flattening::Precession(1.0 / (days * DAY), entry)
        }
        None => {
            let entry = section.required("oblateness", "(I^zz - I^xx) / I^xx, or `star.precession_period` [d]")?;
            Flattening::Oblateness(entry.number_where(OBLATENESS, |oblateness| in_range(&oblateness))?)
        }
    };
    let (entry, frequency) = match section.optional("frequency") {
        Some(entry) => {
            let wobble = wobble(&entry)?;
            let chi = angles.chi.ok_or_else(|| {
                entry.refuse_because("requires `pulsar.chi`; the pulses are those of the magnetic axis")
            })?;
            let observed = entry.number_in("from -1e5 to 1e5 [Hz]", -1e5..=1e5)?;
            let cos = wobble.cos();
            let goes_round = wobble < chi && chi < PI - wobble;
            let frequency = match &flattening {
                Flattening::Precession(rate, _) => {
                    let rate = rate.copysign(observed);
                    cos * if goes_round { observed + rate } else { observed } - rate
                }
                Flattening::Oblateness(oblateness) => {
                    observed / ((1.0 + oblateness) / cos - if goes_round { *oblateness } else { 0.0 })
                }
            };
            (entry, frequency)
        }
        None => {
            let entry =
                section.required("spin_frequency", "Omega^z / (2 pi) [Hz], or `star.frequency` of the pulses [Hz]")?;
            let frequency = entry.number_in("from -1e5 to 1e5 [Hz]", -1e5..=1e5)?;
            (entry, frequency)
        }
    };
    let oblateness = match flattening {
        Flattening::Oblateness(oblateness) => oblateness,
        Flattening::Precession(rate, period) => {
            let oblateness = rate / frequency.abs();
            // I^zz = 1 + epsilon keeps four digits of the smallest.
            if !(1e-12..=0.99).contains(&oblateness) {
                let why = format!("the oblateness is then {oblateness:e}, and must be from 1e-12 to 0.99");
                return Err(period.refuse_because(&why));
            }
            oblateness
        }
    };
    Ok(Rotation { entry, frequency, oblateness })
}
