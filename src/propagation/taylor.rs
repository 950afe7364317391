//! Numerical motion by Taylor series with adaptive steps and dense output.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::Motion;
use crate::propagation::series::Series;
use crate::rounding::two_sum;
use crate::scalar::{Real, Scalar, real_part};

/// Smallest and largest accuracy that [`propagate`] takes.
pub const ACCURACY_RANGE: (f64, f64) = (1e-16, 1e-2);

/// Most steps that one motion may keep: each holds about 2 kB of coefficients for `f64`.
pub const STEP_LIMIT: usize = 500_000;

/// The numerical motion of a spheroid from `initial` at `span.0` to `span.1` (forwards or backwards).
///
/// `s` is the tensor `s^IJ` in the inertial frame of `initial`, which may be any. `accuracy` is the truncation error wanted
/// in the components of `n`, `e_x` and `L / |L|` at the end of the span, in [`ACCURACY_RANGE`]; rounding adds about
/// `2e-16 sqrt(steps)` and its growth, see [`Motion::error_estimate`]. A truncation below rounding costs little: the order
/// of the series rises by one for each factor of seven.
///
/// Step sizes and order follow from the real parts alone, so that derivatives (duals) are those of the motion and not of
/// the choice of steps.
///
/// # Errors
/// [`Error::Domain`] for an accuracy out of range, a state, parameter or span that is not finite, an axis that is not a unit
/// vector or not normal to `e_x` (to 1e-9), moments of inertia that are not positive, and a span that needs more than
/// [`STEP_LIMIT`] steps.
pub fn propagate<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    initial: &BodyState<S>,
    span: (f64, f64),
    accuracy: f64,
) -> Result<TaylorMotion<S>, Error> {
    check_input(spheroid, s, initial, span, accuracy)?;
    let duration = (span.1 - span.0).abs();
    // An isotropic part of s^IJ exerts no torque; left in, its rounding would.
    let anisotropic = s - Matrix3::from_diagonal_element(s.trace() / 3.0);
    let scale = Scale::of(spheroid, &anisotropic, initial);
    Error::unless(
        scale.turning_rate.is_finite(),
        "rate at which the body turns",
        scale.turning_rate,
        "within the range of doubles with the squares of L and s^IJ: choose other units",
    )?;
    // An error made at one time turns into a phase error that grows with the rotation: the budget per unit of time is
    // what is left of the accuracy after that growth over half of the span on average.
    let growth = 1.0 + scale.turning_rate * duration / 2.0;
    let budget = if duration > 0.0 { (accuracy / (duration * growth)).min(f64::MAX) } else { accuracy };
    let order = order_for(budget / scale.turning_rate.max(f64::MIN_POSITIVE));
    let direction = if span.1 >= span.0 { 1.0 } else { -1.0 };

    let mut motion = TaylorMotion { spheroid: *spheroid, violation: *s, span, steps: Vec::new(), scale };
    let mut elapsed = Compensated::new(0.0);
    let mut state = CompensatedState::new(initial);
    let mut error = ErrorGrowth::of_rounded_start();
    loop {
        check_length(motion.steps.len(), elapsed.high, duration)?;
        let series = Series::about(spheroid, &anisotropic, &state.high, order, motion.scale.time);
        let step = step_size(&series, &motion.scale, budget);
        Error::unless(step > 0.0, "step of the motion", step, "above zero: in these units the motion is out of range")?;
        let remaining = (duration - elapsed.high) - elapsed.low;
        let last = step >= remaining;
        let step = if last { remaining } else { step };
        error.add(elapsed.high, budget * step);
        let change = series.change(S::from_f64(step * direction));
        motion.steps.push(Step { start: elapsed, series, error });
        if last {
            return Ok(motion);
        }
        state.add(&change);
        elapsed.add(step);
    }
}

/// A motion kept as Taylor series on adjoining steps.
#[derive(Debug, Clone)]
pub struct TaylorMotion<S> {
    spheroid: RigidSpheroid<S>,
    violation: Matrix3<S>,
    span: (f64, f64),
    steps: Vec<Step<S>>,
    scale: Scale,
}

#[derive(Debug, Clone)]
struct Step<S> {
    /// Time since the start of the motion, positive in either direction.
    start: Compensated,
    series: Series<S>,
    /// Errors made up to the end of this step.
    error: ErrorGrowth,
}

impl<S: Real> TaylorMotion<S> {
    /// Number of steps.
    pub fn step_count(&self) -> usize {
        self.steps.len()
    }

    /// Order of the series.
    pub fn order(&self) -> usize {
        self.steps[0].series.coefficients.len() - 1
    }

    fn step_at(&self, t: f64) -> Result<(&Step<S>, f64), Error> {
        let (first, last) = self.span;
        Error::unless(
            first.min(last) <= t && t <= first.max(last),
            "time t",
            t,
            "within the span for which the motion was propagated",
        )?;
        let elapsed = (t - first).abs();
        let index = self.steps.partition_point(|step| step.start.high <= elapsed).max(1) - 1;
        Ok((&self.steps[index], elapsed))
    }
}

impl<S: Real> Motion<S> for TaylorMotion<S> {
    fn spheroid(&self) -> &RigidSpheroid<S> {
        &self.spheroid
    }

    fn violation(&self) -> &Matrix3<S> {
        &self.violation
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn state(&self, t: S) -> Result<BodyState<S>, Error> {
        let (step, _) = self.step_at(t.re())?;
        let direction = if self.span.1 >= self.span.0 { 1.0 } else { -1.0 };
        let offset = t - S::from_f64(self.span.0) - S::from_f64(step.start.high * direction);
        let change = step.series.change(offset - S::from_f64(step.start.low * direction));
        let start = &step.series.coefficients[0];
        Ok(BodyState {
            axis: start.axis + change.axis,
            momentum: start.momentum + change.momentum,
            equatorial_axis: start.equatorial_axis + change.equatorial_axis,
        })
    }

    /// Truncation and rounding of each step so far, each grown linearly with the phase it shifts. It does not foresee
    /// exponential growth near the unstable middle axis.
    fn error_estimate(&self, t: f64) -> f64 {
        match self.step_at(t) {
            Ok((step, elapsed)) => step.error.at(elapsed, self.scale.turning_rate),
            Err(_) => f64::NAN,
        }
    }
}

/// Sizes by which errors are measured.
#[derive(Debug, Clone, Copy)]
struct Scale {
    /// Size of the angular momentum, or what the torque makes of it within its own time.
    momentum: f64,
    /// Upper bound of the rate at which directions turn.
    turning_rate: f64,
    /// A power of two near the inverse of that rate.
    time: f64,
}

impl Scale {
    fn of<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, state: &BodyState<S>) -> Self {
        let inertia = spheroid.inertia_xx.re();
        let pull = spheroid.constant_c.re().abs() * s.map(S::re).norm();
        // Two roots, since the product may be out of range where they are not.
        let momentum = real_part(&state.momentum).norm() + (2.0 * inertia).sqrt() * pull.sqrt();
        let body_turn = (1.0 - spheroid.inertia_xx.re() / spheroid.inertia_zz.re()).abs();
        let turning_rate = momentum / inertia * (1.0 + body_turn);
        let time = if turning_rate > 0.0 { 2f64.powi(-turning_rate.log2().clamp(-1000.0, 1000.0) as i32) } else { 1.0 };
        // A body at rest without torque stays so: any unit of momentum does.
        Self { momentum: if momentum > 0.0 { momentum } else { inertia }, turning_rate, time }
    }

    /// Largest component of a coefficient, `L` in units of the momentum.
    fn size<S: Real>(&self, c: &BodyState<S>) -> f64 {
        let largest = |v: &Vector3<S>| real_part(v).amax();
        largest(&c.axis).max(largest(&c.equatorial_axis)).max(largest(&c.momentum) / self.momentum)
    }
}

/// Order of the series for a relative truncation `budget` per radian: the work per unit of time is least near
/// `-ln(budget) / 2` (Jorba and Zou 2005).
fn order_for(budget: f64) -> usize {
    (-budget.ln() / 2.0).ceil().clamp(6.0, 32.0) as usize
}

/// Step with truncation error at most `budget` per unit of time, from the last two coefficients (two, since one may vanish
/// by symmetry); zero where the coefficients are out of range.
fn step_size<S: Real>(series: &Series<S>, scale: &Scale, budget: f64) -> f64 {
    let order = series.coefficients.len() - 1;
    let bound = |k: usize| {
        let size = scale.size(&series.coefficients[k]);
        match size {
            0.0 => f64::INFINITY,
            size if size.is_finite() => (budget * scale.time / size).powf(1.0 / (k as f64 - 1.0)) * scale.time,
            _ => 0.0,
        }
    };
    // The first omitted term is about the last kept one times (step / radius of convergence), and that ratio is below
    // one fifth: so the last kept term bounds the whole remainder.
    bound(order).min(bound(order - 1))
}

/// Sums over the steps, at times `t_k`, from which the grown truncation `sum_k e_k u_k` and the grown rounding
/// `2e-16 sqrt(sum_k u_k^2)` follow, with `u_k = 1 + rate (t - t_k)`: rounding errors are independent, truncation errors not.
#[derive(Debug, Clone, Copy)]
struct ErrorGrowth {
    truncation: f64,
    truncation_times: f64,
    steps: f64,
    times: f64,
    times_squared: f64,
}

impl ErrorGrowth {
    /// The initial state comes out of a few rounded operations, about two ulp of one.
    fn of_rounded_start() -> Self {
        Self { truncation: 0.0, truncation_times: 0.0, steps: 4.0, times: 0.0, times_squared: 0.0 }
    }

    fn add(&mut self, time: f64, truncation: f64) {
        self.truncation += truncation;
        self.truncation_times += truncation * time;
        self.steps += 1.0;
        self.times += time;
        self.times_squared += time * time;
    }

    fn at(&self, time: f64, rate: f64) -> f64 {
        let now = 1.0 + rate * time;
        let truncation = self.truncation * now - rate * self.truncation_times;
        let squares = self.steps * now * now - 2.0 * rate * now * self.times + rate * rate * self.times_squared;
        truncation + f64::EPSILON * squares.max(1.0).sqrt()
    }
}

/// A time as an unevaluated sum, so that many small steps do not add up their rounding.
#[derive(Debug, Clone, Copy)]
struct Compensated {
    high: f64,
    low: f64,
}

impl Compensated {
    fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    fn add(&mut self, step: f64) {
        let (high, low) = two_sum(self.high, step + self.low);
        (self.high, self.low) = (high, low);
    }
}

/// A state whose additions are compensated: `high` is the state, `low` what its last addition lost.
struct CompensatedState<S> {
    high: BodyState<S>,
    low: BodyState<S>,
}

impl<S: Scalar> CompensatedState<S> {
    fn new(state: &BodyState<S>) -> Self {
        let zero = Vector3::zeros();
        Self { high: *state, low: BodyState { axis: zero, momentum: zero, equatorial_axis: zero } }
    }

    fn add(&mut self, change: &BodyState<S>) {
        let add = |high: &mut Vector3<S>, low: &mut Vector3<S>, change: &Vector3<S>| {
            for i in 0..3 {
                (high[i], low[i]) = two_sum(high[i], change[i] + low[i]);
            }
        };
        add(&mut self.high.axis, &mut self.low.axis, &change.axis);
        add(&mut self.high.momentum, &mut self.low.momentum, &change.momentum);
        add(&mut self.high.equatorial_axis, &mut self.low.equatorial_axis, &change.equatorial_axis);
    }
}

/// Refuses a motion that has too many steps, or that has shown within its first steps that it will have.
fn check_length(steps: usize, elapsed: f64, duration: f64) -> Result<(), Error> {
    let foreseen = steps as f64 * duration / elapsed.max(f64::MIN_POSITIVE);
    let hopeless = steps >= 256 && foreseen > 2.0 * STEP_LIMIT as f64;
    Error::unless(
        steps < STEP_LIMIT && !hopeless,
        "length of the motion in its own steps",
        foreseen,
        "at most 500,000 steps: take a shorter span (and go on from its end) or a lower accuracy",
    )
}

fn check_input<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &BodyState<S>,
    span: (f64, f64),
    accuracy: f64,
) -> Result<(), Error> {
    let (least, most) = ACCURACY_RANGE;
    Error::unless(least <= accuracy && accuracy <= most, "accuracy", accuracy, "between 1e-16 and 1e-2")?;
    for time in [span.0, span.1] {
        Error::unless(time.is_finite(), "end of the time span", time, "a finite number")?;
    }
    for inertia in [spheroid.inertia_xx.re(), spheroid.inertia_zz.re()] {
        Error::unless(inertia > 0.0 && inertia.is_finite(), "moment of inertia", inertia, "above zero and finite")?;
    }
    let c = spheroid.constant_c.re();
    Error::unless(c.is_finite(), "constant C of the anisotropic self-energy", c, "a finite number")?;
    for entry in s.iter() {
        Error::unless(entry.re().is_finite(), "entry of s^IJ", entry.re(), "a finite number")?;
    }
    for component in state.momentum.iter() {
        Error::unless(component.re().is_finite(), "component of L", component.re(), "a finite number")?;
    }
    let (axis, equatorial) = (real_part(&state.axis), real_part(&state.equatorial_axis));
    for (length, name) in [(axis.norm(), "length of the axis n"), (equatorial.norm(), "length of the axis e_x")] {
        Error::unless((length - 1.0).abs() < 1e-9, name, length, "one, to 1e-9")?;
    }
    let overlap = axis.dot(&equatorial);
    Error::unless(overlap.abs() < 1e-9, "n . e_x", overlap, "zero, to 1e-9")
}
