//! The numerical motion compared with the integrator of another crate, in both forms of the equations.

use crate::prelude::*;
use crate::second_integrator::{motion_in_angles, regular_motion};

checks! {
    /// a Runge-Kutta method of another crate gives the same motion by the regular equations
    Oracle "second-integrator" [25]: regular_forms;
    AtMost(1e-11) "largest difference of n, L, e_x after 20 units of time, 200 random scenes";
    because "the other method's tolerance 1e-13 per step, added up over some hundred steps and grown with the phase";
    /// away from the poles the motion by Eq. (25) in Euler angles, turns counted, is that of the regular equations
    Property "second-integrator-angles" [22, 25]: forms_agree;
    AtMost(1e-10) "largest difference of alpha, beta, gamma after 20 units of time, random scenes whose axis stays 0.1 rad off the poles";
    because "1e-11 of the regular equations, divided by the least sin(beta) of 0.1";
}

const DURATION: f64 = 20.0;

fn regular_forms() -> Result<Measured, String> {
    worst_over(21, 200, &scenes(), |scene| {
        let ours = scene.problem().taylor((0.0, DURATION), 1e-14)?.state(DURATION)?;
        Ok(largest_difference(&ours, &regular_motion(&scene.problem(), DURATION, 1e-13)?, 1.0))
    })
}

fn forms_agree() -> Result<Measured, String> {
    let mut measured = 0;
    let worst = worst_over(22, 200, &scenes(), |scene| {
        let motion = scene.problem().taylor((0.0, DURATION), 1e-14)?;
        let mut closest = f64::INFINITY;
        for i in 0..=2000 {
            let axis = motion.state(DURATION * f64::from(i) / 2000.0)?.axis;
            closest = closest.min(axis.x.hypot(axis.y));
        }
        if closest < 0.1 {
            return Ok(None);
        }
        measured += 1;
        let other = motion_in_angles(&scene.spheroid, &scene.s, (&scene.angles, &scene.rates), DURATION, 1e-13)?;
        let ours = ContinuousAngles::new(&motion, 0.0, &scene.angles).and_then(|mut angles| angles.at(DURATION))?;
        let differences = [ours.alpha - other.alpha, ours.beta - other.beta, ours.gamma - other.gamma];
        Ok(Some(largest(differences.map(f64::abs))))
    })?;
    if measured < 100 {
        return Err(format!("only {measured} of 200 scenes stay off the poles"));
    }
    Ok(Measured::new(worst.figure, format!("{measured} scenes off the poles; {}", worst.detail)))
}
