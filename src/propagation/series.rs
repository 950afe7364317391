//! Taylor series of a motion about one time: the recurrences of the quadratic equations of motion.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::scalar::Scalar;

/// Taylor coefficients of `n`, `L`, `e_x` about one time, `state(t0 + h) = sum_k coefficients[k] (h / unit)^k`.
///
/// The unit of time, a power of two near the time of the motion, keeps high orders within the range of doubles whatever unit
/// the caller counts in; being a power of two it rounds nothing.
///
/// The right-hand sides are quadratic, so each order is a convolution of cross products of the lower ones:
///
/// ```text
/// (k+1) n_{k+1}   = sum_j L_j x n_{k-j} / I^xx
/// (k+1) L_{k+1}   = sum_j (s n)_j x n_{k-j} 2 C
/// (k+1) e_x_{k+1} = sum_j Omega_j x e_x_{k-j},    Omega_j = L_j / I^xx - epsilon Omega^z n_j
/// ```
#[derive(Debug, Clone)]
pub(super) struct Series<S> {
    pub(super) coefficients: Vec<BodyState<S>>,
    unit: f64,
}

impl<S: Scalar> Series<S> {
    /// Coefficients up to `order` (at least one) about the state `start`, for time in the given unit.
    pub(super) fn about(
        spheroid: &RigidSpheroid<S>,
        s: &Matrix3<S>,
        start: &BodyState<S>,
        order: usize,
        unit: f64,
    ) -> Self {
        let inverse_inertia = S::one() / spheroid.inertia_xx;
        let twice_c = spheroid.constant_c * 2.0;
        let spin = start.momentum.dot(&start.axis) / spheroid.inertia_zz;
        let body_turn = spheroid.oblateness() * spin;
        let omega = |c: &BodyState<S>| c.momentum * inverse_inertia - c.axis * body_turn;

        let mut coefficients = Vec::with_capacity(order + 1);
        let mut strained: Vec<Vector3<S>> = Vec::with_capacity(order);
        let mut omegas: Vec<Vector3<S>> = Vec::with_capacity(order);
        coefficients.push(*start);
        for k in 0..order {
            strained.push(s * coefficients[k].axis);
            omegas.push(omega(&coefficients[k]));
            let (mut axis, mut momentum, mut equatorial_axis) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
            for j in 0..=k {
                let other = &coefficients[k - j];
                axis += coefficients[j].momentum.cross(&other.axis);
                momentum += strained[j].cross(&other.axis);
                equatorial_axis += omegas[j].cross(&other.equatorial_axis);
            }
            let share = S::from_f64(unit / (k + 1) as f64);
            coefficients.push(BodyState {
                axis: axis * (inverse_inertia * share),
                momentum: momentum * (twice_c * share),
                equatorial_axis: equatorial_axis * share,
            });
        }
        Self { coefficients, unit }
    }

    /// Change of the state over the time `h`: the sum without its constant term, which the caller adds last.
    pub(super) fn change(&self, h: S) -> BodyState<S> {
        let h = h / self.unit;
        let zero = BodyState { axis: Vector3::zeros(), momentum: Vector3::zeros(), equatorial_axis: Vector3::zeros() };
        self.coefficients[1..].iter().rev().fold(zero, |sum, c| BodyState {
            axis: (sum.axis + c.axis) * h,
            momentum: (sum.momentum + c.momentum) * h,
            equatorial_axis: (sum.equatorial_axis + c.equatorial_axis) * h,
        })
    }
}
