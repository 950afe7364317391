//! Random stars that slow down: the stated error of their stretched time compared with the true one.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use twofold::spin_down::{Braking, Precession, StretchedTime};

use crate::prelude::*;

/// Largest number of precession turns.
const TURNS: f64 = 300.0;

/// The comparison needs a stated error of at least this many roundings of the delay, of its terms and of the phase.
const ROUNDINGS: f64 = 100.0;

/// A star and a stretched time.
#[derive(Debug, Clone, Copy)]
pub struct BrakedStar {
    /// Its torque.
    pub braking: Braking,
    /// Its precession.
    pub precession: Precession,
    /// The stretched time.
    pub tau: f64,
}

impl BrakedStar {
    /// Star `number` drawn from `seed`: with any braking index, or with a damped wobble and the index 3.
    pub fn draw(seed: u64, number: u64, damped: bool) -> Self {
        let random = &mut Random::with_seed(seed << 32 | number);
        let log = |random: &mut Random, low: f64, high: f64| 10f64.powf(random.within(low, high));
        let sign = {
            let word = random.word();
            move |bit: u32| if word >> bit & 1 == 0 { 1.0 } else { -1.0 }
        };
        let rate = log(random, -1.0, 1.0);
        let kappa = rate * log(random, -6.0, -1.5) * sign(0);
        let index = if damped { 3.0 } else { random.within(-2.0, 9.0) };
        let gamma = if damped { rate * log(random, -3.0, -1.0) * sign(1) } else { 0.0 };
        let small = log(random, -4.0, 0.0);
        let wobble = if random.word().is_multiple_of(3) { small } else { random.within(0.0, PI / 2.0) };
        let [chi, phase] = [random.within(0.0, PI), random.within(0.0, TAU)];
        let torque_share = if random.word().is_multiple_of(4) { 1.0 } else { random.within(0.0, 1.0) };
        let most = (0.1 / (kappa.abs() * (index - 2.0).abs().max(1.0))).min(TURNS * TAU / rate);
        let most = if damped { most.min(2.0 / gamma.abs()) } else { most };
        let tau = 0.99 * most * log(random, -2.0, 0.0) * sign(2);
        let precession = Precession::new([wobble, chi, phase], rate, gamma);
        Self { braking: Braking { rate: kappa, index, torque_share }, precession, tau }
    }

    /// Error stated by [`StretchedTime::truncation`] over the true error of the delay; `None` if the stated error is not above rounding.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn stated_over_true(&self) -> Result<Option<f64>, String> {
        let stretched = StretchedTime::new(&self.braking, &self.precession)?;
        let time = stretched.time_at([self.tau, 0.0]);
        stretched.stretched_at(time)?;
        let (delay, rounding) = self.delay(&stretched);
        let stated = stretched.truncation(time[0]);
        Ok((stated >= ROUNDINGS * rounding).then(|| stated / (delay - stretched.delay(self.tau)).abs()))
    }

    /// The delay from the braking law, and the rounding of both delay and law.
    ///
    /// The integral of `dt/dtau = (1 + (n - 2) kappa (tau + P))^(1 / (n - 2))` minus the same without `P`, the integral of the varying torque; for
    /// `n = 3` with damping `d^2 t / dtau^2 = kappa (1 - q + q sin^2 theta_m) / (1 - q + q a_0)`.
    fn delay(&self, stretched: &StretchedTime) -> (f64, f64) {
        let Braking { rate: kappa, index, torque_share: q } = self.braking;
        let Precession { wobble, chi, phase, rate: w, damping, .. } = self.precession;
        let harmonics = |theta: f64| {
            let ((sin, cos), (sin_chi, cos_chi)) = (theta.sin_cos(), chi.sin_cos());
            [
                sin * sin * (1.0 - 0.5 * sin_chi * sin_chi) + (cos * sin_chi).powi(2),
                -2.0 * sin * cos * sin_chi * cos_chi,
                -0.5 * (sin * sin_chi).powi(2),
            ]
        };
        let [mean, once, twice] = harmonics(wobble);
        let g = q / (1.0 - q + q * mean);
        // Two per turn at the fastest rate of psi, which grows as cos theta.
        let fastest = w * (self.precession.wobble_at(self.tau).cos() / wobble.cos()).max(1.0);
        let panels = (2.0 * fastest * self.tau.abs() / TAU).ceil().max(8.0);
        let step = self.tau / panels;
        let rule = GaussLegendre::new(const { NonZeroUsize::new(16).unwrap() });
        let integral = |function: &dyn Fn(f64) -> f64| -> f64 {
            (0..panels as u32)
                .flat_map(|panel| {
                    rule.iter().map(move |(x, weight)| ((f64::from(panel) + 0.5 + 0.5 * x) * step, 0.5 * weight * step))
                })
                .map(|(tau, weight)| weight * function(tau))
                .sum()
        };
        let size = (kappa * g).abs() * (once.abs() + twice.abs()) * (1.0 / w + self.tau.abs()) / w;
        if damping == 0.0 {
            let y = index - 2.0;
            let law = |tau: f64| {
                let psi = phase + w * tau;
                let varying = g * (once * psi.sin() + twice * (2.0 * psi).sin() / 2.0) / w;
                let secular = 1.0 + y * kappa * tau;
                secular.powf(1.0 / y) * ((y * kappa * varying / secular).ln_1p() / y).exp_m1()
            };
            return (integral(&|tau| law(tau)), f64::EPSILON * size);
        }
        // psi is w / cos theta_0 times the integral of cos theta. With d tau = -d ln(tan theta) / gamma it is a difference of asinh(cot theta).
        let cot = |tau: f64| (damping * tau).exp() / wobble.tan();
        let psi = |tau: f64| phase + w / (damping * wobble.cos()) * (cot(tau).asinh() - cot(0.0).asinh());
        let torque = |tau: f64| {
            let theta = (1.0 / cot(tau)).atan();
            let ([here, once, twice], psi) = (harmonics(theta), psi(tau));
            here - mean + once * psi.cos() + twice * (2.0 * psi).cos()
        };
        let begin = 1.0 / stretched.slowing(0.0) - 1.0;
        let late = self.tau * begin + kappa * g * integral(&|tau| (self.tau - tau) * torque(tau));
        // The phase is a difference of numbers of the size of (1 + ln cot theta) w / gamma.
        let phases = 1.0 + (w / (damping * wobble.cos())).abs() * (1.0 + cot(0.0).asinh().abs());
        let rounding = size * phases + self.tau.abs() + (kappa * g).abs() * self.tau.powi(2) * wobble.sin().powi(2);
        (late, f64::EPSILON * rounding)
    }
}
