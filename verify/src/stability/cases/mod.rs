//! The cases, by subject.

mod braking;
mod dynamics;
mod elliptic;
mod mean;
mod observables;
mod orientation;
mod parts;
mod solutions;
mod star;
mod symmetric;
mod tensor;
mod torus;

use super::{Case, measure};
use crate::prelude::*;

/// A family of cases, with one check.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// One word.
    pub name: &'static str,
    /// Id of its check.
    pub check: &'static str,
    /// Equation numbers.
    pub equations: &'static [u8],
    /// Description.
    pub subject: &'static str,
    /// Its cases.
    pub cases: fn() -> Vec<Case>,
    /// The largest error of its cases relative to the bound.
    pub measure: fn() -> Result<Measured, String>,
}

macro_rules! families {
    ($($name:ident $equations:tt $subject:literal;)+) => {
        /// All families, in the order of the page.
        pub const FAMILIES: &[Family] = &[$(Family {
            name: stringify!($name),
            check: concat!("stability-", stringify!($name)),
            equations: &$equations,
            subject: $subject,
            cases: $name::cases,
            measure: || measure::largest_over_bound($name::cases()),
        }),+];
    };
}

families! {
    star [10, 12, 17, 19, 43, 72, 73, 74, 75, 76, 77, 78, 79]
        "shape, potential coefficients, mass, energies and constant C of uniform bodies, multipoles of any star";
    orientation [7, 8, 9, 22, 46, 60, 62, 70]
        "Euler angles, rotation matrix, rates and their inverses";
    dynamics [2, 4, 5, 6, 11, 13, 19, 21, 23, 24, 25, 28, 35, 59, 63, 64, 65, 66, 67, 68, 69, 71]
        "potential, torque, energies, equations of motion, integrals, source of the wave and strain";
    elliptic [25]
        "Carlson's integrals, Jacobi's functions, theta functions";
    solutions [26, 27, 28, 29, 30, 31, 32, 33, 34, 39, 48, 57]
        "free rotation, steady precession, perturbation solutions";
    symmetric [25]
        "the exact motion for a tensor symmetric about Z";
    mean [25]
        "mean Hamiltonian, generator, slow precession, top, separatrix";
    observables [35, 37, 38, 40, 41, 42, 44, 45, 47, 49, 50, 51, 52, 53, 54, 55, 56, 71]
        "spin axis, bounds, beam, pulses, position angle, harmonics, eta, units, epochs";
    tensor [31, 36]
        "principal axes and the nearest symmetric tensor";
    torus [24]
        "states on tori and their exact frequencies";
    braking []
        "harmonics of the torque of a wobbling star, a wobble that friction damps";
}
