//! Ring operations: for one number, with or without fused multiply-add, or for one number in each lane of the vector
//! registers.

use core::ops::{Add, Mul, Sub};

use crate::numerics::scalar::Real;

/// A number, or one number for each of several independent motions.
pub(crate) trait Ring: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Whether it is many numbers.
    const MANY: bool = false;

    /// The constant `value`, in the type of `self`.
    fn like(self, value: f64) -> Self;
    /// `self a + b`, rounded once or twice.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `self a - b`, rounded once or twice.
    fn mul_sub(self, a: Self, b: Self) -> Self;
    /// `self / divisor`, and zero where the divisor is zero.
    fn over(self, divisor: Self) -> Self;
}

impl<S: Real> Ring for S {
    #[inline(always)]
    fn like(self, value: f64) -> S {
        S::from_f64(value)
    }

    #[inline(always)]
    fn mul_add(self, a: S, b: S) -> S {
        self * a + b
    }

    #[inline(always)]
    fn mul_sub(self, a: S, b: S) -> S {
        self * a - b
    }

    #[inline(always)]
    fn over(self, divisor: S) -> S {
        if divisor.re() == 0.0 { S::zero() } else { self / divisor }
    }
}

/// A double in either form.
pub(crate) trait Double: Ring {
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

/// A double with fused products and sums: fast only where the code is compiled for processors that have the instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(transparent)]
pub(crate) struct FusedDouble(pub(crate) f64);

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
