//! Fundamental frequencies of motions: compared with reference values, the exact symmetric solution and averages of numerical motions, and in
//! other frames.

use super::signals::rate;
use crate::mean_rate::{azimuth_of_momentum, mean_rate_of};
use crate::prelude::*;
use twofold::propagation::ContinuousAngles;

checks! {
    /// alpha', gamma' and the slow frequency of the four examples equal the mean rates of alpha, gamma and the azimuth of L from an integration over
    /// 20,000 t_c, checked in quadruple precision
    Oracle "mean-rates-of-examples" [32, 57]: rates_of_examples;
    AtMost(1e-14) "largest difference beyond half a unit of the reference's last digit [1/t_c]";
    because "the references are given to 1e-11 and 1e-10; the frequencies are right to rounding";
    /// for s^XX = s^YY the mean rates of alpha and gamma, the nutation and the slow precession are those of the exact solution in elliptic
    /// functions: the nutation is 2 pi over the period of the inclination, and alpha' = l' + nu' or l'
    Oracle "mean-rates-symmetric" [25, 32, 57]: symmetric_motions;
    AtMost(5e-14) "largest difference [1/t_c], 24 random motions of both kinds, s and rates with either sign";
    because "the closed solution is right to some 1e-15, over the thickness of the torus, as for torus-frequencies-symmetric";
    /// the same motion in the frames X-Y-Z, Y-Z-X and Z-X-Y and in two that are turned by any angles has the same frequencies about the same
    /// principal axis, also if that is X
    Property "mean-rates-of-frame" [36]: frames;
    AtMost(2e-14) "largest difference [1/t_c], tp-II and a motion about the axis of the largest eigenvalue";
    because "the initial state is rounded in each frame, and the frequencies change as much";
    /// alpha', gamma' and l' are the mean rates of the Euler angles and of the azimuth of L, counted turn by turn in the numerical motion
    Oracle "mean-rates-averages" [32, 57]: averages;
    AtMost(1e-13) "largest difference of a weighted average over 2,400 t_c [1/t_c], four examples";
    because "a Kaiser window of shape 30 lets through less than 1e-12 of an oscillation of the rate, some 0.01, once the span is 60 over its frequency: \
     1e-14, and as much by rounding";
}

fn exact(problem: &Problem<f64>) -> Result<QuasiPeriodicMotion, String> {
    Ok(QuasiPeriodicMotion::new(problem)?)
}

fn rates_of_examples() -> Result<Measured, String> {
    // Rates of alpha, gamma and the azimuth of L; unit of the last given digit. In tp-I the azimuth of L has the mean rate of alpha.
    let expected = [
        ("tp-1", 1.51237304762, -0.15557827845, None, 1e-11),
        ("tp-2", 1.39467831103, -0.14421753117, Some(-0.03546436867), 1e-11),
        ("sp-1", -0.0720704306, 1.0549619690, Some(-0.0720704306), 1e-10),
        ("sp-2", -0.0257600721, 1.0086796666, Some(-0.0257600721), 1e-10),
    ];
    worst_of(expected, |&(name, alpha, gamma, slow, digit)| {
        let motion = exact(&reference_motion(name).problem())?;
        let pairs = [("alpha'", Some(alpha)), ("gamma'", Some(gamma)), ("l'", slow)];
        worst_of(
            pairs.into_iter().filter_map(|(symbol, rate)| rate.map(|rate| (symbol, rate))),
            |&(symbol, expected)| {
                let beyond = (rate(&motion, symbol)? - expected).abs() - digit / 2.0;
                Ok(if beyond < 0.0 { 0.0 } else { beyond })
            },
        )
    })
}

fn symmetric_motions() -> Result<Measured, String> {
    let mut fast = false;
    worst_of_draws(25, 24, |random| {
        fast = !fast;
        let mut sign = || if random.word().is_multiple_of(2) { 1.0 } else { -1.0 };
        let [of_s, of_alpha, of_beta, of_gamma] = [(); 4].map(|()| sign());
        let spheroid = RigidSpheroid::in_units_of_tc(random.within(0.8, 1.3));
        let equatorial = random.within(-0.02, 0.02);
        let s = PrincipalCoefficients::new([equatorial, equatorial, equatorial + of_s * random.within(0.03, 0.08)]);
        let angles = EulerAngles { alpha: 0.3, beta: FRAC_PI_2 + of_beta * random.within(0.6, 0.9), gamma: -1.0 };
        let (alpha, gamma) = if fast { (1.5, -0.15) } else { (-0.07, 1.1) };
        let rates = EulerRates { alpha: of_alpha * alpha, beta: random.within(-0.1, 0.1), gamma: of_gamma * gamma };
        let closed = SymmetricSolution::new(&spheroid, &s, &angles, &rates)?;
        let problem = Problem::from_angles(spheroid, s.tensor(), &angles, &rates)?;
        let found = exact(&problem)?;
        let (mean, nutation) = (closed.mean_rates(), TAU / closed.period());
        // Turning fast about Z, the star turns once more than L in each nutation, in the sense of L.
        let slow = mean.alpha - if fast { problem.initial().momentum.z.signum() * nutation } else { 0.0 };
        let pairs = [("alpha'", mean.alpha), ("gamma'", mean.gamma), ("nu'", nutation), ("l'", slow)];
        worst_of(pairs, |&(symbol, expected)| Ok((rate(&found, symbol)? - expected).abs()))
    })
}

fn frames() -> Result<Measured, String> {
    let permuted = permuted_from_inertial::<f64>();
    let any =
        [[0.3, -1.2, 2.0], [-2.5, 0.7, -0.4]].map(|[roll, pitch, yaw]| Rotation3::from_euler_angles(roll, pitch, yaw));
    let turns = [Matrix3::identity(), permuted, permuted * permuted, any[0].into_inner(), any[1].into_inner()];
    worst_of(["tp-2", "retrograde"], |name| {
        let problem = reference_motion(name).problem();
        let reference = exact(&problem)?;
        worst_of(turns, |turn| {
            let found = exact(&problem.rotated(turn))?;
            let pole = turn.transpose() * found.frequencies().pole;
            // The pole is an axis, directed by its largest component in the frame.
            let side = pole.dot(&reference.frequencies().pole).signum();
            let differences = worst_of(["alpha'", "gamma'", "l'", "nu'", "psi'"], |&symbol| {
                let sign = if ["alpha'", "l'"].contains(&symbol) { side } else { 1.0 };
                Ok((rate(&found, symbol)? * sign - rate(&reference, symbol)?).abs())
            });
            Ok(largest([differences?.figure, (pole * side - reference.frequencies().pole).norm()]))
        })
    })
}

fn averages() -> Result<Measured, String> {
    const DURATION: f64 = 2400.0;
    worst_of(["tp-1", "tp-2", "sp-1", "sp-2"], |&name| {
        let problem = reference_motion(name).problem();
        let (motion, found) = (problem.taylor((0.0, DURATION), 1e-13)?, exact(&problem)?);
        let mut angles = ContinuousAngles::new(&motion, 0.0, &motion.state(0.0)?.angles()?)?;
        let (step, count) = (DURATION / 9600.0, 9600);
        let (mut alphas, mut gammas) = (Vec::new(), Vec::new());
        for i in 0..=count {
            let at = angles.at((step * f64::from(i)).min(DURATION))?;
            alphas.push(at.alpha);
            gammas.push(at.gamma);
        }
        // In tp-1 the azimuth of L has the mean rate of alpha.
        let slow = if name == "tp-1" { "alpha'" } else { "l'" };
        let momentum = mean_rate_of(&motion, DURATION, 9600, azimuth_of_momentum)?;
        let mean = |angles: &[f64]| crate::mean_rate::mean_rate(angles, step);
        let pairs = [("alpha'", mean(&alphas)), ("gamma'", mean(&gammas)), (slow, momentum)];
        worst_of(pairs, |&(symbol, average)| Ok((rate(&found, symbol)? - average).abs()))
    })
}
