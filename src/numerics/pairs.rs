//! Vectors of double-double numbers in two registers.

use core::ops::{Add, Mul, Sub};

use crate::numerics::arithmetic::{Arithmetic, LoadStore, Padded};
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::rounding::{add_pairs, multiply_pairs, two_sum};

/// Arithmetic of double-double numbers in terms of doubles whose `a * b + c` is rounded once, as in
/// [`detect_fused`](crate::numerics::fused::detect_fused): the same digits as with [`DoubleDouble`], with 10 operations for a vector of products in
/// place of 72.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pairs<A>(pub(crate) A);

/// A register and its operations.
#[derive(Clone, Copy)]
struct Lanes<A: Arithmetic>(A, A::Vector);

macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<A: Arithmetic> $operator for Lanes<A> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0, self.0.$instruction(self.1, other.1))
            }
        }
    };
}

operator!(Add, add, add);
operator!(Sub, sub, sub);
operator!(Mul, mul, mul);

impl<A: Arithmetic> Pairs<A> {
    #[inline(always)]
    fn lanes(self, [high, low]: [A::Vector; 2]) -> [Lanes<A>; 2] {
        [Lanes(self.0, high), Lanes(self.0, low)]
    }

    #[inline(always)]
    fn negative(self, a: A::Vector) -> A::Vector {
        self.0.sub(self.0.zero(), a)
    }

    /// The rounded product and its rounding error.
    #[inline(always)]
    fn exact_product(self, a: A::Vector, b: A::Vector) -> (Lanes<A>, Lanes<A>) {
        let product = self.0.mul(a, b);
        let lost = self.0.mul_add(a, b, self.negative(product));
        (Lanes(self.0, product), Lanes(self.0, lost))
    }
}

impl<A: LoadStore<Scalar = f64>> Pairs<A> {
    /// `a - quotient divisor`.
    #[inline(always)]
    fn without_product(self, a: [A::Vector; 2], quotient: A::Vector, divisor: f64) -> [A::Vector; 2] {
        let (product, lost) = self.exact_product(quotient, self.0.splat(-divisor));
        self.add(a, [product.1, lost.1])
    }
}

impl<A: LoadStore<Scalar = f64>> Arithmetic for Pairs<A> {
    type Vector = [A::Vector; 2];
    type Permuted = [A::Permuted; 2];
    const PRINCIPAL_FRAME: bool = true;

    #[inline(always)]
    fn zero(self) -> Self::Vector {
        [self.0.zero(); 2]
    }

    #[inline(always)]
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        let [high, low] = add_pairs(self.lanes(a), self.lanes(b));
        [high.1, low.1]
    }

    #[inline(always)]
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.add(a, [self.negative(b[0]), self.negative(b[1])])
    }

    #[inline(always)]
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        let [high, low] = multiply_pairs(self.lanes(a), self.lanes(b), self.exact_product(a[0], b[0]));
        [high.1, low.1]
    }

    #[inline(always)]
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector {
        self.add(self.mul(a, b), c)
    }

    /// Long division: two digits and a correction.
    #[inline(always)]
    fn divide(self, a: Self::Vector, divisor: f64) -> Self::Vector {
        let first = self.0.divide(a[0], divisor);
        let rest = self.without_product(a, first, divisor);
        let second = self.0.divide(rest[0], divisor);
        let rest = self.without_product(rest, second, divisor);
        let (high, low) = two_sum(Lanes(self.0, first), Lanes(self.0, second));
        self.add([high.1, low.1], [self.0.divide(rest[0], divisor), self.0.zero()])
    }

    #[inline(always)]
    fn combine(self, [a, b, c]: &[Self::Vector; 3], v: Self::Vector) -> Self::Vector {
        let [x, y, z, _] = self.store(v).0;
        let first = self.mul(*a, self.splat(x));
        self.mul_add(*c, self.splat(z), self.mul_add(*b, self.splat(y), first))
    }

    #[inline(always)]
    fn permuted(self, v: Self::Vector) -> Self::Permuted {
        [self.0.permuted(v[0]), self.0.permuted(v[1])]
    }

    #[inline(always)]
    fn yzx(self, v: Self::Permuted) -> Self::Vector {
        [self.0.yzx(v[0]), self.0.yzx(v[1])]
    }

    #[inline(always)]
    fn zxy(self, v: Self::Permuted) -> Self::Vector {
        [self.0.zxy(v[0]), self.0.zxy(v[1])]
    }
}

impl<A: LoadStore<Scalar = f64>> LoadStore for Pairs<A> {
    type Scalar = DoubleDouble;

    #[inline(always)]
    fn load(self, kept: &Padded<DoubleDouble>) -> Self::Vector {
        [self.0.load(&Padded(kept.0.map(|x| x.high))), self.0.load(&Padded(kept.0.map(|x| x.low)))]
    }

    #[inline(always)]
    fn store(self, v: Self::Vector) -> Padded<DoubleDouble> {
        let [high, low] = [self.0.store(v[0]).0, self.0.store(v[1]).0];
        Padded(core::array::from_fn(|i| DoubleDouble { high: high[i], low: low[i] }))
    }

    #[inline(always)]
    fn splat(self, value: DoubleDouble) -> Self::Vector {
        [self.0.splat(value.high), self.0.splat(value.low)]
    }

    #[inline(always)]
    fn largest(self, v: Self::Vector) -> f64 {
        self.0.largest(v[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::arithmetic::plain;
    use crate::numerics::fused::detect_fused;

    /// Sizes from 1e-100 to 1e100, with cancelling sums among them.
    fn vectors() -> Vec<[DoubleDouble; 3]> {
        let number = |k: usize| {
            let high = (0.7 * k as f64).sin() * 10f64.powi([-100, -3, -1, 0, 1, 3, 100][k % 7]);
            DoubleDouble::sum(high, high * 1e-17 * (1.3 * k as f64).cos())
        };
        let mut all: Vec<_> = (0..200).map(|k| [number(k), number(3 * k + 1), number(5 * k + 2)]).collect();
        all.push(all[7].map(|x| x + DoubleDouble::from(1e-20)));
        all.push([DoubleDouble::from(0.0); 3]);
        all
    }

    #[test]
    fn digits_are_those_of_single_numbers() {
        let Some(pairs) = detect_fused().map(Pairs) else { return };
        let single = plain::<DoubleDouble>();
        let load = |[x, y, z]: [DoubleDouble; 3]| LoadStore::load(pairs, &Padded([x, y, z, DoubleDouble::from(0.0)]));
        let same = |found, expected: [DoubleDouble; 3]| assert_eq!(LoadStore::store(pairs, found).0[..3], expected);
        let all = vectors();
        for (i, &a) in all.iter().enumerate() {
            for &b in &all {
                let (c, divisor) = (all[(7 * i) % all.len()], 1.0 + i as f64);
                let [wide_a, wide_b, wide_c] = [a, b, c].map(load);
                same(pairs.add(wide_a, wide_b), single.add(a, b));
                same(pairs.sub(wide_a, wide_b), single.sub(a, b));
                same(pairs.mul(wide_a, wide_b), single.mul(a, b));
                same(pairs.mul_add(wide_a, wide_b, wide_c), single.mul_add(a, b, c));
                // Everything except the rounding of the product cancels.
                let product = a.map(|x| -x);
                let product = [0, 1, 2].map(|i| DoubleDouble::from((product[i] * b[i]).high));
                same(pairs.mul_add(wide_a, wide_b, load(product)), single.mul_add(a, b, product));
                same(pairs.divide(wide_a, divisor), single.divide(a, divisor));
                same(pairs.combine(&[wide_a, wide_b, wide_c], wide_b), single.combine(&[a, b, c], b));
                let turned = pairs.permuted(wide_a);
                same(pairs.yzx(turned), [a[1], a[2], a[0]]);
                same(pairs.zxy(turned), [a[2], a[0], a[1]]);
                assert_eq!(pairs.largest(wide_a), single.largest(a));
            }
            same(pairs.splat(a[0]), [a[0]; 3]);
        }
        same(pairs.zero(), single.zero());
    }
}
