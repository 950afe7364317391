//! The parameters for derivatives and fits.

use Parameter::*;

use super::{Parameters, ThirdRate};
use crate::numerics::scalar::Scalar;

/// One number of [`Parameters`], or a combination of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parameter {
    /// `I^xx`.
    InertiaXx,
    /// `I^zz`.
    InertiaZz,
    /// Oblateness `eps = (I^zz - I^xx) / I^xx`, changed through `I^zz`.
    Oblateness,
    /// The constant `C`.
    ConstantC,
    /// The component `s^IJ` for two of the indices 0, 1, 2, in either order. The tensor is symmetric: `s^JI` changes with it.
    S(usize, usize),
    /// A factor multiplying the whole tensor `s^IJ`.
    SScale,
    /// `2 s^ZZ - s^XX - s^YY`. A change of this parameter, the next one or the trace keeps the other two fixed.
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
    /// Initial `Omega^z`. With the other rates fixed, it changes by the same amount as the rate of `gamma`.
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
    /// A factor multiplying the strain, for `I^xx` over distance equal to one.
    Strain,
}

impl Parameter {
    /// The individual numbers that a motion depends on.
    pub const OF_MOTION: [Self; 15] = [
        InertiaXx,
        InertiaZz,
        ConstantC,
        S(0, 0),
        S(1, 1),
        S(2, 2),
        S(0, 1),
        S(0, 2),
        S(1, 2),
        Alpha,
        Beta,
        Gamma,
        AlphaRate,
        BetaRate,
        GammaRate,
    ];

    /// The parameters that data depend on in addition to those of the motion.
    pub(crate) const OF_SIGHT: [Self; 6] = [Chi, Delta, Rho, ThetaO, PhiO, Strain];

    /// The parameters that can be fitted in units of `I^xx = 1`.
    pub const FITTED: [Self; 21] = [
        Oblateness,
        Spin,
        ConstantC,
        SScale,
        SAxial,
        SAsymmetry,
        STrace,
        S(0, 1),
        S(0, 2),
        S(1, 2),
        Alpha,
        Beta,
        Gamma,
        AlphaRate,
        BetaRate,
        Chi,
        Delta,
        Rho,
        ThetaO,
        PhiO,
        Strain,
    ];

    /// The parameters that the pulses of a beam determine, if the frame is the principal one of `s^IJ`.
    pub const OF_PULSES: [Self; 13] =
        [Oblateness, Spin, SAxial, SAsymmetry, Alpha, Beta, Gamma, AlphaRate, BetaRate, Chi, Rho, ThetaO, PhiO];

    /// The parameters that the strain determines in the same frame if the distance is known. The strain does not depend on the
    /// beam or on `gamma`.
    pub const OF_STRAIN: [Self; 10] =
        [Oblateness, Spin, SAxial, SAsymmetry, Alpha, Beta, AlphaRate, BetaRate, ThetaO, PhiO];

    fn names(self) -> [&'static str; 2] {
        match self {
            InertiaXx => ["inertia_xx", "I^xx"],
            InertiaZz => ["inertia_zz", "I^zz"],
            Oblateness => ["eps"; 2],
            ConstantC => ["c", "C"],
            S(0, 0) => ["s_xx", "s^XX"],
            S(1, 1) => ["s_yy", "s^YY"],
            S(2, 2) => ["s_zz", "s^ZZ"],
            S(0, 1) | S(1, 0) => ["s_xy", "s^XY"],
            S(0, 2) | S(2, 0) => ["s_xz", "s^XZ"],
            S(..) => ["s_yz", "s^YZ"],
            SScale => ["s_scale", "|s|"],
            SAxial => ["s_axial", "2 s^ZZ - s^XX - s^YY"],
            SAsymmetry => ["s_asymmetry", "s^XX - s^YY"],
            STrace => ["s_trace", "tr s"],
            Alpha => ["alpha"; 2],
            Beta => ["beta"; 2],
            Gamma => ["gamma"; 2],
            AlphaRate => ["alpha_rate", "alpha'"],
            BetaRate => ["beta_rate", "beta'"],
            GammaRate => ["gamma_rate", "gamma'"],
            Spin => ["spin", "Omega^z"],
            Chi => ["chi"; 2],
            Delta => ["delta"; 2],
            Rho => ["rho"; 2],
            ThetaO => ["theta_o"; 2],
            PhiO => ["phi_o"; 2],
            Strain => ["strain_scale", "I^xx / r"],
        }
    }

    /// Name in commands and files.
    pub fn key(self) -> &'static str {
        self.names()[0]
    }

    /// Mathematical symbol.
    pub fn symbol(self) -> &'static str {
        self.names()[1]
    }

    /// The parameter of [`FITTED`](Self::FITTED) with a name.
    pub fn named(key: &str) -> Option<Self> {
        Self::FITTED.into_iter().find(|parameter| parameter.key() == key)
    }

    /// Whether the parameter is a part of `s^IJ`.
    pub fn is_of_s(self) -> bool {
        matches!(self, S(..) | SScale | SAxial | SAsymmetry | STrace)
    }

    /// Value of the parameter.
    pub fn value<T: Scalar>(self, parameters: &Parameters<T>) -> T {
        let s = &parameters.coefficients;
        match self {
            Oblateness => parameters.spheroid.oblateness(),
            SAxial => s[(2, 2)] * 2.0 - s[(0, 0)] - s[(1, 1)],
            SAsymmetry => s[(0, 0)] - s[(1, 1)],
            STrace => s.trace(),
            GammaRate => parameters.rates().gamma,
            Spin => parameters.spin(),
            number => *number.number(&mut { *parameters }),
        }
    }

    /// The number that the parameter refers to, unless it is a combination of several.
    fn number<T: Scalar>(self, parameters: &mut Parameters<T>) -> &mut T {
        let Parameters { spheroid, coefficients: s, angles, .. } = parameters;
        match self {
            InertiaXx => &mut spheroid.inertia_xx,
            InertiaZz => &mut spheroid.inertia_zz,
            ConstantC => &mut spheroid.constant_c,
            S(i, j) => &mut s[(i, j)],
            SScale => &mut parameters.s_scale,
            Alpha => &mut angles.alpha,
            Beta => &mut angles.beta,
            Gamma => &mut angles.gamma,
            AlphaRate => &mut parameters.alpha_rate,
            BetaRate => &mut parameters.beta_rate,
            GammaRate | Spin => match &mut parameters.third_rate {
                ThirdRate::Gamma(rate) | ThirdRate::Spin(rate) => rate,
            },
            Chi => &mut parameters.chi,
            Delta => &mut parameters.delta,
            Rho => &mut parameters.rho,
            ThetaO => &mut parameters.theta_o,
            PhiO => &mut parameters.phi_o,
            Strain => &mut parameters.strain_scale,
            Oblateness | SAxial | SAsymmetry | STrace => unreachable!("combinations of numbers"),
        }
    }

    /// Adds `change` to the parameter; all other numbers of the struct stay fixed.
    ///
    /// # Panics
    /// For an index of `s^IJ` above 2.
    pub fn add<T: Scalar>(self, parameters: &mut Parameters<T>, change: T) {
        let s = &mut parameters.coefficients;
        let mut diagonal = |parts: [f64; 3]| (0..3).for_each(|i| s[(i, i)] += change * parts[i]);
        match self {
            SAxial => diagonal([-1.0 / 6.0, -1.0 / 6.0, 1.0 / 3.0]),
            SAsymmetry => diagonal([0.5, -0.5, 0.0]),
            STrace => diagonal([1.0 / 3.0; 3]),
            Oblateness => {
                let spheroid = &mut parameters.spheroid;
                spheroid.inertia_zz = spheroid.inertia_xx * (spheroid.oblateness() + change + T::one());
            }
            number => {
                match number {
                    S(i, j) if i != j => s[(j, i)] += change,
                    SScale => *s *= (parameters.s_scale + change) / parameters.s_scale,
                    _ => {}
                }
                *number.number(parameters) += change;
            }
        }
    }
}
