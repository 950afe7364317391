//! Sweep files: a scene, the parameters that are varied in it, the times and the columns, read from TOML and checked.

use std::path::Path;

use rand_distr::Normal;
use toml::de::{DeTable, DeValue};
use twofold::plan::Output;

use super::outputs::{ERRORS, Outputs, Summary};
use super::parameters::{Law, Parameters, Points, Source};
use super::{MOST_COLUMNS, MOST_SCENES, Sweep};
use crate::scene_file::{
    COLUMN_GROUPS, Columns, Entry, Fault, FileFormat, Replaced, SCENE, Scene, SceneError, Section, Times, built_in,
    columns_in, did_you_mean, listed, read_end, read_times, read_tolerance_and_method,
};

const SWEEP: FileFormat = FileFormat { name: "a sweep", built_in: None };

/// Sections of a scene that can be varied.
const VARIED_SECTIONS: [&str; 5] = ["star", "lorentz_violation", "initial", "observer", "pulsar"];

/// The text of a sweep file and of its scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepText {
    /// Path, as in messages.
    pub file: String,
    /// Text of the file.
    pub text: String,
    /// Name and text of the scene, if it is not in the file itself.
    pub scene: Option<(String, String)>,
}

impl SweepText {
    /// Reads the sweep file at `path` and its scene: a built-in one, or a file in the same folder.
    pub fn read(path: &str) -> Result<Self, SceneError> {
        Self::of(path, SWEEP.read(path)?)
    }

    /// A sweep file at `path` with a given text, and its scene.
    pub fn of(path: &str, text: String) -> Result<Self, SceneError> {
        Self::with(path, text, |name| match built_in(name) {
            Some(built_in) => Ok((name.to_owned(), built_in.toml.to_owned())),
            None => {
                let file = Path::new(path).parent().unwrap_or(Path::new("")).join(name);
                let file = file.to_string_lossy().into_owned();
                let text = SCENE.read(&file)?;
                Ok((file, text))
            }
        })
    }

    /// A sweep file with a given text; `find` returns the scene for its name: a name for messages and a text.
    pub fn with(
        path: &str,
        text: String,
        find: impl FnOnce(&str) -> Result<(String, String), SceneError>,
    ) -> Result<Self, SceneError> {
        let name = SWEEP.parse(path, &text, |document| {
            Ok(document
                .optional("scene")
                .filter(Entry::is_string)
                .map(|entry| entry.string())
                .transpose()?
                .map(String::from))
        })?;
        let scene = name.map(|name| find(&name));
        Ok(Self { file: path.to_owned(), text, scene: scene.transpose()? })
    }
}

#[derive(Debug)]
pub(super) struct Base<'t> {
    text: &'t str,
    table: DeTable<'t>,
    /// Whether the table is the sweep file, with the scene in its section `scene`.
    inside: bool,
}

impl Base<'_> {
    fn document(&self) -> Section<'_> {
        let scene = self.table.iter().find(|(key, _)| self.inside && key.get_ref() == "scene");
        let table = match scene.map(|(_, value)| value.get_ref()) {
            Some(DeValue::Table(table)) => table,
            _ => &self.table,
        };
        Section::document(self.text, table, "a scene")
    }

    /// The scene with `numbers` replacing those under `keys`, and the times of the sweep replacing its own.
    pub(super) fn scene(&self, keys: &[String], numbers: &[f64], times: &Times) -> Result<Scene, String> {
        let document = self.document().replacing(Replaced { keys, numbers });
        Scene::from_document(&document, Columns::Unused, Some(times)).map_err(|fault| fault.message)
    }
}

impl<'t> Sweep<'t> {
    /// Reads and checks a sweep.
    ///
    /// # Errors
    /// A [`SceneError`] for text that is not TOML, for keys that are unknown, missing or mutually exclusive, for values of a
    /// wrong type or out of range, and for a scene that is not usable as written.
    pub fn new(text: &'t SweepText) -> Result<Self, SceneError> {
        let document = SWEEP.table(&text.file, &text.text)?;
        let section = Section::document(&text.text, &document, SWEEP.name);
        let in_sweep = |fault| SceneError::in_text(&text.file, &text.text, fault);
        let about = check_keys(&section).map_err(in_sweep)?;
        let (name, scene_text) = text.scene.as_ref().map_or((&text.file, &text.text), |(name, text)| (name, text));
        let table = SCENE.table(name, scene_text)?;
        let base = Base { text: scene_text, table, inside: text.scene.is_none() };
        let in_scene = |fault| SceneError::in_text(name, scene_text, fault);
        let times = times(&section).map_err(in_sweep)?;
        let scene = base.document();
        let with = |times| Scene::from_document(&scene, Columns::Unused, times).map_err(in_scene);
        if let Some(section) = scene.section("spin_down").map_err(in_scene)? {
            return Err(in_scene(section.fault("[spin_down] is only for `twofold timing`; leave it out for a sweep")));
        }
        if let Some(entry) = scene.section("star").map_err(in_scene)?.as_ref().and_then(|star| star.optional("bulge")) {
            return Err(in_scene(entry.refuse_because("a sweep is only for rigid stars; leave it out")));
        }
        // The scene's own times, if it has any, are checked although they are not used.
        let own = scene.has("time").then(|| with(None)).transpose()?;
        let mut scene = with(Some(&times))?;
        let cautions = own.map_or_else(|| scene.cautions.clone(), |own| own.cautions);
        let varied = VARIED_SECTIONS.iter().filter_map(|name| base.document().section(name).ok().flatten());
        let known: Vec<_> = varied.flat_map(|section| section.numbers()).collect();
        let text_of = |key: &str| {
            let (name, key) = key.split_once('.').filter(|(name, _)| VARIED_SECTIONS.contains(name))?;
            base.document().section(name).ok()??.optional(key)?.string().ok()
        };
        let in_degrees = |key: &str| text_of(key).is_some_and(|text| text.ends_with("deg"));
        let parameters = parameters(&section, &known, in_degrees).map_err(in_sweep)?;
        let outputs = outputs(&section, &mut scene, times).map_err(in_sweep)?;
        // Means over the span and pulses follow every turn.
        let mut needed = outputs.outputs();
        if outputs.summaries.iter().any(|summary| matches!(summary, Summary::Lambda | Summary::Pulses)) {
            needed.push(Output::Pulses);
        }
        scene.check_rotation(&needed).map_err(|why| in_sweep(section.fault(why)))?;
        let count = parameters.count().filter(|count| *count <= MOST_SCENES);
        let scenes = count.ok_or_else(|| {
            in_sweep(section.fault(format!("the sweep has too many scenes; at most {MOST_SCENES:.0e} are possible")))
        })?;
        let (tolerance, method, units) = (scene.tolerance, scene.method, scene.units);
        let rotation = scene.rotation();
        let sweep = Sweep { about, base, parameters, outputs, scenes, cautions, tolerance, method, units, rotation };
        let columns = sweep.header().len();
        if columns > MOST_COLUMNS {
            let why = format!("the sweep has {columns} columns: must be at most {MOST_COLUMNS}; use fewer times");
            return Err(in_sweep(section.fault(why)));
        }
        Ok(sweep)
    }
}

/// Checks the keys of the document; returns the description of the sweep.
fn check_keys(document: &Section<'_>) -> Result<String, Fault> {
    document.only("about scene seed draws vary time output")?;
    let about = document.optional_string("about")?.unwrap_or("");
    let scene = document.required("scene", "a built-in scene, the path of a scene file, or a section [scene]")?;
    if !scene.is_string() {
        document.table("scene", "the name of a scene, or a section [scene]")?;
    }
    Ok(about.to_owned())
}

/// The times of the columns: those in a section like that of a scene, or only the end of the span.
fn times(document: &Section<'_>) -> Result<Times, Fault> {
    let section = document.required_section("time", "the times of the columns")?;
    section.only("start span end samples times")?;
    if section.has("times") || section.has("samples") {
        return read_times(&section);
    }
    section.not_both(&[("span", "end")])?;
    let start = section.number_or("start", 0.0)?;
    let (end, _) = read_end(&section, start)?;
    if end == start || !end.is_finite() {
        return Err(section.fault("[time] has a span that is lost in the rounding of its ends; use a longer one"));
    }
    Ok(Times::Listed { start, times: vec![end] })
}

fn parameters(
    document: &Section<'_>,
    known: &[String],
    in_degrees: impl Fn(&str) -> bool,
) -> Result<Parameters, Fault> {
    let mut found = Parameters { keys: Vec::new(), sources: Vec::new(), lengths: Vec::new(), seed: 0 };
    let mut groups: Vec<(&str, usize)> = Vec::new();
    let mut streams = 0;
    for section in document.repeated_section("vary", "a parameter of the scene and its numbers")? {
        section.only("parameter values grid random together")?;
        section.not_both(&[("values", "grid"), ("values", "random"), ("grid", "random"), ("together", "random")])?;
        let parameter = section.required("parameter", "dotted key of a number of the scene")?;
        if parameter.string().is_ok_and(&in_degrees) {
            return Err(parameter.refuse_because("the scene gives it in degrees; write a number there, in rad"));
        }
        found.keys.push(parameter_key(&parameter, known, &found.keys)?);
        let Some((length, points)) = listed_points(&section)? else {
            let random = section.table("random", "{ distribution = \"..\", .. }")?;
            let random = random.ok_or_else(|| section.missing("one of `values`, `grid` and `random`"))?;
            found.sources.push(Source::Random { stream: streams, law: law(&random)? });
            streams += 1;
            continue;
        };
        let name = section.optional("together").map(|entry| entry.string().map(|name| (entry, name))).transpose()?;
        let group = name.as_ref().and_then(|(_, name)| groups.iter().find(|group| group.0 == *name));
        let axis = group.map_or(found.lengths.len(), |group| group.1);
        match (found.lengths.get(axis), name) {
            (Some(first), Some((entry, _))) if *first != length => {
                return Err(entry.refuse_because(&format!(
                    "the number of points is {length}: must be {first}, as for the others of the group"
                )));
            }
            (Some(_), _) => {}
            (None, name) => {
                groups.extend(name.map(|(_, name)| (name, axis)));
                found.lengths.push(length);
            }
        }
        found.sources.push(Source::Axis(axis, points));
    }
    random_axis(document, streams > 0, &mut found)?;
    Ok(found)
}

/// The axis of the random draws, the last one, and their seed.
fn random_axis(document: &Section<'_>, is_random: bool, found: &mut Parameters) -> Result<(), Fault> {
    for key in ["seed", "draws"] {
        if let Some(entry) = document.optional(key).filter(|_| !is_random) {
            return Err(entry.refuse_because("no parameter is random"));
        }
    }
    if is_random {
        let draws = document.required("draws", "number of random draws for each point of the grids and lists")?;
        let seed = document.required("seed", "a whole number, the seed of the random draws")?;
        found.seed = seed.whole_number(0, i64::MAX as usize)? as u64;
        found.lengths.push(draws.whole_number(1, MOST_SCENES as usize)? as u64);
    }
    Ok(())
}

/// The key named by an entry, if the scene has a number there and it is not already varied.
fn parameter_key(entry: &Entry<'_>, known: &[String], taken: &[String]) -> Result<String, Fault> {
    let key = entry.string()?;
    if taken.iter().any(|taken| taken == key) {
        return Err(entry.refuse_because("is already varied"));
    }
    if known.iter().any(|known| known == key) {
        return Ok(key.to_owned());
    }
    let known: Vec<_> = known.iter().map(String::as_str).collect();
    let guess = did_you_mean(key, &known);
    Err(entry.refuse_because(&format!("must be a number of the scene file, one of {}.{guess}", listed(&known))))
}

/// The numbers of a list or a grid, and their count; `None` if there is neither.
fn listed_points(section: &Section<'_>) -> Result<Option<(u64, Points)>, Fault> {
    const LISTS: &str = "a list of at least one number";
    if let Some(entry) = section.optional("values") {
        let values = entry.list(LISTS)?.iter().map(Entry::number).collect::<Result<Vec<_>, _>>()?;
        if values.is_empty() {
            return Err(entry.refuse(LISTS));
        }
        return Ok(Some((values.len() as u64, Points::Values(values))));
    }
    let grid = section.table("grid", "{ from = .., to = .., points = .. }")?;
    grid.map(|grid| self::grid(&grid)).transpose()
}

fn grid(section: &Section<'_>) -> Result<(u64, Points), Fault> {
    section.only("from to points scale")?;
    let points = section.required("points", "number of points, both ends included")?;
    let points = points.whole_number(2, MOST_SCENES as usize)? as u64;
    let scale = section.optional("scale").map_or(Ok("linear"), |entry| entry.word(&["linear", "log"]))?;
    let logarithmic = scale == "log";
    let (from, to) = ends(section, logarithmic)?;
    Ok((points, Points::Grid { from, to, logarithmic }))
}

fn law(section: &Section<'_>) -> Result<Law, Fault> {
    const NAMES: [&str; 3] = ["uniform", "log-uniform", "normal"];
    let name = section.required("distribution", "\"uniform\", \"log-uniform\" or \"normal\"")?.word(&NAMES)?;
    if name == "normal" {
        section.only("distribution mean deviation")?;
        let mean = section.required("mean", "mean")?.number()?;
        let entry = section.required("deviation", "standard deviation")?;
        // No draw is 64 deviations away.
        let is_finite = |x: f64| x > 0.0 && (mean.abs() + 64.0 * x).is_finite();
        let deviation = entry.number_where("a number above zero, so small that every draw is finite", is_finite)?;
        return Normal::new(mean, deviation).map(Law::Normal).map_err(|error| entry.refuse_because(&error.to_string()));
    }
    section.only("distribution from to")?;
    let (from, to) = ends(section, name == "log-uniform")?;
    Ok(if name == "uniform" { Law::Uniform { from, to } } else { Law::LogUniform { from, to } })
}

/// The two ends of an interval: different, and of the same sign if it is divided in equal ratios.
fn ends(section: &Section<'_>, by_ratios: bool) -> Result<(f64, f64), Fault> {
    let from_entry = section.required("from", "first end")?;
    let from = if by_ratios {
        from_entry.number_where("a number other than zero; the points are in equal ratios", |x| x != 0.0)?
    } else {
        from_entry.number()?
    };
    let to = section.required("to", "last end")?;
    let to = if by_ratios {
        to.number_where(
            "a number of the same sign as `from`, but not equal to it; the points are in equal ratios",
            |x| x * from.signum() > 0.0 && x != from,
        )?
    } else {
        to.number_where("a number other than `from`", |x| x != from)?
    };
    Ok((from, to))
}

/// Reads the section `[output]`, its tolerance and method into the scene.
fn outputs(document: &Section<'_>, scene: &mut Scene, times: Times) -> Result<Outputs, Fault> {
    let mut outputs = Outputs { times, groups: Vec::new(), errors: true, summaries: Vec::new() };
    outputs.groups = vec![Output::SymmetryAxis, Output::AngularMomentum];
    let Some(section) = document.section("output")? else { return Ok(outputs) };
    section.only("columns summaries tolerance method")?;
    read_tolerance_and_method(&section, scene)?;
    if let Some(list) = section.optional("columns") {
        let names: Vec<_> = COLUMN_GROUPS.iter().map(|(name, _)| *name).chain([ERRORS]).collect();
        let words = list.words(&names)?;
        outputs.errors = words.iter().any(|(_, name)| *name == ERRORS);
        outputs.groups = columns_in(&words, scene)?;
    }
    if let Some(list) = section.optional("summaries") {
        for (entry, name) in list.words(&Summary::ALL.map(|(name, _)| name))? {
            for (_, summary) in Summary::ALL.iter().filter(|(known, _)| *known == name) {
                let needed = summary.output().map_or(Ok(()), |output| scene.has_what_is_needed_for(output));
                needed.map_err(|why| entry.refuse_because(&why))?;
                outputs.summaries.push(*summary);
            }
        }
    }
    if outputs.groups.is_empty() && !outputs.errors && outputs.summaries.is_empty() {
        return Err(section.fault("[output] requests nothing; give columns, summaries or both"));
    }
    Ok(outputs)
}
