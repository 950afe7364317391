//! Tables of pulsars: what was observed of each, with uncertainties, and the bounds on Lorentz violation that follow.
//!
//! The format and the method are described in `docs/bounds.md`.

mod figures;
mod limit;
pub mod published;
mod pulsar_file;

use crate::random::Random;
use crate::scene_file::{FileFormat, SceneError};

pub use figures::{COMBINATION, CONSERVATIVE_ETA, Figure, ROUND_INERTIA_OVER_C};
pub use limit::{CONFIDENCE, Directions, Limit, limit_over_directions, recommended};

/// The table that comes with the command: the two pulsars of the paper.
pub const PAPER: &str = include_str!("../../pulsars/paper.toml");

/// Files with a table of pulsars.
const TABLE: FileFormat = FileFormat { name: "a table of pulsars", built_in: None };

/// How an uncertainty is distributed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// Uniform: the number was rounded to its last digit.
    Rounded,
    /// Normal: the uncertainty was given.
    Given,
}

/// A number with its standard uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// The number.
    pub value: f64,
    /// Its standard uncertainty.
    pub uncertainty: f64,
    /// Its distribution.
    pub spread: Spread,
}

impl Quantity {
    /// Without uncertainty.
    pub fn exact(value: f64) -> Self {
        Self { value, uncertainty: 0.0, spread: Spread::Given }
    }

    /// A random number of its distribution.
    pub fn draw(&self, random: &mut Random) -> f64 {
        let deviate = match self.spread {
            Spread::Rounded => random.within(-1.0, 1.0) * 3f64.sqrt(),
            Spread::Given => {
                let (u, angle) = (1.0 - random.within(0.0, 1.0), random.within(0.0, std::f64::consts::TAU));
                (-2.0 * u.ln()).sqrt() * angle.cos()
            }
        };
        self.value + self.uncertainty * deviate
    }
}

/// How the spin is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpinForm {
    /// Period (s).
    Period,
    /// Frequency (Hz).
    Frequency,
}

/// How `I^zz / C` is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia<T> {
    /// Itself (s^2).
    Given(T),
    /// By density (g/cm^3) and oblateness, Eq. (43).
    Uniform {
        /// Density.
        density: T,
        /// Oblateness.
        oblateness: T,
    },
    /// Not: a uniform fluid star, oblate by its spin, for which it is `4 / (Omega^z)^2`.
    Fluid,
}

/// How `eta` is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Eta<T> {
    /// Itself.
    Given(T),
    /// By the inclination (deg) of the spin axis to Z, for a tensor symmetric about Z.
    Inclination(T),
    /// Not: nothing is known of the axes of the tensor.
    Unknown,
}

/// One pulse of a pulsar. Angles in degrees, as in the paper's table.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulsar<T = Quantity> {
    /// Its name.
    pub name: String,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// How [`spin`](Self::spin) is given.
    pub spin_form: SpinForm,
    /// Spin period (s) or frequency (Hz).
    pub spin: T,
    /// Pulse width `W` (deg).
    pub width: T,
    /// Its change `Delta W` (deg) with its sign: measured, if an uncertainty is given with it, and otherwise taken as a limit.
    pub width_change: T,
    /// `lambda` (deg) of Eq. (42), from the spin axis to the direction from the observer to the star: 180 - zeta.
    pub lambda: T,
    /// `chi` (deg), from the spin axis to the axis of the beam.
    pub chi: T,
    /// `Delta t` in Julian years.
    pub years: T,
    /// `I^zz / C`.
    pub inertia: Inertia<T>,
    /// `eta`.
    pub eta: Eta<T>,
    /// Speed (km/s) relative to the preferred frame.
    pub speed: Option<T>,
}

impl<T: Copy> Pulsar<T> {
    /// The same pulsar with every number replaced; always in the same order.
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Pulsar<U> {
        Pulsar {
            name: self.name.clone(),
            source: self.source.clone(),
            spin_form: self.spin_form,
            spin: f(self.spin),
            width: f(self.width),
            width_change: f(self.width_change),
            lambda: f(self.lambda),
            chi: f(self.chi),
            years: f(self.years),
            inertia: match self.inertia {
                Inertia::Given(x) => Inertia::Given(f(x)),
                Inertia::Uniform { density, oblateness } => {
                    Inertia::Uniform { density: f(density), oblateness: f(oblateness) }
                }
                Inertia::Fluid => Inertia::Fluid,
            },
            eta: match self.eta {
                Eta::Given(x) => Eta::Given(f(x)),
                Eta::Inclination(x) => Eta::Inclination(f(x)),
                Eta::Unknown => Eta::Unknown,
            },
            speed: self.speed.map(f),
        }
    }
}

/// The pulsars of the paper's table.
pub fn paper() -> Vec<Pulsar> {
    pulsars("paper.toml", PAPER).expect("the table of the paper is well-formed")
}

/// The pulsars in the file at `path`.
pub fn pulsars_in_file(path: &str) -> Result<Vec<Pulsar>, SceneError> {
    pulsars(path, &TABLE.read(path)?)
}

/// The pulsars of the text of a table; `file` is how messages call it.
///
/// # Errors
/// A [`SceneError`] for text that is not TOML, for keys that are unknown, missing or exclude one another, for values of a
/// wrong type or out of range, and for angles at which the width says nothing of the spin axis.
pub fn pulsars(file: &str, text: &str) -> Result<Vec<Pulsar>, SceneError> {
    TABLE.parse(file, text, pulsar_file::read)
}
