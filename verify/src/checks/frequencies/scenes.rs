//! Motions whose frequencies are compared.

use crate::prelude::*;
use twofold::observables::spectrum::QuasiPeriodicMotion;

/// A motion in the principal frame of `s^IJ`.
#[derive(Debug, Clone, Copy)]
pub(in crate::checks) struct Scene {
    pub(super) body: RigidSpheroid<f64>,
    pub(super) s: PrincipalCoefficients<f64>,
    pub(super) start: BodyState<f64>,
}

impl Scene {
    pub(super) fn example(name: &str, k: f64) -> Self {
        let scene = reference_motion(name);
        Self { body: scene.spheroid, s: scene.coefficients.scaled(k), start: scene.initial() }
    }

    pub(in crate::checks) fn problem(&self) -> Result<Problem<f64>, Error> {
        Problem::new(self.body, self.s.tensor(), self.start)
    }

    /// Exact rates with the names of the averaged ones: `slow`, `about_momentum`, `about_axis`.
    pub(super) fn exact(&self) -> Result<[f64; 3], String> {
        let motion = QuasiPeriodicMotion::new(&self.problem()?)?;
        let found = motion.frequencies();
        let rate = |symbol: &str| found.rate(symbol).ok_or(format!("the motion has no {symbol}: {self:?}"));
        let slow = rate("l'")?;
        // The nutation counts from the plane of L and the axis, which turns with L.
        let end = self.start.momentum.dot(&found.pole).signum();
        Ok([slow, rate("nu'")? + end * slow, rate("psi'")?])
    }

    /// Rates of the averaged motion with the names and signs of the exact ones.
    pub(super) fn averaged(&self, order: AveragingOrder) -> Result<[f64; 3], String> {
        let averaged = AveragedSolution::new(&self.problem()?, order)?;
        let rates = averaged.rates();
        Ok([rates.slow.abs(), rates.about_momentum, rates.about_axis])
    }

    pub(super) fn integrals(&self) -> FirstIntegrals<f64> {
        first_integrals(&self.body, &self.s.tensor(), &self.start)
    }

    pub(super) fn rotation(&self) -> f64 {
        self.start.momentum.norm() / self.body.inertia_xx
    }

    /// A motion with a torque of strength `strength` to three times that. Every fourth is single precession.
    pub(in crate::checks) fn random(random: &mut Random, case: usize, strength: f64) -> Self {
        let mut body = RigidSpheroid::in_units_of_tc(random.within(0.6, 1.6));
        body.inertia_xx = random.within(0.5, 2.0);
        body.inertia_zz *= body.inertia_xx;
        body.constant_c = random.within(0.5, 2.0);
        let mut direction = || Vector3::from_fn(|_, _| random.within(-1.0, 1.0)).normalize();
        let (l, other) = (direction(), direction());
        let n = if case.is_multiple_of(4) { (l + other * 0.05).normalize() } else { other };
        let momentum = l * random.within(0.5, 3.0);
        let values = [1.0, random.within(-0.7, 0.7), -1.0];
        let at = case % 3;
        let values = [values[at], values[(at + 1) % 3], values[(at + 2) % 3]];
        let scale =
            strength * random.within(1.0, 3.0) * momentum.norm_squared() / (2.0 * body.constant_c * body.inertia_xx);
        let equatorial_axis = n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let s = PrincipalCoefficients::new(values).scaled(scale);
        Self { body, s, start: BodyState { axis: n, momentum, equatorial_axis } }
    }

    /// Distance from the separatrix: `k'^2` from the initial direction `l`.
    pub(in crate::checks) fn complement(&self) -> f64 {
        let l = self.start.momentum.normalize();
        let mut order = [0, 1, 2];
        let values = [self.s.xx, self.s.yy, self.s.zz];
        order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
        let [s1, s2, s3] = order.map(|i| values[i]);
        let [a, _, c] = order.map(|i| l[i] * l[i]);
        let below = (s2 - s3) * c - (s1 - s2) * a;
        let h = s2 - below;
        let p_squared = if below > 0.0 { (s2 - s3) * (s1 - h) } else { (s1 - s2) * (h - s3) };
        (s1 - s3) * below.abs() / p_squared
    }
}

/// The largest figure of 60 random motions with alternating strengths of the torque, except those near the separatrix.
pub(super) fn worst_off_separatrix(
    seed: u64,
    strengths: [f64; 2],
    figure: impl FnMut(&Scene) -> Result<f64, String>,
) -> Result<Measured, String> {
    let mut random = Random::with_seed(seed);
    let scenes = (0..60).map(|case| Scene::random(&mut random, case, strengths[case % 2]));
    let scenes: Vec<_> = scenes.filter(|scene| scene.complement() >= 0.05).collect();
    if scenes.len() < 40 {
        return Err(format!("only {} of 60 motions are away from the separatrix", scenes.len()));
    }
    worst_of(scenes, figure)
}

/// The mean rates of alpha and gamma as combinations of `slow`, `about_momentum` and `about_axis`.
#[derive(Debug)]
pub(super) struct Angles {
    pub(super) alpha: [f64; 3],
    pub(super) gamma: [f64; 3],
}

/// Twofold precession.
pub(super) const TWOFOLD: Angles = Angles { alpha: [0.0, 1.0, 0.0], gamma: [0.0, 0.0, 1.0] };

/// Single precession.
pub(super) const SINGLE: Angles = Angles { alpha: [1.0, 0.0, 0.0], gamma: [-1.0, 1.0, 1.0] };

pub(super) fn sum(rates: [f64; 3], multiples: [f64; 3]) -> f64 {
    rates.iter().zip(multiples).map(|(rate, multiple)| rate * multiple).sum()
}
