//! Every check of the project, by subject.

mod averaged;
mod axis_motion;
mod bound;
mod elliptic;
mod equations_of_motion;
mod error_estimate;
mod eta;
mod first_integrals;
mod fisher;
mod forced_precession;
mod frequencies;
mod inference;
mod observer;
mod orientation;
mod perturbation_equations;
mod plan_errors;
mod plans;
mod point_masses;
mod potential_energy;
mod propagation;
mod pulsar;
mod pulsar_table;
pub mod regimes;
mod same_bits;
mod second_integrator;
mod solutions;
pub(crate) mod spectrum;
mod spin_axis;
mod splitting;
mod stability;
mod star;
mod symbolic;
mod symmetric;
mod torque;
mod wave_tensor;
mod waves;

use crate::prelude::*;
use std::sync::{LazyLock, OnceLock};

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: &[fn() -> Vec<Check>] = &[
        orientation::checks,
        star::checks,
        point_masses::checks,
        potential_energy::checks,
        equations_of_motion::checks,
        torque::checks,
        wave_tensor::checks,
        pulsar::checks,
        first_integrals::checks,
        perturbation_equations::checks,
        forced_precession::checks,
        solutions::checks,
        elliptic::checks,
        symmetric::checks,
        propagation::checks,
        same_bits::checks,
        error_estimate::checks,
        axis_motion::checks,
        splitting::checks,
        second_integrator::checks,
        plans::checks,
        plan_errors::checks,
        regimes::checks,
        observer::checks,
        symbolic::checks,
        spin_axis::checks,
        bound::checks,
        eta::checks,
        pulsar_table::checks,
        fisher::checks,
        inference::checks,
        waves::checks,
        averaged::checks,
        frequencies::checks,
        spectrum::checks,
        stability::checks,
    ];
    subjects.iter().flat_map(|checks| checks()).collect()
}

/// What became of a check, which is run once in a process; nothing if no check is called so.
pub fn outcome(id: &str) -> Option<&'static Outcome> {
    static OUTCOMES: LazyLock<Vec<(Check, OnceLock<Outcome>)>> =
        LazyLock::new(|| all().into_iter().map(|check| (check, OnceLock::new())).collect());
    let (check, outcome) = OUTCOMES.iter().find(|(check, _)| check.id == id)?;
    Some(outcome.get_or_init(|| check.run()))
}
