//! The parameters of a scene by which derivatives can be taken.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, Problem, RigidSpheroid};
use crate::error::Error;
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::numerics::scalar::{Real, Scalar};

/// A scene as its parameters give it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start<S> {
    /// The body.
    pub spheroid: RigidSpheroid<S>,
    /// `s^IJ`.
    pub violation: Matrix3<S>,
    /// Euler angles at the start of the span.
    pub angles: EulerAngles<S>,
    /// Euler rates there.
    pub rates: EulerRates<S>,
}

/// A parameter of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parameter {
    /// `I^xx`.
    InertiaXx,
    /// `I^zz`.
    InertiaZz,
    /// The constant `C`.
    ConstantC,
    /// The component `s^IJ` for two of the indices 0, 1, 2, in either order. The tensor is symmetric: `s^JI` changes with it.
    S(usize, usize),
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
}

impl Parameter {
    /// How many there are.
    pub const COUNT: usize = Self::ALL.len();

    /// Every parameter.
    pub const ALL: [Self; 15] = [
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

    /// In symbols.
    pub fn name(self) -> &'static str {
        match self {
            Self::InertiaXx => "I^xx",
            Self::InertiaZz => "I^zz",
            Self::ConstantC => "C",
            Self::S(0, 0) => "s^XX",
            Self::S(1, 1) => "s^YY",
            Self::S(2, 2) => "s^ZZ",
            Self::S(0, 1) | Self::S(1, 0) => "s^XY",
            Self::S(0, 2) | Self::S(2, 0) => "s^XZ",
            Self::S(..) => "s^YZ",
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::Gamma => "gamma",
            Self::AlphaRate => "alpha'",
            Self::BetaRate => "beta'",
            Self::GammaRate => "gamma'",
        }
    }

    /// Adds `change` to this parameter of a scene.
    ///
    /// # Panics
    /// For an index of `s^IJ` above 2.
    pub fn add<S: Scalar>(self, start: &mut Start<S>, change: S) {
        let Start { spheroid, violation, angles, rates } = start;
        match self {
            Self::InertiaXx => spheroid.inertia_xx += change,
            Self::InertiaZz => spheroid.inertia_zz += change,
            Self::ConstantC => spheroid.constant_c += change,
            Self::S(i, j) => {
                violation[(i, j)] += change;
                if i != j {
                    violation[(j, i)] += change;
                }
            }
            Self::Alpha => angles.alpha += change,
            Self::Beta => angles.beta += change,
            Self::Gamma => angles.gamma += change,
            Self::AlphaRate => rates.alpha += change,
            Self::BetaRate => rates.beta += change,
            Self::GammaRate => rates.gamma += change,
        }
    }
}

impl Start<f64> {
    /// The same scene with zero derivatives.
    pub fn lifted<S: Scalar>(&self) -> Start<S> {
        let of = S::from_f64;
        let Self { spheroid, violation, angles, rates } = self;
        Start {
            spheroid: spheroid.map(of),
            violation: violation.map(of),
            angles: EulerAngles { alpha: of(angles.alpha), beta: of(angles.beta), gamma: of(angles.gamma) },
            rates: EulerRates { alpha: of(rates.alpha), beta: of(rates.beta), gamma: of(rates.gamma) },
        }
    }
}

impl<S: Real> Start<S> {
    /// What moves.
    ///
    /// # Errors
    /// As for [`Problem::new`].
    pub fn problem(&self) -> Result<Problem<S>, Error> {
        Problem::from_angles(self.spheroid, self.violation, &self.angles, &self.rates)
    }

    /// The initial state.
    pub fn state(&self) -> BodyState<S> {
        BodyState::from_angles(&self.spheroid, &self.angles, &self.rates)
    }
}
