//! The paper's four examples, tp-I, tp-II, sp-I and sp-II.

use crate::prelude::*;

/// `Omega^z` of all four examples [1/t_c].
pub const SPIN: f64 = 1.0;

/// Eigenvalues `s^XX, s^YY, s^ZZ` of all four examples.
pub const COEFFICIENTS: PrincipalCoefficients<f64> = PrincipalCoefficients { xx: 0.02, yy: 0.01, zz: -0.04 };

/// The body of all four examples, `I^zz / I^xx = 1.1` in units `I^xx = C = 1`.
pub fn spheroid() -> RigidSpheroid<f64> {
    RigidSpheroid::in_units_of_tc(1.1)
}

/// One example by its constants of integration.
#[derive(Debug, Clone, Copy)]
pub struct PaperExample {
    /// Name in the paper.
    pub name: &'static str,
    /// Twofold or single precession.
    pub kind: Precession,
    /// Constants of integration in Eq. (34).
    pub constants: Constants<f64>,
}

impl PaperExample {
    /// Initial angles and rates by Eq. (34).
    ///
    /// # Errors
    /// None for the four examples.
    pub fn initial_values(&self) -> Result<AxisAngles<f64>, twofold::Error> {
        Ok(Perturbation::new(Form::Printed, self.kind, &spheroid(), &COEFFICIENTS, SPIN, &self.constants)?.at(0.0))
    }

    /// The problem, with `gamma = 0` at the start.
    ///
    /// # Errors
    /// None for the four examples.
    pub fn problem(&self) -> Result<Problem<f64>, twofold::Error> {
        problem_from(&COEFFICIENTS, &self.initial_values()?)
    }
}

/// The star of the examples with other coefficients, from given angles and rates, `gamma = 0` and the spin of the examples.
pub(crate) fn problem_from(
    s: &PrincipalCoefficients<f64>,
    start: &AxisAngles<f64>,
) -> Result<Problem<f64>, twofold::Error> {
    let angles = EulerAngles { alpha: start.alpha, beta: start.beta, gamma: 0.0 };
    let gamma_rate = SPIN - start.alpha_rate * start.beta.cos();
    let rates = EulerRates { alpha: start.alpha_rate, beta: start.beta_rate, gamma: gamma_rate };
    Problem::from_angles(spheroid(), s.tensor(), &angles, &rates)
}

/// The four examples in the paper's order.
pub fn paper_examples() -> [PaperExample; 4] {
    let example = |name, kind, beta_0, amplitude| PaperExample {
        name,
        kind,
        constants: Constants { alpha_0: FRAC_PI_2, beta_0, amplitude, phase: FRAC_PI_2 },
    };
    [
        example("tp-I", Precession::Twofold, 0.7, 0.0),
        example("tp-II", Precession::Twofold, 0.7, 0.4),
        example("sp-I", Precession::Single, 0.7, 0.01),
        example("sp-II", Precession::Single, 1.4, 0.01),
    ]
}
