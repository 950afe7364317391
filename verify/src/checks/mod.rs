//! Every check of the project, by subject.

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    [].concat()
}
