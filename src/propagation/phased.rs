//! Motions described by phases that grow linearly in time.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
//! use twofold::observables::Observer;
//! use twofold::observables::pulsar::{Beam, PulsarClock};
//! use twofold::propagation::PhasedMotion;
//!
//! let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
//! let (axis, momentum) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.7, 0.1, 1.5));
//! let start = BodyState { axis, momentum, equatorial_axis: Vector3::y() };
//! let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s, start)?;
//! // So strong a torque needs the torus. After 1e12 t_c:
//! let motion = PhasedMotion::new(&problem, 1e12)?;
//! assert!(motion.error_estimate(1e12) < 1e-13);
//! let clock = PulsarClock::new(motion, &Beam::new(1.3, 0.0, 0.6), &Observer::at(1.4, 0.0))?;
//! let turns = 1e12 / clock.period();
//! let pulse = (0..9).find_map(|k| clock.pulse_near([1e12, f64::from(k) * clock.period()]).transpose()).expect("a pulse")?;
//! assert!((pulse.number as f64 - turns).abs() < 10.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::propagation::{AveragedMotion, UniformMotion};
use crate::solutions::averaged::{OfRotations, Turns};
use crate::solutions::torus::TorusSolution;

/// A motion whose state is a periodic function of three phases that grow linearly in time: any time has the same cost. Two of the phases move `n` and
/// `L`, the third rotates the body about `n`.
#[derive(Debug, Clone)]
pub struct PhasedMotion {
    pub(crate) problem: Problem<f64>,
    solution: Solution,
}

#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one motion at a time, and nothing on the heap")]
enum Solution {
    /// Times are counted from the initial state, and no span bounds them.
    Averaged(AveragedMotion<f64>),
    Torus(TorusSolution),
    /// The phases are the rotation of `n` and `L`, zero, and the rotation of `e_x` about `n`.
    Uniform(UniformMotion<f64>),
}

impl PhasedMotion {
    /// The motion from the initial state at the time zero, for times up to `longest` in size. It is the second-order averaged motion if the star has
    /// a bulge, if the truncation error of that motion is below its rounding, or if the torus is refused; otherwise [`exact`](Self::exact).
    ///
    /// # Errors
    /// The errors of the torus, if the averaged motion is not possible either.
    pub fn new(problem: &Problem<f64>, longest: f64) -> Result<Self, Error> {
        let averaged = Self::averaged(problem);
        match averaged {
            averaged if problem.require_rigid().is_err() => averaged,
            Ok(motion) if motion.truncation(longest) <= motion.rounding(longest) => Ok(motion),
            averaged => Self::exact(problem, longest).or_else(|refused| averaged.map_err(|_| refused)),
        }
    }

    /// The motion accurate to rounding, for times up to `longest` in size: on the torus. A free motion is uniform. If there is no torus, as for `n`
    /// along `L` or for a star with a bulge, it is the averaged motion if its truncation error is below rounding at the start, or a steady one.
    ///
    /// # Errors
    /// As for [`TorusSolution::new`]; [`Error::Domain`] for a star with a bulge whose averaged motion is not so accurate.
    pub fn exact(problem: &Problem<f64>, longest: f64) -> Result<Self, Error> {
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        let uniform = |motion| Self { problem: *problem, solution: Solution::Uniform(motion) };
        let free = UniformMotion::free(problem, everywhere);
        if free.truncation(1.0) == 0.0 {
            return Ok(uniform(free));
        }
        let is_exact = |motion: &Self| motion.truncation(0.0) <= motion.rounding(0.0);
        if problem.require_rigid().is_err() {
            let motion = Self::averaged(problem)?;
            Error::ensure(
                is_exact(&motion),
                "error (rad) of the averaged motion, the only one of a star with a bulge",
                motion.truncation(0.0),
                "at most the rounding error; it is smaller for weaker coefficients",
            )?;
            return Ok(motion);
        }
        Self::torus(problem, longest).or_else(|refused| {
            let averaged = Self::averaged(problem).ok().filter(is_exact);
            let steady = || UniformMotion::steady(problem, everywhere).ok().map(uniform);
            averaged.or_else(steady).ok_or(refused)
        })
    }

    /// The averaged motion.
    ///
    /// # Errors
    /// As for [`AveragedMotion::new`]; [`Error::Domain`] on the separatrix, where the slow precession has no period.
    pub fn averaged(problem: &Problem<f64>) -> Result<Self, Error> {
        let motion = AveragedMotion::new(problem, (0.0, f64::INFINITY))?;
        let complement = motion.mean.top().complement();
        Error::ensure(
            complement > 0.0,
            "distance k' of L from the separatrix",
            complement,
            "above zero; on the separatrix L precesses about no axis",
        )?;
        Ok(Self { problem: *problem, solution: Solution::Averaged(motion) })
    }

    /// The exact motion, to rounding, on the torus, for times up to `longest` in size.
    ///
    /// # Errors
    /// As for [`TorusSolution::new`].
    pub fn torus(problem: &Problem<f64>, longest: f64) -> Result<Self, Error> {
        Ok(Self { problem: *problem, solution: Solution::Torus(TorusSolution::new(problem, 0.0, longest)?) })
    }

    /// Rates of the phases (rad per unit of time): on the torus the rates of its angles; for an averaged motion those of the rotation about `L`, of
    /// `L` about its axis, and of `e_x` about `n`.
    pub(crate) fn rates(&self) -> [f64; 3] {
        match &self.solution {
            Solution::Averaged(motion) => {
                let rates = &motion.mean.rates;
                [rates.about_momentum, rates.slow, rates.about_axis]
            }
            Solution::Torus(torus) => torus.rates(),
            Solution::Uniform(motion) => motion.rates(),
        }
    }

    /// The rates in turns per unit of time, to 32 digits where they are known to that precision.
    pub(crate) fn turns_per_time(&self) -> [DoubleDouble; 3] {
        match &self.solution {
            Solution::Torus(torus) => torus.turns_per_time(),
            Solution::Averaged(motion) => motion.mean.turns_per_time(),
            Solution::Uniform(motion) => motion.rates().map(|rate| DoubleDouble::from(rate / TAU)),
        }
    }

    /// Rate (rad per unit of time) at which the averaged `L` circles the [pole](Self::pole), in the right-handed sense; `None` on a torus, where any
    /// basis may serve for the angles.
    pub(crate) fn precession_of_momentum(&self) -> Option<f64> {
        match &self.solution {
            // Avoids minus zero if `L` stays fixed.
            Solution::Averaged(motion) => Some(motion.mean.top().rate_about_axis() * direction_of(&self.axis()) + 0.0),
            Solution::Torus(_) => None,
            Solution::Uniform(_) => Some(0.0),
        }
    }

    /// The pole of the angles `alpha` and `gamma`: the principal axis of `s^IJ` that `L` circles, directed so that its largest component is positive
    /// (of several equal ones the first), or Z if `L` stays fixed.
    pub(crate) fn pole(&self) -> Vector3<f64> {
        let axis = self.axis();
        axis * direction_of(&axis)
    }

    /// The axis of the [pole](Self::pole), in either direction.
    fn axis(&self) -> Vector3<f64> {
        match &self.solution {
            Solution::Averaged(motion) => motion.given_from_principal.column(motion.mean.top().axis()).into(),
            Solution::Torus(torus) => torus.pole(),
            Solution::Uniform(motion) => motion.pole(),
        }
    }

    /// The phases at the time `t[0] + t[1]`.
    pub(crate) fn turns(&self, t: [f64; 2]) -> [Turns; 3] {
        match &self.solution {
            Solution::Averaged(motion) => {
                let turns = motion.mean.turns(t);
                [turns.about_momentum, turns.slow, turns.about_axis]
            }
            Solution::Torus(torus) => torus.angles(t),
            Solution::Uniform(_) => {
                self.turns_per_time().map(|rate| Turns::at(0.0, rate, DoubleDouble::sum(t[0], t[1])))
            }
        }
    }

    /// The state at given phases (in turns), in the frame of the initial state.
    pub(crate) fn state_at(&self, turns: [f64; 3]) -> BodyState<f64> {
        match &self.solution {
            Solution::Averaged(motion) => {
                let [about_momentum, slow, about_axis] = turns.map(|turns| turns * TAU);
                motion.state_of(&OfRotations { slow, about_momentum, about_axis })
            }
            Solution::Torus(torus) => torus.state_on_torus(turns),
            Solution::Uniform(motion) => motion.state_after_turns([turns[0], turns[2]]),
        }
    }

    /// The state at the time `t[0] + t[1]`.
    pub fn state(&self, t: [f64; 2]) -> BodyState<f64> {
        match &self.solution {
            Solution::Averaged(motion) => motion.state_of(&motion.mean.phases_at(t)),
            Solution::Torus(torus) => torus.state(t),
            Solution::Uniform(_) => self.state_at(self.turns(t).map(|turns| turns.fraction)),
        }
    }

    /// Truncation error of directions (rad) at the time `t`: due to the order of the averaged motion, or the length of the series on the
    /// torus.
    pub fn truncation(&self, t: f64) -> f64 {
        match &self.solution {
            Solution::Averaged(motion) => motion.mean.truncation(t),
            Solution::Torus(torus) => torus.truncation(),
            Solution::Uniform(motion) => motion.truncation(t),
        }
    }

    /// Rounding of directions (rad) at the time `t`.
    pub fn rounding(&self, t: f64) -> f64 {
        match &self.solution {
            Solution::Averaged(motion) => motion.mean.rounding(t),
            Solution::Torus(torus) => torus.rounding(t),
            Solution::Uniform(motion) => motion.rounding(t),
        }
    }

    /// Estimated error of directions (rad) at the time `t`.
    pub fn error_estimate(&self, t: f64) -> f64 {
        self.truncation(t) + self.rounding(t)
    }
}

/// The sign of the first of the largest components of an axis; components that are equal to a millionth count as equal, so that rounding does not
/// decide.
fn direction_of(axis: &Vector3<f64>) -> f64 {
    let largest = axis.amax();
    axis.iter().find(|component| component.abs() >= (1.0 - 1e-6) * largest).map_or(1.0, |component| component.signum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::RotationState;
    use crate::dynamics::fixture::{STAR, problem, tensor};
    use crate::propagation::Motion;

    #[test]
    fn rounding_does_not_choose_the_direction_of_an_axis() {
        for off in [-1e-15, 0.0, 1e-15] {
            assert_eq!(direction_of(&Vector3::new(1.0 + off, -1.0, 0.0)), 1.0);
            assert_eq!(direction_of(&Vector3::new(-1.0, 1.0 + off, 1.0 - off)), -1.0);
            assert_eq!(direction_of(&Vector3::new(0.1, off, -0.9)), -1.0);
        }
    }

    /// One rotation about `L` in 2 pi I^xx / |L|, and a backward one about `n` due to the oblateness; `L` itself does not
    /// move.
    #[test]
    fn a_free_motion_is_uniform_at_any_time() {
        let problem = problem([0.0; 3]);
        let motion = PhasedMotion::exact(&problem, 1e12).unwrap();
        assert!(matches!(motion.solution, Solution::Uniform(_)));
        assert_eq!(motion.precession_of_momentum(), Some(0.0));
        let BodyState { axis, momentum, .. } = problem.initial();
        let spin = momentum.dot(axis) / STAR.inertia_zz;
        let rates = [momentum.norm() / STAR.inertia_xx, -STAR.oblateness() * spin];
        assert!(
            (motion.rates()[0] / rates[0] - 1.0).abs() < 1e-15 && (motion.rates()[2] / rates[1] - 1.0).abs() < 1e-15
        );
        for t in [[12.5, 0.25], [-3e3, 1e-14], [1e3, 7.5]] {
            let turns = motion.turns(t);
            for (turns, rate) in [turns[0], turns[2]].into_iter().zip(rates) {
                let expected = rate * (t[0] + t[1]) / TAU;
                assert!((turns.whole as f64 + turns.fraction - expected).abs() < 1e-15 * (1.0 + expected.abs()));
                assert!(turns.fraction.abs() <= 0.5);
            }
            let by_series = problem.taylor((0.0, t[0] + t[1]), 1e-16).unwrap().state(t[0] + t[1]).unwrap();
            for (found, expected) in motion.state(t).vectors().iter().zip(by_series.vectors()) {
                assert!((found - expected).amax() < 1e-12 * (1.0 + t[0].abs() / 1e3), "{found} {expected}");
            }
        }
        // Seconds that are below the rounding of a long time still advance the phase.
        let [first, later] = [[1e9, 0.0], [1e9, 1e-8]].map(|t| motion.turns(t)[0].fraction);
        assert!(((later - first) * TAU / rates[0] / 1e-8 - 1.0).abs() < 1e-6);
    }

    /// `L` on the middle axis has no torus nearby: for a weak torque the averaged motion is accurate to rounding, and for a strong torque the
    /// motion is refused.
    #[test]
    fn without_a_torus_a_motion_is_averaged_or_refused() {
        for (strength, is_there) in [(1e-10, true), (0.02, false)] {
            let (axis, equatorial_axis) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.8, 0.0, -0.6));
            let start = BodyState { axis, momentum: Vector3::y() * 1.7, equatorial_axis };
            let problem = Problem::new(STAR, tensor([1.0, 0.5, -1.5]) * strength, start).unwrap();
            match PhasedMotion::exact(&problem, 1.0).map(|motion| motion.solution) {
                Ok(Solution::Averaged(_)) => assert!(is_there),
                Err(Error::Unsupported { .. }) => assert!(!is_there),
                _ => panic!("{strength}: another motion, or refused for another reason"),
            }
        }
    }

    /// The error in the refusal is that at the start; the error of the phases grows with time.
    #[test]
    fn a_strong_torque_on_a_bulge_is_refused_with_the_error_at_the_start() {
        let problem = problem([0.02, 0.01, -0.03]).with_bulge(0.2).unwrap();
        let averaged = PhasedMotion::averaged(&problem).unwrap();
        assert!(averaged.truncation(1.0) > 1.01 * averaged.truncation(0.0));
        match PhasedMotion::exact(&problem, 1.0) {
            Err(Error::Domain { value, .. }) => assert_eq!(value, averaged.truncation(0.0)),
            other => panic!("{other:?}"),
        }
    }

    /// Without a torus and without an averaged motion the reason is that of the torus.
    #[test]
    fn the_torus_says_why_there_is_no_motion() {
        let axis = Vector3::new(1e-9, 1.0, 0.0);
        let start = BodyState { axis, momentum: axis * 1e-3, equatorial_axis: Vector3::z() };
        let problem = Problem::new(STAR, tensor([0.2, 0.1, -0.3]), start).unwrap();
        let refused = PhasedMotion::new(&problem, 1e3).expect_err("an unstable rest");
        assert!(matches!(refused, Error::Unsupported { why, .. } if why.contains("nearly at rest")), "{refused}");
    }
}
