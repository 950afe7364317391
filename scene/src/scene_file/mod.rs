//! Scene files: a star, its initial motion, the coefficients for Lorentz violation and the times of the output, read from TOML and checked.
//!
//! The format is described in `docs/scenes.md`. Everything is checked before anything is computed; an error message names
//! the file, line, column and key, the value as written and the allowed values.

mod built_in;
mod document;
mod fault;
mod motion;
mod names;
mod observation;
mod rotation;
mod spin_down;
#[cfg(test)]
mod tests;

use twofold::dynamics::Problem;
use twofold::epoch::Epoch;
use twofold::euler_angles::EulerAngles;
use twofold::plan::{Method, Output};
use twofold::solutions::perturbation::Perturbation;

pub use built_in::{BUILT_IN, BuiltIn, PULSARS, TEMPLATES, built_in, names};
pub(crate) use document::{Entry, FileFormat, Replaced, Section};
pub(crate) use fault::Fault;
pub use fault::SceneError;
pub use motion::Units;
pub use names::{counted, did_you_mean, listed, nearest, shortened};
pub use observation::{COLUMN_GROUPS, Catalogued, MOST_SAMPLES, Pulsar, Times, Viewer, column_group, like_julian_date};
pub(crate) use observation::{NAMELESS, columns_in, read_end, read_times, read_tolerance_and_method};
pub use spin_down::{IndexOrSecond, SpinDown};

/// A checked scene. Internally everything is in the paper's units, `I^xx = C = 1`, with time in `t_c`.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Description of the scene, one line; may be empty.
    pub about: String,
    /// The star, `s^IJ` and the state at the time `times.start()`, in the inertial frame of the output.
    pub problem: Problem<f64>,
    /// Euler angles of that state, including whole turns; at a pole as given.
    pub initial_angles: EulerAngles<f64>,
    /// Times of the output, in units of the output.
    pub times: Times,
    /// Modified Julian date (TDB at the barycentre) of the time `times.start()`, if given in the file.
    pub epoch: Option<Epoch>,
    /// Sources of the numbers in the file.
    pub sources: Vec<String>,
    /// The observer, if given in the file.
    pub observer: Option<Viewer>,
    /// The beam of the pulsar, if given in the file.
    pub pulsar: Option<Pulsar>,
    /// Name and position of the pulsar, if given in the file.
    pub catalogued: Option<Catalogued>,
    /// The spin-down of the star, if given in the file; used for arrival times.
    pub spin_down: Option<SpinDown>,
    /// The perturbation solution for the scene's constants as printed, with time from the start in t_c, or the reason why
    /// there is none.
    pub perturbation: Result<Perturbation<f64>, &'static str>,
    /// Groups of columns of the table, in order.
    pub columns: Vec<Output>,
    /// Largest truncation error at the end of the span.
    pub tolerance: f64,
    /// The method of the motion, if one is named.
    pub method: Option<Method>,
    /// Units of the file and of the output.
    pub units: Units,
    /// Sentences about allowed entries of the file that look like a mistake.
    pub cautions: Vec<String>,
}

/// The columns for which a scene is read.
#[derive(Clone, Copy)]
pub enum Columns<'a> {
    /// The columns of the file.
    OfTheFile,
    /// The columns of the file; [`Scene::check_rotation`] decides later whether they can be computed.
    OfTheFileLater,
    /// The groups of these names.
    Named(&'a [&'a str]),
    /// No columns: the file may name groups without the sections they need.
    Unused,
}

impl Scene {
    /// The scene with the built-in name, or in the file at the path; `./tp-1` is a file, `tp-1` is built in.
    pub fn named(name_or_path: &str) -> Result<Self, SceneError> {
        Self::named_with(name_or_path, Columns::OfTheFile)
    }

    /// As [`Scene::named`], for columns other than those of the file.
    pub fn named_with(name_or_path: &str, columns: Columns<'_>) -> Result<Self, SceneError> {
        Self::from_toml_with(name_or_path, &text_of(name_or_path)?, columns)
    }

    /// Reads and checks the text of a scene file; `file` is its name in messages.
    ///
    /// # Errors
    /// A [`SceneError`] for text that is not TOML, for keys that are unknown, missing or mutually exclusive, and for values
    /// of a wrong type or out of range.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(file, text, Columns::OfTheFile)
    }

    /// As [`Scene::from_toml`], for columns other than those of the file.
    ///
    /// # Errors
    /// As for [`Scene::from_toml`].
    pub fn from_toml_with(file: &str, text: &str, columns: Columns<'_>) -> Result<Self, SceneError> {
        SCENE.parse(file, text, |document| Self::from_document(document, columns, None))
    }

    /// The scene of a document, with `times` in place of its own section `[time]`, if given.
    pub(crate) fn from_document(
        document: &Section<'_>,
        columns: Columns<'_>,
        times: Option<&Times>,
    ) -> Result<Self, Fault> {
        document.only("about sources star spin_down lorentz_violation initial observer pulsar time output")?;
        let about = document.optional_string("about")?.unwrap_or("").to_owned();
        let sources = document.optional("sources").map(|entry| sources(&entry)).transpose()?.unwrap_or_default();
        let star_section = document.required_section("star", "the spheroid and its spin")?;
        let angles = rotation::WobbleAngles::read(document)?;
        let (star, spin_caution) = motion::read_star(&star_section, &angles)?;
        let pulsar_section = document.section("pulsar")?;
        let pulsar = pulsar_section.as_ref().map(observation::read_pulsar).transpose()?;
        let violation =
            motion::read_violation(&document.required_section("lorentz_violation", "the coefficients s^IJ")?)?;
        let initial_section = document.required_section("initial", "the initial orientation and motion")?;
        let initial = motion::read_initial(&initial_section, &star, &violation, pulsar.as_ref())?;
        let problem = Problem::new(star.spheroid, violation.tensor, initial.state);
        let problem = problem.and_then(|problem| problem.with_bulge(star.bulge));
        let problem =
            problem.map_err(|error| initial_section.fault(format!("no motion has this initial state: {error}")))?;
        let spin_down_section = document.section("spin_down")?;
        let spin_down = spin_down_section.as_ref().map(|section| spin_down::read(section, &star.units)).transpose()?;
        let catalogued = pulsar_section.as_ref().map(observation::read_catalogued).transpose()?.flatten();
        let observer = document.section("observer")?;
        let read_observer = |section: Section<'_>| {
            let l = initial.state.momentum.try_normalize(0.0);
            observation::read_observer(&section, &star.units, l, catalogued.as_ref())
        };
        let observer = observer.map(read_observer).transpose()?;
        let (time_section, times, epoch, epoch_caution) = match times {
            Some(times) => (None, times.clone(), None, None),
            None => {
                let section = document.required_section("time", "the times of the output")?;
                let times = observation::read_time(&section, &star.units)?;
                let (epoch, caution) = observation::read_epoch(&section, &star.units, &times)?.unzip();
                (Some(section), times, epoch, caution.flatten())
            }
        };
        let output = document.section("output")?;
        let mut scene = Scene {
            about,
            problem,
            initial_angles: initial.angles,
            times,
            epoch,
            sources,
            observer,
            pulsar,
            catalogued,
            spin_down,
            perturbation: if star.bulge == 0.0 { initial.perturbation } else { Err(OF_RIGID_STARS) },
            columns: observation::columns_of_the_motion(),
            tolerance: observation::DEFAULT_TOLERANCE,
            method: None,
            units: star.units,
            cautions: [spin_caution, epoch_caution].into_iter().flatten().collect(),
        };
        if let Some(output) = &output {
            let of_the_file = matches!(columns, Columns::OfTheFile | Columns::OfTheFileLater);
            observation::read_output(output, &mut scene, of_the_file)?;
        }
        if let Columns::Named(names) = columns {
            let refused = |why| Fault { span: None, message: format!("--columns: {why}") };
            scene.choose_columns(names).map_err(refused)?;
        }
        if !matches!(columns, Columns::Unused | Columns::OfTheFileLater) {
            let section = time_section.as_ref().unwrap_or(document);
            scene.check_rotation(&scene.columns).map_err(|why| section.fault(why))?;
        }
        Ok(scene)
    }
}

/// The text of the scene with the built-in name, or of the file at the path.
///
/// # Errors
/// A file that cannot be read.
pub fn text_of(name_or_path: &str) -> Result<String, SceneError> {
    built_in(name_or_path).map_or_else(|| SCENE.read(name_or_path), |built_in| Ok(built_in.toml.to_owned()))
}

/// The reason why a star with a bulge has no printed perturbation solution.
const OF_RIGID_STARS: &str = "the paper's solution is that of a rigid star, and this one has a bulge (`star.bulge`)";

fn sources(entry: &Entry<'_>) -> Result<Vec<String>, Fault> {
    let list = entry.list("a list of strings")?;
    list.iter().map(|source| source.string().map(str::to_owned)).collect()
}

/// Files with a scene.
pub(crate) const SCENE: FileFormat =
    FileFormat { name: "a scene", built_in: Some((built_in::names, "twofold scenes")) };
