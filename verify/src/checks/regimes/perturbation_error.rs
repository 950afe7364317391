//! Error of a perturbation solution against the numerical motion from the same initial values.

use crate::paper_examples::problem_from;
use crate::prelude::*;

/// The parameters of one comparison, those of the paper's examples unless changed.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Form of the solution.
    pub form: Form,
    /// Its kind of precession.
    pub kind: Precession,
    /// Eigenvalues of `s^IJ`.
    pub s: PrincipalCoefficients<f64>,
    /// Mean inclination.
    pub beta_0: f64,
    /// Amplitude `A`.
    pub amplitude: f64,
}

impl Case {
    /// The paper's numbers with `s` scaled by `k`.
    pub fn paper(form: Form, kind: Precession, k: f64, beta_0: f64, amplitude: f64) -> Self {
        Self { form, kind, s: COEFFICIENTS.scaled(k), beta_0, amplitude }
    }

    /// The solution under test.
    pub fn solution(&self) -> Result<Perturbation<f64>, String> {
        let constants =
            Constants { alpha_0: FRAC_PI_2, beta_0: self.beta_0, amplitude: self.amplitude, phase: FRAC_PI_2 };
        Perturbation::new(self.form, self.kind, &spheroid(), &self.s, SPIN, &constants).map_err(String::from)
    }

    /// The problem with the initial values of the solution and `gamma = 0`.
    pub fn problem(&self) -> Result<Problem<f64>, String> {
        Ok(problem_from(&self.s, &self.solution()?.at(0.0))?)
    }

    /// The numerical motion with the initial values of the solution.
    pub fn motion(&self, duration: f64) -> Result<TaylorMotion<f64>, String> {
        Ok(self.problem()?.taylor((0.0, duration), 1e-15)?)
    }

    /// The averaged motion of second order with the same initial values, for small `s`.
    pub fn averaged_motion(&self, duration: f64) -> Result<AveragedMotion<f64>, String> {
        Ok(AveragedMotion::new(&self.problem()?, (0.0, duration))?)
    }

    /// Largest distance of the heads of the axes over one forced period from the averaged motion, for `s` so small that the
    /// period is long.
    pub fn axis_error_over_forced_period(&self, samples: u32) -> Result<f64, String> {
        let solution = self.solution()?;
        let period = TAU / solution.rate.abs();
        let motion = self.averaged_motion(period)?;
        largest_of((0..=samples).map(|i| {
            let t = (period * f64::from(i) / f64::from(samples)).min(period);
            Ok((motion.axis_state(t)?.axis - axis_at(&solution, t)).norm())
        }))
    }

    /// Largest errors over one forced period `2 pi / |a|`, from 1000 samples.
    pub fn errors_over_forced_period(&self) -> Result<Errors, String> {
        self.errors(TAU / self.solution()?.rate.abs(), 1000)
    }

    /// Largest errors over `duration`.
    pub fn errors(&self, duration: f64, samples: u32) -> Result<Errors, String> {
        let solution = self.solution()?;
        let motion = self.motion(duration)?;
        let AxisAngles { alpha, beta, .. } = solution.at(0.0);
        let mut angles = ContinuousAngles::new(&motion, 0.0, &EulerAngles { alpha, beta, gamma: 0.0 })?;
        let mut errors = Errors::default();
        for i in 0..=samples {
            let t = duration * f64::from(i) / f64::from(samples);
            let (exact, approximate) = (angles.at(t)?, solution.at(t));
            let axis = motion.state(t)?.axis;
            errors.alpha = largest([errors.alpha, (exact.alpha - approximate.alpha).abs()]);
            errors.beta = largest([errors.beta, (exact.beta - approximate.beta).abs()]);
            errors.axis = largest([errors.axis, (axis - axis_at(&solution, t)).norm()]);
        }
        Ok(errors)
    }
}

/// The symmetry axis by a perturbation solution.
pub fn axis_at(solution: &Perturbation<f64>, t: f64) -> Vector3<f64> {
    let angles = solution.at(t);
    symmetry_axis(angles.alpha, angles.beta)
}

/// Largest errors of a solution over a span (rad).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Errors {
    /// Error of the precession angle.
    pub alpha: f64,
    /// Error of the inclination.
    pub beta: f64,
    /// Distance between the heads of the true and the approximate symmetry axis.
    pub axis: f64,
}
