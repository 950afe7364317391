//! The numerical motion against the 34-digit reference motions, and its own claims.

use twofold::propagation::{Motion, propagate};

use crate::check::{Bound, Check, Kind, Measured};
use crate::reference::reference_motions;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![Check {
        id: "propagation-reference",
        kind: Kind::Oracle,
        equations: &[25],
        statement: "the numerical motion of ten scenes reproduces n, L, e_x of a 34-digit integration at every listed time",
        figure: "largest error of a component",
        bound: Bound::AtMost(1e-12),
        reason: "rounding of the initial values (1e-16) grown with the phase of 600 rad, and of some 500 steps",
        measure: against_reference,
    }]
}

fn against_reference() -> Result<Measured, String> {
    let mut worst = Measured::new(0.0, "");
    for reference in reference_motions() {
        let end = reference.states.last().map_or(0.0, |(t, _)| *t);
        let motion = propagate(&reference.spheroid, &reference.violation(), &reference.initial(), (0.0, end), 1e-14)
            .map_err(|e| e.to_string())?;
        for (t, state) in &reference.states {
            let ours = motion.state(*t).map_err(|e| e.to_string())?;
            let error = (ours.axis - state.axis)
                .amax()
                .max((ours.momentum - state.momentum).amax())
                .max((ours.equatorial_axis - state.equatorial_axis).amax());
            if !(error <= worst.figure) {
                worst = Measured::new(error, format!("{} at t = {t}", reference.name));
            }
        }
    }
    Ok(worst)
}
