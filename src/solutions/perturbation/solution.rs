//! First-order solutions for the Euler angles. Eqs. (27), (28), (30)-(33), (57).

use crate::dynamics::RigidSpheroid;
use crate::dynamics::euler_angle_equations::AxisAngles;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::{Real, Scalar};
use crate::solutions::perturbation::{Constants, Form, Precession};

/// A first-order solution: the numbers of Eqs. (28), (31) `[consdef]`, (32) `[precangvel]` for given constants.
///
/// ```text
/// alpha  = alpha_0 + a t + (h A / nu) cos(nu t + phi) + eta_alpha C~/(2a) sin 2(a t + alpha_0)
/// beta   = beta_0        + (A / nu)   sin(nu t + phi) - eta_beta  C~/(2a) cos 2(a t + alpha_0)
/// ```
///
/// with the constants of [`Perturbation::new`]. `C~`, `a^(1)` and `a` are those of the paper in both forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perturbation<S> {
    /// The kind of precession.
    pub kind: Precession,
    /// Constants of integration.
    pub constants: Constants<S>,
    /// `omega = I^zz Omega^z / I^xx`, Eq. (28).
    pub omega: S,
    /// Precession rate `a` with the shift absorbed, Eq. (32) `[precangvel]`.
    pub rate: S,
    /// Precession rate at zeroth order, `omega / cos beta_0` or zero, Eq. (28).
    pub zeroth_rate: S,
    /// Forced precession `a^(1)`, Eq. (31) `[consdef]`.
    pub forced_rate: S,
    /// `C~ = C (s^XX - s^YY) / (I^zz Omega^z)`, Eq. (31) `[consdef]`.
    pub c_tilde: S,
    /// `eta_alpha`, Eq. (31) `[consdef]` or corrected.
    pub eta_alpha: S,
    /// `eta_beta`, Eq. (31) `[consdef]` or corrected.
    pub eta_beta: S,
    /// Frequency `nu` of the homogeneous solution.
    pub homogeneous_frequency: S,
    /// Ratio `h` of the homogeneous rates of `alpha` and `beta`.
    pub homogeneous_ratio: S,
}

impl<S: Scalar> Perturbation<S> {
    /// The solution without checks of its domain, for exact fields: see [`new`](Self::new).
    pub fn new_unchecked(
        form: Form,
        kind: Precession,
        spheroid: &RigidSpheroid<S>,
        s: &PrincipalCoefficients<S>,
        spin: S,
        constants: &Constants<S>,
    ) -> Self {
        let (sb, cb) = constants.beta_0.sin_cos();
        let omega = spheroid.free_precession_constant(spin);
        let momentum = spheroid.inertia_zz * spin;
        let forced_rate = spheroid.constant_c * s.combination() * cb / momentum;
        let c_tilde = spheroid.constant_c * s.asymmetry() / momentum;
        let one = S::one();
        let (zeroth_rate, rate) = match kind {
            Precession::Twofold => (omega / cb, omega / cb - forced_rate),
            Precession::Single => (S::zero(), forced_rate),
        };
        let (eta_alpha, eta_beta, homogeneous_frequency, homogeneous_ratio) = match (form, kind) {
            (Form::Printed, Precession::Twofold) => {
                let denominator = one * 4.0 - cb * cb;
                (cb * (one * 2.0 + cb * cb) / denominator, sb * cb * cb * 3.0 / denominator, omega, one / sb)
            }
            (Form::Corrected, Precession::Twofold) => (cb * (one + cb * cb) / 2.0, sb * cb * cb, rate, cb / sb),
            (Form::Printed, Precession::Single) => (cb, sb, omega, -one / sb),
            (Form::Corrected, Precession::Single) => ((one + cb * cb) / (cb * 2.0), sb, omega, -one / sb),
        };
        Self {
            kind,
            constants: *constants,
            omega,
            rate,
            zeroth_rate,
            forced_rate,
            c_tilde,
            eta_alpha,
            eta_beta,
            homogeneous_frequency,
            homogeneous_ratio,
        }
    }

    /// First-order parts `(alpha1, beta1)`, Eq. (33) `[sol3]`, at given phases `nu t + phi` and `a t + alpha_0`.
    pub fn first_order(&self, homogeneous_phase: S, forced_phase: S) -> (S, S) {
        let (sin, cos) = homogeneous_phase.sin_cos();
        let (sin_2, cos_2) = doubled(forced_phase);
        let free = self.constants.amplitude / self.homogeneous_frequency;
        let forced = self.c_tilde / self.rate / 2.0;
        (
            free * self.homogeneous_ratio * cos + forced * self.eta_alpha * sin_2,
            free * sin - forced * self.eta_beta * cos_2,
        )
    }

    /// Rates of the first-order parts, Eq. (30) `[sol2]` without its constant `-+a^(1)`, which `a` has absorbed, at given
    /// phases `nu t + phi` and `a t + alpha_0`.
    pub fn first_order_rates(&self, homogeneous_phase: S, forced_phase: S) -> (S, S) {
        let (sin, cos) = homogeneous_phase.sin_cos();
        let (sin_2, cos_2) = doubled(forced_phase);
        let amplitude = self.constants.amplitude;
        (
            self.c_tilde * self.eta_alpha * cos_2 - amplitude * self.homogeneous_ratio * sin,
            amplitude * cos + self.c_tilde * self.eta_beta * sin_2,
        )
    }

    /// Angles and rates at time `t`, Eqs. (27) `[ansatz]`, (30) `[sol2]`, (33) `[sol3]`; at `t = 0` these are the initial
    /// values (34) `[integraltoinitial]`.
    pub fn at(&self, t: S) -> AxisAngles<S> {
        let homogeneous_phase = self.homogeneous_frequency * t + self.constants.phase;
        let forced_phase = self.rate * t + self.constants.alpha_0;
        let (alpha, beta) = self.first_order(homogeneous_phase, forced_phase);
        let (alpha_rate, beta_rate) = self.first_order_rates(homogeneous_phase, forced_phase);
        AxisAngles {
            alpha: forced_phase + alpha,
            beta: self.constants.beta_0 + beta,
            alpha_rate: self.rate + alpha_rate,
            beta_rate,
        }
    }
}

impl<S: Real> Perturbation<S> {
    /// The solution with the given constants of integration. Eqs. (28), (30)-(33) `[sol2]` `[consdef]` `[precangvel]`
    /// `[sol3]`, with `b0 = beta_0`:
    ///
    /// | form, kind | `eta_alpha` | `eta_beta` | `nu` | `h` |
    /// |---|---|---|---|---|
    /// | printed, twofold | `cos b0 (2 + cos^2 b0) / (4 - cos^2 b0)` | `3 sin b0 cos^2 b0 / (4 - cos^2 b0)` | `omega` | `1 / sin b0` |
    /// | corrected, twofold | `cos b0 (1 + cos^2 b0) / 2` | `sin b0 cos^2 b0` | `a` | `cos b0 / sin b0` |
    /// | printed, single | `cos b0` | `sin b0` | `omega` | `-1 / sin b0` |
    /// | corrected, single | `(1 + cos^2 b0) / (2 cos b0)` | `sin b0` | `omega` | `-1 / sin b0` |
    ///
    /// Errors. Twofold: of first order in `s` and in `A / omega` as printed, of second order corrected; both grow with time. Single,
    /// over one forced period: of first order in `r = (s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)` as printed, of second order in `r`
    /// corrected; both also have an error of first order in `s`. `r` is the size of `alpha1` and `beta1`.
    ///
    /// # Errors
    /// [`Error::Domain`] where `sin beta_0` or `cos beta_0` is not above 2.2e-16 in size, where the spin is zero,
    /// and where `a`, by which Eq. (33) divides, vanishes.
    pub fn new(
        form: Form,
        kind: Precession,
        spheroid: &RigidSpheroid<S>,
        s: &PrincipalCoefficients<S>,
        spin: S,
        constants: &Constants<S>,
    ) -> Result<Self, Error> {
        check_domain(spin, constants.beta_0)?;
        Self::new_unchecked(form, kind, spheroid, s, spin, constants).with_nonzero_rate(spheroid, s, spin)
    }

    /// Refuses a rate `a` that vanishes up to the rounding of the terms of Eqs. (31) and (32).
    fn with_nonzero_rate(
        self,
        spheroid: &RigidSpheroid<S>,
        s: &PrincipalCoefficients<S>,
        spin: S,
    ) -> Result<Self, Error> {
        let (_, cb) = self.constants.beta_0.sin_cos();
        let coefficients = s.xx.abs() + s.yy.abs() + s.zz.abs() * 2.0;
        let forced_terms = (spheroid.constant_c * coefficients * cb / (spheroid.inertia_zz * spin)).re().abs();
        let terms = self.zeroth_rate.re().abs() + forced_terms;
        let rate = self.rate.re();
        Error::ensure(
            rate.abs() > 4.0 * f64::EPSILON * terms,
            "precession rate a of Eq. (32)",
            rate,
            "nonzero beyond rounding; Eq. (33) divides by it (for single precession 2 s^ZZ - s^XX - s^YY must not vanish)",
        )?;
        Ok(self)
    }
}

/// Mean rates of the perturbation solutions, Eq. (57) `[tpconstant]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShiftedRates<S> {
    /// Mean rate of `alpha`: `a`.
    pub alpha: S,
    /// Mean rate of `gamma`: `Omega^z - a cos beta_0`, for twofold precession `-epsilon Omega^z + cos beta_0 a^(1)`.
    pub gamma: S,
}

/// Shifted rates `a' ~ a`, `g' ~ -epsilon Omega^z + cos(beta_0) a^(1)` of twofold precession, Eq. (57) `[tpconstant]`.
///
/// # Errors
/// [`Error::Domain`] as for [`Perturbation::new`], except that the rate may vanish.
pub fn shifted_rates<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    beta_0: S,
) -> Result<ShiftedRates<S>, Error> {
    check_domain(spin, beta_0)?;
    let (_, cb) = beta_0.sin_cos();
    let forced_rate = spheroid.constant_c * s.combination() * cb / (spheroid.inertia_zz * spin);
    Ok(ShiftedRates {
        alpha: spheroid.free_precession_constant(spin) / cb - forced_rate,
        gamma: cb * forced_rate - spheroid.oblateness() * spin,
    })
}

fn check_domain<S: Real>(spin: S, beta_0: S) -> Result<(), Error> {
    let (sb, cb) = beta_0.sin_cos();
    Error::ensure(
        sb.re().abs() > f64::EPSILON,
        "sine of the mean inclination, sin beta_0",
        sb.re(),
        "above 2.2e-16 in size; Eqs. (30)-(34) divide by it",
    )?;
    Error::ensure(
        cb.re().abs() > f64::EPSILON,
        "cosine of the mean inclination, cos beta_0",
        cb.re(),
        "above 2.2e-16 in size; twofold precession has the rate omega / cos beta_0, and single precession has none at a right angle",
    )?;
    Error::ensure(spin.re() != 0.0, "spin Omega^z", spin.re(), "nonzero; Eq. (31) divides by it")
}

/// Sine and cosine of twice the angle.
fn doubled<S: Scalar>(angle: S) -> (S, S) {
    let (sin, cos) = angle.sin_cos();
    (sin * cos * 2.0, cos * cos - sin * sin)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;

    use super::*;

    /// The cosine of the double nearest to a right angle is its rounding.
    #[test]
    fn neither_precession_has_a_rate_at_a_right_angle() {
        let (star, s) = (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new([0.02, 0.01, -0.04]));
        for kind in [Precession::Single, Precession::Twofold] {
            let at = |beta_0: f64| {
                let constants = Constants { alpha_0: 0.3, beta_0, amplitude: 0.0, phase: 0.0 };
                Perturbation::new(Form::Printed, kind, &star, &s, 1.0, &constants)
            };
            assert!(at(FRAC_PI_2).is_err() && at(FRAC_PI_2 - 1e-15).is_ok(), "{kind:?}");
        }
    }
}
