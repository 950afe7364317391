//! The closed formula of the slow precession: compared with the averaged equation, with its limits, and with the motion.

use super::signals::rate;
use crate::mean_rate::{kaiser, mean_rate};
use crate::prelude::*;
use twofold::solutions::averaged::slow_precession::slow_precession;

checks! {
    /// the closed formula is the mean rate of dl/dt = kappa (s l) x l, axis and sense included, for all orders of the eigenvalues, both signs of
    /// kappa and both sides of the separatrix
    Oracle "slow-precession-averaged" [32, 57]: averaged_equation;
    AtMost(1e-8) "largest difference / (|kappa| (s1 - s3)), 24 random cases, Runge-Kutta integration";
    because "step 0.02 in that unit: the phase error of the fourth-order method is 0.02^4 / 120 = 1.3e-9 times powers of the anharmonicity";
    /// with two equal eigenvalues the formula is kappa times their distance from the third times the cosine of the inclination to its axis, and
    /// with three it is zero
    Property "slow-precession-limits" [26, 32]: limits;
    AtMost(16.0) "largest relative error / 2.2e-16";
    because "some fifteen roundings of half an ulp";
    /// a simple expression relates the slow frequency of tp-II to the coefficients: the formula gives it to 5%
    Regime "slow-frequency-formula" [57]: formula_of_tp_2;
    AtMost(0.06) "|formula / measured - 1|, the larger of L and n averaged over the fast rotation and L and n at the start";
    because "the formula is of first order in s, whose largest difference is 0.06";
    /// its relative error is of first order in s, and the slow frequency is proportional to s to that order
    Regime "slow-precession-order" [57]:
        || order_of_error(&[1.0, 0.5, 0.25], |k| slow_frequency(k).map(|[formula, measured]| (formula / measured - 1.0).abs()));
    Within(0.75, 1.4) "order of the relative error in s: tp-II with s scaled by 1, 1/2, 1/4";
    because "one, with corrections of relative order 0.06 k per factor of two";
}

fn averaged_equation() -> Result<Measured, String> {
    let (mut random, mut worst, mut axes) = (Random::with_seed(37), Worst::default(), [0; 3]);
    let permutations = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut case = 0;
    while case < 24 {
        let values = [0.03, random.within(-0.01, 0.015), -0.03];
        let s = PrincipalCoefficients::new(permutations[case % 6].map(|i| values[i]));
        let l = Vector3::from_fn(|_, _| random.within(-1.0, 1.0)).normalize();
        let tensor = s.tensor();
        if (l.dot(&(tensor * l)) - values[1]).abs() < 0.003 {
            continue;
        }
        let (g, c) = (random.within(0.5, 2.0), random.within(-1.0, 1.0));
        let constant_c = random.within(0.5, 2.0) * if case % 2 == 0 { 1.0 } else { -1.0 };
        let inertia_xx = random.within(0.5, 2.0);
        let spheroid = RigidSpheroid { inertia_xx, inertia_zz: 1.1 * inertia_xx, constant_c };
        let across = l.cross(&Vector3::new(0.36, 0.48, 0.8)).normalize();
        let axis = l * c + across * (1.0 - c * c).sqrt();
        let formula = slow_precession(&spheroid, &s, &(l * g), &axis)?;
        let kappa = constant_c * (3.0 * c * c - 1.0) / g;
        let scale = kappa.abs() * 0.06;
        let (step, count) = (0.02 / scale, 12_000);
        let rate = |l: &Vector3<f64>| (tensor * l).cross(l) * kappa;
        let (i, j) = ((formula.axis + 1) % 3, (formula.axis + 2) % 3);
        let (mut at, mut azimuths) = (l, Vec::with_capacity(count));
        for _ in 0..count {
            let azimuth = at[j].atan2(at[i]);
            let last = azimuths.last().copied().unwrap_or(azimuth);
            azimuths.push(azimuth + ((last - azimuth) / std::f64::consts::TAU).round() * std::f64::consts::TAU);
            let a = rate(&at);
            let b = rate(&(at + a * (step / 2.0)));
            let c = rate(&(at + b * (step / 2.0)));
            let d = rate(&(at + c * step));
            at += (a + b * 2.0 + c * 2.0 + d) * (step / 6.0);
        }
        let measured = mean_rate(&azimuths, step);
        axes[formula.axis] += 1;
        worst.see((formula.rate - measured).abs() / scale, || {
            format!("case {case} of seed 37, {s:?}, {formula:?}, measured {:.9}", measured)
        });
        case += 1;
    }
    if axes.contains(&0) {
        return Err(format!("an axis was never gone round: {axes:?}"));
    }
    worst.finish()
}

fn limits() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let mut thirds = (0..3).cycle();
    worst_of_draws(26, 300, |random| {
        let third = thirds.next().unwrap_or_default();
        let (equal, other) = (random.within(-0.1, 0.1), random.within(-0.1, 0.1));
        let l = Vector3::from_fn(|_, _| random.within(-1.0, 1.0)).normalize();
        let n = Vector3::from_fn(|_, _| random.within(-1.0, 1.0)).normalize();
        let momentum = l * random.within(0.5, 2.0);
        let mut values = [equal; 3];
        values[third] = other;
        let found = slow_precession(&spheroid, &PrincipalCoefficients::new(values), &momentum, &n)?;
        let c = n.dot(&momentum) / momentum.norm();
        let size = (3.0 * c * c + 1.0) / momentum.norm() * (equal - other).abs() * l[third].abs();
        let kappa = (3.0 * c * c - 1.0) / momentum.norm();
        // About the third axis: (s l) x l turns by (s3 - s1) l3.
        let expected = kappa * (other - equal) * l[third];
        let right_axis = if found.axis == third { 1.0 } else { f64::INFINITY };
        let error = (found.rate - expected).abs() / (size * f64::EPSILON) * right_axis;
        let isotropic = slow_precession(&spheroid, &PrincipalCoefficients::new([equal; 3]), &momentum, &n)?;
        Ok(largest([error, isotropic.rate.abs() / f64::EPSILON]))
    })
}

/// Slow frequency of tp-II with s scaled by `k`: by the formula, and measured.
fn slow_frequency(k: f64) -> Result<[f64; 2], String> {
    let scene = reference_motion("tp-2");
    let s = scene.coefficients.scaled(k);
    let problem = Problem::new(scene.spheroid, s.tensor(), scene.initial())?;
    let motion = problem.taylor((0.0, 24.0), 1e-12)?;
    let measured = rate(&QuasiPeriodicMotion::new(&problem)?, "l'")?;
    // Averages over 24 t_c, five turns of n about L, of the direction and the size of L.
    let count = 96;
    let weights = kaiser(count, 14.0);
    let (mut direction, mut g) = (Vector3::zeros(), 0.0);
    for (i, weight) in weights.iter().enumerate() {
        let state: BodyState<f64> = motion.state(0.25 * i as f64)?;
        direction += state.momentum * *weight;
        g += state.momentum.norm() * weight / count as f64;
    }
    let l: Vector3<f64> = direction.normalize();
    let c = scene.spheroid.inertia_zz * scene.spin / g;
    let mean = l * g;
    let axis = l * c + l.cross(&Vector3::x()).normalize() * (1.0 - c * c).sqrt();
    let formula = slow_precession(&scene.spheroid, &s, &mean, &axis)?;
    if formula.axis != 2 {
        return Err("the formula has L go round another axis than Z".into());
    }
    Ok([formula.rate, measured])
}

fn formula_of_tp_2() -> Result<Measured, String> {
    let [averaged, measured] = slow_frequency(1.0)?;
    let scene = reference_motion("tp-2");
    let BodyState { axis, momentum, .. } = scene.initial();
    let initial = slow_precession(&scene.spheroid, &scene.coefficients, &momentum, &axis)?.rate;
    let error = largest([averaged, initial].map(|formula| (formula / measured - 1.0).abs()));
    let detail = format!("from averages {averaged:.5}, from initial values {initial:.5}, measured {measured:.8}");
    Ok(Measured::new(error, detail))
}
