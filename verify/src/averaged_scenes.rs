//! Random fast rotations with a weak torque, over the whole domain of the averaged motion, and the error of that motion compared with its
//! estimate.

use crate::prelude::*;

/// A problem in the principal frame of the traceless tensor `s`, and the time up to which its motion is followed from zero.
#[derive(Debug, Clone, Copy)]
pub struct AveragedScene {
    /// Body, tensor and start.
    pub problem: Problem<f64>,
    /// End time.
    pub end: f64,
}

/// Largest ratio of true error to estimate at twelve times.
#[derive(Debug, Clone, Copy)]
pub struct EstimateSeen {
    /// The ratio.
    pub worst: f64,
    /// True error and estimate, and their time.
    pub at: [f64; 3],
}

fn from_to(random: &mut Random, low: f64, high: f64) -> f64 {
    random.within(low.ln(), high.ln()).exp()
}

fn sign(random: &mut Random) -> f64 {
    if random.word().is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// A random direction, uniform on the sphere.
pub fn direction(random: &mut Random) -> Vector3<f64> {
    let z = random.within(-1.0, 1.0);
    let (sin, cos) = random.within(0.0, TAU).sin_cos();
    let rho = (1.0 - z * z).sqrt();
    Vector3::new(rho * cos, rho * sin, z)
}

/// Principal values scaled to a given strength of the torque on a body, `|C| (s_max - s_min) I^xx / L.L`.
fn of_strength(strength: f64, s: Vector3<f64>, body: &RigidSpheroid<f64>, size: f64) -> Vector3<f64> {
    s * (strength * size * size / (body.constant_c.abs() * body.inertia_xx * (s.max() - s.min())))
}

/// The problem of a body whose axis has the cosine `c` to `momentum` and is tilted to `side`.
fn problem(
    random: &mut Random,
    body: RigidSpheroid<f64>,
    s: &Vector3<f64>,
    momentum: Vector3<f64>,
    (c, side): (f64, Vector3<f64>),
) -> Problem<f64> {
    let l = momentum.normalize();
    let across = side.cross(&l).normalize();
    let axis = (l * c + across * (1.0 - c * c).max(0.0).sqrt()).normalize();
    let equatorial = axis.cross(&direction(random)).normalize();
    let equatorial_axis = (equatorial - axis * axis.dot(&equatorial)).normalize();
    let tensor = PrincipalCoefficients::new((*s).into()).tensor();
    Problem::new(body, tensor, BodyState { axis, momentum, equatorial_axis }).expect("parts of the domain")
}

/// The direction on the separatrix with a given component along the middle axis, and the index of the least principal value; `None` if two
/// principal values are equal.
fn on_separatrix(s: &Vector3<f64>, along: f64) -> Option<(Vector3<f64>, usize)> {
    let (low, high) = (s.imin(), s.imax());
    let middle = 3_usize.checked_sub(low + high).filter(|middle| *middle != low && *middle != high && low != high)?;
    let (upper, lower) = (s[high] - s[middle], s[middle] - s[low]);
    let across = (1.0 - along * along).sqrt() / (upper + lower).sqrt();
    let mut l = Vector3::zeros();
    (l[middle], l[high], l[low]) = (along, across * lower.sqrt(), across * upper.sqrt());
    Some((l, low))
}

impl AveragedScene {
    /// Scene `number`: strengths from 1e-6 to 0.19, both signs of `C`, two equal or nearly equal principal values, `L` anywhere, near an axis or
    /// down to 1e-12 from the separatrix, `n` on or near `L`, normal to it, at `c^2 = 1/3` or anywhere, over 3 to `turned` rad.
    pub fn draw(seed: u64, number: u64, turned: f64) -> Self {
        let mut random = Random::with_seed(seed.wrapping_mul(1_000_003) ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let random = &mut random;
        let mut s = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
        match number % 6 {
            0 => s.y = s.x,
            1 => s.z = s.y,
            2 => s.y = s.x + from_to(random, 1e-9, 0.1) * (s.z - s.x),
            _ => {}
        }
        let s = s.map(|value| value - s.mean());
        let mut body = RigidSpheroid::in_units_of_tc(random.within(0.5, 1.9));
        body.inertia_xx = random.within(0.5, 2.0);
        body.inertia_zz *= body.inertia_xx;
        body.constant_c = random.within(0.5, 2.0) * if random.within(0.0, 1.0) < 0.2 { -1.0 } else { 1.0 };
        let size = from_to(random, 0.3, 3.0);
        let s = of_strength(from_to(random, 1e-6, 0.19), s, &body, size);
        let mut l = direction(random);
        match number % 5 {
            0 => l = near_separatrix(random, &s).unwrap_or(l),
            1 => {
                l *= from_to(random, 1e-9, 0.1);
                l[(random.word() % 3) as usize] = 1.0;
                l = l.normalize();
            }
            _ => {}
        }
        let side = direction(random);
        let c = match (number / 7) % 6 {
            0 => 1.0,
            1 => (1.0_f64 / 3.0).sqrt(),
            2 => 0.0,
            3 => 1.0 - from_to(random, 1e-9, 0.1),
            _ => random.within(-1.0, 1.0),
        };
        let problem = problem(random, body, &s, l * size, (c, side));
        Self { problem, end: from_to(random, 3.0, turned) * body.inertia_xx / size }
    }

    /// A scene whose `L` starts beside the separatrix, within a few times the error of the first order, and goes round a few times. Neighbouring
    /// motions separate there.
    pub fn beside_separatrix(seed: u64, number: u64) -> Self {
        // Three distinct principal values.
        let scene = Self::draw(seed, 6 * number + 4, 10.0);
        let mut random = Random::with_seed(seed ^ number.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let (body, start) = (*scene.problem.spheroid(), scene.problem.initial());
        let size = start.momentum.norm();
        let strength = from_to(&mut random, 3e-3, 0.05);
        let s = of_strength(strength, scene.principal_values(), &body, size);
        let (mut l, low) = on_separatrix(&s, random.within(-0.95, 0.95)).expect("three distinct principal values");
        l[low] += from_to(&mut random, 0.1 * strength * strength, 3.0 * strength) * sign(&mut random);
        // The angle between n and L is kept.
        let (c, side) = (start.axis.dot(&start.momentum) / size, direction(&mut random));
        let problem = problem(&mut random, body, &s, l.normalize() * size, (c, side));
        Self { problem, end: from_to(&mut random, 3.0, 60.0) / strength * body.inertia_xx / size }
    }

    /// Principal values of `s`.
    pub fn principal_values(&self) -> Vector3<f64> {
        self.problem.coefficients().diagonal()
    }

    /// The averaged motion over any scalar.
    ///
    /// # Errors
    /// A motion that is refused.
    pub fn motion<S: Real>(&self, order: AveragingOrder) -> Result<AveragedSolution<S>, Error> {
        AveragedSolution::new(&self.problem.map(S::from_f64), order)
    }

    /// True error over estimate of the first and the second order, at random times and at the end. The estimated error of the numerical motion is
    /// subtracted.
    ///
    /// # Errors
    /// A motion that is refused.
    pub fn estimates_seen(&self, seed: u64) -> Result<[EstimateSeen; 2], Error> {
        let exact = self.problem.taylor((0.0, self.end), 1e-13)?;
        let seen = |order| self.estimate_seen(&exact, order, seed);
        Ok([seen(AveragingOrder::First)?, seen(AveragingOrder::Second)?])
    }

    fn estimate_seen(
        &self,
        exact: &TaylorMotion<f64>,
        order: AveragingOrder,
        seed: u64,
    ) -> Result<EstimateSeen, Error> {
        let averaged = self.motion::<f64>(order)?;
        let mut random = Random::with_seed(seed);
        let mut seen = EstimateSeen { worst: f64::NEG_INFINITY, at: [f64::NAN; 3] };
        for i in 0..12 {
            let t = if i == 0 { self.end } else { self.end * random.within(0.0, 1.0) };
            let right = exact.state(t)?;
            let error = largest_difference(&averaged.state(t), &right, right.momentum.norm());
            let estimate = averaged.error_estimate(t);
            let ratio = (error - exact.error_estimate(t)).max(0.0) / estimate;
            let ratio = if ratio.is_nan() || error.is_nan() { f64::INFINITY } else { ratio };
            if ratio > seen.worst {
                seen = EstimateSeen { worst: ratio, at: [error, estimate, t] };
            }
        }
        Ok(seen)
    }
}

/// A direction near the separatrix; `None` if two principal values are equal.
fn near_separatrix(random: &mut Random, s: &Vector3<f64>) -> Option<Vector3<f64>> {
    on_separatrix(s, 0.0)?;
    let (mut l, low) = on_separatrix(s, random.within(-1.0, 1.0))?;
    l[low] += from_to(random, 1e-12, 0.3) * sign(random);
    let high = s.imax();
    l[high] *= -sign(random);
    Some(l.normalize())
}
