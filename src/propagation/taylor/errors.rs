//! The error of a motion by Taylor series: the truncation and rounding of each step, carried to the end of every step.

use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::dynamics::equations_of_motion::reduced_rates;
use crate::numerics::scalar::Real;
use crate::propagation::taylor::error_growth::{Difference, ErrorGrowth, LARGEST};
use crate::propagation::taylor::linearised_flow::LinearisedFlow;
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::series::{AXIS, COMPANION, MOMENTUM};
use crate::propagation::taylor::shared_rounding::{SHARES, SharedRounding, excess_of_shares};

/// The vectors of a series in real numbers, by columns.
type Columns<const V: usize> = SMatrix<f64, 3, V>;

/// Standard deviation of the rounding of a change of the state, in units in the last place of the change.
pub(super) const ROUNDING: f64 = 0.5;

/// Fraction of the truncation of a step that its leading term misses.
const UNCERTAIN: f64 = 0.04;

/// When the carried error has shrunk by this factor, the square of its largest value is added, because that square does not shrink with the error.
/// Errors of the phases of a regular motion vary by less over a period.
const SHRUNK: f64 = 8.0;

/// Relative rounding, at evaluation, of the angle by which `e_x` has turned about `n`: half a unit in the last place.
const ANGLE_ROUNDING: f64 = 0.5 * f64::EPSILON;

/// The estimated error within one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepError {
    /// Error made before the step, the larger of both ends.
    carried: f64,
    /// Truncation error of the step at its end.
    local: f64,
    /// Rounding error of the step at its end.
    rounded: f64,
}

impl StepError {
    /// The error after the given fraction of the step, by a series of the given order.
    pub(super) fn at(&self, fraction: f64, order: usize) -> f64 {
        self.carried + self.rounded * fraction + self.local * fraction.powi(order as i32 + 1)
    }
}

/// The estimated error of a motion at its end, from which the error of a motion that starts there continues to grow.
#[derive(Debug, Clone)]
pub(crate) struct ErrorAtEnd {
    growth: ErrorGrowth,
    /// Unit of time of the growth.
    unit: f64,
    of_angle: f64,
    largest: f64,
}

/// Processes the steps of a motion in order.
pub(super) struct TaylorErrors<const V: usize> {
    spheroid: RigidSpheroid<f64>,
    tensor: Matrix3<f64>,
    flow: LinearisedFlow,
    shared: SharedRounding,
    /// Relative excess of each coefficient, starting with the first.
    excess: [Columns<V>; SHARES],
    growth: ErrorGrowth,
    /// Unit of time of the series.
    unit: f64,
    /// `L / I^xx` of the momentum's unit, in the unit of time.
    momentum_unit: f64,
    before: f64,
    /// The largest error carried since it last shrank by [`SHRUNK`].
    largest: f64,
    /// Bound on the error of the angle of `e_x` about `n`, which is computed apart from the series. The bound contains the rounding of the angle and
    /// the error of its rate, which is that since the start of the motion.
    of_angle: f64,
    rate_of_angle: f64,
    /// Rate of `e_x` about `n`, in the unit of time of the series; zero if only the axis is followed.
    rate_about_axis: f64,
    /// The current step.
    series: Vec<Columns<V>>,
}

impl<const V: usize> TaylorErrors<V> {
    /// The errors at the start of a motion. `earlier` is the error at the end of the motion before it, if there is one.
    pub(super) fn of<S: Real>(setup: &ScaledProblem<S, V>, earlier: Option<&ErrorAtEnd>) -> Self {
        let (scale, spheroid) = (&setup.scale, setup.spheroid.map(S::re));
        let tensor = setup.frame.tensor.map(S::re);
        let unit = scale.time;
        let rate = unit / spheroid.inertia_xx;
        let (shared, at_start) = SharedRounding::of(setup);
        let flow = LinearisedFlow::new(&spheroid, &tensor, unit, shared);
        let excess = excess_of_shares(setup).map(|[axis, momentum]| {
            Columns::from_columns(&core::array::from_fn::<_, V, _>(|i| if i == MOMENTUM { momentum } else { axis }))
        });
        let momentum_unit = scale.momentum * rate;
        let (mut growth, of_angle, largest) = match earlier {
            None => (ErrorGrowth::none(momentum_unit), 0.0, 0.0),
            Some(ErrorAtEnd { growth, unit: of_earlier, of_angle, largest }) => {
                // `e_x` is a sum that contains `n x u`: if the length of n is not one, it is turned by at most half of the difference.
                let of_lengths = if V > COMPANION { growth.of_length() / 2.0 } else { 0.0 };
                let mut growth = growth.clone().of_orthonormal_state(unit / of_earlier, momentum_unit);
                // The state at the end was rounded.
                let rounding = ROUNDING * f64::EPSILON;
                growth.add(&Difference::default(), [rounding, rounding * momentum_unit]);
                (growth, *of_angle + of_lengths, *largest)
            }
        };
        let start = setup.start.map(|v| v.vector().map(S::re));
        // The rate of e_x about n is computed from the start, whose `w.n` may have an error.
        let of_spin = growth.of_spin(&start[AXIS], &(start[MOMENTUM] * rate));
        let rate_of_angle = spheroid.oblateness().abs() * spheroid.inertia_xx / spheroid.inertia_zz * of_spin;
        let rate_of_angle = if V > COMPANION { rate_of_angle } else { 0.0 };
        let mut known = difference::<V>(&Columns::from_columns(&start), &Columns::from_columns(&at_start), rate);
        known.off_frame[0] += shared.off_frame;
        growth.add(&known, [0.0; 2]);
        let before = stated(growth.estimate((V <= COMPANION).then_some(&start[AXIS])), of_angle);
        let series = Vec::with_capacity(setup.order + 1);
        let rate_about_axis = if V > COMPANION { setup.rate_about_axis.re() * unit } else { 0.0 };
        Self {
            spheroid,
            tensor,
            flow,
            shared,
            excess,
            growth,
            unit,
            momentum_unit,
            before,
            largest: before.max(largest),
            of_angle,
            rate_of_angle,
            rate_about_axis,
            series,
        }
    }

    /// The error after the steps so far, with an error `of_time` of the vectors due to the rounding of the time.
    pub(super) fn at_end(self, of_time: f64) -> ErrorAtEnd {
        ErrorAtEnd { growth: self.growth, unit: self.unit, of_angle: self.of_angle + of_time, largest: self.largest }
    }

    /// Processes the next step, of signed length `h` in units of its series. `vector` makes the vectors of the coefficients
    /// real.
    pub(super) fn step<T>(&mut self, series: &[[T; V]], vector: impl Fn(&T) -> Vector3<f64>, h: f64) -> StepError {
        let mut columns = core::mem::take(&mut self.series);
        columns.clear();
        columns.extend(series.iter().map(|vectors| Columns::from_columns(&vectors.each_ref().map(&vector))));
        let end = columns.iter().rev().fold(Columns::zeros(), |sum, coefficient| sum * h + coefficient);
        let error = self.step_of_columns(&columns, h, &end);
        self.series = columns;
        error
    }

    fn step_of_columns(&mut self, series: &[Columns<V>], h: f64, end: &Columns<V>) -> StepError {
        let rate = self.unit / self.spheroid.inertia_xx;
        let axis: Vector3<f64> = end.column(AXIS).into();
        let only_axis = (V <= COMPANION).then_some(&axis);
        let start = (series[0].column(AXIS).into(), series[0].column(MOMENTUM) * rate);
        let growth = &mut self.growth;
        self.flow.over(start, &axis, h, |map| growth.carry(map));
        self.of_angle += (ANGLE_ROUNDING * self.rate_about_axis.abs() + self.rate_of_angle) * h.abs();
        let carried = stated(self.growth.estimate(only_axis), self.of_angle).max(self.before);

        let known = self.truncation(series, h, end);
        let size = known.size(self.momentum_unit);
        // Rounding applies to the changes without the cancellation between their first two terms or within a cross product.
        let changes = (series[1].abs() + series[2].abs() * h.abs()) * h.abs();
        let turned = (0..V).filter(|column| *column != MOMENTUM).map(|column| changes.column(column).norm());
        let turned = turned.fold(start.1.norm() * h.abs(), f64::max);
        let kicked = (self.flow.strength() * h.abs()).max(changes.column(MOMENTUM).norm() * rate);
        // Within a step the momentum also depends on the torque from the defect of the axis.
        let uncertain = UNCERTAIN * (known.momentum.norm() + size * kicked.min(self.momentum_unit));
        self.largest = self.largest.max(carried);
        let second_order = self.left_by_an_error_that_shrank(carried);
        let [turned, kicked] = [turned, kicked].map(|change| ROUNDING * f64::EPSILON * change);
        let deviations =
            [turned + UNCERTAIN * size + second_order, kicked + uncertain + second_order * self.momentum_unit];
        let mut added = known;
        added.rotation += axis * (self.shared.rate_about_axis * h);
        self.growth.add(&added, deviations);
        self.before = stated(self.growth.estimate(only_axis), self.of_angle);
        let rounded = ErrorGrowth::counted_deviation(turned.hypot(kicked / self.momentum_unit));
        StepError { carried, local: ErrorGrowth::counted(size), rounded }
    }

    /// What the linearised flow neglects: the square of an error, which remains where the error itself shrinks, as on the way back to an unstable
    /// state of rest. Otherwise it is small relative to the error.
    fn left_by_an_error_that_shrank(&mut self, carried: f64) -> f64 {
        if carried * SHRUNK > self.largest {
            return 0.0;
        }
        core::mem::replace(&mut self.largest, carried).powi(2)
    }

    /// The truncation error of the step, and the effect of rounded factors in its recurrences.
    ///
    /// It is the integral of the defect `d = x' - f(x)` of the series, which grows as `tau^order`, carried to the end of the
    /// step: the one-node Gauss-Jacobi rule for that weight, followed by the linearised flow from the node on.
    fn truncation(&self, series: &[Columns<V>], h: f64, end: &Columns<V>) -> Difference {
        let order = series.len() - 1;
        let node = (order + 1) as f64 / (order + 2) as f64;
        let (mut value, mut slope) = (series[order], Columns::<V>::zeros());
        for term in series[..order].iter().rev() {
            slope = slope * (h * node) + value;
            value = value * (h * node) + term;
        }
        let weight = h / ((order + 1) as f64 * node.powi(order as i32));
        let truncated = (slope - self.rates(&value)) * weight;
        // The factors of the recurrences are rounded, too. Most of their effect also comes from late in the step.
        let terms = series[1..].iter().zip(&self.excess).rev();
        let rounded = terms.fold(Columns::zeros(), |sum, (term, excess)| (sum + term.component_mul(excess)) * h);
        let error = truncated + rounded;
        let rate = self.unit / self.spheroid.inertia_xx;
        let mut made = difference(&value, &error, rate);
        let ends = [&value, end].map(|state| (state.column(AXIS).into(), state.column(MOMENTUM) * rate));
        self.flow.over_little(ends, h * (1.0 - node), |map| made.carry(map));
        made
    }

    /// Right-hand sides of the equations of motion in the unit of time of the series.
    fn rates(&self, state: &Columns<V>) -> Columns<V> {
        let (n, momentum): (Vector3<f64>, Vector3<f64>) = (state.column(AXIS).into(), state.column(MOMENTUM).into());
        let (axis_rate, momentum_rate) = reduced_rates(&self.spheroid, &self.tensor, &n, &momentum);
        let mut rates = Columns::<V>::zeros();
        rates.set_column(AXIS, &axis_rate);
        rates.set_column(MOMENTUM, &momentum_rate);
        if V > COMPANION {
            let turned = momentum.cross(&state.column(COMPANION)) / self.spheroid.inertia_xx;
            rates.set_column(COMPANION, &turned);
        }
        rates * self.unit
    }
}

/// The estimate of an error that grows with the motion and one of the angle about `n`.
fn stated(grown: f64, of_angle: f64) -> f64 {
    let sum = grown + of_angle;
    // Also if the sum is not a number.
    if sum < LARGEST { sum } else { LARGEST }
}

/// Small differences of the vectors at `state`, converted to a difference of motions; `rate` is `1 / I^xx` in the unit of
/// time.
fn difference<const V: usize>(state: &Columns<V>, small: &Columns<V>, rate: f64) -> Difference {
    let vector = |of: &Columns<V>, column: usize| -> Vector3<f64> { of.column(column).into() };
    let (n, of_axis) = (vector(state, AXIS), vector(small, AXIS));
    let momentum = vector(small, MOMENTUM) * rate;
    let mut made = Difference { rotation: n.cross(&of_axis), momentum, length: n.dot(&of_axis), off_frame: [0.0; 2] };
    if V > COMPANION {
        let (x, of_x) = (vector(state, COMPANION), vector(small, COMPANION));
        made.rotation += n * n.cross(&x).dot(&of_x);
        made.off_frame = [of_x.dot(&x), of_x.dot(&n) + of_axis.dot(&x)];
    }
    made
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::{BodyState, Problem, RotationState};
    use crate::propagation::taylor::step_size::Work;

    const SPHEROID: RigidSpheroid<f64> = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.8 };

    /// A free star with `n` along X and `e_x` along Y.
    fn free_star<const V: usize>(momentum: Vector3<f64>) -> ScaledProblem<f64, V> {
        let state = BodyState::from_vectors([Vector3::x(), momentum, Vector3::y()]);
        let problem = Problem::unchecked(SPHEROID, Matrix3::zeros(), state);
        ScaledProblem::new((true, Work::Waiting), &problem, (0.0, 1.0), 1e-10).unwrap()
    }

    /// A free star, and the Taylor series of the rotation of `n` and of the vector carried along about a constant `L` at the rate `|L| / I^xx`, in
    /// the scaled unit of time.
    fn rotating<const V: usize>(momentum: Vector3<f64>) -> (TaylorErrors<V>, Vec<Columns<V>>) {
        let vectors = [Vector3::x(), momentum, Vector3::y()];
        let setup = free_star::<V>(momentum);
        let unit = setup.scale.time;
        let mut coefficient = Columns::<V>::from_fn(|i, j| vectors[j][i]);
        let mut series = vec![coefficient];
        for k in 1..=30 {
            for (column, mut vector) in coefficient.column_iter_mut().enumerate() {
                let rate = momentum * (unit / SPHEROID.inertia_xx / f64::from(k));
                let next = if column == MOMENTUM { Vector3::zeros() } else { rate.cross(&vector) };
                vector.copy_from(&next);
            }
            series.push(coefficient);
        }
        (TaylorErrors::of(&setup, None), series)
    }

    fn end<const V: usize>(series: &[Columns<V>], h: f64) -> Columns<V> {
        series.iter().rev().fold(Columns::zeros(), |sum, term| sum * h + term)
    }

    /// Each coefficient has an excess because of the excess of the factors of all previous ones, here of the first two: `h c_1 e_1 + h^2 c_2 e_2`.
    #[test]
    fn rounded_factors_add_to_the_coefficients() {
        let (mut errors, series) = rotating::<3>(Vector3::new(0.3, -0.5, 1.2));
        errors.excess = [Columns::zeros(); SHARES];
        let h = 1e-3;
        let exact = end(&series, h);
        let none = errors.truncation(&series, h, &exact);
        assert!(none.rotation.norm() < 1e-15, "{none:?}");
        errors.excess[0] = Columns::from_fn(|i, j| 1e-9 * (1.0 + i as f64 - 0.7 * j as f64));
        errors.excess[1] = Columns::from_fn(|i, j| 1e-6 * (0.4 - i as f64 + 0.3 * j as f64));
        let found = errors.truncation(&series, h, &exact);
        let small = (series[1].component_mul(&errors.excess[0]) + series[2].component_mul(&errors.excess[1]) * h) * h;
        let expected = difference(&exact, &small, errors.unit / SPHEROID.inertia_xx);
        // The node is a thirty-second of the step before its end.
        assert_relative_eq!(found.rotation, expected.rotation, epsilon = 1e-3 * expected.rotation.norm());
        assert_relative_eq!(found.length, expected.length, max_relative = 1e-2);
        for (found, expected) in found.off_frame.into_iter().zip(expected.off_frame) {
            assert_relative_eq!(found, expected, max_relative = 1e-2);
        }
    }

    /// The rounding of the angle about `n` accumulates over the steps, in addition to the other errors.
    #[test]
    fn the_rounding_of_the_angle_about_the_axis_is_carried() {
        let h = 0.1;
        let of = |rate: f64| {
            let (mut errors, series) = rotating::<3>(Vector3::new(0.3, -0.5, 1.2));
            errors.rate_about_axis = rate;
            let exact = end(&series, h);
            [0, 1].map(|_| errors.step_of_columns(&series, h, &exact).carried)
        };
        let ([once, twice], [with_once, with_twice]) = (of(0.0), of(-1e6));
        assert_relative_eq!(with_once - once, ANGLE_ROUNDING * 1e5, max_relative = 1e-9);
        assert_relative_eq!(with_twice - twice, ANGLE_ROUNDING * 2e5, max_relative = 1e-9);
    }

    /// The rate of `e_x` about `n` is computed from `L.n` at the start: an error of this `L.n` turns `e_x` by more with every step.
    #[test]
    fn the_rate_about_the_axis_has_the_error_of_the_start() {
        fn with_error<const V: usize>(momentum: Vector3<f64>) -> [f64; 2] {
            let (errors, series) = rotating::<V>(momentum);
            let mut growth = ErrorGrowth::none(errors.momentum_unit);
            // The axis is X; per unit of time `unit`.
            let known = Difference { momentum: Vector3::new(1e-6, 0.0, 0.0), length: 4e-7, ..Difference::default() };
            growth.add(&known, [0.0; 2]);
            let earlier = ErrorAtEnd { growth, unit: errors.unit, of_angle: 1e-8, largest: 0.0 };
            let mut errors = TaylorErrors::of(&free_star::<V>(momentum), Some(&earlier));
            let start = errors.of_angle;
            errors.step_of_columns(&series, 0.1, &end(&series, 0.1));
            [start, errors.of_angle - start]
        }
        let momentum = Vector3::new(0.0, 0.0, 1.3);
        let [start, grown] = with_error::<3>(momentum);
        // |1.1 / 1.3 - 1| * 1.3 / 1.1 of three times the error, over 0.1 units of time.
        let expected = 3e-6 * (0.2 / 1.1) * 0.1;
        // At the start `e_x` is turned by half of three times the error of the length of `n`.
        assert_relative_eq!(start, 1e-8 + 6e-7, max_relative = 1e-13);
        assert_relative_eq!(grown, expected, max_relative = 1e-6);
        assert_eq!(with_error::<2>(momentum), [1e-8, 0.0]);
    }

    /// Deviations of half a unit in the last place, and none without an earlier motion: three of the rotation, three of `L`, one of the length of `n`
    /// and two of the frame.
    #[test]
    fn the_end_of_an_earlier_motion_was_rounded() {
        let momentum = Vector3::new(0.3, -0.5, 70.0);
        let alone = rotating::<3>(momentum).0;
        let growth = ErrorGrowth::none(alone.momentum_unit);
        let earlier = ErrorAtEnd { growth, unit: alone.unit, of_angle: 0.0, largest: 0.0 };
        let after = TaylorErrors::of(&free_star::<3>(momentum), Some(&earlier));
        let expected = 3.0 * ErrorGrowth::counted_deviation(0.5 * f64::EPSILON);
        assert!((alone.momentum_unit - 1.0).abs() > 0.1, "{}", alone.momentum_unit);
        assert_relative_eq!(after.before - alone.before - after.of_angle, expected, max_relative = 0.02);
    }

    /// A step of a free star has no truncation error; an error of `e` that has shrunk to less than an eighth leaves deviations of `e^2`, once.
    #[test]
    fn the_square_of_an_error_that_shrank_is_added() {
        let momentum = Vector3::new(0.0, 0.0, 1.3);
        let (mut errors, series) = rotating::<2>(momentum);
        let (h, largest) = (0.5 / series[1].column(AXIS).norm(), 1e-3);
        errors.before = 1.01 * largest / SHRUNK;
        errors.largest = largest;
        let before = errors.growth.clone().estimate(None);
        errors.step_of_columns(&series, h, &end(&series, h));
        assert!(errors.before < before + 1e-13 && errors.largest == largest, "{:e}", errors.before);
        errors.before = 0.99 * largest / SHRUNK;
        errors.step_of_columns(&series, h, &end(&series, h));
        assert_eq!(errors.largest, 0.99 * largest / SHRUNK);
        let after = errors.before;
        errors.step_of_columns(&series, h, &end(&series, h));
        assert!(errors.before < 2.0 * after, "{:e} {after:e}", errors.before);
        // Deviations of the rotation except for that about n, of the length and of the momentum: six components.
        let expected = ErrorGrowth::counted_deviation(largest * largest) * 6.0_f64.sqrt();
        assert_relative_eq!(after - before, expected, max_relative = 0.05);
    }

    /// Rounding applies to the change of `n`, with both of its first terms taken without their signs: at a right angle to `L` and by half a radian
    /// these are `x` and `x^2 / 2`.
    #[test]
    fn the_change_of_the_axis_is_rounded() {
        let (mut errors, series) = rotating::<2>(Vector3::new(0.0, 0.0, 1.3));
        let h = 0.5 / series[1].column(AXIS).norm();
        let found = errors.step_of_columns(&series, h, &end(&series, h)).rounded;
        let changed = 0.5_f64.hypot(0.125);
        let expected = ErrorGrowth::counted_deviation(ROUNDING * f64::EPSILON * changed);
        assert_relative_eq!(found, expected, epsilon = 0.0, max_relative = 1e-12);
    }
}
