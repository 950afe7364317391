//! Taylor series of a motion about one time: the recurrences of the quadratic equations of motion.

use nalgebra::Matrix3;
use num_traits::{One, Zero};

use crate::dynamics::RigidSpheroid;
use crate::propagation::arithmetic::{Arithmetic, Stored};

/// What a series carries: `n`, `L` and, with `V = 3`, a vector `u` that turns with `L / I^xx` as `n` does.
pub(super) type Vectors<T, const V: usize> = [T; V];

/// Place of the symmetry axis.
pub(super) const AXIS: usize = 0;

/// Place of the angular momentum.
pub(super) const MOMENTUM: usize = 1;

/// Place of the vector carried along, where there is one.
pub(super) const COMPANION: usize = 2;

/// Largest order of a series.
pub(super) const MAX_ORDER: usize = 40;

/// Coefficients kept at hand: a power of two, so that a masked index is within bounds without a comparison.
const PLACES: usize = 64;
const MASK: usize = PLACES - 1;

/// One factor of the convolutions, for every coefficient so far.
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
    fn put(&mut self, k: usize, value: T) {
        self.0[k & MASK] = value;
    }
}

/// The two cyclic permutations of a series of vectors, of which its cross products are made.
struct Turned<T> {
    yzx: Box<Row<T>>,
    zxy: Box<Row<T>>,
}

impl<T: Copy> Turned<T> {
    fn filled(value: T) -> Self {
        Self { yzx: Row::filled(value), zxy: Row::filled(value) }
    }

    #[inline(always)]
    fn at(&self, k: usize) -> [T; 2] {
        [self.yzx.at(k), self.zxy.at(k)]
    }

    #[inline(always)]
    fn window(&self, from: usize, count: usize) -> Window<'_, T> {
        Window { yzx: &self.yzx.0[from..][..count], zxy: &self.zxy.0[from..][..count] }
    }

    #[inline(always)]
    fn put<A: Arithmetic<Vector = T>>(&mut self, a: A, k: usize, v: T) {
        self.yzx.put(k, a.yzx(v));
        self.zxy.put(k, a.zxy(v));
    }
}

/// Consecutive coefficients.
#[derive(Clone, Copy)]
struct Window<'a, T> {
    yzx: &'a [T],
    zxy: &'a [T],
}

impl<T: Copy> Window<'_, T> {
    #[inline(always)]
    fn at(&self, k: usize) -> [T; 2] {
        [self.yzx[k], self.zxy[k]]
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
    /// Columns of `s`.
    violation: [A::Vector; 3],
    axis: Turned<A::Vector>,
    momentum: Turned<A::Vector>,
    /// `s n`; unused in the principal frame.
    pulled: Turned<A::Vector>,
    companion: Turned<A::Vector>,
}

/// Sums of one order: the terms of the cross products with either sign.
#[derive(Clone, Copy)]
struct Sums<T> {
    axis: [T; 2],
    pull: [T; 2],
    companion: [T; 2],
}

impl<A: Arithmetic, const V: usize> Recurrence<A, V> {
    /// The recurrences up to `order` for time in the given unit. `violation` must be diagonal if the arithmetic wants the
    /// principal frame.
    pub(super) fn new(
        arithmetic: A,
        spheroid: &RigidSpheroid<A::Scalar>,
        violation: &Matrix3<A::Scalar>,
        order: usize,
        unit: f64,
    ) -> Self {
        let a = arithmetic;
        let zero = a.zero();
        let columns = [0, 1, 2].map(|i| a.load(&Stored::from(violation.column(i).into_owned())));
        let differences = if A::PRINCIPAL_FRAME {
            let [x, y, z] = [0, 1, 2].map(|i| violation[(i, i)]);
            a.load(&Stored([y - z, z - x, x - y, A::Scalar::zero()]))
        } else {
            a.splat(A::Scalar::one())
        };
        let (mut share_of_axis, mut share_of_momentum) = (Row::filled(zero), Row::filled(zero));
        let inverse_inertia = A::Scalar::one() / spheroid.inertia_xx;
        for k in 0..order {
            let share = unit / (k + 1) as f64;
            share_of_axis.put(k, a.splat(inverse_inertia * share));
            share_of_momentum.put(k, a.mul(differences, a.splat(spheroid.constant_c * (2.0 * share))));
        }
        let turned = || Turned::filled(zero);
        Self {
            arithmetic,
            order,
            share_of_axis,
            share_of_momentum,
            violation: columns,
            axis: turned(),
            momentum: turned(),
            pulled: turned(),
            companion: turned(),
        }
    }

    /// Fills `series` (of length `order + 1`) with the coefficients about the state `start`.
    #[inline(always)]
    pub(super) fn expand(&mut self, start: &Vectors<A::Vector, V>, series: &mut [Vectors<Stored<A::Scalar>, V>]) {
        // Several orders at once share what they read. How many the registers hold depends on the sums of each.
        if V > COMPANION { self.expand_by::<2>(start, series) } else { self.expand_by::<3>(start, series) }
    }

    #[inline(always)]
    fn expand_by<const B: usize>(
        &mut self,
        start: &Vectors<A::Vector, V>,
        series: &mut [Vectors<Stored<A::Scalar>, V>],
    ) {
        let series = &mut series[..self.order + 1];
        self.put(0, start, series);
        let mut k = 0;
        while k < self.order {
            if k + 2 >= B && k + B <= self.order {
                // Orders k to k + B - 1, as far as the coefficients up to k go.
                let mut sums = [self.zero_sums(); B];
                self.add_common_terms(&mut sums, k);
                for (r, sum) in sums.iter_mut().enumerate() {
                    for j in r..B - 1 {
                        self.add_term(sum, j, k + r - j);
                    }
                }
                // Each order finished adds its terms to the next ones.
                for (r, sum) in sums.iter_mut().enumerate() {
                    for newer in k + 1..k + r + 1 {
                        self.add_term(sum, newer, k + r - newer);
                        self.add_term(sum, k + r - newer, newer);
                    }
                    self.finish(k + r, sum, series);
                }
                k += B;
            } else {
                let mut sum = self.zero_sums();
                for j in 0..k + 1 {
                    self.add_term(&mut sum, j, k - j);
                }
                self.finish(k, &sum, series);
                k += 1;
            }
        }
    }

    #[inline(always)]
    fn zero_sums(&self) -> Sums<A::Vector> {
        let zero = [self.arithmetic.zero(); 2];
        Sums { axis: zero, pull: zero, companion: zero }
    }

    /// Adds to the sums of the orders `k` to `k + B - 1` the terms that turn by the coefficients `B - 1` to `k`.
    #[inline(always)]
    fn add_common_terms<const B: usize>(&self, sums: &mut [Sums<A::Vector>; B], k: usize) {
        let count = k + 2 - B;
        let turning = [&self.momentum, if A::PRINCIPAL_FRAME { &self.axis } else { &self.pulled }];
        let [momentum, pulled] = turning.map(|turned| turned.window(B - 1, count));
        let axis: [_; B] = core::array::from_fn(|r| self.axis.window(r, count));
        let companion: [_; B] = core::array::from_fn(|r| self.companion.window(r, count));
        for j in 0..count {
            let i = count - 1 - j;
            let (momentum, pulled) = (momentum.at(j), pulled.at(j));
            for (r, sum) in sums.iter_mut().enumerate() {
                let companion = if V > COMPANION { companion[r].at(i) } else { momentum };
                self.add_products(sum, momentum, pulled, axis[r].at(i), companion);
            }
        }
    }

    /// Adds the products of coefficient `j` of what turns and coefficient `i` of what is turned.
    #[inline(always)]
    fn add_term(&self, sums: &mut Sums<A::Vector>, j: usize, i: usize) {
        let pulled = if A::PRINCIPAL_FRAME { self.axis.at(j) } else { self.pulled.at(j) };
        let momentum = self.momentum.at(j);
        let companion = if V > COMPANION { self.companion.at(i) } else { momentum };
        self.add_products(sums, momentum, pulled, self.axis.at(i), companion);
    }

    /// Adds `L_j x n_i`, `(s n)_j x n_i` and `L_j x u_i`, each vector by its two permutations.
    #[inline(always)]
    fn add_products(
        &self,
        sums: &mut Sums<A::Vector>,
        momentum: [A::Vector; 2],
        pulled: [A::Vector; 2],
        axis: [A::Vector; 2],
        companion: [A::Vector; 2],
    ) {
        let a = self.arithmetic;
        let add = |[ahead, behind]: [A::Vector; 2], [yzx, zxy]: [A::Vector; 2], turned: [A::Vector; 2]| {
            [a.mul_add(yzx, turned[1], ahead), a.mul_add(zxy, turned[0], behind)]
        };
        sums.axis = add(sums.axis, momentum, axis);
        if A::PRINCIPAL_FRAME {
            sums.pull[0] = a.mul_add(pulled[0], axis[1], sums.pull[0]);
        } else {
            sums.pull = add(sums.pull, pulled, axis);
        }
        if V > COMPANION {
            sums.companion = add(sums.companion, momentum, companion);
        }
    }

    /// Makes coefficient `k + 1` of the sums of order `k`.
    #[inline(always)]
    fn finish(&mut self, k: usize, sums: &Sums<A::Vector>, series: &mut [Vectors<Stored<A::Scalar>, V>]) {
        let a = self.arithmetic;
        let cross = |[ahead, behind]: [A::Vector; 2]| a.sub(ahead, behind);
        let pull = if A::PRINCIPAL_FRAME { sums.pull[0] } else { cross(sums.pull) };
        let mut next = [pull; V];
        next[AXIS] = a.mul(cross(sums.axis), self.share_of_axis.at(k));
        next[MOMENTUM] = a.mul(pull, self.share_of_momentum.at(k));
        if V > COMPANION {
            next[COMPANION] = a.mul(cross(sums.companion), self.share_of_axis.at(k));
        }
        self.put(k + 1, &next, series);
    }

    #[inline(always)]
    fn put(&mut self, k: usize, coefficient: &Vectors<A::Vector, V>, series: &mut [Vectors<Stored<A::Scalar>, V>]) {
        let a = self.arithmetic;
        series[k] = coefficient.map(|v| a.store(v));
        self.axis.put(a, k, coefficient[AXIS]);
        self.momentum.put(a, k, coefficient[MOMENTUM]);
        if !A::PRINCIPAL_FRAME {
            self.pulled.put(a, k, a.combine(&self.violation, coefficient[AXIS]));
        }
        if V > COMPANION {
            self.companion.put(a, k, coefficient[COMPANION]);
        }
    }
}

/// Change of the vectors over the time `h`, in units of the series, by its coefficients: the sum without its constant term,
/// which the caller adds last.
#[inline(always)]
pub(super) fn change<A: Arithmetic, const V: usize>(
    a: A,
    series: &[Vectors<Stored<A::Scalar>, V>],
    h: A::Scalar,
) -> Vectors<A::Vector, V> {
    // Even and odd powers apart: two short chains of products instead of a long one. The largest terms come last.
    let zero = [a.zero(); V];
    let (mut even, mut odd) = (zero, zero);
    let (step, square) = (a.splat(h), a.splat(h * h));
    let times_plus = |sum: &mut Vectors<A::Vector, V>, factor, next: &Vectors<Stored<A::Scalar>, V>| {
        for (sum, next) in sum.iter_mut().zip(next) {
            *sum = a.mul_add(*sum, factor, a.load(next));
        }
    };
    // Pairs of an even and an odd coefficient from the second on; the last may be alone.
    let pairs = series[2..].chunks_exact(2);
    if let [last] = pairs.remainder() {
        even = last.each_ref().map(|v| a.load(v));
    }
    for pair in pairs.rev() {
        times_plus(&mut even, square, &pair[0]);
        times_plus(&mut odd, square, &pair[1]);
    }
    let mut sum = zero;
    for i in 0..V {
        let higher = a.mul_add(odd[i], step, even[i]);
        sum[i] = a.mul(a.mul_add(higher, step, a.load(&series[1][i])), step);
    }
    sum
}
