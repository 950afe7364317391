//! Every check of the project, by subject.

mod elliptic;
mod propagation;
pub mod regimes;
mod solutions;
mod symmetric;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 5] =
        [elliptic::checks, solutions::checks, symmetric::checks, propagation::checks, regimes::checks];
    subjects.iter().flat_map(|checks| checks()).collect()
}
