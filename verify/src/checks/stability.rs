//! Errors of every kernel in ulp of its conditioned scale, on sweeps into its limits: one check for each family of cases.

use crate::prelude::*;
use crate::stability::cases::FAMILIES;

pub(super) fn checks() -> Vec<Check> {
    let of_family = FAMILIES.iter().map(|family| Check {
        id: family.check,
        kind: Kind::Oracle,
        equations: family.equations,
        statement: "every kernel of the family, and its derivatives, stay within their bounds on sweeps into each limit",
        figure: "largest error / its bound in ulp of the conditioned scale",
        bound: Bound::AtMost(1.0),
        reason: "4 ulp for a formula of one step, 16 for composites and derivatives; exceptions are listed with their condition number",
        measure: family.measure,
    });
    of_family.collect()
}
