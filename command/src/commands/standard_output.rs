//! Standard output: no result that was written to it is lost without an error.

use std::io::{self, StdoutLock, Write};

use super::Failure;

/// Standard output for a result. Refused if it is closed (`>&-`).
pub(super) fn standard_output() -> Result<StdoutLock<'static>, Failure> {
    if is_closed() {
        return Err(cannot_be_written(
            "it is closed, or it is the null device opened for reading as well; use `> /dev/null` to discard the output",
        ));
    }
    Ok(io::stdout().lock())
}

/// Prints a result. A reader that has closed its end (`| head`) is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    write_all(standard_output()?, text)
}

/// Prints a summary of what was done. The result itself is in files or in the status, so a closed standard output is no failure.
pub(super) fn tell(text: &str) -> Result<(), Failure> {
    write_all(io::stdout().lock(), text)
}

fn write_all(mut output: StdoutLock<'_>, text: &str) -> Result<(), Failure> {
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(cannot_be_written(&error.to_string())),
        _ => Ok(()),
    }
}

fn cannot_be_written(why: &str) -> Failure {
    Failure::Failed(format!("standard output cannot be written: {why}"))
}

/// Whether standard output was closed when the process started. Rust's runtime then opens the null device instead, for reading
/// and writing; shells open it only for writing.
#[cfg(unix)]
fn is_closed() -> bool {
    use rustix::fs::{OFlags, fcntl_getfl, fstat, stat};
    let output = rustix::stdio::stdout();
    let (Ok(flags), Ok(found), Ok(null)) = (fcntl_getfl(output), fstat(output), stat("/dev/null")) else {
        return false;
    };
    flags & OFlags::RWMODE == OFlags::RDWR && found.st_rdev == null.st_rdev
}

#[cfg(not(unix))]
fn is_closed() -> bool {
    false
}
