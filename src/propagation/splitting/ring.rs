//! The operations of the flows, for one motion or for one in each lane of the vector registers.

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
