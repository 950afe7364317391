//! `twofold report`.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::verify::{conclude, run_all};
use super::{Failure, ReportArgs, print};
use crate::html_report::{Content, Environment, page};
use crate::{checks, golden, report};

pub(super) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let destination = Destination::check(&args.out, args.force)?;
    let start = Instant::now();
    let results = run_all(checks::all());
    let seconds = start.elapsed().as_secs_f64();
    let golden = golden::tables().map_err(Failure::Failed)?;
    let content = Content { results, seconds, golden, environment: Environment::of_this_run() };
    let page = page(&content).map_err(Failure::Failed)?;
    let file = destination.write(&page)?;
    print(&format!("{}\n{}\n", report::summary(&content.results, seconds), file.display()))?;
    conclude(&content.results)
}

/// Where the page goes. The folder and the file appear together, when the page is complete.
struct Destination {
    folder: PathBuf,
    file: PathBuf,
    replace: bool,
}

impl Destination {
    /// Refuses, before any work is done, a page that could not be written.
    fn check(folder: &Path, replace: bool) -> Result<Self, Failure> {
        let refuse = |why: String| Err(Failure::BadInput(format!("--out {}: {why}", folder.display())));
        let file = folder.join("index.html");
        if folder.exists() && !folder.is_dir() {
            return refuse("exists and is not a folder".into());
        }
        if file.is_dir() {
            return refuse("index.html in it is a folder".into());
        }
        if file.exists() && !replace {
            return refuse("index.html exists in it; --force replaces it".into());
        }
        let existing = folder.ancestors().find(|ancestor| ancestor.exists()).unwrap_or(Path::new("."));
        if let Err(error) = tempfile::tempfile_in(existing) {
            return refuse(format!("nothing can be written in {}: {error}", existing.display()));
        }
        Ok(Self { folder: folder.to_owned(), file, replace })
    }

    fn write(self, page: &str) -> Result<PathBuf, Failure> {
        let failed =
            |error: std::io::Error| Failure::Failed(format!("{} cannot be written: {error}", self.file.display()));
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let mut part = tempfile::Builder::new()
            .prefix(".index.html.")
            .suffix(".part")
            .make_in(&self.folder, |path| File::options().write(true).create_new(true).open(path))
            .map_err(failed)?;
        part.write_all(page.as_bytes()).map_err(failed)?;
        let named = if self.replace { part.persist(&self.file) } else { part.persist_noclobber(&self.file) };
        named.map_err(|error| failed(error.error))?;
        Ok(self.file)
    }
}
