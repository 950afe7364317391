//! Models that can be fitted: models with named parameters.

use core::f64::consts::PI;
use core::fmt::Debug;

use super::Symmetry;
use super::symmetry::symmetries;
use crate::error::Error;
use crate::lorentz_violation::traceless;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter};
use crate::parameters::{Parameter, Parameters};

/// The name of a parameter of a [`Model`].
pub trait Unknown: Copy + PartialEq + Debug {
    /// Name in commands and files.
    fn key(self) -> &'static str;

    /// Mathematical symbol.
    fn symbol(self) -> &'static str;

    /// Interval that a fit stays within, if there is one.
    fn limits(self) -> (Option<f64>, Option<f64>);
}

/// A model with parameters, some of them unknown.
pub trait Model: Clone {
    /// The type of the parameters' names.
    type Unknown: Unknown;

    /// The value of a parameter.
    fn value(&self, unknown: Self::Unknown) -> f64;

    /// Value of a parameter minus its value in another model.
    fn difference(&self, other: &Self, unknown: Self::Unknown) -> f64 {
        self.value(unknown) - other.value(unknown)
    }

    /// The last digit of a parameter as it is stored, in the unit of the parameter.
    fn last_digit(&self, unknown: Self::Unknown) -> f64 {
        f64::EPSILON * self.value(unknown).abs()
    }

    /// The model with some parameters changed.
    ///
    /// # Errors
    /// The changed values do not make a valid model.
    fn moved(&self, unknowns: &[Self::Unknown], changes: &[f64]) -> Result<Self, Error>;

    /// Largest possible change of a parameter: a radian for an angle, the rate of rotation for a rate, one for other parameters.
    fn range(&self, unknown: Self::Unknown) -> f64;

    /// Changes of the parameters that no data can show.
    fn symmetries(&self) -> Vec<Symmetry<Self::Unknown>>;
}

impl Unknown for Parameter {
    fn key(self) -> &'static str {
        Self::key(self)
    }

    fn symbol(self) -> &'static str {
        Self::symbol(self)
    }

    fn limits(self) -> (Option<f64>, Option<f64>) {
        match self {
            Self::Beta | Self::ThetaO | Self::Chi => (Some(0.0), Some(PI)),
            Self::Rho => (Some(1e-6), Some(PI - 1e-6)),
            // I^zz <= I^xx + I^yy.
            Self::Oblateness => (Some(-0.999), Some(1.0)),
            _ => (None, None),
        }
    }
}

impl Model for Parameters<f64> {
    type Unknown = Parameter;

    fn value(&self, unknown: Parameter) -> f64 {
        unknown.value(self)
    }

    fn moved(&self, unknowns: &[Parameter], changes: &[f64]) -> Result<Self, Error> {
        Ok(Self::moved(self, unknowns, changes))
    }

    fn range(&self, unknown: Parameter) -> f64 {
        use Parameter::{AlphaRate, BetaRate, GammaRate, Spin};
        match unknown {
            Spin | GammaRate | AlphaRate | BetaRate => {
                // A star at rest is made to librate by the torque.
                let torque = self.spheroid.constant_c.abs() * traceless(&self.coefficients).norm();
                let by_torque = (2.0 * torque / self.spheroid.inertia_xx).sqrt();
                self.alpha_rate.abs().max(self.spin().abs()).max(self.beta_rate.abs()).max(by_torque)
            }
            _ => 1.0,
        }
    }

    fn symmetries(&self) -> Vec<Symmetry<Parameter>> {
        symmetries(self)
    }
}

impl Unknown for TimingParameter {
    fn key(self) -> &'static str {
        Self::key(self)
    }

    fn symbol(self) -> &'static str {
        Self::key(self)
    }

    fn limits(self) -> (Option<f64>, Option<f64>) {
        match self {
            Self::Wobble => (Some(0.0), Some(PI / 2.0)),
            Self::Chi | Self::Inclination | Self::Rho => (Some(0.0), Some(PI)),
            Self::TorqueShare => (Some(0.0), Some(1.0)),
            _ => (None, None),
        }
    }
}

impl Model for TimingModel {
    type Unknown = TimingParameter;

    fn value(&self, unknown: TimingParameter) -> f64 {
        Self::value(self, unknown)
    }

    fn difference(&self, other: &Self, unknown: TimingParameter) -> f64 {
        if unknown == TimingParameter::F0 {
            let ([a, b], [c, d]) = (self.frequency(), other.frequency());
            return (a - c) + (b - d);
        }
        self.value(unknown) - other.value(unknown)
    }

    /// F0 is stored in two doubles.
    fn last_digit(&self, unknown: TimingParameter) -> f64 {
        let digit = if unknown == TimingParameter::F0 { f64::EPSILON.powi(2) } else { f64::EPSILON };
        digit * self.value(unknown).abs()
    }

    fn moved(&self, unknowns: &[TimingParameter], changes: &[f64]) -> Result<Self, Error> {
        let changes: Vec<_> = unknowns.iter().copied().zip(changes.iter().copied()).collect();
        Self::moved(self, &changes)
    }

    fn range(&self, unknown: TimingParameter) -> f64 {
        use TimingParameter::{F0, F1, F2, InclinationRate, PrecessionRate};
        match unknown {
            F0 | F1 | F2 | PrecessionRate | InclinationRate => self.value(F0),
            _ => 1.0,
        }
    }

    fn symmetries(&self) -> Vec<Symmetry<TimingParameter>> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::inference::stars;

    #[test]
    fn last_digits_and_differences_are_those_of_the_stored_values() {
        let star = Parameters { theta_o: -0.3, ..stars::precessing() };
        let other = star.moved(&[Parameter::ThetaO], &[0.25]);
        assert_relative_eq!(
            Model::difference(&other, &star, Parameter::ThetaO),
            0.25,
            max_relative = 1e-15,
            epsilon = 0.0
        );
        assert_eq!(Model::last_digit(&star, Parameter::ThetaO), f64::EPSILON * 0.3);

        let f1 = [(TimingParameter::F1, -3e-10)];
        let [slow, fast] = [1e-15, 3e-15].map(|low| TimingModel::new([10.0, low], &f1).unwrap());
        let f0 = TimingParameter::F0;
        assert_relative_eq!(Model::difference(&fast, &slow, f0), 2e-15, max_relative = 1e-12, epsilon = 0.0);
        assert_relative_eq!(Model::last_digit(&slow, f0), 10.0 * f64::EPSILON * f64::EPSILON, epsilon = 0.0);
        assert_eq!(Model::last_digit(&slow, TimingParameter::F1), f64::EPSILON * 3e-10);
    }

    /// A star at rest is turned by the torque: at most by `I^xx w^2 / 2 = C |s|`, with `s` without its trace.
    #[test]
    fn rates_range_as_far_as_the_rotation_or_the_torque() {
        let mut star = stars::precessing();
        assert_eq!(Model::range(&star, Parameter::Chi), 1.0);
        assert_eq!(Model::range(&star, Parameter::AlphaRate), star.alpha_rate.abs().max(star.spin().abs()));
        (star.alpha_rate, star.beta_rate) = (0.0, 1e-3);
        star = star.moved(&[Parameter::Spin], &[-star.spin()]);
        star.spheroid.inertia_xx = 1.7;
        star.spheroid.constant_c = -0.6;
        let s = star.coefficients - nalgebra::Matrix3::identity() * (star.coefficients.trace() / 3.0);
        let expected = (2.0 * 0.6 * s.norm() / 1.7).sqrt();
        assert_relative_eq!(Model::range(&star, Parameter::Spin), expected, max_relative = 1e-14, epsilon = 0.0);
    }
}
