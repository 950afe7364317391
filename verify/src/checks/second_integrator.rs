//! The numerical motion against another integrator of another crate, in both forms of the equations.

use twofold::propagation::{ContinuousAngles, Motion, propagate};

use crate::check::{Bound, Check, Kind, Measured, largest, largest_component};
use crate::physical_domain::{scenes, worst_over};
use crate::second_integrator::{motion_in_angles, regular_motion};

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "second-integrator",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "a Runge-Kutta method of another crate gives the same motion by the regular equations",
            figure: "largest difference of n, L, e_x after 20 t_c, 200 random scenes",
            bound: Bound::AtMost(1e-11),
            reason: "the other method's tolerance 1e-13 per step, added up over some hundred steps and grown with the phase",
            measure: regular_forms,
        },
        Check {
            id: "second-integrator-angles",
            kind: Kind::Property,
            equations: &[22, 25],
            statement: "away from the poles the motion by Eq. (25) in Euler angles, turns counted, is that of the regular equations",
            figure: "largest difference of alpha, beta, gamma after 20 t_c, random scenes whose axis stays 0.1 rad off the poles",
            bound: Bound::AtMost(1e-10),
            reason: "as above, divided by the least sin(beta) of 0.1",
            measure: forms_agree,
        },
    ]
}

const DURATION: f64 = 20.0;

fn regular_forms() -> Result<Measured, String> {
    worst_over(21, 200, &scenes(), |scene| {
        let (spheroid, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let other = regular_motion(&spheroid, &s, &initial, DURATION, 1e-13)?;
        let ours =
            propagate(&spheroid, &s, &initial, (0.0, DURATION), 1e-14).and_then(|motion| motion.state(DURATION))?;
        let differences =
            [ours.axis - other.axis, ours.momentum - other.momentum, ours.equatorial_axis - other.equatorial_axis];
        Ok(largest(differences.iter().map(largest_component)))
    })
}

fn forms_agree() -> Result<Measured, String> {
    let measured = std::cell::Cell::new(0);
    let worst = worst_over(22, 200, &scenes(), |scene| {
        let motion =
            propagate(&scene.spheroid(), &scene.coefficients().tensor(), &scene.state(), (0.0, DURATION), 1e-14)?;
        let mut closest = f64::INFINITY;
        for i in 0..=2000 {
            let axis = motion.state(DURATION * f64::from(i) / 2000.0)?.axis;
            closest = closest.min(axis.x.hypot(axis.y));
        }
        if closest < 0.1 {
            return Ok(0.0);
        }
        measured.set(measured.get() + 1);
        let other = motion_in_angles(
            &scene.spheroid(),
            &scene.coefficients(),
            (&scene.angles(), &scene.rates()),
            DURATION,
            1e-13,
        )?;
        let ours = ContinuousAngles::new(&motion, 0.0, &scene.angles()).and_then(|mut angles| angles.at(DURATION))?;
        let differences = [ours.alpha - other.alpha, ours.beta - other.beta, ours.gamma - other.gamma];
        Ok(largest(differences.map(f64::abs)))
    })?;
    if measured.get() < 100 {
        return Err(format!("only {} of 200 scenes stay off the poles", measured.get()));
    }
    Ok(Measured::new(worst.figure, format!("{} scenes off the poles; {}", measured.get(), worst.detail)))
}
