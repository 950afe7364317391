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
        Self::with_style(to_be_shown, Self::STEPS as u64, "{percent:>3} % [{bar:40}] {elapsed}, {eta} left")
    }

    /// Of `total` scenes, of which the first `done` do not count for the rate.
    pub(super) fn of_scenes(done: u64, total: u64) -> Self {
        let style = "{percent:>3} % [{bar:30}] {human_pos} of {human_len} scenes, {per_sec}, {elapsed}, {eta} left";
        let progress = Self::with_style(true, total, style);
        progress.bar.set_position(done);
        progress.bar.reset_eta();
        progress
    }

    fn with_style(to_be_shown: bool, steps: u64, style: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden())
            .with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        Self { bar, start: Instant::now(), to_be_shown }
    }

    /// Says which part is done, from 0 to 1.
    pub(super) fn show(&mut self, part: f64) {
        self.show_step((part * Self::STEPS) as u64);
    }

    /// Says how many steps are done.
    pub(super) fn show_step(&mut self, step: u64) {
        if self.to_be_shown && self.start.elapsed() > Self::QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.to_be_shown = false;
        }
        self.bar.set_position(step);
    }
}
