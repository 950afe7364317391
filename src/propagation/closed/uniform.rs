//! Motions in which the symmetry axis and the angular momentum rotate uniformly about one direction. Eqs. (26), (48).

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::equations_of_motion::torque_on_axis;
use crate::dynamics::{AxisState, BodyState, Problem, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::{SymmetryOfTensor, traceless};
use crate::numerics::scalar::{Real, real_part};
use crate::propagation::Motion;
use crate::propagation::input::check_time;
use crate::solutions::free::{normal_turned_about, rotated_by};

/// A motion `n(t) = R(p t) n`, `L(t) = R(p t) L`, `e_x(t) = R(p t) R_n(g t) e_x` with a constant rotation vector `p` and a
/// constant rate `g` about `n`: free rotation, steady precession, and a body that spins about a principal axis of `s^IJ` or rests.
#[derive(Debug, Clone, Copy)]
pub struct UniformMotion<S> {
    problem: Problem<S>,
    span: (f64, f64),
    /// The rotation vector `p`.
    turn: Vector3<S>,
    /// `g = (Omega - p).n`.
    body_rate: S,
    momentum_is_constant: bool,
    /// Largest torque that the motion neglects.
    neglected_torque: f64,
    /// Bound on the rate over `|L|` at which the neglected bulge rotates everything.
    neglected_bulge: f64,
    /// Condition number of the motion with respect to rounding of the initial state.
    condition: f64,
    /// Rate at which the state departs from the uniform motion: the residual with which a steady one was accepted.
    residual: f64,
}

impl<S: Real> UniformMotion<S> {
    /// Free rotation from the initial state at `span.0`, Eq. (48) `[angfreqfre]`: exact where `s^IJ` is isotropic, otherwise an
    /// approximation that neglects the torque and bounds its effect.
    ///
    /// With `T` the largest torque ([`largest_torque`]), `|dL| <= T t`, and since free rotation preserves lengths, `|dn| <= T t^2 / (2 I^xx)` and
    /// `|d e_x| <= T t^2 / (2 I^xx) (1 + |epsilon Omega^z| t / 3)`: these bounds are rigorous and part of the error estimate. A bulge rotates
    /// everything together, at a rate of at most `2 |b| |s| |L|`, and this rotation is added to all the errors.
    pub fn free(problem: &Problem<S>, span: (f64, f64)) -> Self {
        let (spheroid, initial) = (problem.spheroid(), problem.initial());
        let s = problem.coefficients().map(S::re);
        let anisotropic = traceless(&s);
        let turn = initial.momentum / spheroid.inertia_xx;
        Self {
            problem: *problem,
            span,
            turn,
            body_rate: spheroid.rate_about_axis(&initial.axis, &initial.momentum),
            momentum_is_constant: true,
            neglected_torque: largest_torque(spheroid, problem.coefficients()),
            neglected_bulge: 2.0 * problem.bulge().re().abs() * anisotropic.norm(),
            condition: 1.0,
            residual: 0.0,
        }
    }

    /// Steady motion from the initial state at `span.0`: the steady precession of Eq. (26) `[sol1]` about the symmetry axis of a
    /// tensor with two equal eigenvalues, or, for any tensor, a body whose axis is a principal one and along `L`.
    ///
    /// # Errors
    /// [`Error::Domain`] unless the state satisfies `p x n = L x n / I^xx` and `p x L = Gamma` for some `p` along the symmetry axis to 32
    /// roundings of the turning rate, and if that precession is not stable (rounding would grow exponentially). A body whose axis stays at rest
    /// and that feels no torque must satisfy this exactly. [`Error::Unsupported`] for a star with a bulge.
    pub fn steady(problem: &Problem<S>, span: (f64, f64)) -> Result<Self, Error> {
        problem.require_rigid()?;
        let (spheroid, s, initial) = (problem.spheroid(), problem.coefficients(), problem.initial());
        let BodyState { axis, momentum, .. } = initial;
        let axis_rate = momentum.cross(axis) / spheroid.inertia_xx;
        let torque = torque_on_axis(spheroid.constant_c, s, axis);
        let at_rest = real_part(&axis_rate).amax() == 0.0 && real_part(&torque).amax() == 0.0;
        let (turn, condition, residual) = if at_rest {
            (Vector3::zeros(), 1.0, 0.0)
        } else {
            let (pole, rate) = precession_of(problem, &axis_rate)?;
            let turn = pole * rate;
            let real = spheroid.map(S::re);
            let (pole, rate, n) = (real_part(&pole), rate.re(), real_part(axis));
            let omega = real.free_precession_constant(real_part(momentum).dot(&n) / real.inertia_zz);
            let pull = real.constant_c * SymmetryOfTensor::of(&s.map(S::re))?.difference * 2.0 / real.inertia_xx;
            let speed = rate.abs() + omega.abs() + pull.abs().sqrt();
            let size = real_part(momentum).norm() + real.inertia_xx * pull.abs().sqrt();
            let residual = [
                real_part(&(turn.cross(axis) - axis_rate)).norm(),
                real_part(&(turn.cross(momentum) - torque)).norm() / size,
            ];
            let off = residual[0].max(residual[1]) / speed;
            Error::ensure(
                off <= 32.0 * f64::EPSILON,
                "distance of the state from a steady precession, relative",
                off,
                "at most 32 roundings; Eq. (26) holds for states of constant inclination and rate",
            )?;
            let (cos, sin) = (pole.dot(&n), pole.cross(&n).norm());
            let stiffness = (rate * sin).powi(2) + omega * omega + pull * (sin * sin - 4.0 * cos * cos);
            Error::ensure(
                stiffness > 0.0,
                "squared frequency about the steady precession",
                stiffness,
                "above zero; an unstable precession amplifies rounding errors exponentially",
            )?;
            (turn, 1.0 + speed * speed / (stiffness * sin * sin), off * speed)
        };
        Ok(Self {
            problem: *problem,
            span,
            turn,
            body_rate: (momentum / spheroid.inertia_xx - turn).dot(axis) + spheroid.rate_about_axis(axis, momentum),
            momentum_is_constant: false,
            neglected_torque: 0.0,
            neglected_bulge: 0.0,
            condition,
            residual,
        })
    }

    /// Time since the start of the motion.
    fn elapsed(&self, t: S) -> Result<S, Error> {
        check_time(self.span, t.re())?;
        Ok(t - S::from_f64(self.span.0))
    }

    /// Bound on the effect, within a time, of the neglected torque and bulge on the components of `n`, `L` and `e_x`.
    pub fn truncation(&self, elapsed: f64) -> f64 {
        let (inertia, t) = (self.problem.spheroid().inertia_xx.re(), elapsed.abs());
        let momentum = real_part(&self.problem.initial().momentum).norm();
        // L grows at most by the torque times the time.
        let turned = self.neglected_bulge * (momentum + self.neglected_torque * t) * t;
        if self.neglected_torque == 0.0 {
            return turned.min(2.0);
        }
        let size = momentum + (inertia * self.neglected_torque).sqrt();
        let axes = self.neglected_torque * t * t / (2.0 * inertia) * (1.0 + self.body_rate.re().abs() * t / 3.0);
        // The distance of two directions is at most two.
        (axes + turned).min(2.0).max(self.neglected_torque * t / size + turned)
    }

    /// Rounding of the state and of the angles within a time, and the distance of the state from a steady one.
    pub fn rounding(&self, elapsed: f64) -> f64 {
        let phase = (real_part(&self.turn).norm() + self.body_rate.re().abs()) * elapsed.abs();
        (f64::EPSILON * (4.0 + 4.0 * phase) + self.residual * elapsed.abs()) * self.condition
    }
}

impl UniformMotion<f64> {
    /// The rotation vector of `n` and `L`, and the rate of `e_x` about `n`, which is the whole rotation if `n` stays at
    /// rest.
    fn turns(&self) -> (Vector3<f64>, f64) {
        let axis = &self.problem.initial().axis;
        if self.turn.cross(axis) == Vector3::zeros() {
            (Vector3::zeros(), self.body_rate + self.turn.dot(axis))
        } else {
            (self.turn, self.body_rate)
        }
    }

    /// Rates (rad per unit of time): of the rotation of `n` and `L`, zero, and of the rotation of `e_x` about `n`.
    pub(crate) fn rates(&self) -> [f64; 3] {
        let (turn, about_axis) = self.turns();
        [turn.norm(), 0.0, about_axis]
    }

    /// The axis of the angles `alpha` and `gamma`: the axis that `L` circles, or Z if it stays fixed.
    pub(crate) fn pole(&self) -> Vector3<f64> {
        if self.momentum_is_constant { Vector3::z() } else { self.turn.try_normalize(0.0).unwrap_or_else(Vector3::z) }
    }

    /// The state after given turns of both angles since the start.
    pub(crate) fn state_after_turns(&self, [turn, about_axis]: [f64; 2]) -> BodyState<f64> {
        let BodyState { axis, momentum, equatorial_axis } = self.problem.initial();
        let turned = normal_turned_about(axis, equatorial_axis, TAU * about_axis);
        let direction = self.turns().0.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        let round = |v: &Vector3<f64>| rotated_by(&(direction * (TAU * turn)), v);
        let momentum = if self.momentum_is_constant { *momentum } else { round(momentum) };
        BodyState { axis: round(axis), momentum, equatorial_axis: round(&turned) }
    }
}

/// Upper bound of the torque `2 C |n x (s n)|` for any direction: `C` times the range of the eigenvalues, which is at most the
/// square root of two times the Frobenius norm of the anisotropic part.
pub fn largest_torque<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>) -> f64 {
    let s = s.map(S::re);
    let anisotropic = traceless(&s);
    core::f64::consts::SQRT_2 * spheroid.constant_c.re().abs() * anisotropic.norm()
}

/// Pole and rate of the steady precession that a state may be on.
fn precession_of<S: Real>(problem: &Problem<S>, axis_rate: &Vector3<S>) -> Result<(Vector3<S>, S), Error> {
    let (spheroid, s, initial) = (problem.spheroid(), problem.coefficients(), problem.initial());
    let symmetry = SymmetryOfTensor::of(&s.map(S::re))?;
    symmetry.refuse_asymmetry()?;
    if largest_torque(spheroid, s) == 0.0 {
        // Without torque any state precesses steadily about L.
        let length = crate::numerics::scalar::length(&initial.momentum);
        return Ok((initial.momentum / length, length / spheroid.inertia_xx));
    }
    let pole = symmetry.principal_from_given.row(2).transpose().map(S::from_f64);
    let across = pole.cross(&initial.axis);
    let square = across.dot(&across);
    Error::ensure(
        square.re() > f64::EPSILON * f64::EPSILON,
        "sine of the inclination to the symmetry axis of s^IJ, squared",
        square.re(),
        "above zero; on the pole there is no precession",
    )?;
    Ok((pole, across.dot(axis_rate) / square))
}

impl<S: Real> Motion<S> for UniformMotion<S> {
    type State = BodyState<S>;

    fn spheroid(&self) -> &RigidSpheroid<S> {
        self.problem.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<S> {
        self.problem.coefficients()
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn state(&self, t: S) -> Result<BodyState<S>, Error> {
        let elapsed = self.elapsed(t)?;
        let AxisState { axis, momentum } = self.axis_state(t)?;
        let start = self.problem.initial();
        let turned = normal_turned_about(&start.axis, &start.equatorial_axis, self.body_rate * elapsed);
        Ok(BodyState { axis, momentum, equatorial_axis: rotated_by(&(self.turn * elapsed), &turned) })
    }

    fn axis_state(&self, t: S) -> Result<AxisState<S>, Error> {
        let turn = self.turn * self.elapsed(t)?;
        let BodyState { axis, momentum, .. } = self.problem.initial();
        let momentum = if self.momentum_is_constant { *momentum } else { rotated_by(&turn, momentum) };
        Ok(AxisState { axis: rotated_by(&turn, axis), momentum })
    }

    /// Sum of [`truncation`](UniformMotion::truncation) and [`rounding`](UniformMotion::rounding).
    fn error_estimate(&self, t: f64) -> f64 {
        let elapsed = t - self.span.0;
        self.truncation(elapsed) + self.rounding(elapsed)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::RotationState;
    use crate::dynamics::fixture::STAR;
    use crate::solutions::steady::fixture::steady_precession;

    /// The axis lies in the equator of `s` and precesses about its pole at the rate 1/4 without torque; with a spin it would
    /// require one.
    #[test]
    fn a_steady_motion_is_one_to_32_roundings() {
        let star = RigidSpheroid { inertia_xx: 4.0, inertia_zz: 2.0, constant_c: 1.0 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 0.5));
        let with_spin = |momentum: f64| {
            let momentum = Vector3::new(momentum, 0.0, 1.0);
            let initial = BodyState { axis: Vector3::x(), momentum, equatorial_axis: Vector3::y() };
            UniformMotion::steady(&Problem::new(star, s, initial).unwrap(), (0.0, 100.0))
        };
        // Rate times momentum over |L| + I^xx / 2 = 3, against the speed 1/4 + 1/2.
        let momentum = |roundings: f64| roundings * f64::EPSILON * 0.75 * 3.0 / 0.25;
        let residual = with_spin(momentum(31.6)).unwrap().residual;
        assert_relative_eq!(residual / f64::EPSILON, 31.6 * 0.75, max_relative = 1e-9);
        let Err(Error::Domain { value, .. }) = with_spin(momentum(32.4)) else { panic!("accepted") };
        assert_relative_eq!(value / f64::EPSILON, 32.4, max_relative = 1e-9);
    }

    /// Without torque: precession about `L` at the rate `|L| / I^xx`, which the axis resists by its spin of either sign.
    #[test]
    fn the_condition_of_a_steady_motion_is_the_same_for_both_senses_of_spin() {
        let (sin, cos) = 0.7_f64.sin_cos();
        for axis in [Vector3::new(sin, 0.0, cos), Vector3::new(sin, 0.0, -cos)] {
            let initial = BodyState { axis, momentum: Vector3::z() * 1.7, equatorial_axis: Vector3::y() };
            let motion =
                UniformMotion::steady(&Problem::new(STAR, Matrix3::zeros(), initial).unwrap(), (0.0, 100.0)).unwrap();
            assert_relative_eq!(motion.condition, 1.0 + ((1.0 + cos) / sin).powi(2), max_relative = 1e-12);
        }
    }

    #[test]
    fn the_torque_left_out_counts_whatever_its_unit_and_the_sign_of_c() {
        let initial = BodyState { axis: Vector3::x(), momentum: Vector3::z() * 2.0, equatorial_axis: Vector3::y() };
        let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03));
        for constant_c in [0.7, -0.7] {
            let star = RigidSpheroid { constant_c, ..STAR };
            assert_relative_eq!(largest_torque(&star, &s), 0.7 * (2.0 * 14e-4_f64).sqrt(), max_relative = 1e-12);
            let motion = UniformMotion::free(&Problem::new(star, s, initial).unwrap(), (0.0, 100.0));
            for neglected_torque in [0.1, 1.0] {
                let short = UniformMotion { neglected_torque, ..motion }.truncation(0.01);
                let of_momentum = neglected_torque * 0.01 / (2.0 + (1.3 * neglected_torque).sqrt());
                assert_relative_eq!(short, of_momentum, max_relative = 1e-12);
            }
        }
    }

    /// Steady precessions with a torque, each with its rate about Z.
    fn steady() -> impl Iterator<Item = (UniformMotion<f64>, f64, f64, f64)> {
        [(1.5, 0.7), (1.1, 0.3), (2.7, 1.2), (-1.9, 2.2)].into_iter().map(|(spin, beta)| {
            let (problem, rate) = steady_precession(spin, beta);
            (UniformMotion::steady(&problem, (2.0, 100.0)).unwrap(), rate, spin, beta)
        })
    }

    /// The squared frequency of the inclination about a steady precession is the second derivative of its effective potential over `I^xx`, with both
    /// momenta fixed; here by finite differences.
    #[test]
    fn the_condition_of_a_steady_motion_goes_by_its_stiffness() {
        for (motion, rate, spin, beta) in steady() {
            let initial = motion.problem.initial();
            let (about_z, about_n) = (initial.momentum.z, initial.momentum.dot(&initial.axis));
            let potential = |beta: f64| {
                let (sin, cos) = beta.sin_cos();
                ((about_z - about_n * cos) / sin).powi(2) / (2.0 * STAR.inertia_xx) - STAR.constant_c * 0.6 * cos * cos
            };
            let [low, middle, high] = [-1e-3, 0.0, 1e-3].map(|step| potential(beta + step));
            assert!((high - low).abs() < 1e-2 * (high + low - 2.0 * middle), "a steady state is a minimum");
            let stiffness = (high + low - 2.0 * middle) / 1e-6 / STAR.inertia_xx;
            let pull = STAR.constant_c * 0.6 * 2.0 / STAR.inertia_xx;
            let speed = rate.abs() + STAR.free_precession_constant(spin).abs() + pull.sqrt();
            let expected = 1.0 + speed * speed / (stiffness * beta.sin().powi(2));
            assert_relative_eq!(motion.condition, expected, max_relative = 1e-4);
        }
    }

    #[test]
    fn states_by_turns_are_those_by_time() {
        for (motion, rate, ..) in steady() {
            assert_relative_eq!(motion.pole() * motion.rates()[0], Vector3::z() * rate, epsilon = 1e-13);
            assert_eq!(UniformMotion::free(&motion.problem, (0.0, 1.0)).pole(), Vector3::z());
            let time = 3.7;
            let [turn, _, about_axis] = motion.rates().map(|rate| rate * time / TAU);
            let (found, expected) = (motion.state_after_turns([turn, about_axis]), motion.state(2.0 + time).unwrap());
            for (a, b) in found.vectors().iter().zip(expected.vectors()) {
                assert_relative_eq!(*a, b, epsilon = 1e-12);
            }
        }
    }

    /// If `n` stays at rest, the whole rotation is about it.
    #[test]
    fn a_star_that_spins_about_its_axis_turns_about_it_alone() {
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let initial = BodyState { axis, momentum: axis * 2.2, equatorial_axis: Vector3::y() };
        let motion = UniformMotion::free(&Problem::new(STAR, Matrix3::zeros(), initial).unwrap(), (0.0, 9.0));
        let [turn, nothing, about_axis] = motion.rates();
        assert_eq!([turn, nothing], [0.0; 2]);
        assert_relative_eq!(about_axis, 2.0, max_relative = 1e-15);
        let quarter = motion.state_after_turns([0.0, 0.25]);
        assert_relative_eq!(quarter.equatorial_axis, axis.cross(&Vector3::y()), epsilon = 1e-15);
        assert_eq!((quarter.axis, quarter.momentum), (axis, axis * 2.2));
    }

    /// The pole is found also for a slow motion, about any axis, in either sense.
    #[test]
    fn the_pole_is_what_the_momentum_goes_round() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, 1.1, -0.4).into_inner();
        for (spin, beta) in [(1.5, 0.7), (-1.9, 2.2), (0.2, 0.3), (0.2, 2.8)] {
            let (problem, rate) = steady_precession(spin, beta);
            let motion = UniformMotion::steady(&problem.rotated(&turn), (0.0, 1.0)).unwrap();
            assert!((motion.pole() - turn.column(2) * rate.signum()).amax() < 1e-12, "{rate}");
            // After a quarter of a turn about the pole.
            let start = motion.problem.initial();
            let quarter = motion.state_after_turns([0.25, 0.0]).axis;
            let along = motion.pole() * motion.pole().dot(&start.axis);
            assert!((quarter - along - motion.pole().cross(&start.axis)).amax() < 1e-12, "{rate}");
        }
        let rate = steady_precession(0.2, 0.3).1;
        assert!(rate.abs() < 1.0, "{rate}");
    }
}
