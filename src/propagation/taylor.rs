//! Numerical motion by Taylor series with adaptive steps and dense output.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::compensated::{Compensated, CompensatedState};
use crate::propagation::error_growth::ErrorGrowth;
use crate::propagation::input::check_input;
use crate::propagation::series::{AXIS, EQUATORIAL_AXIS, MOMENTUM, Recurrence, Vectors, change};
use crate::propagation::step_size::{Control, Scale, step_size};
use crate::propagation::{AxisMotion, AxisState, Motion};
use crate::scalar::Real;

/// Smallest and largest accuracy that [`propagate`] takes.
pub const ACCURACY_RANGE: (f64, f64) = (1e-16, 1e-2);

/// Most steps that one motion may keep: each holds about 2 kB of coefficients for `f64`.
pub const STEP_LIMIT: usize = 500_000;

/// The numerical motion of a spheroid from `initial` at `span.0` to `span.1` (forwards or backwards).
///
/// `s` is the tensor `s^IJ` in the inertial frame of `initial`, which may be any. `accuracy` is the truncation error wanted
/// in the components of `n`, `e_x` and of `L` in units of `|L| + sqrt(2 I^xx C |s|)` at the end of the span, in
/// [`ACCURACY_RANGE`]; rounding adds about `2e-16 sqrt(steps)` and its growth, see [`AxisMotion::error_estimate`]. A
/// truncation below rounding costs little: the order of the series rises by one for each factor of seven.
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
    let start = Vectors::from_columns(&[initial.axis, initial.momentum, initial.equatorial_axis]);
    TaylorMotion::from_start(spheroid, s, start, span, accuracy)
}

/// The numerical motion of the symmetry axis and the angular momentum alone: [`propagate`] without `e_x`, which neither
/// follows nor influences them here. For the spin axis and the gravitational wave; a third of the work is saved.
///
/// # Errors
/// As for [`propagate`].
pub fn propagate_axis<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    initial: &AxisState<S>,
    span: (f64, f64),
    accuracy: f64,
) -> Result<TaylorAxisMotion<S>, Error> {
    TaylorMotion::from_start(spheroid, s, Vectors::from_columns(&[initial.axis, initial.momentum]), span, accuracy)
}

/// What [`propagate`] will do, from its first step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorForecast {
    /// Order of the series.
    pub order: usize,
    /// Steps, if all are as long as the first; at least one.
    pub steps: f64,
    /// Upper bound of the rate at which directions turn, with which errors grow.
    pub turning_rate: f64,
}

/// What [`propagate`], or without `e_x` [`propagate_axis`], will do over a `duration`: the work of one step tells it.
///
/// # Errors
/// As for [`propagate`], but for the number of steps.
pub fn taylor_forecast<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    initial: &BodyState<S>,
    with_equatorial_axis: bool,
    duration: f64,
    accuracy: f64,
) -> Result<TaylorForecast, Error> {
    let [n, l, e_x] = [initial.axis, initial.momentum, initial.equatorial_axis];
    if with_equatorial_axis {
        forecast::<S, 3>(spheroid, s, &Vectors::from_columns(&[n, l, e_x]), duration, accuracy)
    } else {
        forecast::<S, 2>(spheroid, s, &Vectors::from_columns(&[n, l]), duration, accuracy)
    }
}

fn forecast<S: Real, const V: usize>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    start: &Vectors<S, V>,
    duration: f64,
    accuracy: f64,
) -> Result<TaylorForecast, Error> {
    check_input(spheroid, s, start, (0.0, duration), accuracy)?;
    let anisotropic = without_trace(s);
    let Control { scale, budget, order } =
        Control::of(spheroid, &anisotropic, &start.column(MOMENTUM).into(), duration.abs(), accuracy)?;
    let mut series = Vec::with_capacity(order + 1);
    Recurrence::new(spheroid, &anisotropic, order, scale.time).append(start, &mut series);
    let steps = (duration.abs() / step_size(&series, &scale, budget)).ceil().max(1.0);
    Ok(TaylorForecast { order, steps, turning_rate: scale.turning_rate })
}

/// An isotropic part of s^IJ exerts no torque; left in, its rounding would.
fn without_trace<S: Real>(s: &Matrix3<S>) -> Matrix3<S> {
    s - Matrix3::from_diagonal_element(s.trace() / 3.0)
}

/// A motion kept as Taylor series on adjoining steps, of the `V` vectors `n`, `L` and, with `V = 3`, `e_x`.
#[derive(Debug, Clone)]
pub struct TaylorMotion<S, const V: usize = 3> {
    spheroid: RigidSpheroid<S>,
    violation: Matrix3<S>,
    span: (f64, f64),
    scale: Scale,
    order: usize,
    /// Start of each step: time since the start of the motion, positive in either direction.
    starts: Vec<Compensated>,
    /// Errors made up to the end of each step.
    errors: Vec<ErrorGrowth>,
    /// `order + 1` coefficients for each step.
    coefficients: Vec<Vectors<S, V>>,
}

/// The motion of the symmetry axis and the angular momentum, kept as Taylor series.
pub type TaylorAxisMotion<S> = TaylorMotion<S, 2>;

impl<S: Real, const V: usize> TaylorMotion<S, V> {
    fn from_start(
        spheroid: &RigidSpheroid<S>,
        s: &Matrix3<S>,
        start: Vectors<S, V>,
        span: (f64, f64),
        accuracy: f64,
    ) -> Result<Self, Error> {
        check_input(spheroid, s, &start, span, accuracy)?;
        let duration = (span.1 - span.0).abs();
        let anisotropic = without_trace(s);
        let Control { scale, budget, order } =
            Control::of(spheroid, &anisotropic, &start.column(MOMENTUM).into(), duration, accuracy)?;
        let (spheroid, violation) = (*spheroid, *s);
        let (starts, errors, coefficients) = (Vec::new(), Vec::new(), Vec::new());
        let mut motion = Self { spheroid, violation, span, scale, order, starts, errors, coefficients };
        let mut recurrence = Recurrence::new(&spheroid, &anisotropic, order, scale.time);
        let mut elapsed = Compensated::new(0.0);
        let mut state = CompensatedState::new(&start);
        let mut error = ErrorGrowth::of_rounded_start();
        loop {
            check_length(motion.step_count(), elapsed.high, duration)?;
            recurrence.append(&state.high, &mut motion.coefficients);
            let series = motion.series(motion.step_count());
            let step = step_size(series, &scale, budget);
            Error::unless(
                step > 0.0,
                "step of the motion",
                step,
                "above zero: in these units the motion is out of range",
            )?;
            let remaining = (duration - elapsed.high) - elapsed.low;
            let last = step >= remaining;
            let step = if last { remaining } else { step };
            error.add(elapsed.high, budget * step);
            if !last {
                state.add(&change(series, motion.in_series_units(S::from_f64(step * motion.direction()))));
            }
            motion.starts.push(elapsed);
            motion.errors.push(error);
            if last {
                return Ok(motion);
            }
            elapsed.add(step);
        }
    }

    /// Number of steps.
    pub fn step_count(&self) -> usize {
        self.starts.len()
    }

    /// Order of the series.
    pub fn order(&self) -> usize {
        self.order
    }

    /// `1` forwards in time, `-1` backwards.
    fn direction(&self) -> f64 {
        if self.span.1 >= self.span.0 { 1.0 } else { -1.0 }
    }

    /// The coefficients of one step.
    fn series(&self, step: usize) -> &[Vectors<S, V>] {
        &self.coefficients[step * (self.order + 1)..][..self.order + 1]
    }

    /// A time in units of the series, a power of two.
    fn in_series_units(&self, h: S) -> S {
        h * (1.0 / self.scale.time)
    }

    /// Index of the step that holds the time `t`, and the time since the start.
    fn step_at(&self, t: f64) -> Result<(usize, f64), Error> {
        let (first, last) = self.span;
        Error::unless(
            first.min(last) <= t && t <= first.max(last),
            "time t",
            t,
            "within the span for which the motion was propagated",
        )?;
        let elapsed = (t - first).abs();
        Ok((self.starts.partition_point(|start| start.high <= elapsed).max(1) - 1, elapsed))
    }

    /// The vectors at time `t`.
    fn at(&self, t: S) -> Result<Vectors<S, V>, Error> {
        let (index, _) = self.step_at(t.re())?;
        let (start, series) = (&self.starts[index], self.series(index));
        let offset = t - S::from_f64(self.span.0) - S::from_f64(start.high * self.direction());
        let h = self.in_series_units(offset - S::from_f64(start.low * self.direction()));
        Ok(series[0] + change(series, h))
    }
}

impl<S: Real, const V: usize> AxisMotion<S> for TaylorMotion<S, V> {
    fn spheroid(&self) -> &RigidSpheroid<S> {
        &self.spheroid
    }

    fn violation(&self) -> &Matrix3<S> {
        &self.violation
    }

    fn span(&self) -> (f64, f64) {
        self.span
    }

    fn axis_state(&self, t: S) -> Result<AxisState<S>, Error> {
        let vectors = self.at(t)?;
        Ok(AxisState { axis: vectors.column(AXIS).into(), momentum: vectors.column(MOMENTUM).into() })
    }

    /// Truncation and rounding of each step so far, each grown linearly with the phase it shifts. It does not foresee
    /// exponential growth near the unstable middle axis.
    fn error_estimate(&self, t: f64) -> f64 {
        match self.step_at(t) {
            Ok((index, elapsed)) => self.errors[index].at(elapsed, self.scale.turning_rate),
            Err(_) => f64::NAN,
        }
    }
}

impl<S: Real> Motion<S> for TaylorMotion<S> {
    fn state(&self, t: S) -> Result<BodyState<S>, Error> {
        let vectors = self.at(t)?;
        let [axis, momentum, equatorial_axis] =
            [AXIS, MOMENTUM, EQUATORIAL_AXIS].map(|column| vectors.column(column).into());
        Ok(BodyState { axis, momentum, equatorial_axis })
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
