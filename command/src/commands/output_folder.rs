//! A folder in which each file appears under its name only when it is complete, and none before all are.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::{TempDir, TempPath};

use super::Failure;
use super::interrupt::{hold_requests, unfinished};
use super::output_file::refuse_dash;

/// A folder that is being filled.
pub(super) struct OutputFolder {
    path: PathBuf,
    /// Whether the folder was created for this output.
    new: bool,
    replace: bool,
    /// Folder of the files until all are complete: inside the output folder, so that they can be moved at once.
    temporary: Option<TempDir>,
}

impl OutputFolder {
    /// The folder `path`, created if it does not exist. Refused if it contains a file with a name that `would_write`
    /// accepts, unless files may be replaced; anything but a file is never replaced.
    pub(super) fn at(path: &Path, replace: bool, would_write: impl Fn(&str) -> bool) -> Result<Self, Failure> {
        let refuse = |why: String| Failure::BadInput(format!("--out {}: {why}", path.display()));
        refuse_dash(path, "")?;
        let new = !path.exists();
        if new {
            if path.is_symlink() {
                return Err(refuse("is a broken link".into()));
            }
            let made = path.to_owned();
            // The folder is removed only if it is empty.
            unfinished(|| fs::create_dir_all(path), |()| move || drop(fs::remove_dir(&made)))
                .map_err(|error| refuse(format!("cannot create the folder: {error}")))?;
        } else if !path.is_dir() {
            return Err(refuse("exists and is not a folder".into()));
        }
        let mut folder = Self { path: path.to_owned(), new, replace, temporary: None };
        let entries = fs::read_dir(path).map_err(|error| refuse(format!("cannot be read: {error}")))?;
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut found: Vec<_> = names.filter(|name| would_write(name)).collect();
        found.sort();
        if let Some(name) = found.iter().find(|name| fs::metadata(path.join(name)).is_ok_and(|found| !found.is_file()))
        {
            return Err(refuse(format!("{name} exists there and is not a regular file")));
        }
        match &found[..] {
            _ if replace => {}
            [] => {}
            [only] => return Err(refuse(format!("{only} exists there; --force replaces it"))),
            [first, more @ ..] => {
                let count = more.len();
                return Err(refuse(format!("{first} and {count} more exist there; --force replaces them")));
            }
        }
        let temporary = unfinished(
            || tempfile::Builder::new().prefix(".figures.").suffix(".part").tempdir_in(path),
            |temporary| {
                let part = temporary.path().to_owned();
                move || drop(fs::remove_dir_all(&part))
            },
        );
        folder.temporary = Some(temporary.map_err(|error| refuse(format!("cannot create a file there: {error}")))?);
        Ok(folder)
    }

    /// Writes a file to the temporary folder.
    pub(super) fn write(&self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let Some(temporary) = &self.temporary else { return Ok(()) };
        // The folder could not be removed if a file was added during the removal.
        let _held = hold_requests();
        fs::write(temporary.path().join(name), content)
            .map_err(|error| cannot_be_written(&self.path.join(name), &error))
    }

    /// Moves the files to their names and returns their number. If one cannot have its name, those moved before it keep
    /// theirs; without permission to replace, none takes the name of a file that has appeared since.
    pub(super) fn complete(mut self) -> Result<usize, Failure> {
        let Some(temporary) = self.temporary.take() else { return Ok(0) };
        let _held = hold_requests();
        let mut count = 0;
        for entry in fs::read_dir(temporary.path()).map_err(|error| cannot_be_written(&self.path, &error))? {
            let entry = entry.map_err(|error| cannot_be_written(&self.path, &error))?;
            let target = self.path.join(entry.file_name());
            let complete =
                TempPath::try_from_path(entry.path()).map_err(|error| cannot_be_written(&self.path, &error))?;
            let named = if self.replace { complete.persist(&target) } else { complete.persist_noclobber(&target) };
            named.map_err(|error| cannot_be_written(&target, &error.error))?;
            count += 1;
        }
        Ok(count)
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        drop(self.temporary.take());
        if self.new {
            // The folder is removed only if it is empty.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

fn cannot_be_written(path: &Path, error: &io::Error) -> Failure {
    Failure::Failed(format!("{} cannot be written: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{Failure, OutputFolder};

    /// The final content of a file that appears while the folder is filled, and the failure.
    fn meanwhile(replace: bool) -> (String, Option<String>) {
        let parent = tempfile::tempdir().expect("folder");
        let folder = OutputFolder::at(parent.path(), replace, |name| name == "page").expect("empty folder");
        assert!(folder.write("page", b"ours").is_ok());
        fs::write(parent.path().join("page"), "theirs").expect("file");
        let failure = match folder.complete() {
            Err(Failure::Failed(why)) => Some(why),
            _ => None,
        };
        let names: Vec<_> = fs::read_dir(parent.path()).expect("folder").collect();
        assert_eq!(names.len(), 1, "{names:?}");
        (fs::read_to_string(parent.path().join("page")).expect("text"), failure)
    }

    /// A command that fails removes the folder that it created, and keeps an empty one that existed.
    #[test]
    fn a_folder_of_the_user_stays_where_nothing_is_written() {
        let parent = tempfile::tempdir().expect("folder");
        let (theirs, ours) = (parent.path().join("theirs"), parent.path().join("ours"));
        fs::create_dir(&theirs).expect("folder");
        for path in [&theirs, &ours] {
            let Ok(folder) = OutputFolder::at(path, false, |_| false) else { panic!("a folder may be there") };
            assert!(folder.write("page", b"half").is_ok());
            drop(folder);
        }
        assert_eq!([theirs.exists(), ours.exists()], [true, false]);
        assert_eq!(fs::read_dir(&theirs).expect("folder").count(), 0);
    }

    #[test]
    fn a_file_that_appears_meanwhile_is_replaced_only_with_leave() {
        let (text, failure) = meanwhile(false);
        assert_eq!(text, "theirs");
        assert!(failure.is_some_and(|why| why.contains("page cannot be written")));
        assert_eq!(meanwhile(true), ("ours".to_owned(), None));
    }
}
