//! `twofold report`.

use clap::Args;
use std::path::PathBuf;
use std::time::Instant;

use super::output_folder::OutputFolder;
use super::verify::{conclude, run_all};
use super::{Failure, tell};
use crate::figures;
use crate::html_report::{Content, environment, page};
use twofold_verify::{checks, report};

#[derive(Args)]
pub(crate) struct ReportArgs {
    /// Write the page into this folder, which is created if necessary
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub(crate) out: PathBuf,
    /// Replace the page if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

const PAGE: &str = "index.html";

pub(super) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let folder = OutputFolder::at(&args.out, args.force, |name| name == PAGE)?;
    let start = Instant::now();
    let results = run_all(checks::all());
    let seconds = start.elapsed().as_secs_f64();
    let figures = figures::all().map_err(Failure::Failed)?;
    let golden = figures::golden_tables(&figures).map_err(Failure::Failed)?;
    finish(args, folder, &Content { results, seconds, golden, figures, environment: environment() })
}

/// Writes the page; fails if a check failed.
fn finish(args: &ReportArgs, folder: OutputFolder, content: &Content) -> Result<(), Failure> {
    folder.write(PAGE, page(content).map_err(Failure::Failed)?.as_bytes())?;
    folder.complete()?;
    let summary = report::summary(&content.results, content.seconds);
    tell(&format!("{summary}\n{}\n", args.out.join(PAGE).display()))?;
    conclude(&content.results)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::html_report::tests::FAILURES;

    #[test]
    fn a_report_of_failures_is_written_and_fails() {
        let out = tempfile::tempdir().expect("a folder");
        let args = ReportArgs { out: out.path().to_owned(), force: false };
        let Ok(folder) = OutputFolder::at(&args.out, false, |name| name == PAGE) else { panic!("a folder is there") };
        assert!(matches!(finish(&args, folder, &FAILURES.1), Err(Failure::Failed(_))));
        assert_eq!(std::fs::read_to_string(out.path().join(PAGE)).expect("a page"), FAILURES.0);
    }
}
