//! The star: uniform spheroids and ellipsoids, any axisymmetric density, the constant C and the virial relation.
//! Eqs. (6), (10)-(20), (43), (58), (72)-(79).
//!
//! Everything is in units with G = 1 (and c = 1): any set in which mass, length and time are consistent, for instance
//! [`units::geometrised`](crate::units::geometrised).

pub mod axisymmetric;
pub mod deformation;
pub mod ellipsoid;
pub mod estimates;
pub mod maclaurin;
pub mod potential_coefficients;
pub mod spheroid_shape;
pub mod uniform_spheroid;

/// A symmetric tensor of an axisymmetric star in its body frame: diagonal, with `xx = yy`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisymmetricTensor<S> {
    /// The components `xx = yy`, perpendicular to the symmetry axis.
    pub xx: S,
    /// The component `zz`, along the symmetry axis.
    pub zz: S,
}
