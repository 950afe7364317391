//! `twofold compare`.

use super::{CompareArgs, Failure, print};
use crate::compare::{self, CompareError};

pub(super) fn compare(args: &CompareArgs) -> Result<(), Failure> {
    let comparison = compare::compare(&args.authors_data).map_err(|error| match error {
        CompareError::Input(faults) => Failure::BadInput(faults.join("\n")),
        CompareError::Motion(error) => Failure::Failed(format!("a motion could not be computed: {error}")),
    })?;
    print(&format!("{}\n", if args.json { compare::json(&comparison) } else { compare::text(&comparison) }))?;
    let differing = comparison.differing();
    if differing.is_empty() {
        Ok(())
    } else {
        Err(Failure::Failed(format!("files that differ by more than allowed: {}", differing.join(", "))))
    }
}
