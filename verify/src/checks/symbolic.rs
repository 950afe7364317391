//! The second derivation: kernels compared with exact values that SymPy derived from the Lagrangian.

use crate::prelude::*;
use crate::symbolic::{DATA, Document, compare_closed, compare_doubles, compare_field};

const EQUATIONS: [u8; 44] = [
    6, 7, 8, 9, 11, 13, 17, 21, 22, 23, 24, 25, 28, 29, 30, 31, 32, 33, 37, 38, 39, 42, 45, 46, 47, 49, 50, 51, 52, 54,
    56, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71,
];

checks! {
    /// all kernels without roots or inverse functions have the values that computer algebra derives from the Lagrangian, at rational points
    Exact "symbolic-exact" EQUATIONS: || compare_field(&Document::parse(DATA)?);
    AtMost(0.0) "values that differ in the field modulo 2^61 - 1, 8 rational points";
    because "exact arithmetic on both sides";
    /// the same kernels have these values in doubles
    Oracle "symbolic-rounding" EQUATIONS: || compare_doubles(&Document::parse(DATA)?);
    AtMost(2.0) "largest error / (2.2e-16 x sum of magnitudes of its terms), 8 rational points";
    because "each term is rounded some tens of times by half an ulp at most, independently of the others";
    /// coefficients and C of spheroids, steady and free precession, mean Hamiltonian with its transformation, wave harmonics, bound, braked rotation and
    /// damped wobble are what computer algebra derives, from the integral over directions, the Lagrangian and the law of braking
    Oracle "symbolic-closed-forms" [12, 15, 17, 19, 26, 40, 43, 48, 68, 71, 73, 74, 75, 77, 78, 79]:
        || compare_closed(&Document::parse(DATA)?);
    AtMost(16.0) "largest error / (2.2e-16 x its scale: the value, or the vector or sum that it is part of), 8 rational points";
    because "some tens of roundings by half an ulp at most, of numbers no larger than the scale";
}
