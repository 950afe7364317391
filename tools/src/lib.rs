//! Common parts of several campaigns: arguments, times, distributions of ratios, and long motions in double-double numbers.

use std::hint::black_box;
use std::str::FromStr;

use twofold::Scalar;
use twofold::dynamics::{Problem, RotationState};
use twofold::propagation::Motion;
use twofold_bench::timing::clock;
use twofold_verify::double_double::DoubleDouble;

/// The argument of the program at a place, counted from zero, or `otherwise` if there is none.
///
/// # Panics
/// If it cannot be read.
pub fn argument<T: FromStr>(place: usize, otherwise: T) -> T {
    let read = |text: String| text.parse().unwrap_or_else(|_| panic!("`{text}` is no argument"));
    std::env::args().nth(place + 1).map_or(otherwise, read)
}

/// The shortest time of some runs (s), as processor time of this thread if the system provides it.
pub fn least_time<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    (0..runs).fold(f64::INFINITY, |least, _| {
        let start = clock();
        black_box(work());
        least.min(clock() - start)
    })
}

/// The ratio of an estimate to a true error, both non-negative: NaN counts as below one, a vanishing error as far above.
pub fn estimate_over_error(estimate: f64, error: f64) -> f64 {
    match estimate / error {
        _ if estimate.is_nan() || error.is_nan() => 0.0,
        _ if error == 0.0 => f64::INFINITY,
        ratio => ratio,
    }
}

/// Some ratios in ascending order.
#[derive(Debug, Clone)]
pub struct Ratios(Vec<f64>);

impl FromIterator<f64> for Ratios {
    fn from_iter<I: IntoIterator<Item = f64>>(ratios: I) -> Self {
        let mut ratios: Vec<f64> = ratios.into_iter().collect();
        ratios.sort_by(f64::total_cmp);
        Self(ratios)
    }
}

impl Ratios {
    /// Number of ratios.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The ratio below which the fraction `part` of them lies; NaN if there are none.
    pub fn quantile(&self, part: f64) -> f64 {
        let place = (self.0.len().saturating_sub(1) as f64 * part) as usize;
        self.0.get(place).copied().unwrap_or(f64::NAN)
    }

    /// Number of ratios below a limit, with NaN.
    pub fn below(&self, limit: f64) -> usize {
        self.0.iter().filter(|ratio| ratio.is_nan() || **ratio < limit).count()
    }

    /// Number of ratios above a limit, with NaN.
    pub fn above(&self, limit: f64) -> usize {
        self.0.iter().filter(|ratio| ratio.is_nan() || **ratio > limit).count()
    }
}

/// Length of the stretches of a long motion (t_c). Over one of them the tolerance 1e-16 needs a truncation below 2e-25 per t_c.
const STRETCH: f64 = 25_000.0;

/// A long motion by the Taylor series over double-double numbers, in stretches that each restart from the end of the one before.
#[derive(Debug, Clone)]
pub struct LongMotion<X: RotationState<DoubleDouble>> {
    /// The problem with its present state.
    pub problem: Problem<DoubleDouble, X>,
    /// The present time (t_c).
    pub time: f64,
}

impl<X: RotationState<DoubleDouble>> LongMotion<X> {
    /// Advances to a time.
    ///
    /// # Errors
    /// If the series refuses the motion.
    pub fn advance_to(&mut self, end: f64) -> Result<(), twofold::Error> {
        while self.time < end {
            let step = STRETCH.min(end - self.time);
            // Part of a stretch is also computed with the small truncation of a whole one.
            let motion = self.problem.taylor((0.0, STRETCH), 1e-16)?;
            self.problem = self.problem.starting_from(motion.state(DoubleDouble::from_f64(step))?)?;
            self.time += step;
        }
        Ok(())
    }
}
