//! Pulses of a precessing star: the kernels, their approximations, the pulse train, times of arrival and polarization. Eqs.
//! (44), (45), (47), (49)-(56).

pub(super) mod absorbed_angles;
pub(super) mod approximations;
pub(super) mod arrivals;
mod cases;
pub(super) mod clock;
pub(super) mod edges_reference;
pub(super) mod formulas;
pub(super) mod functions_of_gamma;
pub(super) mod grazing;
pub(super) mod identities;
pub(super) mod margin;
pub(super) mod position_angle;
pub(super) mod published;
pub(super) mod pulse_numbers;
pub(super) mod scan;
pub(super) mod train;
pub(super) mod ways;
