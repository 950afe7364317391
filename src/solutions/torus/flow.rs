//! Flows of the integrals, by Taylor series.

use nalgebra::{Matrix3, Matrix6x2, Vector3, Vector6};
use num_dual::Dual64;

use crate::dynamics::RigidSpheroid;
use crate::dynamics::first_integrals::symmetric_adjugate;
use crate::numerics::scalar::{Real, cast, length};

/// Order of the longest series.
const HIGHEST_ORDER: usize = 44;

/// Steps are whole multiples of one over this.
const STEPS_IN_ONE: f64 = 1_048_576.0;

/// Most steps of a way; once round a torus takes some ten.
const MOST_STEPS: usize = 300;

/// `n`, `L` and a vector `u` of the body, which turns with the part of the angular velocity across `n` that the flow gives.
pub(super) type Axes<S> = [Vector3<S>; 3];

/// Order of the series, and the size of its last two terms in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Precision {
    order: usize,
    last_terms: f64,
    /// What counts as zero of a distance.
    rounding: f64,
}

/// For doubles and dual numbers of doubles, of which derivatives are as exact as values: against what they are in the first terms.
pub(super) const DOUBLE: Precision = Precision { order: 26, last_terms: 1e-17, rounding: 2e-16 };

/// For a first look.
pub(super) const COARSE: Precision = Precision { order: 14, last_terms: 1e-9, rounding: 2e-16 };

/// For double-double numbers.
pub(super) const DOUBLE_DOUBLE: Precision = Precision { order: HIGHEST_ORDER, last_terms: 1e-33, rounding: 1e-31 };

/// `H = L.L / (2 I^xx) + C n.(s n)` and `K / (I^xx D)`, `D` the spread of the principal values. Both with the middle principal value taken off, which adds a multiple of `H` to `K`: so where `L` is
/// near the axis of that value, the flow of `K` is as slow as the motion of `L`. Values are diagonal; derivatives need not be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integrals<S> {
    /// Slopes of both by `L`, over `L`, and by `n`, over `n`.
    by_momentum: [Matrix3<S>; 2],
    by_axis: [Matrix3<S>; 2],
    precision: Precision,
}

impl<S: Real> Integrals<S> {
    /// For a tensor whose middle principal value is zero, and the spread of these values.
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

    /// What counts as zero of a distance.
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

    /// Angular velocities along the flows of `H` and of `K`, without that about `n` which they do not give.
    pub(super) fn turning_rates(&self, [_, momentum, _]: &Axes<S>) -> [Vector3<S>; 2] {
        self.by_momentum.map(|m| times_vector(&m, momentum))
    }

    /// The flow of `t H + k K` as a series about a point of it.
    pub(super) fn series(&self, times: [S; 2], start: &Axes<S>) -> FlowSeries<S> {
        let [a, b] = self.of(times);
        let Precision { order: last, last_terms, .. } = self.precision;
        let mut terms = [[Vector3::zeros(); 3]; HIGHEST_ORDER + 1];
        let mut turns = [Vector3::zeros(); HIGHEST_ORDER];
        let mut torques = [Vector3::zeros(); HIGHEST_ORDER];
        terms[0] = *start;
        // (a L) x L and (b n) x n, component by component where both are diagonal.
        let of_products = [a, b].map(|m| Vector3::new(m.m22 - m.m33, m.m33 - m.m11, m.m11 - m.m22));
        for order in 0..last {
            turns[order] = times_vector(&a, &terms[order][1]);
            torques[order] = times_vector(&b, &terms[order][0]);
            let mut next = [Vector3::zeros(); 3];
            let mut products = [Vector3::zeros(); 2];
            for i in 0..=order {
                let [other_n, other_l, _] = &terms[i];
                let [n, momentum, u] = &terms[order - i];
                next[0] += turns[i].cross(n);
                next[2] += turns[i].cross(u);
                if S::HAS_DERIVATIVES {
                    next[1] += turns[i].cross(momentum) + torques[i].cross(n);
                } else {
                    products[0] += product(other_l, momentum);
                    products[1] += product(other_n, n);
                }
            }
            if !S::HAS_DERIVATIVES {
                next[1] = products[0].component_mul(&of_products[0]) + products[1].component_mul(&of_products[1]);
            }
            terms[order + 1] = next.map(|v| v / S::from_f64((order + 1) as f64));
        }
        let unit = length(&start[1].map(S::re));
        let size = |terms: &Axes<S>, part: fn(S) -> f64| {
            let [n, momentum, u] = terms.map(|v| length(&v.map(part)));
            n.max(u).max(momentum / unit)
        };
        let least_of_both = |smallest: f64, part: fn(S) -> f64| {
            [last - 1, last].into_iter().fold(f64::INFINITY, |least, order| {
                let ratio = smallest.max(f64::MIN_POSITIVE) / size(&terms[order], part).max(f64::MIN_POSITIVE);
                least.min(ratio.powf(1.0 / order as f64))
            })
        };
        let mut step = least_of_both(last_terms, S::re);
        if S::HAS_DERIVATIVES {
            // Derivatives may have multiples of the frequencies that values have.
            let first = (0..3).map(|order| size(&terms[order], derivative) * step.min(1.0).powi(order as i32));
            step = step.min(least_of_both(last_terms * first.fold(0.0, f64::max), derivative));
        }
        // Of so few bits that steps add up exactly.
        let step = (step * STEPS_IN_ONE).floor().max(1.0) / STEPS_IN_ONE;
        FlowSeries { terms, last, step }
    }

    /// The flow of `t H + k K` for the time one: `H` for the time `t` and `K` for `k`, in any order, since they commute. Not a number where that takes
    /// more than [`MOST_STEPS`].
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
                // What rounding takes from the sum goes into the next one.
                let change = change[i] + lost[i];
                let moved = *axis + change;
                lost[i] = change - (moved - *axis);
                *axis = moved;
            }
        }
        axes
    }
}

/// A flow near one of its points.
#[derive(Debug, Clone)]
pub(super) struct FlowSeries<S> {
    terms: [Axes<S>; HIGHEST_ORDER + 1],
    last: usize,
    /// Parameter up to which the last two terms are small enough.
    pub(super) step: f64,
}

impl<S: Real> FlowSeries<S> {
    /// What changes up to a parameter.
    fn change(&self, step: f64) -> Axes<S> {
        let step = S::from_f64(step);
        let mut sum = [Vector3::zeros(); 3];
        for terms in self.terms[1..=self.last].iter().rev() {
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum = (*sum + term) * step;
            }
        }
        sum
    }

    /// The axes at a parameter.
    pub(super) fn at(&self, step: f64) -> Axes<S> {
        let change = self.change(step);
        core::array::from_fn(|i| self.terms[0][i] + change[i])
    }
}

/// The product of a vector with a matrix of which values are diagonal.
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

/// The derivative of a dual number, zero of others.
pub(super) fn derivative<S: Real>(x: S) -> f64 {
    cast::<S, Dual64>(x).map_or(0.0, |dual| dual.eps)
}

fn product<S: Real>(a: &Vector3<S>, b: &Vector3<S>) -> Vector3<S> {
    Vector3::new(a.y * b.z, a.z * b.x, a.x * b.y)
}
