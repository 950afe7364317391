//! What can be asked of a motion, and what each needs of it.

/// Parts of the state, each with those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// No motion at all.
    Nothing,
    /// The symmetry axis `n` alone. A numerical motion carries `L` with it, since `n` does not move by itself.
    Axis,
    /// The symmetry axis `n` and the angular momentum `L`, which move by themselves.
    AxisAndMomentum,
    /// `n`, `L` and `e_x`: the rotation about the symmetry axis too.
    Orientation,
}

impl State {
    /// In symbols.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Axis => "n",
            Self::AxisAndMomentum => "n, L",
            Self::Orientation => "n, L, e_x",
        }
    }
}

/// At which times a motion is evaluated for an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Evaluations {
    /// Never.
    Never,
    /// Once at each sample. Outputs at samples share that evaluation.
    AtSamples,
    /// At each sample, and between samples so often that no turn is lost: `per_radian` times per radian of rotation.
    CountingTurns {
        /// Evaluations per radian of rotation, typical.
        per_radian: f64,
    },
    /// Wherever bounds on the rates leave an event undecided; samples do not matter.
    ForEvents {
        /// Evaluations per radian of rotation, typical.
        per_radian: f64,
    },
}

/// What an output needs of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Need {
    /// State.
    pub state: State,
    /// Times.
    pub evaluations: Evaluations,
}

/// Something that a motion is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// `alpha` and `beta` of a perturbation solution, Eq. (33): functions of time, no motion.
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
    /// `h_+` and `h_x`, Eq. (71): of a spheroid, functions of `n` and `L`.
    GravitationalWave,
    /// Euler angles that count their turns.
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

    /// In words.
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

    /// What it needs.
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

/// Evaluations per radian of the turn counter between samples that are far apart; more where the axis comes near a pole.
const TURN_COUNTING: f64 = 12.0;

/// Evaluations per radian of the search for pulses and of their turns.
const PULSE_SEARCH: f64 = 8.0;
