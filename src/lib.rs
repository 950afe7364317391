//! The rotation of spheroidal stars under Lorentz violation, as verified equations.
//!
//! The model of Xu, Gao and Shao, *Precession of spheroids under Lorentz violation and observational consequences for
//! neutron stars*: every equation is a function, generic over the scalar type, with the equation's number and LaTeX label.
//! Nothing here reads a file, prints or starts a thread.

pub mod curvature_coupling;
pub mod dynamics;
pub mod epoch;
pub mod error;
pub mod euler_angles;
pub mod inference;
pub mod lorentz_violation;
pub mod numerics;
pub mod observables;
pub mod parameters;
pub mod plan;
pub mod propagation;
pub mod solutions;
pub mod star;
pub mod straight_line;
pub mod units;

pub use error::Error;
pub use numerics::scalar::{Real, Scalar};
