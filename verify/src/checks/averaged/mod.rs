//! The averaged motion in closed form: its derivation, its errors and its derivatives.

use crate::prelude::*;

mod averaging;
mod decades;
mod derivatives;
mod estimates;
mod orders;
mod scenes;
mod top;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        averaging::checks(),
        top::checks(),
        orders::checks(),
        estimates::checks(),
        derivatives::checks(),
        decades::checks(),
    ]
    .concat()
}
