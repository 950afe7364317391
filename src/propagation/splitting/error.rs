//! The error of a motion by splitting, from the same motion with shorter steps.

use crate::propagation::splitting::SplittingMotion;
use crate::propagation::splitting::flows::Pair;
use crate::propagation::splitting::stepper::Steps;

/// Most times at which the two motions are compared.
const COMPARISONS: u64 = 256;

/// Estimate over difference.
const SAFETY: f64 = 3.0;

/// Differences from the motion with steps of two thirds, the largest so far, at equal distances in time.
///
/// Where the error has order `p` the difference is `1 - (2/3)^p` of it: 0.56 for `p = 2`, 0.98 for `p = 10`. Three times the
/// difference is the estimate. Both motions feel the same instability near the middle axis, so that no model of its growth
/// is needed.
#[derive(Debug, Clone)]
pub(super) struct ErrorEstimate {
    interval: f64,
    largest: Vec<f64>,
    /// Rounding of `s`, of the initial state and of the step, which both motions share, per unit of time.
    shared_rounding: f64,
}

impl ErrorEstimate {
    pub(super) fn new(motion: &SplittingMotion) -> Self {
        let scene = &motion.scene;
        let twos = motion.step_count() / 2;
        let stride = twos.div_ceil(COMPARISONS);
        let shorter = Steps::new(motion.scheme(), &scene.field, motion.step() * 2.0 / 3.0, scene.largest_rate);
        let mut state = scene.start;
        shorter.open(&mut state);
        let (mut largest, mut most, mut done) = (Vec::new(), 0.0_f64, 0);
        while done < twos {
            let now = stride.min(twos - done);
            shorter.advance(&mut state, scene.casimir, 3 * now);
            done += now;
            let mut closed = state;
            shorter.close(&mut closed);
            let difference = SAFETY * largest_difference(&closed, &motion.after(2 * done), scene.largest_rate);
            most = if difference > most || difference.is_nan() { difference } else { most };
            largest.push(most);
        }
        let interval = 2.0 * stride as f64 * motion.step().abs();
        Self { interval, largest, shared_rounding: 2.0 * f64::EPSILON * scene.largest_rate }
    }

    /// The estimate after the time `elapsed`.
    pub(super) fn at(&self, elapsed: f64) -> f64 {
        let rounding = 4.0 * f64::EPSILON + self.shared_rounding * elapsed;
        if elapsed == 0.0 || self.interval == 0.0 {
            return rounding;
        }
        let index = (elapsed / self.interval) as usize;
        self.largest[index.min(self.largest.len() - 1)] + rounding
    }
}

/// Largest difference of a component of `n`, and of `w` in units of `rate`.
fn largest_difference(a: &Pair<f64>, b: &Pair<f64>, rate: f64) -> f64 {
    let unit = if rate > 0.0 { rate } else { 1.0 };
    (0..3).fold(0.0, |most: f64, i| {
        let difference = (a.axis[i] - b.axis[i]).abs().max((a.rate[i] - b.rate[i]).abs() / unit);
        if difference > most || difference.is_nan() { difference } else { most }
    })
}
