//! Progress of long computations, and parallel work with a progress bar.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use rayon::prelude::*;

use super::interrupt::progress_requested;
use super::note;

/// Progress on standard error: on a terminal a bar after two seconds, otherwise lines at intervals.
pub(super) struct Progress {
    shown: Shown,
    start: Instant,
    /// Steps completed earlier, which do not count towards the rate.
    first: u64,
    steps: u64,
    /// Name of a step, if it is shown.
    unit: Option<&'static str>,
}

enum Shown {
    Nothing,
    /// The flag tells whether it is on the screen.
    Bar(ProgressBar, bool),
    Lines(Lines),
}

impl Progress {
    const QUIET: Duration = Duration::from_secs(2);
    const STEPS: f64 = 1000.0;

    /// Progress of a computation that reports its completed part; the bar is shown only if standard output is not on the terminal, too.
    pub(super) fn new(bar_has_the_terminal: bool) -> Self {
        let style = "{percent:>3} % [{bar:40}] {elapsed}, {eta} left";
        Self::with_style(bar_has_the_terminal, (0, Self::STEPS as u64, None), style)
    }

    /// Progress of `total` scenes; the first `done` do not count for the rate.
    pub(super) fn of_scenes(done: u64, total: u64) -> Self {
        let style = "{percent:>3} % [{bar:30}] {human_pos} of {human_len} scenes, {per_sec}, {elapsed}, {eta} left";
        Self::with_style(true, (done, total, Some("scenes")), style)
    }

    fn with_style(
        bar_has_the_terminal: bool,
        (first, steps, unit): (u64, u64, Option<&'static str>),
        style: &str,
    ) -> Self {
        let shown = match (io::stderr().is_terminal(), bar_has_the_terminal) {
            (false, _) => Shown::Lines(Lines::default()),
            (true, false) => Shown::Nothing,
            (true, true) => {
                let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden())
                    .with_finish(ProgressFinish::AndClear)
                    .with_position(first);
                if let Ok(style) = ProgressStyle::with_template(style) {
                    bar.set_style(style);
                }
                bar.reset_eta();
                Shown::Bar(bar, false)
            }
        };
        Self { shown, start: Instant::now(), first, steps, unit }
    }

    /// Shows the completed fraction, from 0 to 1.
    pub(super) fn show(&mut self, part: f64) {
        self.show_step((part * Self::STEPS) as u64);
    }

    pub(super) fn show_step(&mut self, step: u64) {
        let elapsed = self.start.elapsed();
        match &mut self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar, is_on_screen) => {
                if !*is_on_screen && elapsed > Self::QUIET {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    *is_on_screen = true;
                }
                bar.set_position(step);
            }
            Shown::Lines(lines) => {
                if lines.is_due(step as f64 / self.steps as f64, elapsed, progress_requested()) {
                    note(&line((self.first, step, self.steps), self.unit, elapsed));
                }
            }
        }
    }
}

/// Lines come after ten seconds, then at each tenth of the work, at least ten seconds and at most a minute apart; and when one is requested.
#[derive(Default)]
struct Lines {
    /// Tenths done at the last line.
    tenths: u32,
    last: Option<Duration>,
}

impl Lines {
    const APART: Duration = Duration::from_secs(10);
    const AT_LEAST_EVERY: Duration = Duration::from_secs(60);

    fn is_due(&mut self, part: f64, now: Duration, is_requested: bool) -> bool {
        let tenths = (part * 10.0) as u32;
        let since = now - self.last.unwrap_or_default();
        let is_due = is_requested
            || since >= Self::AT_LEAST_EVERY
            || (since >= Self::APART && (self.last.is_none() || tenths > self.tenths));
        if is_due {
            *self = Self { tenths, last: Some(now) };
        }
        is_due
    }
}

fn line((first, step, steps): (u64, u64, u64), unit: Option<&str>, elapsed: Duration) -> String {
    let left = |seconds: f64| HumanDuration(Duration::from_secs(seconds.min(1e15) as u64));
    let rate = (step - first) as f64 / elapsed.as_secs_f64().max(1e-9);
    let percent = (step as f64 / steps as f64 * 100.0) as u64;
    let done = match unit {
        None => format!("{percent} % done"),
        Some(unit) => format!("{percent} % done, {step} of {steps} {unit}, {rate:.3e} {unit}/s,"),
    };
    let after = format!("{done} after {}", HumanDuration(elapsed));
    if rate > 0.0 { format!("{after}, about {} left", left((steps - step) as f64 / rate)) } else { after }
}

/// Processes all items on all processors, with a bar on a terminal; the results are in the order of the items. After a failure no
/// further item is started, and one failure is returned.
pub(super) fn on_all_processors<T: Sync, R: Send, E: Send>(
    items: &[T],
    what: &str,
    name: impl Fn(&T) -> &'static str + Sync,
    work: impl Fn(&T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let bar = ProgressBar::new(items.len() as u64);
    if let Ok(style) = ProgressStyle::with_template(&format!("{{pos}}/{{len}} {what} [{{bar:40}}] {{elapsed}} {{msg}}"))
    {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    let worked = |item| {
        bar.set_message(name(item));
        let result = work(item);
        bar.inc(1);
        result
    };
    let results = items.par_iter().map(worked).collect();
    bar.finish_and_clear();
    results
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::{Lines, line, on_all_processors};

    #[test]
    fn results_are_in_the_order_of_the_items_and_a_failure_is_returned() {
        let items: Vec<u32> = (0..1000).collect();
        let squares = on_all_processors(&items, "squares", |_| "", |x| Ok::<_, u32>(x * x));
        assert_eq!(squares, Ok(items.iter().map(|x| x * x).collect()));
        assert_eq!(
            on_all_processors(&items, "squares", |_| "", |x| if *x == 700 { Err(*x) } else { Ok(*x) }),
            Err(700)
        );
    }

    /// Times (s) of lines for work that reports every 0.1 s and takes `length` seconds.
    fn times(length: u32) -> Vec<f64> {
        let mut lines = Lines::default();
        let tenths_of_a_second = 0..=10 * length;
        let due = tenths_of_a_second.filter(|&k| {
            lines.is_due(f64::from(k) / f64::from(10 * length), Duration::from_millis(u64::from(k) * 100), false)
        });
        due.map(|k| f64::from(k) / 10.0).collect()
    }

    #[test]
    fn lines_come_at_tenths_of_the_work_and_neither_too_often_nor_too_seldom() {
        assert!(times(9).is_empty());
        assert_eq!(times(50), [10.0, 20.0, 30.0, 40.0, 50.0]);
        assert_eq!(times(200), [10.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0]);
        let long = times(36_000);
        assert_eq!(long[..4], [10.0, 70.0, 130.0, 190.0]);
        assert!(long.windows(2).all(|pair| pair[1] - pair[0] <= 60.0));
    }

    #[test]
    fn a_line_tells_what_is_done_and_the_time_left() {
        let minute = Duration::from_secs(60);
        assert_eq!(line((0, 250, 1000), None, minute), "25 % done after 60 seconds, about 3 minutes left");
        assert_eq!(line((0, 0, 1000), None, minute), "0 % done after 60 seconds");
        assert_eq!(line((0, 1000, 1000), None, minute), "100 % done after 60 seconds, about 0 seconds left");
        // The rate is so small that the remaining time exceeds any number of seconds.
        let year = Duration::from_secs(31_557_600);
        assert!(line((0, 1, u64::MAX), None, year).ends_with("about 31709792 years left"));
        assert!(line((0, 1, 2), None, Duration::ZERO).ends_with("about 0 seconds left"));
        let scenes = "50 % done, 1000 of 2000 scenes, 1.000e1 scenes/s, after 60 seconds, about 2 minutes left";
        assert_eq!(line((400, 1000, 2000), Some("scenes"), minute), scenes);
    }
}
