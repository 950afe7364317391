//! Pulses of a precessing star: the kernels, their approximations, the pulse train, times of arrival and polarization. Eqs.
//! (44), (45), (47), (49)-(56).

use crate::prelude::*;

mod absorbed_angles;
mod approximations;
mod arrivals;
mod cases;
mod clock;
mod edges_reference;
mod formulas;
mod functions_of_gamma;
mod grazing;
mod identities;
mod margin;
mod position_angle;
mod published;
mod pulse_numbers;
mod scan;
mod train;
mod ways;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identities::checks(),
        formulas::checks(),
        margin::checks(),
        scan::checks(),
        train::checks(),
        ways::checks(),
        grazing::checks(),
        edges_reference::checks(),
        published::checks(),
        arrivals::checks(),
        pulse_numbers::checks(),
        clock::checks(),
        position_angle::checks(),
        approximations::checks(),
        functions_of_gamma::checks(),
        absorbed_angles::checks(),
    ]
    .concat()
}
