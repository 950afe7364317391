//! Turns of the magnetic axis about the angular momentum, counted along a motion.

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;

use super::Beam;
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::propagation::Motion;

/// Rotation (rad) between two looks at the phase.
const STRIDE: f64 = 0.5;

/// Follows the phase of rotation: the azimuth of the magnetic axis `m` about the angular momentum `L`, counted from that of
/// the line of sight, whole turns included.
///
/// A body turns about `L` in the positive sense always (`L . Omega > 0`), and `m` comes nearest to the line of sight near the
/// phase zero of each turn. The azimuth about a fixed axis counts the same turns while that axis and `L` are on one side of
/// the path of `m`; where the path leaves the axis outside, that azimuth swings to and fro and counts none.
pub(super) struct Turns<'a, M> {
    motion: &'a M,
    beam: &'a Beam<f64>,
    line_of_sight: &'a Vector3<f64>,
    stride: f64,
    time: f64,
    phase: f64,
}

impl<'a, M: Motion<f64>> Turns<'a, M> {
    /// Starts at the time `t`; `rate` bounds the angular velocity.
    pub(super) fn new(
        motion: &'a M,
        beam: &'a Beam<f64>,
        line_of_sight: &'a Vector3<f64>,
        rate: f64,
        t: f64,
    ) -> Result<Self, Error> {
        let mut turns = Self { motion, beam, line_of_sight, stride: STRIDE / rate, time: t, phase: 0.0 };
        turns.phase = turns.phase_at(t)?;
        Ok(turns)
    }

    /// Phase at a later time `t`, continued from the last call.
    ///
    /// Half a radian of rotation turns the path of `m` by about as much, and the azimuth swept about a point that a path
    /// passes is at most half a turn and what the path itself turns by: a piece with less than a quarter turn between its ends
    /// has none hidden. Others are halved.
    pub(super) fn at(&mut self, t: f64) -> Result<f64, Error> {
        while self.time < t {
            let mut to = if t - self.time > self.stride { self.time + self.stride } else { t };
            loop {
                let phase = self.phase_at(to)?;
                let swept = phase - self.phase;
                let swept = swept - (swept / TAU).round() * TAU;
                let middle = self.time + (to - self.time) / 2.0;
                if swept.abs() < FRAC_PI_2 || middle <= self.time || middle >= to {
                    (self.time, self.phase) = (to, self.phase + swept);
                    break;
                }
                to = middle;
            }
        }
        Ok(self.phase)
    }

    /// The phase at `t` in (-pi, pi].
    fn phase_at(&self, t: f64) -> Result<f64, Error> {
        phase(self.beam, self.line_of_sight, &self.motion.state(t)?)
    }
}

/// Azimuth of the magnetic axis about the angular momentum of a state, from that of the line of sight, in (-pi, pi].
pub(super) fn phase(beam: &Beam<f64>, n: &Vector3<f64>, state: &BodyState<f64>) -> Result<f64, Error> {
    let (l, m) = (state.momentum.normalize(), beam.direction(state));
    let (x, y) = (n.dot(&m) - l.dot(n) * l.dot(&m), l.dot(&n.cross(&m)));
    let allowed = "above 2.2e-16: along L neither m nor n has an azimuth about it";
    Error::unless(
        x.hypot(y) > f64::EPSILON,
        "product of the sines of the angles of m and n with L",
        x.hypot(y),
        allowed,
    )?;
    Ok(y.atan2(x))
}
