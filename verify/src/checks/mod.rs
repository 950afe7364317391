//! Every check of the project, by subject.

use crate::check::Check;

pub mod equations_of_motion;
pub mod first_integrals;
pub mod orientation;
pub mod potential_energy;
pub mod torque;
pub mod wave_tensor;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 6] = [
        orientation::checks,
        potential_energy::checks,
        equations_of_motion::checks,
        torque::checks,
        wave_tensor::checks,
        first_integrals::checks,
    ];
    subjects.iter().flat_map(|checks| checks()).collect()
}
