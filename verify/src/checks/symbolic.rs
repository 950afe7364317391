//! The second derivation: kernels against exact values that SymPy derived from the Lagrangian.

use crate::check::{Bound, Check, Kind, Measured};
use crate::symbolic::{Comparison, DATA, Document, compare_doubles, compare_field};

const EQUATIONS: &[u8] = &[
    6, 7, 8, 9, 11, 13, 17, 21, 22, 23, 24, 25, 28, 29, 30, 31, 32, 33, 37, 38, 39, 42, 45, 46, 47, 49, 50, 51, 52, 54,
    56, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71,
];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "symbolic-exact",
            kind: Kind::Exact,
            equations: EQUATIONS,
            statement: "47 kernels have the values that computer algebra derives from the Lagrangian, at rational points",
            figure: "values that differ in the field modulo 2^61 - 1, 8 rational points",
            bound: Bound::AtMost(0.0),
            reason: "exact arithmetic on both sides",
            measure: || compare_field(&Document::parse(DATA)?).map(measured),
        },
        Check {
            id: "symbolic-rounding",
            kind: Kind::Oracle,
            equations: EQUATIONS,
            statement: "the same 47 kernels have these values in doubles",
            figure: "largest error / (2.2e-16 x sum of magnitudes of its terms), 8 rational points",
            bound: Bound::AtMost(2.0),
            reason: "each term is rounded some tens of times by half an ulp at most, in directions that have no reason to agree",
            measure: || compare_doubles(&Document::parse(DATA)?).map(|[rational, _]| measured(rational)),
        },
        Check {
            id: "symbolic-closed-forms",
            kind: Kind::Oracle,
            equations: &[12, 15, 17, 19, 26, 40, 43, 48, 68, 71, 73, 74, 75, 77, 78, 79],
            statement: "coefficients and C of spheroids, steady and free precession, mean Hamiltonian with its transformation, wave \
                 harmonics and bound are what computer algebra derives, from the integral over directions and from the Lagrangian",
            figure: "largest error / (2.2e-16 x its scale: the value, or the vector or sum that it is part of), 8 rational points",
            bound: Bound::AtMost(16.0),
            reason: "some tens of roundings by half an ulp at most, of numbers no larger than the scale",
            measure: || compare_doubles(&Document::parse(DATA)?).map(|[_, closed]| measured(closed)),
        },
    ]
}

fn measured(comparison: Comparison) -> Measured {
    Measured::new(comparison.figure, comparison.detail)
}
