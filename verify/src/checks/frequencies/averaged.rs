//! Frequencies of the averaged motion compared with the exact ones.

use super::scenes::{Scene, TWOFOLD, sum, worst_off_separatrix};
use crate::prelude::*;

checks! {
    /// the slow frequency of tp-II, 0.03546436867 / t_c, follows from the averaged motion of first order to 5 %
    Regime "mean-frequency-first" [57]: || slow_frequency(AveragingOrder::First, 1.0);
    AtMost(0.05) "relative error";
    because "of first order in the strength of the torque, 0.024, with a coefficient of order one";
    /// the slow frequency of tp-II follows from the averaged motion of second order to 0.5 %
    Regime "mean-frequency-second" [57]: || slow_frequency(AveragingOrder::Second, 1.0);
    AtMost(0.005) "relative error";
    because "of second order in the strength of the torque, 0.024^2, with coefficients of order one to ten";
    /// the relative errors of the slow frequency by the first and the second order fall with the first and the second power of s
    Regime "mean-frequency-slopes" [57]: slopes;
    AtMost(0.05) "largest |measured slope - order|, tp-II with s scaled by 0.1 to 1e-3";
    because "corrections of relative order k";
    /// all three rates of second order are right to the third power of the strength of the torque, for random motions of both kinds, on both sides
    /// of the separatrix
    Regime "mean-frequency-random" [57]: random_rates;
    AtMost(15.0) "largest |mean - exact| / (x^3 G / I^xx), x = C (s_max - s_min) I^xx / G^2 from 0.001 to 0.02, 60 random motions with k'^2 above \
     0.05";
    because "coefficients of order one, over the distance from the separatrix";
    /// the lines that the paper marks at the free values 1.438 and 0.1 are at alpha' and gamma' of the averaged motion to second order
    Regime "mean-lines-of-examples" [57]: lines;
    AtMost(0.01) "largest |formula - exact| / |free value - exact|, alpha' and gamma' of tp-I and tp-II";
    because "third order against first, at a strength of 0.03";
}

fn error_of_slow(order: AveragingOrder, k: f64) -> Result<(f64, f64, f64), String> {
    let scene = Scene::example("tp-2", k);
    let (exact, mean) = (scene.exact()?[0].abs(), scene.averaged(order)?[0]);
    Ok(((mean / exact - 1.0).abs(), mean, exact))
}

fn slow_frequency(order: AveragingOrder, k: f64) -> Result<Measured, String> {
    let (error, averaged, exact) = error_of_slow(order, k)?;
    Ok(Measured::new(error, format!("averaged {averaged:.8}, exact {exact:.14}")))
}

fn slopes() -> Result<Measured, String> {
    let errors = |order| errors_at([0.1, 0.03, 0.01, 3e-3, 1e-3], |k| error_of_slow(order, k).map(|(error, ..)| error));
    largest_off_order([
        ("first", 1.0, errors(AveragingOrder::First)?),
        ("second", 2.0, errors(AveragingOrder::Second)?),
    ])
}

fn random_rates() -> Result<Measured, String> {
    worst_off_separatrix(73, [0.001, 0.007], |scene| {
        let exact = scene.exact()?;
        let averaged = scene.averaged(AveragingOrder::Second)?;
        let x = AveragedSolution::new(&scene.problem()?, AveragingOrder::Second)?.relative_strength();
        let differences = [averaged[0] - exact[0].abs(), averaged[1] - exact[1], averaged[2] - exact[2]];
        Ok(largest(differences.map(f64::abs)) / (x.powi(3) * scene.rotation()))
    })
}

fn lines() -> Result<Measured, String> {
    worst_of(["tp-1", "tp-2"], |name| {
        let scene = Scene::example(name, 1.0);
        let exact = scene.exact()?;
        let mean = scene.averaged(AveragingOrder::Second)?;
        worst_of([(TWOFOLD.alpha, 1.1 / f64::cos(0.7)), (TWOFOLD.gamma, -0.1)], |&(multiples, free)| {
            let (exact, mean) = (sum(exact, multiples), sum(mean, multiples));
            Ok(Measured::new(
                (mean - exact).abs() / (free - exact).abs(),
                format!("exact {exact:.9}, formula {mean:.9}, free {free:.4}"),
            ))
        })
    })
}
