//! The component along a fixed direction of a vector fixed in the body, from the series of a motion.

use core::cell::Cell;

use nalgebra::Vector3;

use crate::error::Error;
use crate::numerics::arithmetic::{LoadStore, Padded};
use crate::numerics::fused::{Fused, run_fused};
use crate::propagation::taylor::Steps;
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::series::{AXIS, COMPANION, MOMENTUM, change};

/// `m.o` of a vector `m` fixed in the body and a fixed direction `o`, with its time derivatives, at any time of a motion that is stored
/// as Taylor series in doubles: [`Motion::projection`](crate::propagation::Motion::projection).
///
/// The results agree with those from the states to rounding, for less work: `o` is transformed into the frame of the series once,
/// instead of every state out of it. The same time always gives the same digits, whatever was requested before.
#[derive(Debug, Clone)]
pub struct SeriesProjection<'a> {
    setup: &'a ScaledProblem<f64, 3>,
    steps: &'a Steps<f64, 3>,
    fused: Fused,
    /// `o` in the frame of the series.
    direction: Padded<f64>,
    /// Body-frame components of `m`.
    in_body: Vector3<f64>,
    /// `1 / I^xx`.
    axis_rate: f64,
    /// `2 C (s^YY - s^ZZ, s^ZZ - s^XX, s^XX - s^YY) / I^xx` in the frame of the series, which is principal.
    pull: Padded<f64>,
    /// The step of the last request: the next is often the same or a nearby one.
    step: Cell<usize>,
    /// Integer number of radians that the body has turned about `n` relative to the vector carried by the series, and the components
    /// of `m` along that vector and perpendicular to it after such a rotation.
    turned: Cell<(f64, [f64; 2])>,
}

impl<'a> SeriesProjection<'a> {
    pub(super) fn new(
        setup: &'a ScaledProblem<f64, 3>,
        steps: &'a Steps<f64, 3>,
        fused: Fused,
        in_body: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> Self {
        let rates = setup.drive().rates();
        let unit = setup.scale.time;
        let axis_rate = rates.axis / unit;
        Self {
            setup,
            steps,
            fused,
            direction: Padded::from(setup.frame.series_from_given(direction)),
            in_body: *in_body,
            axis_rate,
            pull: Padded::from(Vector3::from(rates.momentum_of_principal) * (axis_rate / unit)),
            step: Cell::new(0),
            turned: Cell::new((0.0, [in_body.x, in_body.y])),
        }
    }

    /// `m.o` and its first three time derivatives at the time `t`.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time outside the span of the motion.
    pub fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let step = self.step_near(t)?;
        self.step.set(step);
        Ok(run_fused(
            self.fused,
            #[inline(always)]
            || self.by_step(self.fused, step, t),
        ))
    }

    /// The cheapest time in `(after, t]`: the latest at which a series starts, if that is not `t`.
    pub(crate) fn cheapest_time(&self, after: f64, t: f64) -> Option<f64> {
        let step = self.step_near(t).ok()?;
        let direction = self.setup.direction();
        let start = self.steps.starts.get(if direction > 0.0 { step } else { step + 1 })?;
        let time = self.setup.span.0 + start.high * direction;
        (after < time && time <= t).then_some(time)
    }

    fn step_near(&self, t: f64) -> Result<usize, Error> {
        let elapsed = self.setup.elapsed(t)?;
        Ok(self.steps.index_near(self.step.get(), elapsed, self.setup.duration()))
    }

    /// The components of `m` along the vector carried by the series and perpendicular to it and `n`, at the time `t`. Sine and cosine
    /// of the angle are stored for the nearest integer number of radians, and recomputed if that changes; for the remaining angle their
    /// series need seven terms. The same time always gives the same numbers, whatever was requested before.
    #[inline(always)]
    fn about_axis(&self, t: f64) -> [f64; 2] {
        let angle = self.setup.rate_about_axis * (t - self.setup.span.0);
        let whole = angle.round_ties_even();
        let (kept, mut turned) = self.turned.get();
        if kept != whole {
            let (sin, cos) = whole.sin_cos();
            turned = [self.in_body.x * cos - self.in_body.y * sin, self.in_body.x * sin + self.in_body.y * cos];
            self.turned.set((whole, turned));
        }
        let rest = angle - whole;
        let square = rest * rest;
        // From the last term to the first, each multiplied with the sum of those after it.
        let (mut sine, mut less) = (1.0, 1.0);
        for k in [12.0, 10.0, 8.0, 6.0, 4.0, 2.0] {
            sine = 1.0 - square * (1.0 / (k * (k + 1.0))) * sine;
            less = 1.0 - square * (1.0 / ((k + 1.0) * (k + 2.0))) * less;
        }
        let (sin, less) = (rest * sine, square / 2.0 * less);
        let [x, y] = turned;
        // The small parts first.
        [x - (y * sin + x * less), y + (x * sin - y * less)]
    }

    /// With the derivatives of `o` as seen from the body, `a_0 = o`, `a_(k+1) = a_k' + a_k x Omega`, the derivatives of `m.o`
    /// are `a_k . m`:
    ///
    /// ```text
    /// a_1 = o x Omega,   a_2 = o x Omega' + a_1 x Omega,   a_3 = o x Omega'' + (o x Omega' + a_2) x Omega + a_1 x Omega'
    /// ```
    ///
    /// They do not depend on `m`, unlike the derivatives of `m`.
    #[inline(always)]
    fn by_step<A: LoadStore<Scalar = f64>>(&self, a: A, step: usize, t: f64) -> [f64; 4] {
        let setup = self.setup;
        let [along_companion, across] = self.about_axis(t);
        let series = self.steps.series(step);
        // Loops rather than `map`, which is not always inlined and then loses the instructions of `a`.
        let coefficient = |k: usize| {
            let [n, l, u] = &series[k];
            [a.load(n), a.load(l), a.load(u)]
        };
        let h = setup.series_time(&self.steps.starts[step], t);
        let first = coefficient(0);
        // At the start of a series, to the rounding of the time, two of its terms are sufficient.
        let change = if h.abs() < 1e-9 {
            let [n, l, u] = coefficient(1);
            let h = a.splat(h);
            [a.mul(n, h), a.mul(l, h), a.mul(u, h)]
        } else {
            change(a, setup.order, coefficient, a.splat(h))
        };
        let axis = a.add(first[AXIS], change[AXIS]);
        let momentum = a.add(first[MOMENTUM], change[MOMENTUM]);
        let companion = a.add(first[COMPANION], change[COMPANION]);

        let cross = |u, v| cross(a, u, v);
        let (pull, about) = (a.load(&self.pull), a.splat(setup.rate_about_axis));
        // The rate of rotation of n, L / I^xx, and its derivatives.
        let n = a.permuted(axis);
        let w = a.mul(momentum, a.splat(self.axis_rate));
        let wt = a.permuted(w);
        let axis_1 = cross(wt, n);
        let n_1 = a.permuted(axis_1);
        let w_1 = a.mul(pull, a.mul(a.yzx(n), a.zxy(n)));
        let axis_2 = a.add(cross(a.permuted(w_1), n), cross(wt, n_1));
        let w_2 = a.mul(pull, a.mul_add(a.yzx(n_1), a.zxy(n), a.mul(a.yzx(n), a.zxy(n_1))));
        let omega = a.permuted(a.mul_add(about, axis, w));
        let omega_1 = a.permuted(a.mul_add(about, axis_1, w_1));
        let omega_2 = a.permuted(a.mul_add(about, axis_2, w_2));

        let direction = a.load(&self.direction);
        let o = a.permuted(direction);
        let o_1 = cross(o, omega_1);
        let a_1 = cross(o, omega);
        let a_1t = a.permuted(a_1);
        let a_2 = a.add(o_1, cross(a_1t, omega));
        let a_3 = a.add(cross(o, omega_2), a.add(cross(a.permuted(a.add(o_1, a_2)), omega), cross(a_1t, omega_1)));

        let third = cross(n, a.permuted(companion));
        let m = a.mul_add(
            axis,
            a.splat(self.in_body.z),
            a.mul_add(companion, a.splat(along_companion), a.mul(third, a.splat(across))),
        );
        [dot(a, direction, m), dot(a, a_1, m), dot(a, a_2, m), dot(a, a_3, m)]
    }
}

#[inline(always)]
fn cross<A: LoadStore>(a: A, u: A::Permuted, v: A::Permuted) -> A::Vector {
    a.sub(a.mul(a.yzx(u), a.zxy(v)), a.mul(a.zxy(u), a.yzx(v)))
}

#[inline(always)]
fn dot<A: LoadStore<Scalar = f64>>(a: A, u: A::Vector, v: A::Vector) -> f64 {
    let Padded([x, y, z, _]) = a.store(a.mul(u, v));
    x + y + z
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use crate::dynamics::{BodyState, Problem, RigidSpheroid};
    use crate::observables::pulsar::Beam;
    use crate::propagation::Motion;
    use nalgebra::Vector3;

    /// The start of a step, at most one step earlier; backwards in time the projection also agrees with that of the state.
    #[test]
    fn the_cheapest_time_is_the_latest_start_of_a_step() {
        let (beam, n) = (Beam::new(0.7, 0.9, 0.2), Vector3::new(0.36, 0.48, 0.8));
        for span in [(2.0, 45.0), (2.0, -41.0)] {
            let motion = tumbling(span);
            let Some(projection) = motion.projection(&beam.axis, &n) else { return };
            for (after, t) in [(span.0, 0.5 * (span.0 + span.1)), (0.3 * span.0 + 0.7 * span.1, span.1)] {
                let exact = n.dot(&beam.direction(&motion.state(t).unwrap()));
                assert!((projection.at(t).unwrap()[0] - exact).abs() < 1e-14, "{t}");
                let (after, t) = if after < t { (after, t) } else { (t, after) };
                let found = projection.cheapest_time(after, t).expect("a step starts between");
                assert!(after < found && found <= t && t - found < 2.5, "{after} {t} {found}");
                assert_eq!(projection.cheapest_time(found, found + 1e-9), None);
                assert_eq!(projection.cheapest_time(found - 1e-9, found + 1e-9), Some(found));
            }
        }
    }

    fn tumbling(span: (f64, f64)) -> crate::propagation::TaylorMotion<f64> {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 0.7, constant_c: 0.8 };
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.21, -0.1, -0.11));
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let start = BodyState { axis, momentum: Vector3::new(0.5, -0.9, 1.7), equatorial_axis: Vector3::y() };
        Problem::new(spheroid, tensor, start).unwrap().taylor(span, 1e-13).unwrap()
    }

    /// Sine and cosine from the nearest integer number of radians are accurate to the last digits, also farthest from it and
    /// at the first request.
    #[test]
    fn the_turn_about_the_axis_has_all_digits() {
        let motion = tumbling((0.0, 8.0));
        for angle in [0.49999, -0.49999, 0.31, 1.2, 0.8, -1.3, 2.49] {
            for (x, y) in [(1.0, 0.0), (0.0, 1.0)] {
                let in_body = Vector3::new(x, y, 0.3);
                let Some(projection) = motion.projection(&in_body, &Vector3::z()) else { return };
                let t = angle / projection.setup.rate_about_axis;
                let (sin, cos) = (projection.setup.rate_about_axis * t).sin_cos();
                let exact = [x * cos - y * sin, x * sin + y * cos];
                let error = projection.about_axis(t).iter().zip(exact).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
                // From a nonzero integer number of radians there are two more roundings.
                let allowed = if angle.abs() < 0.5 { 3e-16 } else { 1e-15 };
                assert!(error < allowed, "{angle}: {error:e}");
            }
        }
    }

    /// The times lie where two terms are sufficient, and where they no longer are.
    #[test]
    fn just_after_the_start_of_a_series_the_projection_is_that_of_the_state() {
        let motion = tumbling((0.0, 8.0));
        let beam = Beam::new(0.7, 0.9, 0.2);
        let n = Vector3::new(0.36, 0.48, 0.8);
        let Some(projection) = motion.projection(&beam.axis, &n) else { return };
        let start = projection.steps.starts[2].high;
        for h in [0.0, 3e-10, 8e-10, 1.2e-9, 3e-7, 8e-7] {
            let t = start + h * projection.setup.scale.time;
            let exact = n.dot(&beam.direction(&motion.state(t).unwrap()));
            let error = (projection.at(t).unwrap()[0] - exact).abs();
            assert!(error < 3e-15, "{h}: {error:e}");
        }
    }
}
