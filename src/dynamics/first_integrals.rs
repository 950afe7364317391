//! What a motion conserves: the energy, the spin component and a third, quadratic integral. Eq. (24) and beyond.
//!
//! # Example
//!
//! ```
//! # use nalgebra::{Matrix3, Vector3};
//! # use twofold::dynamics::{BodyState, RigidSpheroid};
//! # use twofold::euler_angles::{EulerAngles, EulerRates};
//! # use twofold::lorentz_violation::PrincipalCoefficients;
//! let star = RigidSpheroid::in_units_of_tc(1.1_f64);
//! let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]);
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! use twofold::dynamics::first_integrals::{
//!     clebsch_integral, energy, energy_in_angles, first_integrals, spin, spin_in_angles, symmetric_adjugate,
//! };
//!
//! let tensor = s.tensor();
//! let found = first_integrals(&star, &tensor, &state);
//! assert!((found.energy - energy_in_angles(&star, &s, &angles, &rates)).abs() < 1e-14);
//! assert!((found.spin - spin_in_angles(&angles, &rates)).abs() < 1e-14);
//! assert_eq!(found.energy, energy(&star, &tensor, &state.axis, &state.momentum));
//! assert_eq!(found.spin, spin(&star, &state.axis, &state.momentum));
//! assert_eq!(found.clebsch, clebsch_integral(&star, &tensor, &state.axis, &state.momentum));
//! // adj(s) s = det(s).
//! assert!((symmetric_adjugate(&tensor) * tensor - Matrix3::identity() * tensor.determinant()).amax() < 1e-18);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::dynamics::equations_of_motion::BodyState;
use crate::dynamics::kinetic_energy::kinetic_energy;
use crate::dynamics::potential::{anisotropic_potential_in_angles, anisotropic_potential_of_axis};
use crate::euler_angles::{EulerAngles, EulerRates};
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::scalar::Scalar;

/// Energy `E = T_rot + delta U` in Euler angles, Eq. (24) `[firstint]`.
pub fn energy_in_angles<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    angles: &EulerAngles<S>,
    rates: &EulerRates<S>,
) -> S {
    kinetic_energy(spheroid, angles.beta, rates)
        + anisotropic_potential_in_angles(spheroid.constant_c, s, angles.alpha, angles.beta)
}

/// Spin component `Omega^z = a' cos b + g'`, Eq. (24) `[firstint]`.
pub fn spin_in_angles<S: Scalar>(angles: &EulerAngles<S>, rates: &EulerRates<S>) -> S {
    let (_, cb) = angles.beta.sin_cos();
    rates.alpha * cb + rates.gamma
}

/// Energy `E = (L.L - (L.n)^2) / (2 I^xx) + (L.n)^2 / (2 I^zz) + C n.(s n)` of the regular state, the same as
/// [`energy_in_angles`].
pub fn energy<S: Scalar>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, axis: &Vector3<S>, momentum: &Vector3<S>) -> S {
    let along = momentum.dot(axis);
    let transverse = momentum.cross(axis);
    transverse.dot(&transverse) / (spheroid.inertia_xx * 2.0)
        + along * along / (spheroid.inertia_zz * 2.0)
        + anisotropic_potential_of_axis(spheroid.constant_c, s, axis)
}

/// Spin component `Omega^z = L.n / I^zz` of the regular state, Eq. (24) `[firstint]`.
pub fn spin<S: Scalar>(spheroid: &RigidSpheroid<S>, axis: &Vector3<S>, momentum: &Vector3<S>) -> S {
    momentum.dot(axis) / spheroid.inertia_zz
}

/// The third integral, which the paper does not have:
///
/// ```text
/// K = L.(s L) - 2 C I^xx n.(adj(s) n)
/// ```
///
/// with `adj(s)` the adjugate. The motion of `(n, L)` is the Clebsch system on e(3)*; with `E`, `n.n` and `L.n` this makes
/// it integrable, so every motion is quasi-periodic.
pub fn clebsch_integral<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> S {
    momentum.dot(&(s * momentum))
        - spheroid.constant_c * spheroid.inertia_xx * axis.dot(&(symmetric_adjugate(s) * axis)) * 2.0
}

/// Adjugate of a symmetric matrix: `adj(s) s = det(s) 1`, without a division.
pub fn symmetric_adjugate<S: Scalar>(s: &Matrix3<S>) -> Matrix3<S> {
    let (x, y, z) = (s.column(0), s.column(1), s.column(2));
    Matrix3::from_columns(&[y.cross(&z), z.cross(&x), x.cross(&y)])
}

/// The three integrals of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstIntegrals<S> {
    /// Energy `E`, Eq. (24) `[firstint]`.
    pub energy: S,
    /// Spin component `Omega^z`, Eq. (24) `[firstint]`.
    pub spin: S,
    /// Third integral `K`, see [`clebsch_integral`].
    pub clebsch: S,
}

/// The three integrals of a state.
pub fn first_integrals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &BodyState<S>,
) -> FirstIntegrals<S> {
    FirstIntegrals {
        energy: energy(spheroid, s, &state.axis, &state.momentum),
        spin: spin(spheroid, &state.axis, &state.momentum),
        clebsch: clebsch_integral(spheroid, s, &state.axis, &state.momentum),
    }
}
