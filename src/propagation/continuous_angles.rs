//! Unwrapped (continuous) Euler angles of a motion.

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::dynamics::equations_of_motion::{angular_velocity, reduced_rates};
use crate::error::Error;
use crate::euler_angles::EulerAngles;
use crate::lorentz_violation::traceless;
use crate::numerics::angle::whole_turns;
use crate::numerics::scalar::{Real, real_part};
use crate::propagation::{Motion, Turning};

/// Largest rotation (rad) whose turns are counted in one call; it takes minutes.
pub const MOST_COUNTED: f64 = 1e9;

/// Number of pieces of time allowed for counting turns: per radian of rotation, and in addition to that. A passage by a pole takes some sixty.
const PIECES_PER_RADIAN: f64 = 1e3;
const LEAST_PIECES: f64 = 1e4;

/// Follows the Euler angles of a motion continuously, so that `alpha` and `gamma` include whole turns.
///
/// An interval of time is halved until neither the symmetry axis, seen from the Z axis, nor the Z axis, seen from the body,
/// can have turned by a quarter: turns are counted, not guessed. At a passage through a pole, where `alpha` and `gamma` jump
/// by half a turn each, the shorter side is chosen.
#[derive(Debug)]
pub struct ContinuousAngles<'m, S, M> {
    motion: &'m M,
    time: f64,
    last: EulerAngles<f64>,
    scalar: core::marker::PhantomData<S>,
}

impl<'m, S: Real, M: Motion<S, State = BodyState<S>>> ContinuousAngles<'m, S, M> {
    /// Starts at the time `t0` with the angles `start` there, whose turns are kept. They must be those of the motion up to
    /// whole turns; at a pole, where the angles of the motion are undefined, any `start` is accepted as given.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span.
    pub fn new(motion: &'m M, t0: f64, start: &EulerAngles<f64>) -> Result<Self, Error> {
        motion.state(S::from_f64(t0))?;
        Ok(Self { motion, time: t0, last: *start, scalar: core::marker::PhantomData })
    }

    /// Angles at the time `t`, continued from the last call; `t` may lie on either side of it.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span, for a rotation of more than [`MOST_COUNTED`] since the last call, for an axis that is
    /// held near a pole against the torque, as only an approximate motion can be, or at a pole, where the angles are undefined; the next call
    /// continues.
    pub fn at(&mut self, t: S) -> Result<EulerAngles<S>, Error> {
        let target = t.re();
        let (mut from_time, mut from) = (self.time, self.real_state(self.time)?);
        let rotation = self.rotation(&from, target - from_time);
        let is_finite = |state: &BodyState<f64>, time: f64| {
            let allowed = "finite in every component";
            Error::ensure(finite(state), "state of the motion at time t", time, allowed)
        };
        is_finite(&from, from_time)?;
        Error::ensure(
            rotation <= MOST_COUNTED,
            "rotation (rad)",
            rotation,
            "at most 1e9 between calls; turns are counted one by one",
        )?;
        let mut ends = vec![(target, self.real_state(target)?)];
        let (mut pieces, most) = (0.0, LEAST_PIECES + PIECES_PER_RADIAN * rotation);
        while let Some((to_time, to)) = ends.pop() {
            pieces += 1.0;
            Error::ensure(
                pieces <= most,
                "number of pieces in which turns are counted",
                pieces,
                "at most 1e4 plus 1e3 per radian; the axis stays so near to a pole that a torque could turn its azimuth at any time",
            )?;
            is_finite(&to, to_time)?;
            if self.resolved(&from, &to, to_time - from_time) {
                self.count(&to, to_time);
                (from_time, from) = (to_time, to);
            } else {
                let middle = from_time + (to_time - from_time) / 2.0;
                if middle == from_time || middle == to_time {
                    self.count(&to, to_time);
                    (from_time, from) = (to_time, to);
                    continue;
                }
                ends.push((to_time, to));
                ends.push((middle, self.real_state(middle)?));
            }
        }
        let angles = self.motion.state(t)?.angles()?;
        Ok(EulerAngles {
            alpha: angles.alpha + S::from_f64(whole_turns(self.last.alpha - angles.alpha.re())),
            beta: angles.beta,
            gamma: angles.gamma + S::from_f64(whole_turns(self.last.gamma - angles.gamma.re())),
        })
    }

    /// Upper estimate of the rotation (rad) over a time from a state.
    fn rotation(&self, state: &BodyState<f64>, duration: f64) -> f64 {
        let spheroid = self.motion.spheroid();
        let (xx, zz) = (spheroid.inertia_xx.re().abs(), spheroid.inertia_zz.re().abs());
        let anisotropic = traceless(&self.motion.coefficients().map(S::re)).norm();
        let by_violation = (4.0 * spheroid.constant_c.re().abs() * anisotropic / xx).sqrt();
        (state.momentum.norm() / xx.min(zz) + by_violation) * duration.abs()
    }

    fn real_state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        let state = self.motion.state(S::from_f64(t))?;
        Ok(BodyState {
            axis: real_part(&state.axis),
            momentum: real_part(&state.momentum),
            equatorial_axis: real_part(&state.equatorial_axis),
        })
    }

    /// Whether no azimuth can have turned by a quarter between two states, as seen from either of them. Between two states
    /// at the pole less than a radian of rotation apart there is nothing to count.
    fn resolved(&self, from: &BodyState<f64>, to: &BodyState<f64>, duration: f64) -> bool {
        let on_pole = |state: &BodyState<f64>| off_pole(state) <= f64::EPSILON;
        let inertia = self.motion.spheroid().inertia_xx.re().min(self.motion.spheroid().inertia_zz.re());
        let short = from.momentum.norm().max(to.momentum.norm()) * duration.abs() < inertia;
        self.stays_aside(from, duration) || self.stays_aside(to, duration) || (short && on_pole(from) && on_pole(to))
    }

    /// Whether over a time `t` from `state` both the path of `n` and that of Z in the body stay shorter than the distance to
    /// the pole; sin(beta) is below that distance, and such a path turns its azimuth by less than a quarter.
    ///
    /// The bounds shrink with that distance if `n`, `L` and a principal axis are near Z, so that a body spinning there costs
    /// no more than any other. With `v = |dn/dt|`, `w >= |L| / I^xx`, the angular acceleration `g` of the torque now and its
    /// change `k |dn|`, the path `p` of `n` obeys `p'' <= w p' + k p + g`, hence
    /// `p <= (v t + g t^2 / 2) exp((w + sqrt(k)) t)`. The rate of Z in the body, `|Omega x Z|`, changes by at most
    /// `g t + k int p dt + |I^zz - I^xx| |Omega^z| p / I^xx`.
    fn stays_aside(&self, state: &BodyState<f64>, duration: f64) -> bool {
        let spheroid = self.motion.spheroid().map(|x| x.re());
        let s = traceless(&self.motion.coefficients().map(S::re));
        let (xx, t) = (spheroid.inertia_xx, duration.abs());
        let (axis_rate, torque) = reduced_rates(&spheroid, &s, &state.axis, &state.momentum);
        let rate = state.momentum.norm() / xx;
        // A bulge rotates everything by at most this fraction of the rate.
        let share = match self.motion.turning() {
            Turning::Equations { bulge } => 2.0 * bulge.abs() * s.norm() * xx,
            Turning::Given { .. } => 0.0,
        };
        let turned = share * rate;
        let acceleration = (torque.norm() / xx + turned * rate) * (1.0 + share);
        let k = 4.0 * spheroid.constant_c.abs() * s.norm() / xx * (1.0 + share);
        let w = rate * (1.0 + share) + k * t;
        let axis_path = ((axis_rate.norm() + turned) * t + acceleration * t * t / 2.0) * ((w + k.sqrt()) * t).exp();
        let spin = state.momentum.dot(&state.axis) / spheroid.inertia_zz;
        let z_rate = angular_velocity(&spheroid, &state.axis, &state.momentum).cross(&Vector3::z()).norm();
        let z_path = (z_rate + turned) * t
            + acceleration * t * t / 2.0
            + (k * t * t / 2.0 + (spheroid.oblateness() * spin).abs() * t) * axis_path;
        axis_path.max(z_path) < off_pole(state)
    }

    /// The count is kept if a later piece is refused.
    fn count(&mut self, state: &BodyState<f64>, time: f64) {
        self.time = time;
        let Ok(angles) = state.angles() else { return };
        self.last = EulerAngles {
            alpha: angles.alpha + whole_turns(self.last.alpha - angles.alpha),
            beta: angles.beta,
            gamma: angles.gamma + whole_turns(self.last.gamma - angles.gamma),
        };
    }
}

fn finite(state: &BodyState<f64>) -> bool {
    [state.axis, state.momentum, state.equatorial_axis].iter().flatten().all(|component| component.is_finite())
}

/// Distance of `n` from the nearer end of the Z axis, across it: `sin(beta)`.
fn off_pole(state: &BodyState<f64>) -> f64 {
    state.axis.x.hypot(state.axis.y)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::fixture::{ANGLES as START, STAR};
    use crate::dynamics::{Problem, RigidSpheroid};
    use crate::euler_angles::EulerRates;
    use crate::plan::Counted;
    use crate::propagation::UniformMotion;

    /// Free precession about Z at the rate 1, starting at a given time. The tensor is isotropic, because one that exerts a torque could turn the body
    /// by more than 1e9 rad, which is refused.
    fn precession(from: f64) -> (UniformMotion<f64>, EulerRates<f64>) {
        let spin = 1.3 * START.beta.cos() / 1.1;
        let rates = EulerRates { alpha: 1.0, beta: 0.0, gamma: 0.2 / 1.3 * spin };
        let initial = BodyState::from_angles(&STAR, &START, &rates);
        let problem = Problem::new(STAR, Matrix3::from_diagonal_element(1e16), initial).unwrap();
        (UniformMotion::free(&problem, (from, from + 100.0)), rates)
    }

    /// A path of length `x exp(x)` times the distance to the pole, for a rotation `x`, is short enough up to `x = 0.567`.
    #[test]
    fn time_is_halved_until_no_turn_can_be_lost() {
        let (motion, rates) = precession(0.0);
        for (t, pieces) in [(9.0, 16.0), (9.1, 32.0), (18.1, 32.0), (18.2, 64.0)] {
            let counted = Counted::new(motion);
            let angles = ContinuousAngles::new(&counted, 0.0, &START).unwrap().at(t).unwrap();
            assert_relative_eq!(angles.alpha, START.alpha + t, max_relative = 1e-12);
            assert_relative_eq!(angles.gamma, START.gamma + rates.gamma * t, max_relative = 1e-12);
            // The start twice, the end twice, and the times between the pieces.
            assert_eq!(counted.evaluations().orientation_evaluations, 4.0 + (pieces - 1.0), "{t}");
        }
    }

    /// Doubles near 1e16 are two apart, here two radians: there is none between them, and the nearest turn is assumed.
    #[test]
    fn turns_are_counted_on_between_times_that_cannot_be_halved() {
        let (motion, rates) = precession(1e16);
        let mut angles = ContinuousAngles::new(&motion, 1e16, &START).unwrap();
        for elapsed in [40.0, 44.0, 12.0] {
            let angles = angles.at(1e16 + elapsed).unwrap();
            assert_relative_eq!(angles.alpha, START.alpha + elapsed, max_relative = 1e-12);
            assert_relative_eq!(angles.gamma, START.gamma + rates.gamma * elapsed, max_relative = 1e-12);
        }
    }

    #[test]
    fn there_is_nothing_to_count_between_two_near_states_on_the_pole_alone() {
        let (motion, _) = precession(0.0);
        let angles = ContinuousAngles::new(&motion, 0.0, &START).unwrap();
        let momentum = Vector3::new(0.0, 1.3, 0.0);
        let state = |axis| BodyState { axis, momentum, equatorial_axis: Vector3::y() };
        let (on, off) = (state(Vector3::z()), state(Vector3::new(0.1, 0.0, 0.99_f64.sqrt())));
        let resolved = |from, to, radians: f64| angles.resolved(from, to, 1.1 / 1.3 * radians);
        assert!(resolved(&on, &on, 0.9) && resolved(&on, &on, -0.9) && !resolved(&on, &on, 1.1));
        assert!(!resolved(&on, &off, 0.9) && !resolved(&off, &on, 0.9) && !resolved(&off, &off, 0.9));
    }

    /// A prolate body that spins about its axis. The Z axis moves in it by the bound given above, whose terms are tested one by one.
    #[test]
    fn the_path_of_z_in_the_body_is_bounded_by_rate_torque_and_spin() {
        let star = RigidSpheroid { inertia_xx: 2.0, inertia_zz: 0.64, constant_c: 3.4 };
        let s = Vector3::new(-0.68, -0.29, 1.06);
        let axis: Vector3<f64> = Vector3::new(-0.4, 0.02, 0.92).normalize();
        let state = BodyState { axis, momentum: axis * 0.74, equatorial_axis: Vector3::y() };
        let motion = UniformMotion::free(&Problem::unchecked(star, Matrix3::from_diagonal(&s), state), (0.0, 1.0));
        let angles = ContinuousAngles::new(&motion, 0.0, &START).unwrap();

        let (w, spin) = (0.74 / 2.0, 0.74 / 0.64);
        let distance = axis.x.hypot(axis.y);
        let (g, k) = (2.0 * 3.4 * axis.cross(&s.component_mul(&axis)).norm() / 2.0, 4.0 * 3.4 * s.norm() / 2.0);
        let paths = |t: f64| {
            let of_axis = 0.5 * g * t * t * ((w + k * t + k.sqrt()) * t).exp();
            let by_change = 0.5 * k * t * t * of_axis + (2.0 - 0.64) / 2.0 * spin * t * of_axis;
            (of_axis, spin * distance * t + 0.5 * g * t * t + by_change)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if paths(middle).1 < distance { low = middle } else { high = middle }
        }
        assert!(paths(low).0 < 0.97 * distance, "the path of Z is the longer one");
        assert!(angles.stays_aside(&state, 0.998 * low) && !angles.stays_aside(&state, 1.002 * low));
    }
}
