//! A part of a motion, at any late time.

use twofold::Error;
use twofold::dynamics::RotationState;
use twofold::plan::Output;

use crate::samples::{ErrorEstimates, Sample, for_each_sample};
use crate::scene_file::{Scene, Times};

impl Scene {
    /// The scene that starts at the time `from` of the output, with the state that the motion has there, and lasts to the time `to`. Turns of angles
    /// and of pulses are counted from there on. Neither time need be within the span of the scene. Also returns the estimated error of that state.
    ///
    /// # Errors
    /// Times that are not finite or too close to one another; a start so late that its motion, without a closed form, rotates by more
    /// than [`LARGEST_ROTATION`](crate::plan::LARGEST_ROTATION).
    pub fn window(&self, from: f64, to: f64) -> Result<(Self, f64), String> {
        let start = self.times.start();
        let resolved = 1e-3 * self.units.time / self.turning_rate();
        if !((to - from).abs() > resolved && from.next_up() - from <= resolved && to.next_up() - to <= resolved) {
            return Err(format!(
                "a window from {from:?} to {to:?}: must be two different times at which doubles resolve a thousandth of a radian of rotation"
            ));
        }
        let until = Self { times: Times::Listed { start, times: vec![from] }, ..self.clone() };
        let plan = until.plan(&[Output::EquatorialAxis])?;
        let (mut state, mut angles, mut error) = (*self.problem.initial(), self.initial_angles, 0.0);
        if from != start {
            let take = |_, sample: &Sample| {
                state = sample.orientation().orthonormal();
                Ok::<_, Error>(())
            };
            let sampled = for_each_sample(&until, &plan, ErrorEstimates::AtEnd, take, |_, _, _| Ok(()))?;
            angles = state.angles().unwrap_or(angles);
            error = sampled.error.expect("the estimate at the end");
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

#[cfg(test)]
mod tests {
    use twofold::epoch::Epoch;
    use twofold::propagation::Motion;

    use super::*;

    /// A window starts with the state of the motion and reports its error, also before the start and in either direction.
    #[test]
    fn a_window_starts_where_the_motion_is() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.times = Times::Even { start: 5.0, end: 105.0, samples: 11 };
        let whole = |end: f64| scene.problem.taylor((0.0, end), 1e-13).unwrap().state(end).unwrap();
        for (from, to) in [(35.0, 40.0), (35.0, 20.0), (-15.0, 300.0)] {
            let (window, error) = scene.window(from, to).unwrap();
            let (found, expected) = (window.problem.initial(), whole(from - 5.0));
            let off = (found.axis - expected.axis).norm() + (found.equatorial_axis - expected.equatorial_axis).norm();
            assert!(off < 1e-11 && (1e-16..1e-11).contains(&error), "{off:e} {error:e}");
            assert_eq!(window.times, Times::Even { start: from, end: to, samples: 11 });
            let expected = found.angles().unwrap();
            assert_eq!(window.initial_angles, expected);
        }
        // Also of a scene of a single time.
        let alone = Scene { times: Times::Listed { start: 5.0, times: vec![9.0] }, ..scene.clone() };
        assert_eq!(alone.window(5.0, 6.0).unwrap().0.times, Times::Even { start: 5.0, end: 6.0, samples: 2 });
        let (same, error) = scene.window(5.0, 6.0).unwrap();
        assert_eq!((same.problem.initial(), error), (scene.problem.initial(), 0.0));
    }

    /// Both times differ by a thousandth of a radian of rotation, which doubles resolve at these times.
    #[test]
    fn a_window_is_longer_than_a_thousandth_of_a_radian() {
        for name in ["tp-2", "millisecond-pulsar"] {
            let scene = Scene::named(name).unwrap();
            let start = scene.times.start();
            let resolved = 1e-3 * scene.units.time / scene.turning_rate();
            let refused =
                |from: f64, to: f64| scene.window(from, to).is_err_and(|why| why.contains("resolve a thousandth"));
            for sense in [1.0, -1.0] {
                assert!(
                    !refused(start, start + 1.01 * sense * resolved) && refused(start, start + 0.99 * sense * resolved)
                );
            }
            // The distance of neighbouring doubles is 2^-52 of the power of two below them.
            let coarse = resolved.log2().floor().exp2() * 2.0 / f64::EPSILON;
            for (from, to) in [(start, coarse), (coarse, start), (coarse, 2.0 * coarse)] {
                assert!(refused(from, to), "{from:e} {to:e}");
            }
        }
    }

    #[test]
    fn a_window_has_the_date_of_its_start() {
        let mut scene = Scene::named("b1937+21").unwrap();
        let epoch = scene.epoch.expect("an epoch");
        let start = 100.0;
        scene.times = Times::Even { start, end: 200.0, samples: 2 };
        let (window, _) = scene.window(start + 86_400.0, start + 86_500.0).unwrap();
        assert_eq!(window.epoch, Some(Epoch::new(epoch.day() + 1, epoch.fraction()).unwrap()));
    }
}
