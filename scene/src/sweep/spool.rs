//! A table that grows under a temporary name next to its final one and can be continued after any interruption.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crc32fast::Hasher;

use super::identity::Identity;
use super::journal::{self, Journal, Mark, Prefix};

/// Names of the files of an incomplete table.
#[derive(Debug, Clone)]
pub struct SpoolFiles {
    /// The table so far.
    pub rows: PathBuf,
    /// The table of errors so far.
    pub errors: PathBuf,
    /// The journal, which states which part of both counts.
    pub journal: PathBuf,
}

/// Reasons why a table cannot be begun or continued.
#[derive(Debug)]
pub enum SpoolError {
    /// The existing part belongs to something else, described here.
    Different(String),
    /// Another process is writing the table.
    InUse,
    /// A file cannot be read or written.
    File(PathBuf, io::Error),
}

/// A growing table.
#[derive(Debug)]
pub struct Spool {
    files: SpoolFiles,
    rows: Growing,
    errors: Growing,
    journal: File,
    mark: Mark,
    /// Whether everything was already written, and only the renaming is missing.
    pub complete: bool,
}

#[derive(Debug)]
struct Growing {
    file: File,
    length: u64,
    checksum: Hasher,
}

impl SpoolFiles {
    /// The files for the table `out`.
    pub fn of(out: &Path) -> Self {
        let with = |extension: &str| {
            let mut name = out.as_os_str().to_owned();
            name.push(extension);
            PathBuf::from(name)
        };
        Self { rows: with(".partial"), errors: with(".partial.errors"), journal: with(".partial.journal") }
    }

    /// Number of scenes that failed in a table with the given identity that was complete and about to be renamed; `None` if there is no such table.
    pub fn complete(&self, identity: &Identity) -> Option<u64> {
        let journal = Journal::read(File::open(&self.journal).ok()?).ok()?;
        let is_ours = journal.complete && journal.identity.as_ref() == Some(identity.facts());
        is_ours.then(|| journal.marks.last().map_or(0, |(mark, _)| mark.failed))
    }

    /// Removes the files left by an interrupted process.
    pub fn discard(&self) -> Result<(), SpoolError> {
        let in_use = |journal: File| matches!(journal.try_lock(), Err(fs::TryLockError::WouldBlock));
        if File::open(&self.journal).is_ok_and(in_use) { Err(SpoolError::InUse) } else { self.remove() }
    }

    /// Removes the existing files.
    pub fn remove(&self) -> Result<(), SpoolError> {
        // The journal last: without it the others could not be identified.
        for path in [&self.rows, &self.errors, &self.journal] {
            match fs::remove_file(path) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(refused(path)(error)),
                _ => {}
            }
        }
        Ok(())
    }
}

/// Name of the table of errors for a table.
pub fn errors_beside(out: &Path) -> PathBuf {
    let mut name = out.as_os_str().to_owned();
    name.push(".errors.csv");
    name.into()
}

impl Spool {
    /// Begins a table of `scenes` with two headers, or continues the existing part: up to the last mark at which both files agree with the
    /// journal. The files are locked for other processes, if the file system supports this.
    pub fn open(
        files: SpoolFiles,
        identity: &Identity,
        headers: [&[u8]; 2],
        scenes: Range<u64>,
    ) -> Result<Self, SpoolError> {
        let unknown = !files.journal.exists();
        let mut journal_file = open(&files.journal)?;
        if matches!(journal_file.try_lock(), Err(fs::TryLockError::WouldBlock)) {
            return Err(SpoolError::InUse);
        }
        if unknown && files.rows.exists() {
            let _ = fs::remove_file(&files.journal);
            return Err(SpoolError::Different("its journal is missing".to_owned()));
        }
        let journal = Journal::read(&journal_file).map_err(refused(&files.journal))?;
        let difference = journal.identity.as_ref().and_then(|there| identity.difference_from(there));
        if let Some(difference) = difference {
            return Err(SpoolError::Different(difference));
        }
        if let Some((mark, _)) = journal.marks.iter().find(|(mark, _)| !mark.is_of(&scenes)) {
            let (next, failed) = (mark.next, mark.failed);
            return Err(SpoolError::Different(format!(
                "its journal is for other scenes: it is complete up to scene {next}, with {failed} failed"
            )));
        }
        let (rows, errors) = (open(&files.rows)?, open(&files.errors)?);
        let intact = [(&rows, &files.rows), (&errors, &files.errors)].map(|(file, path)| (file, refused(path)));
        let [(rows_file, rows_refused), (errors_file, errors_refused)] = intact;
        let lengths = |of: fn(&Mark) -> Prefix| journal.marks.iter().map(|(mark, _)| of(mark)).collect::<Vec<_>>();
        let good = intact_prefixes(rows_file, &lengths(|mark| mark.rows))
            .map_err(rows_refused)?
            .min(intact_prefixes(errors_file, &lengths(|mark| mark.errors)).map_err(errors_refused)?);
        let complete = journal.complete && good == journal.marks.len();
        let last = good.checked_sub(1).map(|last| journal.marks[last]);
        let (mark, journal_length) = last.unwrap_or((Mark { next: scenes.start, ..Mark::default() }, 0));
        let rows = Growing::from(rows, &files.rows, mark.rows.length)?;
        let errors = Growing::from(errors, &files.errors, mark.errors.length)?;
        truncate(&mut journal_file, journal_length).map_err(refused(&files.journal))?;
        let mut spool = Self { files, rows, errors, journal: journal_file, mark, complete: false };
        if last.is_none() {
            spool.write_line(identity.facts())?;
            spool.append(scenes.start, headers, 0)?;
            spool.commit()?;
        }
        if complete {
            spool.completed()?;
        }
        Ok(spool)
    }

    /// First scene that is not in the table.
    pub fn next(&self) -> u64 {
        self.mark.next
    }

    /// Number of scenes in the table that failed.
    pub fn failed(&self) -> u64 {
        self.mark.failed
    }

    /// The files.
    pub fn files(&self) -> &SpoolFiles {
        &self.files
    }

    /// Appends lines to the table and to the table of errors; `next` is the first scene that is then not in them.
    pub fn append(&mut self, next: u64, [rows, errors]: [&[u8]; 2], failed: u64) -> Result<(), SpoolError> {
        self.rows.append(rows).map_err(refused(&self.files.rows))?;
        self.errors.append(errors).map_err(refused(&self.files.errors))?;
        self.mark.next = next;
        self.mark.failed += failed;
        Ok(())
    }

    /// Ensures that the appended lines survive the end of the process and a loss of power: first the tables, then the
    /// journal.
    pub fn commit(&mut self) -> Result<(), SpoolError> {
        self.mark.rows = self.rows.mark().map_err(refused(&self.files.rows))?;
        self.mark.errors = self.errors.mark().map_err(refused(&self.files.errors))?;
        self.write_line(&self.mark.to_value())
    }

    /// Records that the table is complete.
    pub fn completed(&mut self) -> Result<(), SpoolError> {
        self.complete = true;
        self.write_line(&journal::completion())
    }

    /// Gives a complete table of errors its name next to the table `out`, if there are any. An existing file of that name is replaced or removed if
    /// it may be `replaced`; what an earlier attempt has written may always be.
    ///
    /// # Errors
    /// A file that cannot be written, or exists.
    pub fn name_errors(&mut self, out: &Path, replaced: bool) -> Result<(), SpoolError> {
        if !self.complete {
            self.completed()?;
        }
        let errors = errors_beside(out);
        if self.mark.failed > 0 {
            free(&errors, replaced || is_beginning_of(&errors, &self.files.errors))?;
            let copied = fs::copy(&self.files.errors, &errors).and_then(|_| File::open(&errors)?.sync_all());
            copied.map_err(refused(&errors))?;
        } else if errors.exists() {
            free(&errors, replaced)?;
            fs::remove_file(&errors).map_err(refused(&errors))?;
        }
        Ok(())
    }

    /// Gives a complete CSV table its name `out`, after the table of errors has its name, so that the presence of the
    /// table means that everything is there.
    ///
    /// # Errors
    /// A file that cannot be written, or exists and may not be `replaced`.
    pub fn give_names(&mut self, out: &Path, replaced: bool) -> Result<(), SpoolError> {
        // This comes before the errors get their name: a table that cannot have its own name leaves no errors beside a foreign table.
        free(out, replaced)?;
        self.name_errors(out, replaced)?;
        free(out, replaced)?;
        fs::rename(&self.files.rows, out).map_err(refused(out))?;
        let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if let Ok(folder) = File::open(folder) {
            // The names survive a loss of power, if the system can guarantee that.
            let _ = folder.sync_all();
        }
        self.files.remove()
    }

    fn write_line(&mut self, value: &serde_json::Value) -> Result<(), SpoolError> {
        let write = |file: &mut File| file.write_all(&journal::line(value)).and_then(|()| file.sync_data());
        write(&mut self.journal).map_err(refused(&self.files.journal))
    }
}

impl Growing {
    fn from(mut file: File, path: &Path, length: u64) -> Result<Self, SpoolError> {
        truncate(&mut file, length).map_err(refused(path))?;
        Ok(Self { file, length, checksum: Hasher::new() })
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.length += bytes.len() as u64;
        self.checksum.update(bytes);
        Ok(())
    }

    fn mark(&mut self) -> io::Result<Prefix> {
        self.file.sync_data()?;
        let checksum = std::mem::take(&mut self.checksum).finalize();
        Ok(Prefix { length: self.length, checksum })
    }
}

fn open(path: &Path) -> Result<File, SpoolError> {
    File::options().read(true).write(true).create(true).truncate(false).open(path).map_err(refused(path))
}

fn truncate(file: &mut File, length: u64) -> io::Result<()> {
    file.set_len(length)?;
    file.seek(SeekFrom::Start(length)).map(|_| ())
}

/// Number of prefixes, counted from the first, that the file contains unchanged.
fn intact_prefixes(mut file: &File, prefixes: &[Prefix]) -> io::Result<usize> {
    const PIECE: usize = 1 << 16;
    let mut piece = vec![0; PIECE];
    let mut position = 0;
    for (i, prefix) in prefixes.iter().enumerate() {
        let mut checksum = Hasher::new();
        let Some(mut missing) = prefix.length.checked_sub(position) else { return Ok(i) };
        while missing > 0 {
            let wanted = missing.min(PIECE as u64) as usize;
            let read = file.read(&mut piece[..wanted])?;
            if read == 0 {
                return Ok(i);
            }
            checksum.update(&piece[..read]);
            missing -= read as u64;
        }
        if checksum.finalize() != prefix.checksum {
            return Ok(i);
        }
        position = prefix.length;
    }
    Ok(prefixes.len())
}

/// Whether the bytes of the file `part` are those with which `whole` begins, as in an interrupted copy.
pub fn is_beginning_of(part: &Path, whole: &Path) -> bool {
    let same = || -> io::Result<bool> {
        let (mut part, mut whole) = (BufReader::new(File::open(part)?), BufReader::new(File::open(whole)?));
        loop {
            let bytes = part.fill_buf()?;
            if bytes.is_empty() {
                return Ok(true);
            }
            let mut expected = vec![0; bytes.len()];
            whole.read_exact(&mut expected)?;
            if bytes != expected {
                return Ok(false);
            }
            let read = bytes.len();
            part.consume(read);
        }
    };
    same().unwrap_or(false)
}

fn free(path: &Path, replaced: bool) -> Result<(), SpoolError> {
    if path.exists() && !replaced { Err(refused(path)(io::ErrorKind::AlreadyExists.into())) } else { Ok(()) }
}

fn refused(path: &Path) -> impl FnOnce(io::Error) -> SpoolError + use<> {
    let path = path.to_owned();
    |error| SpoolError::File(path, error)
}

impl fmt::Display for SpoolError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SpoolError::Different(why) => write!(f, "the existing part cannot be continued: {why}"),
            SpoolError::InUse => write!(f, "another process is writing it (its journal is locked)"),
            SpoolError::File(path, error) => write!(f, "{} cannot be written: {error}", path.display()),
        }
    }
}

impl std::error::Error for SpoolError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::SweepText;

    const CHUNKS: [[&[u8]; 2]; 4] =
        [[b"0,1\n1,2\n", b""], [b"2,3\n", b"2,why\n"], [b"3,4\n4,5\n", b""], [b"5,6\n", b""]];

    fn identity(text: &str) -> Identity {
        Identity::new(&SweepText { file: "a.toml".into(), text: text.into(), scene: None }, &(0..40))
    }

    /// Continues the table in `folder` up to `chunks` chunks, each of ten scenes, with a mark after each.
    fn grow(folder: &Path, text: &str, chunks: usize) -> Result<u64, SpoolError> {
        let files = SpoolFiles::of(&folder.join("a.csv"));
        let mut spool = Spool::open(files, &identity(text), [b"head\n", b"errors\n"], 0..40)?;
        let begun = spool.next();
        assert_eq!(begun % 10, 0);
        for chunk in begun / 10..chunks as u64 {
            spool.append(10 * (chunk + 1), CHUNKS[chunk as usize], u64::from(chunk == 1))?;
            spool.commit()?;
        }
        assert_eq!(spool.failed(), u64::from(chunks > 1));
        Ok(begun)
    }

    fn bytes(folder: &Path) -> [Vec<u8>; 2] {
        let files = SpoolFiles::of(&folder.join("a.csv"));
        [files.rows, files.errors].map(|path| fs::read(path).expect("a file"))
    }

    #[test]
    fn files_torn_or_damaged_anywhere_are_continued_to_the_same_bytes() {
        // In memory if that is a folder, because the marks wait for the disk thousands of times.
        let folder = tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).expect("a folder");
        let folder = folder.path();
        assert_eq!(grow(folder, "text", 4).expect("a table"), 0);
        let files = SpoolFiles::of(&folder.join("a.csv"));
        let paths = [files.rows, files.errors, files.journal];
        let whole = bytes(folder);
        assert_eq!(whole[0], b"head\n0,1\n1,2\n2,3\n3,4\n4,5\n5,6\n");
        assert_eq!(whole[1], b"errors\n2,why\n");
        let contents = paths.clone().map(|path| fs::read(path).expect("a file"));
        let mut continued = 0;
        for (path, original) in paths.iter().zip(&contents) {
            // Every byte of a journal is tested where it is read; here each one costs a table.
            let step = if path.ends_with("a.csv.partial.journal") { 7 } else { 1 };
            for place in (0..original.len()).step_by(step) {
                let mut damaged = original.clone();
                damaged[place] ^= 0x41;
                let torn = original[..place].to_vec();
                let longer = [original.as_slice(), b"garbage"].concat();
                for version in [damaged, torn, longer] {
                    for (path, original) in paths.iter().zip(&contents) {
                        fs::write(path, original).expect("a file");
                    }
                    fs::write(path, version).expect("a file");
                    let begun = grow(folder, "text", 4).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
                    continued += u64::from(begun > 0);
                    assert_eq!(bytes(folder), whole, "{}, byte {place}", path.display());
                }
            }
        }
        assert!(continued > 150, "only {continued} were continued and not begun anew");
    }

    #[test]
    fn a_table_is_recorded_as_complete_before_a_file_gets_its_name() {
        let folder = tempfile::tempdir().expect("folder");
        let folder = folder.path();
        grow(folder, "text", 4).expect("a table");
        let files = SpoolFiles::of(&folder.join("a.csv"));
        assert_eq!(files.complete(&identity("text")), None);
        let mut spool =
            Spool::open(files.clone(), &identity("text"), [b"head\n", b"errors\n"], 0..40).expect("a table");
        let (out, errors) = (folder.join("a.csv"), errors_beside(&folder.join("a.csv")));
        fs::write(&errors, "theirs").expect("a file");
        assert!(spool.name_errors(&out, false).is_err());
        assert_eq!(files.complete(&identity("text")), Some(1));
        spool.name_errors(&out, true).expect("a name");
        assert_eq!(fs::read(errors).expect("errors"), bytes(folder)[1]);
    }

    #[test]
    fn only_the_same_sweep_is_continued_and_by_one_process() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        grow(folder, "one\ntwo", 2).expect("a table");
        let before = bytes(folder);
        let refused = grow(folder, "one\nthree", 4).expect_err("another sweep").to_string();
        assert!(
            refused.ends_with("the sweep file a.toml has changed since: line 2 was `two` and is `three`"),
            "{refused}"
        );
        assert_eq!(bytes(folder), before);
        let files = SpoolFiles::of(&folder.join("a.csv"));
        let open = || Spool::open(files.clone(), &identity("one\ntwo"), [b"head\n", b"errors\n"], 0..40);
        let first = open().expect("a table");
        assert!(matches!(open(), Err(SpoolError::InUse)));
        assert!(matches!(files.discard(), Err(SpoolError::InUse)));
        drop(first);
        fs::remove_file(&files.journal).expect("a journal");
        let refused = open().expect_err("a table without a journal").to_string();
        assert!(refused.contains("journal is missing") && !files.journal.exists(), "{refused}");
        assert_eq!(bytes(folder), before);
    }

    /// After an interrupted attempt to name a table, what it has written of the errors is replaced, and nothing else.
    #[test]
    fn only_what_an_earlier_attempt_has_written_is_replaced() {
        for (there, is_taken) in
            [("errors\n0,w", true), ("errors\n0,why\n", true), ("errors\n0,who", false), ("errors\n0,why\nmore", false)]
        {
            let folder = tempfile::tempdir().expect("a folder");
            let out = folder.path().join("a.csv");
            let open = || Spool::open(SpoolFiles::of(&out), &identity("text"), [b"head\n", b"errors\n"], 0..40);
            let mut spool = open().expect("a table");
            spool.append(40, [b"0,1\n", b"0,why\n"], 1).expect("a row");
            spool.commit().expect("a mark");
            spool.completed().expect("a mark");
            drop(spool);
            fs::write(errors_beside(&out), there).expect("a file");
            let named = open().expect("a table").give_names(&out, false);
            assert_eq!(named.is_ok(), is_taken, "{there}: {named:?}");
            let expected = if is_taken { "errors\n0,why\n" } else { there };
            assert_eq!(fs::read_to_string(errors_beside(&out)).expect("errors"), expected);
        }
    }

    /// A table of errors is named if a scene has failed, and removed if none has.
    #[test]
    fn errors_have_a_name_where_a_scene_has_failed() {
        for (failed, replaced) in [(1, false), (0, true), (1, true)] {
            let folder = tempfile::tempdir().expect("a folder");
            let out = folder.path().join("a.csv");
            let files = SpoolFiles::of(&out);
            let name = |extension: &str| folder.path().join(format!("a.csv{extension}"));
            let names = [".partial", ".partial.errors", ".partial.journal"].map(name);
            assert_eq!([&files.rows, &files.errors, &files.journal], names.each_ref());
            let mut spool =
                Spool::open(files.clone(), &identity("text"), [b"head\n", b"errors\n"], 0..40).expect("a table");
            spool.append(40, [b"0,1\n", b"0,why\n"], failed).expect("a row");
            spool.commit().expect("a mark");
            let errors = errors_beside(&out);
            if replaced {
                fs::write(&errors, "of another sweep").expect("a file");
            }
            assert_eq!(files.complete(&identity("text")), None);
            spool.completed().expect("a mark");
            assert_eq!([files.complete(&identity("text")), files.complete(&identity("other"))], [Some(failed), None]);
            spool.give_names(&out, replaced).expect("a table");
            assert_eq!(fs::read(&out).expect("a table"), b"head\n0,1\n");
            let expected = (failed == 1).then(|| b"errors\n0,why\n".to_vec());
            assert_eq!(fs::read(&errors).ok(), expected, "{failed}");
            assert!(names.iter().all(|path| !path.exists()));
        }
    }
}
