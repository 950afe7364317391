//! `twofold run`.

use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use tempfile::NamedTempFile;

use super::{Failure, RunArgs};
use crate::scene_file::Scene;
use crate::trajectory::{self, Summary, TrajectoryError};

pub(super) fn run(args: &RunArgs) -> Result<(), Failure> {
    let scene = Scene::named(&args.scene).map_err(|error| Failure::BadInput(error.to_string()))?;
    let output = args.out.as_deref().map(|path| OutputFile::beside(path, args.force)).transpose()?;
    note_units(&scene);
    let mut progress = Progress::new(output.is_some() || !io::stdout().is_terminal());
    let summary = match &output {
        None => trajectory::write_csv(&scene, io::stdout().lock(), |part| progress.show(part)),
        Some(output) => {
            output.remove_on_interrupt();
            let file = BufWriter::new(output.temporary.as_file());
            trajectory::write_csv(&scene, file, |part| progress.show(part))
        }
    };
    drop(progress);
    let summary = match (summary, output) {
        (Err(error), None) if error.is_closed_pipe() => return Ok(()),
        (summary, None) => summary.map_err(failed)?,
        (summary, Some(output)) => {
            let summary = summary.map_err(failed)?;
            output.complete()?;
            summary
        }
    };
    note_poles(&scene, &summary);
    Ok(())
}

fn failed(error: TrajectoryError) -> Failure {
    Failure::Failed(error.to_string())
}

fn note_units(scene: &Scene) {
    if scene.units.are_physical() {
        let ratio = scene.spheroid.inertia_zz / scene.spheroid.inertia_xx;
        note(&format!("t_c = {:.6e} s, I^zz/I^xx = {ratio:.9}; times are in s, L in g cm^2/s", scene.units.time));
    }
}

fn note_poles(scene: &Scene, summary: &Summary) {
    if let Some(time) = summary.first_on_pole {
        note(&format!(
            "the symmetry axis is on a pole in {} of {} rows, first at t = {time:?} {}: alpha, gamma and the rates do not \
             exist there and are left empty",
            summary.rows_on_pole, summary.rows, scene.units.time_name
        ));
    }
}

fn note(text: &str) {
    let _ = writeln!(io::stderr(), "note: {text}");
}

/// A bar on standard error, if that is a terminal, from two seconds on.
struct Progress {
    bar: ProgressBar,
    start: Instant,
    to_be_shown: bool,
}

impl Progress {
    const QUIET: Duration = Duration::from_secs(2);
    const STEPS: f64 = 1000.0;

    fn new(to_be_shown: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(Self::STEPS as u64), ProgressDrawTarget::hidden())
            .with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template("{percent:>3} % [{bar:40}] {elapsed}, {eta} left") {
            bar.set_style(style);
        }
        Self { bar, start: Instant::now(), to_be_shown }
    }

    /// Says which part is done, from 0 to 1.
    fn show(&mut self, part: f64) {
        if self.to_be_shown && self.start.elapsed() > Self::QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.to_be_shown = false;
        }
        self.bar.set_position((part * Self::STEPS) as u64);
    }
}

/// Status of a command ended by an interrupt, by the shells' convention.
const INTERRUPTED: i32 = 130;

/// A file that appears under its name only when it is complete.
struct OutputFile {
    path: PathBuf,
    temporary: NamedTempFile,
    replace: bool,
}

impl OutputFile {
    /// Starts a temporary file in the folder of `path`.
    fn beside(path: &Path, replace: bool) -> Result<Self, Failure> {
        let refuse = |why: String| Failure::BadInput(format!("--out {}: {why}", path.display()));
        if path == Path::new("-") {
            return Err(refuse("is not standard output here: leave --out away, or write ./- for a file".into()));
        }
        match fs::metadata(path) {
            Ok(found) if !found.is_file() => return Err(refuse("exists and is not a regular file".into())),
            Ok(_) if !replace => return Err(refuse("exists; --force replaces it".into())),
            Err(_) if !replace && path.is_symlink() => {
                return Err(refuse("is a link to nothing; --force replaces it".into()));
            }
            _ => {}
        }
        // A link is followed, so that what it points to is replaced and not the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let Some(name) = path.file_name() else { return Err(refuse("is not the name of a file".into())) };
        let mut prefix = std::ffi::OsString::from(".");
        prefix.push(name);
        prefix.push(".");
        let temporary = tempfile::Builder::new()
            .prefix(&prefix)
            .suffix(".part")
            .make_in(folder, |part| File::options().write(true).create_new(true).open(part))
            .map_err(|error| refuse(format!("no file can be made in {}: {error}", folder.display())))?;
        Ok(Self { path, temporary, replace })
    }

    /// Removes the temporary file and ends the process on an interrupt (Ctrl-C), hang-up or request to terminate. Where
    /// one of these is ignored already (`nohup`), all are left as they are.
    fn remove_on_interrupt(&self) {
        let temporary = self.temporary.path().to_owned();
        let _ = ctrlc::try_set_handler(move || {
            let _ = fs::remove_file(&temporary);
            // The terminal's line has the bar and ^C on it.
            let line_end = if io::stderr().is_terminal() { "\n" } else { "" };
            let _ = writeln!(io::stderr(), "{line_end}error: interrupted: nothing was written");
            process::exit(INTERRUPTED);
        });
    }

    /// Gives the file its name.
    fn complete(self) -> Result<(), Failure> {
        let named = if self.replace {
            self.temporary.persist(&self.path)
        } else {
            self.temporary.persist_noclobber(&self.path)
        };
        match named {
            Ok(_) => Ok(()),
            Err(error) => Err(Failure::Failed(format!("{} cannot be written: {}", self.path.display(), error.error))),
        }
    }
}
