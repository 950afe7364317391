//! Fundamental frequencies of motions against reference values, the exact symmetric solution, other frames and other spans.

use twofold::observables::fundamental_frequencies::{FundamentalFrequencies, MeanRate, mean_rates_about};

use super::signals::{AVERAGING, motion_of};
use crate::prelude::*;

checks! {
    /// mean rates of alpha, gamma and the azimuth of L of the four examples equal those of integration over 20,000 t_c with quadruple precision
    /// checks
    Oracle "mean-rates-of-examples" [32, 57]: rates_of_examples;
    AtMost(1e-11) "largest difference beyond half a unit of the reference's last digit [1/t_c]";
    because "averages over 2,400 t_c have converged to the last digits of the references, 1e-11 and 1e-10";
    /// for s^XX = s^YY the mean rates of alpha and gamma, the nutation and the slow precession are those of the exact solution in elliptic
    /// functions: the nutation is 2 pi over the period of the inclination, and alpha' = l' + nu' or l'
    Oracle "mean-rates-symmetric" [25, 32, 57]: symmetric_motions;
    AtMost(1e-11) "largest difference [1/t_c], 6 random motions of both kinds";
    because "averages over 2,400 t_c have converged to some 1e-12, and the exact solution is right to as much";
    /// the same motion in the frames X-Y-Z, Y-Z-X and Z-X-Y has the same frequencies about the same principal axis, also where that is X; about an
    /// axis that L does not go round the slow rate is zero
    Property "mean-rates-of-frame" [36]: frames;
    AtMost(2e-11) "largest difference [1/t_c], tp-II and a motion about the axis of the largest eigenvalue";
    because "two averages over 2,400 t_c, each off by 1e-11 at most as in the checks before";
    /// a mean rate over a shorter span differs from that over 2,400 t_c by no more than its estimated error
    Property "mean-rate-uncertainty" [32, 57]: uncertainties;
    AtMost(1.0) "largest difference / sum of the two estimates, four examples, spans of 800 and 1,400 t_c";
    because "the estimate compares with spans a quarter shorter, whose error is larger while averaging converges";
}

fn known(rate: Option<MeanRate>, what: &str) -> Result<f64, String> {
    rate.map(|rate| rate.value).ok_or_else(|| format!("no mean rate of {what}"))
}

fn rates_of_examples() -> Result<Measured, String> {
    // Rate of alpha, of gamma, of the azimuth of L; unit of the last digit given.
    let expected = [
        ("tp-1", 1.51237304762, -0.15557827845, 1.51237304762, 1e-11),
        ("tp-2", 1.39467831103, -0.14421753117, -0.03546436867, 1e-11),
        ("sp-1", -0.0720704306, 1.0549619690, -0.0720704306, 1e-10),
        ("sp-2", -0.0257600721, 1.0086796666, -0.0257600721, 1e-10),
    ];
    worst_of(expected, |&(name, alpha, gamma, momentum, digit)| {
        let found = fundamental_frequencies(&motion_of(name, AVERAGING)?)?;
        worst_of([(found.alpha, alpha), (found.gamma, gamma), (found.momentum, momentum)], |(rate, expected)| {
            let beyond = (known(*rate, name)? - expected).abs() - digit / 2.0;
            Ok(if beyond < 0.0 { 0.0 } else { beyond })
        })
    })
}

fn symmetric_motions() -> Result<Measured, String> {
    let (mut twofold, mut single) = (0, 0);
    let measured = worst_of_draws(25, 6, |random| {
        let spheroid = RigidSpheroid::in_units_of_tc(random.within(0.8, 1.3));
        let equatorial = random.within(-0.02, 0.02);
        let s = PrincipalCoefficients::new([equatorial, equatorial, equatorial - random.within(0.03, 0.08)]);
        let angles = EulerAngles { alpha: 0.3, beta: random.within(0.6, 0.9), gamma: -1.0 };
        let (alpha, gamma) = if (twofold + single) % 2 == 0 { (1.5, -0.15) } else { (-0.07, 1.1) };
        let rates = EulerRates { alpha, beta: random.within(-0.1, 0.1), gamma };
        let exact = SymmetricSolution::new(&spheroid, &s, &angles, &rates)?;
        let problem = Problem::from_angles(spheroid, s.tensor(), &angles, &rates)?;
        let found = fundamental_frequencies(&problem.taylor((0.0, AVERAGING), 1e-13)?)?;
        let (mean, nutation) = (exact.mean_rates(), TAU / exact.period());
        let (alpha, slow) = (known(found.alpha, "alpha")?, known(found.slow, "L")?);
        // The inclination repeats, so alpha, L and the axes differ by whole turns of the nutation.
        let fast = (alpha - slow).abs() > 0.5;
        *(if fast { &mut twofold } else { &mut single }) += 1;
        let differences = [
            alpha - mean.alpha,
            known(found.gamma, "gamma")? - mean.gamma,
            known(found.nutation, "n round L")? - nutation,
            slow - (mean.alpha - if fast { nutation } else { 0.0 }),
        ];
        Ok(largest(differences.map(f64::abs)))
    });
    if twofold == 0 || single == 0 {
        return Err(format!("{twofold} twofold and {single} single motions: both are needed"));
    }
    measured
}

fn frames() -> Result<Measured, String> {
    let permuted = permuted_from_inertial::<f64>();
    worst_of(["tp-2", "retrograde"], |name| {
        let mut turn = Matrix3::identity();
        let mut first: Option<FundamentalFrequencies> = None;
        let over_frames = worst_of(0..3, |_| {
            let turned = reference_motion(name).problem().rotated(&turn);
            let found = fundamental_frequencies(&turned.taylor((0.0, AVERAGING), 1e-13)?)?;
            let axis = found.frame.row(2).transpose();
            let reference = *first.get_or_insert(found);
            let differences = [
                known(found.alpha, "alpha")? - known(reference.alpha, "alpha")?,
                known(found.gamma, "gamma")? - known(reference.gamma, "gamma")?,
                known(found.slow, "L")? - known(reference.slow, "L")?,
                known(found.nutation, "n")? - known(reference.nutation, "n")?,
                (turn.transpose() * axis - reference.frame.row(2).transpose()).norm(),
            ];
            turn = permuted * turn;
            Ok(largest(differences.map(f64::abs)))
        })?;
        // About the next axis, which L does not go round.
        let frame = first.map_or(Matrix3::identity(), |first| permuted * first.frame);
        let about_another = mean_rates_about(&motion_of(name, AVERAGING)?, &frame)?;
        Ok(largest([over_frames.figure, known(about_another.slow, "L")?.abs()]))
    })
}

fn uncertainties() -> Result<Measured, String> {
    let mut spans = 0;
    let measured = worst_of(["tp-1", "tp-2", "sp-1", "sp-2"], |name| {
        let over = |span| motion_of(name, span).and_then(|motion| fundamental_frequencies(&motion));
        let long = over(AVERAGING)?;
        // A span that is too short is refused, which is right as well.
        let shorter: Vec<_> = [800.0, 1400.0].into_iter().filter_map(|span| over(span).ok()).collect();
        spans += shorter.len();
        largest_if_any(shorter.iter().flat_map(|short| {
            let of_short = [short.alpha, short.gamma, short.slow, short.nutation];
            let pairs = of_short.into_iter().zip([long.alpha, long.gamma, long.slow, long.nutation]);
            pairs
                .filter_map(|(short, long)| short.zip(long))
                .map(|(short, long)| Ok((short.value - long.value).abs() / (short.uncertainty + long.uncertainty)))
        }))
    });
    if spans < 5 { Err(format!("only {spans} shorter spans gave rates")) } else { measured }
}
