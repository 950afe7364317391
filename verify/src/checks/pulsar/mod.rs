//! Pulses of a precessing star: the kernels, their approximations and the pulse train. Eqs. (44), (45), (47), (49)-(56).

mod approximations;
mod formulas;
mod identities;
mod margin;
mod position_angle;
mod train;

use crate::check::Check;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [identities::checks(), formulas::checks(), margin::checks(), position_angle::checks(), train::checks(), approximations::checks()].concat()
}
