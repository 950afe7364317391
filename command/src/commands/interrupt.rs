//! Requests to end: an interrupt (Ctrl-C), a hang-up of the terminal, a request to terminate. And the signal USR1, which asks for a line
//! of progress.
//!
//! Each signal is treated separately. An interrupt or a hang-up that is ignored when the command starts, as under `nohup` or in
//! the background of a script, stays ignored; a request to terminate is always obeyed.

use std::io::{self, IsTerminal, Write};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Exit status of a command ended by such a request, by the convention of shells.
pub(super) const INTERRUPTED: u8 = 130;

struct OnRequest {
    /// Set at the first request, for work that stops by itself; the next request ends the process.
    stop: Option<Arc<AtomicBool>>,
    /// Remove incomplete output.
    removals: Vec<Box<dyn Fn() + Send>>,
}

static ON_REQUEST: Mutex<OnRequest> = Mutex::new(OnRequest { stop: None, removals: Vec::new() });

/// Set by the signal USR1.
static PROGRESS: AtomicBool = AtomicBool::new(false);

/// Whether a line of progress was asked for since the last call.
pub(super) fn progress_requested() -> bool {
    PROGRESS.swap(false, Ordering::Relaxed)
}

fn on_request() -> MutexGuard<'static, OnRequest> {
    ON_REQUEST.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Handles requests to end from now on. Called before any other work.
#[cfg(unix)]
pub(super) fn watch() -> io::Result<()> {
    use signal_hook::consts::{SIGUSR1, SIGXFSZ};
    let mut signals = signal_hook::iterator::Signals::new(heeded(ignored()))?;
    signals.handle().add_signal(SIGUSR1)?;
    // A file that would be too large is an error of its write.
    signals.handle().add_signal(SIGXFSZ)?;
    let heed = |signal| match signal {
        SIGUSR1 => PROGRESS.store(true, Ordering::Relaxed),
        SIGXFSZ => {}
        _ => requested(),
    };
    let thread = std::thread::Builder::new().name("signals".to_owned());
    thread.spawn(move || signals.forever().for_each(heed)).map(drop)
}

/// Handles requests to end from now on. Called before any other work.
#[cfg(windows)]
pub(super) fn watch() -> io::Result<()> {
    ctrlc::try_set_handler(requested).map_err(io::Error::other)
}

/// The signals to handle; those of the mask `ignored` were ignored at the start.
#[cfg(unix)]
fn heeded(ignored: u64) -> Vec<i32> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let is_heeded = |signal: &i32| *signal == SIGTERM || ignored >> (signal - 1) & 1 == 0;
    [SIGINT, SIGHUP, SIGTERM].into_iter().filter(is_heeded).collect()
}

/// The signals that this process ignores: bit n - 1 for signal n. If the system does not tell, a hang-up counts as ignored, so that
/// `nohup` works.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.unwrap_or(1 << (signal_hook::consts::SIGHUP - 1))
}

/// Stops work that can stop by itself; otherwise removes incomplete output and ends the process.
fn requested() {
    let mut on_request = on_request();
    if let Some(stop) = on_request.stop.take() {
        stop.store(true, Ordering::Relaxed);
        return;
    }
    // The newest first: it may be inside something older.
    on_request.removals.iter().rev().for_each(|remove| remove());
    let left = if on_request.removals.is_empty() { "" } else { ": no file was left incomplete" };
    // The current line of the terminal shows the bar and ^C.
    let line_end = if io::stderr().is_terminal() { "\n" } else { "" };
    // The lock is kept, so that the command writes nothing afterwards.
    let mut stderr = io::stderr().lock();
    let _ = writeln!(stderr, "{line_end}error: interrupted{left}");
    process::exit(INTERRUPTED.into());
}

/// Defers requests while the returned value lives; one that has already arrived ends the command now. Used at the end of a command, which could
/// fail because an interrupt has removed a file, and to register a file that an interrupt must remove.
pub(super) fn hold_requests() -> impl Sized {
    on_request()
}

/// A flag that the first request to end sets, for work that stops by itself; the next one ends the process.
pub(super) fn stop_on_request() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    on_request().stop = Some(Arc::clone(&stop));
    stop
}

/// Creates something incomplete; `removal` gives the function that removes it at a request to end, if it still exists. No request
/// comes between the two.
pub(super) fn unfinished<T, E, R: Fn() + Send + 'static>(
    make: impl FnOnce() -> Result<T, E>,
    removal: impl FnOnce(&T) -> R,
) -> Result<T, E> {
    let mut on_request = on_request();
    let made = make()?;
    on_request.removals.push(Box::new(removal(&made)));
    Ok(made)
}

#[cfg(all(test, unix))]
mod tests {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

    use super::*;

    /// Bit n - 1 of the mask is signal n; a request to terminate is always obeyed.
    #[test]
    fn signals_that_were_ignored_stay_ignored() {
        let bit = |signal: i32| 1_u64 << (signal - 1);
        assert_eq!(heeded(0), [SIGINT, SIGHUP, SIGTERM]);
        assert_eq!(heeded(bit(SIGHUP)), [SIGINT, SIGTERM]);
        assert_eq!(heeded(bit(SIGINT)), [SIGHUP, SIGTERM]);
        assert_eq!(heeded(u64::MAX), [SIGTERM]);
    }
}
