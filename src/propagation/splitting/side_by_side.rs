//! Numbers of several motions side by side, one in each lane of a few registers.

use core::ops::{Add, Mul, Sub};

use crate::numerics::registers::Register;
use crate::propagation::splitting::flows::{Field, Moving};
use crate::propagation::splitting::ring::Ring;

/// One number for each of [`COUNT`](Self::COUNT) motions, in `N` registers whose operations take turns: one starts while the other
/// waits for its result.
#[derive(Clone, Copy)]
pub(super) struct SideBySide<R: Register, const N: usize> {
    register: R,
    lanes: [R::Lanes; N],
}

impl<R: Register, const N: usize> SideBySide<R, N> {
    /// Number of motions.
    pub(super) const COUNT: usize = N * R::COUNT;

    /// The same number for every motion.
    #[inline(always)]
    pub(super) fn splat(register: R, value: f64) -> Self {
        Self { register, lanes: [register.splat(value); N] }
    }

    #[inline(always)]
    pub(super) fn get(&self, place: usize) -> f64 {
        self.register.get(&self.lanes[place / R::COUNT], place % R::COUNT)
    }

    #[inline(always)]
    pub(super) fn set(&mut self, place: usize, value: f64) {
        self.register.set(&mut self.lanes[place / R::COUNT], place % R::COUNT, value);
    }

    /// The numbers of motions, by their places.
    #[inline(always)]
    pub(super) fn gather(register: R, value: impl Fn(usize) -> f64) -> Self {
        let mut all = Self::splat(register, 0.0);
        for place in 0..Self::COUNT {
            all.set(place, value(place));
        }
        all
    }

    #[inline(always)]
    fn gather_vector(register: R, value: impl Fn(usize) -> [f64; 3]) -> [Self; 3] {
        let component = |i: usize| Self::gather(register, |place| value(place)[i]);
        [component(0), component(1), component(2)]
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

impl<R: Register, const N: usize, const V: usize> Moving<SideBySide<R, N>, V> {
    /// The states of motions, by their places.
    #[inline(always)]
    pub(super) fn gather<'m>(register: R, state: impl Fn(usize) -> &'m Moving<f64, V>) -> Self {
        let vector = |v: usize| SideBySide::gather_vector(register, |place| state(place).vectors[v]);
        Moving::new(core::array::from_fn(vector))
    }

    /// The state of one motion.
    #[inline(always)]
    pub(super) fn take(&self, place: usize) -> Moving<f64, V> {
        let of = |v: &[SideBySide<R, N>; 3]| v.each_ref().map(|component| component.get(place));
        Moving { vectors: self.vectors.each_ref().map(of), low: self.low.each_ref().map(of) }
    }

    /// Replaces the state of one motion.
    #[inline(always)]
    pub(super) fn put(&mut self, place: usize, state: &Moving<f64, V>) {
        for v in 0..V {
            for i in 0..3 {
                self.vectors[v][i].set(place, state.vectors[v][i]);
                self.low[v][i].set(place, state.low[v][i]);
            }
        }
    }
}

impl<R: Register, const N: usize> Field<SideBySide<R, N>> {
    /// The fields of motions, by their places.
    #[inline(always)]
    pub(super) fn gather<'f>(register: R, field: impl Fn(usize) -> &'f Field<f64>) -> Self {
        Field {
            strength: SideBySide::gather(register, |place| field(place).strength),
            tensor: SideBySide::gather_vector(register, |place| field(place).tensor),
            torque: SideBySide::gather_vector(register, |place| field(place).torque),
        }
    }
}

#[cfg(test)]
mod tests {
    use pulp::x86::V3;

    use super::*;

    type Numbers = SideBySide<V3, 2>;

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

    #[test]
    fn the_state_put_in_a_place_is_taken_from_it_again() {
        let Some(register) = V3::try_new() else { return };
        let state = |first: f64| Moving::<f64, 3> {
            vectors: [0.0, 3.0, 6.0].map(|x| [first + x, first + x + 1.0, first + x + 2.0]),
            low: [0.25, 3.25, 6.25].map(|x| [first + x, first + x + 1.0, first + x + 2.0]),
        };
        let other = Moving { low: [[0.0; 3]; 3], ..state(100.0) };
        let mut states = Moving::<Numbers, 3>::gather(register, |_| &other);
        for place in [2, 7] {
            states.put(place, &state(10.0 * place as f64));
        }
        for place in 0..Numbers::COUNT {
            let expected = if place == 2 || place == 7 { state(10.0 * place as f64) } else { other };
            assert_eq!(states.take(place), expected);
        }
    }
}
