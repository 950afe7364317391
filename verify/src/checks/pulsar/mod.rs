//! Pulses of a precessing star: the kernels, their approximations and the pulse train. Eqs. (44), (45), (47), (49)-(56).

mod absorbed_angles;
mod approximations;
mod formulas;
mod identities;
mod margin;
mod train;

use crate::check::Check;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identities::checks(),
        formulas::checks(),
        margin::checks(),
        train::checks(),
        approximations::checks(),
        absorbed_angles::checks(),
    ]
    .concat()
}
