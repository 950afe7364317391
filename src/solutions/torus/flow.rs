//! Flows of the integrals, by Taylor series.

use nalgebra::{Matrix3, Matrix6x2, Vector3, Vector6};
use num_dual::Dual64;

use super::flow_series::{FlowScalar, FlowSeries, Precision};
use crate::dynamics::RigidSpheroid;
use crate::dynamics::first_integrals::symmetric_adjugate;
use crate::numerics::scalar::{Real, cast};

/// Maximum number of steps of a path; a full circuit of a torus takes some ten.
const MOST_STEPS: usize = 300;

/// `n`, `L` and a vector `u` of the body. The flow determines the angular velocity only across `n`, and `u` rotates with this part.
pub(super) type Axes<S> = [Vector3<S>; 3];

/// `H = L.L / (2 I^xx) + C n.(s n)` and `K / (I^xx D)`, `D` the spread of the principal values. The middle principal value is subtracted in both,
/// which adds a multiple of `H` to `K`. As a result, where `L` is near the axis of that value, the flow of `K` is as slow as the motion of `L`. The
/// values are diagonal; derivatives need not be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integrals<S> {
    /// Matrices whose products with `L` are the slopes of both integrals with respect to `L`, and those whose products with `n` are the slopes with
    /// respect to `n`.
    by_momentum: [Matrix3<S>; 2],
    by_axis: [Matrix3<S>; 2],
    precision: Precision,
}

impl<S: FlowScalar> Integrals<S> {
    /// The integrals for a tensor `s` whose middle principal value is zero, and for the `spread` of its principal values.
    pub(super) fn new(spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, spread: S, precision: Precision) -> Self {
        let (c, inertia) = (spheroid.constant_c, spheroid.inertia_xx);
        Self {
            by_momentum: [
                Matrix3::from_diagonal_element(S::one() / inertia),
                s * (S::from_f64(2.0) / (inertia * spread)),
            ],
            by_axis: [s * (c * 2.0), symmetric_adjugate(s) * (-(c * 4.0) / spread)],
            precision,
        }
    }

    /// The same flows in another precision.
    pub(super) fn with(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// Distance that counts as zero.
    pub(super) fn rounding(&self) -> f64 {
        self.precision.rounding
    }

    /// `1 / I^xx`.
    pub(super) fn inverse_inertia(&self) -> f64 {
        self.by_momentum[0].m11.re()
    }

    /// Coefficients of the flow of `t H + k K`.
    fn of(&self, [t, k]: [S; 2]) -> [Matrix3<S>; 2] {
        [self.by_momentum, self.by_axis].map(|[of_h, of_k]| of_h * t + of_k * k)
    }

    /// Rates along the flow of `t H + k K`.
    fn rates(&self, times: [S; 2], [n, momentum, u]: &Axes<S>) -> Axes<S> {
        let [a, b] = self.of(times);
        let turn = times_vector(&a, momentum);
        [turn.cross(n), turn.cross(momentum) + times_vector(&b, n).cross(n), turn.cross(u)]
    }

    /// Rates along the flows of `H` and of `K`.
    pub(super) fn both_rates(&self, at: &Axes<S>) -> [Axes<S>; 2] {
        [[S::one(), S::zero()], [S::zero(), S::one()]].map(|unit| self.rates(unit, at))
    }

    /// Angular velocities along the flows of `H` and of `K`, without the component about `n`, which they do not determine.
    pub(super) fn turning_rates(&self, [_, momentum, _]: &Axes<S>) -> [Vector3<S>; 2] {
        self.by_momentum.map(|m| times_vector(&m, momentum))
    }

    /// The flow of `t H + k K` as a series about one of its points.
    pub(super) fn series(&self, times: [S; 2], start: &Axes<S>) -> FlowSeries<S> {
        FlowSeries::new(&self.of(times), start, self.precision)
    }

    /// The flow of `t H + k K` for unit time: `H` for the time `t` and `K` for `k`, in any order, since they commute. NaN if it takes more than
    /// [`MOST_STEPS`].
    pub(super) fn moved(&self, times: [S; 2], start: &Axes<S>) -> Axes<S> {
        let (mut axes, mut lost, mut left) = (*start, [Vector3::zeros(); 3], 1.0);
        let mut steps = 0;
        while left > 0.0 {
            steps += 1;
            if steps > MOST_STEPS {
                return [Vector3::repeat(S::from_f64(f64::NAN)); 3];
            }
            let series = self.series(times, &axes);
            let step = series.step.min(left);
            left -= step;
            let change = series.change(step);
            for (i, axis) in axes.iter_mut().enumerate() {
                // The rounding error of the sum is added to the next one.
                let change = change[i] + lost[i];
                let moved = *axis + change;
                lost[i] = change - (moved - *axis);
                *axis = moved;
            }
        }
        axes
    }
}

/// The product of a vector with a matrix whose values are diagonal.
fn times_vector<S: Real>(matrix: &Matrix3<S>, v: &Vector3<S>) -> Vector3<S> {
    if S::HAS_DERIVATIVES { matrix * v } else { matrix.diagonal().component_mul(v) }
}

/// The components of `n` and of `L` in units of a size.
pub(super) fn joined<S: Real>([n, momentum, _]: &Axes<S>, size: f64, part: fn(S) -> f64) -> Vector6<f64> {
    let (n, l) = (n.map(part), momentum.map(part) / size);
    Vector6::new(n.x, n.y, n.z, l.x, l.y, l.z)
}

/// Values of the rates of `n`, and of `L` in its unit, along both flows.
pub(super) fn tangents<S: Real>(rates: &[Axes<S>; 2], unit: f64) -> Matrix6x2<f64> {
    Matrix6x2::from_columns(&[0, 1].map(|flow| joined(&rates[flow], unit, S::re)))
}

/// Largest difference of a component of `n`, or of `L` in its unit.
pub(super) fn apart<S: Real>(a: &Axes<S>, b: &Axes<S>, unit: f64) -> f64 {
    let [n, momentum] = [0, 1].map(|i| (a[i] - b[i]).map(S::re).amax());
    n.max(momentum / unit)
}

/// The derivative of a dual number, zero for other numbers.
pub(super) fn derivative<S: Real>(x: S) -> f64 {
    cast::<S, Dual64>(x).map_or(0.0, |dual| dual.eps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_without_derivatives_have_none() {
        assert_eq!((derivative(2.5), derivative(Dual64::new(2.5, -0.7))), (0.0, -0.7));
    }
}
