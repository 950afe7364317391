//! Where the approximations hold: their errors against the numerical motion.

use crate::prelude::*;

pub mod method_errors;
mod middle_axis;
pub mod perturbation_error;
mod precession_rates;
mod single_precession;
mod small_s;
mod twofold_precession;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        twofold_precession::checks(),
        single_precession::checks(),
        precession_rates::checks(),
        middle_axis::checks(),
        method_errors::checks(),
        small_s::checks(),
    ]
    .concat()
}
