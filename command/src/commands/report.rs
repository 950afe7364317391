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
    let content = Content { results, seconds, golden, figures, environment: environment() };
    folder.write(PAGE, page(&content).map_err(Failure::Failed)?.as_bytes())?;
    folder.complete()?;
    let summary = report::summary(&content.results, seconds);
    tell(&format!("{summary}\n{}\n", args.out.join(PAGE).display()))?;
    conclude(&content.results)
}
