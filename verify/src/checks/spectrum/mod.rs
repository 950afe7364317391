//! Spectra, line lists and fundamental frequencies, and what the paper says of its spectra.

mod amplitudes;
mod frequencies;
mod harmonics;
mod identification;
mod line_lists;
mod lines;
mod pulse_series;
pub(crate) mod signals;
mod slow_precession;

use crate::check::Check;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        amplitudes::checks(),
        line_lists::checks(),
        identification::checks(),
        frequencies::checks(),
        slow_precession::checks(),
        lines::checks(),
        harmonics::checks(),
        pulse_series::checks(),
    ]
    .concat()
}
