//! A file that appears under its name only when it is complete.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::Failure;
use super::interrupt::unfinished;

/// Refuses `-` as the name of an output; `other` is another advice than the name.
pub(super) fn refuse_dash(path: &Path, other: &str) -> Result<(), Failure> {
    let why = format!("--out -: does not mean standard output; {other}use ./- for a file of that name");
    if path == Path::new("-") { Err(Failure::BadInput(why)) } else { Ok(()) }
}

/// The path of an output, unless it is taken. A link is followed: the file it points to is replaced.
pub(super) fn free_name(path: &Path, replace: bool) -> Result<PathBuf, Failure> {
    let refuse = |why: &str| Err(Failure::BadInput(format!("--out {}: {why}", path.display())));
    refuse_dash(path, "omit --out, or ")?;
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => return refuse("exists and is not a regular file"),
        Ok(_) if !replace => return refuse("exists; --force replaces it"),
        Err(_) if !replace && path.is_symlink() => return refuse("is a broken link; --force replaces it"),
        _ => {}
    }
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if path.file_name().is_none() { refuse("is not the name of a file") } else { Ok(path) }
}

/// A file that appears under its name only when it is complete.
pub(super) struct OutputFile {
    path: PathBuf,
    temporary: NamedTempFile,
    replace: bool,
}

impl OutputFile {
    /// Starts a temporary file in the folder of `path`.
    pub(super) fn beside(path: &Path, replace: bool) -> Result<Self, Failure> {
        let refuse = |why: String| Failure::BadInput(format!("--out {}: {why}", path.display()));
        let path = free_name(path, replace)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut prefix = std::ffi::OsString::from(".");
        prefix.push(path.file_name().unwrap_or_default());
        prefix.push(".");
        let temporary = unfinished(
            || {
                let open = |part: &Path| File::options().write(true).create_new(true).open(part);
                tempfile::Builder::new().prefix(&prefix).suffix(".part").make_in(folder, open)
            },
            |temporary| {
                let part = temporary.path().to_owned();
                move || drop(fs::remove_file(&part))
            },
        )
        .map_err(|error| refuse(format!("cannot create a file in {}: {error}", folder.display())))?;
        Ok(Self { path, temporary, replace })
    }

    pub(super) fn file(&self) -> &File {
        self.temporary.as_file()
    }

    /// Its temporary path.
    pub(super) fn path(&self) -> &Path {
        self.temporary.path()
    }

    pub(super) fn complete(self) -> Result<(), Failure> {
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

    /// Nothing is written: an older file of this name is removed if it may be replaced.
    pub(super) fn nothing(self) -> Result<(), Failure> {
        if self.replace && self.path.is_file() {
            let cannot = |error| Failure::Failed(format!("{} cannot be removed: {error}", self.path.display()));
            fs::remove_file(&self.path).map_err(cannot)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The content of the file at the end if another one has appeared during the computation, and whether that is a failure.
    fn meanwhile(replace: bool) -> (String, bool) {
        let folder = tempfile::tempdir().expect("folder");
        let path = folder.path().join("table.csv");
        let Ok(output) = OutputFile::beside(&path, replace) else { panic!("the name is free") };
        std::io::Write::write_all(&mut output.file(), b"ours").expect("written");
        fs::write(&path, "theirs").expect("file");
        let is_failure = output.complete().is_err();
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1, "nothing incomplete is left");
        (fs::read_to_string(&path).expect("text"), is_failure)
    }

    #[test]
    fn a_file_that_appears_meanwhile_is_replaced_only_with_leave() {
        assert_eq!(meanwhile(false), ("theirs".to_owned(), true));
        assert_eq!(meanwhile(true), ("ours".to_owned(), false));
    }

    #[test]
    fn an_older_file_is_removed_only_if_it_may_be_replaced() {
        for replace in [false, true] {
            let folder = tempfile::tempdir().expect("folder");
            let path = folder.path().join("table.csv");
            let Ok(output) = OutputFile::beside(&path, replace) else { panic!("the name is free") };
            fs::write(&path, "theirs").expect("file");
            assert!(output.nothing().is_ok());
            assert_eq!(path.exists(), !replace);
            let Ok(output) = OutputFile::beside(&folder.path().join("none.csv"), replace) else { panic!("a new name") };
            assert!(output.nothing().is_ok());
        }
    }
}
