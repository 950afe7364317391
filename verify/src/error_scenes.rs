//! Random scenes over the whole space of motions, and how the estimated error of each compares with its true one.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Rotation3, Vector3};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::numerics::scalar::{Real, Scalar};
use twofold::plan::{Method, PlannedMotion};
use twofold::propagation::Motion;
use twofold::solutions::perturbation::Precession;
use twofold::solutions::steady::steady_precession_rate;

use crate::check::{largest, largest_component};
use crate::double_double::DoubleDouble;
use crate::independent_taylor::state_after;
use crate::random::Random;

/// A motion and a time at which its error is asked for.
#[derive(Debug, Clone, Copy)]
pub struct ErrorScene {
    /// The body.
    pub spheroid: RigidSpheroid<f64>,
    /// `s^IJ`.
    pub violation: Matrix3<f64>,
    /// State at the start.
    pub initial: BodyState<f64>,
    /// Start and end.
    pub span: (f64, f64),
    /// Time asked for.
    pub time: f64,
    /// Accuracy asked for.
    pub accuracy: f64,
    /// Largest eigenvalue of `s^IJ` in magnitude.
    pub strength: f64,
    /// Whether `L` starts near the middle eigenvector.
    pub near_middle_axis: bool,
}

fn unit_vector(random: &mut Random) -> Vector3<f64> {
    let (z, angle) = (random.within(-1.0, 1.0), random.within(0.0, TAU));
    let r = (1.0 - z * z).sqrt();
    Vector3::new(r * angle.cos(), r * angle.sin(), z)
}

fn random_frame(random: &mut Random) -> Matrix3<f64> {
    let axis = nalgebra::Unit::new_normalize(unit_vector(random));
    Rotation3::from_axis_angle(&axis, random.within(0.0, TAU)).into_inner()
}

/// The symmetric tensor with these eigenvalues along the columns of `frame`.
fn tensor_in(frame: &Matrix3<f64>, eigenvalues: [f64; 3]) -> Matrix3<f64> {
    let tensor = frame * Matrix3::from_diagonal(&eigenvalues.into()) * frame.transpose();
    (tensor + tensor.transpose()) / 2.0
}

impl ErrorScene {
    /// Scene `number` of those that start from `seed`.
    pub fn draw(seed: u64, number: u64) -> Self {
        let mut random = Random::with_seed(seed.wrapping_mul(0x1_0000_0001).wrapping_add(number));
        let random = &mut Random::with_seed(random.word());
        let chance = |random: &mut Random, share: f64| random.within(0.0, 1.0) < share;
        let log = |random: &mut Random, low: f64, high: f64| 10f64.powf(random.within(low, high));

        // Units: I^xx and t_c are numbers that are not one.
        let (inertia, unit) = (log(random, -2.0, 2.0), log(random, -2.0, 2.0));
        let spheroid = RigidSpheroid {
            inertia_xx: inertia,
            inertia_zz: inertia * random.within(0.6, 2.0),
            constant_c: inertia / (unit * unit) * if chance(random, 0.2) { -1.0 } else { 1.0 },
        };
        let strength = log(random, -8.0, 0.0);
        let mut eigenvalues = [random.within(-1.0, 1.0), random.within(-1.0, 1.0), 1.0];
        if chance(random, 0.25) {
            eigenvalues[0] = eigenvalues[1] + log(random, -8.0, -1.0);
        } else if chance(random, 0.15) {
            eigenvalues[1] = 1.0 - log(random, -8.0, -1.0);
        }
        let sign = if chance(random, 0.5) { -strength } else { strength };
        let eigenvalues = eigenvalues.map(|x| x * sign);
        let frame = random_frame(random);
        let violation = tensor_in(&frame, eigenvalues);

        let near_middle_axis = chance(random, 0.4);
        let mut direction = unit_vector(random);
        if near_middle_axis {
            let mut order = [0, 1, 2];
            order.sort_by(|a, b| eigenvalues[*a].total_cmp(&eigenvalues[*b]));
            let middle: Vector3<f64> = frame.column(order[1]).into();
            direction = (middle + direction * log(random, -12.0, 0.0)).normalize();
        }
        let size = match random.within(0.0, 1.0) {
            share if share < 0.05 => 0.0,
            share if share < 0.3 => log(random, -4.0, 0.0),
            _ => log(random, -1.0, 1.0),
        };
        let across = direction.cross(&unit_vector(random)).normalize();
        let tilt = match random.within(0.0, 1.0) {
            share if share < 0.15 => log(random, -12.0, 0.0),
            share if share < 0.3 => PI - log(random, -12.0, 0.0),
            _ => random.within(0.0, PI),
        };
        let axis = (direction * tilt.cos() + across * tilt.sin()).normalize();
        let equatorial_axis = axis.cross(&unit_vector(random)).normalize();
        let initial = BodyState { axis, momentum: direction * (size * inertia / unit), equatorial_axis };

        // Spans in t_c, as long as the rotation allows.
        let rate = size + (2.0 * strength).sqrt();
        let most = if chance(random, 0.1) { 2000.0 } else { 300.0 };
        let length = log(random, 0.5, f64::log10(most)).min(10.0 * most / rate);
        let start = random.within(-100.0, 100.0) * unit;
        let end = start + length * unit * if chance(random, 0.3) { -1.0 } else { 1.0 };
        let time = start + (end - start) * random.within(0.0, 1.0);
        let accuracy = log(random, -16.0, -3.0);
        Self { spheroid, violation, initial, span: (start, end), time, accuracy, strength, near_middle_axis }
    }

    /// Unit in which errors of `L` count: its size and what the torque makes of it.
    pub fn momentum_unit(&self) -> f64 {
        let anisotropic = self.violation - Matrix3::from_diagonal_element(self.violation.trace() / 3.0);
        let torque = self.spheroid.constant_c.abs() * anisotropic.norm();
        self.initial.momentum.norm() + (2.0 * self.spheroid.inertia_xx * torque).sqrt()
    }

    /// Radians that the body turns at most until the time asked for.
    pub fn turned(&self) -> f64 {
        (self.time - self.span.0).abs() * self.momentum_unit() / self.spheroid.inertia_xx
    }

    /// A scene like this one that a method is made for: [`Method::Symmetric`] takes a tensor symmetric about an axis, [`Method::Steady`] a
    /// state that precesses steadily about it, [`Method::Averaged`] a weaker torque. `None` where there is no such state.
    pub fn for_method(mut self, method: Method, seed: u64) -> Option<Self> {
        let random = &mut Random::with_seed(seed);
        let frame = random_frame(random);
        let [equal, other] = [random.within(-1.0, 1.0), 1.0].map(|x| x * self.strength);
        match method {
            Method::Taylor | Method::Splitting => {}
            // Weak torques over spans that they are nearly nothing in, and none at all.
            Method::Free => {
                if self.initial.momentum.norm() == 0.0 {
                    return None;
                }
                let weaker = [0.0, 1e-12, 1e-6, 1.0][(random.word() % 4) as usize];
                self.violation = self.violation * weaker + Matrix3::from_diagonal_element(equal);
            }
            Method::Averaged => {
                let weakest =
                    self.initial.momentum.norm_squared() / (self.spheroid.inertia_xx * self.spheroid.constant_c.abs());
                self.violation *= (10f64.powf(random.within(-8.0, -0.5)) * weakest / self.strength).min(1.0);
            }
            Method::Symmetric | Method::Steady => {
                self.violation = tensor_in(&frame, [equal, equal, other]);
            }
        }
        if method == Method::Steady {
            self.initial = self.steady_state(&frame, equal, other, random)?;
        }
        self.strength = self.violation.amax();
        self.accuracy = if method.is_closed_form() { 1e-16 } else { self.accuracy };
        Some(self)
    }

    /// Steady precession, Eq. (26), about the third axis of a frame (its rows in the given one are columns here).
    fn steady_state(
        &self,
        frame: &Matrix3<f64>,
        equal: f64,
        other: f64,
        random: &mut Random,
    ) -> Option<BodyState<f64>> {
        let s = PrincipalCoefficients { xx: equal, yy: equal, zz: other };
        let spin = self.initial.momentum.norm() / self.spheroid.inertia_zz
            * if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
        let kind = if random.word().is_multiple_of(2) { Precession::Single } else { Precession::Twofold };
        let (alpha, beta, gamma) = (random.within(0.0, TAU), random.within(0.01, PI - 0.01), random.within(0.0, TAU));
        let rate = steady_precession_rate(kind, &self.spheroid, &s, spin, beta).ok()?;
        let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
        Some(BodyState::from_angles(&self.spheroid, &EulerAngles { alpha, beta, gamma }, &rates).rotated(frame))
    }

    /// The estimated error at the time asked for, and the true one, of the Taylor series.
    ///
    /// # Errors
    /// What the motion refuses.
    pub fn estimated_and_true(&self) -> Result<(f64, f64), String> {
        self.estimated_and_true_by(Method::Taylor)
    }

    /// The same by any method.
    ///
    /// # Errors
    /// What the motion refuses.
    pub fn estimated_and_true_by(&self, method: Method) -> Result<(f64, f64), String> {
        let motion =
            PlannedMotion::by(method, &self.spheroid, &self.violation, &self.initial, self.span, self.accuracy);
        let motion = motion?;
        let state = motion.state(self.time)?;
        Ok((motion.error_estimate(self.time), largest(self.true_errors(&state))))
    }

    /// True errors of `n`, `L` (in units of its size) and `e_x`, largest components, of `state` at the time asked for. By
    /// another integrator that is much more accurate, with 32 digits where rounding may matter.
    pub fn true_errors(&self, state: &BodyState<f64>) -> [f64; 3] {
        // Exactly: that the motion rounds it is part of its error.
        let duration = DoubleDouble::from_f64(self.time) - DoubleDouble::from_f64(self.span.0);
        if self.accuracy > 1e-5 && self.turned() > 5.0 && self.turned() < 300.0 {
            self.differences(
                state,
                &state_after::<f64>(&self.spheroid, &self.violation, &self.initial, duration.high(), 1e-16),
            )
        } else {
            let end = state_after::<DoubleDouble>(&self.spheroid, &self.violation, &self.initial, duration, 1e-22);
            self.differences(state, &end)
        }
    }

    fn differences<S: Real>(&self, state: &BodyState<f64>, exact: &BodyState<S>) -> [f64; 3] {
        let difference = |a: &Vector3<f64>, b: &Vector3<S>| largest_component(&(a.map(S::from_f64) - b).map(S::re));
        [
            difference(&state.axis, &exact.axis),
            difference(&state.momentum, &exact.momentum) / self.momentum_unit(),
            difference(&state.equatorial_axis, &exact.equatorial_axis),
        ]
    }
}
