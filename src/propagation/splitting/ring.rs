//! The operations of the flows: for one motion, with or without fused multiply-add, or for one in each lane of the vector registers.

use core::ops::{Add, Mul, Sub};

/// A number, or one number for each of several motions, of which none knows of the others.
pub(in crate::propagation) trait Ring:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The constant `value`, of the kind of `self`.
    fn like(self, value: f64) -> Self;
    /// `self a + b`, rounded once or twice.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `self a - b`, rounded once or twice.
    fn mul_sub(self, a: Self, b: Self) -> Self;
    /// `self / divisor`, and zero where the divisor is zero.
    fn over(self, divisor: Self) -> Self;
}

impl Ring for f64 {
    #[inline(always)]
    fn like(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn mul_add(self, a: f64, b: f64) -> f64 {
        self * a + b
    }

    #[inline(always)]
    fn mul_sub(self, a: f64, b: f64) -> f64 {
        self * a - b
    }

    #[inline(always)]
    fn over(self, divisor: f64) -> f64 {
        if divisor == 0.0 { 0.0 } else { self / divisor }
    }
}

/// A double, one way or the other.
pub(super) trait Double: Ring {
    fn of(value: f64) -> Self;
    fn value(self) -> f64;
}

impl Double for f64 {
    #[inline(always)]
    fn of(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
}

impl Double for FusedDouble {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self.0
    }
}

/// A double whose products and sums are fused: fast only where the code is compiled for processors that have the instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(transparent)]
pub(super) struct FusedDouble(pub(super) f64);

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl $operator for FusedDouble {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);

impl Ring for FusedDouble {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }

    #[inline(always)]
    fn mul_sub(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, -b.0))
    }

    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        Self(self.0.over(divisor.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quotient_by_zero_is_zero() {
        for (divisor, quotient) in [(0.0, 0.0), (1.0, 3.0), (-2.0, -1.5)] {
            assert_eq!((3.0_f64.over(divisor), FusedDouble(3.0).over(FusedDouble(divisor)).0), (quotient, quotient));
        }
    }
}
