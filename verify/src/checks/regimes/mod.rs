//! Ranges of validity of the approximations: their errors relative to the numerical motion.

pub mod method_errors;
pub(super) mod middle_axis;
pub mod perturbation_error;
pub(super) mod precession_rates;
pub(super) mod single_precession;
pub(super) mod small_s;
pub(super) mod twofold_precession;
