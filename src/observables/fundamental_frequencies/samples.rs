//! States of a motion in equal steps of time, fine enough to count turns, and their averages over the fast rotation.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::error::Error;
use crate::numerics::angle::whole_turns;
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
    pub(super) fn of<M: Motion<f64, State = BodyState<f64>>>(motion: &M) -> Result<Self, Error> {
        let (from, to) = motion.span();
        let (start, end) = (from.min(to), from.max(to));
        let body = motion.spheroid();
        let momentum = motion.state(start)?.momentum.norm();
        // The torque 2 C |n x s n| works within its own time sqrt(I^xx / (2 C |s|)).
        let pull = (2.0 * body.constant_c.abs() * motion.coefficients().norm() / body.inertia_xx).sqrt();
        let rotation = momentum / body.inertia_xx.min(body.inertia_zz) + pull;
        Error::ensure(rotation > 0.0 && rotation.is_finite(), "rate of rotation", rotation, "above zero and finite")?;
        let intervals = ((end - start) * rotation / ROTATION_PER_STEP).ceil();
        Error::ensure(intervals <= MOST_SAMPLES, "length of the span in half radians", intervals, "at most 1e7")?;
        let step = (end - start) / intervals.max(1.0);
        let times = (0..=intervals as usize).map(|i| (start + step * i as f64).min(end));
        let states: Vec<_> = times.map(|time| motion.state(time)).collect::<Result<_, _>>()?;
        let reach = (SMOOTHING_ROTATION / 2.0 * body.inertia_xx / (momentum * step)).ceil();
        // So many that the averages are left with something to average.
        let most = states.len() as f64 / (4 * PASSES) as f64;
        Error::ensure(
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
            let continued = last.map_or(angle, |last: f64| angle + whole_turns(last - angle));
            *last.insert(continued)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::observables::tests::Made;

    impl Samples {
        /// With nothing to average.
        pub(in crate::observables::fundamental_frequencies) fn made(states: Vec<BodyState<f64>>) -> Self {
            Self { start: 0.0, step: 1.0, states, reach: 0 }
        }
    }

    fn state(momentum: Vector3<f64>, time: f64) -> BodyState<f64> {
        BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::new(time, 0.0, 0.0) }
    }

    /// `|L| = 0.8`, `2 C |s| = 0.36` in size.
    fn sampled(inertia_zz: f64, span: (f64, f64)) -> Result<Samples, Error> {
        let spheroid = RigidSpheroid { inertia_xx: 2.0, inertia_zz, constant_c: -0.6 };
        let violation = Matrix3::from_diagonal(&Vector3::new(0.2, -0.1, 0.2));
        let state = |t| Ok(state(Vector3::new(0.48, 0.0, -0.64), t));
        Samples::of(&Made { spheroid, coefficients: violation, span, error: 0.0, state })
    }

    #[test]
    fn steps_are_half_a_radian_of_the_fastest_rotation() {
        for inertia_zz in [1.7, 3.1] {
            let rotation = 0.8 / f64::min(2.0, inertia_zz) + (0.36_f64 / 2.0).sqrt();
            let samples = sampled(inertia_zz, (700.5, -299.8)).unwrap();
            let intervals = (1000.3 * rotation / 0.5).ceil();
            assert_eq!(samples.states.len() as f64, intervals + 1.0);
            assert_eq!(samples.start, -299.8);
            assert!((samples.step - 1000.3 / intervals).abs() < 1e-12);
            for (i, state) in samples.states.iter().enumerate() {
                assert!((state.equatorial_axis.x - (-299.8 + samples.step * i as f64)).abs() < 1e-11);
                assert!((samples.time(i) - state.equatorial_axis.x).abs() < 1e-11);
            }
            assert!(samples.states.last().unwrap().equatorial_axis.x <= 700.5);
            // Half of 36 rad about L, 80.5 steps or 74.2.
            let reach = 18.0 * 2.0 / (0.8 * samples.step);
            assert!((0.1..0.9).contains(&reach.fract()) && samples.reach as f64 == reach.ceil());
        }
    }

    #[test]
    fn the_shortest_span_has_twelve_samples_for_each_of_half_an_average() {
        let rotation = 0.8 / 1.7 + (0.36_f64 / 2.0).sqrt();
        let length = |intervals: f64| (intervals - 0.4) * 0.5 / rotation;
        let samples = sampled(1.7, (0.0, length(972.0))).unwrap();
        assert_eq!((samples.states.len(), samples.reach), (12 * 81 + 1, 81));
        for span in [(3.0, 3.0 + length(971.0)), (3.0 + length(971.0), 3.0)] {
            match sampled(1.7, span) {
                Err(Error::Domain { quantity: "span in turns of n about L", value, .. }) => {
                    assert!((value / (length(971.0) * 0.8 / 2.0 / TAU) - 1.0).abs() < 1e-12);
                }
                other => panic!("{:?}", other.map(|samples| samples.states.len())),
            }
        }
    }

    /// What is refused, of a motion that is known at its first time alone.
    fn refused(momentum: f64, end: f64) -> &'static str {
        let known = |t: f64| {
            Error::ensure(t == 0.0, "later time", t, "zero")?;
            Ok(state(Vector3::new(0.0, momentum, 0.0), t))
        };
        match Samples::of(&Made::new((0.0, end), known)) {
            Err(Error::Domain { quantity, .. }) => quantity,
            other => panic!("{:?}", other.map(|samples| samples.states.len())),
        }
    }

    #[test]
    fn a_rotation_has_a_rate_and_a_span_at_most_ten_million_steps() {
        assert_eq!([0.0, f64::INFINITY].map(|momentum| refused(momentum, 1e3)), ["rate of rotation"; 2]);
        assert_eq!(refused(0.5, 1e3), "later time");
        assert_eq!(
            (refused(0.5, 1e7), refused(0.5, 1.000_001e7)),
            ("later time", "length of the span in half radians")
        );
    }

    #[test]
    fn averages_are_by_a_window_of_shape_fourteen_and_at_their_times() {
        let (reach, step) = (40, 0.3);
        // Seven radians in half of the window.
        let frequency = 2.0 * 7.0 / (81.0 * step);
        let around = |t: f64| Vector3::new((frequency * t).cos(), (frequency * t).sin(), 0.0);
        let line = |t: f64| Vector3::new(0.3 + 0.1 * t, -0.2 * t, 1.1);
        let states: Vec<_> = (0..301)
            .map(|i| 2.0 + step * f64::from(i))
            .map(|t| BodyState { axis: line(t) + around(t), ..state(line(-t) + 0.7 * around(t), t) })
            .collect();
        let samples = Samples { start: 2.0, step, states, reach };
        let averages = samples.averages().unwrap();
        assert_eq!(averages.len(), 301 - 6 * reach);
        // The transform of Kaiser's window.
        let left = 147.0_f64.sqrt().sinh() / 147.0_f64.sqrt() * 14.0 / 14.0_f64.sinh();
        for (i, averaged) in averages.iter().enumerate() {
            let t = 2.0 + step * (3 * reach + i) as f64;
            assert!((averaged.state.equatorial_axis.x - t).abs() < 1e-12);
            assert!((averaged.momentum - line(-t) - 0.7 * left * around(t)).norm() < 1e-4, "{i}");
            assert!((averaged.fast_axis - (1.0 - left).powi(3) * around(t)).norm() < 1e-4, "{i}");
        }
    }
}
