//! A part of a motion, however late.

use twofold::Error;
use twofold::plan::Output;

use crate::samples::{ErrorAtEnd, ErrorEstimates, Sample, for_each_sample};
use crate::scene_file::{Scene, Times};

impl Scene {
    /// The scene that starts at the time `from` of the output, with the state that the motion has there, and lasts to the time `to`. Angles count their turns,
    /// and pulses theirs, from there on. Neither time need be within the span of the scene. With it the estimated error of that state.
    ///
    /// # Errors
    /// Times that are not finite or too near to one another; a start so late that its motion, without a closed form, turns by more than
    /// [`LARGEST_ROTATION`](crate::plan::LARGEST_ROTATION).
    pub fn window(&self, from: f64, to: f64) -> Result<(Self, f64), String> {
        let start = self.times.start();
        let resolved = 1e-3 * self.units.time / self.turning_rate();
        if !((to - from).abs() > resolved && from.next_up() - from <= resolved && to.next_up() - to <= resolved) {
            return Err(format!(
                "a window from {from:?} to {to:?}: allowed are two times that differ, at which doubles resolve a thousandth of a radian of rotation"
            ));
        }
        let until = Self { times: Times::Listed { start, times: vec![from] }, ..self.clone() };
        let plan = until.plan(&[Output::EquatorialAxis])?;
        let (mut state, mut angles, mut error) = (*self.problem.initial(), self.initial_angles, 0.0);
        if from != start {
            let take = |_, sample: &Sample| {
                state = *sample.orientation();
                Ok::<_, Error>(())
            };
            let sampled = for_each_sample(&until, &plan, ErrorEstimates::AtEnd, take, |_, _, _| Ok(()))?;
            angles = state.angles().unwrap_or(angles);
            if let Some(ErrorAtEnd::Estimated(estimate) | ErrorAtEnd::Foreseen(estimate)) = sampled.error {
                error = estimate;
            }
        }
        let scene = Self {
            problem: self.problem.starting_from(state)?,
            initial_angles: angles,
            times: Times::Even { start: from, end: to, samples: self.times.count().max(2) },
            epoch: self.epoch.map(|epoch| epoch.after([from - start, 0.0])).transpose()?,
            perturbation: Err("the perturbation solution starts where the scene does, not where a window of it does"),
            ..self.clone()
        };
        Ok((scene, error))
    }
}
