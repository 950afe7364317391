//! The unknowns of a fit, one number each.

use nalgebra::Matrix3;
use twofold::Scalar;

use super::Model;

/// Something that is not known of a scene. Others are kept when one is changed; `I^xx = 1` sets the unit of `C`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unknown {
    /// Oblateness `eps = (I^zz - I^xx) / I^xx`.
    Oblateness,
    /// `Omega^z`.
    Spin,
    /// The constant `C`.
    ConstantC,
    /// A factor of the whole tensor `s^IJ`, one for that of the scene.
    SScale,
    /// `2 s^ZZ - s^XX - s^YY`.
    SAxial,
    /// `s^XX - s^YY`.
    SAsymmetry,
    /// The trace of `s^IJ`.
    STrace,
    /// `s^XY`.
    SXy,
    /// `s^XZ`.
    SXz,
    /// `s^YZ`.
    SYz,
    /// Initial `alpha`.
    Alpha,
    /// Initial `beta`.
    Beta,
    /// Initial `gamma`.
    Gamma,
    /// Initial rate of `alpha`.
    AlphaRate,
    /// Initial rate of `beta`.
    BetaRate,
    /// Angle of the magnetic axis to the symmetry axis.
    Chi,
    /// Azimuth of the magnetic axis in the body.
    Delta,
    /// Semi-open angle of the beam.
    Rho,
    /// Colatitude of the observer.
    ThetaO,
    /// Azimuth of the observer.
    PhiO,
    /// A factor of the strain, `I^xx` over distance; one for the scene.
    StrainScale,
}

impl Unknown {
    /// Every unknown.
    pub const ALL: [Self; 21] = [
        Self::Oblateness,
        Self::Spin,
        Self::ConstantC,
        Self::SScale,
        Self::SAxial,
        Self::SAsymmetry,
        Self::STrace,
        Self::SXy,
        Self::SXz,
        Self::SYz,
        Self::Alpha,
        Self::Beta,
        Self::Gamma,
        Self::AlphaRate,
        Self::BetaRate,
        Self::Chi,
        Self::Delta,
        Self::Rho,
        Self::ThetaO,
        Self::PhiO,
        Self::StrainScale,
    ];

    /// Those that the pulses of a beam determine, where the frame is the principal one of `s^IJ`.
    pub const OF_PULSES: [Self; 13] = [
        Self::Oblateness,
        Self::Spin,
        Self::SAxial,
        Self::SAsymmetry,
        Self::Alpha,
        Self::Beta,
        Self::Gamma,
        Self::AlphaRate,
        Self::BetaRate,
        Self::Chi,
        Self::Rho,
        Self::ThetaO,
        Self::PhiO,
    ];

    /// Those that the strain determines in the same frame, the distance known: it knows no beam and no third angle.
    pub const OF_STRAIN: [Self; 10] = [
        Self::Oblateness,
        Self::Spin,
        Self::SAxial,
        Self::SAsymmetry,
        Self::Alpha,
        Self::Beta,
        Self::AlphaRate,
        Self::BetaRate,
        Self::ThetaO,
        Self::PhiO,
    ];

    /// Name for commands and files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Oblateness => "eps",
            Self::Spin => "spin",
            Self::ConstantC => "c",
            Self::SScale => "s_scale",
            Self::SAxial => "s_axial",
            Self::SAsymmetry => "s_asymmetry",
            Self::STrace => "s_trace",
            Self::SXy => "s_xy",
            Self::SXz => "s_xz",
            Self::SYz => "s_yz",
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::Gamma => "gamma",
            Self::AlphaRate => "alpha_rate",
            Self::BetaRate => "beta_rate",
            Self::Chi => "chi",
            Self::Delta => "delta",
            Self::Rho => "rho",
            Self::ThetaO => "theta_o",
            Self::PhiO => "phi_o",
            Self::StrainScale => "strain_scale",
        }
    }

    /// In symbols.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Oblateness => "eps",
            Self::Spin => "Omega^z",
            Self::ConstantC => "C",
            Self::SScale => "|s|",
            Self::SAxial => "2 s^ZZ - s^XX - s^YY",
            Self::SAsymmetry => "s^XX - s^YY",
            Self::STrace => "tr s",
            Self::SXy => "s^XY",
            Self::SXz => "s^XZ",
            Self::SYz => "s^YZ",
            Self::AlphaRate => "alpha'",
            Self::BetaRate => "beta'",
            Self::StrainScale => "I^xx / r",
            other => other.key(),
        }
    }

    /// The unknown with a name.
    pub fn named(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unknown| unknown.key() == key)
    }

    /// Whether the pulses of a beam depend on it, of all that a scene has.
    pub fn is_of_beam(self) -> bool {
        matches!(self, Self::Chi | Self::Delta | Self::Rho)
    }

    /// Whether it is a part of `s^IJ`.
    pub fn is_of_s(self) -> bool {
        (Self::SScale..=Self::SYz).contains(&self)
    }

    /// How far it can be from a known value at all: a radian, a turning rate, one. A direction along which all of this is less than
    /// one standard deviation of the data is not determined by them.
    pub fn range(self, model: &Model<f64>) -> f64 {
        match self {
            Self::Spin | Self::AlphaRate | Self::BetaRate => {
                model.alpha_rate.abs().max(model.spin.abs()).max(model.beta_rate.abs())
            }
            _ => 1.0,
        }
    }

    /// Interval that a fit stays within, where there is one.
    pub fn limits(self) -> (Option<f64>, Option<f64>) {
        use std::f64::consts::PI;
        match self {
            Self::Beta | Self::ThetaO | Self::Chi => (Some(0.0), Some(PI)),
            Self::Rho => (Some(1e-6), Some(PI - 1e-6)),
            // I^zz <= I^xx + I^yy.
            Self::Oblateness => (Some(-0.999), Some(1.0)),
            _ => (None, None),
        }
    }

    /// Its value in a model.
    pub fn value(self, model: &Model<f64>) -> f64 {
        let s = model.violation();
        match self {
            Self::Oblateness => model.oblateness,
            Self::Spin => model.spin,
            Self::ConstantC => model.constant_c,
            Self::SScale => model.s_scale,
            Self::SAxial => 2.0 * s[(2, 2)] - s[(0, 0)] - s[(1, 1)],
            Self::SAsymmetry => s[(0, 0)] - s[(1, 1)],
            Self::STrace => s.trace(),
            Self::SXy => s[(0, 1)],
            Self::SXz => s[(0, 2)],
            Self::SYz => s[(1, 2)],
            Self::Alpha => model.angles.alpha,
            Self::Beta => model.angles.beta,
            Self::Gamma => model.angles.gamma,
            Self::AlphaRate => model.alpha_rate,
            Self::BetaRate => model.beta_rate,
            Self::Chi => model.chi,
            Self::Delta => model.delta,
            Self::Rho => model.rho,
            Self::ThetaO => model.theta_o,
            Self::PhiO => model.phi_o,
            Self::StrainScale => model.strain_scale,
        }
    }

    /// Changes it by `change` in a model.
    pub fn add<S: Scalar>(self, model: &mut Model<S>, change: S) {
        // Of s with its factor, so that a change is that of the tensor.
        let share = change / model.s_scale;
        let mut diagonal = |parts: [f64; 3]| {
            model.s += Matrix3::from_diagonal(&nalgebra::Vector3::from(parts).map(|part| share * part));
        };
        match self {
            Self::SAxial => return diagonal([-1.0 / 6.0, -1.0 / 6.0, 1.0 / 3.0]),
            Self::SAsymmetry => return diagonal([0.5, -0.5, 0.0]),
            Self::STrace => return diagonal([1.0 / 3.0; 3]),
            _ => {}
        }
        let mut off_diagonal = |i: usize, j: usize| {
            model.s[(i, j)] += share;
            model.s[(j, i)] += share;
        };
        match self {
            Self::SXy => return off_diagonal(0, 1),
            Self::SXz => return off_diagonal(0, 2),
            Self::SYz => return off_diagonal(1, 2),
            _ => {}
        }
        *match self {
            Self::Oblateness => &mut model.oblateness,
            Self::Spin => &mut model.spin,
            Self::ConstantC => &mut model.constant_c,
            Self::Alpha => &mut model.angles.alpha,
            Self::Beta => &mut model.angles.beta,
            Self::Gamma => &mut model.angles.gamma,
            Self::AlphaRate => &mut model.alpha_rate,
            Self::BetaRate => &mut model.beta_rate,
            Self::Chi => &mut model.chi,
            Self::Delta => &mut model.delta,
            Self::Rho => &mut model.rho,
            Self::ThetaO => &mut model.theta_o,
            Self::PhiO => &mut model.phi_o,
            Self::StrainScale => &mut model.strain_scale,
            _ => &mut model.s_scale,
        } += change;
    }
}
