//! The possible outputs of a motion, and the requirements of each.

/// Parts of the state. Each includes the previous ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// No motion at all.
    Nothing,
    /// The symmetry axis `n` alone. A numerical motion also carries `L`, since the equation of motion of `n` depends on it.
    Axis,
    /// The symmetry axis `n` and the angular momentum `L`, which form a closed system.
    AxisAndMomentum,
    /// `n`, `L` and `e_x`: includes the rotation about the symmetry axis.
    Orientation,
}

impl State {
    /// Mathematical symbol.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Axis => "n",
            Self::AxisAndMomentum => "n, L",
            Self::Orientation => "n, L, e_x",
        }
    }
}

/// The times at which a motion is evaluated for an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Evaluations {
    /// Never.
    Never,
    /// Once at each sample. All outputs at samples share that evaluation.
    AtSamples,
    /// At each sample, and between samples often enough to count every turn: `per_radian` times per radian of rotation.
    CountingTurns {
        /// Typical number of evaluations per radian of rotation.
        per_radian: f64,
    },
    /// Wherever bounds on the rates leave an event undecided; samples are irrelevant.
    ForEvents {
        /// Typical number of evaluations per radian of rotation.
        per_radian: f64,
    },
}

/// The requirements of an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Need {
    /// The part of the state.
    pub state: State,
    /// The times.
    pub evaluations: Evaluations,
}

/// An output of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// `alpha` and `beta` of a perturbation solution, Eq. (33): functions of time that need no motion.
    PerturbationAngles,
    /// Components of `n = e_z`.
    SymmetryAxis,
    /// The spin-axis angle `cos lambda` and its rate, Eq. (37).
    SpinAxisAngle,
    /// Components of `L`.
    AngularMomentum,
    /// Energy, spin and third integral, Eq. (24).
    FirstIntegrals,
    /// Rates of the Euler angles: those of the axis, and `gamma' = Omega^z - alpha' cos(beta)`.
    EulerRates,
    /// `h_+` and `h_x`, Eq. (71); for a spheroid they are functions of `n` and `L`.
    GravitationalWave,
    /// Continuous Euler angles, including whole turns.
    EulerAngles,
    /// Components of `e_x`.
    EquatorialAxis,
    /// `m.n` and its rate, Eq. (47).
    PulseProfile,
    /// Direction of the magnetic axis, Eq. (49).
    MagneticAxis,
    /// Position angle of the polarization and its rate.
    PositionAngle,
    /// Edges, arrival times and turns of the pulses of a beam, Eq. (44).
    Pulses,
}

impl Output {
    /// Every output.
    pub const ALL: [Self; 13] = [
        Self::PerturbationAngles,
        Self::SymmetryAxis,
        Self::SpinAxisAngle,
        Self::AngularMomentum,
        Self::FirstIntegrals,
        Self::EulerRates,
        Self::GravitationalWave,
        Self::EulerAngles,
        Self::EquatorialAxis,
        Self::PulseProfile,
        Self::MagneticAxis,
        Self::PositionAngle,
        Self::Pulses,
    ];

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::PerturbationAngles => "angles of the perturbation solution",
            Self::SymmetryAxis => "symmetry axis",
            Self::SpinAxisAngle => "spin-axis angle",
            Self::AngularMomentum => "angular momentum",
            Self::FirstIntegrals => "first integrals",
            Self::EulerRates => "Euler rates",
            Self::GravitationalWave => "gravitational wave",
            Self::EulerAngles => "Euler angles with their turns",
            Self::EquatorialAxis => "equatorial axis",
            Self::PulseProfile => "m.n",
            Self::MagneticAxis => "magnetic axis",
            Self::PositionAngle => "position angle",
            Self::Pulses => "pulses",
        }
    }

    /// Its requirements.
    pub fn need(self) -> Need {
        let (state, evaluations) = match self {
            Self::PerturbationAngles => (State::Nothing, Evaluations::Never),
            Self::SymmetryAxis => (State::Axis, Evaluations::AtSamples),
            Self::SpinAxisAngle
            | Self::AngularMomentum
            | Self::FirstIntegrals
            | Self::EulerRates
            | Self::GravitationalWave => (State::AxisAndMomentum, Evaluations::AtSamples),
            Self::EquatorialAxis | Self::PulseProfile | Self::MagneticAxis | Self::PositionAngle => {
                (State::Orientation, Evaluations::AtSamples)
            }
            Self::EulerAngles => (State::Orientation, Evaluations::CountingTurns { per_radian: TURN_COUNTING }),
            Self::Pulses => (State::Orientation, Evaluations::ForEvents { per_radian: PULSE_SEARCH }),
        };
        Need { state, evaluations }
    }
}

/// Evaluations per radian by the turn counter between samples that are far apart; more are needed where the axis comes near
/// a pole.
const TURN_COUNTING: f64 = 12.0;

/// Evaluations per radian by the search for pulses and their turns.
const PULSE_SEARCH: f64 = 8.0;
