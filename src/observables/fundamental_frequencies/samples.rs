//! States of a motion in equal steps of time, fine enough to count turns, and their averages over the fast rotation.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::error::Error;
use crate::observables::spectrum::Window;
use crate::propagation::Motion;

/// Rotation between two samples (rad).
const ROTATION_PER_STEP: f64 = 0.5;

/// Most samples of a span.
const MOST_SAMPLES: f64 = 1e7;

/// Weight of the average over the fast rotation: what it leaves of an oscillation beyond its width is below 5e-6.
const SMOOTHING: Window = Window::Kaiser { shape: 14.0 };

/// Width of that average in radian of the rotation of `n` about `L`: its first zero, `2 hypot(14, pi) = 28.7`, lies below the
/// lines near that rotation rate, at four fifths of it.
const SMOOTHING_ROTATION: f64 = 36.0;

/// Times that the average is taken away from `n`: one alone would leave some percent of its slow motion, which may be more than
/// the fast one.
const PASSES: usize = 3;

/// States in equal steps of time, in the direction of growing time.
pub(super) struct Samples {
    pub(super) start: f64,
    pub(super) step: f64,
    pub(super) states: Vec<BodyState<f64>>,
    /// Samples on either side of one that its average takes in.
    reach: usize,
}

impl Samples {
    pub(super) fn of<M: Motion<f64>>(motion: &M) -> Result<Self, Error> {
        let (from, to) = motion.span();
        let (start, end) = (from.min(to), from.max(to));
        let body = motion.spheroid();
        let momentum = motion.state(start)?.momentum.norm();
        // The torque 2 C |n x s n| works within its own time sqrt(I^xx / (2 C |s|)).
        let pull = (2.0 * body.constant_c.abs() * motion.violation().norm() / body.inertia_xx).sqrt();
        let rotation = momentum / body.inertia_xx.min(body.inertia_zz) + pull;
        Error::unless(rotation > 0.0 && rotation.is_finite(), "rate of rotation", rotation, "above zero and finite")?;
        let intervals = ((end - start) * rotation / ROTATION_PER_STEP).ceil();
        Error::unless(intervals <= MOST_SAMPLES, "length of the span in half radians", intervals, "at most 1e7")?;
        let step = (end - start) / intervals.max(1.0);
        let times = (0..=intervals as usize).map(|i| (start + step * i as f64).min(end));
        let states: Vec<_> = times.map(|time| motion.state(time)).collect::<Result<_, _>>()?;
        let reach = (SMOOTHING_ROTATION / 2.0 * body.inertia_xx / (momentum * step)).ceil();
        // So many that the averages are left with something to average.
        let most = states.len() as f64 / (4 * PASSES) as f64;
        Error::unless(
            reach < most,
            "span in turns of n about L",
            (end - start) * momentum / body.inertia_xx / TAU,
            "long enough for repeated averages over 6 turns, at least 35",
        )?;
        Ok(Self { start, step, states, reach: reach as usize })
    }

    /// Time of a sample.
    pub(super) fn time(&self, index: usize) -> f64 {
        self.start + self.step * index as f64
    }

    /// Each sample far enough from the ends, with the average of `L` over the fast rotation and what averages leave of `n`.
    pub(super) fn averages(&self) -> Result<Vec<Averaged>, Error> {
        let weights = SMOOTHING.weights(2 * self.reach + 1)?;
        let smooth = |vectors: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            let mean = |near: &[Vector3<f64>]| {
                near.iter().zip(&weights).map(|(v, weight)| v * *weight).sum::<Vector3<f64>>() / weights.len() as f64
            };
            vectors.windows(weights.len()).map(mean).collect()
        };
        let mut fast: Vec<_> = self.states.iter().map(|state| state.axis).collect();
        for _ in 0..PASSES {
            let slow = smooth(&fast);
            fast = slow.iter().zip(&fast[self.reach..]).map(|(slow, all)| all - slow).collect();
        }
        let momenta: Vec<_> = self.states.iter().map(|state| state.momentum).collect();
        let slow = smooth(&momenta);
        let inner = (PASSES - 1) * self.reach;
        let rows = fast.iter().zip(&slow[inner..]).zip(&self.states[inner + self.reach..]);
        Ok(rows.map(|((fast, slow), state)| Averaged { state: *state, fast_axis: *fast, momentum: *slow }).collect())
    }
}

/// A state with the averages about its time.
pub(super) struct Averaged {
    pub(super) state: BodyState<f64>,
    /// The part of `n` that rotates fast.
    pub(super) fast_axis: Vector3<f64>,
    /// The part of `L` that does not.
    pub(super) momentum: Vector3<f64>,
}

/// Angles without jumps: each continued by the nearest turn.
pub(super) fn continuous(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut last = None;
    angles
        .map(|angle| {
            let continued = last.map_or(angle, |last: f64| angle + ((last - angle) / TAU).round() * TAU);
            *last.insert(continued)
        })
        .collect()
}
