//! Every check of the project, by subject.

mod propagation;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 1] = [propagation::checks];
    subjects.iter().flat_map(|checks| checks()).collect()
}
