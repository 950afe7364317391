//! Turns of the magnetic axis about the angular momentum, counted along a motion.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use super::Beam;
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::numerics::angle::wrapped;
use crate::propagation::Motion;

/// Rotation (rad) between two evaluations of the phase.
const STRIDE: f64 = 0.5;

/// Follows the rotational phase: the azimuth of the magnetic axis `m` about the angular momentum `L`, counted from that of
/// the line of sight, including whole turns.
///
/// A body always turns about `L` in the positive sense (`L . Omega > 0`), and `m` is nearest to the line of sight close to
/// the phase zero of each turn. The azimuth about a fixed axis counts the same turns while that axis and `L` are on one side
/// of the path of `m`; if the path leaves the axis outside, that azimuth oscillates and counts none.
pub(super) struct AzimuthFollower<'a, M> {
    motion: &'a M,
    beam: &'a Beam<f64>,
    line_of_sight: &'a Vector3<f64>,
    stride: f64,
    time: f64,
    phase: f64,
}

impl<'a, M: Motion<f64, State = BodyState<f64>>> AzimuthFollower<'a, M> {
    /// Starts at the time `t`; `rate` bounds the angular velocity.
    pub(super) fn new(
        motion: &'a M,
        beam: &'a Beam<f64>,
        line_of_sight: &'a Vector3<f64>,
        rate: f64,
        t: f64,
    ) -> Result<Self, Error> {
        let phase = phase(beam, line_of_sight, &motion.state(t)?)?;
        Ok(Self { motion, beam, line_of_sight, stride: STRIDE / rate, time: t, phase })
    }

    /// Phase at a later time `t`, continued from the last call.
    ///
    /// Half a radian of rotation turns the path of `m` by about as much, and the azimuth swept about a point that a path
    /// passes is at most half a turn plus the turn of the path itself. Therefore a piece with less than a quarter turn between
    /// its ends hides none; other pieces are halved.
    pub(super) fn at(&mut self, t: f64) -> Result<f64, Error> {
        while self.time < t {
            let mut to = if t - self.time > self.stride { self.time + self.stride } else { t };
            loop {
                let phase = self.phase_at(to)?;
                let swept = phase - self.phase;
                let swept = wrapped(swept);
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

    /// The phase at `t` from -pi to pi.
    fn phase_at(&self, t: f64) -> Result<f64, Error> {
        phase(self.beam, self.line_of_sight, &self.motion.state(t)?)
    }
}

/// Azimuth of the magnetic axis about the angular momentum of a state, from that of the line of sight, from -pi to pi.
pub(super) fn phase(beam: &Beam<f64>, n: &Vector3<f64>, state: &BodyState<f64>) -> Result<f64, Error> {
    let momentum = state.momentum.norm();
    Error::ensure(momentum > 0.0, "|L|", momentum, "above zero; a star at rest has no azimuth about L")?;
    let (l, m) = (state.momentum / momentum, beam.direction(state));
    let (x, y) = (n.dot(&m) - l.dot(n) * l.dot(&m), l.dot(&n.cross(&m)));
    let allowed = "above 2.2e-16; along L neither m nor n has an azimuth about it";
    Error::ensure(
        x.hypot(y) > f64::EPSILON,
        "product of the sines of the angles of m and n with L",
        x.hypot(y),
        allowed,
    )?;
    Ok(y.atan2(x))
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::{Problem, RigidSpheroid};
    use crate::propagation::UniformMotion;

    /// The free motion of a prolate star from its axis and its angular momentum.
    fn free(axis: Vector3<f64>, momentum: Vector3<f64>, span: (f64, f64)) -> UniformMotion<f64> {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 0.8, constant_c: 1.0 };
        let start = BodyState { axis, momentum, equatorial_axis: axis.cross(&Vector3::z()).normalize() };
        UniformMotion::free(&Problem::new(spheroid, Matrix3::zeros(), start).unwrap(), span)
    }

    fn sight() -> Vector3<f64> {
        Vector3::new(0.1, -0.3, 0.6).normalize()
    }

    /// Evaluations are half a radian apart, however fast the star rotates.
    #[test]
    fn fast_turns_are_counted() {
        let (axis, rate) = (Vector3::new(0.36, 0.48, 0.8), 300.0);
        let motion = free(axis, axis * (0.8 * rate), (1.0, 2.0));
        let (beam, n) = (Beam::new(0.6, 0.3, 0.2), sight());
        let mut follower = AzimuthFollower::new(&motion, &beam, &n, rate, 1.0).unwrap();
        let first = follower.at(1.0).unwrap();
        for t in [1.001, 1.13, 1.7] {
            assert!((follower.at(t).unwrap() - first - rate * (t - 1.0)).abs() < 1e-10, "{t}");
        }
    }

    /// One close passage, at a thousandth of a radian, wherever the evaluations are: within half a radian the azimuth turns by more than
    /// half a turn.
    #[test]
    fn a_close_passage_is_followed_in_any_stride() {
        let (l, theta) = (Vector3::new(0.36, 0.48, 0.8), 0.7_f64);
        let axis = l * theta.cos() + l.cross(&Vector3::z()).normalize() * theta.sin();
        let (motion, n) = (free(axis, l * 2.1, (3.0, 60.0)), sight());
        for chi in [theta - 1e-3, theta + 1e-3, PI - theta - 1e-3, PI - theta + 1e-3] {
            let beam = Beam::new(chi, 0.3, 0.2);
            let along = |t: f64| beam.direction(&motion.state(t).unwrap()).dot(&l).abs();
            let times = (0..1000).map(|k| 10.0 + 0.009 * f64::from(k));
            let pass = times.max_by(|a, b| along(*a).total_cmp(&along(*b))).unwrap();
            let exact = |t: f64| phase(&beam, &n, &motion.state(t).unwrap()).unwrap();
            for (before, after) in [(0.3, 0.4), (0.12, 0.7), (0.03, 0.07), (0.08, 0.06), (0.5, 0.02)] {
                let mut follower = AzimuthFollower::new(&motion, &beam, &n, 4.2, pass - before).unwrap();
                let mut last = exact(pass - before);
                for k in 1..=2000 {
                    let next = exact(pass - before + (before + after) * f64::from(k) / 2000.0);
                    last += wrapped(next - last);
                }
                assert!((follower.at(pass + after).unwrap() - last).abs() < 1e-9, "{chi} {before} {after}");
            }
        }
    }
}
