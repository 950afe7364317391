//! The component along a fixed direction of a vector fixed in the body, from the series of a motion.

use core::cell::Cell;

use nalgebra::Vector3;

use crate::error::Error;
use crate::propagation::arithmetic::{OneMotion, Stored};
use crate::propagation::fused::{Fused, run_fused};
use crate::propagation::taylor::TaylorMotion;
use crate::propagation::taylor::series::{AXIS, COMPANION, MOMENTUM, change};

/// `m.o` of a vector `m` fixed in the body and a fixed direction `o`, with its time derivatives, at any time of a motion that is
/// kept as Taylor series in doubles. See [`Motion::projection`](crate::propagation::Motion::projection).
///
/// The same numbers as those from the states, to rounding, in less than half the time: `o` is turned into the frame of the series
/// once, instead of every state out of it.
#[derive(Debug, Clone)]
pub struct SeriesProjection<'a> {
    motion: &'a TaylorMotion<f64>,
    fused: Fused,
    /// `o` in the frame of the series.
    direction: Stored<f64>,
    /// `m` in the body.
    in_body: Vector3<f64>,
    /// `1 / I^xx`.
    axis_rate: f64,
    /// `2 C (s^YY - s^ZZ, s^ZZ - s^XX, s^XX - s^YY) / I^xx` in the frame of the series, which is principal.
    pull: Stored<f64>,
    /// The step that was asked for last: the next is often the same or one near by.
    step: Cell<usize>,
}

impl<'a> SeriesProjection<'a> {
    pub(super) fn new(
        motion: &'a TaylorMotion<f64>,
        fused: Fused,
        in_body: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> Self {
        let setup = &motion.setup;
        let rates = setup.drive().rates();
        let unit = setup.scale.time;
        let axis_rate = rates.axis / unit;
        Self {
            motion,
            fused,
            direction: Stored::from(setup.frame.series_from_given(direction)),
            in_body: *in_body,
            axis_rate,
            pull: Stored::from(Vector3::from(rates.momentum_of_principal) * (axis_rate / unit)),
            step: Cell::new(0),
        }
    }

    /// `m.o` and its first three time derivatives at the time `t`.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span of the motion.
    pub fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let step = self.motion.step_near(t, self.step.get())?;
        self.step.set(step);
        Ok(run_fused(
            self.fused,
            #[inline(always)]
            || self.by_step(self.fused, step, t),
        ))
    }

    /// The latest time in `(after, t]` at which a series starts, where it takes least work.
    pub fn step_start(&self, after: f64, t: f64) -> Option<f64> {
        let step = self.motion.step_near(t, self.step.get()).ok()?;
        let forwards = self.motion.setup.direction() > 0.0;
        let start = self.motion.steps.starts.get(if forwards { step } else { step + 1 })?;
        let time = self.motion.setup.span.0 + start.high * self.motion.setup.direction();
        (after < time && time <= t).then_some(time)
    }

    /// By the derivatives of `o` as the body sees it, `a_0 = o`, `a_(k+1) = a_k' + a_k x Omega`, those of `m.o` are `a_k . m`:
    ///
    /// ```text
    /// a_1 = o x Omega,   a_2 = o x Omega' + a_1 x Omega,   a_3 = o x Omega'' + (o x Omega' + a_2) x Omega + a_1 x Omega'
    /// ```
    ///
    /// They need not wait for `m`, as the derivatives of `m` would.
    #[inline(always)]
    fn by_step<A: OneMotion<Scalar = f64>>(&self, a: A, step: usize, t: f64) -> [f64; 4] {
        let setup = &self.motion.setup;
        let turned = setup.rate_about_axis * (t - setup.span.0);
        let (sin, cos) = turned.sin_cos();
        let (along_companion, across) =
            (self.in_body.x * cos - self.in_body.y * sin, self.in_body.x * sin + self.in_body.y * cos);

        let series = self.motion.series(step);
        let coefficient = |k: usize| series[k].each_ref().map(|v| a.load(v));
        let h = setup.series_time(&self.motion.steps.starts[step], t);
        let first = coefficient(0);
        // Where a series starts, to the rounding of the time, two of its terms are enough.
        let change = if h.abs() < 1e-9 {
            coefficient(1).map(|rate| a.mul(rate, a.splat(h)))
        } else {
            change(a, setup.order, coefficient, a.splat(h))
        };
        let [axis, momentum, companion] = [AXIS, MOMENTUM, COMPANION].map(|i| a.add(first[i], change[i]));

        let cross = |u: A::Turned, v: A::Turned| a.sub(a.mul(a.yzx(u), a.zxy(v)), a.mul(a.zxy(u), a.yzx(v)));
        let (pull, about) = (a.load(&self.pull), a.splat(setup.rate_about_axis));
        // What turns n: L / I^xx, and its derivatives.
        let n = a.turned(axis);
        let w = a.mul(momentum, a.splat(self.axis_rate));
        let wt = a.turned(w);
        let axis_1 = cross(wt, n);
        let n_1 = a.turned(axis_1);
        let w_1 = a.mul(pull, a.mul(a.yzx(n), a.zxy(n)));
        let axis_2 = a.add(cross(a.turned(w_1), n), cross(wt, n_1));
        let w_2 = a.mul(pull, a.mul_add(a.yzx(n_1), a.zxy(n), a.mul(a.yzx(n), a.zxy(n_1))));
        let omega = a.turned(a.mul_add(about, axis, w));
        let omega_1 = a.turned(a.mul_add(about, axis_1, w_1));
        let omega_2 = a.turned(a.mul_add(about, axis_2, w_2));

        let direction = a.load(&self.direction);
        let o = a.turned(direction);
        let o_1 = cross(o, omega_1);
        let a_1 = cross(o, omega);
        let a_1t = a.turned(a_1);
        let a_2 = a.add(o_1, cross(a_1t, omega));
        let a_3 = a.add(cross(o, omega_2), a.add(cross(a.turned(a.add(o_1, a_2)), omega), cross(a_1t, omega_1)));

        let third = cross(n, a.turned(companion));
        let m = a.mul_add(
            axis,
            a.splat(self.in_body.z),
            a.mul_add(companion, a.splat(along_companion), a.mul(third, a.splat(across))),
        );
        [direction, a_1, a_2, a_3].map(|v| {
            let Stored([x, y, z, _]) = a.store(a.mul(v, m));
            x + y + z
        })
    }
}
