//! Every check of the project, by subject.

mod propagation;
mod star;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 2] = [propagation::checks, star::checks];
    subjects.iter().flat_map(|checks| checks()).collect()
}
