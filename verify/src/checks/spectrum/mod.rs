//! Spectra, line lists and fundamental frequencies, and what the paper says of its spectra.

use crate::prelude::*;

mod amplitudes;
mod frequencies;
mod harmonics;
mod identification;
mod line_lists;
mod lines;
mod pulse_series;
pub(crate) mod signals;
mod slow_precession;

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
