//! The input of a motion, converted to the units and the frame of its series.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::traceless;
use crate::numerics::arithmetic::{LoadStore, Padded};
use crate::numerics::compensated::Compensated;
use crate::numerics::rounding::two_sum;
use crate::numerics::scalar::Real;
use crate::propagation::input::{check_request, check_time};
use crate::propagation::taylor::frame::SeriesFrame;
use crate::propagation::taylor::series::{AXIS, MOMENTUM, Vectors, change};
use crate::propagation::taylor::step_size::{Scale, Work, longest_step, order_for};
use crate::propagation::taylor::stepper::Stepper;
use crate::propagation::third_angle::body_state;

/// Body, tensor, start and span of a motion, with the order and the error allowed per unit of time.
#[derive(Debug, Clone)]
pub(super) struct ScaledProblem<S, const V: usize> {
    pub(super) spheroid: RigidSpheroid<S>,
    pub(super) tensor: Matrix3<S>,
    pub(super) span: (f64, f64),
    pub(super) scale: Scale,
    pub(super) order: usize,
    budget: f64,
    longest_step: f64,
    pub(super) frame: SeriesFrame<S>,
    pub(super) given_start: [Vector3<S>; V],
    /// The initial vectors in the frame of the series.
    pub(super) start: Vectors<Padded<S>, V>,
    /// Rate at which `e_x` rotates about `n` relative to the vector carried along.
    pub(super) rate_about_axis: S,
}

impl<S: Real, const V: usize> ScaledProblem<S, V> {
    /// `principal_frame` selects whether the series is computed in the principal frame of `s`.
    pub(super) fn new<X: RotationState<S>>(
        (principal_frame, work): (bool, Work),
        problem: &Problem<S, X>,
        span: (f64, f64),
        tolerance: f64,
    ) -> Result<Self, Error> {
        check_request(span, tolerance)?;
        problem.require_rigid()?;
        let (spheroid, s, start) = (problem.spheroid(), problem.coefficients(), problem.start::<V>());
        let duration = (span.1 - span.0).abs();
        // An isotropic part of s^IJ exerts no torque, but if it were left in, its rounding would.
        let anisotropic = traceless(s);
        let scale = Scale::of(spheroid, &anisotropic, &start[MOMENTUM]);
        Error::ensure(
            scale.turning_rate.is_finite(),
            "rate at which the body turns",
            scale.turning_rate,
            "within the range of doubles, and so must the squares of L and s^IJ; choose other units",
        )?;
        // An error made at one time turns into a phase error that grows with the rotation. The error budget per unit of time
        // is the tolerance divided by that growth, averaged over the span.
        let growth = 1.0 + scale.turning_rate * duration / 2.0;
        let budget = if duration > 0.0 { (tolerance / (duration * growth)).min(f64::MAX) } else { tolerance };
        let order = order_for(budget / scale.turning_rate.max(f64::MIN_POSITIVE), work);
        // If real parts alone choose the steps, derivatives have more and faster terms than the real parts show: near free
        // rotation the derivative with respect to `s` has terms of twice the frequency.
        let longest_step = if principal_frame { longest_step(order, &scale, budget) } else { 1.0 / scale.turning_rate };
        let frame = SeriesFrame::of(&anisotropic, principal_frame)?;
        let rate_about_axis = spheroid.rate_about_axis(&start[AXIS], &start[MOMENTUM]);
        let given_start = start;
        let start = start.map(|v| Padded::from(frame.series_from_given(&v)));
        let (spheroid, tensor) = (*spheroid, *s);
        Ok(Self {
            spheroid,
            tensor,
            span,
            scale,
            order,
            budget,
            longest_step,
            frame,
            given_start,
            start,
            rate_about_axis,
        })
    }

    /// `1` forwards in time, `-1` backwards.
    pub(super) fn direction(&self) -> f64 {
        if self.span.1 >= self.span.0 { 1.0 } else { -1.0 }
    }

    /// Error of the vectors due to rounding of the time `t` since the start.
    pub(super) fn error_of_time(&self, t: f64) -> f64 {
        two_sum(t, -self.span.0).1.abs() * self.scale.turning_rate
    }

    /// Length of the span.
    pub(super) fn duration(&self) -> f64 {
        (self.span.1 - self.span.0).abs()
    }

    /// Time since the start, at a time `t` of the span.
    pub(super) fn elapsed(&self, t: f64) -> Result<f64, Error> {
        check_time(self.span, t)?;
        Ok((t - self.span.0).abs())
    }

    /// The steps of the motion, and its start.
    #[inline(always)]
    pub(super) fn drive(&self) -> Stepper<'_, S, V> {
        Stepper {
            spheroid: &self.spheroid,
            tensor: &self.frame.tensor,
            start: &self.start,
            scale: &self.scale,
            order: self.order,
            duration: self.duration(),
            direction: self.direction(),
            budget: self.budget,
            longest_step: self.longest_step,
        }
    }

    /// Time in units of the series from the start of a step to the time `t`; the step starts at the time `high + low` since
    /// the start of the motion.
    #[inline(always)]
    pub(super) fn series_time(&self, start: &Compensated, t: S) -> S {
        let direction = self.direction();
        let offset = t - S::from_f64(self.span.0) - S::from_f64(start.high * direction);
        (offset - S::from_f64(start.low * direction)) * (1.0 / self.scale.time)
    }

    /// The vectors at the time `t` from the series of a step, in the given frame.
    #[inline(always)]
    pub(super) fn sum<A: LoadStore<Scalar = S>>(
        &self,
        a: A,
        coefficient: impl Fn(usize) -> Vectors<A::Vector, V>,
        start: &Compensated,
        t: S,
    ) -> [Padded<S>; V] {
        let first = coefficient(0);
        let change = change(a, self.order, coefficient, a.splat(self.series_time(start, t)));
        let mut vectors = [Padded::zero(); V];
        for i in 0..V {
            let v = a.add(first[i], change[i]);
            vectors[i] = a.store(self.frame.turned_to_given(a, v));
        }
        vectors
    }
}

impl<S: Real> ScaledProblem<S, 3> {
    /// The state of the body from the vectors of the series at time `t`.
    pub(super) fn body_state(&self, vectors: [Vector3<S>; 3], t: S) -> BodyState<S> {
        body_state(vectors, self.rate_about_axis * (t - S::from_f64(self.span.0)))
    }
}
