//! The sections `[observer]` and `[pulsar]`: who looks on, and what shines.

use std::f64::consts::PI;

use twofold::observables::Observer;
use twofold::observables::pulsar::Beam;
use twofold::units::si::KILOPARSEC;

use super::error::Fault;
use super::section::Section;
use super::star::Units;

/// A distant observer, in the inertial frame of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewer {
    /// Colatitude `theta_o` (rad).
    pub theta_o: f64,
    /// Azimuth `phi_o` (rad).
    pub phi_o: f64,
    /// Distance of a physical star in m, where given.
    pub distance: Option<f64>,
}

impl Viewer {
    /// The direction to the observer and the basis normal to it, Eqs. (46), (70).
    pub fn basis(&self) -> Observer<f64> {
        Observer::at(self.theta_o, self.phi_o)
    }
}

/// The radiation of a scene's star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulsar {
    /// Angle `chi` of the magnetic axis to the symmetry axis (rad).
    pub chi: f64,
    /// Azimuth `delta` of the magnetic axis in the body (rad).
    pub delta: f64,
    /// Semi-open angle `rho` of the beam (rad).
    pub rho: f64,
    /// Whether the pulses of the opposite beam are wanted too.
    pub second_beam: bool,
}

impl Pulsar {
    /// The beam about the magnetic axis, Eq. (45).
    pub fn beam(&self) -> Beam<f64> {
        Beam::new(self.chi, self.delta, self.rho)
    }
}

/// A pulsar in the catalogues.
#[derive(Debug, Clone, PartialEq)]
pub struct Catalogued {
    /// Name.
    pub name: String,
    /// Right ascension (J2000), as `19:39:38.56`, and declination, as `+21:34:59.1`.
    pub position: Option<(String, String)>,
}

pub(super) fn read_observer(section: &Section<'_>, units: &Units) -> Result<Viewer, Fault> {
    section.only(&["theta_o", "phi_o", "distance"])?;
    let theta_o = section
        .required("theta_o", "colatitude of the observer [rad]")?
        .number_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?;
    let phi_o = section.required("phi_o", "azimuth of the observer [rad]")?.angle()?;
    let distance = match section.optional("distance") {
        Some(entry) if !units.are_physical() => {
            return Err(entry.refuse("a distance only for a physical star: in the paper's units h is that at r = 1"));
        }
        Some(entry) => {
            Some(entry.number_where("a distance from 1e-6 to 1e8 [kpc]", |x| (1e-6..=1e8).contains(&x))? * KILOPARSEC)
        }
        None => None,
    };
    Ok(Viewer { theta_o, phi_o, distance })
}

pub(super) fn read_pulsar(section: &Section<'_>) -> Result<Pulsar, Fault> {
    section.only(&["chi", "delta", "rho", "second_beam", "name", "right_ascension", "declination"])?;
    Ok(Pulsar {
        chi: section
            .required("chi", "angle of the magnetic axis to the symmetry axis [rad]")?
            .number_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?,
        delta: section.optional("delta").map_or(Ok(0.0), |entry| entry.angle())?,
        rho: section
            .required("rho", "semi-open angle of the beam [rad]")?
            .number_where("an angle above 0 and below pi [rad]", |x| x > 0.0 && x < PI)?,
        second_beam: section.optional("second_beam").map_or(Ok(false), |entry| entry.boolean())?,
    })
}

pub(super) fn read_catalogued(section: &Section<'_>) -> Result<Option<Catalogued>, Fault> {
    let Some(name) = section.optional("name") else { return Ok(None) };
    let is_name = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_ascii_graphic());
    if !is_name(name.string()?) {
        return Err(name.refuse("a name without spaces"));
    }
    let position = match (section.optional("right_ascension"), section.optional("declination")) {
        (None, None) => None,
        (Some(_), None) => return Err(section.missing("`pulsar.declination` beside `pulsar.right_ascension`")),
        (None, Some(_)) => return Err(section.missing("`pulsar.right_ascension` beside `pulsar.declination`")),
        (Some(ascension), Some(declination)) => {
            if !is_sexagesimal(ascension.string()?, 24) {
                return Err(ascension.refuse("hours, minutes and seconds as \"19:39:38.56\""));
            }
            let angle = declination.string()?;
            if !is_sexagesimal(angle.strip_prefix(['+', '-']).unwrap_or(angle), 90) {
                return Err(declination.refuse("degrees, minutes and seconds as \"+21:34:59.1\""));
            }
            Some((ascension.string()?.to_owned(), angle.to_owned()))
        }
    };
    Ok(Some(Catalogued { name: name.string()?.to_owned(), position }))
}

/// Whether a text is a whole number up to `most`, minutes and decimal seconds.
fn is_sexagesimal(text: &str, most: u8) -> bool {
    let parts: Vec<_> = text.split(':').collect();
    let [whole, minutes, seconds] = parts[..] else { return false };
    let plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let below = |part: &str| plain(part) && part.parse::<f64>().is_ok_and(|x| x < 60.0);
    whole.parse::<u8>().is_ok_and(|x| x <= most) && minutes.len() == 2 && below(minutes) && below(seconds)
}
