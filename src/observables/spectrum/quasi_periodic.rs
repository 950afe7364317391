//! A motion as a function of angles that grow in proportion to time.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::FundamentalFrequencies;
use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::{UniformMotion, largest_torque};
use crate::solutions::torus::TorusSolution;

/// Rates of a torus are found to 32 digits, as for a motion of so many turns.
const TURNS: f64 = 1e15;

/// A motion as a function of three angles that grow in proportion to time, with their frequencies.
#[derive(Debug, Clone)]
pub struct QuasiPeriodicMotion {
    form: Form,
    /// Turns per unit of time.
    rates: [DoubleDouble; 3],
    rate_error: f64,
    frequencies: FundamentalFrequencies,
}

/// Which solution it is.
#[derive(Debug, Clone)]
enum Form {
    /// Angles: the turn of `n` and `L`, none, and that of `e_x` about `n`.
    Uniform(UniformMotion<f64>),
    /// The angles of [`TorusSolution`].
    Torus(TorusSolution),
}

impl Form {
    fn state(&self, turns: [f64; 3]) -> BodyState<f64> {
        match self {
            Self::Uniform(motion) => motion.state_after_turns(turns[0], turns[2]),
            Self::Torus(solution) => solution.state_after_turns(turns),
        }
    }
}

impl QuasiPeriodicMotion {
    /// The motion of a problem: uniform where it is free or steady, else on its torus.
    ///
    /// # Errors
    /// As for [`TorusSolution::new`]: near the separatrix, and where the torque turns the body as fast as it rotates.
    pub fn new(problem: &Problem<f64>) -> Result<Self, Error> {
        let (everywhere, spheroid) = ((0.0, f64::INFINITY), problem.spheroid());
        let uniform = if largest_torque(spheroid, problem.coefficients()) == 0.0 {
            Some(UniformMotion::free(problem, everywhere))
        } else {
            UniformMotion::steady(problem, everywhere).ok()
        };
        let (form, rates, rate_error, pole) = match uniform {
            Some(motion) => {
                let [turn, about_axis] = motion.rates();
                let rates = [turn / TAU, 0.0, about_axis / TAU].map(DoubleDouble::from);
                let error = motion.rounding(1.0) - motion.rounding(0.0);
                (Form::Uniform(motion), rates, error, motion.pole())
            }
            None => {
                let turn = TAU * spheroid.inertia_xx / problem.initial().momentum.norm();
                let solution = TorusSolution::new(problem, 0.0, TURNS * turn)?;
                let (rates, error) = (solution.turns_per_time(), solution.rate_error());
                let pole = solution.pole();
                (Form::Torus(solution), rates, error, pole)
            }
        };
        // The end of the axis that is nearest to an axis of the frame.
        let pole = pole * pole[pole.iamax()].signum();
        let pole = if pole == Vector3::zeros() { Vector3::z() } else { pole };
        let rounded = rates.map(|rate| rate.high * TAU);
        let frequencies = FundamentalFrequencies::of(|turns| form.state(turns), rounded, &pole);
        Ok(Self { form, rates, rate_error, frequencies })
    }

    /// The state after turns of the three angles since the start.
    pub fn state_after_turns(&self, turns: [f64; 3]) -> BodyState<f64> {
        self.form.state(turns)
    }

    /// Rates of the three angles (rad per unit of time).
    pub fn rates(&self) -> [f64; 3] {
        self.rates.map(|rate| rate.high * TAU)
    }

    /// The fundamental frequencies by which lines are named.
    pub fn frequencies(&self) -> &FundamentalFrequencies {
        &self.frequencies
    }

    /// Frequency (rad per unit of time) of a combination of the three angles, and its estimated error.
    pub(super) fn frequency(&self, multiples: [i32; 3]) -> [f64; 2] {
        let terms = self.rates.iter().zip(multiples).map(|(rate, k)| *rate * DoubleDouble::from(f64::from(k)));
        let sum = terms.fold(DoubleDouble::from(0.0), |sum, term| sum + term).high * TAU;
        let order: i32 = multiples.iter().map(|k| k.abs()).sum();
        [sum, f64::from(order) * self.rate_error + f64::EPSILON * sum.abs()]
    }

    /// Estimated error of a state as a function of the angles.
    pub(super) fn error(&self) -> f64 {
        match &self.form {
            Form::Uniform(motion) => motion.rounding(0.0),
            Form::Torus(solution) => solution.error_estimate(0.0),
        }
    }
}
