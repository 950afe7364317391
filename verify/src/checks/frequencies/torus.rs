//! Exact frequencies from the periods of the torus, compared with known ones.

use super::scenes::{SINGLE, Scene, TWOFOLD, sum, worst_off_separatrix};
use crate::mean_rate::{azimuth_of_momentum, mean_rate_of};
use crate::prelude::*;
use twofold::observables::spectrum::QuasiPeriodicMotion;

checks! {
    /// states found from (E, Omega^z, K) of random motions, twofold and single, have these integrals, and one of them lies on the motion's own
    /// torus: it has the same frequencies
    Property "torus-states" [24]: states;
    AtMost(1e-13) "largest of: difference of an integral / its size; difference of a frequency / rotation rate / 10; 60 random motions";
    because "K is met to 1e-13 of its size by construction; the frequencies lose one digit more, as a period divides by the thickness of the torus";
    /// the exact frequencies of the four examples agree with an integration over 20,000 t_c checked in quadruple precision: the mean rates of alpha
    /// and gamma are sums of them
    Oracle "torus-frequencies-examples" [32, 57]: examples;
    AtMost(1e-13) "largest difference beyond half a unit of the reference's last digit [1/t_c]";
    because "rounding of a few periods; the references are given to 1e-11 and 1e-10";
    /// with two equal eigenvalues the exact frequencies are those of the exact solution in elliptic functions: slow and about_axis are alpha' and
    /// gamma' up to whole turns of the nutation, which is about_momentum less the slow one
    Oracle "torus-frequencies-symmetric" [25, 26]: symmetric;
    AtMost(5e-14) "largest difference / rotation rate, 12 random motions of both kinds";
    because "rounding of a period, 1e-15, over the thickness of the torus: the estimated errors of two of these rates add to at most 3.3e-14, and \
     the closed solution is right to some 1e-15";
    /// from states later in the same motion the exact frequencies are the same
    Property "torus-frequencies-same-torus" [25]: same_torus;
    AtMost(1e-12) "largest relative difference; tp-1, tp-2, sp-1, sp-2 and tp-2 with s scaled by 0.3, 0.1";
    because "the state later is right to some 1e-15, and a frequency moves with the integrals by that times the rotation rate: 1.5 over the least \
     frequency, 0.0035, is 430";
    /// the exact frequencies of tp-II are weighted averages over 4,800 and 9,600 t_c of numerical motion
    Oracle "torus-frequencies-averages" [57]: averages;
    AtMost(1e-13) "largest difference, relative, of the slow frequency";
    because "a Kaiser window of shape 30 lets through 60 exp(-30) / sqrt((f T / 2)^2 - 30^2) of an oscillation: 3.4e-14 for twice the slow frequency, \
     f = 0.071, and T = 4,800. The rounding of the exact frequency is estimated to be 2.5e-14 of it";
}

fn states() -> Result<Measured, String> {
    worst_off_separatrix(71, [0.003, 0.03], |scene| {
        let (integrals, exact) = (scene.integrals(), scene.exact()?);
        let found = states_with_integrals(&scene.body, &scene.s, &integrals)?;
        let axis = QuasiPeriodicMotion::new(&scene.problem()?)?.frequencies().pole.iamax();
        if found.round != Some(axis) {
            return Err(format!("L goes round {:?}, not {axis}: {scene:?}", found.round));
        }
        let square = scene.start.momentum.norm_squared();
        let spread = scene.s.xx.abs() + scene.s.yy.abs() + scene.s.zz.abs();
        let (mut off, mut nearest) = (0.0, f64::INFINITY);
        for start in &found.states {
            let state = Scene { start: *start, ..*scene };
            let again = state.integrals();
            let differences = [
                (again.energy - integrals.energy) / integrals.energy,
                (again.spin - integrals.spin) / scene.rotation(),
                (again.clebsch - integrals.clebsch) / (square * spread),
            ];
            off = largest([off, largest(differences.map(f64::abs))]);
            let other = state.exact()?;
            let rates = [other[0].abs() - exact[0].abs(), other[1] - exact[1], other[2] - exact[2]];
            nearest = nearest.min(largest(rates.map(|rate| (rate / scene.rotation()).abs())));
        }
        Ok(largest([off, nearest / 10.0]))
    })
}

fn examples() -> Result<Measured, String> {
    let expected = [
        ("tp-1", TWOFOLD, 1.51237304762, -0.15557827845, None, 1e-11),
        ("tp-2", TWOFOLD, 1.39467831103, -0.14421753117, Some(-0.03546436867), 1e-11),
        ("sp-1", SINGLE, -0.0720704306, 1.0549619690, Some(-0.0720704306), 1e-10),
        ("sp-2", SINGLE, -0.0257600721, 1.0086796666, Some(-0.0257600721), 1e-10),
    ];
    worst_of(expected, |(name, angles, alpha, gamma, slow, digit)| {
        let rates = Scene::example(name, 1.0).exact()?;
        let of_angles = [(sum(rates, angles.alpha), *alpha), (sum(rates, angles.gamma), *gamma)];
        // In tp-1 the mean rate of the azimuth of L is that of alpha.
        let of_momentum = slow.map(|slow| (rates[0], slow));
        worst_of(of_angles.into_iter().chain(of_momentum), |(rate, expected)| {
            let beyond = (rate - expected).abs() - digit / 2.0;
            Ok(if beyond < 0.0 { 0.0 } else { beyond })
        })
    })
}

fn symmetric() -> Result<Measured, String> {
    let mut twofold = false;
    worst_of_draws(72, 12, |random| {
        twofold = !twofold;
        let body = RigidSpheroid::in_units_of_tc(random.within(0.8, 1.3));
        let equatorial = random.within(-0.02, 0.02);
        let sign = if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
        let s = PrincipalCoefficients::new([equatorial, equatorial, equatorial + sign * random.within(0.01, 0.06)]);
        let angles = EulerAngles { alpha: 0.3, beta: random.within(0.6, 0.9), gamma: -1.0 };
        let (alpha, gamma) = if twofold { (1.5, -0.15) } else { (-0.07, 1.1) };
        let rates = EulerRates { alpha, beta: random.within(0.05, 0.1), gamma };
        let closed = SymmetricSolution::new(&body, &s, &angles, &rates)?;
        let scene = Scene { body, s, start: BodyState::from_angles(&body, &angles, &rates) };
        let exact = scene.exact()?;
        let (mean, nutation) = (closed.mean_rates(), TAU / closed.period());
        // The inclination is periodic, so that angles differ by whole turns of the nutation.
        let off = |value: f64, expected: f64| {
            let turns = ((value - expected) / nutation).round();
            (value - expected - turns * nutation).abs()
        };
        let side = scene.start.momentum.z.signum();
        let differences =
            [off(exact[0], mean.alpha), (exact[1] - side * exact[0] - nutation).abs(), off(exact[2], mean.gamma)];
        Ok(largest(differences) / scene.rotation())
    })
}
fn same_torus() -> Result<Measured, String> {
    let scenes = [("tp-1", 1.0), ("tp-2", 1.0), ("sp-1", 1.0), ("sp-2", 1.0), ("tp-2", 0.3), ("tp-2", 0.1)];
    worst_of(scenes, |&(name, k)| {
        let scene = Scene::example(name, k);
        let first = scene.exact()?;
        let motion = scene.problem()?.taylor((0.0, 300.0), 1e-15)?;
        worst_of([7.3, 41.0, 300.0], |&t| {
            let later = Scene { start: motion.state(t)?, ..scene };
            let rates = later.exact()?;
            worst_of(0..3, |&i| Ok((rates[i] / first[i] - 1.0).abs()))
        })
    })
}

fn averages() -> Result<Measured, String> {
    let scene = Scene::example("tp-2", 1.0);
    let exact = scene.exact()?;
    worst_of([4800.0, 9600.0], |&span| {
        let motion = scene.problem()?.taylor((0.0, span), 1e-16)?;
        // In tp-II the azimuth of L has the mean rate of the averaged L.
        let slow = mean_rate_of(&motion, span, (4.0 * span) as usize, azimuth_of_momentum)?;
        Ok((slow / exact[0] - 1.0).abs())
    })
}
