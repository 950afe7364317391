//! Tables of pulsars: the observations of each, with uncertainties, and the resulting bounds on Lorentz violation.
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

/// The table included with the command: the two pulsars of the paper.
pub const PAPER: &str = include_str!("../../pulsars/paper.toml");

/// Files with a table of pulsars.
const TABLE: FileFormat = FileFormat { name: "a table of pulsars", built_in: None };

/// The distribution of an uncertainty.
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
    /// A number without uncertainty.
    pub fn exact(value: f64) -> Self {
        Self { value, uncertainty: 0.0, spread: Spread::Given }
    }

    /// A random number from its distribution.
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

/// The form in which the spin is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpinForm {
    /// Period (s).
    Period,
    /// Frequency (Hz).
    Frequency,
}

/// The form in which `I^zz / C` is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia<T> {
    /// Its value (s^2).
    Given(T),
    /// Density (g/cm^3) and oblateness, Eq. (43).
    Uniform {
        /// Density.
        density: T,
        /// Oblateness.
        oblateness: T,
    },
    /// Not given: a uniform fluid star whose oblateness is due to its spin, for which it is `4 / (Omega^z)^2`.
    Fluid,
}

/// The form in which `eta` is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Eta<T> {
    /// Its value.
    Given(T),
    /// The inclination (deg) of the spin axis to Z, for a tensor symmetric about Z.
    Inclination(T),
    /// Not given: nothing is known of the axes of the tensor.
    Unknown,
}

/// One pulse of a pulsar. Angles in degrees, as in the paper's table.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulsar<T = Quantity> {
    /// Its name.
    pub name: String,
    /// Source of its numbers.
    pub source: Option<String>,
    /// The form in which [`spin`](Self::spin) is given.
    pub spin_form: SpinForm,
    /// Spin period (s) or frequency (Hz).
    pub spin: T,
    /// Pulse width `W` (deg).
    pub width: T,
    /// Change `Delta W` of the pulse width (deg) with its sign: measured, if an uncertainty is given with it, otherwise taken as a limit.
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
    /// The same pulsar with `f` applied to every number, always in the same order.
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

/// The pulsars in the text of a table; `file` is its name in messages.
///
/// # Errors
/// A [`SceneError`] for text that is not TOML, for keys that are unknown, missing or mutually exclusive, for values of a
/// wrong type or out of range, and for angles at which the width does not constrain the spin axis.
pub fn pulsars(file: &str, text: &str) -> Result<Vec<Pulsar>, SceneError> {
    TABLE.parse(file, text, pulsar_file::read)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Moments of 1e4 draws. In standard deviations, a rounded number is uniform up to `sqrt 3`, with the fourth moment 9/5, and a measured
    /// one is normal, with 3. Bounds are five standard deviations of the means, whose eighth moments are 9 and 105.
    #[test]
    fn draws_have_the_mean_the_deviation_and_the_shape_of_their_distribution() {
        const DRAWS: u32 = 10_000;
        for (spread, fourth, eighth) in [(Spread::Rounded, 1.8, 9.0), (Spread::Given, 3.0, 105.0)] {
            let (mut random, quantity) = (Random::with_seed(8), Quantity { value: 40.0, uncertainty: 0.25, spread });
            let draws: Vec<_> = (0..DRAWS).map(|_| (quantity.draw(&mut random) - 40.0) / 0.25).collect();
            let moment = |power| draws.iter().map(|x: &f64| x.powi(power)).sum::<f64>() / f64::from(DRAWS);
            for (power, mean, of_square) in [(1, 0.0, 1.0), (2, 1.0, fourth), (4, fourth, eighth)] {
                let deviation = ((of_square - mean * mean) / f64::from(DRAWS)).sqrt();
                assert!((moment(power) - mean).abs() < 5.0 * deviation, "{spread:?}: {}", moment(power));
            }
            let largest = draws.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            assert_eq!(largest > 3.0_f64.sqrt(), spread == Spread::Given, "{largest}");
        }
    }

    /// In the Box-Muller method two uniform numbers give a point in the plane, at the distance `sqrt(-2 ln u)` from the origin and at an angle of
    /// a fraction of a turn: the deviate is its projection on the first axis.
    #[test]
    fn a_normal_draw_is_the_projection_of_a_point() {
        let (mut random, unit) =
            (Random::with_seed(5), Quantity { value: 0.0, uncertainty: 1.0, spread: Spread::Given });
        for _ in 0..20 {
            let mut uniform = random.clone();
            let (left, turns) = (uniform.within(0.0, 1.0), uniform.within(0.0, 1.0));
            let point = nalgebra::Rotation2::new(TAU * turns) * nalgebra::Vector2::x();
            let radius = unit.draw(&mut random) / point.x;
            let density = (-0.5 * radius * radius).exp();
            assert!(radius > 0.0 && (density - (1.0 - left)).abs() < 1e-13, "{radius} {density}");
            assert_eq!(random.word(), uniform.word());
        }
    }

    /// Each number returns to its place.
    #[test]
    fn numbers_are_replaced_where_they_are() {
        let one = Quantity::exact(1.0);
        let pulsar = Pulsar {
            name: "any".to_owned(),
            source: None,
            spin_form: SpinForm::Period,
            spin: Quantity::exact(0.25),
            width: one,
            width_change: one,
            lambda: one,
            chi: one,
            years: one,
            inertia: Inertia::Uniform { density: Quantity::exact(3.0), oblateness: Quantity::exact(0.5) },
            eta: Eta::Unknown,
            speed: None,
        };
        assert_eq!(pulsar.map(|quantity| quantity), pulsar);
    }
}
