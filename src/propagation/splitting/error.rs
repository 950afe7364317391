//! The error of a motion by splitting, from the same motion by a more accurate scheme.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::propagation::splitting::GRADIENT_8_8_6;
use crate::propagation::splitting::double_steps::DoubleSteps;
use crate::propagation::splitting::flows::{AXIS, Field, Moving, RATE};
use crate::propagation::splitting::motion::KeptStates;

/// Largest number of times at which the two motions are compared.
const COMPARISONS: u64 = 256;

/// Ratio of the estimate to the difference. If the leading terms of the two errors nearly cancel, or the error has another size
/// between the times compared, the difference is less than the error: by a factor of at most 3.4 in 160,000 random comparisons.
const SAFETY: f64 = 6.0;

/// Displacement of the start of the more accurate motion, in roundings, in an arbitrary direction.
const OFF: [f64; 3] = [8.3, -6.1, 7.7];

/// Displacement of the start of a second motion with the same steps, in a direction normal to the first: an instability may leave one of the
/// two unchanged. In the field of this second motion the eigenvalues of `s` are displaced by their own roundings, which are large relative to
/// the difference of nearly equal eigenvalues.
const OFF_ACROSS: [f64; 3] = [9.4, 8.9, -3.1];
const EIGENVALUES_OFF: [f64; 3] = [3.7, -5.3, 4.1];

/// Off-diagonal components of `s` in the field of the second motion, in roundings. They turn the principal axes, by a large angle for nearly
/// equal eigenvalues.
const OFF_DIAGONAL: [f64; 3] = [4.3, -3.9, 5.1];

/// Rounding of `s`, of the initial state and of the step, which both motions share, in units in the last place for each radian of
/// rotation.
const SHARED: f64 = 8.0;

/// Rounding error of the evaluation of the state.
const READING: f64 = 4.0 * f64::EPSILON;

/// Longest step of the more accurate motion, in radians of the rotation: beyond it, the order of a scheme does not describe how
/// its error decreases.
const LONGEST_STEP: f64 = 1.0;

/// Largest number of steps of the more accurate motion for two of the other. For even longer steps nothing is known, and the
/// estimate is infinite.
const MOST_FINER: f64 = 1e4;

/// The error at the end of a motion, with the data from which a motion that starts there continues the estimate.
#[derive(Debug, Clone)]
pub(crate) struct ErrorAtEnd {
    /// The largest difference so far, times [`SAFETY`].
    largest: f64,
    /// The rounding that all motions share.
    shared_rounding: f64,
    /// `n`, `L` and, if it is followed, `e_x` of the more accurate motion, and of the second one, whose start is displaced in another
    /// direction.
    others: [[Vector3<f64>; 3]; 2],
}

/// Six times the difference from the motion by [`GRADIENT_8_8_6`] with stages half as long or shorter: the largest difference
/// so far, at equally spaced times.
///
/// That motion is far more accurate than those of the other schemes, so that the difference is their error. For the scheme
/// itself the difference is `1 - (1/2)^6 = 0.98` of the error. (The same scheme with other steps does not serve for the
/// others: if two terms of an error cancel, two steps can have the same error.) Both motions have the same instability near
/// the middle axis, so that no model of its growth is needed.
#[derive(Debug, Clone)]
pub(super) struct ErrorEstimate {
    interval: f64,
    largest: Vec<f64>,
    /// [`SHARED`], per unit of time.
    shared_rounding: f64,
    /// At the start: the largest difference, times [`SAFETY`], and the rounding shared.
    at_start: [f64; 2],
    pub(super) at_end: ErrorAtEnd,
}

impl ErrorEstimate {
    pub(super) fn new<const V: usize>(motion: &KeptStates<V>) -> Self {
        let scene = &motion.scene;
        let twos = motion.step_count / 2;
        let stride = twos.div_ceil(COMPARISONS);
        let by_stages = (4 * motion.scheme.stages()).div_ceil(GRADIENT_8_8_6.stages()) as u64;
        let interval = 2.0 * stride as f64 * motion.step.abs();
        let shared_rounding = SHARED * f64::EPSILON * scene.largest_rate;
        let duration = motion.step * motion.step_count as f64;
        // The start of the others is displaced by a rounding, so that the difference includes the growth by an instability of the rounding that
        // all motions share.
        let (mut most, earlier_rounding, starts) = match &motion.earlier {
            None => (0.0, 0.0, [OFF, OFF_ACROSS].map(|by| off(&scene.start, by, scene.largest_rate))),
            Some(ErrorAtEnd { largest, shared_rounding, others }) => {
                (*largest, *shared_rounding, others.each_ref().map(|vectors| scene.moving(vectors)))
            }
        };
        // Each has its own w.n: near rest, where `w` is small, the w.n of the motion would turn `n` by much more than the displacement.
        let casimirs = starts.each_ref().map(|of| {
            let n = Vector3::from(of.vectors[AXIS]);
            n.dot(&Vector3::from(of.vectors[RATE])) / n.norm()
        });
        let at_start = [most, earlier_rounding];
        let at_end = |largest: f64, others: [Moving<f64, V>; 2]| ErrorAtEnd {
            largest,
            shared_rounding: earlier_rounding + shared_rounding * duration.abs(),
            others: core::array::from_fn(|k| {
                let rate = scene.rate_about_axis - motion.rate_about_axis_for(casimirs[k] - scene.casimir);
                scene.vectors(&others[k], rate * duration)
            }),
        };
        let by_angle = (2.0 * motion.step.abs() * scene.largest_rate / LONGEST_STEP).ceil();
        if by_angle > MOST_FINER {
            let (largest, at_end) = (vec![f64::INFINITY], at_end(f64::INFINITY, starts));
            return Self { interval, largest, shared_rounding, at_start, at_end };
        }
        let per_two = by_stages.max(by_angle as u64);
        let other = |step| DoubleSteps::new(&GRADIENT_8_8_6, &scene.field, step, scene.largest_rate);
        let finer = other(2.0 * motion.step / per_two as f64);
        let half_back = other(-0.5 * motion.step);
        let half_forth = DoubleSteps::new(motion.scheme, &scene.field, 0.5 * motion.step, scene.largest_rate);
        let ([mut state, mut beside], [casimir, beside_casimir]) = (starts, casimirs);
        finer.open(&mut state);
        let field = Field::new(scene.field.strength, rounded(scene.eigenvalues));
        let axes_off = turn_of_axes(scene.eigenvalues);
        beside = turned(&beside, &axes_off);
        let along = DoubleSteps::new(motion.scheme, &field, motion.step, scene.largest_rate);
        along.open(&mut beside);
        let (mut largest, mut ends, mut done) = (Vec::new(), starts, 0);
        while done < twos {
            let now = stride.min(twos - done);
            finer.advance(&mut state, casimir, per_two * now);
            along.advance(&mut beside, beside_casimir, 2 * now);
            done += now;
            let mut closed = state;
            finer.close(&mut closed);
            let there = motion.after(2 * done);
            let at_step = largest_difference(&closed, &there, scene.largest_rate);
            let mut grown = beside;
            along.close(&mut grown);
            let grown = turned(&grown, &axes_off.transpose());
            ends = [closed, grown];
            let grown = largest_difference(&grown, &there, scene.largest_rate);
            // Also in the middle of a step, where the error differs.
            half_back.single(&mut closed, casimir);
            let mut between = motion.after(2 * done - 1);
            half_forth.single(&mut between, scene.casimir);
            let in_step = largest_difference(&closed, &between, scene.largest_rate);
            for difference in [at_step, grown, in_step] {
                most = if SAFETY * difference > most || difference.is_nan() { SAFETY * difference } else { most };
            }
            largest.push(most);
        }
        Self { interval, largest, shared_rounding, at_start, at_end: at_end(most, ends) }
    }

    /// The estimate after the time `elapsed`.
    pub(super) fn at(&self, elapsed: f64) -> f64 {
        let [at_start, earlier_rounding] = self.at_start;
        let rounding = READING + earlier_rounding + self.shared_rounding * elapsed;
        if elapsed == 0.0 || self.interval == 0.0 {
            return at_start + rounding;
        }
        let index = (elapsed / self.interval) as usize;
        self.largest[index.min(self.largest.len() - 1)] + rounding
    }
}

/// The contribution of rounding to the estimate after a rotation by the angle `turn` (rad) without instability: the rounding of the numbers
/// that both motions share, and the effect of the displaced start, whose component along `w`, a third of its square on average, changes the
/// rate.
pub(super) fn expected_rounding(turn: f64) -> f64 {
    let off = OFF.iter().map(|x| x * x).sum::<f64>();
    READING + f64::EPSILON * (SHARED * turn + SAFETY * (off / 3.0).sqrt() * (1.0 + turn))
}

/// Eigenvalues displaced by [`EIGENVALUES_OFF`] roundings of the largest.
fn rounded(eigenvalues: [f64; 3]) -> [f64; 3] {
    let largest = eigenvalues.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    core::array::from_fn(|k| eigenvalues[k] + EIGENVALUES_OFF[k] * f64::EPSILON * largest)
}

/// The turn of the principal axes by [`OFF_DIAGONAL`] roundings of the largest eigenvalue.
fn turn_of_axes(eigenvalues: [f64; 3]) -> Matrix3<f64> {
    let largest = eigenvalues.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let turns = (0..3).map(|k| {
        let difference = eigenvalues[(k + 1) % 3] - eigenvalues[(k + 2) % 3];
        let component = OFF_DIAGONAL[k] * f64::EPSILON * largest;
        Rotation3::new(Vector3::ith(k, 0.5 * (2.0 * component).atan2(difference.abs())))
    });
    turns.fold(Matrix3::identity(), |all, turn| all * turn.into_inner())
}

fn turned<const V: usize>(state: &Moving<f64, V>, by: &Matrix3<f64>) -> Moving<f64, V> {
    Moving::new(state.vectors.map(|v| (by * Vector3::from(v)).into()))
}

/// A start displaced by a number of roundings.
fn off<const V: usize>(start: &Moving<f64, V>, parts: [f64; 3], rate: f64) -> Moving<f64, V> {
    let mut state = *start;
    for v in 0..V {
        let unit = if v == RATE { rate } else { 1.0 };
        for (x, part) in state.vectors[v].iter_mut().zip(parts) {
            *x += part * f64::EPSILON * unit;
        }
    }
    state
}

/// Largest difference of a component of `n` and the vector carried along, and of `w` in units of `rate`.
fn largest_difference<const V: usize>(a: &Moving<f64, V>, b: &Moving<f64, V>, rate: f64) -> f64 {
    let unit = if rate > 0.0 { rate } else { 1.0 };
    let mut most = 0.0_f64;
    for v in 0..V {
        let unit = if v == RATE { unit } else { 1.0 };
        for i in 0..3 {
            let difference = (a.vectors[v][i] - b.vectors[v][i]).abs() / unit;
            most = if difference > most || difference.is_nan() { difference } else { most };
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::{AXIS_STATE, axis_problem, problem};
    use crate::dynamics::{AxisState, BodyState, RotationState};
    use crate::propagation::Motion;
    use crate::propagation::splitting::{STRANG, Scheme, SplittingMotion};

    type Reduced = SplittingMotion<AxisState<f64>>;

    fn motion(s: [f64; 3], scheme: &'static Scheme, step: f64, count: f64) -> Reduced {
        axis_problem(s).splitting_by(scheme, (3.0, 3.0 + step * count), step).unwrap()
    }

    /// The tensor with these eigenvalues along the turned axes has the given off-diagonal components; for equal eigenvalues the axes are at 45
    /// degrees.
    #[test]
    fn axes_are_turned_by_the_rounding_of_the_tensor() {
        let eigenvalues = [0.3, 0.3 - 1e-7, -0.4];
        let turn = turn_of_axes(eigenvalues);
        let tensor = turn * Matrix3::from_diagonal(&eigenvalues.into()) * turn.transpose();
        let rounding = f64::EPSILON * 0.4;
        for (k, (i, j)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
            assert!((tensor[(i, j)].abs() / (OFF_DIAGONAL[k].abs() * rounding) - 1.0).abs() < 0.3, "{tensor}");
        }
        let turn = turn_of_axes([0.3, 0.3, 0.3]);
        assert!((turn.transpose() * turn - Matrix3::identity()).norm() < 1e-15 && (turn[(0, 0)] - 0.5).abs() < 0.3);
        assert_eq!(turn_of_axes([0.0; 3]), Matrix3::identity());
    }

    /// The start of a motion has the error of the end of the one before, and its rounding is added to that of all before it.
    #[test]
    fn errors_of_motions_that_go_on_add_up() {
        let part = || motion([0.3, 0.1, -0.4], &GRADIENT_8_8_6, 0.0625, 64.0);
        let rounding = ErrorEstimate::new(part().axis_states()).shared_rounding * 4.0;
        let mut end = part().error_at_end();
        for before in 1..4 {
            let next = part().with_initial_error(end.clone());
            let estimate = ErrorEstimate::new(next.axis_states());
            assert!((estimate.at_start[1] / (rounding * f64::from(before)) - 1.0).abs() < 1e-14, "{before}");
            let expected = [end.largest, *estimate.largest.last().unwrap()];
            for (t, largest, parts) in [(3.0, expected[0], before), (7.0, expected[1], before + 1)] {
                let expected = largest + READING + rounding * f64::from(parts);
                assert!((next.error_estimate(t) / expected - 1.0).abs() < 1e-12, "{before} {t}");
            }
            end = next.error_at_end();
        }
        // The same backwards in time.
        let back = axis_problem([0.3, 0.1, -0.4]).splitting_by(&GRADIENT_8_8_6, (7.0, 3.0), 0.0625).unwrap();
        assert!((back.error_at_end().shared_rounding / rounding - 1.0).abs() < 1e-14);
    }

    /// The motions compared go on from where they ended before: those from a displaced start end as a motion that starts there, also `e_x`, whose
    /// rate about `n` is that of their own `L.n`.
    #[test]
    fn a_motion_that_goes_on_is_compared_with_those_before() {
        let s = [0.3, 0.1, -0.4];
        let span = (3.0, 7.0);
        let displaced = {
            let BodyState { axis, momentum, equatorial_axis } = *problem(s).initial();
            let momentum = momentum + axis * 1e-3 + equatorial_axis * 2e-3;
            BodyState { axis, momentum, equatorial_axis }
        };
        let others = [displaced.vectors(); 2];
        let earlier = ErrorAtEnd { largest: 0.0, shared_rounding: 0.0, others };
        let motion = problem(s).splitting_by(&GRADIENT_8_8_6, span, 0.01).unwrap().with_initial_error(earlier);
        let expected = problem(s).starting_from(displaced).unwrap().taylor(span, 1e-13).unwrap().state(7.0).unwrap();
        for found in motion.error_at_end().others {
            for (found, expected) in found.iter().zip(expected.vectors()) {
                assert!((found - expected).norm() < 1e-9, "{found} {expected}");
            }
        }
    }

    #[test]
    fn motions_are_compared_at_256_times_or_half_as_many() {
        for (count, times, stride) in [(512.0, 256, 1.0), (514.0, 129, 2.0)] {
            let estimate = ErrorEstimate::new(motion([0.3, 0.1, -0.4], &GRADIENT_8_8_6, 0.0625, count).axis_states());
            assert_eq!((estimate.largest.len(), estimate.interval), (times, 2.0 * stride * 0.0625));
            assert!(estimate.largest.iter().all(|&error| error < 1e-10), "{:?}", estimate.largest.last());
        }
    }

    #[test]
    fn the_error_is_unknown_where_two_steps_turn_by_more_than_ten_thousand_radians() {
        let rate = AXIS_STATE.momentum.norm() / 1.3;
        let estimate = |turn: f64| motion([0.0; 3], &STRANG, 0.5 * turn / rate, 2.0).error_estimate(3.0);
        let at_end = |turn: f64| {
            let span = (3.0, 3.0 + turn / rate);
            let motion = axis_problem([0.0; 3]).splitting_by(&STRANG, span, 0.5 * turn.abs() / rate).unwrap();
            motion.error_estimate(3.0 + 0.9 * turn / rate)
        };
        for sense in [1.0, -1.0] {
            assert!(at_end(sense * 9.5e3).is_finite() && at_end(sense * 1.05e4) == f64::INFINITY);
        }
        assert_eq!(estimate(1.05e4), 4.0 * f64::EPSILON);
    }

    #[test]
    fn at_the_start_alone_nothing_but_rounding_is_off() {
        let motion = motion([0.3, 0.1, -0.4], &STRANG, 0.5, 8.0);
        assert_eq!(ErrorEstimate::new(motion.axis_states()).interval, 1.0);
        assert_eq!(motion.error_estimate(3.0), 4.0 * f64::EPSILON);
        for elapsed in [0.3, 1.0, 2.7] {
            assert!(motion.error_estimate(3.0 + elapsed) > 1e-5);
        }
    }

    #[test]
    fn the_two_motions_start_off_in_directions_normal_to_each_other() {
        let (first, second) = (Vector3::from(OFF), Vector3::from(OFF_ACROSS));
        assert!(first.dot(&second).abs() < 0.01 * first.norm() * second.norm());
    }

    #[test]
    fn differences_of_rates_are_in_units_of_the_largest_if_there_is_one() {
        let a = Moving::new([[0.6, 0.0, 0.8], [0.1, 0.0, 0.0]]);
        let mut b = a;
        b.vectors[RATE][2] = -0.125;
        for (rate, difference) in [(0.5, 0.25), (2.0, 0.0625), (0.0, 0.125)] {
            assert_eq!(largest_difference(&a, &b, rate), difference);
        }
    }

    /// Each eigenvalue is displaced by some roundings of the largest, whatever its own size, and each difference by more than one rounding.
    #[test]
    fn eigenvalues_are_off_by_roundings_of_the_largest() {
        for size in [1.0, 1e-9] {
            let values = [1.0, 1e-5, -3.0].map(|value| value * size);
            let moved = rounded(values);
            let by = [0, 1, 2].map(|k| (moved[k] - values[k]) / (f64::EPSILON * 3.0 * size));
            assert!(by.iter().all(|x| (3.0..6.0).contains(&x.abs())), "{by:?}");
            let apart = [by[0] - by[1], by[1] - by[2]];
            assert!(apart.iter().all(|x| x.abs() > 5.0), "{by:?}");
        }
    }
}
