//! Groups of columns that a scene's table can have: header and values of each side by side.
//!
//! A new group is an entry in `motion.rs` or `observables.rs` and its place in [`ALL`].

mod column;
mod motion;
mod observables;

use twofold::dynamics::BodyState;
use twofold::euler_angles::EulerAngles;
use twofold::plan::Output;
use twofold::propagation::AxisState;

use crate::scene_file::{Scene, Units};

pub use column::Column;
pub use observables::strain_of_scene;

/// Columns that belong together.
#[derive(Debug)]
pub struct ColumnGroup {
    /// Name in a scene file and on the command line.
    pub name: &'static str,
    /// What the scene must have.
    needs: &'static [Need],
    /// What a plan takes it for: the state and the times that it needs.
    pub output: Output,
    /// Names of the columns with their units.
    pub header: fn(&Units) -> Vec<String>,
    /// As many values as the header has names, in the units of the output; none where they do not exist.
    pub values: fn(&Scene, &mut Moment<'_>) -> Option<Vec<f64>>,
}

impl PartialEq for ColumnGroup {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// One time of a motion.
pub struct Moment<'m> {
    /// Time since the start, in t_c.
    pub since_start: f64,
    /// State at that time, as far as the plan carries it.
    pub state: Carried,
    /// The Euler angles with their turns, unless the symmetry axis is on a pole; computed where they are wanted.
    pub angles: &'m mut dyn FnMut() -> Option<EulerAngles<f64>>,
}

/// As much of a state as a plan carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Carried {
    /// No motion.
    Nothing,
    /// Symmetry axis and angular momentum.
    Axis(AxisState<f64>),
    /// The whole orientation.
    Orientation(BodyState<f64>),
}

impl Moment<'_> {
    /// Symmetry axis and angular momentum.
    ///
    /// # Panics
    /// For a group whose output does not need them.
    fn axis(&self) -> AxisState<f64> {
        match &self.state {
            Carried::Axis(state) => *state,
            Carried::Orientation(state) => AxisState::from(state),
            Carried::Nothing => panic!("the group's output needs no state"),
        }
    }

    /// The whole orientation.
    ///
    /// # Panics
    /// For a group whose output does not need it.
    fn orientation(&self) -> &BodyState<f64> {
        match &self.state {
            Carried::Orientation(state) => state,
            Carried::Nothing | Carried::Axis(_) => panic!("the group's output needs no orientation"),
        }
    }
}

/// An optional part of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Need {
    Observer,
    Distance,
    Pulsar,
    Constants,
}

impl Need {
    /// What the scene lacks.
    fn missing_from(self, scene: &Scene) -> Option<String> {
        let because = |missing: bool, what: &str| missing.then(|| what.to_owned());
        match self {
            Need::Observer => because(scene.observer.is_none(), "the section [observer]"),
            Need::Pulsar => because(scene.pulsar.is_none(), "the section [pulsar]"),
            Need::Distance => because(
                scene.units.are_physical() && scene.observer.is_some_and(|observer| observer.distance.is_none()),
                "`observer.distance` [kpc], without which a physical star has no strain",
            ),
            Need::Constants => scene.perturbation.as_ref().err().map(|why| format!("a perturbation solution: {why}")),
        }
    }
}

impl ColumnGroup {
    /// Whether the scene has what the group is computed from.
    ///
    /// # Errors
    /// A sentence that says what the scene lacks.
    pub fn available_in(&self, scene: &Scene) -> Result<(), String> {
        let missing: Vec<_> = self.needs.iter().filter_map(|need| need.missing_from(scene)).collect();
        if missing.is_empty() { Ok(()) } else { Err(format!("the scene lacks {}", missing.join(" and "))) }
    }
}

/// All groups in the order of the columns; the first six are those of the motion.
pub const ALL: [&ColumnGroup; 12] = [
    &motion::ANGLES,
    &motion::RATES,
    &motion::EQUATORIAL_AXIS,
    &motion::SYMMETRY_AXIS,
    &motion::MOMENTUM,
    &motion::INTEGRALS,
    &motion::PERTURBATION,
    &observables::LAMBDA,
    &observables::LINE_OF_SIGHT,
    &observables::MAGNETIC_AXIS,
    &observables::POSITION_ANGLE,
    &observables::STRAIN,
];

/// The groups of the motion itself, which every scene has: the columns of a scene that does not name any.
pub fn of_the_motion() -> Vec<&'static ColumnGroup> {
    ALL[..6].to_vec()
}

/// The group called `name`.
pub fn named(name: &str) -> Option<&'static ColumnGroup> {
    ALL.into_iter().find(|group| group.name == name)
}

/// The groups `wanted` in the order of the columns.
pub fn in_order(wanted: &[&'static ColumnGroup]) -> Vec<&'static ColumnGroup> {
    ALL.into_iter().filter(|group| wanted.contains(group)).collect()
}

/// `name_X [unit]`, `name_Y [unit]`, `name_Z [unit]`.
fn components(name: &str, unit: &str) -> Vec<String> {
    ["X", "Y", "Z"].map(|axis| format!("{name}_{axis} [{unit}]")).to_vec()
}

/// `name [unit]` for each.
fn with_unit(names: &[&str], unit: &str) -> Vec<String> {
    names.iter().map(|name| format!("{name} [{unit}]")).collect()
}
