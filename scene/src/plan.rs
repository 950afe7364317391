//! Times of a scene in `t_c`, its rotation, and the plan for computing its motion.

use twofold::Error;
use twofold::dynamics::equations_of_motion::angular_velocity;
use twofold::plan::{Output, Plan, Request};

use crate::scene_file::Scene;

/// Largest rotation over the whole span that is computed, in rad; this takes some minutes.
pub const LARGEST_ROTATION: f64 = 1e8;

impl Scene {
    /// Converts a time of the output to the time since the start, in t_c.
    pub fn since_start(&self, time: f64) -> f64 {
        self.since_start_in_parts(time)[0]
    }

    /// The time since the start, in t_c, as a sum of two doubles, of which the first is the rounded sum: after 1e10 turns the rounding of a single
    /// double is a noticeable fraction of a turn.
    pub fn since_start_in_parts(&self, time: f64) -> [f64; 2] {
        let (start, unit) = (self.times.start(), self.units.time);
        // Knuth's exact difference, followed by the remainder of the quotient.
        let difference = time - start;
        let part = difference - time;
        let lost = (time - (difference - part)) - (start + part);
        let quotient = difference / unit;
        let rest = ((-quotient).mul_add(unit, difference) + lost) / unit;
        if !rest.is_finite() {
            return [quotient, 0.0];
        }
        let sum = quotient + rest;
        [sum, rest - (sum - quotient)]
    }

    /// Converts a time since the start, in t_c, to a time of the output.
    pub fn output_time(&self, since_start: f64) -> f64 {
        self.times.start() + since_start * self.units.time
    }

    /// Length of the span in t_c, negative for a span backwards in time.
    pub fn duration(&self) -> f64 {
        self.since_start(self.times.last())
    }

    /// The fraction of the span, from 0 to 1, before a time since the start, in t_c.
    pub(crate) fn part_done(&self, since_start: f64) -> f64 {
        let duration = self.duration();
        if duration == 0.0 { 1.0 } else { since_start / duration }
    }

    /// Upper estimate of the rotation angle of the body over the span, in rad.
    pub fn rotation(&self) -> f64 {
        self.duration().abs() * self.turning_rate()
    }

    /// Upper estimate of the rotation rate of directions, per `t_c`.
    pub(crate) fn turning_rate(&self) -> f64 {
        let (problem, initial) = (&self.problem, self.problem.initial());
        let omega = angular_velocity(problem.spheroid(), &initial.axis, &initial.momentum).norm();
        omega.max(initial.momentum.norm()) + (2.0 * problem.coefficients().norm()).sqrt()
    }

    /// The plan for given outputs over the span and at the samples of the scene. Times are measured since the start, in t_c.
    ///
    /// # Errors
    /// A method that the scene does not allow, or a span too long for outputs that follow every turn.
    pub fn plan(&self, outputs: &[Output]) -> Result<Plan, Error> {
        let span = (0.0, self.duration());
        let request =
            Request { method: self.method, ..Request::new(outputs, span, self.times.count(), self.tolerance) };
        let plan = self.problem.plan(&request)?;
        let rotation = self.rotation();
        Error::ensure(
            rotation <= LARGEST_ROTATION || plan.costs_the_same_at_any_time(),
            "rotation over the span (rad)",
            rotation,
            "at most 1e8 for pulses, continuous angles and motions without a closed form",
        )?;
        Ok(plan)
    }

    /// Refuses a span with too many turns if an output must follow each of them.
    pub fn check_rotation(&self, outputs: &[Output]) -> Result<(), String> {
        let rotation = self.rotation();
        if rotation <= LARGEST_ROTATION {
            return Ok(());
        }
        match self.plan(outputs) {
            Ok(_) => return Ok(()),
            // A shorter span would have no other method.
            Err(error) if self.problem.bulge() != 0.0 => return Err(error.to_string()),
            Err(_) => {}
        }
        Err(format!(
            "[time] covers {rotation:.1e} rad of rotation: must be at most {LARGEST_ROTATION:.0e} rad, which takes \
             minutes, for pulses, continuous angles and motions without a closed form; shorten the span, lower the rates \
             or choose other columns"
        ))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use twofold::dynamics::{BodyState, Problem, RigidSpheroid};

    use super::*;
    use crate::scene_file::Times;

    fn scene(start: f64, last: f64, unit: f64) -> Scene {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.units.time = unit;
        scene.times = Times::Listed { start, times: vec![last] };
        scene
    }

    /// Computed in integer multiples of 2^-70: doubles of these sizes are such multiples, and three times the sum of the parts is the difference,
    /// except for a rounding of the second part, 2^-78, and the truncated digits.
    #[test]
    fn two_parts_are_a_time_to_twice_the_digits() {
        let whole = |x: f64| (x * 2.0_f64.powi(70)) as i128;
        for (start, time) in [(0.1, 1e9), (1e9, 0.1), (-0.3, 7.7e8), (0.0, 1e9)] {
            let [most, rest] = scene(start, time, 3.0).since_start_in_parts(time);
            let off = 3 * (whole(most) + whole(rest)) - (whole(time) - whole(start));
            assert!(off.abs() < 6 && rest != 0.0, "{start} to {time}: {off}");
            assert_eq!(most + rest, most, "{start} to {time}: the first part is the rounded sum");
        }
        assert_eq!(scene(-f64::MAX, f64::MAX, 3.0).since_start_in_parts(f64::MAX), [f64::INFINITY, 0.0]);
    }

    #[test]
    fn the_part_done_goes_from_zero_to_one_in_either_sense() {
        for last in [26.0, -6.0] {
            let scene = scene(10.0, last, 2.0);
            let parts = [0.0, 0.25, 1.0].map(|part| scene.part_done(part * scene.duration()));
            assert_eq!(parts, [0.0, 0.25, 1.0]);
        }
        assert_eq!(scene(10.0, 10.0, 2.0).part_done(0.0), 1.0);
    }

    /// About an axis perpendicular to its symmetry axis a star rotates at `|L|`, about the symmetry axis at `|L| / I^zz`, which is faster if the star
    /// is prolate; `sqrt(2 |s|)` is added. A tensor with the eigenvalues 2, -1 and 2 has the norm 3.
    #[test]
    fn a_star_turns_by_no_more_than_its_rates_and_that_of_the_torque() {
        for (ratio, torque, momentum, rate) in [
            (1.25, 0.0, Vector3::new(0.0, 0.0, 5.0), 5.0),
            (0.8, 0.0, Vector3::new(0.0, 0.0, 2.0), 2.5),
            (0.8, 0.0, Vector3::new(4.0, 0.0, 0.0), 4.0),
            (1.25, 1.0, Vector3::new(0.0, 0.0, 5.0), 5.0 + 6.0_f64.sqrt()),
        ] {
            let mut scene = scene(10.0, -10.0, 2.0);
            let s = Matrix3::from_diagonal(&Vector3::new(2.0, -1.0, 2.0)) * torque;
            let state = BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() };
            scene.problem = Problem::new(RigidSpheroid::in_units_of_tc(ratio), s, state).unwrap();
            // One or two roundings of each of the terms.
            assert!((scene.turning_rate() - rate).abs() < 4.0 * f64::EPSILON * rate, "{}", scene.turning_rate());
            // Twenty units of the output are ten t_c, backwards.
            assert!((scene.rotation() - 10.0 * rate).abs() < 40.0 * f64::EPSILON * rate, "{}", scene.rotation());
        }
    }
}
