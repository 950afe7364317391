//! `twofold compare`.

use super::{Failure, print};
use crate::compare;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct CompareArgs {
    /// Folder with the authors' files: tp1.dat, mntp1.dat, ...
    #[arg(long, value_name = "DIR")]
    pub(crate) authors_data: PathBuf,
    /// Print the comparison as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

pub(super) fn compare(args: &CompareArgs) -> Result<(), Failure> {
    let comparison = compare::compare(&args.authors_data)?;
    print(&format!("{}\n", if args.json { compare::json(&comparison) } else { compare::text(&comparison) }))?;
    let differing = comparison.differing();
    if differing.is_empty() {
        Ok(())
    } else {
        Err(Failure::Failed(format!("files that differ by more than allowed: {}", differing.join(", "))))
    }
}
