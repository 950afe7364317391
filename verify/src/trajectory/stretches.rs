//! A long motion stretch by stretch, so that memory does not grow with its span.

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::propagation::{ACCURACY_RANGE, Motion, TaylorMotion, propagate};

use crate::scene_file::Scene;

/// Rotation per stretch of motion that is kept in memory at a time, in rad.
pub(crate) const ROTATION_PER_STRETCH: f64 = 5e4;

/// The motion of a scene over its whole span, in order.
pub struct Stretches<'s> {
    scene: &'s Scene,
    /// Length of the span in t_c, negative backwards.
    total: f64,
    count: usize,
    next: usize,
    from: f64,
    state: BodyState<f64>,
}

/// One stretch; times since the start, in t_c.
pub struct Stretch {
    /// The motion from `from` to `to`.
    pub motion: TaylorMotion<f64>,
    /// First time; later than `to` where the span leads backwards.
    pub from: f64,
    /// Last time.
    pub to: f64,
    /// Whether the span ends here.
    pub is_last: bool,
}

impl<'s> Stretches<'s> {
    /// The stretches of the span of `scene`, one at least.
    pub fn new(scene: &'s Scene) -> Self {
        Self::of_rotation(scene, ROTATION_PER_STRETCH)
    }

    /// The stretches of the span of `scene` with a rotation of at most `most` rad each.
    pub(super) fn of_rotation(scene: &'s Scene, most: f64) -> Self {
        let total = since_start(scene, scene.times.last());
        let count = (total.abs() * scene.turning_rate() / most).ceil().max(1.0) as usize;
        Self { scene, total, count, next: 0, from: 0.0, state: scene.initial }
    }

    /// Computes the next stretch, if there is one.
    ///
    /// # Errors
    /// A motion that cannot be computed.
    pub fn next(&mut self) -> Result<Option<Stretch>, Error> {
        if self.next == self.count {
            return Ok(None);
        }
        self.next += 1;
        let (from, to) = (self.from, self.total * (self.next as f64 / self.count as f64));
        let accuracy = self.share_of_accuracy(to - from);
        let motion = propagate(&self.scene.spheroid, &self.scene.violation, &self.state, (from, to), accuracy)?;
        self.state = motion.state(to)?;
        self.from = to;
        Ok(Some(Stretch { motion, from, to, is_last: self.next == self.count }))
    }

    /// Lets the next stretch begin earlier, at a time of this one.
    ///
    /// # Errors
    /// A time outside the stretch.
    pub fn resume_at(&mut self, stretch: &Stretch, time: f64) -> Result<(), Error> {
        self.state = stretch.motion.state(time)?;
        self.from = time;
        Ok(())
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
        (self.scene.accuracy * growth(stretch) / growth(self.total)).max(ACCURACY_RANGE.0)
    }
}

/// A time of the output as time since the start, in t_c.
pub fn since_start(scene: &Scene, time: f64) -> f64 {
    (time - scene.times.start()) / scene.units.time
}
