//! Random scenes over the whole space of motions: the estimated error of each compared with the true one.

use crate::averaged_scenes::direction;
use crate::independent_taylor::state_after;
use crate::prelude::*;

/// A motion and a time at which its error is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct ErrorScene {
    /// Body, tensor and start.
    pub problem: Problem<f64>,
    /// Start and end.
    pub span: (f64, f64),
    /// Time of the comparison.
    pub time: f64,
    /// Tolerance.
    pub tolerance: f64,
    /// Largest eigenvalue of `s^IJ` in magnitude.
    pub strength: f64,
    /// Whether `L` starts near the middle eigenvector.
    pub near_middle_axis: bool,
    /// Whether `n` and `L` start near one eigenvector, where the star is at rest or only spins.
    pub near_rest: bool,
}

fn random_frame(random: &mut Random) -> Matrix3<f64> {
    let axis = nalgebra::Unit::new_normalize(direction(random));
    Rotation3::from_axis_angle(&axis, random.within(0.0, TAU)).into_inner()
}

/// The symmetric tensor with these eigenvalues along the columns of `frame`.
fn tensor_in(frame: &Matrix3<f64>, eigenvalues: [f64; 3]) -> Matrix3<f64> {
    let tensor = frame * Matrix3::from_diagonal(&eigenvalues.into()) * frame.transpose();
    (tensor + tensor.transpose()) / 2.0
}

impl ErrorScene {
    /// Scene `number` drawn from `seed`.
    pub fn draw(seed: u64, number: u64) -> Self {
        let mut random = Random::with_seed(seed.wrapping_mul(0x1_0000_0001).wrapping_add(number));
        let random = &mut Random::with_seed(random.word());
        let chance = |random: &mut Random, share: f64| random.within(0.0, 1.0) < share;
        let log = |random: &mut Random, low: f64, high: f64| 10f64.powf(random.within(low, high));

        // In units in which I^xx and t_c are not one.
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
        let mut toward = direction(random);
        if near_middle_axis {
            let mut order = [0, 1, 2];
            order.sort_by(|a, b| eigenvalues[*a].total_cmp(&eigenvalues[*b]));
            let middle: Vector3<f64> = frame.column(order[1]).into();
            toward = (middle + toward * log(random, -12.0, 0.0)).normalize();
        }
        let size = match random.within(0.0, 1.0) {
            share if share < 0.05 => 0.0,
            share if share < 0.3 => log(random, -4.0, 0.0),
            _ => log(random, -1.0, 1.0),
        };
        let across = toward.cross(&direction(random)).normalize();
        let tilt = match random.within(0.0, 1.0) {
            share if share < 0.15 => log(random, -12.0, 0.0),
            share if share < 0.3 => PI - log(random, -12.0, 0.0),
            _ => random.within(0.0, PI),
        };
        let axis = (toward * tilt.cos() + across * tilt.sin()).normalize();
        let equatorial_axis = axis.cross(&direction(random)).normalize();
        let initial = BodyState { axis, momentum: toward * (size * inertia / unit), equatorial_axis };

        // Spans in t_c, as long as the rotation allows.
        let rate = size + (2.0 * strength).sqrt();
        let most = if chance(random, 0.1) { 2000.0 } else { 300.0 };
        let length = log(random, 0.5, f64::log10(most)).min(10.0 * most / rate);
        let start = random.within(-100.0, 100.0) * unit;
        let end = start + length * unit * if chance(random, 0.3) { -1.0 } else { 1.0 };
        let time = start + (end - start) * random.within(0.0, 1.0);
        let tolerance = log(random, -16.0, -3.0);
        let problem = Problem::new(spheroid, violation, initial).expect("parts of the domain");
        Self { problem, span: (start, end), time, tolerance, strength, near_middle_axis, near_rest: false }
    }

    /// The same scene with a start near rest: `n` and a slow `L` differ from one eigenvector of `s^IJ` by 1e-12 to 1e-1. Its error is taken at the
    /// end, where the deviation has grown, for a tolerance of 1e-6 to 1e-2, for which steps are long.
    pub fn started_near_rest(mut self, seed: u64) -> Self {
        let random = &mut Random::with_seed(seed);
        let (body, s) = (*self.problem.spheroid(), *self.problem.coefficients());
        let frame = s.symmetric_eigen().eigenvectors;
        let rest: Vector3<f64> = frame.column((random.word() % 3) as usize).into();
        let off = 10f64.powf(random.within(-12.0, -1.0));
        let axis = (rest + direction(random) * off).normalize();
        // In units of the `L` that the torque can produce. Much faster stars are stable.
        let unit = (2.0 * body.inertia_xx * body.constant_c.abs() * self.strength).sqrt();
        let spin = if random.word().is_multiple_of(2) { 0.0 } else { 10f64.powf(random.within(-3.0, 0.0)) };
        let momentum = (rest * spin + direction(random) * off) * unit;
        let equatorial_axis = axis.cross(&direction(random)).normalize();
        let initial = BodyState { axis, momentum, equatorial_axis };
        self.problem = Problem::new(body, s, initial).expect("parts of the domain");
        (self.time, self.tolerance) = (self.span.1, 10f64.powf(random.within(-6.0, -2.0)));
        self.near_rest = true;
        self
    }

    /// Unit for errors of `L`: its size plus what the torque can produce.
    pub fn momentum_unit(&self) -> f64 {
        let (body, s) = (self.problem.spheroid(), self.problem.coefficients());
        let anisotropic = s - Matrix3::from_diagonal_element(s.trace() / 3.0);
        let torque = body.constant_c.abs() * anisotropic.norm();
        self.problem.initial().momentum.norm() + (2.0 * body.inertia_xx * torque).sqrt()
    }

    /// Largest rotation of the body until `time`, in rad.
    pub fn turned(&self) -> f64 {
        (self.time - self.span.0).abs() * self.momentum_unit() / self.problem.spheroid().inertia_xx
    }

    /// A similar scene to which a method applies: [`Method::Symmetric`] needs a tensor symmetric about an axis, [`Method::Steady`] a state
    /// that precesses steadily about it, [`Method::Averaged`] a weaker torque. `None` if there is no such state.
    pub fn for_method(mut self, method: Method, seed: u64) -> Option<Self> {
        let random = &mut Random::with_seed(seed);
        let frame = random_frame(random);
        let [equal, other] = [random.within(-1.0, 1.0), 1.0].map(|x| x * self.strength);
        let (body, s, mut initial) = (*self.problem.spheroid(), self.problem.coefficients(), *self.problem.initial());
        let s = match method {
            Method::Taylor | Method::Splitting | Method::Torus => *s,
            // No torque, a weak one, or the full one.
            Method::Free => {
                if initial.momentum.norm() == 0.0 {
                    return None;
                }
                let weaker = [0.0, 1e-12, 1e-6, 1.0][(random.word() % 4) as usize];
                s * weaker + Matrix3::from_diagonal_element(equal)
            }
            Method::Averaged => {
                let weakest = initial.momentum.norm_squared() / (body.inertia_xx * body.constant_c.abs());
                s * (10f64.powf(random.within(-8.0, -0.5)) * weakest / self.strength).min(1.0)
            }
            Method::Symmetric | Method::Steady => tensor_in(&frame, [equal, equal, other]),
        };
        if method == Method::Steady {
            initial = steady_state(&body, initial.momentum.norm(), &frame, [equal, other], random)?;
        }
        self.problem = Problem::new(body, s, initial).ok()?;
        self.strength = s.amax();
        self.tolerance = if method.is_closed_form() { 1e-16 } else { self.tolerance };
        Some(self)
    }

    /// The estimated and the true error of the motion by a method, at the time of the comparison.
    ///
    /// # Errors
    /// If the method refuses the motion.
    pub fn estimated_and_true(&self, method: Method) -> Result<(f64, f64), String> {
        let motion = self.problem.motion_by(method, self.span, self.tolerance)?;
        Ok((motion.error_estimate(self.time), self.true_error(&motion.state(self.time)?)))
    }

    /// The same for a motion in equal parts, each of which continues the one before.
    ///
    /// # Errors
    /// If the method refuses the motion.
    pub fn estimated_and_true_in_parts(&self, method: Method, parts: u32) -> Result<(f64, f64), String> {
        let (start, end) = self.span;
        let (mut problem, mut from, mut earlier) = (self.problem, start, None);
        for part in 1..=parts {
            let to = if part == parts { end } else { start + (end - start) * f64::from(part) / f64::from(parts) };
            let mut motion = problem.motion_by(method, (from, to), self.tolerance)?;
            if let Some(earlier) = earlier {
                motion = motion.continuing_from(earlier)?;
            }
            if part == parts || (self.time - start).abs() <= (to - start).abs() {
                return Ok((motion.error_estimate(self.time), self.true_error(&motion.state(self.time)?)));
            }
            problem = problem.starting_from(motion.state(to)?.orthonormal())?;
            (from, earlier) = (to, motion.error_at_end());
        }
        Err("a motion of no parts".to_owned())
    }

    /// The largest true error of a component of `n`, `e_x` or `L` (in units of its size) of `state` at the time of the
    /// comparison, from a much more accurate integrator, with 32 digits where rounding may matter.
    pub fn true_error(&self, state: &BodyState<f64>) -> f64 {
        // Exact: rounding in the motion is part of its error.
        let duration = DoubleDouble::from_f64(self.time) - DoubleDouble::from_f64(self.span.0);
        let is_well_conditioned = self.turned() > 5.0 && self.turned() < 300.0 && !self.near_rest;
        if self.tolerance > 1e-5 && is_well_conditioned {
            self.difference(state, &state_after::<f64>(&self.problem, duration.high(), 1e-16))
        } else {
            self.difference(state, &state_after::<DoubleDouble>(&self.problem, duration, 1e-22))
        }
    }

    fn difference<S: Real>(&self, state: &BodyState<f64>, exact: &BodyState<S>) -> f64 {
        let off = |a: &Vector3<f64>, b: &Vector3<S>| largest_component(&(a.map(S::from_f64) - b).map(S::re));
        largest([
            off(&state.axis, &exact.axis),
            off(&state.momentum, &exact.momentum) / self.momentum_unit(),
            off(&state.equatorial_axis, &exact.equatorial_axis),
        ])
    }
}

/// Steady precession, Eq. (26), about the third column of a frame.
fn steady_state(
    spheroid: &RigidSpheroid<f64>,
    momentum: f64,
    frame: &Matrix3<f64>,
    [equal, other]: [f64; 2],
    random: &mut Random,
) -> Option<BodyState<f64>> {
    let s = PrincipalCoefficients { xx: equal, yy: equal, zz: other };
    let spin = momentum / spheroid.inertia_zz * if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
    let kind = if random.word().is_multiple_of(2) { Precession::Single } else { Precession::Twofold };
    let (alpha, beta, gamma) = (random.within(0.0, TAU), random.within(0.01, PI - 0.01), random.within(0.0, TAU));
    let rate = steady_precession_rate(kind, spheroid, &s, spin, beta).ok()?;
    let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
    Some(BodyState::from_angles(spheroid, &EulerAngles { alpha, beta, gamma }, &rates).rotated(frame))
}
