//! Sweeps continued from files that were torn, changed or made by another program.

use std::fs;
use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;

use rayon::{ThreadPool, ThreadPoolBuilder};
use tempfile::tempdir;

use super::bytes::Bytes;
use twofold_scene::sweep::{
    Done, Identity, Spool, SpoolError, SpoolFiles, Sweep, SweepText, compute, csv_line, signed_again,
};

/// Eighteen scenes without a motion; every third one is refused.
const SWEEP: &str = "scene = \"free\"\n[[vary]]\nparameter = \"initial.beta\"\nvalues = [0.4, 0.5, -1.0]\n[[vary]]\n\
                     parameter = \"star.spin\"\ngrid = { from = 0.5, to = 1.0, points = 6 }\n[time]\nend = 1.0\n";

/// Scenes at which the journal was marked.
const MARKS: [u64; 6] = [1, 2, 5, 9, 14, 18];

const MOST_CHANGES: usize = 8;

/// The sweep, its complete table and the three files from which it was continued.
struct Whole {
    text: SweepText,
    tables: [Vec<u8>; 2],
    files: [Vec<u8>; 3],
    thread: ThreadPool,
}

impl Whole {
    fn get() -> &'static Self {
        static WHOLE: OnceLock<Whole> = OnceLock::new();
        WHOLE.get_or_init(|| {
            let find = |name: &str| {
                Ok((name.to_owned(), twofold_scene::scene_file::built_in(name).expect("a scene").toml.to_owned()))
            };
            let text = SweepText::with("sweep.toml", SWEEP.to_owned(), find).expect("a sweep");
            let thread = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
            let mut whole = Self { text, tables: Default::default(), files: Default::default(), thread };
            let folder = tempdir().expect("a folder");
            let files = SpoolFiles::of(&folder.path().join("table.csv"));
            for end in MARKS {
                whole.continued(&files, end).expect("a table");
            }
            let paths = [&files.rows, &files.errors, &files.journal];
            whole.files = paths.map(|path| fs::read(path).expect("a file"));
            whole.tables = [whole.files[0].clone(), whole.files[1].clone()];
            whole
        })
    }

    /// Continues to the scene `end`, as the command does.
    fn continued(&self, files: &SpoolFiles, end: u64) -> Result<Done, SpoolError> {
        let sweep = Sweep::new(&self.text).expect("a sweep");
        let headers = [csv_line(&sweep.header()), csv_line(&sweep.errors_header())];
        let scenes = 0..sweep.scenes;
        let identity = Identity::new(&self.text, &scenes);
        let mut spool = Spool::open(files.clone(), &identity, [&headers[0], &headers[1]], scenes.clone())?;
        assert!(scenes.start <= spool.next() && spool.next() <= scenes.end, "goes on from scene {}", spool.next());
        compute(&sweep, &mut spool, end, &self.thread, &AtomicBool::new(false), |_| {})
    }
}

/// Changes the three files of an interrupted sweep and continues it: it is refused, or its table equals the uninterrupted one to
/// the byte. If a line of the journal was changed and signed again, which no accident does, any table is allowed.
pub fn resume(bytes: &[u8]) {
    let whole = Whole::get();
    let mut bytes = Bytes::new(bytes);
    let mut contents = whole.files.clone();
    let mut is_forged = false;
    for _ in 0..MOST_CHANGES {
        if bytes.is_empty() {
            break;
        }
        is_forged |= change(&mut contents, &mut bytes);
    }
    let folder = tempdir().expect("a folder");
    let files = SpoolFiles::of(&folder.path().join("table.csv"));
    for (path, content) in [&files.rows, &files.errors, &files.journal].into_iter().zip(&contents) {
        if !content.is_empty() {
            fs::write(path, content).expect("a file");
        }
    }
    match whole.continued(&files, 18) {
        Err(SpoolError::Different(why)) => {
            assert!(!why.is_empty());
            let kept = [&files.rows, &files.errors].map(|path| fs::read(path).unwrap_or_default());
            assert!(kept == contents[..2], "a table that was refused is touched");
        }
        Err(error) => panic!("{error}"),
        Ok(done) => {
            let tables = [&files.rows, &files.errors].map(|path| fs::read(path).expect("a file"));
            assert!(is_forged || done == Done::All && tables == whole.tables, "another table");
        }
    }
}

/// Makes one change to one of the files; returns whether it created a line of the journal that only the program could have written.
fn change(contents: &mut [Vec<u8>; 3], bytes: &mut Bytes<'_>) -> bool {
    let kind = bytes.byte();
    let which = usize::from(bytes.byte() % 3);
    let content = &mut contents[which];
    let place = bytes.below(content.len() + 1);
    match kind % 8 {
        0 => content.truncate(place),
        1 => content.extend(std::iter::repeat_n(bytes.byte(), place)),
        2 | 3 => {
            let (count, mask) = (1 + bytes.below(8), bytes.byte());
            content.iter_mut().skip(place).take(count).for_each(|byte| *byte ^= mask);
        }
        4 => {
            let end = (place + bytes.below(200)).min(content.len());
            content.drain(place..end);
        }
        5 => {
            let new: Vec<u8> = (0..1 + bytes.below(12)).map(|_| bytes.byte()).collect();
            content.splice(place..place, new);
        }
        6 => {
            // A line is repeated elsewhere, as a disk or a copy may do.
            let line = content.split_inclusive(|byte| *byte == b'\n').nth(place % 8).unwrap_or(b"").to_vec();
            content.splice(place..place, line);
        }
        _ => {
            let digits = [b'0' + bytes.byte() % 10, b'0' + bytes.byte() % 10];
            let new = signed_again(&contents[2], bytes.below(8), bytes.below(16), &digits[..1 + bytes.below(2)]);
            let is_new = new != contents[2];
            contents[2] = new;
            return is_new;
        }
    }
    false
}
