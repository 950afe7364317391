//! How far a long computation is.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

/// A bar on standard error, if that is a terminal, from two seconds on.
pub(super) struct Progress {
    bar: ProgressBar,
    start: Instant,
    to_be_shown: bool,
}

impl Progress {
    const QUIET: Duration = Duration::from_secs(2);
    const STEPS: f64 = 1000.0;

    pub(super) fn new(to_be_shown: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(Self::STEPS as u64), ProgressDrawTarget::hidden())
            .with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template("{percent:>3} % [{bar:40}] {elapsed}, {eta} left") {
            bar.set_style(style);
        }
        Self { bar, start: Instant::now(), to_be_shown }
    }

    /// Says which part is done, from 0 to 1.
    pub(super) fn show(&mut self, part: f64) {
        if self.to_be_shown && self.start.elapsed() > Self::QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.to_be_shown = false;
        }
        self.bar.set_position((part * Self::STEPS) as u64);
    }
}
