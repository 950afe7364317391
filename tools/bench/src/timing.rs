//! Times of several cases, taken in turn.

/// CPU time of this thread (s), which other programs disturb less than the wall-clock time; on systems without such a clock, the wall-clock time.
pub fn clock() -> f64 {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
    }
    #[cfg(not(unix))]
    {
        static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
        START.elapsed().as_secs_f64()
    }
}

/// Times of one case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// Least time (s): that of the run least disturbed by other programs.
    pub least: f64,
    /// Median time (s).
    pub median: f64,
}

impl Times {
    fn of(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        Self { least: seconds[0], median: seconds[seconds.len() / 2] }
    }
}

/// Runs every case once to warm up, then `rounds` times each, in turn; `done` receives the fraction of the rounds that is over.
pub fn in_turn<R>(
    cases: &mut [impl FnMut() -> Result<R, String>],
    rounds: usize,
    done: impl FnMut(f64),
) -> Result<Vec<Times>, String> {
    in_turn_by(clock, cases, rounds, done)
}

/// As `in_turn`, with any clock (s).
fn in_turn_by<R>(
    clock: impl Fn() -> f64,
    cases: &mut [impl FnMut() -> Result<R, String>],
    rounds: usize,
    mut done: impl FnMut(f64),
) -> Result<Vec<Times>, String> {
    let mut seconds = vec![Vec::with_capacity(rounds); cases.len()];
    for round in 0..=rounds {
        for (case, seconds) in cases.iter_mut().zip(&mut seconds) {
            let start = clock();
            std::hint::black_box(case()?);
            let elapsed = clock() - start;
            if round > 0 {
                seconds.push(elapsed);
            }
        }
        done(round as f64 / rounds as f64);
    }
    Ok(seconds.into_iter().map(Times::of).collect())
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};

    use super::*;

    #[test]
    fn cases_take_turns_after_a_round_that_does_not_count() {
        let (order, now) = (RefCell::new(Vec::new()), Cell::new(0.0));
        // Case 0 takes 0.5 s in the first round, then 1 s and 3 s; case 1 ten times as long.
        let case = |i: usize| {
            let (order, now) = (&order, &now);
            move || {
                let round = order.borrow().len() / 2;
                order.borrow_mut().push(i);
                now.set(now.get() + [0.5, 1.0, 3.0][round] * [1.0, 10.0][i]);
                Ok(())
            }
        };
        let times = in_turn_by(|| now.get(), &mut [case(0), case(1)], 2, |_| ()).expect("no case fails");
        assert_eq!(*order.borrow(), [0, 1, 0, 1, 0, 1]);
        assert_eq!(times.iter().map(|t| [t.least, t.median]).collect::<Vec<_>>(), [[1.0, 3.0], [10.0, 30.0]]);
        assert_eq!(in_turn(&mut [|| Err::<(), _>("no".to_owned())], 2, |_| ()), Err("no".to_owned()));
    }
}
