//! Elliptic integrals and functions that carry derivatives: Carlson's symmetric integrals, Jacobi's functions.

pub mod carlson;
pub mod jacobi;
pub mod theta;
