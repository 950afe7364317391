//! A star, its beam and its observer as named parameters, for derivatives and fits.
//!
//! A change of one [`Parameter`] keeps all other numbers of [`Parameters`] fixed. The struct stores either the rate of `gamma` or
//! `Omega^z = gamma' + alpha' cos(beta)`, as its [`ThirdRate`]; the one that is stored stays fixed when `beta` or `alpha'` change.
//!
//! # Example
//!
//! ```
//! use nalgebra::Matrix3;
//! use twofold::dynamics::RigidSpheroid;
//! use twofold::euler_angles::{EulerAngles, EulerRates};
//! use twofold::parameters::{Parameter, Parameters};
//!
//! let star = RigidSpheroid::in_units_of_tc(1.1);
//! let (angles, rates) = (EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 }, EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 });
//! let parameters = Parameters::new(star, Matrix3::zeros(), angles, rates);
//! // The spin with beta a little larger: with gamma' held, and with Omega^z held.
//! let spin = |parameters: Parameters<f64>| parameters.moved(&[Parameter::Beta], &[0.01]).spin() - parameters.spin();
//! assert!((spin(parameters) - 1.4 * (0.71_f64.cos() - 0.7_f64.cos())).abs() < 1e-15);
//! assert_eq!(spin(parameters.with_fixed_spin()), 0.0);
//! ```

mod parameter;

pub use parameter::Parameter;

use nalgebra::Matrix3;
use num_dual::Dual64;

use crate::dynamics::{BodyState, Problem, RigidSpheroid};
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::numerics::scalar::{Real, Scalar};
use crate::observables::Observer;
use crate::observables::pulsar::Beam;

/// The rate that stays fixed when `beta` or the rate of `alpha` change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ThirdRate<S> {
    /// Rate of `gamma`.
    Gamma(S),
    /// `Omega^z`.
    Spin(S),
}

/// All numbers that motions and data depend on. Time and length may be in any units; in fits `I^xx = 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters<S> {
    /// The body.
    pub spheroid: RigidSpheroid<S>,
    /// `s^IJ`.
    pub coefficients: Matrix3<S>,
    /// Coefficient `b` of the energy `b L.(s L)` of a centrifugal [`bulge`](crate::dynamics::bulge), initially zero; not a
    /// parameter.
    pub bulge: S,
    /// Factor by which `s^IJ` has been multiplied, initially one.
    pub s_scale: S,
    /// Initial Euler angles.
    pub angles: EulerAngles<S>,
    /// Initial rate of `alpha`.
    pub alpha_rate: S,
    /// Initial rate of `beta`.
    pub beta_rate: S,
    /// Initial rate of `gamma`, or initial `Omega^z`.
    pub third_rate: ThirdRate<S>,
    /// Angle of the magnetic axis to the symmetry axis, Eq. (45).
    pub chi: S,
    /// Azimuth of the magnetic axis in the body.
    pub delta: S,
    /// Semi-open angle of the beam.
    pub rho: S,
    /// Colatitude of the observer, Eq. (46).
    pub theta_o: S,
    /// Azimuth of the observer.
    pub phi_o: S,
    /// Factor by which the strain has been multiplied, initially one.
    pub strain_scale: S,
    /// Strain that corresponds to `h = 1` at `r = 1`, not a parameter.
    pub strain_unit: f64,
}

impl<S: Scalar> Parameters<S> {
    /// The parameters of a body with its initial values, with the rate of `gamma` held fixed. Beam and observer get placeholder values until
    /// their fields are set: a motion does not depend on them.
    pub fn new(
        spheroid: RigidSpheroid<S>,
        coefficients: Matrix3<S>,
        angles: EulerAngles<S>,
        rates: EulerRates<S>,
    ) -> Self {
        let [zero, half, one] = [0.0, 0.5, 1.0].map(S::from_f64);
        Self {
            spheroid,
            coefficients,
            bulge: zero,
            s_scale: one,
            angles,
            alpha_rate: rates.alpha,
            beta_rate: rates.beta,
            third_rate: ThirdRate::Gamma(rates.gamma),
            chi: half,
            delta: zero,
            rho: half,
            theta_o: half,
            phi_o: zero,
            strain_scale: one,
            strain_unit: 1.0,
        }
    }

    /// The same parameters with `Omega^z` held fixed instead of the rate of `gamma`.
    pub fn with_fixed_spin(self) -> Self {
        Self { third_rate: ThirdRate::Spin(self.spin()), ..self }
    }

    /// The same parameters with the rate of `gamma` held fixed.
    pub(crate) fn holding_gamma_rate(self) -> Self {
        Self { third_rate: ThirdRate::Gamma(self.rates().gamma), ..self }
    }

    /// `Omega^z`.
    pub fn spin(&self) -> S {
        match self.third_rate {
            ThirdRate::Gamma(rate) => rate + self.alpha_rate * self.angles.beta.sin_cos().1,
            ThirdRate::Spin(spin) => spin,
        }
    }

    /// Initial Euler rates.
    pub(crate) fn rates(&self) -> EulerRates<S> {
        let gamma = match self.third_rate {
            ThirdRate::Gamma(rate) => rate,
            ThirdRate::Spin(spin) => spin - self.alpha_rate * self.angles.beta.sin_cos().1,
        };
        EulerRates { alpha: self.alpha_rate, beta: self.beta_rate, gamma }
    }

    /// The initial state.
    pub fn state(&self) -> BodyState<S> {
        BodyState::from_angles(&self.spheroid, &self.angles, &self.rates())
    }

    /// The beam.
    pub(crate) fn beam(&self) -> Beam<S> {
        Beam::new(self.chi, self.delta, self.rho)
    }

    /// The observer.
    pub(crate) fn observer(&self) -> Observer<S> {
        Observer::at(self.theta_o, self.phi_o)
    }
}

impl<S: Real> Parameters<S> {
    /// The `Problem` (body, tensor and initial state) of these parameters.
    ///
    /// # Errors
    /// As for [`Problem::new`].
    pub fn problem(&self) -> Result<Problem<S>, Error> {
        Problem::new(self.spheroid, self.coefficients, self.state())?.with_bulge(self.bulge)
    }
}

impl Parameters<f64> {
    /// The same numbers with zero derivatives.
    pub fn lifted<S: Scalar>(&self) -> Parameters<S> {
        let of = S::from_f64;
        let Self { spheroid, angles, .. } = self;
        Parameters {
            spheroid: spheroid.map(of),
            coefficients: self.coefficients.map(of),
            bulge: of(self.bulge),
            s_scale: of(self.s_scale),
            angles: angles.map(of),
            alpha_rate: of(self.alpha_rate),
            beta_rate: of(self.beta_rate),
            third_rate: match self.third_rate {
                ThirdRate::Gamma(rate) => ThirdRate::Gamma(of(rate)),
                ThirdRate::Spin(spin) => ThirdRate::Spin(of(spin)),
            },
            chi: of(self.chi),
            delta: of(self.delta),
            rho: of(self.rho),
            theta_o: of(self.theta_o),
            phi_o: of(self.phi_o),
            strain_scale: of(self.strain_scale),
            strain_unit: self.strain_unit,
        }
    }

    /// The same numbers as functions of one parameter: dual numbers with derivatives with respect to it, at its current value.
    pub fn seeded(&self, parameter: Parameter) -> Parameters<Dual64> {
        let mut seeded = self.lifted();
        parameter.add(&mut seeded, Dual64::new(0.0, 1.0));
        seeded
    }

    /// The parameters with some of them changed.
    pub fn moved(&self, parameters: &[Parameter], changes: &[f64]) -> Self {
        let mut moved = *self;
        parameters.iter().zip(changes).for_each(|(parameter, change)| parameter.add(&mut moved, *change));
        moved
    }

    /// The values of some parameters.
    pub fn values(&self, parameters: &[Parameter]) -> Vec<f64> {
        parameters.iter().map(|parameter| parameter.value(self)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::RotationState;
    use crate::dynamics::fixture::{ANGLES, RATES, STAR};
    use crate::inference::{Model, Unknown};

    fn parameters() -> Parameters<f64> {
        let s = Matrix3::new(0.03, 0.002, -0.004, 0.002, 0.01, 0.005, -0.004, 0.005, -0.02);
        let sight = Parameters {
            chi: 0.4,
            delta: -0.2,
            rho: 0.3,
            theta_o: 1.1,
            phi_o: 0.6,
            ..Parameters::new(STAR, s, ANGLES, RATES)
        };
        Parameters { bulge: -0.7, s_scale: 2.5, strain_scale: 1.5, ..sight }
    }

    #[test]
    fn a_change_of_a_parameter_is_that_of_its_value() {
        let start = parameters();
        for parameter in Parameter::OF_MOTION.into_iter().chain(Parameter::OF_SIGHT).chain(Parameter::FITTED) {
            let start = if parameter == Parameter::Spin { start.with_fixed_spin() } else { start };
            let moved = start.moved(&[parameter], &[0.01]);
            let change = moved.values(&[parameter])[0] - start.values(&[parameter])[0];
            assert!((change - 0.01).abs() < 1e-15, "{parameter:?}: {change}");
            // Each of the combinations of s keeps the two others fixed.
            let others = [Parameter::SAxial, Parameter::SAsymmetry, Parameter::STrace];
            for other in others.into_iter().filter(|other| others.contains(&parameter) && *other != parameter) {
                let change = moved.values(&[other])[0] - start.values(&[other])[0];
                assert!(change.abs() < 1e-16, "{parameter:?} changes {other:?} by {change}");
            }
        }
        let by_field = [
            (Parameter::Chi, Parameters { chi: start.chi + 0.01, ..start }),
            (Parameter::Delta, Parameters { delta: start.delta + 0.01, ..start }),
            (Parameter::Rho, Parameters { rho: start.rho + 0.01, ..start }),
            (Parameter::ThetaO, Parameters { theta_o: start.theta_o + 0.01, ..start }),
            (Parameter::PhiO, Parameters { phi_o: start.phi_o + 0.01, ..start }),
            (Parameter::AlphaRate, Parameters { alpha_rate: start.alpha_rate + 0.01, ..start }),
            (Parameter::BetaRate, Parameters { beta_rate: start.beta_rate + 0.01, ..start }),
        ];
        for (parameter, expected) in by_field {
            assert_eq!(start.moved(&[parameter], &[0.01]), expected, "{parameter:?}");
        }
        // The tensor is multiplied by the ratio of the factors, 3 / 2.5.
        let scaled = start.moved(&[Parameter::SScale], &[0.5]).coefficients;
        assert!((scaled - start.coefficients * 1.2).amax() < 1e-16);
    }

    #[test]
    fn lifted_numbers_are_the_same() {
        for start in [parameters(), parameters().with_fixed_spin()] {
            let lifted: Parameters<Dual64> = start.lifted();
            let problem = lifted.problem().unwrap();
            let [found, expected] = [problem.initial().vectors().map(|v| v.map(|x| x.re)), start.state().vectors()];
            assert_eq!(found, expected);
            assert_eq!((problem.bulge().re, lifted.spin().re), (-0.7, start.spin()));
            let sight = [lifted.chi, lifted.delta, lifted.rho, lifted.theta_o, lifted.phi_o].map(|x| x.re);
            assert_eq!(sight, [0.4, -0.2, 0.3, 1.1, 0.6]);
        }
        assert_eq!(Parameters::new(STAR, Matrix3::zeros(), ANGLES, RATES).strain_unit, 1.0);
    }

    /// Keys are the names in scenes and commands.
    #[test]
    fn names_are_found_again() {
        let keys = [(Parameter::BetaRate, "beta_rate", "beta'"), (Parameter::S(1, 0), "s_xy", "s^XY")];
        for (parameter, key, symbol) in keys {
            assert_eq!((parameter.key(), parameter.symbol()), (key, symbol));
        }
        for parameter in Parameter::FITTED {
            assert_eq!(Parameter::named(parameter.key()), Some(parameter));
        }
        assert_eq!(Parameter::named("beta'"), None);
    }

    #[test]
    fn fits_stay_within_what_is_possible() {
        let (pi, near) = (core::f64::consts::PI, 1e-6);
        for (parameter, limits) in [
            (Parameter::Beta, (Some(0.0), Some(pi))),
            (Parameter::Rho, (Some(near), Some(pi - near))),
            (Parameter::Oblateness, (Some(-0.999), Some(1.0))),
            (Parameter::Spin, (None, None)),
        ] {
            assert_eq!(parameter.limits(), limits, "{parameter:?}");
        }
        // A radian, or the largest of the rates of alpha and beta and of the spin.
        let of = |alpha: f64, beta: f64, spin: f64| {
            let rates = EulerRates { alpha, beta, gamma: spin - alpha * ANGLES.beta.cos() };
            Parameters::new(STAR, Matrix3::zeros(), ANGLES, rates).range(Parameter::GammaRate)
        };
        assert_eq!((parameters().range(Parameter::Chi), of(-3.0, 0.1, 0.2), of(0.1, -3.0, 0.2)), (1.0, 3.0, 3.0));
        assert!((of(0.1, 0.2, -3.0) - 3.0).abs() < 1e-15);
    }
}
