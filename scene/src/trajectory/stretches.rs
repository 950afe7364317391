//! A long motion stretch by stretch, so that memory does not grow with its span, by the method of a plan.

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::euler_angles::EulerAngles;
use twofold::plan::{Counted, Method, Plan, PlannedAxisMotion, PlannedMotion, Work};
use twofold::propagation::{ACCURACY_RANGE, AxisState, ContinuousAngles, Motion};

use crate::columns::Carried;
use crate::scene_file::Scene;

/// Rotation per stretch of motion that is kept in memory at a time, in rad.
pub(crate) const ROTATION_PER_STRETCH: f64 = 5e4;

/// The Euler angles at a time, where they exist.
pub(super) type Angles<'m> = Box<dyn FnMut(f64) -> Option<EulerAngles<f64>> + 'm>;

/// A motion that a plan can make, with as much of the state as it carries.
pub(crate) trait PlannedState: Motion<f64> + Sized {
    /// The motion by a method.
    fn by(
        method: Method,
        scene: &Scene,
        start: &BodyState<f64>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error>;

    /// What is carried at the time `t[0] + t[1]`.
    fn carried(motion: &Counted<Self>, t: [f64; 2]) -> Result<Carried, Error>;

    /// A start for the next stretch; what is not carried is that of `before`.
    fn start_at(&self, t: f64, before: &BodyState<f64>) -> Result<BodyState<f64>, Error>;

    /// The Euler angles with their turns from the time `from`, where they are `start`; none where they do not exist.
    ///
    /// # Errors
    /// A time outside the motion.
    fn angles<'m>(motion: &'m Counted<Self>, from: f64, start: &EulerAngles<f64>) -> Result<Angles<'m>, Error>;

    /// Steps and right-hand sides.
    fn work(&self) -> Work;
}

impl PlannedState for PlannedAxisMotion {
    fn by(
        method: Method,
        scene: &Scene,
        start: &BodyState<f64>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error> {
        PlannedAxisMotion::axis_by(method, &scene.spheroid, &scene.violation, start, span, accuracy)
    }

    fn carried(motion: &Counted<Self>, t: [f64; 2]) -> Result<Carried, Error> {
        motion.axis_state_in_parts(t).map(Carried::Axis)
    }

    fn start_at(&self, t: f64, before: &BodyState<f64>) -> Result<BodyState<f64>, Error> {
        let AxisState { axis, momentum } = self.axis_state(t)?;
        Ok(BodyState { axis, momentum, ..*before })
    }

    fn angles<'m>(_: &'m Counted<Self>, _: f64, _: &EulerAngles<f64>) -> Result<Angles<'m>, Error> {
        Ok(Box::new(|_| None))
    }

    fn work(&self) -> Work {
        PlannedAxisMotion::work(self)
    }
}

impl PlannedState for PlannedMotion {
    fn by(
        method: Method,
        scene: &Scene,
        start: &BodyState<f64>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error> {
        PlannedMotion::by(method, &scene.spheroid, &scene.violation, start, span, accuracy)
    }

    fn carried(motion: &Counted<Self>, t: [f64; 2]) -> Result<Carried, Error> {
        motion.state_in_parts(t).map(Carried::Orientation)
    }

    fn start_at(&self, t: f64, _: &BodyState<f64>) -> Result<BodyState<f64>, Error> {
        self.state(t)
    }

    fn angles<'m>(motion: &'m Counted<Self>, from: f64, start: &EulerAngles<f64>) -> Result<Angles<'m>, Error> {
        let mut angles = ContinuousAngles::new(motion, from, start)?;
        Ok(Box::new(move |t| angles.at(t).ok()))
    }

    fn work(&self) -> Work {
        PlannedMotion::work(self)
    }
}

/// The motion of a scene over the stretch of a plan, in order.
pub struct Stretches<'s, M> {
    scene: &'s Scene,
    method: Method,
    /// Length of the span in t_c, negative backwards.
    total: f64,
    count: usize,
    next: usize,
    from: f64,
    state: BodyState<f64>,
    /// Steps and right-hand sides so far.
    pub(super) work: Work,
    motion: std::marker::PhantomData<M>,
}

/// Error of the components of `n`, `e_x` and of `L` in units of its size at the end of a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErrorAtEnd {
    /// Estimated from the motion, where it is one from the start.
    Estimated(f64),
    /// What the plan foresaw, where the motion is in stretches that are not kept.
    Foreseen(f64),
}

/// One stretch; times since the start, in t_c.
pub struct Stretch<M> {
    /// The motion from `from` to `to`.
    pub motion: Counted<M>,
    /// First time; later than `to` where the span leads backwards.
    pub from: f64,
    /// Last time.
    pub to: f64,
    /// Whether the span ends here.
    pub is_last: bool,
}

impl<'s, M: PlannedState> Stretches<'s, M> {
    /// The stretches of a plan for `scene`, one at least.
    ///
    /// # Errors
    /// A plan without a motion.
    pub fn new(scene: &'s Scene, plan: &Plan) -> Result<Self, Error> {
        Self::of_rotation(scene, plan, ROTATION_PER_STRETCH)
    }

    /// The stretches of a plan for `scene` with a rotation of at most `most` rad each.
    pub(super) fn of_rotation(scene: &'s Scene, plan: &Plan, most: f64) -> Result<Self, Error> {
        let (what, why) = ("motion of the plan", "none of its outputs needs one");
        let method = plan.method.ok_or(Error::Unsupported { what, why })?;
        let total = plan.stretch.1;
        let whole = plan.costs_the_same_at_any_time();
        let count = if whole { 1 } else { (total.abs() * scene.turning_rate() / most).ceil().max(1.0) as usize };
        let (work, motion) = (Work::default(), std::marker::PhantomData);
        Ok(Self { scene, method, total, count, next: 0, from: 0.0, state: scene.initial, work, motion })
    }

    /// Computes the next stretch, if there is one.
    ///
    /// # Errors
    /// A motion that cannot be computed.
    pub fn next(&mut self) -> Result<Option<Stretch<M>>, Error> {
        if self.next == self.count {
            return Ok(None);
        }
        self.next += 1;
        let (from, to) = (self.from, self.total * (self.next as f64 / self.count as f64));
        let motion = if self.method.is_closed_form() {
            // From the start of the scene: nothing adds up from stretch to stretch.
            M::by(self.method, self.scene, &self.scene.initial, (0.0, self.total), self.scene.accuracy)?
        } else {
            let accuracy = self.share_of_accuracy(to - from);
            let motion = M::by(self.method, self.scene, &self.state, (from, to), accuracy)?;
            self.state = motion.start_at(to, &self.state)?;
            motion
        };
        self.work += motion.work();
        self.from = to;
        Ok(Some(Stretch { motion: Counted::new(motion), from, to, is_last: self.next == self.count }))
    }

    /// Lets the next stretch begin earlier, at a time of this one.
    ///
    /// # Errors
    /// A time outside the stretch.
    pub fn resume_at(&mut self, stretch: &Stretch<M>, time: f64) -> Result<(), Error> {
        self.state = stretch.motion.inner().start_at(time, &self.state)?;
        self.from = time;
        Ok(())
    }

    /// Error at the end.
    pub fn error_at_end(&self, last: &Stretch<M>, plan: &Plan) -> ErrorAtEnd {
        if self.count == 1 || self.method.is_closed_form() {
            return ErrorAtEnd::Estimated(last.motion.error_estimate(last.to));
        }
        ErrorAtEnd::Foreseen(plan.prediction.map_or(f64::NAN, |prediction| prediction.truncation + prediction.rounding))
    }

    /// The part of the span, from 0 to 1, that lies before a time.
    pub fn part_done(&self, time: f64) -> f64 {
        if self.total == 0.0 { 1.0 } else { time / self.total }
    }

    /// The part of the scene's accuracy that a stretch may use up, so that the truncation per unit of time is that of one
    /// motion over the whole span: an error of time `t` grows with the rotation from `t` on.
    fn share_of_accuracy(&self, stretch: f64) -> f64 {
        let growth = |duration: f64| duration.abs() * (1.0 + self.scene.turning_rate() * duration.abs() / 2.0);
        if self.total == 0.0 {
            return self.scene.accuracy;
        }
        // Rounding may pass by both ends of what a motion takes.
        (self.scene.accuracy * growth(stretch) / growth(self.total)).clamp(ACCURACY_RANGE.0, ACCURACY_RANGE.1)
    }
}

/// A time of the output as time since the start, in t_c.
pub fn since_start(scene: &Scene, time: f64) -> f64 {
    (time - scene.times.start()) / scene.units.time
}

/// The same as a sum of two doubles, kept within a stretch, whose ends rounding may pass by.
pub fn since_start_within(scene: &Scene, time: f64, from: f64, to: f64) -> [f64; 2] {
    let parts = since_start_in_parts(scene, time);
    let t = parts[0].clamp(from.min(to), from.max(to));
    if t == parts[0] { parts } else { [t, 0.0] }
}

/// The same as a sum of two doubles: after 1e10 turns the rounding of one is part of a turn.
fn since_start_in_parts(scene: &Scene, time: f64) -> [f64; 2] {
    let (start, unit) = (scene.times.start(), scene.units.time);
    // Knuth's exact difference, then what is left of the quotient.
    let difference = time - start;
    let part = difference - time;
    let lost = (time - (difference - part)) - (start + part);
    let quotient = difference / unit;
    let rest = ((-quotient).mul_add(unit, difference) + lost) / unit;
    [quotient, if rest.is_finite() { rest } else { 0.0 }]
}

#[cfg(test)]
mod tests {
    use twofold::plan::PlannedAxisMotion;

    use super::*;

    /// An error of the time `t` grows to `1 + rate (end - t)` times itself by the end. All of the stretches together are to stay below the accuracy.
    #[test]
    fn the_errors_of_all_stretches_are_within_the_accuracy() {
        let mut scene = Scene::named("tp-2").unwrap();
        scene.accuracy = 1e-8;
        scene.choose_method("taylor").unwrap();
        scene.choose_columns(&["e_z"]).unwrap();
        let plan = scene.plan_of_columns().unwrap();
        let rate = scene.turning_rate();
        let end = plan.stretch.1;
        let mut stretches = Stretches::<PlannedAxisMotion>::of_rotation(&scene, &plan, rate * end / 20.5).unwrap();
        let (mut sum, mut count) = (0.0, 0);
        while let Some(stretch) = stretches.next().unwrap() {
            sum += stretch.motion.error_estimate(stretch.to) * (1.0 + rate * (end - stretch.to));
            count += 1;
        }
        assert_eq!(count, 21);
        assert!(sum < scene.accuracy, "{sum:e}");
    }
}
