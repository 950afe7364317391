//! The successive steps of a motion.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::numerics::arithmetic::{LoadStore, Padded};
use crate::numerics::compensated::CompensatedVectors;
use crate::numerics::scalar::Real;
use crate::propagation::taylor::clock::{Clock, Interval, StepLimit};
use crate::propagation::taylor::series::{Recurrence, Vectors, change};
use crate::propagation::taylor::step_size::{Scale, step_size};

/// The data that determine the steps.
pub(super) struct Stepper<'a, S, const V: usize> {
    pub(super) spheroid: &'a RigidSpheroid<S>,
    /// The traceless tensor, in the frame of the series.
    pub(super) tensor: &'a Matrix3<S>,
    /// The initial vectors, in the frame of the series.
    pub(super) start: &'a Vectors<Padded<S>, V>,
    pub(super) scale: &'a Scale,
    pub(super) order: usize,
    pub(super) duration: f64,
    /// `1` forwards in time, `-1` backwards.
    pub(super) direction: f64,
    /// Truncation error per unit of time.
    pub(super) budget: f64,
    /// Upper limit of every step, whatever the coefficients.
    pub(super) longest_step: f64,
}

/// Rates of the recurrences in units of the series.
pub(super) struct Rates<S> {
    /// `unit / I^xx`.
    pub(super) axis: S,
    /// `2 C unit`.
    pub(super) momentum: S,
    /// `2 C unit (s^YY - s^ZZ, s^ZZ - s^XX, s^XX - s^YY)`, for a tensor that is diagonal.
    pub(super) momentum_of_principal: [S; 3],
}

impl<S: Real, const V: usize> Stepper<'_, S, V> {
    #[inline(always)]
    pub(super) fn rates(&self) -> Rates<S> {
        let RigidSpheroid { inertia_xx, constant_c, .. } = *self.spheroid;
        let unit = self.scale.time;
        let momentum = constant_c * (2.0 * unit);
        let [x, y, z] = [0, 1, 2].map(|i| self.tensor[(i, i)]);
        let momentum_of_principal = [y - z, z - x, x - y].map(|difference| momentum * difference);
        Rates { axis: S::from_f64(unit) / inertia_xx, momentum, momentum_of_principal }
    }

    fn recurrence<A: LoadStore<Scalar = S>>(&self, a: A) -> Recurrence<A, V> {
        let rates = self.rates();
        let momentum_rate = if A::PRINCIPAL_FRAME {
            a.load(&Padded::from(Vector3::from(rates.momentum_of_principal)))
        } else {
            a.splat(rates.momentum)
        };
        let columns = [0, 1, 2].map(|i| a.load(&Padded::from(self.tensor.column(i).into_owned())));
        Recurrence::new(a, self.order, a.splat(rates.axis), momentum_rate, columns)
    }

    /// Length of the first step for a sufficiently long span.
    pub(super) fn first_step<A: LoadStore<Scalar = S>>(&self, a: A) -> f64 {
        let mut series = vec![[a.zero(); V]; self.order + 1];
        self.recurrence(a).expand(&self.start.map(|v| a.load(&v)), &mut series);
        let sizes = [self.order, self.order - 1].map(|k| self.scale.size(a, &series[k]));
        step_size(sizes, self.order, self.scale, self.budget).min(self.longest_step)
    }

    /// Takes steps from the start to the end of the span, at most `limit`; `visit` receives each with its series.
    #[inline(always)]
    pub(super) fn run<A: LoadStore<Scalar = S>>(
        &self,
        a: A,
        limit: StepLimit,
        mut visit: impl FnMut(&Interval, &[Vectors<A::Vector, V>]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let Stepper { scale, order, duration, direction, budget, longest_step, .. } = *self;
        let mut recurrence = self.recurrence(a);
        let mut series = vec![[a.zero(); V]; order + 1];
        let mut state = CompensatedVectors::new(a, self.start.map(|v| a.load(&v)));
        let mut clock = Clock::new();
        loop {
            recurrence.expand(&state.high, &mut series);
            // Not by `map`, which is not always inlined and then loses the instructions of `a`.
            let sizes = [scale.size(a, &series[order]), scale.size(a, &series[order - 1])];
            let step = clock.advance(step_size(sizes, order, scale, budget).min(longest_step), duration, limit)?;
            visit(&step, &series)?;
            if step.is_last() {
                return Ok(());
            }
            let h = S::from_f64(step.length * direction / scale.time);
            state.add(a, &change(a, order, |k| series[k], a.splat(h)));
        }
    }
}
