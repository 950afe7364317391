//! The cases, by subject.

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

use super::Case;

/// A family of cases: one check each.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// Kebab-case, as in the id of the check.
    pub name: &'static str,
    /// In words.
    pub subject: &'static str,
    /// Equation numbers.
    pub equations: &'static [u8],
    /// Its cases.
    pub cases: fn() -> Vec<Case>,
}

/// All families, in the order of the page.
pub const FAMILIES: &[Family] = &[
    Family {
        name: "star",
        subject: "shape, potential coefficients, mass, energies and constant C of uniform bodies, multipoles of any star",
        equations: &[10, 12, 17, 19, 43, 72, 73, 74, 75, 76, 77, 78, 79],
        cases: star::cases,
    },
    Family {
        name: "orientation",
        subject: "Euler angles, rotation matrix, rates and their inverses",
        equations: &[7, 8, 9, 22, 46, 60, 62, 70],
        cases: orientation::cases,
    },
    Family {
        name: "dynamics",
        subject: "potential, torque, energies, equations of motion, integrals, source of the wave and strain",
        equations: &[2, 4, 5, 6, 11, 13, 19, 21, 23, 24, 25, 28, 35, 59, 63, 64, 65, 66, 67, 68, 69, 71],
        cases: dynamics::cases,
    },
    Family {
        name: "elliptic",
        subject: "Carlson's integrals, Jacobi's functions, theta functions",
        equations: &[25],
        cases: elliptic::cases,
    },
    Family {
        name: "solutions",
        subject: "free rotation, steady precession, perturbation solutions",
        equations: &[26, 27, 28, 29, 30, 31, 32, 33, 34, 39, 48, 57],
        cases: solutions::cases,
    },
    Family {
        name: "symmetric",
        subject: "the exact motion for a tensor symmetric about Z",
        equations: &[25],
        cases: symmetric::cases,
    },
    Family {
        name: "mean",
        subject: "mean Hamiltonian, generator, slow precession, top, separatrix",
        equations: &[25],
        cases: mean::cases,
    },
    Family {
        name: "observables",
        subject: "spin axis, bounds, beam, pulses, position angle, harmonics, eta, units, epochs",
        equations: &[35, 37, 38, 40, 41, 42, 44, 45, 47, 49, 50, 51, 52, 53, 54, 55, 56, 71],
        cases: observables::cases,
    },
    Family {
        name: "tensor",
        subject: "principal axes and the nearest symmetric tensor",
        equations: &[31, 36],
        cases: tensor::cases,
    },
    Family {
        name: "torus",
        subject: "states on tori and their exact frequencies",
        equations: &[24],
        cases: torus::cases,
    },
];
