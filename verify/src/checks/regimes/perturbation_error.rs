//! Error of a perturbation solution against the numerical motion from the same initial values.

use std::f64::consts::FRAC_PI_2;

use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates, symmetry_axis};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{ContinuousAngles, Motion, TaylorMotion, propagate};
use twofold::solutions::perturbation::{Constants, Kind, Perturbation};

use crate::check::largest;

/// Which perturbation solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Eqs. (30)-(33) as printed.
    Printed(Kind),
    /// The corrected first-order twofold solution.
    CorrectedTwofold,
}

/// The numbers of one comparison, those of the paper's examples unless changed.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Solution under test.
    pub form: Form,
    /// Eigenvalues of `s^IJ`.
    pub s: PrincipalCoefficients<f64>,
    /// Mean inclination.
    pub beta_0: f64,
    /// Amplitude `A`.
    pub amplitude: f64,
}

impl Case {
    /// The paper's numbers with `s` scaled by `k`.
    pub fn paper(form: Form, k: f64, beta_0: f64, amplitude: f64) -> Self {
        Self { form, s: PrincipalCoefficients::new([0.02, 0.01, -0.04]).scaled(k), beta_0, amplitude }
    }

    /// The solution under test.
    pub fn solution(&self) -> Result<Perturbation<f64>, String> {
        let (spheroid, spin) = (RigidSpheroid::in_units_of_tc(1.1), 1.0);
        let constants =
            Constants { alpha_0: FRAC_PI_2, beta_0: self.beta_0, amplitude: self.amplitude, phase: FRAC_PI_2 };
        match self.form {
            Form::Printed(kind) => Perturbation::printed(kind, &spheroid, &self.s, spin, &constants),
            Form::CorrectedTwofold => Perturbation::corrected_twofold(&spheroid, &self.s, spin, &constants),
        }
        .map_err(|e| e.to_string())
    }

    /// The numerical motion with the initial values of the solution.
    pub fn motion(&self, duration: f64) -> Result<(TaylorMotion<f64>, EulerAngles<f64>), String> {
        let spheroid = RigidSpheroid::in_units_of_tc(1.1);
        let start = self.solution()?.at(0.0);
        let angles = EulerAngles { alpha: start.alpha, beta: start.beta, gamma: 0.0 };
        let rates = EulerRates {
            alpha: start.alpha_rate,
            beta: start.beta_rate,
            gamma: 1.0 - start.alpha_rate * start.beta.cos(),
        };
        let initial = BodyState::from_angles(&spheroid, &angles, &rates);
        let motion =
            propagate(&spheroid, &self.s.tensor(), &initial, (0.0, duration), 1e-15).map_err(|e| e.to_string())?;
        Ok((motion, angles))
    }

    /// Largest errors over `duration`.
    pub fn errors(&self, duration: f64, samples: u32) -> Result<Errors, String> {
        let solution = self.solution()?;
        let (motion, start) = self.motion(duration)?;
        let mut angles = ContinuousAngles::new(&motion, 0.0, &start).map_err(|e| e.to_string())?;
        let mut errors = Errors::default();
        for i in 0..=samples {
            let t = duration * f64::from(i) / f64::from(samples);
            let (exact, approximate) = (angles.at(t).map_err(|e| e.to_string())?, solution.at(t));
            let axis = motion.state(t).map_err(|e| e.to_string())?.axis;
            errors.alpha = largest([errors.alpha, (exact.alpha - approximate.alpha).abs()]);
            errors.beta = largest([errors.beta, (exact.beta - approximate.beta).abs()]);
            errors.axis = largest([errors.axis, (axis - symmetry_axis(approximate.alpha, approximate.beta)).norm()]);
        }
        Ok(errors)
    }
}

/// Largest errors of a solution over a span (rad).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Errors {
    /// Of the precession angle.
    pub alpha: f64,
    /// Of the inclination.
    pub beta: f64,
    /// Distance between the heads of the true and the approximate symmetry axis.
    pub axis: f64,
}
