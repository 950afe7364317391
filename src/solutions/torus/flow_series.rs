//! Taylor series of a flow of the integrals.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use super::flow::{Axes, derivative};
use crate::numerics::arithmetic::{Arithmetic, Componentwise, LoadStore, Padded, plain};
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::fused::{Fused, detect_fused, run_fused};
use crate::numerics::pairs::Pairs;
use crate::numerics::scalar::{Real, length};

/// Steps are integer multiples of the inverse of this.
const STEPS_IN_ONE: f64 = 1_048_576.0;

/// Order of the series, and the allowed size of its last two terms in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Precision {
    order: usize,
    last_terms: f64,
    /// Distance that counts as zero.
    pub(super) rounding: f64,
}

/// For doubles and dual numbers of doubles; derivatives are as accurate as values, relative to their first terms.
pub(super) const DOUBLE: Precision = Precision { order: 26, last_terms: 1e-17, rounding: 2e-16 };

/// For a preliminary search.
pub(super) const COARSE: Precision = Precision { order: 14, last_terms: 1e-9, rounding: 2e-16 };

/// For double-double numbers.
pub(super) const DOUBLE_DOUBLE: Precision = Precision { order: 44, last_terms: 1e-33, rounding: 1e-31 };

/// Coefficients of `n`, `L` and `u` of one order.
type Terms<S> = [Padded<S>; 3];

/// A flow near one of its points.
#[derive(Debug, Clone)]
pub(super) struct FlowSeries<S> {
    terms: Vec<Terms<S>>,
    /// Parameter up to which the last two terms are sufficiently small.
    pub(super) step: f64,
}

/// A scalar with vector arithmetic in the registers of a processor.
pub(super) trait FlowScalar: Real {
    /// Arithmetic of its vectors.
    type Registers: LoadStore<Scalar = Self>;

    fn registers(fused: Fused) -> Self::Registers;
}

impl FlowScalar for f64 {
    type Registers = Fused;

    #[inline(always)]
    fn registers(fused: Fused) -> Fused {
        fused
    }
}

impl FlowScalar for DoubleDouble {
    type Registers = Pairs<Fused>;

    #[inline(always)]
    fn registers(fused: Fused) -> Pairs<Fused> {
        Pairs(fused)
    }
}

impl FlowScalar for Dual64 {
    type Registers = Componentwise<Dual64>;

    #[inline(always)]
    fn registers(_: Fused) -> Componentwise<Dual64> {
        plain()
    }
}

/// The quantities of one order that enter a sum of products of terms: both cyclic permutations of each vector.
#[derive(Clone, Copy)]
struct Factors<P> {
    n: P,
    momentum: P,
    u: P,
    /// Angular velocity and `b n`.
    turn: P,
    pull: P,
}

/// A matrix whose values are diagonal; its derivatives need not be.
struct NearlyDiagonal<A: LoadStore> {
    columns: [A::Vector; 3],
    diagonal: A::Vector,
    /// Differences of the diagonal: `(m v) x v` is these times the products of the other two components of `v`.
    differences: A::Vector,
}

impl<A: LoadStore> NearlyDiagonal<A> {
    #[inline(always)]
    fn new(v: A, m: &Matrix3<A::Scalar>) -> Self {
        let [x, y, z] = [0, 1, 2].map(|j| Padded::from(Vector3::from(m.column(j))));
        Self {
            columns: [v.load(&x), v.load(&y), v.load(&z)],
            diagonal: v.load(&m.diagonal().into()),
            differences: v.load(&Vector3::new(m.m22 - m.m33, m.m33 - m.m11, m.m11 - m.m22).into()),
        }
    }

    #[inline(always)]
    fn times(&self, v: A, of: A::Vector) -> A::Vector {
        if A::Scalar::HAS_DERIVATIVES { v.combine(&self.columns, of) } else { v.mul(self.diagonal, of) }
    }
}

#[inline(always)]
fn cross<A: Arithmetic>(v: A, a: A::Permuted, b: A::Permuted) -> A::Vector {
    v.sub(v.mul(v.yzx(a), v.zxy(b)), v.mul(v.zxy(a), v.yzx(b)))
}

/// Adds the terms of all orders to the first, from `dn/dx = (a L) x n`, `dL/dx = (a L) x L + (b n) x n`,
/// `du/dx = (a L) x u`.
#[inline(always)]
fn add_terms<A: LoadStore>(v: A, [a, b]: &[Matrix3<A::Scalar>; 2], order: usize, terms: &mut Vec<Terms<A::Scalar>>) {
    let has_derivatives = A::Scalar::HAS_DERIVATIVES;
    let matrices = [NearlyDiagonal::new(v, a), NearlyDiagonal::new(v, b)];
    let mut factors = Vec::with_capacity(order);
    for order in 0..order {
        let [n, momentum, u] = &terms[order];
        let (n, momentum, u) = (v.load(n), v.load(momentum), v.load(u));
        factors.push(Factors {
            n: v.permuted(n),
            momentum: v.permuted(momentum),
            u: v.permuted(u),
            turn: v.permuted(matrices[0].times(v, momentum)),
            pull: if has_derivatives { v.permuted(matrices[1].times(v, n)) } else { v.permuted(n) },
        });
        // Products are rounded before they are added, so that doubles have the same digits on every processor.
        let (mut n, mut momentum, mut u) = (v.zero(), v.zero(), v.zero());
        let (mut of_momentum, mut of_n) = (v.zero(), v.zero());
        for (first, second) in factors.iter().zip(factors.iter().rev()) {
            n = v.add(n, cross(v, first.turn, second.n));
            u = v.add(u, cross(v, first.turn, second.u));
            if has_derivatives {
                let rate = v.add(cross(v, first.turn, second.momentum), cross(v, first.pull, second.n));
                momentum = v.add(momentum, rate);
            } else {
                of_momentum = v.add(of_momentum, v.mul(v.yzx(first.momentum), v.zxy(second.momentum)));
                of_n = v.add(of_n, v.mul(v.yzx(first.n), v.zxy(second.n)));
            }
        }
        if !has_derivatives {
            momentum = v.add(v.mul(of_momentum, matrices[0].differences), v.mul(of_n, matrices[1].differences));
        }
        let along = (order + 1) as f64;
        terms.push([v.store(v.divide(n, along)), v.store(v.divide(momentum, along)), v.store(v.divide(u, along))]);
    }
}

impl<S: FlowScalar> FlowSeries<S> {
    /// The series about a point, from the coefficients `a` and `b` of the flow.
    pub(super) fn new(
        slopes: &[Matrix3<S>; 2],
        start: &Axes<S>,
        Precision { order, last_terms, .. }: Precision,
    ) -> Self {
        let mut terms = Vec::with_capacity(order + 1);
        terms.push(start.map(Padded::from));
        match detect_fused() {
            Some(fused) => run_fused(
                fused,
                #[inline(always)]
                || add_terms(S::registers(fused), slopes, order, &mut terms),
            ),
            None => add_terms(plain(), slopes, order, &mut terms),
        }
        let mut series = Self { terms, step: 0.0 };
        series.step = series.longest_step(last_terms);
        series
    }

    /// The parameter up to which the last two terms are sufficiently small.
    fn longest_step(&self, last_terms: f64) -> f64 {
        let order = self.terms.len() - 1;
        let unit = length(&self.terms[0][1].vector().map(S::re));
        let size = |order: usize, part: fn(S) -> f64| {
            let [n, momentum, u] = self.term(order).map(|v| length(&v.map(part)));
            n.max(u).max(momentum / unit)
        };
        let least_of_both = |smallest: f64, part: fn(S) -> f64| {
            [order - 1, order].into_iter().fold(f64::INFINITY, |least, order| {
                let ratio = smallest.max(f64::MIN_POSITIVE) / size(order, part).max(f64::MIN_POSITIVE);
                least.min(ratio.powf(1.0 / order as f64))
            })
        };
        let mut step = least_of_both(last_terms, S::re);
        if S::HAS_DERIVATIVES {
            // Derivatives may contain multiples of the frequencies of the values.
            let first = (0..3).map(|order| size(order, derivative) * step.min(1.0).powi(order as i32));
            step = step.min(least_of_both(last_terms * first.fold(0.0, f64::max), derivative));
        }
        // Rounded to so few bits that steps add up exactly.
        (step * STEPS_IN_ONE).floor().max(1.0) / STEPS_IN_ONE
    }

    /// The terms of an order.
    pub(super) fn term(&self, order: usize) -> Axes<S> {
        self.terms[order].map(|v| v.vector())
    }

    /// The change up to a parameter.
    pub(super) fn change(&self, step: f64) -> Axes<S> {
        let step = S::from_f64(step);
        let mut sum = [Vector3::zeros(); 3];
        for terms in self.terms[1..].iter().rev() {
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum = (*sum + term.vector()) * step;
            }
        }
        sum
    }

    /// The axes at a parameter.
    pub(super) fn at(&self, step: f64) -> Axes<S> {
        let (start, change) = (self.term(0), self.change(step));
        core::array::from_fn(|i| start[i] + change[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOPES: [[f64; 3]; 2] = [[0.9, 1.1, 0.7], [0.3, -0.2, 0.05]];
    const START: [[f64; 3]; 3] = [[0.36, 0.48, 0.8], [1.2, -0.7, 2.1], [0.8, -0.6, 0.0]];

    fn series<S: FlowScalar>(precision: Precision) -> FlowSeries<S> {
        let number = |x: f64| S::from_f64(x);
        let slopes = SLOPES.map(|m| Matrix3::from_diagonal(&Vector3::from(m).map(number)));
        FlowSeries::new(&slopes, &START.map(|v| Vector3::from(v).map(number)), precision)
    }

    /// Largest difference of a term from that of another series, in units of the term's size.
    fn apart<S: FlowScalar, T: FlowScalar>(a: &FlowSeries<S>, b: &FlowSeries<T>) -> f64 {
        let terms = a.terms.iter().zip(&b.terms).flat_map(|(a, b)| a.iter().zip(b));
        let off =
            terms.map(|(a, b)| (a.vector().map(S::re) - b.vector().map(T::re)).norm() / a.vector().map(S::re).norm());
        off.fold(0.0, f64::max)
    }

    #[test]
    fn terms_are_the_same_by_any_instructions() {
        let (single, double) = (series::<f64>(DOUBLE), series::<DoubleDouble>(DOUBLE_DOUBLE));
        assert_eq!((single.terms.len(), double.terms.len()), (27, 45));
        assert_eq!(series::<f64>(COARSE).terms.len(), 15);
        let mut plainly = vec![START.map(|v| Padded::from(Vector3::from(v)))];
        add_terms(plain(), &SLOPES.map(|m| Matrix3::from_diagonal(&Vector3::from(m))), 26, &mut plainly);
        for (a, b) in plainly.iter().flatten().zip(single.terms.iter().flatten()) {
            assert_eq!(a.vector(), b.vector());
        }
        // Rounding grows by some units with each of 26 orders.
        assert!(apart(&single, &double) < 1e-14, "{:e}", apart(&single, &double));
        assert!(apart(&series::<Dual64>(DOUBLE), &double) < 1e-14);
        let slopes = SLOPES.map(|m| Matrix3::from_diagonal(&Vector3::from(m).map(DoubleDouble::from)));
        let mut plainly = vec![START.map(|v| Padded::from(Vector3::from(v).map(DoubleDouble::from)))];
        add_terms(plain(), &slopes, 44, &mut plainly);
        for (a, b) in plainly.iter().flatten().zip(double.terms.iter().flatten()) {
            assert_eq!(a.vector(), b.vector());
        }
    }

    /// Largest residual of `dn/dx = (a L) x n`, `dL/dx = (a L) x L + (b n) x n`, `du/dx = (a L) x u`, by differences of fourth order, over `L`.
    fn left<S: FlowScalar>(slopes: &[Matrix3<S>; 2], start: &Axes<S>, part: fn(S) -> f64) -> f64 {
        let series = FlowSeries::new(slopes, start, DOUBLE);
        let (x, h) = (0.6 * series.step, 1e-3 * series.step);
        let [n, momentum, u] = series.at(x);
        let (turn, pull) = (slopes[0] * momentum, slopes[1] * n);
        let rates = [turn.cross(&n), turn.cross(&momentum) + pull.cross(&n), turn.cross(&u)];
        let difference = |k: f64, i: usize| (series.at(x + k * h)[i] - series.at(x - k * h)[i]).map(part);
        let off = (0..3).map(|i| {
            let found = difference(1.0, i) * (2.0 / 3.0 / h) - difference(2.0, i) / (12.0 * h);
            (found - rates[i].map(part)).norm()
        });
        off.fold(0.0, f64::max) / momentum.map(S::re).norm()
    }

    /// Bounds are rounding over `h`, and `h^4` times a fifth derivative of some `(2 L)^5`.
    #[test]
    fn the_series_solves_its_equations() {
        let slopes = SLOPES.map(|m| Matrix3::from_diagonal(&Vector3::from(m)));
        let start = START.map(Vector3::from);
        let found = left(&slopes, &start, Real::re);
        assert!(found < 1e-11, "{found:e}");
        // Values are diagonal, derivatives are arbitrary.
        let by_parameter = Matrix3::new(0.3, -0.7, 0.2, -0.7, 0.1, 0.9, 0.2, 0.9, -0.4);
        let changing = |v: f64, by: f64| Dual64::new(v, by);
        let slopes = slopes.map(|m| m.zip_map(&(by_parameter + m * 0.4), changing));
        let start = start.map(|v| v.zip_map(&Vector3::new(0.2, -0.5, 0.8), changing));
        for (part, bound) in [(Real::re as fn(Dual64) -> f64, 1e-11), (derivative, 1e-10)] {
            let found = left(&slopes, &start, part);
            assert!(found < bound, "{found:e}");
        }
    }

    /// Size at the step of the sixteen terms after the last, divided by that of the whole change at the step (or at one, if
    /// the step is longer).
    fn left_out<S: FlowScalar>(
        slopes: &[Matrix3<S>; 2],
        start: &Axes<S>,
        precision: Precision,
        part: fn(S) -> f64,
    ) -> f64 {
        let (order, step) = (precision.order, FlowSeries::new(slopes, start, precision).step);
        let longer = FlowSeries::new(slopes, start, Precision { order: order + 16, ..precision });
        let unit = longer.term(0)[1].map(S::re).norm();
        let size = |orders: core::ops::RangeInclusive<usize>, x: f64| {
            let mut sum = [Vector3::zeros(); 3];
            for k in orders {
                (0..3).for_each(|i| sum[i] += longer.term(k)[i].map(part) * x.powi(k as i32));
            }
            sum[0].norm().max(sum[1].norm() / unit).max(sum[2].norm())
        };
        size(order + 1..=order + 16, step) / size(0..=order, step.min(1.0))
    }

    /// The terms after the last fall by a ratio `q`, starting from about the size of the last, so that the fraction `q / (1 - q)` of the last term
    /// is neglected. At these steps `q` is 0.02 to 0.05: the step is a fraction of the radius of convergence, so small that its last term is
    /// rounding.
    #[test]
    fn steps_are_as_long_as_the_precision_allows() {
        let slopes = SLOPES.map(|m| Matrix3::from_diagonal(&Vector3::from(m).map(DoubleDouble::from)));
        let start = START.map(|v| Vector3::from(v).map(DoubleDouble::from));
        for (precision, last_terms) in [(DOUBLE, 1e-17), (COARSE, 1e-9), (DOUBLE_DOUBLE, 1e-33)] {
            let found = left_out(&slopes, &start, precision, Real::re) / last_terms;
            assert!((0.02..0.05).contains(&found), "{precision:?}: {found:e}");
        }
        // Derivatives with respect to slopes and to the start, of any size, over steps below and above one.
        let changing = |v: f64, by: f64| Dual64::new(v, by);
        let by_parameter = Matrix3::new(0.3, -0.7, 0.2, -0.7, 0.1, 0.9, 0.2, 0.9, -0.4);
        for (of_slopes, of_start) in [(1.0, 0.0), (1e3, 0.0), (1e-3, 0.0), (0.0, 1.0), (0.0, 1e-3), (1.0, 1.0)] {
            for factor in [0.01, 1.0, 100.0] {
                let slopes = SLOPES.map(|m| {
                    let values = Matrix3::from_diagonal(&Vector3::from(m)) * factor;
                    values.zip_map(&(by_parameter * (of_slopes * factor)), changing)
                });
                let start =
                    START.map(|v| Vector3::from(v).zip_map(&(Vector3::new(0.2, -0.5, 0.8) * of_start), changing));
                let found = left_out(&slopes, &start, DOUBLE, derivative) / 1e-17;
                assert!((0.01..0.06).contains(&found), "{of_slopes} {of_start} {factor}: {found:e}");
            }
        }
    }
}
