//! Mean rates of the precession angle and of the angular momentum, with their signs, for both kinds of precession.

use crate::mean_rate::{azimuth_of_momentum, mean_rate_of};
use crate::prelude::*;

checks! {
    /// forced precession turns the angular momentum in the same sense for both kinds; the shift of the rate of alpha in tp-I, a change of its free
    /// precession, is opposite
    Regime "forced-precession-direction" [32, 57]: directions;
    AtMost(0.0) "signs that differ from: tp-I alpha +, tp-II azimuth of L -, sp-I azimuth of L -, sp-I alpha -";
    because "signs of numbers that are above 0.02 in size";
    /// the ratio of the mean rates |gamma'| / alpha' is the same in tp-I and tp-II: it does not determine where Eqs. (51), (56) apply
    Regime "rates-of-both-examples" [51, 56, 57]: ratios_of_rates;
    AtMost(0.05) "|ratio of tp-II / ratio of tp-I - 1|";
    because "a twentieth of the ratio, which is said to be small in one and not in the other";
    /// the angular momentum precesses about Z at (2 C P2(c) / G) (s^ZZ - s^XX) l_Z with c = n.L/G: its sign reverses where c^2 crosses 1/3
    Regime "momentum-precession-rate" [26, 32]: momentum_rate_across_magic_angle;
    AtMost(0.1) "largest |rate - formula| / (|2 C (s^ZZ - s^XX) / G| k), c^2 from 0.05 to 1, symmetric s scaled by k";
    because "the formula is of first order: with s^ZZ - s^XX = -0.055 k its relative error is of the order 0.055 k";
}

/// Mean rates of `alpha`, of `gamma` and of the azimuth of `L` about Z.
fn mean_rates(name: &str) -> Result<[f64; 3], String> {
    let problem = reference_motion(name).problem();
    let exact = QuasiPeriodicMotion::new(&problem)?;
    let rate = |symbol| exact.frequencies().rate(symbol).ok_or_else(|| format!("{name} has no {symbol}"));
    let motion = problem.taylor((0.0, 2000.0), 1e-13)?;
    Ok([rate("alpha'")?, rate("gamma'")?, mean_rate_of(&motion, 2000.0, 8000, azimuth_of_momentum)?])
}

fn directions() -> Result<Measured, String> {
    let shift = mean_rates("tp-1")?[0] - 1.1 / 0.7f64.cos();
    let [_, _, twofold] = mean_rates("tp-2")?;
    let [alpha, _, single] = mean_rates("sp-1")?;
    let wrong = [shift < 0.02, twofold > -0.02, single > -0.02, alpha > -0.02];
    Ok(Measured::new(
        wrong.iter().filter(|w| **w).count() as f64,
        format!("tp-I alpha shift {shift:.4}, tp-II L {twofold:.4}, sp-I L {single:.4}, sp-I alpha {alpha:.4}"),
    ))
}

fn ratios_of_rates() -> Result<Measured, String> {
    let ratio = |name| mean_rates(name).map(|[alpha, gamma, _]| gamma.abs() / alpha);
    let (first, second) = (ratio("tp-1")?, ratio("tp-2")?);
    Ok(Measured::new((second / first - 1.0).abs(), format!("tp-I {first:.4}, tp-II {second:.4}")))
}

fn momentum_rate_across_magic_angle() -> Result<Measured, String> {
    let k = 0.1;
    let s = PrincipalCoefficients::new([0.015, 0.015, -0.04]).scaled(k);
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let (g, tilt) = (1.4, 0.6_f64);
    let l = Vector3::new(tilt.sin(), 0.0, tilt.cos());
    let across = Vector3::new(tilt.cos(), 0.0, -tilt.sin());
    worst_of([0.05, 0.15, 0.25, 1.0 / 3.0, 0.4, 0.5, 0.7, 0.9, 1.0], |&c2| {
        let c = f64::sqrt(c2);
        let axis = l * c + across * (1.0 - c2).sqrt();
        let initial = BodyState { axis, momentum: l * g, equatorial_axis: Vector3::y() };
        let duration = 4000.0;
        let motion = Problem::new(spheroid, s.tensor(), initial)?.taylor((0.0, duration), 1e-12)?;
        let rate = mean_rate_of(&motion, duration, 20_000, azimuth_of_momentum)?;
        let size = 2.0 * (s.zz - s.xx) / g;
        let formula = size * (1.5 * c2 - 0.5) * l.z;
        if c2 < 0.3 && rate * size > 0.0 || c2 > 0.36 && rate * size < 0.0 {
            return Err(format!("wrong sign of the rate {rate:e} at c^2 = {c2}"));
        }
        Ok(Measured::new((rate - formula).abs() / (size.abs() * k), format!("rate {rate:.6e}, formula {formula:.6e}")))
    })
}
