//! The parameters of a timing model.

/// A parameter of a [`TimingModel`](super::TimingModel), in the order of [`ALL`](Self::ALL).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TimingParameter {
    /// Turns at the epoch, without the geometric effect of the wobble.
    Phase,
    /// Frequency of the pulses at the epoch, averaged over a precession (Hz).
    F0,
    /// First derivative of the frequency (Hz/s).
    F1,
    /// Second derivative of the frequency (Hz/s^2).
    F2,
    /// Wobble angle `theta` of the symmetry axis `n` to `L` (rad).
    Wobble,
    /// Angle `chi` of the magnetic axis to `n` (rad).
    Chi,
    /// Angle `psi` about `n` from the projection of the magnetic axis to the projection of `L`, both onto the plane normal
    /// to `n`, at the epoch (rad).
    PrecessionPhase,
    /// Rate of `psi` at the epoch (rad/s).
    PrecessionRate,
    /// Fraction of the braking torque that is proportional to `sin^2 theta_m`.
    TorqueShare,
    /// Angle of the line of sight to `L` at the epoch (rad).
    Inclination,
    /// Rate of the inclination (rad/s), caused by Lorentz violation.
    InclinationRate,
    /// Semi-open angle of the beam (rad).
    Rho,
    /// Rate `gamma` at which friction damps the wobble: `tan theta` varies as `exp(-gamma t)` (1/s).
    Damping,
}

use TimingParameter::*;

impl TimingParameter {
    /// All parameters.
    pub const ALL: [Self; 13] = [
        Phase,
        F0,
        F1,
        F2,
        Wobble,
        Chi,
        PrecessionPhase,
        PrecessionRate,
        TorqueShare,
        Inclination,
        InclinationRate,
        Rho,
        Damping,
    ];

    fn names(self) -> [&'static str; 2] {
        match self {
            Phase => ["phase", "1"],
            F0 => ["f0", "Hz"],
            F1 => ["f1", "Hz/s"],
            F2 => ["f2", "Hz/s^2"],
            Wobble => ["wobble", "rad"],
            Chi => ["chi", "rad"],
            PrecessionPhase => ["precession_phase", "rad"],
            PrecessionRate => ["precession_rate", "rad/s"],
            TorqueShare => ["torque_share", "1"],
            Inclination => ["inclination", "rad"],
            InclinationRate => ["inclination_rate", "rad/s"],
            Rho => ["rho", "rad"],
            Damping => ["damping", "1/s"],
        }
    }

    /// Name of the parameter in commands and files.
    pub fn key(self) -> &'static str {
        self.names()[0]
    }

    /// Unit of the parameter.
    pub fn unit(self) -> &'static str {
        self.names()[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_has_the_unit_of_what_changes_over_seconds() {
        for (of, rate) in [(PrecessionPhase, PrecessionRate), (Inclination, InclinationRate), (F0, F1)] {
            assert_eq!(rate.unit(), format!("{}/s", of.unit()));
        }
        for angle in [Wobble, Chi, PrecessionPhase, Inclination, Rho] {
            assert_eq!(angle.unit(), "rad");
        }
        let others = [(Phase, "1"), (F0, "Hz"), (F2, "Hz/s^2"), (TorqueShare, "1"), (Damping, "1/s")];
        for (parameter, unit) in others {
            assert_eq!(parameter.unit(), unit, "{}", parameter.key());
        }
    }
}
