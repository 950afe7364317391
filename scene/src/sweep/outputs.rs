//! The output of a sweep for each scene: columns at its times, and summaries of its whole span.

use twofold::Error;
use twofold::dynamics::AxisState;
use twofold::dynamics::BodyState;
use twofold::dynamics::RotationState;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::lorentz_violation::principal_frame;
use twofold::plan::{Method, Output, Plan, State};
use twofold::propagation::{SampledProblem, states_of_many};
use twofold::solutions::averaged::slow_precession::slow_precession;

use super::chunk::guarded;
use super::spin_axis_angle::SpinAxisAngle;
use crate::columns;
use crate::estimated_error::{ROUNDING_OF_COMPONENT, as_printed};
use crate::samples::{ErrorEstimates, Sample, SampledState, for_each_sample};
use crate::scene_file::{COLUMN_GROUPS, Scene, Times, Units};
use crate::trajectory::write_pulses;

/// Name of the group of errors.
pub(super) const ERRORS: &str = "errors";

/// The values that are written for each scene.
#[derive(Debug)]
pub(super) struct Outputs {
    pub(super) times: Times,
    pub(super) groups: Vec<Output>,
    /// Whether the errors of the motion at each of the times are written.
    pub(super) errors: bool,
    pub(super) summaries: Vec<Summary>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Summary {
    /// Smallest, largest and mean angle between the spin axis and the direction to the observer.
    Lambda,
    Pulses,
    /// Axis and rate of the slow precession to first order.
    SlowPrecession,
}

impl Summary {
    /// All summaries, with their names in a sweep file.
    pub(super) const ALL: [(&'static str, Self); 3] =
        [("lambda", Self::Lambda), ("pulses", Self::Pulses), ("slow_precession", Self::SlowPrecession)];

    /// The output from which the summary is computed, in addition to the initial values.
    pub(super) fn output(self) -> Option<Output> {
        match self {
            Self::Lambda => Some(Output::SpinAxisAngle),
            Self::Pulses => Some(Output::Pulses),
            Self::SlowPrecession => None,
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
            let groups = self.groups.iter().flat_map(|group| columns::header(*group, units));
            let errors = if self.errors { errors_header(units) } else { Vec::new() };
            names.extend(groups.chain(errors).map(|title| match title.split_once(' ') {
                Some((name, unit)) => format!("{name}@{time:?} {unit}"),
                None => format!("{title}@{time:?}"),
            }));
        }
        names.extend(self.summaries.iter().flat_map(|summary| summary.header(units)));
        names
    }

    /// The numbers of each scene, as many as the header has names; NaN for one that does not exist.
    pub(super) fn values(&self, scenes: &[&Scene]) -> Vec<Result<Vec<f64>, String>> {
        let together = self.samples_of_many(scenes);
        scenes.iter().zip(together).map(|(scene, samples)| guarded(|| self.values_of(scene, samples))).collect()
    }

    /// The samples of those of the `scenes` that need only `n` and `L` by numerical motion, and name no method: computed many at
    /// once, each by splitting or by the series as suits its times. `None` for the others.
    fn samples_of_many(&self, scenes: &[&Scene]) -> Vec<Option<Result<Vec<Sample>, Error>>> {
        let mut found: Vec<_> = scenes.iter().map(|_| None).collect();
        if self.errors || self.summaries.contains(&Summary::Lambda) {
            return found;
        }
        let is_plain = |plan: Plan| {
            !plan.forced
                && matches!(plan.state, State::Axis | State::AxisAndMomentum)
                && matches!(plan.method, Some(Method::Taylor | Method::Splitting))
        };
        let outputs = self.outputs();
        let plain: Vec<_> = (0..scenes.len()).filter(|&i| scenes[i].plan(&outputs).is_ok_and(is_plain)).collect();
        let times = |&i: &usize| scenes[i].times.iter().map(|time| scenes[i].since_start(time)).collect::<Vec<_>>();
        let times: Vec<_> = plain.iter().map(times).collect();
        let motion = |(&i, times): (&usize, _)| {
            let Scene { problem, tolerance, .. } = scenes[i];
            SampledProblem { problem: problem.reduced(), start: 0.0, times, tolerance: *tolerance }
        };
        let motions: Vec<_> = plain.iter().zip(times.iter().map(Vec::as_slice)).map(motion).collect();
        for ((i, times), states) in plain.into_iter().zip(&times).zip(states_of_many(&motions)) {
            let sample = |(&since_start, state)| Sample::new(since_start, SampledState::Axis(state));
            found[i] = Some(states.map(|states| times.iter().zip(states.states).map(sample).collect()));
        }
        found
    }

    /// The samples of one scene, by the method of its plan. `angle` receives the whole motion.
    fn samples_of(&self, scene: &Scene, mut angle: Option<&mut SpinAxisAngle>) -> Result<Vec<Sample>, Error> {
        let mut samples = Vec::new();
        let estimates = if self.errors { ErrorEstimates::OfEachSample } else { ErrorEstimates::None };
        let take = |_, sample: &Sample| {
            samples.push(*sample);
            Ok(())
        };
        for_each_sample(scene, &scene.plan(&self.outputs())?, estimates, take, |motion, from, to| {
            angle.as_mut().map_or(Ok(()), |angle| angle.add(motion, from, to))
        })?;
        Ok(samples)
    }

    fn values_of(&self, scene: &Scene, known: Option<Result<Vec<Sample>, Error>>) -> Result<Vec<f64>, String> {
        let mut angle = match scene.observer {
            Some(observer) if self.summaries.contains(&Summary::Lambda) => {
                Some(SpinAxisAngle::new(*scene.problem.spheroid(), observer.basis().direction, scene.turning_rate()))
            }
            _ => None,
        };
        let samples = known.unwrap_or_else(|| self.samples_of(scene, angle.as_mut()));
        let mut values = Vec::new();
        for sample in &samples? {
            self.append_columns(scene, sample, &mut values)?;
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

    /// The outputs of a plan from which the columns at the samples and the summary of `lambda` are computed.
    pub(super) fn outputs(&self) -> Vec<Output> {
        let of_errors = self.errors.then_some(Output::FirstIntegrals);
        let of_summary = self.summaries.contains(&Summary::Lambda).then_some(Output::SpinAxisAngle);
        let mut outputs = Vec::new();
        for output in self.groups.iter().copied().chain(of_errors).chain(of_summary) {
            if !outputs.contains(&output) {
                outputs.push(output);
            }
        }
        outputs
    }

    fn append_columns(&self, scene: &Scene, sample: &Sample, values: &mut Vec<f64>) -> Result<(), String> {
        for &group in &self.groups {
            match columns::values(group, scene, sample) {
                Some(found) if found.iter().all(|x| x.is_finite()) => values.extend(found),
                Some(_) => {
                    let name = COLUMN_GROUPS.iter().find(|(_, known)| *known == group).map_or("", |(name, _)| name);
                    return Err(format!("a number of the group `{name}` is not finite"));
                }
                None => values.extend(columns::header(group, &scene.units).iter().map(|_| f64::NAN)),
            }
        }
        if self.errors {
            values.extend(errors(scene, sample));
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

/// The estimated error of the state, and the changes of the constants of motion since the start.
fn errors(scene: &Scene, sample: &Sample) -> [f64; 5] {
    let initial = scene.problem.initial();
    let state = match sample.state {
        SampledState::Axis(AxisState { axis, momentum }) => BodyState { axis, momentum, ..*initial },
        SampledState::Orientation(state) => state,
        SampledState::Nothing => *initial,
    };
    // The integrals depend only on n and L.
    let integrals = |state| first_integrals(scene.problem.spheroid(), scene.problem.coefficients(), state);
    let (now, start) = (integrals(&state), integrals(initial));
    let units = &scene.units;
    [
        as_printed(sample.error_estimate.unwrap_or(f64::NAN), ROUNDING_OF_COMPONENT),
        state.axis.norm() - 1.0,
        (now.energy - start.energy) * units.energy,
        (now.spin - start.spin) / units.time,
        (now.clebsch - start.clebsch) * units.momentum * units.momentum,
    ]
}

fn count_pulses(scene: &Scene) -> Result<f64, String> {
    let found = write_pulses(scene, std::io::sink(), |_| Ok(())).map_err(|error| error.to_string())?;
    Ok(found.pulses.iter().sum::<usize>() as f64)
}

/// Number of the principal axis that L circles, one for that of the largest eigenvalue and three for that of the smallest, and
/// the rate, counted about the end of the axis that is nearer to L; NaN on a separatrix.
fn slow_precession_of(scene: &Scene) -> [f64; 2] {
    let problem = &scene.problem;
    let found = principal_frame(problem.coefficients()).and_then(|frame| {
        let state = problem.initial().rotated(&frame.principal_from_given);
        let found = slow_precession(problem.spheroid(), &frame.coefficients, &state.momentum, &state.axis)?;
        Ok((found, state.momentum[found.axis]))
    });
    found.map_or([f64::NAN; 2], |(found, along)| {
        let sense = if along < 0.0 { -1.0 } else { 1.0 };
        [(found.axis + 1) as f64, sense * found.rate / scene.units.time]
    })
}
