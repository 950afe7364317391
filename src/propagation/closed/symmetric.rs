//! The exact motion for two equal eigenvalues of `s^IJ`, in the frame of the caller and without Euler angles in the
//! interface.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use super::uniform::largest_torque;
use crate::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::{PrincipalCoefficients, SymmetryOfTensor};
use crate::numerics::scalar::{Real, real_part};
use crate::propagation::Motion;
use crate::propagation::input::check_time;
use crate::solutions::symmetric::SymmetricSolution;

/// A motion by [`SymmetricSolution`] for a tensor given in any frame.
///
/// Two eigenvalues that differ are replaced by their mean. The effect of the neglected torque is part of the error estimate. Derivatives (duals)
/// are correct for changes of the tensor that keep its symmetry axis.
#[derive(Debug, Clone, Copy)]
pub struct SymmetricMotion<S> {
    problem: Problem<S>,
    span: (f64, f64),
    solution: SymmetricSolution<S>,
    given_from_principal: Matrix3<S>,
    /// Real parts of the initial values in the frame of the solution.
    start: Start,
    symmetry: SymmetryOfTensor,
    neglected_torque: f64,
    turning_rate: f64,
    /// `sqrt(2 D / I^xx)` with the largest torque `D`: the rate at which the torque turns a body at rest.
    swing_rate: f64,
}

#[derive(Debug, Clone, Copy)]
struct Start {
    spheroid: RigidSpheroid<f64>,
    coefficients: PrincipalCoefficients<f64>,
    angles: EulerAngles<f64>,
    rates: EulerRates<f64>,
}

/// Smallest allowed sine of the inclination along a motion: closer to a pole the Euler rates lose the digits of `L`.
const NEAREST_TO_POLE: f64 = 1e-9;

impl<S: Real> SymmetricMotion<S> {
    /// The motion from the initial state at `span.0`.
    ///
    /// # Errors
    /// [`Error::Domain`] for a tensor that is not symmetric, for a state within 1e-9 of a pole of the symmetry axis at the start or
    /// at any time, and for problems that [`SymmetricSolution::new`] refuses. Eigenvalues that differ are not refused: see
    /// [`truncation`](Self::truncation). [`Error::Unsupported`] for a star with a bulge.
    pub fn new(problem: &Problem<S>, span: (f64, f64)) -> Result<Self, Error> {
        problem.require_rigid()?;
        let (spheroid, s, initial) = (problem.spheroid(), problem.coefficients(), problem.initial());
        let symmetry = SymmetryOfTensor::of(&s.map(S::re))?;
        let principal_from_given = symmetry.principal_from_given.map(S::from_f64);
        let diagonal = (principal_from_given * s * principal_from_given.transpose()).diagonal();
        let equal = (diagonal.x + diagonal.y) / 2.0;
        let coefficients = PrincipalCoefficients { xx: equal, yy: equal, zz: diagonal.z };
        let state = initial.rotated(&principal_from_given);
        let (angles, rates) = (state.angles()?, state.rates(spheroid)?);
        let solution = SymmetricSolution::new(spheroid, &coefficients, &angles, &rates)?;
        let (low, high) = solution.inclinations();
        let nearest = low.re().sin().min(high.re().sin()).min(angles.beta.re().sin());
        Error::ensure(
            nearest >= NEAREST_TO_POLE,
            "least distance from the symmetry axis of s^IJ (sine)",
            nearest,
            "at least 1e-9; nearer to it the Euler angles are singular",
        )?;
        let real = spheroid.map(S::re);
        let start = Start {
            spheroid: real,
            coefficients: coefficients.map(S::re),
            angles: angles.map(S::re),
            rates: rates.map(S::re),
        };
        Ok(Self {
            problem: *problem,
            span,
            solution,
            given_from_principal: principal_from_given.transpose(),
            neglected_torque: largest_torque(&real, &symmetry.asymmetry),
            swing_rate: (2.0 * largest_torque(&real, &s.map(S::re)) / real.inertia_xx).sqrt(),
            turning_rate: real_part(&initial.momentum).norm() / real.inertia_xx
                + (real.oblateness() * (start.rates.alpha * start.angles.beta.cos() + start.rates.gamma)).abs(),
            start,
            symmetry,
        })
    }

    /// Bound on the effect, within a time, of the difference of the two eigenvalues on the components of `n` and `L`; zero if
    /// they are equal within rounding, which [`Motion::error_estimate`] includes.
    ///
    /// With the neglected torque `T` and the largest torque `D`, `|dn|' <= |dL| / I^xx` and `|dL|' <= 2 D |dn| + T`, hence
    /// `|dn| <= T (cosh(k t) - 1) / (2 D)` with `k^2 = 2 D / I^xx` (Gronwall). This is rigorous, but useless over many times
    /// `1 / k`.
    pub fn truncation(&self, elapsed: f64) -> f64 {
        if self.symmetry.is_symmetric_within_rounding() {
            return 0.0;
        }
        let body = &self.start.spheroid;
        let largest = largest_torque(body, &self.problem.coefficients().map(S::re));
        let (k, t) = ((2.0 * largest / body.inertia_xx).sqrt(), elapsed.abs());
        let push = self.neglected_torque / body.inertia_xx;
        let axis = push * ((k * t).cosh() - 1.0) / (k * k);
        let size = self.turning_rate + (self.neglected_torque / body.inertia_xx).sqrt();
        // Nor can L differ by more than the change due to the torques of both motions.
        let momentum = (push * (k * t).sinh() / k).min(2.0 * largest / body.inertia_xx * t) / size;
        momentum.max((axis * (1.0 + self.turning_rate * t)).min(2.0))
    }

    /// Rounding error of the state after the time `elapsed`. It consists of the rounding of the initial values and parameters, amplified by the
    /// derivatives of the solution itself, and of the rounding of the phase, including cancellation in the turning points of the inclination and
    /// near the poles. If the two eigenvalues are equal within rounding, their remaining difference is included here.
    pub fn rounding(&self, elapsed: f64) -> f64 {
        let by = |seed: fn(&mut EulerAngles<Dual64>, &mut EulerRates<Dual64>)| self.sensitivity(elapsed, seed);
        let by_angle = by(|angles, _| angles.beta.eps = 1.0);
        let by_rates = by(|_, rates| rates.beta.eps = 1.0) + by(|_, rates| rates.alpha.eps = 1.0);
        // Initial rates are rounded relative to their own size, and to the size of the terms whose difference they are.
        let rates = &self.start.rates;
        let size = self.turning_rate + self.swing_rate + rates.alpha.abs() + rates.beta.abs();
        let phase = (self.turning_rate + self.swing_rate) * elapsed.abs();
        let lost = self.solution.condition();
        let rounding = f64::EPSILON * (8.0 * (1.0 + phase) * lost + 4.0 * by_angle + 4.0 * size * by_rates);
        let left_out = if self.symmetry.is_symmetric_within_rounding() {
            self.neglected_torque / self.start.spheroid.inertia_xx * elapsed.abs() * by_rates
        } else {
            0.0
        };
        rounding + left_out
    }

    /// Largest component of the derivative of `n`, `L` and `e_x` with respect to an initial value; infinite where it does
    /// not exist.
    fn sensitivity(&self, elapsed: f64, seed: fn(&mut EulerAngles<Dual64>, &mut EulerRates<Dual64>)) -> f64 {
        let Start { spheroid, coefficients, angles, rates } = &self.start;
        let dual = Dual64::from_re;
        let body = spheroid.map(dual);
        let s = coefficients.map(dual);
        let (mut angles, mut rates) = (angles.map(dual), rates.map(dual));
        seed(&mut angles, &mut rates);
        let Ok(solution) = SymmetricSolution::new(&body, &s, &angles, &rates) else { return f64::INFINITY };
        let state = state_of(&body, &solution, dual(elapsed));
        let size = real_part(&state.momentum).norm().max(f64::MIN_POSITIVE);
        let part = |v: &Vector3<Dual64>| v.map(|x| x.eps).amax();
        let most = [part(&state.axis), part(&state.equatorial_axis), part(&state.momentum) / size];
        most.into_iter().fold(0.0, |most, x| if x.is_finite() { x.max(most) } else { f64::INFINITY })
    }
}

fn state_of<S: Real>(spheroid: &RigidSpheroid<S>, solution: &SymmetricSolution<S>, t: S) -> BodyState<S> {
    BodyState::from_angles(spheroid, &solution.angles(t), &solution.rates(t))
}

/// The precession angle and the rotation angle are sums of the same two integrals, so the third angle costs nothing extra
/// here.
impl<S: Real> Motion<S> for SymmetricMotion<S> {
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
        check_time(self.span, t.re())?;
        let state = state_of(self.problem.spheroid(), &self.solution, t - S::from_f64(self.span.0));
        Ok(state.rotated(&self.given_from_principal))
    }

    /// Sum of [`truncation`](SymmetricMotion::truncation) and [`rounding`](SymmetricMotion::rounding); takes some evaluations of
    /// the solution.
    fn error_estimate(&self, t: f64) -> f64 {
        let elapsed = t - self.span.0;
        self.truncation(elapsed) + self.rounding(elapsed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::{ANGLES, STAR, tensor};

    fn motion(s: [f64; 3], beta: f64, [alpha, inclining, gamma]: [f64; 3]) -> Result<SymmetricMotion<f64>, Error> {
        let rates = EulerRates { alpha, beta: inclining, gamma };
        let problem = Problem::from_angles(STAR, tensor(s), &EulerAngles { beta, ..ANGLES }, &rates).unwrap();
        SymmetricMotion::new(&problem, (0.0, 10.0))
    }

    /// Within a short time the neglected torque changes `L` in proportion to the time, and `n` to its square.
    #[test]
    fn what_is_left_out_begins_with_the_momentum() {
        let moving = motion([0.1, 0.1 + 1e-9, -0.2], 0.7, [1.4, 0.1, 0.2]).unwrap();
        let push = moving.neglected_torque / STAR.inertia_xx;
        assert!((push * STAR.inertia_xx / (STAR.constant_c * 1e-9) - 1.0).abs() < 0.2, "{push:e}");
        for t in [1e-3, 3e-3, -3e-3] {
            let expected = push * f64::abs(t) / (moving.turning_rate + push.sqrt());
            assert!((moving.truncation(t) / expected - 1.0).abs() < 1e-5, "{t} {expected:e}");
        }
    }

    #[test]
    fn motions_are_refused_that_come_nearer_to_a_pole_than_a_billionth() {
        let refused = |motion: Result<SymmetricMotion<f64>, Error>| match motion {
            Ok(_) => false,
            Err(Error::Domain { quantity, .. }) if quantity.starts_with("least distance") => true,
            Err(other) => panic!("{other}"),
        };
        // The star spins about an axis near the pole, or swings through the pole.
        assert!(!refused(motion([0.1, 0.1, -0.2], 3e-8, [0.5, 0.0, 2.0])));
        assert!(refused(motion([0.1, 0.1, -0.2], 5e-10, [0.5, 0.0, 2.0])));
        assert!(refused(motion([0.1, 0.1, -0.2], 0.3, [0.0, 0.1, 0.0])));
    }
}
