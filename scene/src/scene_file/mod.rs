//! Scene files: a star, its initial motion, the violation and the times asked for, read from TOML and checked.
//!
//! The format is described in `docs/scenes.md`. Everything is checked before anything is computed; a refusal names the
//! file, line, column and key, the value as written and what is allowed.

mod built_in;
mod document;
mod error;
mod initial;
mod observer;
mod output;
mod section;
mod star;
mod time;
mod violation;

use nalgebra::Matrix3;
use twofold::Error;
use twofold::dynamics::equations_of_motion::angular_velocity;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::epoch::Epoch;
use twofold::euler_angles::EulerAngles;
use twofold::plan::{Method, Output, Plan, Request};
use twofold::solutions::perturbation::Perturbation;

use crate::columns::{self, ColumnGroup};

pub use built_in::{BUILT_IN, BuiltIn, PULSARS, built_in};
use document::BuiltInNames;
pub(crate) use document::FileKind;
pub(crate) use error::Fault;
pub use error::SceneError;
pub use observer::{Catalogued, Pulsar, Viewer};
pub(crate) use output::read_accuracy_and_method;
pub(crate) use section::{Entry, Replaced, Section};
pub use section::{listed, nearest, shortened};
pub use star::Units;
pub use time::Times;
pub use time::like_julian_date;
pub(crate) use time::read as read_times;

/// Largest scene file that is read, in bytes.
pub const LARGEST_FILE: u64 = 64 << 20;

/// Largest rotation over the whole span that is computed, in rad; it takes some minutes.
pub const LARGEST_ROTATION: f64 = 1e8;

/// A checked scene. Inside it everything is in the paper's units, `I^xx = C = 1`, with time in `t_c`.
#[derive(Debug, Clone)]
pub struct Scene {
    /// What the scene is, one line; may be empty.
    pub about: String,
    /// The star.
    pub spheroid: RigidSpheroid<f64>,
    /// `s^IJ` in the inertial frame of the output.
    pub violation: Matrix3<f64>,
    /// State at the time `times.start()`, in the inertial frame of the output.
    pub initial: BodyState<f64>,
    /// Euler angles of that state, with their turns, and on a pole as given.
    pub initial_angles: EulerAngles<f64>,
    /// Times of the output, in units of the output.
    pub times: Times,
    /// Modified Julian date (TDB at the barycentre) of the time `times.start()`, where the file says so.
    pub epoch: Option<Epoch>,
    /// Where the numbers of the file come from.
    pub sources: Vec<String>,
    /// Who looks on, where the file says so.
    pub observer: Option<Viewer>,
    /// What shines, where the file says so.
    pub pulsar: Option<Pulsar>,
    /// What the pulsar is called and where it is, where the file says so.
    pub catalogued: Option<Catalogued>,
    /// The perturbation solution of the scene's constants as printed, with time from the start in t_c, or why there is none.
    pub perturbation: Result<Perturbation<f64>, &'static str>,
    /// Columns of the output, in its order.
    pub columns: Vec<&'static ColumnGroup>,
    /// Truncation error wanted at the end of the span.
    pub accuracy: f64,
    /// The method of the motion, where one is named.
    pub method: Option<Method>,
    /// Units of the file and of the output.
    pub units: Units,
    /// What in the file is allowed and looks like a mistake, a sentence each.
    pub cautions: Vec<String>,
}

/// The columns that a scene is read for.
#[derive(Clone, Copy)]
pub(crate) enum Columns<'a> {
    /// Those of the file.
    OfTheFile,
    /// The groups of these names.
    Named(&'a [&'a str]),
    /// None: the file may name groups without what these need.
    Unused,
}

impl Scene {
    /// The scene with the built-in name, or in the file at the path, `name_or_path`. Built-in names come first: write
    /// `./tp-1` for a file of that name.
    ///
    /// # Errors
    /// A file that cannot be read, and everything that [`Scene::from_toml`] refuses.
    pub fn named(name_or_path: &str) -> Result<Self, SceneError> {
        Self::named_for(name_or_path, Columns::OfTheFile)
    }

    /// As [`Scene::named`], with the groups of columns called `names` in place of those of the file.
    ///
    /// # Errors
    /// Those of [`Scene::named`], and those of [`Scene::choose_columns`].
    pub fn named_with_columns(name_or_path: &str, names: &[&str]) -> Result<Self, SceneError> {
        Self::named_for(name_or_path, Columns::Named(names))
    }

    /// As [`Scene::named`], for one who does not use the columns of the file: they are those of the motion, and the file may
    /// name groups without what these need.
    ///
    /// # Errors
    /// Those of [`Scene::named`], but for the needs of columns.
    pub fn named_without_columns(name_or_path: &str) -> Result<Self, SceneError> {
        Self::named_for(name_or_path, Columns::Unused)
    }

    fn named_for(name_or_path: &str, columns: Columns<'_>) -> Result<Self, SceneError> {
        let read =
            |file: &str, text: &str| SCENE.parse(file, text, |document| Self::from_document(document, columns, None));
        match built_in(name_or_path) {
            Some(built_in) => read(built_in.name, built_in.toml),
            None => read(name_or_path, &SCENE.read(name_or_path)?),
        }
    }

    /// Reads and checks the text of a scene file; `file` is how messages call it.
    ///
    /// # Errors
    /// A [`SceneError`] for text that is not TOML, for keys that are unknown, missing or exclude one another, and for
    /// values of a wrong type or out of range.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SceneError> {
        SCENE.parse(file, text, |document| Self::from_document(document, Columns::OfTheFile, None))
    }

    /// The scene of a document, with `times` in place of its own section `[time]` if there are any.
    pub(crate) fn from_document(
        document: &Section<'_>,
        columns: Columns<'_>,
        times: Option<&Times>,
    ) -> Result<Self, Fault> {
        document.only(&[
            "about",
            "sources",
            "star",
            "lorentz_violation",
            "initial",
            "observer",
            "pulsar",
            "time",
            "output",
        ])?;
        let about = document.optional("about").map(|entry| entry.string()).transpose()?.unwrap_or("").to_owned();
        let sources = document.optional("sources").map(|entry| sources(&entry)).transpose()?.unwrap_or_default();
        let star_section = document.required_section("star", "the spheroid and its spin")?;
        let (star, spin_caution) = star::read(&star_section)?;
        let violation = violation::read(&document.required_section("lorentz_violation", "the coefficients s^IJ")?)?;
        let initial_section = document.required_section("initial", "the initial orientation and motion")?;
        let initial = initial::read(&initial_section, &star, &violation)?;
        let observer = document.section("observer")?;
        let observer = observer.map(|section| observer::read_observer(&section, &star.units)).transpose()?;
        let pulsar_section = document.section("pulsar")?;
        let pulsar = pulsar_section.as_ref().map(observer::read_pulsar).transpose()?;
        let catalogued = pulsar_section.as_ref().map(observer::read_catalogued).transpose()?.flatten();
        let (time_section, times, epoch, epoch_caution) = match times {
            Some(times) => (None, times.clone(), None, None),
            None => {
                let section = document.required_section("time", "the times of the output")?;
                let times = time::read_with_years(&section, &star.units)?;
                let (epoch, caution) = time::read_epoch(&section, &star.units, &times)?.unzip();
                (Some(section), times, epoch, caution.flatten())
            }
        };
        let output = document.section("output")?;
        let mut scene = Scene {
            about,
            spheroid: star.spheroid,
            violation: violation.tensor,
            initial: initial.state,
            initial_angles: initial.angles,
            times,
            epoch,
            sources,
            observer,
            pulsar,
            catalogued,
            perturbation: initial.perturbation,
            columns: columns::of_the_motion(),
            accuracy: output::DEFAULT_ACCURACY,
            method: None,
            units: star.units,
            cautions: [spin_caution, epoch_caution].into_iter().flatten().collect(),
        };
        if let Some(output) = &output {
            output::read(output, &mut scene, matches!(columns, Columns::OfTheFile))?;
        }
        if let Columns::Named(names) = columns {
            let refused = |why| Fault { span: None, message: format!("--columns: {why}") };
            scene.choose_columns(names).map_err(refused)?;
        }
        if !matches!(columns, Columns::Unused) {
            let outputs: Vec<_> = scene.columns.iter().map(|group| group.output).collect();
            let section = time_section.as_ref().unwrap_or(document);
            scene.check_rotation(&outputs).map_err(|why| section.fault(why))?;
        }
        Ok(scene)
    }

    /// Refuses a span of too many turns for what goes through all of them.
    pub(crate) fn check_rotation(&self, outputs: &[Output]) -> Result<(), String> {
        let rotation = self.rotation();
        if rotation <= LARGEST_ROTATION || self.plan(outputs).is_ok() {
            return Ok(());
        }
        Err(format!(
            "[time] asks for a rotation by {rotation:.1e} rad: allowed is at most {LARGEST_ROTATION:.0e} rad, which takes \
             minutes, for pulses, angles that count their turns and motions without a closed form; shorten the span, lower the rates \
             or choose other columns"
        ))
    }

    /// The plan for some outputs over the span and at the samples of the scene. Times are those since the start, in t_c.
    ///
    /// # Errors
    /// A method that the scene does not allow, and a span too long for what goes through every turn.
    pub fn plan(&self, outputs: &[Output]) -> Result<Plan, Error> {
        let span = (0.0, (self.times.last() - self.times.start()) / self.units.time);
        let request = Request { method: self.method, ..Request::new(outputs, span, self.times.count(), self.accuracy) };
        let plan = Plan::from_parts(&self.spheroid, &self.violation, &self.initial, &request)?;
        let rotation = self.rotation();
        Error::ensure(
            rotation <= LARGEST_ROTATION || plan.costs_the_same_at_any_time(),
            "rotation over the span (rad)",
            rotation,
            "at most 1e8 for pulses, angles that count their turns and motions without a closed form",
        )?;
        Ok(plan)
    }

    /// The plan for the columns of the scene.
    ///
    /// # Errors
    /// As for [`Scene::plan`].
    pub fn plan_of_columns(&self) -> Result<Plan, Error> {
        let outputs: Vec<_> = self.columns.iter().map(|group| group.output).collect();
        self.plan(&outputs)
    }

    /// Upper estimate of the angle through which the body turns over the span, in rad.
    pub fn rotation(&self) -> f64 {
        let duration = (self.times.last() - self.times.start()).abs() / self.units.time;
        duration * self.turning_rate()
    }

    /// Upper estimate of the rate at which directions turn, per `t_c`.
    pub(crate) fn turning_rate(&self) -> f64 {
        let BodyState { axis, momentum, .. } = &self.initial;
        let omega = angular_velocity(&self.spheroid, axis, momentum).norm();
        omega.max(momentum.norm()) + (2.0 * self.violation.norm()).sqrt()
    }
}

fn sources(entry: &Entry<'_>) -> Result<Vec<String>, Fault> {
    let list = entry.list("a list of strings")?;
    list.iter().map(|source| source.string().map(str::to_owned)).collect()
}

/// A scene, in the words of the messages.
pub(crate) const SCENE: FileKind =
    FileKind { name: "a scene", built_in: Some(BuiltInNames { names: built_in::names, listed_by: "twofold scenes" }) };
