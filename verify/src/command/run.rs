//! `twofold run`.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{Failure, RunArgs};
use crate::scene_file::Scene;
use crate::trajectory::{self, Summary, TrajectoryError};

pub(super) fn run(args: &RunArgs) -> Result<(), Failure> {
    let scene = Scene::named(&args.scene).map_err(|error| Failure::BadInput(error.to_string()))?;
    let output = args.out.as_deref().map(|path| OutputFile::beside(path, args.force)).transpose()?;
    note_units(&scene);
    let summary = match output {
        None => match trajectory::write_csv(&scene, io::stdout().lock()) {
            Err(error) if error.is_closed_pipe() => return Ok(()),
            result => result.map_err(failed)?,
        },
        Some(output) => {
            let summary = trajectory::write_csv(&scene, BufWriter::new(output.temporary.as_file())).map_err(failed)?;
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
        match fs::metadata(path) {
            Ok(found) if !found.is_file() => return Err(refuse("exists and is not a regular file".into())),
            Ok(_) if !replace => return Err(refuse("exists; --force replaces it".into())),
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
