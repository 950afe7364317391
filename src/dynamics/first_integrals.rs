//! First integrals of a motion: energy, spin component and a third, quadratic one. Eq. (24) and beyond.
//!
//! ```
//! use twofold::dynamics::first_integrals::{energy_in_angles, first_integrals, spin_in_angles};
//! use twofold::{BodyState, EulerAngles, EulerRates, PrincipalCoefficients, RigidSpheroid};
//!
//! let (star, s) = (RigidSpheroid::in_units_of_tc(1.1_f64), PrincipalCoefficients::new([0.02, 0.01, -0.04]));
//! let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 };
//! let rates = EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 };
//! let found = first_integrals(&star, &s.tensor(), &BodyState::from_angles(&star, &angles, &rates));
//! assert!((found.energy - energy_in_angles(&star, &s, &angles, &rates)).abs() < 1e-14);
//! assert!((found.spin - spin_in_angles(&angles, &rates)).abs() < 1e-14);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::kinetic_energy::kinetic_energy;
use crate::dynamics::potential::{anisotropic_potential_in_angles, anisotropic_potential_of_axis};
use crate::dynamics::{AxisState, RigidSpheroid, RotationState};
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

/// Adjugate of a symmetric matrix: `adj(s) s = det(s) 1`, without a division.
pub fn symmetric_adjugate<S: Scalar>(s: &Matrix3<S>) -> Matrix3<S> {
    let (x, y, z) = (s.column(0), s.column(1), s.column(2));
    Matrix3::from_columns(&[y.cross(&z), z.cross(&x), x.cross(&y)])
}

/// The three integrals of a motion of `(n, L)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstIntegrals<S> {
    /// Energy `E = (L.L - (L.n)^2) / (2 I^xx) + (L.n)^2 / (2 I^zz) + C n.(s n)`, Eq. (24) `[firstint]` as in [`energy_in_angles`].
    pub energy: S,
    /// Spin component `Omega^z = L.n / I^zz`, Eq. (24) `[firstint]`.
    pub spin: S,
    /// The third integral, which is not in the paper; `adj(s)` is the adjugate:
    ///
    /// ```text
    /// K = L.(s L) - 2 C I^xx n.(adj(s) n)
    /// ```
    ///
    /// The motion is the Clebsch system on e(3)*; with `E`, `n.n` and `L.n`, `K` makes it integrable, so that every motion is quasi-periodic.
    pub clebsch: S,
}

/// The first integrals of a state.
pub fn first_integrals<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &impl RotationState<S>,
) -> FirstIntegrals<S> {
    let AxisState { axis, momentum } = state.axis_state();
    FirstIntegrals {
        energy: energy(spheroid, s, &axis, &momentum),
        spin: momentum.dot(&axis) / spheroid.inertia_zz,
        clebsch: momentum.dot(&(s * momentum))
            - spheroid.constant_c * spheroid.inertia_xx * axis.dot(&(symmetric_adjugate(s) * axis)) * 2.0,
    }
}

/// [`FirstIntegrals::energy`] alone.
pub(crate) fn energy<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> S {
    let along = momentum.dot(axis);
    let transverse = momentum.cross(axis);
    transverse.dot(&transverse) / (spheroid.inertia_xx * 2.0)
        + along * along / (spheroid.inertia_zz * 2.0)
        + anisotropic_potential_of_axis(spheroid.constant_c, s, axis)
}
