//! Errors of every kernel in ulp of its conditioned scale, on sweeps into its limits: a check for each family of cases.

use crate::check::{Bound, Check, Kind, Measured, Worst};
use crate::stability::cases::{FAMILIES, Family};

const STATEMENT: &str =
    "every kernel of the family, and its derivatives, stay within their bounds on sweeps into each limit";
const FIGURE: &str = "largest error / its bound in ulp of the conditioned scale";
const REASON: &str = "4 ulp for a formula of one step, 16 for composites and derivatives; exceptions are listed with their condition number";

/// One check for each family: a function pointer knows its place in the list.
macro_rules! of_families {
    ($($place:literal: $id:literal),*) => {
        pub(super) fn checks() -> Vec<Check> {
            vec![$(Check {
                id: $id,
                kind: Kind::Oracle,
                equations: FAMILIES[$place].equations,
                statement: STATEMENT,
                figure: FIGURE,
                bound: Bound::AtMost(1.0),
                reason: REASON,
                measure: || measure(&FAMILIES[$place]),
            }),*]
        }
    };
}

of_families! {
    0: "stability-star",
    1: "stability-orientation",
    2: "stability-dynamics",
    3: "stability-elliptic",
    4: "stability-solutions",
    5: "stability-symmetric",
    6: "stability-mean",
    7: "stability-observables",
    8: "stability-tensor",
    9: "stability-torus"
}

fn measure(family: &Family) -> Result<Measured, String> {
    let mut worst = Worst::default();
    for case in (family.cases)() {
        let found = case.measure(1);
        let of_values = ("value", Some(found.kernel), case.class);
        for (what, errors, class) in [of_values, ("derivative", found.derivative, case.class_of_derivatives)] {
            let Some(errors) = errors else { continue };
            worst.see(errors.ulp / class.bound(), || {
                format!(
                    "{what} {} of {}, {}: {:e} ulp at {:?}",
                    errors.component, case.name, case.limit, errors.ulp, errors.place
                )
            });
        }
    }
    worst.finish()
}
