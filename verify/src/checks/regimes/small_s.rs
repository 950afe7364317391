//! The paper's statements about precession at the small `s` of real stars over years, from the averaged motion where integration is not
//! feasible.

use twofold::units::JULIAN_YEAR;

use super::perturbation_error::{Case, axis_at};
use crate::prelude::*;

checks! {
    /// for beta_0 up to 1 the single-precession solution follows the motion through one forced period at s of 1e-6 to 1e-14 too, 1e12 turns
    Regime "small-s-single" [33, 34]: || {
        worst_of(single(&[0.1, 0.3, 0.5, 0.7, 0.9, 1.0]), |case| case.axis_error_over_forced_period(1000))
    };
    AtMost(1.0 / 3.0) "largest distance of the heads of the true and the approximate axis over one forced period, beta_0 = 0.1 to 1";
    because "as for the examples: within a third of the unit sphere's radius";
    /// the single-precession solution fails towards beta_0 = pi/2 as it does for the examples
    Regime "small-s-single-right-angle" [33, 34]:
        || least_of(single(&[1.4, 1.5]), |case| case.axis_error_over_forced_period(1000));
    AtLeast(1.0) "smallest distance reached over one forced period, beta_0 = 1.4 and 1.5";
    because "as for the examples: more than the unit sphere's radius";
    /// the twofold solution, even the corrected one, keeps the direction of L fixed: half a turn of its slow precession later L is on the other
    /// side of Z, however small s is
    Regime "small-s-twofold" [30, 33]: twofold;
    Within(1.5, 2.1) "smallest distance of the directions of L (the axis averaged over a fast rotation) over its tilt A / a, half a slow turn later, s \
     scaled by 1e-5, 1e-7, 1e-9";
    because "twice the tilt, less where the turn is an ellipse";
    /// over 15 years of a millisecond pulsar with s of 1e-16 to 1e-12 the estimate (40), from the root mean square change of cos lambda over
    /// observers, gives sin(beta_0) / sqrt(3) of the combination of s
    Regime "small-s-drift" [40, 41]: drift;
    AtMost(1e-5) "largest |estimate / (combination sin(beta_0) / sqrt 3) - 1|, 40 random stars, oblateness up to 0.1, beta_0 from 0.2 to 1.1";
    because "a chord of an angle of at most 1e-2 rad is shorter by its square over 24, 4e-6; rounding is 1e-15 of 1e-6 rad";
}

/// The examples' single precession, with `s` scaled down.
fn single(inclinations: &[f64]) -> impl Iterator<Item = Case> {
    let cases =
        |k| inclinations.iter().map(move |&beta_0| Case::paper(Form::Printed, Precession::Single, k, beta_0, 0.0));
    [1e-4, 1e-8, 1e-12].into_iter().flat_map(cases)
}

fn twofold() -> Result<Measured, String> {
    let (beta_0, amplitude) = (0.7_f64, 0.01);
    least_of([1e-5, 1e-7, 1e-9], |&k| {
        let case = Case::paper(Form::Corrected, Precession::Twofold, k, beta_0, amplitude);
        let solution = case.solution()?;
        let half_turn = PI / case.averaged_motion(0.0)?.mean.rates().slow.abs();
        let motion = case.averaged_motion(half_turn)?;
        // The axes averaged over the last fast rotation lie along L. The fast phase, which A^2 t spoils first, drops out.
        let mut off = Vector3::zeros();
        for i in 0..16 {
            let t = half_turn - f64::from(i) * TAU / 16.0 / solution.rate.abs();
            off += (motion.axis_state(t)?.axis - axis_at(&solution, t)) / 16.0;
        }
        Ok(off.norm() / beta_0.cos() / (amplitude / solution.rate.abs()))
    })
}

fn drift() -> Result<Measured, String> {
    worst_of_draws(71, 40, |random| {
        // A unit of time of a few milliseconds.
        let unit = random.within(1e-3, 1e-2);
        let spin = TAU * random.within(200.0, 700.0) * unit;
        let interval = 15.0 * JULIAN_YEAR / unit;
        let (inertia, oblateness) = (random.within(1.0, 2.0), 10f64.powf(random.within(-6.0, -1.0)));
        let spheroid = RigidSpheroid {
            inertia_xx: inertia,
            inertia_zz: inertia * (1.0 + oblateness),
            constant_c: random.within(0.3, 1.0),
        };
        let beta_0 = random.within(0.2, 1.1);
        let gone = 10f64.powf(random.within(-6.0, -2.0));
        let size = gone * spin / interval;
        let s = PrincipalCoefficients::new([-size / 3.0, -size / 3.0, size * 2.0 / 3.0]);
        let axis = Vector3::new(beta_0.sin(), 0.0, beta_0.cos());
        let initial = BodyState {
            axis,
            momentum: axis * (spin * spheroid.inertia_zz),
            equatorial_axis: Vector3::new(beta_0.cos(), 0.0, -beta_0.sin()),
        };
        let problem = Problem::new(spheroid, s.tensor(), initial)?;
        let motion = AveragedMotion::new(&problem, (0.0, interval))?;
        let end = motion.axis_state(interval)?.axis;
        // Over all directions o of observers the mean square of o.d is |d|^2 / 3.
        let cos_lambda_change = (end - axis).norm() / 3.0_f64.sqrt();
        let polar_inertia_over_c = spheroid.inertia_zz / spheroid.constant_c;
        let drift = SpinAxisDrift { polar_inertia_over_c, spin, interval, cos_lambda_change };
        let estimate = drift.combination_bound(eta_from_inclination(beta_0)?)?;
        let expected = s.combination().abs() * beta_0.sin() / 3.0_f64.sqrt();
        Ok((estimate / expected - 1.0).abs())
    })
}
