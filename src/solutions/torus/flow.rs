//! Flows of the integrals, by Taylor series.

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;
use crate::numerics::scalar::{Real, length};

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

/// For doubles and dual numbers of doubles.
pub(super) const DOUBLE: Precision = Precision { order: 26, last_terms: 1e-17, rounding: 2e-16 };

/// For double-double numbers.
pub(super) const DOUBLE_DOUBLE: Precision = Precision { order: HIGHEST_ORDER, last_terms: 1e-33, rounding: 1e-31 };

/// `H = L.L / (2 I^xx) + C n.(s n)` and `K / (I^xx D)`, `D` the spread of the principal values, of which `K` takes the traceless part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integrals<S> {
    /// Slopes of both by `L`, over `L`, and by `n`, over `n`.
    by_momentum: [Vector3<S>; 2],
    by_axis: [Vector3<S>; 2],
    precision: Precision,
}

impl<S: Real> Integrals<S> {
    /// For traceless principal values and their spread.
    pub(super) fn new(spheroid: &RigidSpheroid<S>, s: &Vector3<S>, spread: S, precision: Precision) -> Self {
        let one = Vector3::from_element(S::one());
        let adjugate = Vector3::new(s.y * s.z, s.z * s.x, s.x * s.y);
        let (c, inertia) = (spheroid.constant_c, spheroid.inertia_xx);
        Self {
            by_momentum: [one / inertia, s * (S::from_f64(2.0) / (inertia * spread))],
            by_axis: [s * (c * 2.0), adjugate * (-(c * 4.0) / spread)],
            precision,
        }
    }

    /// What counts as zero of a distance.
    pub(super) fn rounding(&self) -> f64 {
        self.precision.rounding
    }

    /// `1 / I^xx`.
    pub(super) fn inverse_inertia(&self) -> f64 {
        self.by_momentum[0].x.re()
    }

    /// Coefficients of the flow of `t H + k K`.
    fn of(&self, [t, k]: [S; 2]) -> [Vector3<S>; 2] {
        [self.by_momentum, self.by_axis].map(|[of_h, of_k]| of_h * t + of_k * k)
    }

    /// Rates of `n` and `L` along the flow of `t H + k K`.
    pub(super) fn rates(&self, times: [S; 2], [n, momentum, _]: &Axes<S>) -> [Vector3<S>; 2] {
        let [a, b] = self.of(times);
        let turn = a.component_mul(momentum);
        [turn.cross(n), turn.cross(momentum) + b.component_mul(n).cross(n)]
    }

    /// The flow of `t H + k K` as a series about a point of it.
    pub(super) fn series(&self, times: [S; 2], start: &Axes<S>) -> FlowSeries<S> {
        let [a, b] = self.of(times);
        let Precision { order: last, last_terms, .. } = self.precision;
        let mut terms = [[Vector3::zeros(); 3]; HIGHEST_ORDER + 1];
        let mut turns = [Vector3::zeros(); HIGHEST_ORDER];
        terms[0] = *start;
        // (a L) x L and (b n) x n, component by component.
        let of_products = [a, b].map(|v| Vector3::new(v.y - v.z, v.z - v.x, v.x - v.y));
        for order in 0..last {
            turns[order] = a.component_mul(&terms[order][1]);
            let mut next = [Vector3::zeros(); 3];
            let mut products = [Vector3::zeros(); 2];
            for i in 0..=order {
                let [other_n, other_l, _] = &terms[i];
                let [n, momentum, u] = &terms[order - i];
                next[0] += turns[i].cross(n);
                next[2] += turns[i].cross(u);
                products[0] += product(other_l, momentum);
                products[1] += product(other_n, n);
            }
            next[1] = products[0].component_mul(&of_products[0]) + products[1].component_mul(&of_products[1]);
            terms[order + 1] = next.map(|v| v / S::from_f64((order + 1) as f64));
        }
        let size = |terms: &Axes<S>| {
            let [n, momentum, u] = terms.map(|v| length(&v.map(S::re)));
            n.max(u).max(momentum / length(&start[1].map(S::re)))
        };
        let step = [last - 1, last]
            .map(|order| (last_terms / size(&terms[order]).max(f64::MIN_POSITIVE)).powf(1.0 / order as f64))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
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

fn product<S: Real>(a: &Vector3<S>, b: &Vector3<S>) -> Vector3<S> {
    Vector3::new(a.y * b.z, a.z * b.x, a.x * b.y)
}
