//! Lines and amplitude spectra of a column of a scene's table.

use std::io::Write;

use twofold::Error;
use twofold::observables::fundamental_frequencies::fundamental_frequencies;
use twofold::observables::spectrum::{
    FrequencyBasis, Generator, LineList, Series, SpectralLine, Window, amplitude_spectrum, spectral_lines,
};
use twofold::plan::{Counted, Method, Output, Plan, PlannedMotion, Request, Samples, State, Work};

use super::TrajectoryError;
use crate::columns::Column;
use crate::samples::{Sample, SampledState, SegmentState};
use crate::scene_file::Scene;

/// Highest frequency of a series over the upper estimate of the rotation rate: what is observed has harmonics.
const HARMONICS: f64 = 8.0;

/// Largest rotation of a series, in rad; the whole motion is in memory.
const LARGEST_ROTATION: f64 = 1e5;

/// Window of the amplitude spectrum: sidelobes of 1.8e-8.
const WINDOW: Window = Window::Kaiser { shape: 20.0 };

/// A column in equal steps over the span of a scene. Inside, times are those since the start, in t_c.
pub struct Sampling {
    /// The motion, where its fundamental frequencies are wanted.
    motion: Option<Counted<PlannedMotion>>,
    series: Series,
    /// Largest size of what the column is a part of, in its unit.
    size: f64,
    /// What it took.
    pub work: Work,
}

/// Most lines that are fitted, however few are written: the error of each counts the strongest one that is left out.
const MOST_FITTED: usize = 200;

/// Which lines are written.
#[derive(Debug, Clone, Copy)]
pub struct LinesWanted {
    /// Least amplitude as a part of the largest one.
    pub least: f64,
    /// Most lines that are written.
    pub most: usize,
    /// Whether lines are to be named by the fundamental frequencies of the motion.
    pub identified: bool,
}

/// What sets the least amplitude of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Floor {
    /// What was asked.
    Wanted,
    /// The tolerance of the motion, as a part of this size: of the column, or of what it is a component of.
    Tolerance(f64),
    /// The noise of what is left, rounding for instance: see [`LineList::noise`].
    Noise,
}

/// Constant term, counts and limits of a list of lines.
#[derive(Debug, Clone)]
pub struct LinesSummary {
    /// Constant term, in the unit of the column.
    pub constant: f64,
    /// Lines written.
    pub lines: usize,
    /// Lines found.
    pub found: usize,
    /// Lines among them in the upper fifth of the frequencies, where there may be others folded back from above.
    pub near_highest: usize,
    /// Lines written whose frequency is uncertain by more than `1 / T`: each stands for several.
    pub unresolved: usize,
    /// Least distance of two lines that are told apart, in rad per unit of time of the output.
    pub resolution: f64,
    /// Amplitude of the strongest line; zero without one.
    pub strongest: f64,
    /// Least amplitude of a line that is listed, and what sets it.
    pub least: f64,
    /// What sets `least`.
    pub floor: Floor,
    /// Largest amplitude left in the series; above `least`, lines are missing.
    pub remainder: f64,
    /// The fundamental frequencies in the unit of the output, or why there are none; none where they are not wanted.
    pub fundamental: Option<Result<Vec<Generator>, Error>>,
}

impl Sampling {
    /// Why the span of a scene cannot be sampled.
    pub fn check(scene: &Scene) -> Result<(), String> {
        let rotation = scene.rotation();
        if rotation == 0.0 {
            return Err("[time] has no length, so nothing has a spectrum".into());
        }
        if rotation <= LARGEST_ROTATION {
            return Ok(());
        }
        let (most, unit) = (LARGEST_ROTATION / scene.turning_rate() * scene.units.time, scene.units.time_name);
        Err(format!(
            "the span holds a rotation by {rotation:.1e} rad: allowed for a spectrum is at most {LARGEST_ROTATION:.0e} rad, here \
             {most:.3e} {unit}"
        ))
    }

    /// The plan for a column, and for the fundamental frequencies of the motion if lines are to be named by them.
    pub fn plan(scene: &Scene, column: &Column, identified: bool) -> Result<Plan, Error> {
        let frequencies = identified.then_some(Output::FundamentalFrequencies);
        let outputs: Vec<_> = [column.group].into_iter().chain(frequencies).collect();
        let (intervals, span) = (intervals(scene), (0.0, scene.duration()));
        let samples = Samples { count: intervals as usize + 1, last: span.1 };
        let request = Request { method: scene.method, samples, ..Request::new(&outputs, span, 0, scene.tolerance) };
        let plan = scene.problem.plan(&request)?;
        if scene.method.is_some() || plan.method != Some(Method::Torus) {
            return Ok(plan);
        }
        // The rounding of a Fourier series is a sum of lines, which a fit would find: the next best method has noise.
        let cost = |method: &Method| {
            let candidate = plan.considered.iter().find(|candidate| candidate.method == *method);
            candidate
                .and_then(|candidate| candidate.prediction.as_ref().ok())
                .filter(|other| plan.admits(other))
                .map(|other| other.cost)
        };
        let others = Method::ALL.into_iter().filter(|method| *method != Method::Torus && cost(method).is_some());
        let next = others.min_by(|a, b| cost(a).partial_cmp(&cost(b)).unwrap_or(core::cmp::Ordering::Equal));
        scene.problem.plan(&Request { method: next.or(Some(Method::Taylor)), ..request })
    }

    /// Computes the motion by a [`plan`](Sampling::plan) and samples a column, in steps that follow from the rotation rate alone.
    pub fn of(scene: &Scene, column: &Column, plan: &Plan) -> Result<Self, TrajectoryError> {
        match plan.state {
            State::Nothing => {
                let (series, size) = series(scene, column, |_| Ok(SampledState::Nothing))?;
                Ok(Self { motion: None, series, size, work: Work::default() })
            }
            State::Axis | State::AxisAndMomentum => {
                Self::of_motion(scene, column, plan.motion(&scene.problem.reduced())?).map(|(sampling, _)| sampling)
            }
            State::Orientation => {
                let (sampling, motion) = Self::of_motion(scene, column, plan.motion(&scene.problem)?)?;
                Ok(Self { motion: Some(motion), ..sampling })
            }
        }
    }

    fn of_motion<X: SegmentState>(
        scene: &Scene,
        column: &Column,
        motion: PlannedMotion<X>,
    ) -> Result<(Self, Counted<PlannedMotion<X>>), TrajectoryError> {
        let motion = Counted::new(motion);
        let (series, size) = series(scene, column, |t| X::sampled(&motion, [t, 0.0]))?;
        let mut work = motion.motion.work();
        work += motion.evaluations();
        Ok((Self { motion: None, series, size, work }, motion))
    }

    /// Number of values, time between two in the unit of the output, and Nyquist's frequency in rad per unit of time.
    pub fn describe(&self, scene: &Scene) -> (usize, f64, f64) {
        let unit = scene.units.time;
        (self.series.values.len(), self.series.step * unit, self.series.highest_frequency() / unit)
    }

    /// Writes the amplitude spectrum as CSV.
    pub fn write_spectrum(&self, scene: &Scene, column: &Column, writer: impl Write) -> Result<(), TrajectoryError> {
        let mut table = csv::Writer::from_writer(writer);
        table.write_record([frequency_title(scene, "frequency"), format!("amplitude [{}]", column.unit)])?;
        for (frequency, amplitude) in amplitude_spectrum(&self.series, WINDOW)?.points() {
            table.write_record([frequency / scene.units.time, amplitude].map(|x| format!("{x:?}")))?;
        }
        table.flush()?;
        Ok(())
    }

    /// Writes the lines as CSV, strongest first.
    pub fn write_lines(
        &self,
        scene: &Scene,
        column: &Column,
        wanted: &LinesWanted,
        writer: impl Write,
    ) -> Result<LinesSummary, TrajectoryError> {
        let basis = wanted.identified.then(|| self.basis()).transpose()?;
        let (floor, least, mut list) = self.lines(scene, wanted)?;
        let found = list.lines.len();
        let is_unresolved = |line: &SpectralLine| line.uncertainty * self.series.duration() > 1.0;
        list.lines.truncate(wanted.most);
        let unit = scene.units.time;
        let mut table = csv::Writer::from_writer(writer);
        table.write_record([
            frequency_title(scene, "frequency"),
            format!("amplitude [{}]", column.unit),
            "phase [rad]".to_owned(),
            frequency_title(scene, "uncertainty"),
            "combination".to_owned(),
        ])?;
        for line in &list.lines {
            let name = match &basis {
                _ if is_unresolved(line) => "unresolved".to_owned(),
                Some(Ok(basis)) => basis.identify(line.frequency, line.uncertainty).to_string(),
                Some(Err(_)) | None => "unidentified".to_owned(),
            };
            let numbers = [line.frequency / unit, line.amplitude, line.phase, line.uncertainty / unit];
            table.write_record(numbers.map(|x| format!("{x:?}")).into_iter().chain([name]))?;
        }
        table.flush()?;
        let in_output =
            |g: &Generator| Generator { frequency: g.frequency / unit, uncertainty: g.uncertainty / unit, ..*g };
        let high = 0.8 * self.series.highest_frequency();
        Ok(LinesSummary {
            constant: list.constant,
            lines: list.lines.len(),
            found,
            near_highest: list.lines.iter().filter(|line| line.frequency > high).count(),
            unresolved: list.lines.iter().filter(|line| is_unresolved(line)).count(),
            resolution: list.resolution / unit,
            strongest: list.lines.first().map_or(0.0, |line| line.amplitude),
            least,
            floor,
            remainder: list.remainder,
            fundamental: basis.map(|basis| basis.map(|basis| basis.generators().iter().map(in_output).collect())),
        })
    }

    /// The least amplitude of a line, what sets it, and the lines.
    fn lines(&self, scene: &Scene, wanted: &LinesWanted) -> Result<(Floor, f64, LineList), Error> {
        let values = &self.series.values;
        let weights = WINDOW.weights(values.len())?;
        let mean = weights.iter().zip(values).map(|(w, x)| w * x).sum::<f64>() / values.len() as f64;
        let about_mean = Series { values: values.iter().map(|x| x - mean).collect(), ..self.series };
        let spectrum = amplitude_spectrum(&about_mean, WINDOW)?;
        let strongest = spectrum.amplitudes.iter().fold(0.0_f64, |most, x| most.max(*x));
        // What is below the error of the motion is no line of it; nor may the least amplitude be zero.
        let (wanted, error) = (strongest * wanted.least, (self.size * scene.tolerance).max(f64::MIN_POSITIVE));
        let (floor, least) =
            if error > wanted { (Floor::Tolerance(self.size), error) } else { (Floor::Wanted, wanted) };
        let list = spectral_lines(&self.series, least, MOST_FITTED)?;
        Ok(if list.noise > least { (Floor::Noise, list.noise, list) } else { (floor, least, list) })
    }

    /// The fundamental frequencies, or why this motion has none.
    fn basis(&self) -> Result<Result<FrequencyBasis, Error>, TrajectoryError> {
        let motion = self.motion.as_ref().expect("names of lines are in the plan");
        match fundamental_frequencies(motion).and_then(|found| found.basis()) {
            Err(why @ (Error::NotConverged { .. } | Error::Domain { quantity: SHORT_SPAN, .. })) => {
                Err(TrajectoryError::NoFrequencies(why))
            }
            basis => Ok(basis),
        }
    }
}

/// The quantity that [`fundamental_frequencies`] refuses in a span of few turns.
const SHORT_SPAN: &str = "span in turns of n about L";

fn intervals(scene: &Scene) -> f64 {
    (scene.rotation() * HARMONICS / std::f64::consts::PI).ceil().max(15.0)
}

/// A column in equal steps over the span, and the largest size of what it is a part of.
fn series(
    scene: &Scene,
    column: &Column,
    state_at: impl Fn(f64) -> Result<SampledState, Error>,
) -> Result<(Series, f64), TrajectoryError> {
    let (intervals, span) = (intervals(scene), scene.duration());
    let start = span.min(0.0);
    let step = span.abs() / intervals;
    let value = |index: usize| {
        let since_start = (start + step * index as f64).min(start + span.abs());
        let mut sample = Sample::new(since_start, state_at(since_start)?);
        if column.group == Output::EulerAngles {
            sample.angles = sample.orientation().angles().ok();
        }
        let time = || format!("{:?} {}", scene.output_time(since_start), scene.units.time_name);
        column.value_and_size(scene, &sample).ok_or_else(|| TrajectoryError::Undefined(column.name.clone(), time()))
    };
    let (mut values, mut largest) = (Vec::new(), 0.0_f64);
    for index in 0..=intervals as usize {
        let (value, size) = value(index)?;
        values.push(value);
        largest = largest.max(size);
    }
    Ok((Series { start, step, values }, largest))
}

fn frequency_title(scene: &Scene, name: &str) -> String {
    format!("{name} [rad/{}]", scene.units.time_name)
}
