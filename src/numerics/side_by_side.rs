//! Numbers side by side, one in each lane of a few registers.

use core::ops::{Add, Mul, Sub};

use crate::numerics::registers::Register;
use crate::numerics::ring::Ring;

/// [`COUNT`](Self::COUNT) numbers in `N` registers with interleaved operations: one starts while the other waits for its
/// result.
#[derive(Clone, Copy)]
pub(crate) struct SideBySide<R: Register, const N: usize> {
    register: R,
    lanes: [R::Lanes; N],
}

impl<R: Register, const N: usize> SideBySide<R, N> {
    /// Number of numbers.
    pub(crate) const COUNT: usize = N * R::COUNT;

    /// The same number everywhere.
    #[inline(always)]
    pub(crate) fn splat(register: R, value: f64) -> Self {
        Self { register, lanes: [register.splat(value); N] }
    }

    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> f64 {
        self.register.get(&self.lanes[place / R::COUNT], place % R::COUNT)
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, value: f64) {
        self.register.set(&mut self.lanes[place / R::COUNT], place % R::COUNT, value);
    }

    /// Collects numbers by their positions.
    #[inline(always)]
    pub(crate) fn gather(register: R, value: impl Fn(usize) -> f64) -> Self {
        let mut all = Self::splat(register, 0.0);
        for place in 0..Self::COUNT {
            all.set(place, value(place));
        }
        all
    }

    #[inline(always)]
    pub(crate) fn gather_vector(register: R, value: impl Fn(usize) -> [f64; 3]) -> [Self; 3] {
        let component = |i: usize| Self::gather(register, |place| value(place)[i]);
        [component(0), component(1), component(2)]
    }
}

impl<R: Register, const N: usize> SideBySide<R, N> {
    /// The larger of two in size, position by position; NaN in `self` stays.
    #[inline(always)]
    pub(crate) fn larger(mut self, other: Self) -> Self {
        for i in 0..N {
            self.lanes[i] = self.register.larger(self.lanes[i], other.lanes[i]);
        }
        self
    }

    /// The vector at one position.
    #[inline(always)]
    pub(crate) fn take(v: &[Self; 3], place: usize) -> [f64; 3] {
        [v[0].get(place), v[1].get(place), v[2].get(place)]
    }

    /// Replaces the vector at one position.
    #[inline(always)]
    pub(crate) fn put(v: &mut [Self; 3], place: usize, components: [f64; 3]) {
        for (v, component) in v.iter_mut().zip(components) {
            v.set(place, component);
        }
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<R: Register, const N: usize> $operator for SideBySide<R, N> {
            type Output = Self;

            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for i in 0..N {
                    self.lanes[i] = self.register.$instruction(self.lanes[i], other.lanes[i]);
                }
                self
            }
        }
    };
}

operator!(Add, add, add);
operator!(Sub, sub, sub);
operator!(Mul, mul, mul);

impl<R: Register, const N: usize> Ring for SideBySide<R, N> {
    const MANY: bool = true;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(self.register, value)
    }

    #[inline(always)]
    fn mul_add(mut self, a: Self, b: Self) -> Self {
        for i in 0..N {
            self.lanes[i] = self.register.mul_add(self.lanes[i], a.lanes[i], b.lanes[i]);
        }
        self
    }

    #[inline(always)]
    fn mul_sub(mut self, a: Self, b: Self) -> Self {
        for i in 0..N {
            self.lanes[i] = self.register.mul_sub(self.lanes[i], a.lanes[i], b.lanes[i]);
        }
        self
    }

    #[inline(always)]
    fn over(mut self, divisor: Self) -> Self {
        for i in 0..N {
            self.lanes[i] = self.register.div_or_zero(self.lanes[i], divisor.lanes[i]);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use pulp::x86::V3;

    use super::*;
    use crate::numerics::arithmetic::{Arithmetic, Componentwise};

    type Numbers = SideBySide<V3, 2>;

    #[test]
    fn columns_are_added_by_their_weights() {
        let Some(register) = V3::try_new() else { return };
        let entry = |i: usize, j: usize, place: usize| ((3 * i + j) * 8 + place) as f64;
        let column = |j: usize| [0, 1, 2].map(|i| Numbers::gather(register, |place| entry(i, j, place)));
        let arithmetic = Componentwise(Numbers::splat(register, 0.0));
        let weights = [2.0, 30.0, 500.0].map(|x| Numbers::splat(register, x));
        let combined = arithmetic.combine(&[0, 1, 2].map(column), weights);
        for place in 0..Numbers::COUNT {
            let expected = |i| 2.0 * entry(i, 0, place) + 30.0 * entry(i, 1, place) + 500.0 * entry(i, 2, place);
            assert_eq!(Numbers::take(&combined, place), [0, 1, 2].map(expected));
        }
    }

    #[test]
    fn quotients_are_taken_in_every_register() {
        let Some(register) = V3::try_new() else { return };
        let (a, b) = (|place: usize| 1.0 + place as f64, |place: usize| place as f64 - 5.0);
        let quotient = Numbers::gather(register, a).over(Numbers::gather(register, b));
        for place in 0..Numbers::COUNT {
            let expected = if place == 5 { 0.0 } else { a(place) / b(place) };
            assert_eq!(quotient.get(place), expected);
        }
    }
}
