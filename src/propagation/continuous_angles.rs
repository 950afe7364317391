//! Euler angles of a motion without jumps of a whole turn.

use core::f64::consts::TAU;

use crate::dynamics::BodyState;
use crate::error::Error;
use crate::euler_angles::EulerAngles;
use crate::propagation::Motion;
use crate::scalar::{Real, real_part};

/// Follows the Euler angles of a motion so that `alpha` and `gamma` count their turns.
///
/// Between two times the motion is halved until neither the symmetry axis, seen from the Z axis, nor the Z axis, seen from
/// the body, can have turned by a quarter: turns are counted, not guessed. A passage through a pole, where `alpha` and
/// `gamma` jump by half a turn each, is taken at the shorter side.
#[derive(Debug)]
pub struct ContinuousAngles<'m, S, M> {
    motion: &'m M,
    time: f64,
    last: Option<EulerAngles<f64>>,
    scalar: core::marker::PhantomData<S>,
}

impl<'m, S: Real, M: Motion<S>> ContinuousAngles<'m, S, M> {
    /// Starts at the time `t0` with the angles `start` there, whose turns are kept. They must be those of the motion up to
    /// whole turns; on a pole, where the motion has no angles of its own, any `start` is taken as given.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span.
    pub fn new(motion: &'m M, t0: f64, start: &EulerAngles<f64>) -> Result<Self, Error> {
        motion.state(S::from_f64(t0))?;
        Ok(Self { motion, time: t0, last: Some(*start), scalar: core::marker::PhantomData })
    }

    /// Angles at the time `t`, continued from the last call; `t` may lie on either side of it.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span, or on a pole, where the angles do not exist; the next call
    /// continues.
    pub fn at(&mut self, t: S) -> Result<EulerAngles<S>, Error> {
        let target = t.re();
        let (mut from_time, mut from) = (self.time, self.real_state(self.time)?);
        let mut ends = vec![(target, self.real_state(target)?)];
        while let Some((to_time, to)) = ends.pop() {
            if self.resolved(&from, &to, to_time - from_time) {
                self.count(&to);
                (from_time, from) = (to_time, to);
            } else {
                let middle = from_time + (to_time - from_time) / 2.0;
                if middle == from_time || middle == to_time {
                    self.count(&to);
                    (from_time, from) = (to_time, to);
                    continue;
                }
                ends.push((to_time, to));
                ends.push((middle, self.real_state(middle)?));
            }
        }
        self.time = target;
        let angles = self.motion.state(t)?.angles()?;
        let counted = self.last.unwrap_or(real_angles(&angles));
        Ok(EulerAngles {
            alpha: angles.alpha + S::from_f64(turns(counted.alpha - angles.alpha.re())),
            beta: angles.beta,
            gamma: angles.gamma + S::from_f64(turns(counted.gamma - angles.gamma.re())),
        })
    }

    fn real_state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        let state = self.motion.state(S::from_f64(t))?;
        Ok(BodyState {
            axis: real_part(&state.axis),
            momentum: real_part(&state.momentum),
            equatorial_axis: real_part(&state.equatorial_axis),
        })
    }

    /// Whether no azimuth can have turned by a quarter between two states, by a bound on the speed of the directions.
    fn resolved(&self, from: &BodyState<f64>, to: &BodyState<f64>, duration: f64) -> bool {
        let spheroid = self.motion.spheroid();
        let (xx, zz) = (spheroid.inertia_xx.re(), spheroid.inertia_zz.re());
        let pull = 2.0 * spheroid.constant_c.re().abs() * self.motion.violation().map(S::re).norm();
        let momentum = from.momentum.norm().max(to.momentum.norm()) + pull * duration.abs();
        // |Omega| is at most |L| over the smaller moment of inertia.
        let arc = momentum / xx.min(zz) * duration.abs();
        // A path shorter than the distance to the pole turns its azimuth by less than a quarter; sin(beta) is below that
        // distance.
        let off_pole = |state: &BodyState<f64>| state.axis.x.hypot(state.axis.y);
        arc < off_pole(from).min(off_pole(to))
    }

    fn count(&mut self, state: &BodyState<f64>) {
        let Ok(angles) = state.angles() else { return };
        self.last = Some(match self.last {
            None => angles,
            Some(last) => EulerAngles {
                alpha: angles.alpha + turns(last.alpha - angles.alpha),
                beta: angles.beta,
                gamma: angles.gamma + turns(last.gamma - angles.gamma),
            },
        });
    }
}

fn real_angles<S: Real>(angles: &EulerAngles<S>) -> EulerAngles<f64> {
    EulerAngles { alpha: angles.alpha.re(), beta: angles.beta.re(), gamma: angles.gamma.re() }
}

/// The whole turns [rad] nearest to an angle.
fn turns(angle: f64) -> f64 {
    (angle / TAU).round() * TAU
}
