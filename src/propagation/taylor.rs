//! Numerical motion by Taylor series with adaptive steps and dense output.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::Motion;
use crate::propagation::compensated::{Compensated, CompensatedState};
use crate::propagation::error_growth::ErrorGrowth;
use crate::propagation::input::check_input;
use crate::propagation::series::Series;
use crate::propagation::step_size::{Scale, order_for, step_size};
use crate::scalar::Real;

/// Smallest and largest accuracy that [`propagate`] takes.
pub const ACCURACY_RANGE: (f64, f64) = (1e-16, 1e-2);

/// Most steps that one motion may keep: each holds about 2 kB of coefficients for `f64`.
pub const STEP_LIMIT: usize = 500_000;

/// The numerical motion of a spheroid from `initial` at `span.0` to `span.1` (forwards or backwards).
///
/// `s` is the tensor `s^IJ` in the inertial frame of `initial`, which may be any. `accuracy` is the truncation error wanted
/// in the components of `n`, `e_x` and of `L` in units of `|L| + sqrt(2 I^xx C |s|)` at the end of the span, in
/// [`ACCURACY_RANGE`]; rounding adds about `2e-16 sqrt(steps)` and its growth, see [`Motion::error_estimate`]. A truncation below rounding costs little: the order
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
