//! Random fast rotations against a weak torque, over the whole domain of the averaged motion, and its error beside its estimate.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{Motion, propagate};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder};
use twofold::{Error, Real};

use crate::check::{largest, largest_component};
use crate::random::Random;

/// A scene in the principal frame, and how long it is followed.
#[derive(Debug, Clone)]
pub struct MeanScene {
    /// The body.
    pub spheroid: RigidSpheroid<f64>,
    /// Principal values of `s`, traceless.
    pub s: Vector3<f64>,
    /// The state at the time zero.
    pub initial: BodyState<f64>,
    /// The end.
    pub end: f64,
}

/// What an estimate was worth.
#[derive(Debug, Clone, Copy)]
pub struct EstimateSeen {
    /// Largest true error over estimate, of twelve times.
    pub worst: f64,
    /// True error, estimate and time there.
    pub at: [f64; 3],
}

fn from_to(random: &mut Random, low: f64, high: f64) -> f64 {
    random.within(low.ln(), high.ln()).exp()
}

fn direction(random: &mut Random) -> Vector3<f64> {
    let z = random.within(-1.0, 1.0);
    let (sin, cos) = random.within(0.0, TAU).sin_cos();
    let rho = (1.0 - z * z).sqrt();
    Vector3::new(rho * cos, rho * sin, z)
}

impl MeanScene {
    /// The scene of a number: strengths from 1e-6 to 0.19, both signs of `C`, two equal or nearly equal principal values, `L` anywhere, near an
    /// axis, and near the separatrix up to 1e-12, `n` on `L` or near it, normal to it, at `c^2 = 1/3` or anywhere, followed for 3 to `turned` rad.
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
        s = s.map(|value| value - s.mean());
        let mut spheroid = RigidSpheroid::in_units_of_tc(random.within(0.5, 1.9));
        spheroid.inertia_xx = random.within(0.5, 2.0);
        spheroid.inertia_zz *= spheroid.inertia_xx;
        spheroid.constant_c = random.within(0.5, 2.0) * if random.within(0.0, 1.0) < 0.2 { -1.0 } else { 1.0 };
        let size = from_to(random, 0.3, 3.0);
        let strength = from_to(random, 1e-6, 0.19);
        s *= strength * size * size / (spheroid.constant_c.abs() * spheroid.inertia_xx * (s.max() - s.min()));
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
        let across = direction(random).cross(&l).normalize();
        let c = match (number / 7) % 6 {
            0 => 1.0,
            1 => (1.0_f64 / 3.0).sqrt(),
            2 => 0.0,
            3 => 1.0 - from_to(random, 1e-9, 0.1),
            _ => random.within(-1.0, 1.0),
        };
        let axis = (l * c + across * (1.0 - c * c).max(0.0).sqrt()).normalize();
        let equatorial = axis.cross(&direction(random)).normalize();
        let equatorial_axis = (equatorial - axis * axis.dot(&equatorial)).normalize();
        let end = from_to(random, 3.0, turned) * spheroid.inertia_xx / size;
        Self { spheroid, s, initial: BodyState { axis, momentum: l * size, equatorial_axis }, end }
    }

    /// A scene whose `L` begins beside the separatrix, nearer to it than a few times what the first order leaves out, and goes round a few times:
    /// where neighbours part.
    pub fn beside_separatrix(seed: u64, number: u64) -> Self {
        // Three distinct principal values.
        let mut scene = Self::draw(seed, 6 * number + 4, 10.0);
        let mut random = Random::with_seed(seed ^ number.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let size = scene.initial.momentum.norm();
        let strength = from_to(&mut random, 3e-3, 0.05);
        let spread = scene.s.max() - scene.s.min();
        scene.s *= strength * size * size / (scene.spheroid.constant_c.abs() * scene.spheroid.inertia_xx * spread);
        let (low, high) = (scene.s.imin(), scene.s.imax());
        let (upper, lower) = (scene.s[high] - scene.s[3 - low - high], scene.s[3 - low - high] - scene.s[low]);
        let mut l = Vector3::zeros();
        let along = random.within(-0.95, 0.95);
        let across = f64::sqrt(1.0 - along * along) / (upper + lower).sqrt();
        (l[3 - low - high], l[high], l[low]) = (along, across * lower.sqrt(), across * upper.sqrt());
        l[low] += from_to(&mut random, 0.1 * strength * strength, 3.0 * strength)
            * if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
        let l = l.normalize();
        // n at its angle to L.
        let c = scene.initial.axis.dot(&scene.initial.momentum) / size;
        let across = direction(&mut random).cross(&l).normalize();
        let axis = (l * c + across * (1.0 - c * c).max(0.0).sqrt()).normalize();
        let equatorial = axis.cross(&direction(&mut random)).normalize();
        let equatorial_axis = (equatorial - axis * axis.dot(&equatorial)).normalize();
        scene.initial = BodyState { axis, momentum: l * size, equatorial_axis };
        scene.end = from_to(&mut random, 3.0, 60.0) / strength * scene.spheroid.inertia_xx / size;
        scene
    }

    /// The averaged motion over any scalar.
    ///
    /// # Errors
    /// A motion that is refused.
    pub fn motion<S: Real>(&self, order: AveragingOrder) -> Result<AveragedSolution<S>, Error> {
        let lift = |v: &Vector3<f64>| v.map(S::from_f64);
        let spheroid = self.spheroid.map(S::from_f64);
        let initial = BodyState {
            axis: lift(&self.initial.axis),
            momentum: lift(&self.initial.momentum),
            equatorial_axis: lift(&self.initial.equatorial_axis),
        };
        AveragedSolution::new(&spheroid, &PrincipalCoefficients::new(lift(&self.s).into()), &initial, order)
    }

    /// True error over estimate of an order, at random times and the end. What the numerical motion may be off does not count.
    ///
    /// # Errors
    /// A motion that is refused.
    pub fn estimate_seen(&self, order: AveragingOrder, seed: u64) -> Result<EstimateSeen, Error> {
        let coefficients = PrincipalCoefficients::new(self.s.into());
        let exact = propagate(&self.spheroid, &coefficients.tensor(), &self.initial, (0.0, self.end), 1e-13)?;
        let mean = AveragedSolution::new(&self.spheroid, &coefficients, &self.initial, order)?;
        let mut random = Random::with_seed(seed);
        let mut seen = EstimateSeen { worst: f64::NEG_INFINITY, at: [f64::NAN; 3] };
        for i in 0..12 {
            let t = if i == 0 { self.end } else { self.end * random.within(0.0, 1.0) };
            let (state, right) = (mean.state(t), exact.state(t)?);
            let error = largest([
                largest_component(&(state.axis - right.axis)),
                largest_component(&(state.equatorial_axis - right.equatorial_axis)),
                largest_component(&(state.momentum - right.momentum)) / right.momentum.norm(),
            ]);
            let estimate = mean.error_estimate(t);
            let ratio = (error - exact.error_estimate(t)).max(0.0) / estimate;
            let ratio = if ratio.is_nan() || error.is_nan() { f64::INFINITY } else { ratio };
            if ratio > seen.worst {
                seen = EstimateSeen { worst: ratio, at: [error, estimate, t] };
            }
        }
        Ok(seen)
    }
}

/// A direction beside the separatrix; none where two principal values are equal.
fn near_separatrix(random: &mut Random, s: &Vector3<f64>) -> Option<Vector3<f64>> {
    let (low, high) = (s.imin(), s.imax());
    let middle = 3_usize.checked_sub(low + high).filter(|middle| *middle != low && *middle != high && low != high)?;
    let (upper, lower) = (s[high] - s[middle], s[middle] - s[low]);
    let along = random.within(-1.0, 1.0);
    let across = (1.0 - along * along).sqrt() / (upper + lower).sqrt();
    let mut l = Vector3::zeros();
    (l[middle], l[high], l[low]) = (along, across * lower.sqrt(), across * upper.sqrt());
    l[low] += from_to(random, 1e-12, 0.3) * if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
    if random.word().is_multiple_of(2) {
        l[high] = -l[high];
    }
    Some(l.normalize())
}
