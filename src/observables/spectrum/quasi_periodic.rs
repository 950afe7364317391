//! A motion as a function of angles that grow in proportion to time, and their frequencies.

use core::f64::consts::TAU;

use super::fundamental_frequencies::{FundamentalFrequencies, rate_of, turns_of};
use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::{PhasedMotion, largest_torque};

/// Rates are computed to 32 digits, as for a motion of this many turns.
const TURNS: f64 = 1e15;

/// Fraction of these turns over which the error of the rates is evaluated.
const PART: f64 = 1e-9;

/// A component `L.n` below this fraction of `|L|` is the rounding of both: the star has no spin.
const NO_SPIN: f64 = 4.0 * f64::EPSILON;

/// A motion as a function of three angles that grow in proportion to time, with its fundamental frequencies.
#[derive(Debug, Clone)]
pub struct QuasiPeriodicMotion {
    motion: PhasedMotion,
    /// Phases at the start, in turns.
    start: [f64; 3],
    /// Rates of the phases (turns per unit of time).
    rates: [DoubleDouble; 3],
    rate_error: f64,
    frequencies: FundamentalFrequencies,
}

impl QuasiPeriodicMotion {
    /// The motion of a problem, exact to rounding for the given numbers.
    ///
    /// # Errors
    /// As for [`PhasedMotion::exact`]: near the separatrix.
    pub fn new(problem: &Problem<f64>) -> Result<Self, Error> {
        let (spheroid, momentum) = (problem.spheroid(), problem.initial().momentum.norm());
        // For a start from rest, the scale is set by the torque.
        let torque = largest_torque(spheroid, problem.coefficients());
        let momentum = momentum.max((spheroid.inertia_xx * torque).sqrt());
        let longest = if momentum > 0.0 { TURNS * TAU * spheroid.inertia_xx / momentum } else { 1.0 };
        let motion = PhasedMotion::exact(problem, longest)?;
        let start = motion.turns([0.0; 2]).map(|turns| turns.fraction);
        let rate_error = (motion.error_estimate(PART * longest) - motion.error_estimate(0.0)) / (PART * longest);
        let mut rates = motion.turns_per_time();
        let state = |turns| motion.state_at(sum(start, turns));
        let mut frequencies = FundamentalFrequencies::of(state, rates, &motion.pole());
        // The rotation about n due to the rounding of L.n would have a period of some 1e16 rotations.
        let rounding = NO_SPIN * problem.initial().momentum.norm();
        if problem.initial().momentum.dot(&problem.initial().axis).abs() <= rounding
            && let Some(psi) = frequencies.all.iter().find(|of| of.symbol == "psi'")
            && psi.rate.abs() <= rounding / spheroid.inertia_xx.min(spheroid.inertia_zz)
        {
            // The angle about n turns once with the third angle, in either sense.
            rates[2] -= turns_of(&rates, psi.turns) * f64::from(psi.turns[2]);
            frequencies = FundamentalFrequencies::of(state, rates, &motion.pole());
        }
        Ok(Self { motion, start, rates, rate_error, frequencies })
    }

    /// The state after given turns of the three angles since the start.
    pub(crate) fn state_after_turns(&self, turns: [f64; 3]) -> BodyState<f64> {
        self.motion.state_at(sum(self.start, turns))
    }

    /// Rates of the three angles (rad per unit of time). If `L.n` is zero up to rounding, they add up to no rotation about `n`.
    pub(crate) fn rates(&self) -> [f64; 3] {
        self.rates.map(|rate| (rate * DoubleDouble::TAU).high)
    }

    /// The fundamental frequencies by which lines are named.
    pub fn frequencies(&self) -> &FundamentalFrequencies {
        &self.frequencies
    }

    /// Frequency (turns per unit of time) of a combination of the three angles.
    pub(super) fn turns(&self, multiples: [i32; 3]) -> DoubleDouble {
        turns_of(&self.rates, multiples)
    }

    /// Frequency (rad per unit of time) of a combination of the three angles, and its estimated error.
    pub(super) fn frequency(&self, multiples: [i32; 3]) -> [f64; 2] {
        let sum = rate_of(&self.rates, multiples);
        let order: i32 = multiples.iter().map(|k| k.abs()).sum();
        [sum, f64::from(order) * self.rate_error + f64::EPSILON * sum.abs()]
    }

    /// Estimated error of a state as a function of the angles.
    pub(super) fn error(&self) -> f64 {
        self.motion.error_estimate(0.0)
    }
}

/// Angles in turns, without their integer part.
fn sum(start: [f64; 3], turns: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| {
        let turns = start[i] + turns[i];
        turns - turns.round()
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::dynamics::fixture::problem;

    /// An `L.n` that is rounding turns nothing about `n`, also for a needle of little inertia; the frequencies know it.
    #[test]
    fn a_spin_that_is_rounding_is_none() {
        let star = RigidSpheroid { inertia_xx: 1e-3, inertia_zz: 3e-4, constant_c: 1e-3 };
        for spin in [-6e-16, 6e-16] {
            let start = BodyState {
                axis: Vector3::z(),
                momentum: Vector3::new(1e-3, 2e-4, 1e-3 * spin),
                equatorial_axis: Vector3::x(),
            };
            let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03));
            let motion = QuasiPeriodicMotion::new(&Problem::new(star, s, start).unwrap()).unwrap();
            let psi = motion.frequencies().all.iter().find(|of| of.symbol == "psi'").unwrap();
            assert!(psi.rate.abs() < 1e-25, "{spin}: {psi:?}");
        }
    }

    #[test]
    fn nothing_moves_without_momentum_and_torque() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.1, constant_c: 1.0 };
        let start = BodyState { axis: Vector3::x(), momentum: Vector3::zeros(), equatorial_axis: Vector3::y() };
        let found = QuasiPeriodicMotion::new(&Problem::new(star, Matrix3::zeros(), start).unwrap()).unwrap();
        assert_eq!(found.rates(), [0.0; 3]);
        assert_eq!(found.state_after_turns([0.0; 3]), start);
    }

    /// The errors of the rates of a free motion may have either sign: a difference of rates has as large an error as their sum, apart from the rounding
    /// of the result.
    #[test]
    fn errors_of_rates_add_up_in_sums_and_in_differences() {
        let found = QuasiPeriodicMotion::new(&problem([0.0; 3])).unwrap();
        let error = |multiples| {
            let [frequency, error] = found.frequency(multiples);
            error - f64::EPSILON * frequency.abs()
        };
        let one = error([1, 0, 0]);
        assert!(one > 0.0);
        for (multiples, rates) in [([1, 0, 1], 2.0), ([1, 0, -1], 2.0), ([-1, 0, 1], 2.0), ([2, 0, -3], 5.0)] {
            assert!((error(multiples) / one - rates).abs() < 1e-13, "{multiples:?}: {}", error(multiples) / one);
        }
    }

    /// The rate of `e_x` about `n` of a nearly spherical star is a difference of rates 1e8 times as large: `-epsilon Omega^z`, apart from the
    /// torque.
    #[test]
    fn small_differences_of_rates_keep_their_digits() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.0 + 9e-9, constant_c: 1.0 };
        let s = Matrix3::from_diagonal(&Vector3::new(2e-22, 1e-22, -3e-22));
        let axis = Vector3::new(0.28, 0.0, 0.96);
        let momentum = Vector3::new(0.36, 0.0, 1.0);
        let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
        let found = QuasiPeriodicMotion::new(&Problem::new(star, s, start).unwrap()).unwrap();
        let expected = -star.oblateness() * momentum.dot(&axis) / star.inertia_zz;
        let rate = found.frequencies().rate("psi'").unwrap();
        assert!((rate / expected - 1.0).abs() < 1e-12, "{rate:e} {expected:e}");
    }
}
