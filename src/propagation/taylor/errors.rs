//! The error of a motion by Taylor series: what each step leaves out and rounds, carried to the end of every step.

use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::dynamics::regular_equations::reduced_rates;
use crate::propagation::taylor::error_growth::{Difference, ErrorGrowth};
use crate::propagation::taylor::linearised_flow::LinearisedFlow;
use crate::propagation::taylor::series::{AXIS, COMPANION, MOMENTUM};
use crate::propagation::taylor::setup::Setup;
use crate::scalar::Real;

/// The vectors of a series in real numbers, by columns.
type Columns<const V: usize> = SMatrix<f64, 3, V>;

/// Standard deviation of what rounding makes of a change of the state, in units in the last place of the change.
const ROUNDING: f64 = 0.5;

/// Rounding of the constant rate at which `e_x` turns about `n`, from a sum of products that may cancel: a phase, in units in
/// the last place of one per radian.
const RATE_ROUNDING: f64 = 1.0;

/// Standard deviation of what turning the start into the principal frame of `s` rounds, in units in the last place of one.
const TURNED: f64 = 1.0;

/// Part of the truncation of a step that its leading term misses.
const UNCERTAIN: f64 = 0.04;

/// Rounding of the constants (`1 / I^xx`, the oblateness, the body's turn) that all steps have in common: a phase, in units
/// in the last place of one per radian.
const COMMON_ROUNDING: f64 = 0.5;

/// The estimated error within one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepError {
    /// Of what was made before it, the larger of both ends.
    carried: f64,
    /// Of what the step makes by its end.
    local: f64,
}

impl StepError {
    /// The error after the given fraction of the step, by a series of the given order.
    pub(super) fn at(&self, fraction: f64, order: usize) -> f64 {
        self.carried + self.local * fraction.powi(order as i32 + 1)
    }
}

/// Goes through the steps of a motion in their order.
pub(super) struct TaylorErrors<const V: usize> {
    spheroid: RigidSpheroid<f64>,
    violation: Matrix3<f64>,
    flow: LinearisedFlow,
    growth: ErrorGrowth,
    /// Unit of time of the series.
    unit: f64,
    /// `L / I^xx` of the momentum's unit, in the unit of time.
    momentum_unit: f64,
    before: f64,
    /// Of `e_x` about `n`, in the unit of time of the series; zero where only the axis is followed.
    rate_about_axis: f64,
    /// The step at work.
    series: Vec<Columns<V>>,
}

impl<const V: usize> TaylorErrors<V> {
    /// At the start of a motion.
    pub(super) fn of<S: Real>(setup: &Setup<S, V>) -> Self {
        let (scale, spheroid) = (&setup.scale, setup.spheroid.map(S::re));
        let violation = setup.frame.violation.map(S::re);
        let unit = scale.time;
        let momentum_unit = scale.momentum / spheroid.inertia_xx * unit;
        let flow = LinearisedFlow::new(&spheroid, &violation, unit);
        let mut growth = ErrorGrowth::none(momentum_unit);
        if setup.frame.is_turned() {
            // The start is rounded when it is turned, and so are the principal axes.
            let deviations = [1.0, momentum_unit].map(|unit| TURNED * f64::EPSILON * unit);
            growth.add(&Difference::default(), deviations, 2.0 * TURNED * f64::EPSILON);
        }
        let before = growth.estimate(None);
        let series = Vec::with_capacity(setup.order + 1);
        let rate_about_axis = if V > COMPANION { setup.rate_about_axis.re() * unit } else { 0.0 };
        Self { spheroid, violation, flow, growth, unit, momentum_unit, before, rate_about_axis, series }
    }

    /// The next step, of signed length `h` in units of its series. `vector` makes the vectors of the coefficients real.
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
        let carried = self.growth.estimate(only_axis).max(self.before);

        let (known, off_frame) = self.truncation(series, h, end);
        let size = known.size(self.momentum_unit) + off_frame;
        // What is rounded is the changes without the cancellation between their first two terms or within a cross product.
        let changes = (series[1].abs() + series[2].abs() * h.abs()) * h.abs();
        let turned = (0..V).filter(|column| *column != MOMENTUM).map(|column| changes.column(column).norm());
        let turned = turned.fold(start.1.norm() * h.abs(), f64::max).min(1.0);
        let kicked = (self.flow.strength() * h.abs()).max(changes.column(MOMENTUM).norm() * rate);
        // Of the momentum too, by the size of the whole: its own defect is small where it averages out, and then less certain.
        let deviations = [(turned, 1.0), (kicked.min(self.momentum_unit), self.momentum_unit)]
            .map(|(change, unit)| ROUNDING * f64::EPSILON * change + UNCERTAIN * size * unit);
        let common = COMMON_ROUNDING * f64::EPSILON * (series[0].column(MOMENTUM).norm() * rate * h).abs()
            + RATE_ROUNDING * f64::EPSILON * (self.rate_about_axis * h).abs();
        self.growth.add(&known, deviations, off_frame + common);
        self.before = self.growth.estimate(only_axis);
        StepError { carried, local: ErrorGrowth::counted(size) }
    }

    /// What the step leaves out: the difference that it makes of the motion, and what it makes of the length of the vector
    /// carried along and its angle to `n`, which do not influence anything.
    ///
    /// It is `integral of d(tau) dtau` with the defect `d = x' - f(x)` of the series, which grows as `tau^order`: the
    /// Gauss-Jacobi rule of one node for that weight.
    fn truncation(&self, series: &[Columns<V>], h: f64, end: &Columns<V>) -> (Difference, f64) {
        let order = series.len() - 1;
        let node = (order + 1) as f64 / (order + 2) as f64;
        let (mut value, mut slope) = (series[order], Columns::<V>::zeros());
        for term in series[..order].iter().rev() {
            slope = slope * (h * node) + value;
            value = value * (h * node) + term;
        }
        let weight = h / ((order + 1) as f64 * node.powi(order as i32));
        let error = (slope - self.rates(&value)) * weight;
        let vector = |of: &Columns<V>, column: usize| -> Vector3<f64> { of.column(column).into() };
        let (n, of_axis) = (vector(end, AXIS), vector(&error, AXIS));
        let momentum = vector(&error, MOMENTUM) * (self.unit / self.spheroid.inertia_xx);
        let mut known = Difference { rotation: n.cross(&of_axis), momentum, length: n.dot(&of_axis) };
        let mut off_frame = 0.0;
        if V > COMPANION {
            let (x, of_x) = (vector(end, COMPANION), vector(&error, COMPANION));
            known.rotation += n * n.cross(&x).dot(&of_x);
            off_frame = of_x.dot(&x).abs() + (of_x.dot(&n) + of_axis.dot(&x)).abs();
        }
        (known, off_frame)
    }

    /// Right-hand sides of the equations of motion in the unit of time of the series.
    fn rates(&self, state: &Columns<V>) -> Columns<V> {
        let (n, momentum): (Vector3<f64>, Vector3<f64>) = (state.column(AXIS).into(), state.column(MOMENTUM).into());
        let (axis_rate, momentum_rate) = reduced_rates(&self.spheroid, &self.violation, &n, &momentum);
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
