//! Every check of the project, by subject.

mod elliptic;
mod propagation;
mod symmetric;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 3] = [elliptic::checks, propagation::checks, symmetric::checks];
    subjects.iter().flat_map(|checks| checks()).collect()
}
