//! Taylor series of a motion about one time: the recurrences of the quadratic equations of motion.

use crate::numerics::arithmetic::Arithmetic;

/// The vectors of a series: `n`, `L` and, with `V = 3`, a vector `u` that rotates with `L / I^xx` like `n`.
pub(super) type Vectors<T, const V: usize> = [T; V];

/// Index of the symmetry axis.
pub(super) const AXIS: usize = 0;

/// Index of the angular momentum.
pub(super) const MOMENTUM: usize = 1;

/// Index of the vector carried along, if there is one.
pub(super) const COMPANION: usize = 2;

/// Largest order of a series.
pub(super) const MAX_ORDER: usize = 40;

/// Number of first coefficients to which the rounding error of their factors `rate / (k + 1)` is added back. This error is the same in every step,
/// so that without the correction the energy would drift linearly in time. Later coefficients are too small to matter.
pub(super) const MENDED: usize = 8;

/// Capacity for coefficients: a power of two, so that a masked index is within bounds without a comparison.
const PLACES: usize = 64;
const MASK: usize = PLACES - 1;

/// One factor of the convolutions, for all coefficients so far.
#[repr(align(64))]
struct Row<T>([T; PLACES]);

impl<T: Copy> Row<T> {
    fn filled(value: T) -> Box<Self> {
        Box::new(Self([value; PLACES]))
    }

    #[inline(always)]
    fn at(&self, k: usize) -> T {
        self.0[k & MASK]
    }

    #[inline(always)]
    fn window(&self, from: usize, count: usize) -> &[T] {
        &self.0[from..][..count]
    }

    #[inline(always)]
    fn put(&mut self, k: usize, value: T) {
        self.0[k & MASK] = value;
    }
}

/// The right-hand sides are quadratic, so each order is a convolution of products of the lower ones:
///
/// ```text
/// (k+1) n_{k+1} = sum_j L_j x n_{k-j} / I^xx
/// (k+1) L_{k+1} = sum_j (s n)_j x n_{k-j} 2 C
/// (k+1) u_{k+1} = sum_j L_j x u_{k-j} / I^xx
/// ```
///
/// In the principal frame of `s`, `(s n) x n` has the components `(s^YY - s^ZZ) n_Y n_Z` and so on, one product each.
pub(super) struct Recurrence<A: Arithmetic, const V: usize> {
    arithmetic: A,
    order: usize,
    /// `unit / (I^xx (k+1))`.
    share_of_axis: Box<Row<A::Vector>>,
    /// `2 C unit / (k+1)`, in the principal frame times the differences of eigenvalues.
    share_of_momentum: Box<Row<A::Vector>>,
    /// The rounding errors of both.
    rest_of_axis: [A::Vector; MENDED],
    rest_of_momentum: [A::Vector; MENDED],
    /// Columns of `s`.
    tensor: [A::Vector; 3],
    axis: Box<Row<A::Permuted>>,
    momentum: Box<Row<A::Permuted>>,
    /// `s n`; unused in the principal frame.
    pulled: Box<Row<A::Permuted>>,
    companion: Box<Row<A::Permuted>>,
}

/// Sums of one order: the terms of the cross products with either sign.
#[derive(Clone, Copy)]
struct Sums<T> {
    axis: [T; 2],
    pull: [T; 2],
    companion: [T; 2],
}

impl<A: Arithmetic, const V: usize> Recurrence<A, V> {
    /// The recurrences up to `order`. `axis_rate` is `unit / I^xx` for the unit of time of the series, `momentum_rate` is
    /// `2 C unit`, in the principal frame times the differences of eigenvalues `s^YY - s^ZZ, s^ZZ - s^XX, s^XX - s^YY`;
    /// `tensor` has the columns of `s`, which are not used there.
    pub(super) fn new(
        arithmetic: A,
        order: usize,
        axis_rate: A::Vector,
        momentum_rate: A::Vector,
        tensor: [A::Vector; 3],
    ) -> Self {
        let a = arithmetic;
        let zero = a.zero();
        let turned = || Row::filled(a.permuted(zero));
        let mut recurrence = Self {
            arithmetic,
            order,
            share_of_axis: Row::filled(zero),
            share_of_momentum: Row::filled(zero),
            rest_of_axis: [zero; MENDED],
            rest_of_momentum: [zero; MENDED],
            tensor,
            axis: turned(),
            momentum: turned(),
            pulled: turned(),
            companion: turned(),
        };
        recurrence.set_rates(axis_rate, momentum_rate);
        recurrence
    }

    /// Sets other rates from now on.
    #[inline(always)]
    pub(super) fn set_rates(&mut self, axis_rate: A::Vector, momentum_rate: A::Vector) {
        for k in 0..self.order {
            let order = (k + 1) as f64;
            self.share_of_axis.put(k, self.arithmetic.divide(axis_rate, order));
            self.share_of_momentum.put(k, self.arithmetic.divide(momentum_rate, order));
        }
        for k in 0..MENDED {
            self.rest_of_axis[k] = self.rest(axis_rate, self.share_of_axis.at(k), k + 1);
            self.rest_of_momentum[k] = self.rest(momentum_rate, self.share_of_momentum.at(k), k + 1);
        }
    }

    /// The difference between `rate / divisor` and `share`. The product of `share` and `divisor` is subtracted in powers of two, the largest first:
    /// each is at least half of the remainder, so that every difference is exact.
    #[inline(always)]
    fn rest(&self, rate: A::Vector, share: A::Vector, divisor: usize) -> A::Vector {
        let a = self.arithmetic;
        let twice = a.add(share, share);
        let fourfold = a.add(twice, twice);
        let mut left = rate;
        for (power, multiple) in [(8, a.add(fourfold, fourfold)), (4, fourfold), (2, twice), (1, share)] {
            if divisor & power != 0 {
                left = a.sub(left, multiple);
            }
        }
        a.divide(left, divisor as f64)
    }

    /// Whether the factors of coefficient `k + 1` are corrected. The factors of the first, second, fourth and eighth are
    /// exact.
    #[inline(always)]
    fn is_mended(k: usize) -> bool {
        const INEXACT: u32 = 1 << 2 | 1 << 4 | 1 << 5 | 1 << 6;
        k < MENDED && INEXACT >> k & 1 == 1
    }

    /// Fills `series` (of length `order + 1`) with the coefficients about the state `start`.
    #[inline(always)]
    pub(super) fn expand(&mut self, start: &Vectors<A::Vector, V>, series: &mut [Vectors<A::Vector, V>]) {
        // Several orders at once share their loads. How many fit into the registers depends on the sums of each.
        if A::MANY {
            self.expand_by::<1>(start, series);
        } else if const { V > COMPANION } {
            self.expand_by::<2>(start, series);
        } else {
            self.expand_by::<3>(start, series);
        }
    }

    #[inline(always)]
    fn expand_by<const B: usize>(&mut self, start: &Vectors<A::Vector, V>, series: &mut [Vectors<A::Vector, V>]) {
        let series = &mut series[..self.order + 1];
        self.put(0, start, series);
        let mut k = 0;
        while k < self.order.min(MENDED) {
            k += self.advance::<B, true>(k, series);
        }
        while k < self.order {
            k += self.advance::<B, false>(k, series);
        }
    }

    /// Computes coefficients from `k + 1` on and returns how many; `FIRST` if some of their factors may have to be
    /// corrected.
    #[inline(always)]
    fn advance<const B: usize, const FIRST: bool>(&mut self, k: usize, series: &mut [Vectors<A::Vector, V>]) -> usize {
        if k + 2 >= B && k + B <= self.order {
            // Orders k to k + B - 1, as far as the coefficients up to k determine them.
            let mut sums = [self.zero_sums(); B];
            self.add_common_terms(&mut sums, k);
            for (r, sum) in sums.iter_mut().enumerate() {
                for j in r..B - 1 {
                    self.add_term(sum, j, k + r - j);
                }
            }
            // Each completed order adds its terms to the next ones.
            for (r, sum) in sums.iter_mut().enumerate() {
                for newer in k + 1..k + r + 1 {
                    self.add_term(sum, newer, k + r - newer);
                    self.add_term(sum, k + r - newer, newer);
                }
                self.finish::<FIRST>(k + r, sum, series);
            }
            B
        } else {
            let mut sum = self.zero_sums();
            for j in 0..k + 1 {
                self.add_term(&mut sum, j, k - j);
            }
            self.finish::<FIRST>(k, &sum, series);
            1
        }
    }

    #[inline(always)]
    fn zero_sums(&self) -> Sums<A::Vector> {
        let zero = [self.arithmetic.zero(); 2];
        Sums { axis: zero, pull: zero, companion: zero }
    }

    /// Adds to the sums of the orders `k` to `k + B - 1` the terms in which the rotating factor has the coefficients `B - 1`
    /// to `k`.
    #[inline(always)]
    fn add_common_terms<const B: usize>(&self, sums: &mut [Sums<A::Vector>; B], k: usize) {
        let count = k + 2 - B;
        let pulled = if A::PRINCIPAL_FRAME { &self.axis } else { &self.pulled };
        let (momentum, pulled) = (self.momentum.window(B - 1, count), pulled.window(B - 1, count));
        let axis: [_; B] = core::array::from_fn(|r| self.axis.window(r, count));
        let companion: [_; B] = core::array::from_fn(|r| self.companion.window(r, count));
        for j in 0..count {
            let i = count - 1 - j;
            let (momentum, pulled) = (momentum[j], pulled[j]);
            for (r, sum) in sums.iter_mut().enumerate() {
                let companion = if V > COMPANION { companion[r][i] } else { momentum };
                self.add_products(sum, momentum, pulled, axis[r][i], companion);
            }
        }
    }

    /// Adds the products of coefficient `j` of the rotating factor and coefficient `i` of the rotated vector.
    #[inline(always)]
    fn add_term(&self, sums: &mut Sums<A::Vector>, j: usize, i: usize) {
        let pulled = if A::PRINCIPAL_FRAME { self.axis.at(j) } else { self.pulled.at(j) };
        let momentum = self.momentum.at(j);
        let companion = if V > COMPANION { self.companion.at(i) } else { momentum };
        self.add_products(sums, momentum, pulled, self.axis.at(i), companion);
    }

    /// Adds `L_j x n_i`, `(s n)_j x n_i` and `L_j x u_i`, by their terms of either sign.
    #[inline(always)]
    fn add_products(
        &self,
        sums: &mut Sums<A::Vector>,
        momentum: A::Permuted,
        pulled: A::Permuted,
        axis: A::Permuted,
        companion: A::Permuted,
    ) {
        let a = self.arithmetic;
        let add = |[ahead, behind]: [A::Vector; 2], turning, turned| {
            [a.mul_add(a.yzx(turning), a.zxy(turned), ahead), a.mul_add(a.zxy(turning), a.yzx(turned), behind)]
        };
        sums.axis = add(sums.axis, momentum, axis);
        if A::PRINCIPAL_FRAME {
            sums.pull[0] = a.mul_add(a.yzx(pulled), a.zxy(axis), sums.pull[0]);
        } else {
            sums.pull = add(sums.pull, pulled, axis);
        }
        if V > COMPANION {
            sums.companion = add(sums.companion, momentum, companion);
        }
    }

    /// Computes coefficient `k + 1` from the sums of order `k`.
    #[inline(always)]
    fn finish<const FIRST: bool>(&mut self, k: usize, sums: &Sums<A::Vector>, series: &mut [Vectors<A::Vector, V>]) {
        let a = self.arithmetic;
        let cross = |[ahead, behind]: [A::Vector; 2]| a.sub(ahead, behind);
        let pull = if A::PRINCIPAL_FRAME { sums.pull[0] } else { cross(sums.pull) };
        let mut next = [pull; V];
        next[AXIS] = cross(sums.axis);
        if V > COMPANION {
            next[COMPANION] = cross(sums.companion);
        }
        for (i, next) in next.iter_mut().enumerate() {
            let (shares, rests) = if i == MOMENTUM {
                (&self.share_of_momentum, &self.rest_of_momentum)
            } else {
                (&self.share_of_axis, &self.rest_of_axis)
            };
            let sum = *next;
            *next = if FIRST && Self::is_mended(k) {
                a.mul_add(sum, shares.at(k), a.mul(sum, rests[k]))
            } else {
                a.mul(sum, shares.at(k))
            };
        }
        self.put(k + 1, &next, series);
    }

    #[inline(always)]
    fn put(&mut self, k: usize, coefficient: &Vectors<A::Vector, V>, series: &mut [Vectors<A::Vector, V>]) {
        let a = self.arithmetic;
        series[k] = *coefficient;
        self.axis.put(k, a.permuted(coefficient[AXIS]));
        self.momentum.put(k, a.permuted(coefficient[MOMENTUM]));
        if !A::PRINCIPAL_FRAME {
            self.pulled.put(k, a.permuted(a.combine(&self.tensor, coefficient[AXIS])));
        }
        if V > COMPANION {
            self.companion.put(k, a.permuted(coefficient[COMPANION]));
        }
    }
}

/// `sum h + next`. A function rather than a closure: one that is not inlined is compiled without AVX2.
#[inline(always)]
fn times_plus<A: Arithmetic, const V: usize>(
    a: A,
    sum: &mut Vectors<A::Vector, V>,
    h: A::Vector,
    next: Vectors<A::Vector, V>,
) {
    for i in 0..V {
        sum[i] = a.mul_add(sum[i], h, next[i]);
    }
}

/// Change of the vectors over the time `h` (the same in each component), in units of the series, from its coefficients: the
/// sum without its constant term, which the caller adds last. `coefficient` gives the coefficients up to `order`.
#[inline(always)]
pub(super) fn change<A: Arithmetic, const V: usize>(
    a: A,
    order: usize,
    coefficient: impl Fn(usize) -> Vectors<A::Vector, V>,
    h: A::Vector,
) -> Vectors<A::Vector, V> {
    // Even and odd powers separately: two short chains of products instead of a long one. The largest terms come last.
    let zero = [a.zero(); V];
    let (mut even, mut odd) = (zero, zero);
    let square = a.mul(h, h);
    let mut k = order;
    if k.is_multiple_of(2) {
        even = coefficient(k);
        k -= 1;
    }
    // `k` is odd: pairs of an odd and an even coefficient, down to the third and second.
    while k > 2 {
        times_plus(a, &mut odd, square, coefficient(k));
        times_plus(a, &mut even, square, coefficient(k - 1));
        k -= 2;
    }
    let first = coefficient(1);
    let mut sum = zero;
    for i in 0..V {
        let higher = a.mul_add(odd[i], h, even[i]);
        sum[i] = a.mul(a.mul_add(higher, h, first[i]), h);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::arithmetic::{Componentwise, plain};
    use crate::numerics::double_double::DoubleDouble;

    #[test]
    fn first_shares_and_their_rests_are_the_quotients() {
        let rate = [0.7, -0.042 * 0.8, 1.0];
        let recurrence = Recurrence::<_, 2>::new(plain::<f64>(), 12, rate, rate, [[0.0; 3]; 3]);
        for k in 0..MENDED {
            let (share, rest) = (recurrence.share_of_axis.at(k), recurrence.rest_of_axis[k]);
            assert_eq!(rest, recurrence.rest_of_momentum[k]);
            for i in 0..3 {
                let product = DoubleDouble::sum(share[i], rest[i]) * DoubleDouble::from((k + 1) as f64);
                let left = (product - DoubleDouble::from(rate[i])).high;
                assert!(left.abs() < 1e-31 * rate[i].abs(), "{k} {i}: {left:e}");
            }
            assert_eq!(rest == [0.0; 3], !Recurrence::<Componentwise<f64>, 2>::is_mended(k), "{k}");
        }
    }
}
