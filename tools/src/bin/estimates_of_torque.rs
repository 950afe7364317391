//! What stretched time states to leave out, beside what it leaves out, in random stars that slow down.
//!
//! `cargo run --release -p twofold-tools --bin estimates_of_torque [STARS] [SEED]`: 100,000 stars of seed 1 unless said. The true lateness is the law itself, integrated by Gauss' formula. A star whose
//! lateness is further off than stated is listed with its number and makes the exit status 1.

use std::f64::consts::{PI, TAU};
use std::process::ExitCode;

use gauss_quad::GaussLegendre;
use rayon::prelude::*;
use twofold::spin_down::{Braking, Precession, StretchedTime};
use twofold_tools::{Ratios, argument, estimate_over_error};
use twofold_verify::random::Random;

/// Most turns of the precession.
const TURNS: f64 = 300.0;

/// Roundings of the lateness, of what it is the difference of and of the phase, below which an error says nothing.
const ROUNDINGS: f64 = 100.0;

/// Ratio of the error stated to the true one, or why there is none.
enum Seen {
    Ratio(f64),
    Refused,
    Rounding,
}

/// A star, and the stretched time at which it is looked at.
struct Star {
    braking: Braking,
    precession: Precession,
    tau: f64,
}

fn main() -> ExitCode {
    let (stars, seed): (u64, u64) = (argument(0, 100_000), argument(1, 1));
    println!("{stars} stars of seed {seed}; error stated / true error of the lateness");
    println!(
        "{:<10} {:>7} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9} {:>9}",
        "star", "judged", "refused", "rounding", "below 1", "least", "1 %", "median", "99 %"
    );
    let rule: Vec<(f64, f64)> =
        GaussLegendre::new(16.try_into().expect("not zero")).iter().map(|(x, w)| (*x, *w)).collect();
    let mut all_above = true;
    for (name, damped) in [("any index", false), ("damped", true)] {
        let seen: Vec<_> = (0..stars)
            .into_par_iter()
            .map(|number| (number, Star::draw(&mut Random::with_seed(seed << 32 | number), damped).look(&rule)))
            .collect();
        let count = |which: fn(&Seen) -> bool| seen.iter().filter(|(_, seen)| which(seen)).count();
        let (refused, rounding) =
            (count(|seen| matches!(seen, Seen::Refused)), count(|seen| matches!(seen, Seen::Rounding)));
        let judged = || {
            seen.iter()
                .filter_map(|(number, seen)| if let Seen::Ratio(ratio) = seen { Some((number, *ratio)) } else { None })
        };
        judged()
            .filter(|(_, ratio)| *ratio < 1.0)
            .take(20)
            .for_each(|(number, ratio)| println!("{name} star {number}: {ratio:.3}"));
        let ratios: Ratios = judged().map(|(_, ratio)| ratio).collect();
        all_above &= ratios.below(1.0) == 0;
        println!(
            "{name:<10} {:>7} {refused:>8} {rounding:>9} {:>8} {:>9.2} {:>9.2} {:>9.1} {:>9.1e}",
            ratios.count(),
            ratios.below(1.0),
            ratios.quantile(0.0),
            ratios.quantile(0.01),
            ratios.quantile(0.5),
            ratios.quantile(0.99)
        );
    }
    if all_above { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn log(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(random.within(low, high))
}

impl Star {
    fn draw(random: &mut Random, damped: bool) -> Self {
        let mut sign = {
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

    fn look(&self, rule: &[(f64, f64)]) -> Seen {
        let Ok(stretched) = StretchedTime::new(&self.braking, &self.precession) else { return Seen::Refused };
        let time = stretched.time_at([self.tau, 0.0]);
        if stretched.stretched_at(time).is_err() {
            return Seen::Refused;
        }
        let (lateness, rounding) = self.lateness(&stretched, rule);
        let stated = stretched.truncation(time[0]);
        if stated < ROUNDINGS * rounding {
            return Seen::Rounding;
        }
        Seen::Ratio(estimate_over_error(stated, (lateness - stretched.late(self.tau)).abs()))
    }

    /// The lateness by the law, and the rounding of both lateness and law.
    ///
    /// `dt/dtau = (1 + (n - 2) kappa (tau + P))^(1 / (n - 2))` less the same without `P`, the integral of the varying torque; for `n = 3` with damping `d^2 t / dtau^2 = kappa (1 - q + q sin^2 theta_m) / (1 - q + q a_0)`.
    fn lateness(&self, stretched: &StretchedTime, rule: &[(f64, f64)]) -> (f64, f64) {
        let Braking { rate: kappa, index, torque_share: q } = self.braking;
        let Precession { wobble, chi, phase, rate: w, damping, .. } = self.precession;
        let harmonics = |theta: f64| {
            let ((sin, cos), (sin_chi, cos_chi)) = (theta.sin_cos(), chi.sin_cos());
            [
                1.0 - (cos * cos_chi).powi(2) - 0.5 * (sin * sin_chi).powi(2),
                -2.0 * sin * cos * sin_chi * cos_chi,
                -0.5 * (sin * sin_chi).powi(2),
            ]
        };
        let [mean, once, twice] = harmonics(wobble);
        let g = q / (1.0 - q + q * mean);
        let panels = (2.0 * w * self.tau.abs() / TAU).ceil().max(8.0);
        let step = self.tau / panels;
        let integral = |function: &mut dyn FnMut(f64) -> f64| -> f64 {
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
            return (integral(&mut |tau| law(tau)), f64::EPSILON * size);
        }
        // psi is w / cos theta_0 times the integral of cos theta, d tau = -d ln(tan theta) / gamma: that of the inverse hyperbolic sine of cot theta, as a difference.
        let cot = |tau: f64| (damping * tau).exp() / wobble.tan();
        let psi = |tau: f64| phase + w / (damping * wobble.cos()) * (cot(tau).asinh() - cot(0.0).asinh());
        let torque = |tau: f64| {
            let theta = (1.0 / cot(tau)).atan();
            let ([here, once, twice], psi) = (harmonics(theta), psi(tau));
            here - mean + once * psi.cos() + twice * (2.0 * psi).cos()
        };
        let begin = 1.0 / stretched.slowing(0.0) - 1.0;
        let late = self.tau * begin + kappa * g * integral(&mut |tau| (self.tau - tau) * torque(tau));
        // The phase is a difference of numbers of the size of (1 + ln cot theta) w / gamma.
        let phases = 1.0 + (w / (damping * wobble.cos())).abs() * (1.0 + cot(0.0).asinh().abs());
        let rounding = size * phases + self.tau.abs() + (kappa * g).abs() * self.tau.powi(2) * wobble.sin().powi(2);
        (late, f64::EPSILON * rounding)
    }
}
