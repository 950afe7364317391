//! Lines and fundamental frequencies, and the paper's statements about its spectra.

pub(super) mod frequencies;
pub(super) mod harmonics;
pub(super) mod lines;
pub(super) mod pulse_series;
pub(crate) mod signals;
pub(super) mod slow_precession;
