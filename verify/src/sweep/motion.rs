//! States of the motion of one scene at the times of a sweep.

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::euler_angles::EulerAngles;
use twofold::propagation::{AxisMotion, AxisState, ContinuousAngles, Motion, propagate_axis};

use super::spin_axis_angle::SpinAxisAngle;
use crate::scene_file::Scene;
use crate::trajectory::{ROTATION_PER_STRETCH, Stretches, since_start};

/// What is asked of a motion besides `n` and `L`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Needs {
    /// Whether the third angle is.
    pub(super) equatorial_axis: bool,
    /// Whether Euler angles that count their turns are.
    pub(super) turns: bool,
}

/// One of the times.
pub(super) struct Instant {
    /// Time since the start, in t_c.
    pub(super) since_start: f64,
    /// State; the axis `e_x` is not a number where it is not needed.
    pub(super) state: BodyState<f64>,
    /// Euler angles with their turns, where they are needed and exist.
    pub(super) angles: Option<EulerAngles<f64>>,
    /// Estimated error, see [`AxisMotion::error_estimate`].
    pub(super) error_estimate: f64,
}

/// The states of `scene` at its times. `angle` is shown the whole motion.
///
/// # Errors
/// A motion that cannot be computed.
pub(super) fn instants(
    scene: &Scene,
    needs: Needs,
    mut angle: Option<&mut SpinAxisAngle>,
) -> Result<Vec<Instant>, Error> {
    let mut instants = Vec::new();
    let mut times = scene.times.iter().map(|time| since_start(scene, time)).peekable();
    let total = since_start(scene, scene.times.last());
    if !needs.equatorial_axis && total.abs() * scene.turning_rate() <= ROTATION_PER_STRETCH {
        let start = AxisState::from(&scene.initial);
        let motion = propagate_axis(&scene.spheroid, &scene.violation, &start, (0.0, total), scene.accuracy)?;
        if let Some(angle) = &mut angle {
            angle.add(&motion, 0.0, total)?;
        }
        for t in times {
            let AxisState { axis, momentum } = motion.axis_state(t)?;
            let state = BodyState { axis, momentum, equatorial_axis: axis.map(|_| f64::NAN) };
            instants.push(Instant { since_start: t, state, angles: None, error_estimate: motion.error_estimate(t) });
        }
        return Ok(instants);
    }
    let mut stretches = Stretches::new(scene);
    let mut start_angles = scene.initial_angles;
    let mut earlier = EarlierErrors::default();
    while let Some(stretch) = stretches.next()? {
        let (motion, from, to) = (&stretch.motion, stretch.from, stretch.to);
        if let Some(angle) = &mut angle {
            angle.add(motion, from, to)?;
        }
        let mut angles = ContinuousAngles::new(motion, from, &start_angles)?;
        while let Some(t) = times.next_if(|t| stretch.is_last || t.abs() <= to.abs()) {
            let t = t.clamp(from.min(to), from.max(to));
            instants.push(Instant {
                since_start: t,
                state: motion.state(t)?,
                angles: if needs.turns { angles.at(t).ok() } else { None },
                error_estimate: earlier.at(t, scene.turning_rate()) + motion.error_estimate(t),
            });
        }
        if needs.turns {
            start_angles = angles.at(to).unwrap_or(start_angles);
        }
        earlier.add(to, motion.error_estimate(to));
    }
    Ok(instants)
}

/// Errors at the ends of the stretches before: each grows linearly with the phase that it shifts.
#[derive(Default)]
struct EarlierErrors {
    sum: f64,
    times: f64,
}

impl EarlierErrors {
    fn add(&mut self, time: f64, error: f64) {
        self.sum += error;
        self.times += error * time.abs();
    }

    fn at(&self, time: f64, rate: f64) -> f64 {
        self.sum + rate * (self.sum * time.abs() - self.times)
    }
}
