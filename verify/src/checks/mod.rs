//! Every check of the project, by subject.

mod propagation;
pub mod regimes;
mod solutions;
mod star;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 4] = [star::checks, solutions::checks, propagation::checks, regimes::checks];
    subjects.iter().flat_map(|checks| checks()).collect()
}
