//! What a sweep writes of each scene: columns at its times, and summaries of its whole span.

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::lorentz_violation::principal_frame;
use twofold::plan::Output;
use twofold::propagation::AxisState;
use twofold::solutions::averaged::slow_precession::slow_precession;

use super::chunk::guarded;
use super::motion::{Asked, Instant, instants, instants_of_many};
use super::spin_axis_angle::SpinAxisAngle;
use crate::columns::{Carried, ColumnGroup, Moment};
use crate::estimated_error::{ROUNDING_OF_COMPONENT, as_printed};
use crate::scene_file::{Scene, Times, Units};
use crate::trajectory::write_pulses;

/// Name of the group of errors.
pub(super) const ERRORS: &str = "errors";

/// What is written of each scene.
#[derive(Debug)]
pub(super) struct Outputs {
    /// Times, in the units of the scene.
    pub(super) times: Times,
    /// Groups of columns at each of the times.
    pub(super) groups: Vec<&'static ColumnGroup>,
    /// Whether the errors of the motion at each of the times are.
    pub(super) errors: bool,
    /// Numbers for the whole span.
    pub(super) summaries: Vec<Summary>,
}

/// Numbers for the whole span of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Summary {
    /// Least, largest and mean angle between the spin axis and the direction to the observer.
    Lambda,
    /// Number of pulses.
    Pulses,
    /// Axis and rate of the slow precession to first order.
    SlowPrecession,
}

impl Summary {
    /// All, by their names in a sweep file.
    pub(super) const ALL: [(&'static str, Self); 3] =
        [("lambda", Self::Lambda), ("pulses", Self::Pulses), ("slow_precession", Self::SlowPrecession)];

    /// Whether the scene has what the summary is computed from.
    ///
    /// # Errors
    /// A sentence that says what the scene lacks.
    pub(super) fn available_in(self, scene: &Scene) -> Result<(), String> {
        let lacks = |section: &str| Err(format!("the scene lacks the section [{section}]"));
        match self {
            Self::Lambda | Self::Pulses if scene.observer.is_none() => lacks("observer"),
            Self::Pulses if scene.pulsar.is_none() => lacks("pulsar"),
            _ => Ok(()),
        }
    }

    fn header(self, units: &Units) -> Vec<String> {
        match self {
            Self::Lambda => {
                ["lambda_least", "lambda_largest", "lambda_mean"].map(|name| format!("{name} [rad]")).to_vec()
            }
            Self::Pulses => vec!["pulses [1]".to_owned()],
            Self::SlowPrecession => {
                vec!["slow_precession_axis [1]".to_owned(), format!("slow_precession_rate [rad/{}]", units.time_name)]
            }
        }
    }
}

impl Outputs {
    /// Names of the columns with their units: those at each time, marked with it, then the summaries.
    pub(super) fn header(&self, units: &Units) -> Vec<String> {
        let mut names = Vec::new();
        for time in self.times.iter() {
            let groups = self.groups.iter().flat_map(|group| (group.header)(units));
            let errors = if self.errors { errors_header(units) } else { Vec::new() };
            names.extend(groups.chain(errors).map(|title| match title.split_once(' ') {
                Some((name, unit)) => format!("{name}@{time:?} {unit}"),
                None => format!("{title}@{time:?}"),
            }));
        }
        names.extend(self.summaries.iter().flat_map(|summary| summary.header(units)));
        names
    }

    /// The numbers of each scene, as many as the header has names; not a number where one does not exist.
    ///
    /// # Errors
    /// For each scene a sentence that says what could not be computed.
    pub(super) fn values(&self, scenes: &[&Scene]) -> Vec<Result<Vec<f64>, String>> {
        let together = if self.summaries.contains(&Summary::Lambda) {
            scenes.iter().map(|_| None).collect()
        } else {
            instants_of_many(scenes, &self.asked())
        };
        scenes.iter().zip(together).map(|(scene, instants)| guarded(|| self.values_of(scene, instants))).collect()
    }

    /// The numbers of one scene, from its states if they are known.
    fn values_of(&self, scene: &Scene, known: Option<Result<Vec<Instant>, Error>>) -> Result<Vec<f64>, String> {
        let rate = scene.turning_rate();
        let mut angle = match scene.observer {
            Some(observer) if self.summaries.contains(&Summary::Lambda) => {
                Some(SpinAxisAngle::new(observer.basis().direction, rate))
            }
            _ => None,
        };
        let instants = known.unwrap_or_else(|| instants(scene, &self.asked(), angle.as_mut()));
        let instants = instants.map_err(|error| error.to_string())?;
        let mut values = Vec::new();
        for instant in &instants {
            self.append_columns(scene, instant, &mut values)?;
        }
        for summary in &self.summaries {
            match summary {
                Summary::Lambda => values.extend(angle.iter().flat_map(SpinAxisAngle::least_largest_mean)),
                Summary::Pulses => values.push(count_pulses(scene)?),
                Summary::SlowPrecession => values.extend(slow_precession_of(scene)),
            }
        }
        Ok(values)
    }

    /// What the columns need of the motion.
    pub(super) fn asked(&self) -> Asked {
        let of_groups = self.groups.iter().map(|group| group.output);
        let of_errors = self.errors.then_some(Output::FirstIntegrals);
        let of_summary = self.summaries.contains(&Summary::Lambda).then_some(Output::SpinAxisAngle);
        let mut outputs = Vec::new();
        for output in of_groups.chain(of_errors).chain(of_summary) {
            if !outputs.contains(&output) {
                outputs.push(output);
            }
        }
        Asked { outputs, errors: self.errors }
    }

    fn append_columns(&self, scene: &Scene, instant: &Instant, values: &mut Vec<f64>) -> Result<(), String> {
        let mut angles = || instant.angles;
        let mut moment = Moment { since_start: instant.since_start, state: instant.state, angles: &mut angles };
        for group in &self.groups {
            match (group.values)(scene, &mut moment) {
                Some(found) if found.iter().all(|x| x.is_finite()) => values.extend(found),
                Some(_) => return Err(format!("a number of the group `{}` is not finite", group.name)),
                None => values.extend((group.header)(&scene.units).iter().map(|_| f64::NAN)),
            }
        }
        if self.errors {
            values.extend(errors(scene, instant));
        }
        Ok(())
    }
}

fn errors_header(units: &Units) -> Vec<String> {
    vec![
        "error_estimate [1]".to_owned(),
        "e_z_length_error [1]".to_owned(),
        format!("E_error [{}]", units.energy_name),
        format!("Omega_z_error [rad/{}]", units.time_name),
        format!("K_error [({})^2]", units.momentum_name),
    ]
}

/// The estimated error of the state, and by how much what is constant has changed since the start.
fn errors(scene: &Scene, instant: &Instant) -> [f64; 5] {
    let state = match instant.state {
        Carried::Axis(AxisState { axis, momentum }) => BodyState { axis, momentum, ..scene.initial },
        Carried::Orientation(state) => state,
        Carried::Nothing => scene.initial,
    };
    // The integrals are those of n and L; e_x is not looked at.
    let integrals = |state| first_integrals(&scene.spheroid, &scene.violation, state);
    let (now, start) = (integrals(&state), integrals(&scene.initial));
    let units = &scene.units;
    [
        as_printed(instant.error_estimate.unwrap_or(f64::NAN), ROUNDING_OF_COMPONENT),
        state.axis.norm() - 1.0,
        (now.energy - start.energy) * units.energy,
        (now.spin - start.spin) / units.time,
        (now.clebsch - start.clebsch) * units.momentum * units.momentum,
    ]
}

fn count_pulses(scene: &Scene) -> Result<f64, String> {
    let (Some(viewer), Some(pulsar)) = (scene.observer, scene.pulsar) else {
        return Err("the scene lacks the section [observer] or [pulsar]".to_owned());
    };
    let found = write_pulses(scene, (&viewer, &pulsar), std::io::sink(), |_| {}).map_err(|error| error.to_string())?;
    Ok(found.pulses.iter().sum::<usize>() as f64)
}

/// Number of the principal axis that L goes round, one for that of the largest eigenvalue and three for that of the smallest, and
/// the rate about the end at which L is; none on a separatrix.
fn slow_precession_of(scene: &Scene) -> [f64; 2] {
    let found = principal_frame(&scene.violation).and_then(|frame| {
        let state = scene.initial.rotated(&frame.principal_from_given);
        let found = slow_precession(&scene.spheroid, &frame.coefficients, &state.momentum, &state.axis)?;
        Ok((found, state.momentum[found.axis]))
    });
    found.map_or([f64::NAN; 2], |(found, along)| {
        let sense = if along < 0.0 { -1.0 } else { 1.0 };
        [(found.axis + 1) as f64, sense * found.rate / scene.units.time]
    })
}
