//! Computes the chunks of a sweep on all cores, written in order.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use super::Sweep;
use super::chunk::{ChunkText, chunk_text};
use super::spool::{Spool, SpoolError};

/// Time between two marks in the journal: the largest loss by an interruption, in addition to the chunks in progress.
const BETWEEN_MARKS: Duration = Duration::from_millis(250);

/// Largest number of bytes between two marks, independent of the clock: if the clock stood still, a sweep would otherwise
/// have no marks.
const BYTES_BETWEEN_MARKS: usize = 16 << 20;

/// Chunks in progress or waiting to be written, per thread; this bounds the memory.
const CHUNKS_PER_THREAD: usize = 8;

/// The outcome of a computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Done {
    /// All scenes are in the table.
    All,
    /// The computation was stopped, and the table is incomplete.
    Stopped,
}

/// Computes the scenes up to `end` that the table does not contain and appends them, in order, until the table is complete or `stop` is set;
/// the chunks in progress are then finished, those waiting for a thread are not. `progress` receives the first scene that has not been
/// written.
pub fn compute(
    sweep: &Sweep<'_>,
    spool: &mut Spool,
    end: u64,
    threads: &rayon::ThreadPool,
    stop: &AtomicBool,
    mut progress: impl FnMut(u64),
) -> Result<Done, SpoolError> {
    let length = sweep.chunk_length();
    let most = CHUNKS_PER_THREAD * threads.current_num_threads();
    let (mut dispatched, mut written) = (spool.next(), spool.next());
    let (results, finished) = channel();
    let mut waiting = BTreeMap::new();
    let (mut last_mark, mut bytes) = (Instant::now(), 0);
    threads.in_place_scope(|scope| {
        let mut in_work = 0;
        loop {
            while dispatched < end && in_work + waiting.len() < most && !stop.load(Ordering::Relaxed) {
                let chunk = next_chunk(dispatched, length, end);
                dispatched = chunk.end;
                in_work += 1;
                let results = results.clone();
                // The receiver lives as long as the scope, unless writing has failed, in which case nobody waits for it.
                scope.spawn(move |_| {
                    let text = (!stop.load(Ordering::Relaxed)).then(|| chunk_text(sweep, chunk.clone()));
                    drop(results.send((chunk, text)));
                });
            }
            if in_work == 0 {
                break;
            }
            let Ok((chunk, text)) = finished.recv() else { break };
            in_work -= 1;
            waiting.extend(text.map(|text| (chunk.start, (chunk.end, text))));
            while let Some((next, text)) = waiting.remove(&written) {
                let ChunkText { rows, errors, failed } = text;
                spool.append(next, [&rows, &errors], failed)?;
                bytes += rows.len() + errors.len();
                written = next;
                progress(written);
            }
            if last_mark.elapsed() > BETWEEN_MARKS || bytes > BYTES_BETWEEN_MARKS {
                spool.commit()?;
                (last_mark, bytes) = (Instant::now(), 0);
            }
        }
        Ok(())
    })?;
    spool.commit()?;
    Ok(if written == end { Done::All } else { Done::Stopped })
}

/// The scenes from `first` up to the next multiple of `length`.
fn next_chunk(first: u64, length: u64, end: u64) -> Range<u64> {
    first..end.min((first / length + 1) * length)
}
