//! Spectra, line lists and fundamental frequencies, and what the paper says of its spectra.

mod claims;
mod frequencies;
mod kernels;
pub(crate) mod signals;
mod slow_precession;

use crate::check::Check;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [kernels::checks(), frequencies::checks(), slow_precession::checks(), claims::checks()].concat()
}
