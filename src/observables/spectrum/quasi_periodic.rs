//! A motion as a function of angles that grow in proportion to time, and their frequencies.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::FundamentalFrequencies;
use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::PhasedMotion;

/// Rates are found to 32 digits, as for a motion of so many turns.
const TURNS: f64 = 1e15;

/// A motion as a function of three angles that grow in proportion to time, with its fundamental frequencies.
#[derive(Debug, Clone)]
pub struct QuasiPeriodicMotion {
    motion: PhasedMotion,
    /// Phases at the start, in turns.
    start: [f64; 3],
    rate_error: f64,
    frequencies: FundamentalFrequencies,
}

impl QuasiPeriodicMotion {
    /// The exact motion of a problem.
    ///
    /// # Errors
    /// As for [`PhasedMotion::exact`]: near the separatrix, and where the torque turns the body as fast as it rotates.
    pub fn new(problem: &Problem<f64>) -> Result<Self, Error> {
        let momentum = problem.initial().momentum.norm();
        let longest = if momentum > 0.0 { TURNS * TAU * problem.spheroid().inertia_xx / momentum } else { 1.0 };
        let motion = PhasedMotion::exact(problem, longest)?;
        let start = motion.turns([0.0; 2]).map(|turns| turns.fraction);
        let rate_error = (motion.rounding(longest) - motion.rounding(0.0)) / longest;
        // The end of the axis that is nearest to an axis of the frame.
        let pole: Vector3<f64> = motion.pole();
        let pole = pole * pole[pole.iamax()].signum();
        let frequencies = FundamentalFrequencies::of(|turns| motion.state_at(sum(start, turns)), motion.rates(), &pole);
        Ok(Self { motion, start, rate_error, frequencies })
    }

    /// The state after turns of the three angles since the start.
    pub fn state_after_turns(&self, turns: [f64; 3]) -> BodyState<f64> {
        self.motion.state_at(sum(self.start, turns))
    }

    /// Rates of the three angles (rad per unit of time).
    pub fn rates(&self) -> [f64; 3] {
        self.motion.rates()
    }

    /// The fundamental frequencies by which lines are named.
    pub fn frequencies(&self) -> &FundamentalFrequencies {
        &self.frequencies
    }

    /// Frequency (rad per unit of time) of a combination of the three angles, and its estimated error.
    pub(super) fn frequency(&self, multiples: [i32; 3]) -> [f64; 2] {
        let rates = self.motion.turns_per_time();
        let terms = rates.into_iter().zip(multiples).map(|(rate, k)| rate * DoubleDouble::from(f64::from(k)));
        let sum = terms.fold(DoubleDouble::from(0.0), |sum, term| sum + term).high * TAU;
        let order: i32 = multiples.iter().map(|k| k.abs()).sum();
        [sum, f64::from(order) * self.rate_error + f64::EPSILON * sum.abs()]
    }

    /// Estimated error of a state as a function of the angles.
    pub(super) fn error(&self) -> f64 {
        self.motion.error_estimate(0.0)
    }
}

/// Angles in turns, without whole ones.
fn sum(start: [f64; 3], turns: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| {
        let turns = start[i] + turns[i];
        turns - turns.round()
    })
}
