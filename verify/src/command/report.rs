//! `twofold report`.

use std::thread;
use std::time::Instant;

use super::output_folder::OutputFolder;
use super::verify::{conclude, run_all};
use super::{Failure, ReportArgs, tell};
use crate::html_report::{Content, Environment, page};
use crate::{checks, figures, golden, report};

const PAGE: &str = "index.html";

pub(super) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let folder = OutputFolder::at(&args.out, args.force, |name| name == PAGE)?;
    let start = Instant::now();
    let results = run_all(checks::all());
    let seconds = start.elapsed().as_secs_f64();
    let (golden, figures) = thread::scope(|scope| {
        let golden = scope.spawn(golden::tables);
        let figures = figures::all();
        (golden.join().unwrap_or_else(|_| Err("the golden tables panicked".to_owned())), figures)
    });
    let content = Content {
        results,
        seconds,
        golden: golden.map_err(Failure::Failed)?,
        figures: figures.map_err(Failure::Failed)?,
        environment: Environment::of_this_run(),
    };
    folder.write(PAGE, page(&content).map_err(Failure::Failed)?.as_bytes())?;
    folder.complete()?;
    let summary = report::summary(&content.results, seconds);
    tell(&format!("{summary}\n{}\n", args.out.join(PAGE).display()))?;
    conclude(&content.results)
}
