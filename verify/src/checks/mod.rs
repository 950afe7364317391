//! Every check of the project, by subject.

mod equations_of_motion;
mod first_integrals;
mod orientation;
mod perturbation_equations;
mod potential_energy;
mod propagation;
mod steady_precession;
mod torque;
mod wave_tensor;

use crate::check::Check;

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: [fn() -> Vec<Check>; 9] = [
        orientation::checks,
        potential_energy::checks,
        equations_of_motion::checks,
        torque::checks,
        wave_tensor::checks,
        first_integrals::checks,
        perturbation_equations::checks,
        steady_precession::checks,
        propagation::checks,
    ];
    subjects.iter().flat_map(|checks| checks()).collect()
}
