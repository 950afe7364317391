//! Every check of the project, by subject.

mod averaged;
mod axis_motion;
mod bound;
mod bulge;
mod elliptic;
mod equations_of_motion;
mod error_estimate;
mod eta;
mod first_integrals;
mod fisher;
mod forced_precession;
mod frequencies;
mod inference;
mod more_pulsars;
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
mod spin_down;
mod splitting;
mod stability;
mod star;
mod symbolic;
mod symmetric;
mod timing_model;
mod torque;
mod torus_motion;
mod wave_tensor;
mod waves;

use crate::prelude::*;
use std::sync::{LazyLock, OnceLock};

/// All checks, in the order in which they are listed.
pub fn all() -> Vec<Check> {
    let subjects: &[fn() -> Vec<Check>] = &[
        orientation::checks,
        star::multiprecision_table::checks,
        star::potential_coefficients::checks,
        star::shape::checks,
        star::energy::checks,
        star::equilibrium::checks,
        star::estimates::checks,
        point_masses::checks,
        potential_energy::checks,
        equations_of_motion::checks,
        torque::checks,
        wave_tensor::checks,
        pulsar::identities::checks,
        pulsar::formulas::checks,
        pulsar::margin::checks,
        pulsar::scan::checks,
        pulsar::train::checks,
        pulsar::ways::checks,
        pulsar::grazing::checks,
        pulsar::edges_reference::checks,
        pulsar::published::checks,
        pulsar::arrivals::checks,
        pulsar::pulse_numbers::checks,
        pulsar::clock::checks,
        spin_down::checks,
        timing_model::checks,
        bulge::checks,
        pulsar::position_angle::checks,
        pulsar::approximations::checks,
        pulsar::functions_of_gamma::checks,
        pulsar::absorbed_angles::checks,
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
        regimes::twofold_precession::checks,
        regimes::single_precession::checks,
        regimes::precession_rates::checks,
        regimes::middle_axis::checks,
        regimes::method_errors::checks,
        regimes::small_s::checks,
        observer::checks,
        symbolic::checks,
        spin_axis::checks,
        bound::checks,
        eta::checks,
        more_pulsars::checks,
        pulsar_table::checks,
        fisher::checks,
        inference::checks,
        waves::checks,
        averaged::averaging::checks,
        averaged::top::checks,
        averaged::orders::checks,
        averaged::estimates::checks,
        averaged::derivatives::checks,
        averaged::decades::checks,
        torus_motion::checks,
        frequencies::torus::checks,
        frequencies::averaged::checks,
        frequencies::middle_axis::checks,
        spectrum::frequencies::checks,
        spectrum::slow_precession::checks,
        spectrum::lines::checks,
        spectrum::harmonics::checks,
        spectrum::pulse_series::checks,
        stability::checks,
    ];
    subjects.iter().flat_map(|checks| checks()).collect()
}

/// The outcome of a check, which runs once per process; `None` if no check has this id.
pub fn outcome(id: &str) -> Option<&'static Outcome> {
    static OUTCOMES: LazyLock<Vec<(Check, OnceLock<Outcome>)>> =
        LazyLock::new(|| all().into_iter().map(|check| (check, OnceLock::new())).collect());
    let (check, outcome) = OUTCOMES.iter().find(|(check, _)| check.id == id)?;
    Some(outcome.get_or_init(|| check.run()))
}
