//! Long work: without Python's lock, and stopped by Ctrl-C.

use std::fmt::Display;
use std::ops::Range;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::error::raised;

/// Time between two checks for Ctrl-C.
pub const LOOKED_EVERY: Duration = Duration::from_millis(50);

/// Does `count` pieces of work in order without Python's lock, and checks for Ctrl-C between them. `work` takes several pieces at a time: few if they
/// are long, many if they are short.
pub fn in_parts<E: Display + Send>(
    py: Python<'_>,
    count: usize,
    mut work: impl FnMut(Range<usize>) -> Result<(), E> + Send,
) -> PyResult<()> {
    let (mut next, mut at_once) = (0, 1_usize);
    while next < count {
        py.check_signals()?;
        let until_next_look = || {
            let begun = Instant::now();
            let mut before = Duration::ZERO;
            while next < count && before < LOOKED_EVERY {
                let end = count.min(next.saturating_add(at_once));
                work(next..end)?;
                next = end;
                let now = begun.elapsed();
                at_once = if now - before < LOOKED_EVERY / 4 { at_once.saturating_mul(2) } else { 1.max(at_once / 2) };
                before = now;
            }
            Ok(())
        };
        py.detach(until_next_look).map_err(raised::<E>)?;
    }
    Ok(())
}
