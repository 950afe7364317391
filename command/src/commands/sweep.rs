//! `twofold sweep`.

use clap::Args;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::interrupt::stop_on_request;
use super::output_file::{OutputFile, free_name, refuse_dash};
use super::progress::Progress;
use super::run::note_size;
use super::{Failure, also_read, counted, is_same_file, note};
use twofold_scene::sweep::{
    Done, Identity, Shard, Spool, SpoolError, SpoolFiles, Sweep, SweepText, compute, csv_line, errors_beside,
    is_beginning_of, merge, merge_errors,
};

#[derive(Args)]
pub(crate) struct SweepArgs {
    /// The sweep (TOML)
    #[arg(value_name = "SWEEP")]
    pub(crate) file: String,
    /// The table: CSV, or Parquet if the name ends in .parquet
    #[arg(long, value_name = "TABLE")]
    pub(crate) out: PathBuf,
    /// Replace the table if it exists
    #[arg(long)]
    pub(crate) force: bool,
    /// Start over and discard any partial table
    #[arg(long, conflicts_with = "merge")]
    pub(crate) restart: bool,
    /// Compute only part i of n; parts are consecutive scenes, so that their tables in order make up the whole
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    pub(crate) shard: Option<Shard>,
    /// Number of threads; all cores if not given
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..=4096), conflicts_with = "merge")]
    pub(crate) threads: Option<u16>,
    /// Compute nothing; merge the CSV tables of all shards, given in order, into one table
    #[arg(long, value_name = "PART", num_args = 1..)]
    pub(crate) merge: Vec<PathBuf>,
}

pub(super) fn sweep(args: &SweepArgs) -> Result<(), Failure> {
    refuse_dash(&args.out, "")?;
    let text = SweepText::read(&args.file)?;
    if text.scene.as_ref().is_some_and(|(scene, _)| is_same_file(&args.out, Path::new(scene))) {
        return Err(Failure::BadInput(also_read(&args.out)));
    }
    let sweep = Sweep::new(&text)?;
    sweep.cautions.iter().for_each(|caution| note(&format!("{}: {caution}", args.file)));
    let format = Format::of(&args.out)?;
    if !args.merge.is_empty() {
        return merge_parts(args, &sweep, format);
    }
    let scenes = args.shard.unwrap_or(Shard::WHOLE).scenes(sweep.scenes);
    let identity = Identity::new(&text, &scenes);
    // A link is followed: the table grows next to its target.
    let target = fs::canonicalize(&args.out).unwrap_or_else(|_| args.out.clone());
    let files = SpoolFiles::of(&target);
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if args.restart {
        files.discard().map_err(|error| Failure::BadInput(format!("{}: {error}", files.rows.display())))?;
    }
    let complete = files.complete(&identity);
    let named_before = complete.is_some();
    if named_before && !files.rows.exists() && target.exists() {
        // Only the removal of files was interrupted.
        files.remove().map_err(failed)?;
        return if complete == Some(0) { Ok(()) } else { Err(some_failed(&args.out)) };
    }
    // Output of an earlier attempt to name the table may be replaced; whether the file is that output is checked when the table is named.
    let out = free_name(&args.out, args.force || (named_before && format == Format::Parquet))?;
    free_name(&errors_beside(&target), args.force || named_before)?;

    let headers = [csv_line(&sweep.header()), csv_line(&sweep.errors_header())];
    let refuse = |error: SpoolError| {
        let advice = if matches!(error, SpoolError::Different(_)) { "; --restart starts over" } else { "" };
        let why = format!("{}: {error}{advice}", files.rows.display());
        // A full disk is not an error of the input.
        match &error {
            SpoolError::File(_, error) if is_full(error.kind()) => Failure::Failed(why),
            SpoolError::File(_, error) if !folder.is_dir() => Failure::BadInput(format!(
                "--out {}: cannot create a file in {}: {error}",
                args.out.display(),
                folder.display()
            )),
            _ => Failure::BadInput(why),
        }
    };
    let stop = stop_on_request();
    let mut spool =
        Spool::open(files.clone(), &identity, [&headers[0], &headers[1]], scenes.clone()).map_err(refuse)?;
    let (first, count) = (spool.next(), scenes.end - scenes.start);
    if first > scenes.start {
        note(&format!("{} of {count} scenes are already computed", first - scenes.start));
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(args.threads.unwrap_or(0).into()).build();
    let threads = threads.map_err(|error| Failure::Failed(format!("no threads can be started: {error}")))?;
    note_size((scenes.end - first) as f64, sweep.header().len());
    let start = Instant::now();
    let mut progress = Progress::of_scenes(first - scenes.start, count);
    let done = compute(&sweep, &mut spool, scenes.end, &threads, &stop, |next| progress.show_step(next - scenes.start));
    drop(progress);
    note_rate(spool.next() - first, spool.next() - scenes.start, start.elapsed(), spool.failed());
    if done.map_err(failed)? == Done::Stopped {
        return Err(Failure::Interrupted(format!(
            "{} of {count} scenes are in {}; run the same command to continue",
            spool.next() - scenes.start,
            files.rows.display()
        )));
    }
    give_names(&mut spool, &out, (args.force, format))?;
    if spool.failed() == 0 { Ok(()) } else { Err(some_failed(&args.out)) }
}

fn is_full(kind: io::ErrorKind) -> bool {
    matches!(kind, io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge)
}

fn some_failed(out: &Path) -> Failure {
    Failure::Partly(format!("some scenes failed; {} lists them with the reasons", errors_beside(out).display()))
}

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Csv,
    Parquet,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Failure> {
        let is_parquet = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"));
        match (is_parquet, cfg!(feature = "parquet")) {
            (false, _) => Ok(Self::Csv),
            (true, true) => Ok(Self::Parquet),
            (true, false) => Err(Failure::BadInput(format!(
                "--out {}: this program was built without Parquet; build it with `cargo build --release --features parquet`, \
                 or use the name of a CSV file",
                path.display()
            ))),
        }
    }
}

fn failed(error: SpoolError) -> Failure {
    Failure::Failed(error.to_string())
}

/// Moves complete tables to their names.
fn give_names(spool: &mut Spool, out: &Path, (replace, format): (bool, Format)) -> Result<(), Failure> {
    let cannot = |error: SpoolError| match error {
        SpoolError::File(path, error) if error.kind() == io::ErrorKind::AlreadyExists => {
            Failure::Failed(format!("{} exists and does not belong to this table; --force replaces it", path.display()))
        }
        SpoolError::File(path, error) => Failure::Failed(format!("{} cannot be written: {error}", path.display())),
        error => failed(error),
    };
    match format {
        Format::Csv => spool.give_names(out, replace).map_err(cannot),
        Format::Parquet => {
            spool.name_errors(out, replace).map_err(cannot)?;
            let exists = out.exists();
            let output = OutputFile::beside(out, replace || exists)?;
            let rows = &spool.files().rows;
            let table = File::open(rows).map_err(|error| Failure::Failed(format!("{}: {error}", rows.display())))?;
            convert(table, output.file(), out)?;
            if exists && !replace && !is_beginning_of(out, output.path()) {
                return Err(cannot(SpoolError::File(out.to_owned(), io::ErrorKind::AlreadyExists.into())));
            }
            output.complete()?;
            spool.files().remove().map_err(failed)
        }
    }
}

#[cfg(feature = "parquet")]
fn convert(table: impl Read, file: &File, out: &Path) -> Result<(), Failure> {
    let done = twofold_scene::sweep::parquet_file::write_parquet(BufReader::new(table), file);
    done.map_err(|error| Failure::Failed(error.to_string()))?;
    file.sync_all().map_err(|error| Failure::Failed(format!("{} cannot be written: {error}", out.display())))
}

#[cfg(not(feature = "parquet"))]
fn convert(_: impl Read, _: &File, out: &Path) -> Result<(), Failure> {
    Format::of(out).map(|_| ())
}

/// Writes the tables of all shards as one, and their errors.
fn merge_parts(args: &SweepArgs, sweep: &Sweep<'_>, format: Format) -> Result<(), Failure> {
    let bad = |path: &Path, error: io::Error| Failure::BadInput(format!("--merge {}: {error}", path.display()));
    let mut parts: Vec<(String, Box<dyn BufRead>)> = Vec::new();
    let output = OutputFile::beside(&args.out, args.force)?;
    let errors_output = OutputFile::beside(&errors_beside(&args.out), args.force)?;
    for path in &args.merge {
        let file = File::open(path).map_err(|error| bad(path, error))?;
        parts.push((format!("--merge {}", path.display()), Box::new(BufReader::new(file))));
    }
    let failed = match format {
        Format::Csv => {
            let mut writer = BufWriter::new(output.file());
            let failed = merge(sweep, &mut parts, &mut writer).map_err(Failure::BadInput)?;
            writer.flush().map_err(|error| Failure::Failed(format!("{}: {error}", args.out.display())))?;
            failed
        }
        Format::Parquet => {
            let cannot = |error: io::Error| Failure::Failed(format!("a temporary file: {error}"));
            let mut whole = tempfile::tempfile().map_err(cannot)?;
            let failed = merge(sweep, &mut parts, BufWriter::new(&whole)).map_err(Failure::BadInput)?;
            whole.rewind().map_err(cannot)?;
            convert(whole, output.file(), &args.out)?;
            failed
        }
    };
    let mut errors = BufWriter::new(errors_output.file());
    let cannot = |error: io::Error| Failure::Failed(format!("the table of errors cannot be written: {error}"));
    errors.write_all(&csv_line(&sweep.errors_header())).map_err(cannot)?;
    let mut missing = Vec::new();
    for (path, &failed) in args.merge.iter().zip(&failed) {
        let path = errors_beside(path);
        let name = format!("--merge {}", path.display());
        match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                missing.extend((failed > 0).then(|| path.display().to_string()));
            }
            Err(error) => return Err(bad(&path, error)),
            Ok(part) => {
                merge_errors(sweep, &name, failed, BufReader::new(part), &mut errors).map_err(Failure::BadInput)?;
            }
        }
    }
    errors.flush().map_err(cannot)?;
    drop(errors);
    let any_failed = failed.iter().any(|failed| *failed > 0);
    if any_failed {
        errors_output.complete()?;
    } else {
        errors_output.nothing()?;
    }
    output.complete()?;
    if !missing.is_empty() {
        note(&format!("{} is missing, so the reasons why these scenes failed are not known", missing.join(", ")));
    }
    if any_failed { Err(some_failed(&args.out)) } else { Ok(()) }
}

/// Reports the rate of the scenes `computed` in this run, and how many of `all` so far failed.
fn note_rate(computed: u64, all: u64, elapsed: Duration, failed: u64) {
    let seconds = elapsed.as_secs_f64();
    let rate = computed as f64 / seconds.max(1e-9);
    let scenes = counted(computed, "scene");
    note(&format!("{scenes} in {seconds:.2} s, {rate:.4e} scenes/s; {failed} of {all} failed"));
}
