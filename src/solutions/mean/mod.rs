//! Motion averaged over the fast rotation of the symmetry axis about the angular momentum.

pub mod slow_precession;
