//! Anisotropic potential energy of two point masses, in the SME and in the PPN formalism. Eqs. (2), (4).
//!
//! Geometrised units, `G = c = 1`. A body consists of pairs of masses: half the double sum of Eq. (2) over its mass is the
//! self-energy [`anisotropic_potential_of_body`](crate::dynamics::potential::anisotropic_potential_of_body), Eq. (6).
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::point_masses::{anisotropic_potential_of_masses, preferred_frame_potential_of_masses};
//! use twofold::lorentz_violation::coefficients_from_preferred_frame;
//!
//! let (masses, distance, direction) = ([2.0_f64, 3.0], 10.0, Vector3::new(0.6, 0.0, 0.8));
//! // The unit tensor scales Newton's -m_A m_B / r alone: by a half.
//! let isotropic = anisotropic_potential_of_masses(&Matrix3::identity(), masses, distance, &direction);
//! assert!((isotropic + 0.3).abs() < 1e-16);
//! // With the replacement (5) it is the PPN form.
//! let (alpha_2, w) = (1e-3, Vector3::new(1e-3, 0.0, 0.0));
//! let s = coefficients_from_preferred_frame(alpha_2, &w);
//! let sme = anisotropic_potential_of_masses(&s, masses, distance, &direction);
//! assert!((sme - preferred_frame_potential_of_masses(alpha_2, &w, masses, distance, &direction)).abs() < 1e-24);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::numerics::scalar::Scalar;

/// `delta U = -(1/2) s^ij m_A m_B n^i n^j / r` of two point masses, Eq. (2) `[pecorrect]`, with `r n = x_A - x_B`: `direction` is the unit
/// vector `n` in the frame of `s`, `distance` is `r`, not zero. Energies, masses and lengths in geometrised units.
pub fn anisotropic_potential_of_masses<S: Scalar>(
    s: &Matrix3<S>,
    masses: [S; 2],
    distance: S,
    direction: &Vector3<S>,
) -> S {
    -(masses[0] * masses[1] * direction.dot(&(s * direction)) / distance / 2.0)
}

/// `delta U_PPN = (1/2) alpha_2 m_A m_B (w . n)^2 / r` of two point masses, Eq. (4) `[ppndeu]`, with the velocity `w` relative to the preferred
/// frame in units of c, and Will's `alpha_2`, twice Nordtvedt's; the rest as in [`anisotropic_potential_of_masses`].
///
/// With the replacement (5) `[replace]` it is Eq. (2).
pub fn preferred_frame_potential_of_masses<S: Scalar>(
    alpha_2: S,
    w: &Vector3<S>,
    masses: [S; 2],
    distance: S,
    direction: &Vector3<S>,
) -> S {
    let along = w.dot(direction);
    alpha_2 * masses[0] * masses[1] * along * along / distance / 2.0
}
