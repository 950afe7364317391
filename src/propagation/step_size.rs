//! Sizes by which a series is measured, its order and its step.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::series::{MOMENTUM, Vectors};
use crate::scalar::{Real, real_part};

/// Sizes by which errors are measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    /// Size of the angular momentum, or what the torque makes of it within its own time.
    pub(super) momentum: f64,
    /// Upper bound of the rate at which directions turn.
    pub(super) turning_rate: f64,
    /// A power of two near the inverse of that rate.
    pub(super) time: f64,
}

impl Scale {
    pub(super) fn of<S: Real>(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, momentum: &Vector3<S>) -> Self {
        let inertia = spheroid.inertia_xx.re();
        let pull = spheroid.constant_c.re().abs() * s.map(S::re).norm();
        // Two roots, since the product may be out of range where they are not.
        let momentum = real_part(momentum).norm() + (2.0 * inertia).sqrt() * pull.sqrt();
        let body_turn = (1.0 - spheroid.inertia_xx.re() / spheroid.inertia_zz.re()).abs();
        let turning_rate = momentum / inertia * (1.0 + body_turn);
        let time = if turning_rate > 0.0 { 2f64.powi(-turning_rate.log2().clamp(-1000.0, 1000.0) as i32) } else { 1.0 };
        // A body at rest without torque stays so: any unit of momentum does.
        Self { momentum: if momentum > 0.0 { momentum } else { inertia }, turning_rate, time }
    }

    /// Largest component of a coefficient, `L` in units of the momentum.
    pub(super) fn size<S: Real, const V: usize>(&self, coefficient: &Vectors<S, V>) -> f64 {
        let mut sizes = coefficient.map(|component| component.re().abs());
        let mut momentum = sizes.column_mut(MOMENTUM);
        momentum /= self.momentum;
        sizes.max()
    }
}

/// What the accuracy asked makes of order and steps.
pub(super) struct Control {
    pub(super) scale: Scale,
    /// Truncation error per unit of time.
    pub(super) budget: f64,
    pub(super) order: usize,
}

impl Control {
    /// For a motion over `duration` under the trace-free tensor `s`.
    ///
    /// # Errors
    /// [`Error::Domain`] for a turning rate that is not finite.
    pub(super) fn of<S: Real>(
        spheroid: &RigidSpheroid<S>,
        s: &Matrix3<S>,
        momentum: &Vector3<S>,
        duration: f64,
        accuracy: f64,
    ) -> Result<Self, Error> {
        let scale = Scale::of(spheroid, s, momentum);
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
        Ok(Self { scale, budget, order })
    }
}

/// Order of the series for a relative truncation `budget` per radian: the work per unit of time is least near
/// `-ln(budget) / 2` (Jorba and Zou 2005).
fn order_for(budget: f64) -> usize {
    (-budget.ln() / 2.0).ceil().clamp(6.0, 32.0) as usize
}

/// Step with truncation error at most `budget` per unit of time, from the last two coefficients (two, since one may vanish
/// by symmetry); zero where the coefficients are out of range.
pub(super) fn step_size<S: Real, const V: usize>(series: &[Vectors<S, V>], scale: &Scale, budget: f64) -> f64 {
    let order = series.len() - 1;
    // The logarithm of the largest step in units of the series.
    let bound = |k: usize| {
        let size = scale.size(&series[k]);
        match size {
            0.0 => f64::INFINITY,
            size if size.is_finite() => (budget * scale.time / size).ln() / (k as f64 - 1.0),
            _ => f64::NEG_INFINITY,
        }
    };
    // The first omitted term is about the last kept one times (step / radius of convergence), and that ratio is below
    // one fifth: so the last kept term bounds the whole remainder.
    bound(order).min(bound(order - 1)).exp() * scale.time
}
