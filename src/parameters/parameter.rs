//! The parameters by which derivatives are taken and which are fitted.

use super::{Parameters, ThirdRate};
use crate::scalar::Scalar;

/// One number of [`Parameters`], or a combination of some.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parameter {
    /// `I^xx`.
    InertiaXx,
    /// `I^zz`.
    InertiaZz,
    /// Oblateness `eps = (I^zz - I^xx) / I^xx`, by a change of `I^zz`.
    Oblateness,
    /// The constant `C`.
    ConstantC,
    /// The component `s^IJ` for two of the indices 0, 1, 2, in either order. The tensor is symmetric: `s^JI` changes with it.
    S(usize, usize),
    /// A factor of the whole tensor `s^IJ`.
    SScale,
    /// `2 s^ZZ - s^XX - s^YY`. A change of one of this, the next and the trace keeps the other two.
    SAxial,
    /// `s^XX - s^YY`.
    SAsymmetry,
    /// The trace of `s^IJ`.
    STrace,
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
    /// Initial rate of `gamma`.
    GammaRate,
    /// Initial `Omega^z`. The other rates held, a change of it is the same change of the rate of `gamma`.
    Spin,
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
    /// A factor of the strain, `I^xx` over distance.
    StrainScale,
}

impl Parameter {
    /// Those that a motion depends on, each in itself.
    pub const OF_MOTION: [Self; 15] = [
        Self::InertiaXx,
        Self::InertiaZz,
        Self::ConstantC,
        Self::S(0, 0),
        Self::S(1, 1),
        Self::S(2, 2),
        Self::S(0, 1),
        Self::S(0, 2),
        Self::S(1, 2),
        Self::Alpha,
        Self::Beta,
        Self::Gamma,
        Self::AlphaRate,
        Self::BetaRate,
        Self::GammaRate,
    ];

    /// Those that data depend on beside the motion.
    pub const OF_SIGHT: [Self; 6] = [Self::Chi, Self::Delta, Self::Rho, Self::ThetaO, Self::PhiO, Self::StrainScale];

    /// Those that can be fitted in units of `I^xx = 1`.
    pub const FITTED: [Self; 21] = [
        Self::Oblateness,
        Self::Spin,
        Self::ConstantC,
        Self::SScale,
        Self::SAxial,
        Self::SAsymmetry,
        Self::STrace,
        Self::S(0, 1),
        Self::S(0, 2),
        Self::S(1, 2),
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

    /// Those that the strain determines in the same frame where the distance is known. It depends on no beam and not on `gamma`.
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

    fn names(self) -> [&'static str; 2] {
        match self {
            Self::InertiaXx => ["inertia_xx", "I^xx"],
            Self::InertiaZz => ["inertia_zz", "I^zz"],
            Self::Oblateness => ["eps"; 2],
            Self::ConstantC => ["c", "C"],
            Self::S(0, 0) => ["s_xx", "s^XX"],
            Self::S(1, 1) => ["s_yy", "s^YY"],
            Self::S(2, 2) => ["s_zz", "s^ZZ"],
            Self::S(0, 1) | Self::S(1, 0) => ["s_xy", "s^XY"],
            Self::S(0, 2) | Self::S(2, 0) => ["s_xz", "s^XZ"],
            Self::S(..) => ["s_yz", "s^YZ"],
            Self::SScale => ["s_scale", "|s|"],
            Self::SAxial => ["s_axial", "2 s^ZZ - s^XX - s^YY"],
            Self::SAsymmetry => ["s_asymmetry", "s^XX - s^YY"],
            Self::STrace => ["s_trace", "tr s"],
            Self::Alpha => ["alpha"; 2],
            Self::Beta => ["beta"; 2],
            Self::Gamma => ["gamma"; 2],
            Self::AlphaRate => ["alpha_rate", "alpha'"],
            Self::BetaRate => ["beta_rate", "beta'"],
            Self::GammaRate => ["gamma_rate", "gamma'"],
            Self::Spin => ["spin", "Omega^z"],
            Self::Chi => ["chi"; 2],
            Self::Delta => ["delta"; 2],
            Self::Rho => ["rho"; 2],
            Self::ThetaO => ["theta_o"; 2],
            Self::PhiO => ["phi_o"; 2],
            Self::StrainScale => ["strain_scale", "I^xx / r"],
        }
    }

    /// Name for commands and files.
    pub fn key(self) -> &'static str {
        self.names()[0]
    }

    /// In symbols.
    pub fn symbol(self) -> &'static str {
        self.names()[1]
    }

    /// The one of [`FITTED`](Self::FITTED) with a name.
    pub fn named(key: &str) -> Option<Self> {
        Self::FITTED.into_iter().find(|parameter| parameter.key() == key)
    }

    /// Whether it is a part of `s^IJ`.
    pub fn is_of_s(self) -> bool {
        matches!(self, Self::S(..) | Self::SScale | Self::SAxial | Self::SAsymmetry | Self::STrace)
    }

    /// How far its value can be from a known one at all: a radian, the rate of rotation, one.
    pub fn range(self, parameters: &Parameters<f64>) -> f64 {
        match self {
            Self::Spin | Self::GammaRate | Self::AlphaRate | Self::BetaRate => {
                let Parameters { alpha_rate, beta_rate, .. } = parameters;
                alpha_rate.abs().max(parameters.spin().abs()).max(beta_rate.abs())
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

    /// Its value.
    pub fn value<S: Scalar>(self, parameters: &Parameters<S>) -> S {
        let Parameters { spheroid, violation: s, angles, .. } = parameters;
        match self {
            Self::InertiaXx => spheroid.inertia_xx,
            Self::InertiaZz => spheroid.inertia_zz,
            Self::Oblateness => spheroid.oblateness(),
            Self::ConstantC => spheroid.constant_c,
            Self::S(i, j) => s[(i, j)],
            Self::SScale => parameters.s_scale,
            Self::SAxial => s[(2, 2)] * 2.0 - s[(0, 0)] - s[(1, 1)],
            Self::SAsymmetry => s[(0, 0)] - s[(1, 1)],
            Self::STrace => s.trace(),
            Self::Alpha => angles.alpha,
            Self::Beta => angles.beta,
            Self::Gamma => angles.gamma,
            Self::AlphaRate => parameters.alpha_rate,
            Self::BetaRate => parameters.beta_rate,
            Self::GammaRate => parameters.rates().gamma,
            Self::Spin => parameters.spin(),
            Self::Chi => parameters.chi,
            Self::Delta => parameters.delta,
            Self::Rho => parameters.rho,
            Self::ThetaO => parameters.theta_o,
            Self::PhiO => parameters.phi_o,
            Self::StrainScale => parameters.strain_scale,
        }
    }

    /// Adds `change` to it; all other numbers of the struct stay.
    ///
    /// # Panics
    /// For an index of `s^IJ` above 2.
    pub fn add<S: Scalar>(self, parameters: &mut Parameters<S>, change: S) {
        let Parameters { spheroid, violation: s, angles, .. } = parameters;
        let mut diagonal = |parts: [f64; 3]| (0..3).for_each(|i| s[(i, i)] += change * parts[i]);
        *match self {
            Self::InertiaXx => &mut spheroid.inertia_xx,
            Self::InertiaZz => &mut spheroid.inertia_zz,
            Self::Oblateness => return spheroid.inertia_zz += spheroid.inertia_xx * change,
            Self::ConstantC => &mut spheroid.constant_c,
            Self::S(i, j) => {
                if i != j {
                    s[(j, i)] += change;
                }
                &mut s[(i, j)]
            }
            Self::SScale => {
                *s *= (parameters.s_scale + change) / parameters.s_scale;
                &mut parameters.s_scale
            }
            Self::SAxial => return diagonal([-1.0 / 6.0, -1.0 / 6.0, 1.0 / 3.0]),
            Self::SAsymmetry => return diagonal([0.5, -0.5, 0.0]),
            Self::STrace => return diagonal([1.0 / 3.0; 3]),
            Self::Alpha => &mut angles.alpha,
            Self::Beta => &mut angles.beta,
            Self::Gamma => &mut angles.gamma,
            Self::AlphaRate => &mut parameters.alpha_rate,
            Self::BetaRate => &mut parameters.beta_rate,
            Self::GammaRate | Self::Spin => match &mut parameters.third_rate {
                ThirdRate::Gamma(rate) | ThirdRate::Spin(rate) => rate,
            },
            Self::Chi => &mut parameters.chi,
            Self::Delta => &mut parameters.delta,
            Self::Rho => &mut parameters.rho,
            Self::ThetaO => &mut parameters.theta_o,
            Self::PhiO => &mut parameters.phi_o,
            Self::StrainScale => &mut parameters.strain_scale,
        } += change;
    }
}
